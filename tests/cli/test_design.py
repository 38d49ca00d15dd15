# SPDX-License-Identifier: BSD-3-Clause
"""metamer design: the report against colors summed here from the palette it wrote, and what it refuses."""
import csv
import json
import os

import support

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
SPECTRA = os.path.join(ROOT, "data/spectra")
GOALS = {"metamer": 1,
         "materials": [{"name": "skin", "spectrum": os.path.join(SPECTRA, "reflectance_ces99.csv") + ":CES05"},
                       {"name": "twin", "design": "physical"}],
         "lights": [{"name": "day", "illuminant": "D65"}, {"name": "lamp", "design": "physical"}],
         "goals": [{"material": "twin", "light": "day", "same_as": {"material": "skin"}},
                   {"material": "twin", "light": "lamp", "differs_from": {"material": "skin"}, "by": 15}]}
IMPOSSIBLE = {"metamer": 1, "materials": [{"name": "a", "design": "physical"}],
              "lights": [{"name": "day", "illuminant": "D65"}, {"name": "lamp", "illuminant": "A"}],
              "goals": [{"material": "a", "light": "day", "black": True},
                        {"material": "a", "light": "lamp", "srgb": "#a08060"}]}


def observer():
    """The three curves of CIE 1931 on the grid."""
    path = os.path.join(SPECTRA, "cie_observer_1931_2deg.csv")
    with open(path, encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.reader(stream) if not row[0].startswith("#")]
    table = {float(row[0]): list(map(float, row[1:4])) for row in rows[1:]}
    return [[table[nm][i] for nm in range(380, 785, 5)] for i in range(3)]


def xyz_of(palette, material, light):
    """XYZ of a material of a written palette under one of its lights, Y = 1 for white."""
    x, y, z = observer()
    reflectance = next(m["values"] for m in palette["materials"] if m["name"] == material)
    power = next(m["values"] for m in palette["lights"] if m["name"] == light)
    white = sum(e * v for e, v in zip(power, y))
    return [sum(e * r * v for e, r, v in zip(power, reflectance, curve)) / white for curve in (x, y, z)]


class Design(support.CliTest):
    def read(self, name):
        with open(self.path(name), encoding="utf-8") as stream:
            return json.load(stream)

    def setUp(self):
        super().setUp()
        self.write_json("goals.json", GOALS)
        self.write_json("impossible.json", IMPOSSIBLE)

    def test_the_report_is_true_of_the_palette(self):
        self.succeed("design", "goals.json", "-o", "p.json", "--report", "r.json")
        palette, report = self.read("p.json"), self.read("r.json")
        self.assertEqual(len(report["cells"]), 2)
        for cell in report["cells"]:
            for ours, theirs in zip(xyz_of(palette, cell["material"], cell["light"]), cell["achieved"]["xyz"]):
                self.assertAlmostEqual(ours, theirs, delta=1e-6)  # sRGB's matrix and its inverse have four digits
            self.assertLess(cell["ciede2000"], 0.1)
            self.assertLess(cell["ciede2000_basis"], 0.1)
        twins = [xyz_of(palette, name, "day") for name in ("skin", "twin")]
        for a, b in zip(*twins):
            self.assertAlmostEqual(a, b, delta=1e-4)
        self.assertGreaterEqual(report["cells"][1]["difference"], 15 - 0.1)
        self.assertEqual(report["infeasible"], [])
        self.assertEqual([m["honesty"] for m in report["materials"]], ["given", "physical"])
        self.assertGreater(report["seconds"], 0)

    def test_what_is_given_stays_as_it_is(self):
        self.succeed("design", "goals.json", "-o", "p.json")
        with open(os.path.join(SPECTRA, "reflectance_ces99.csv"), encoding="utf-8", newline="") as stream:
            rows = list(csv.reader(stream))
        column = rows[0].index("CES05")
        measured = [float(row[column]) for row in rows[1:]]
        self.assertEqual(self.read("p.json")["materials"][0]["values"][:81], measured[:81])

    def test_the_palette_is_one_that_renders(self):
        self.succeed("design", "goals.json", "-o", "p.json")
        info = self.json_of("info", "p.json")
        self.assertEqual(info["kind"], "palette")
        self.assertEqual(info["lights"], ["day", "lamp"])

    def test_threads_do_not_change_a_byte(self):
        texts = []
        for threads in ("1", "2", "3"):
            self.succeed("design", "goals.json", "-o", "p.json", "--threads", threads)
            texts.append(support.read_bytes(self.path("p.json")))
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(texts[0], texts[2])

    def test_what_cannot_be_is_said_in_words_and_as_json(self):
        words = self.succeed("design", "impossible.json", "-o", "p.json")
        self.assertIn("a under day: possible alone, but blocked by a under lamp", words)
        self.assertIn("0 of 2 goals met", words)
        report = self.json_of("design", "impossible.json", "-o", "p.json")
        self.assertEqual(len(report["infeasible"]), 2)
        self.assertEqual(report["infeasible"][0]["blocked_by"], [{"material": "a", "light": "lamp", "cell": 1}])
        self.assertTrue(report["infeasible"][0]["proven"])
        self.assertGreater(report["cells"][1]["ciede2000"], 5)

    def test_mistakes_are_refused_and_leave_nothing(self):
        self.refuse("design", "goals.json", status=2, texts=["-o PALETTE.json is needed"])
        self.refuse("design", "-o", "p.json", status=2, texts=["a goals document is needed"])
        self.refuse("design", "no-such.json", "-o", "p.json", texts=["no-such.json"])
        self.refuse("design", "goals.json", "-o", "no-such/p.json", texts=["no-such/p.json", "cannot be written"])
        self.refuse("design", "goals.json", "-o", "p.json", "--plot", "no-such/p.svg", texts=["no-such/p.svg"])
        bad = json.loads(json.dumps(GOALS))
        bad["goals"][0]["light"] = "dai"
        self.write_json("bad.json", bad)
        self.refuse("design", "bad.json", "-o", "p.json", texts=["bad.json", "goals[0].light", "dai"])


if __name__ == "__main__":
    support.main()
