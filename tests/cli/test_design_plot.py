# SPDX-License-Identifier: BSD-3-Clause
"""metamer design --plot: a picture that any reader of XML reads, with all names, and marks where goals are missed."""
import os
import xml.etree.ElementTree as ElementTree

import support

SVG = "{http://www.w3.org/2000/svg}"
ODD = "bone <&> \"a\" ]]> \u30e9"
CONTROL = "\u0001\uffff"


def goals(materials, lights, cells, **more):
    return {"metamer": 1, "materials": materials, "lights": lights, "goals": cells, **more}


def designed(*names):
    return [{"name": name, "design": "physical"} for name in names]


DAY = {"name": "day", "illuminant": "D65"}
GREY = {"name": "grey", "srgb": "#808080"}


class DesignPlotTest(support.CliTest):
    def plot(self, document):
        self.write_json("goals.json", document)
        self.succeed("design", "goals.json", "-o", "palette.json", "--plot", "plot.svg")
        return ElementTree.parse(self.path("plot.svg")).getroot()

    def texts(self, root):
        return ["".join(element.itertext()) for element in root.iter(SVG + "text")]

    def titles(self, root):
        return [element.text for element in root.iter(SVG + "title")]

    def marks(self, root, kind):
        return [path for path in root.iter(SVG + "path") if path.get("class") == kind]

    def boxes(self, root):
        return [box.get("fill") for box in root.iter(SVG + "rect")]

    def assert_inside(self, root):
        """Nothing is drawn beyond the picture."""
        width, height = float(root.get("width")), float(root.get("height"))
        for element in root.iter():
            for name, most in (("x", width), ("y", height)):
                if element.get(name) is not None:
                    self.assertTrue(0 <= float(element.get(name)) <= most, ElementTree.tostring(element))

    def test_a_figure_of_the_paper(self):
        root = self.plot({"metamer": 1, "goals": [{"recipe": "figure 7"}]})
        self.assertEqual(root.tag, SVG + "svg")
        self.assertIn("4 of 4", root.find(SVG + "title").text)
        for word in ("flesh (physical)", "gel (physical)", "light 1 (physical)", "No goal is missed"):
            self.assertIn(word, root.find(SVG + "desc").text)
        texts = self.texts(root)
        for name in ("flesh", "gel", "light 1", "light 2"):
            self.assertEqual(texts.count(name), 2, name)  # beside the curve and in the table
        self.assertEqual(len(list(root.iter(SVG + "polyline"))), 4)
        self.assertEqual(texts.count("="), 2)
        self.assertIn("= flesh", texts)
        self.assertIn("= light 1", texts)
        self.assertIn("#b8584a", self.boxes(root))
        self.assertEqual(self.marks(root, "missed"), [])
        self.assert_inside(root)

    def test_names_are_any_text(self):
        root = self.plot(goals([*designed(ODD), {"name": CONTROL, "srgb": "#808080"}], [DAY],
                               [{"material": ODD, "light": "day", "srgb": "#406080"}]))
        self.assertIn(ODD, self.titles(root))
        self.assertIn("\ufffd\ufffd", self.texts(root))
        self.assertIn(ODD, root.find(SVG + "desc").text)

    def test_a_missed_goal_is_marked(self):
        root = self.plot(goals([GREY, *designed("free")], [DAY], [{"material": "grey", "light": "day", "srgb": "#ff0000"},
                                                                {"material": "free", "light": "day", "black": True}]))
        self.assertEqual(len(self.marks(root, "missed")), 2)  # the cell and the key
        texts = self.texts(root)
        self.assertIn("missed", texts)
        self.assertIn("Not as asked", texts)
        self.assertIn("Missed: grey under day", root.find(SVG + "desc").text)
        self.assertIn("#ff0000", self.boxes(root))
        self.assertIn("given", texts)

    def test_a_cell_that_nothing_was_asked_of_and_one_that_differs(self):
        root = self.plot(goals([GREY, *designed("other")], [DAY],
                               [{"material": "other", "light": "day", "differs_from": {"material": "grey"}, "by": 20}]))
        texts = self.texts(root)
        self.assertIn("–", texts)
        self.assertIn("≠", texts)
        self.assertIn("≠ grey", texts)
        self.assertTrue(any("(≥ 20)" in text for text in texts), texts)
        self.assertIn("grey under day: #808080, nothing asked", self.titles(root))

    def test_measured_reflectances_say_so(self):
        lines = ["wavelength_nm,red tile", "380,0.1", "560,0.1", "600,0.7", "780,0.7"]
        self.write_text("tiles.csv", "\n".join(lines) + "\n")
        color = self.json_of("color", "tiles.csv")["colors"][0]
        srgb = "#" + "".join(f"{round(255 * value):02x}" for value in color["srgb_picture"])
        root = self.plot(goals(designed("tile"), [DAY], [
            {"material": "tile", "light": "day", "srgb": srgb},
            {"recipe": "from_library", "materials": ["tile"], "tables": ["tiles.csv"]}]))
        self.assertIn("measured: red tile", self.texts(root))
        self.assertTrue(any("measured" in text and "dots" in text for text in self.texts(root)))

    def test_sixteen_of_each(self):
        materials = [{"name": f"material {i}", "srgb": f"#{16 * i:02x}6080"} for i in range(16)]
        lights = [{"name": f"light {i}", "blackbody": 2500 + 300 * i} for i in range(16)]
        root = self.plot(goals([*materials, *designed("found")], lights,
                               [{"material": "found", "light": "light 15", "srgb": "#607080"}]))
        texts = self.texts(root)
        for name in [material["name"] for material in materials] + [light["name"] for light in lights]:
            self.assertGreaterEqual(texts.count(name), 2, name)
        self.assertEqual(len(list(root.iter(SVG + "polyline"))), 33)
        self.assert_inside(root)

    def test_all_or_nothing(self):
        self.write_json("goals.json", {"metamer": 1, "goals": [{"recipe": "figure 7"}]})
        self.refuse("design", "goals.json", "-o", "palette.json", "--plot", "no/plot.svg", texts=["no/plot.svg"])
        self.assertFalse(os.path.exists(self.path("palette.json")))


if __name__ == "__main__":
    support.main()
