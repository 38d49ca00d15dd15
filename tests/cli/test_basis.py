# SPDX-License-Identifier: BSD-3-Clause
"""Rendering in every basis and relighting the result."""
import support

BASES = {"factors:3": 3, "factors:5": 5, "factors:7": 7, "factors:9": 9, "sharpened:7": 7, "wavelengths:31": 31}


class Basis(support.CliTest):
    def setUp(self):
        super().setUp()
        self.scene = support.make_scene()
        self.write_json("scene.json", self.scene)

    def render(self, basis):
        result = self.call("render", "scene.json", "-o", "image.exr", "--basis", basis)
        self.assertEqual(result.returncode, 0, result.stderr)  # a note on large errors may stand there
        return self.json_of("info", "image.exr")

    def difference(self, basis, light):
        """Mean CIEDE2000 to the reference under another light."""
        self.render("wavelengths")
        self.succeed("relight", "image.exr", "-o", "reference.png", "--illuminant", light)
        self.render(basis)
        self.succeed("relight", "image.exr", "-o", "relit.png", "--illuminant", light)
        return self.json_of("compare", "relit.png", "reference.png")["ciede2000"]["mean"]

    def test_images_name_their_basis_with_its_dimension(self):
        for basis, dimension in BASES.items():
            facts = self.render(basis)
            self.assertEqual((facts["basis"], facts["dimension"]), (basis, dimension))
        self.assertEqual(self.render("factors")["basis"], "factors:7")
        self.assertEqual(self.render("wavelengths")["basis"], "wavelengths")

    def test_more_than_six_materials_are_factors(self):
        for count in (6, 7):
            materials = self.scene["palette"]["materials"]
            materials += [{"name": f"m{i}", "srgb": "#808080"} for i in range(len(materials), count)]
            self.write_json("scene.json", self.scene)
            self.assertEqual(self.render("auto")["basis"], "materials" if count == 6 else "factors:7")

    def test_more_coefficients_are_nearer_and_sharpened_is_far(self):
        for light in ("FL11", "LED-B3"):
            nine, seven = self.difference("factors:9", light), self.difference("factors:7", light)
            self.assertLess(nine, 0.3)
            self.assertLess(seven, 0.5)
            self.assertGreater(seven, 0)
            self.assertGreater(self.difference("sharpened:7", light), 2 * seven)

    def test_a_basis_that_shows_other_colors_says_so(self):
        band = [1 if 540 <= nm <= 550 else 0 for nm in range(380, 781, 5)]
        self.scene["palette"]["materials"][1] = {"name": "shell", "values": band}
        self.write_json("scene.json", self.scene)
        result = self.call("render", "scene.json", "-o", "image.exr", "--basis", "factors:7")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"note: basis factors:7 shows \"shell\" under \"\w+\" \d+\.\d CIEDE2000")
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.succeed("render", "scene.json", "-o", "image.exr", "--basis", "materials")

    def test_dimensions_are_checked(self):
        for basis in ("factors:2", "factors:10", "sharpened:x", "wavelengths:7"):
            result = self.call("render", "scene.json", "-o", "image.exr", "--basis", basis)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn(basis, result.stderr)
            self.assertIn("the dimension of", result.stderr)

    def test_reflectances_are_fixed_after_rendering(self):
        self.render("factors:7")
        self.write_json("new.json", {"materials": [{"name": "core", "srgb": "#00ff00"}]})
        self.refuse("relight", "image.exr", "-o", "relit.png", "--palette", "new.json",
                    texts=["core", "factors:7", "--basis materials"])


if __name__ == "__main__":
    support.main()
