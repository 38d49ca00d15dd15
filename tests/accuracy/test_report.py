#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""test_report.py REPORT SOURCE OUT: the numbers of docs/accuracy.md keep their bounds and their order, and one of them
is computed again from the tables alone, with color formulas of its own. Leaves its report in OUT for check_same.py."""
import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import unittest

OUT = pathlib.Path(sys.argv.pop()).resolve()
SOURCE = pathlib.Path(sys.argv.pop()).resolve()
REPORT = sys.argv.pop()
GRID = range(380, 785, 5)


# The color of a light on a reflectance and CIEDE2000, from their publications.

def read_table(path):
    """Columns by name; rows beyond the grid are left out, finer lights averaged over 5 nm."""
    with open(path, encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    waves = [float(row[0]) for row in rows[1:]]
    columns = {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0]) if i > 0}
    if waves[1] - waves[0] < 5:
        return {name: [mean_within(waves, values, nm) for nm in GRID] for name, values in columns.items()}
    return {name: [values[waves.index(nm)] for nm in GRID] for name, values in columns.items()}


def mean_within(waves, values, nm):
    """Of the curve through the samples over 5 nm; its ends are held."""
    def at(x):
        if x <= waves[0]:
            return values[0]
        if x >= waves[-1]:
            return values[-1]
        i = max(k for k, wave in enumerate(waves) if wave <= x)
        return values[i] + (values[i + 1] - values[i]) * (x - waves[i]) / (waves[i + 1] - waves[i])
    low, high = nm - 2.5, nm + 2.5
    places = [low] + [wave for wave in waves if low < wave < high] + [high]
    return sum((b - a) * (at(a) + at(b)) / 2 for a, b in zip(places, places[1:])) / 5


def blackbody(kelvin):
    def planck(meters):
        return meters ** -5 / math.expm1(1.4388e-2 / (meters * kelvin))
    return [planck(nm * 1e-9) / planck(560e-9) for nm in GRID]


def xyz_of(observer, *spectra):
    stimulus = [math.prod(samples) for samples in zip(*spectra)]
    return [sum(s * c for s, c in zip(stimulus, curve)) for curve in observer]


def lab_of(xyz, white):
    def f(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29
    x, y, z = (f(max(part, 0) / whole) for part, whole in zip(xyz, white))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def ciede2000(one, two):
    """Sharma, Wu, Dalal, Color Res. Appl. 30(1), 2005, step by step."""
    mean_chroma = (math.hypot(*one[1:]) + math.hypot(*two[1:])) / 2
    g = 0.5 * (1 - math.sqrt(mean_chroma ** 7 / (mean_chroma ** 7 + 25 ** 7)))
    a1, a2 = (1 + g) * one[1], (1 + g) * two[1]
    c1, c2 = math.hypot(a1, one[2]), math.hypot(a2, two[2])
    h1, h2 = (math.degrees(math.atan2(b, a)) % 360 for a, b in ((a1, one[2]), (a2, two[2])))
    turn = h2 - h1
    hue_sum = h1 + h2
    if c1 * c2 == 0:
        turn, mean_hue = 0, hue_sum
    elif abs(turn) <= 180:
        mean_hue = hue_sum / 2
    else:
        turn += 360 if turn < 0 else -360
        mean_hue = (hue_sum + (360 if hue_sum < 360 else -360)) / 2
    dl, dc = two[0] - one[0], c2 - c1
    dh = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(turn / 2))
    l, c = (one[0] + two[0]) / 2, (c1 + c2) / 2
    t = (1 - 0.17 * math.cos(math.radians(mean_hue - 30)) + 0.24 * math.cos(math.radians(2 * mean_hue))
         + 0.32 * math.cos(math.radians(3 * mean_hue + 6)) - 0.2 * math.cos(math.radians(4 * mean_hue - 63)))
    sl = 1 + 0.015 * (l - 50) ** 2 / math.sqrt(20 + (l - 50) ** 2)
    sc, sh = 1 + 0.045 * c, 1 + 0.015 * c * t
    rotation = (-2 * math.sqrt(c ** 7 / (c ** 7 + 25 ** 7))
                * math.sin(math.radians(60 * math.exp(-((mean_hue - 275) / 25) ** 2))))
    return math.sqrt((dl / sl) ** 2 + (dc / sc) ** 2 + (dh / sh) ** 2 + rotation * dc / sc * dh / sh)


def held_out():
    """The lights and reflectances of accuracy/split.csv that come along and that no basis was fitted to."""
    spectra = SOURCE / "data/spectra"
    illuminants = {}
    for name in ("standard", "fl1-12", "fl3", "led"):
        illuminants.update(read_table(spectra / f"cie_illuminants_{name}.csv"))
    lights, reflectances, tables = [], [], {}
    with open(SOURCE / "accuracy/split.csv", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            table, name, part = row["table"], row["name"], row["part"]
            if part == "train" or not (table in ("illuminant", "blackbody") or (spectra / f"{table}.csv").exists()):
                continue
            if table == "illuminant":
                lights.append(illuminants[name])
            elif table == "blackbody":
                lights.append(blackbody(float(name)))
            else:
                tables.setdefault(table, read_table(spectra / f"{table}.csv"))
                (reflectances if part == "test" else lights).append(tables[table][name])
    return lights, reflectances


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        OUT.mkdir(parents=True, exist_ok=True)
        subprocess.run([REPORT, "--quick", "--threads", "3", "--json", OUT / "accuracy.json", SOURCE, OUT], check=True)
        with open(OUT / "accuracy.json", encoding="utf-8") as stream:
            cls.numbers = json.load(stream)
        cls.document = (OUT / "accuracy.md").read_text(encoding="utf-8")

    def products(self, model, set_="held_out"):
        return self.numbers[set_][model]

    def test_factors_keep_their_bounds(self):
        factors = self.products("factors:7")
        self.assertLessEqual(factors["one"]["mean"], 0.25)
        self.assertLessEqual(factors["one"]["p95"], 0.75)
        self.assertLessEqual(factors["three_matched"]["mean"], 0.5)
        self.assertLessEqual(self.products("factors:7", "houser")["one"]["mean"], 0.35)

    def test_the_other_models_are_what_they_are_said_to_be(self):
        self.assertLessEqual(self.products("sharpened:7")["one"]["mean"], 1.7)
        self.assertGreaterEqual(self.products("unsharpened:7")["one"]["mean"], 20)
        self.assertLess(self.products("wavelengths:31")["one"]["mean"], 0.1)
        self.assertLess(self.products("wavelengths")["three_matched"]["max"], 1e-4)

    def test_factors_are_better_than_sharpened_than_rgb(self):
        for kind in ("one", "two", "three", "three_matched", "one_filter", "two_filters"):
            rgb, sharpened, factors = (self.products(model)[kind]["mean"]
                                       for model in ("RGB", "sharpened:7", "factors:7"))
            self.assertTrue(rgb > sharpened > factors, kind)

    def test_more_factors_are_better(self):
        means = [self.products(f"factors:{d}")["one"]["mean"] for d in range(3, 10)]
        self.assertEqual(means, sorted(means, reverse=True))

    def test_an_exact_light_helps_both_bases(self):
        for kind, other in (("sharpened:7", "sharpened:7, light exact"), ("factors:7, light encoded", "factors:7")):
            self.assertGreater(self.products(kind)["one"]["mean"], 2 * self.products(other)["one"]["mean"])

    def test_points_fail_under_lines_only(self):
        smooth, _, fluorescent = self.products("points every 10 nm")["by_class"]
        self.assertLess(smooth, 0.1)
        self.assertGreater(fluorescent, 2)

    def test_metamers_stay_and_part(self):
        metamers = self.numbers["metamers"]
        self.assertAlmostEqual(metamers["RGB"]["spurious"]["max"], 0, places=6)
        self.assertAlmostEqual(metamers["RGB"]["split_error"]["mean"], metamers["RGB"]["true_split"]["mean"], places=6)
        self.assertLess(metamers["factors:7"]["spurious"]["mean"], 0.2)
        self.assertLess(metamers["factors:7"]["split_error"]["mean"], 0.2)

    def test_the_true_splits_are_the_published_ones(self):
        with open(SOURCE / "tests/data/expected/metamers_constructed_D65.csv", encoding="utf-8") as stream:
            splits = [float(value) for row in csv.DictReader(stream) for name, value in row.items()
                      if name.startswith("dE2000_") and name != "dE2000_D65"]
        truth = self.numbers["metamers"]["wavelengths"]["true_split"]
        self.assertAlmostEqual(truth["mean"], sum(splits) / len(splits), places=5)
        self.assertAlmostEqual(truth["max"], max(splits), places=5)

    def test_pictures_of_measured_palettes_are_right(self):
        engine = self.numbers["engine"]
        self.assertLessEqual(engine["factors:7"]["measured"]["mean"], 0.5)
        # The engine's lights are narrow. `sharpened` encodes them, and comes out no better than RGB.
        for other in ("rgb", "sharpened:7"):
            self.assertGreater(engine[other]["measured"]["mean"], 2 * engine["factors:7"]["measured"]["mean"])
        self.assertLess(engine["materials"]["measured"]["max"], 0.01)
        self.assertLess(engine["materials"]["own"]["max"], 0.01)

    def test_a_number_computed_again_from_the_tables(self):
        curves = read_table(SOURCE / "data/bases/factors_7.csv")
        eye = read_table(SOURCE / "data/spectra/cie_observer_1931_2deg.csv")
        observer = list(eye.values())
        encoder = [curves[f"encode_{i}"] for i in range(1, 8)]
        columns = [curves[f"spectrum_{i}"] for i in range(1, 8)]
        lights, reflectances = held_out()
        self.assertEqual(len(lights) * len(reflectances), self.numbers["pair_count"])
        codes = [[math.fsum(w * s for w, s in zip(curve, spectrum)) for curve in encoder] for spectrum in reflectances]
        errors = []
        for light in lights:
            white = xyz_of(observer, light)
            matrix = [xyz_of(observer, light, column) for column in columns]
            for spectrum, code in zip(reflectances, codes):
                shown = [sum(c * color[k] for c, color in zip(code, matrix)) for k in range(3)]
                errors.append(ciede2000(lab_of(shown, white), lab_of(xyz_of(observer, light, spectrum), white)))
        pairs = self.products("factors:7", "pairs")["one"]
        self.assertAlmostEqual(sum(errors) / len(errors), pairs["mean"], places=6)
        self.assertAlmostEqual(max(errors), pairs["max"], places=5)

    def test_the_color_difference_of_this_file_is_the_published_one(self):
        with open(SOURCE / "tests/data/expected/ciede2000_sharma34.csv", encoding="utf-8") as stream:
            for row in csv.reader(stream):
                try:
                    values = [float(cell) for cell in row]
                except ValueError:
                    continue
                self.assertAlmostEqual(ciede2000(values[-7:-4], values[-4:-1]), values[-1], places=4)

    def test_the_document_is_whole(self):
        self.assertIn("`factors:7` has the mean %.3f" % self.products("factors:7", "pairs")["one"]["mean"], self.document)
        row = re.search(r"^\| RGB \| 3 \| ([0-9.]+) / ", self.document, re.MULTILINE)
        self.assertEqual(row.group(1), "%.2f" % self.products("RGB")["one"]["mean"])
        for picture in re.findall(r"\]\((pictures/[^)]+)\)", self.document):
            self.assertIn("</svg>", (OUT / picture).read_text(encoding="utf-8"))
        self.assertNotRegex(self.document, r"\b-?(nan|inf)\b")
        self.assertNotRegex(self.document, r"[ \t]\n")
        for row in re.findall(r"(?:^\|.*\n)+", self.document, re.MULTILINE):
            self.assertEqual(len({line.count("|") for line in row.splitlines()}), 1, row)
        self.assertEqual([name for name in os.listdir(OUT) if name.endswith((".part", ".exr"))], [])


class Usage(unittest.TestCase):
    def test_what_cannot_be_done_is_said(self):
        for arguments in ([], [SOURCE], ["--threads", "0", SOURCE, OUT], ["--threads", "two", SOURCE, OUT],
                          ["--more"], ["--nothing", "x", SOURCE, OUT], [SOURCE, OUT, "more"]):
            done = subprocess.run([REPORT, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn("usage: report", done.stderr)

    def test_a_folder_without_the_spectra_is_named(self):
        done = subprocess.run([REPORT, OUT / "nothing", OUT], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing/accuracy/split.csv", done.stderr)


if __name__ == "__main__":
    unittest.main()
