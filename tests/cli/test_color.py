# SPDX-License-Identifier: BSD-3-Clause
"""metamer color against tables made by another program (tests/data/expected/README.md), against sums made here from the
same tables of spectra, and what it refuses."""
import csv
import math
import os

import support

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
SPECTRA = os.path.join(ROOT, "data/spectra")
OHTA = os.path.join(SPECTRA, "reflectance_colorchecker_ohta.csv")
BABELCOLOR = os.path.join(SPECTRA, "reflectance_colorchecker_babelcolor.csv")
NIKON = os.path.join(SPECTRA, "camera_nikon_d5100.csv")
GRID = range(380, 785, 5)
RGB_FROM_XYZ = ((3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570))
XYZ_KEYS = {"name", "xyz", "xy", "lab", "srgb_linear", "srgb", "srgb_picture"}


def read_rows(path):
    """{first cell: {column: number}} of a table of numbers with names."""
    with open(path, encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.reader(stream) if not row[0].startswith("#")]
    return {row[0]: dict(zip(rows[0][1:], map(float, row[1:]))) for row in rows[1:]}


def expected(name):
    return read_rows(os.path.join(ROOT, "tests/data/expected", name + ".csv"))


def read_spectra(path):
    """{column: {wavelength: value}} of a table that has every wavelength of the grid."""
    rows = {float(nm): values for nm, values in read_rows(path).items()}
    return {name: {nm: rows[nm][name] for nm in GRID} for name in next(iter(rows.values()))}


def column_names(path):
    """In the order of the file."""
    with open(path, encoding="utf-8", newline="") as stream:
        return next(row for row in csv.reader(stream) if not row[0].startswith("#"))[1:]


def observer(name):
    table = read_spectra(os.path.join(SPECTRA, f"cie_observer_{name}.csv"))
    return [table[key] for key in ("x_bar", "y_bar", "z_bar")]


def illuminant(name):
    return read_spectra(os.path.join(SPECTRA, "cie_illuminants_standard.csv"))[name]


def product(*spectra):
    return {nm: math.prod(spectrum[nm] for spectrum in spectra) for nm in GRID}


def total(*spectra):
    return sum(product(*spectra).values())


def encode(linear):
    linear = min(max(linear, 0), 1)
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def distances(a, b):
    """Of the colors of two answers, in CIELAB (CIE 1976)."""
    return [math.dist(one["lab"], other["lab"]) for one, other in zip(a["colors"], b["colors"])]


def mean(values):
    return sum(values) / len(values)


class ColorTest(support.CliTest):
    def assert_numbers(self, found, wanted, tolerance, what=None):
        self.assertEqual(len(found), len(wanted), what)
        for one, other in zip(found, wanted):
            self.assertAlmostEqual(one, other, delta=tolerance, msg=what)

    def assert_same_colors(self, found, wanted, tolerance):
        self.assertEqual([c["name"] for c in found["colors"]], [c["name"] for c in wanted["colors"]])
        for one, other in zip(found["colors"], wanted["colors"]):
            for key in XYZ_KEYS - {"name"}:
                self.assert_numbers(one[key], other[key], tolerance, f"{one['name']} {key}")

    def write_flat(self, **values):
        """small.csv: a constant reflectance per name."""
        lines = [",".join(["wavelength_nm", *values])]
        lines += [",".join([str(nm), *map(str, values.values())]) for nm in (380, 780)]
        return self.write_text("small.csv", "\n".join(lines) + "\n")


class Truth(ColorTest):
    def check(self, table, light, rows):
        found = self.json_of("color", table, "--illuminant", light)
        self.assertEqual([c["name"] for c in found["colors"]], column_names(table))
        self.assertEqual(len(found["colors"]), 24)
        for color in found["colors"]:
            row = rows[color["name"]]
            for key, columns in (("xyz", "X Y Z"), ("xy", "x y"), ("lab", "L a b"),
                                 ("srgb_linear", "linB_R linB_G linB_B"), ("srgb", "encB_R encB_G encB_B"),
                                 ("srgb_picture", "enc_R enc_G enc_B")):
                self.assert_numbers(color[key], [row[c] for c in columns.split()], 1e-6, f"{color['name']} {key}")

    def test_the_colorchecker_under_three_lights(self):
        for light in ("D65", "A", "FL11"):
            self.check(OHTA, light, expected(f"colorchecker_ohta_{light}_2deg"))

    def test_a_coarse_table_is_interpolated(self):
        self.check(BABELCOLOR, "D65", expected("colorchecker_babelcolor_D65_2deg"))

    def test_white_and_black(self):
        table = self.write_flat(white=1, black=0)
        for light, row in expected("illuminants_white_cct").items():
            for name, columns in (("cie1931", "X2 Y2 Z2"), ("cie1964", "X10 Y10 Z10")):
                white, black = self.json_of("color", table, "--illuminant", light, "--observer", name)["colors"]
                self.assert_numbers(white["xyz"], [row[c] for c in columns.split()], 1e-6, light)
                self.assert_numbers(white["lab"], (100, 0, 0), 1e-9, light)
                self.assert_numbers(white["srgb"], (1, 1, 1), 2e-4, light)
                self.assertEqual((black["xyz"], black["xy"], black["srgb"]), ([0, 0, 0], None, [0, 0, 0]))
                self.assert_numbers(black["lab"], (0, 0, 0), 1e-9, light)

    def test_without_options_the_light_is_d65_and_the_observer_cie1931(self):
        found = self.json_of("color", OHTA)
        self.assertEqual(found, self.json_of("color", OHTA, "--illuminant", "D65", "--observer", "cie1931"))
        self.assertEqual(set(found), {"illuminant", "observer", "light", "colors"})
        self.assertEqual((found["illuminant"], found["observer"]), ("D65", "cie1931"))
        self.assertEqual(set(found["colors"][0]), XYZ_KEYS)

    def test_a_camera(self):
        for light in ("D65", "A"):
            rows = expected(f"camera_nikon_d5100_{light}")
            found = self.json_of("color", OHTA, "--illuminant", light, "--observer", NIKON)
            for color in found["colors"]:
                self.assertEqual(set(color), {"name", "camera"})
                self.assert_numbers(color["camera"], rows[color["name"]].values(), 1e-7, color["name"])
            exact = self.json_of("color", OHTA, "--illuminant", light, "--observer", NIKON, "--basis", "wavelengths")
            self.assert_numbers(exact["colors"][0]["camera"], found["colors"][0]["camera"], 1e-12)

    def test_an_observer_from_a_file(self):
        path = os.path.join(SPECTRA, "cie_observer_1964_10deg.csv")
        found = self.json_of("color", OHTA, "--observer", path)
        self.assertEqual(found["observer"], path)
        self.assert_same_colors(found, self.json_of("color", OHTA, "--observer", "cie1964"), 0)

    def test_the_picture_is_the_one_a_palette_gives(self):
        self.write_json("palette.json", {
            "materials": [{"name": name, "spectrum": f"{OHTA}:{name}"} for name in ("red", "cyan")],
            "lights": [{"name": "lamp", "illuminant": "A"}, {"name": "dim", "illuminant": "A", "through": ["cyan"]}]})
        materials = {m["name"]: m["srgb_picture"] for m in self.json_of("info", "palette.json")["materials"]}
        for light, options in (("lamp", ()), ("dim", ("--through", "cyan"))):
            found = self.json_of("color", OHTA, "--illuminant", "A", *options)["colors"]
            for color in found:
                if color["name"] in materials:
                    self.assert_numbers(color["srgb_picture"], materials[color["name"]][light], 1e-12)

    def test_the_picture_of_another_observer_is_exposed_for_luminance(self):
        light, reflectance = illuminant("A"), read_spectra(OHTA)["orange"]
        eye, standard = observer("1964_10deg"), observer("1931_2deg")
        exposure = sum(standard[1].values()) / sum(eye[1].values()) / total(light, standard[1])
        xyz = [exposure * total(light, reflectance, curve) for curve in eye]
        wanted = [encode(sum(m * v for m, v in zip(row, xyz))) for row in RGB_FROM_XYZ]
        found = self.json_of("color", OHTA, "--illuminant", "A", "--observer", "cie1964")["colors"]
        color = next(c for c in found if c["name"] == "orange")
        self.assert_numbers(color["srgb_picture"], wanted, 1e-9)


class Light(ColorTest):
    def test_color_temperature_and_rendering(self):
        table = self.write_flat(gray=0.5)
        rows = expected("illuminants_cri")
        self.assertGreater(len(rows), 10)
        for name, row in rows.items():
            light = self.json_of("color", table, "--illuminant", name)["light"]
            self.assertAlmostEqual(light["cct"], row["CCT_K"], delta=2, msg=name)
            self.assertAlmostEqual(light["duv"], row["Duv"], delta=1e-5, msg=name)
            self.assertAlmostEqual(light["ra"], row["Ra"], delta=0.3, msg=name)
            self.assert_numbers(light["r"], [row[f"R{i}"] for i in range(1, 15)], 0.3, name)

    def test_it_is_described_for_cie1931_whoever_looks(self):
        table = self.write_flat(gray=0.5)
        row = expected("illuminants_white_cct")["A"]
        wanted = self.json_of("color", table, "--illuminant", "A")["light"]
        self.assert_numbers(wanted["xy"], (row["x2"], row["y2"]), 1e-7)
        for eye in ("cie1964", NIKON):
            found = self.json_of("color", table, "--illuminant", "A", "--observer", eye)["light"]
            self.assert_numbers([*found["xy"], found["cct"], *found["r"]],
                                [*wanted["xy"], wanted["cct"], *wanted["r"]], 1e-6, eye)

    def test_a_fine_table_is_averaged_over_5_nm(self):
        """A line at 452 nm, 451 … 453 nm wide: 7/8 of it lie within 2.5 nm of 450 nm, 1/8 within 2.5 nm of 455 nm."""
        rows = [f"{nm},{int(nm == 452)}" for nm in range(380, 781)]
        self.write_text("lamp.csv", "wavelength_nm,line\n" + "\n".join(rows) + "\n")
        found = self.json_of("color", self.write_flat(white=1), "--illuminant", "lamp.csv:line")
        sums = [7 / 8 * curve[450] + 1 / 8 * curve[455] for curve in observer("1931_2deg")]
        self.assert_numbers(found["colors"][0]["xyz"], [100 * s / sums[1] for s in sums], 1e-9)
        self.assert_numbers(found["light"]["xy"], [s / sum(sums) for s in sums[:2]], 1e-12)

    def test_a_light_without_a_color_temperature(self):
        self.write_text("lamp.csv", "wavelength_nm,blue\n440,0\n450,1\n460,0\n")
        light = self.json_of("color", self.write_flat(white=1), "--illuminant", "lamp.csv:blue")["light"]
        self.assertEqual([light[key] for key in ("cct", "duv", "ra", "r")], [None] * 4)
        self.assertEqual(len(light["xy"]), 2)

    def test_a_light_too_blue_for_a_reference_has_no_rendering(self):
        light = self.json_of("color", OHTA, "--illuminant", "D75", "--through", "blue_sky")["light"]
        self.assertGreater(light["cct"], 25000)
        self.assertEqual((light["ra"], light["r"]), (None, None))


class Basis(ColorTest):
    def test_wavelengths_are_exact(self):
        for options in ((), ("--illuminant", "FL11"), ("--illuminant", "A", "--through", "cyan,orange"),
                        ("--observer", "cie1964", "--through", "yellow")):
            exact = self.json_of("color", OHTA, *options)
            found = self.json_of("color", OHTA, *options, "--basis", "wavelengths")
            self.assertNotIn("basis", exact)
            self.assertEqual(found["basis"], "wavelengths")
            self.assertEqual(found["light"], exact["light"])
            self.assert_same_colors(found, exact, 1e-9)

    def test_factors_come_near_and_sharpened_less(self):
        for light, factors_limit, sharpened_limit in (("D65", 0.3, 0.8), ("FL11", 0.4, 7)):
            exact = self.json_of("color", OHTA, "--illuminant", light)
            factors = self.json_of("color", OHTA, "--illuminant", light, "--basis", "factors")
            sharpened = self.json_of("color", OHTA, "--illuminant", light, "--basis", "sharpened:7")
            self.assertEqual((factors["basis"], sharpened["basis"]), ("factors:7", "sharpened:7"))
            near, far = mean(distances(factors, exact)), mean(distances(sharpened, exact))
            self.assertLess(near, factors_limit, light)
            self.assertLess(far, sharpened_limit, light)
            self.assertGreater(far, 1.5 * near, light)
            self.assertGreater(near, 0, light)

    def test_products_of_coefficients_come_near_products_of_spectra(self):
        for filters, limit in (("orange", 1), ("yellow,cyan", 1.5), ("orange,orange", 6)):
            options = ("--illuminant", "A", "--through", filters)
            exact = self.json_of("color", OHTA, *options)
            near = mean(distances(self.json_of("color", OHTA, *options, "--basis", "factors:7"), exact))
            far = mean(distances(self.json_of("color", OHTA, *options, "--basis", "factors:3"), exact))
            self.assertLess(near, limit, filters)
            self.assertGreater(far, 5 * near, filters)

    def test_the_colors_of_products_are_those_of_the_tables(self):
        """XYZ = k Σ S · cmf · Σ columns · (coefficients of sample × those of the filters), k from the true spectra."""
        curves = read_spectra(os.path.join(ROOT, "data/bases/factors_7.csv"))
        spectra, light, eye = read_spectra(OHTA), illuminant("A"), observer("1931_2deg")

        def coefficients(name):
            return [total(curves[f"encode_{i}"], spectra[name]) for i in range(1, 8)]
        white = [total(light, spectra["orange"], spectra["cyan"], curve) for curve in eye]
        found = self.json_of("color", OHTA, "--illuminant", "A", "--through", "orange,cyan", "--basis", "factors:7")
        for color in found["colors"]:
            factors = [math.prod(c) for c in zip(*map(coefficients, (color["name"], "orange", "cyan")))]
            seen = {nm: sum(f * curves[f"spectrum_{i}"][nm] for i, f in enumerate(factors, 1)) for nm in GRID}
            xyz = [100 / white[1] * total(light, seen, curve) for curve in eye]
            self.assert_numbers(color["xyz"], xyz, 1e-9, color["name"])
            lightness = 116 * (xyz[1] / 100) ** (1 / 3) - 16
            if xyz[1] > 1:
                self.assertAlmostEqual(color["lab"][0], lightness, delta=1e-9)


class Through(ColorTest):
    def test_the_light_passes_every_filter(self):
        spectra, eye = read_spectra(OHTA), observer("1931_2deg")
        light = product(illuminant("D65"), spectra["cyan"], spectra["yellow"])
        found = self.json_of("color", OHTA, "--through", "cyan,yellow")
        self.assertEqual(found["through"], ["cyan", "yellow"])
        white = [total(light, curve) for curve in eye]
        self.assert_numbers(found["light"]["xy"], [w / sum(white) for w in white[:2]], 1e-12)
        for color in found["colors"]:
            xyz = [100 / white[1] * total(light, spectra[color["name"]], curve) for curve in eye]
            self.assert_numbers(color["xyz"], xyz, 1e-9, color["name"])

    def test_white_is_white_behind_the_filters(self):
        table = self.write_text("filters.csv", "wavelength_nm,white,red\n380,1,0.1\n580,1,0.1\n620,1,0.9\n")
        white, red = self.json_of("color", table, "--through", "red")["colors"]
        self.assert_numbers(white["lab"], (100, 0, 0), 1e-9)
        self.assert_numbers(white["srgb_linear"], (1, 1, 1), 2e-4)
        self.assertEqual(white["srgb_picture"][0], 1)
        self.assertLess(white["srgb_picture"][2], 0.7)
        self.assertLess(red["xyz"][1], 99)

    def test_every_way_to_name_filters(self):
        self.write_text("more.csv", "wavelength_nm,\"a,b\",c\n380,0.2,0.9\n780,0.9,0.3\n")
        table = self.write_text("t.csv", "wavelength_nm,a,b,\"a,b\",\"x:y\"\n380,0.1,0.5,0.3,0.2\n780,0.8,0.4,0.9,0.7\n")
        for words, filters in ((["--through", "a,b"], ["a,b"]), (["--through", "b,a"], ["b", "a"]),
                               (["--through", "a", "--through", "b"], ["a", "b"]), (["--through", "x:y"], ["x:y"]),
                               (["--through", "a,x:y,b"], ["a", "x:y", "b"]),
                               (["--through", "more.csv:a,b"], ["more.csv:a,b"]),
                               (["--through", "a,more.csv:c,b"], ["a", "more.csv:c", "b"]),
                               (["--through=more.csv:c", "--through", "a,b", "--through", "a,a"],
                                ["more.csv:c", "a,b", "a", "a"])):
            self.assertEqual(self.json_of("color", table, *words)["through"], filters)
        self.assertEqual(self.json_of("color", table, "--through", "a,a")["colors"],
                         self.json_of("color", table, "--through", "a", "--through", "a")["colors"])
        for one, other in (("a,b", "b,a"), ("more.csv:c", "more.csv:a,b")):
            self.assertNotEqual(self.json_of("color", table, "--through", one)["colors"],
                                self.json_of("color", table, "--through", other)["colors"])


class Output(ColorTest):
    def test_for_people(self):
        table = self.write_text("t.csv", "wavelength_nm,grün,dark violet\n380,0.1,0.6\n560,0.8,0.05\n780,0.1,0.7\n")
        text = self.succeed("color", table, "--through", "grün", "--basis", "factors:5")
        header, rows = text.split("\n\n")
        self.assertRegex(header, r"^illuminant  D65 through grün\nlight       x 0\.3\d{3}, y 0\.4\d{3}, \d{4} K, "
                                 r"Duv \+0\.\d{4}, Ra \d\d\.\d\nobserver    cie1931\nbasis       factors:5$")
        head, green, violet = rows.splitlines()
        self.assertEqual(head.split(), ["name", "X", "Y", "Z", "L*", "a*", "b*", "sRGB"])
        self.assertEqual({len(green), len(violet)}, {len(head) + len("#123456") - len("sRGB")})
        for row, color in zip((green, violet), self.json_of("color", table, "--through", "grün", "--basis",
                                                            "factors:5")["colors"]):
            self.assertTrue(row.startswith(color["name"] + " "))
            cells = row[len(color["name"]):].split()
            self.assert_numbers([float(c) for c in cells[:6]], color["xyz"] + color["lab"], 5.01e-4)
            self.assertEqual(cells[6], "#" + "".join(f"{round(255 * v):02x}" for v in color["srgb"]))

    def test_a_camera_for_people(self):
        rows = self.succeed("color", OHTA, "--observer", NIKON).split("\n\n")[1].splitlines()
        self.assertEqual((rows[0].split(), len(rows)), (["name", "R", "G", "B"], 25))
        self.assertEqual(rows[1].split(), ["dark_skin", "0.07823", "0.07770", "0.04922"])

    def test_no_locale_changes_it(self):
        locales = [{"LC_ALL": "C"}, {"LC_ALL": "C.UTF-8"}, {"LC_ALL": "", "LC_NUMERIC": "comma", "LOCPATH": self.folder}]
        if not self.make_comma_locale():
            self.skipTest("localedef makes no locale with decimal commas")
        for options in ((), ("--json",)):
            self.assertEqual(len({self.succeed("color", OHTA, *options, env=locale) for locale in locales}), 1)

    def test_as_many_columns_as_a_table_may_have(self):
        names = [f"a column with a long name {i}" for i in range(4096)]
        lines = [",".join(["wavelength_nm", *names])]
        lines += [",".join([nm, *(str(i / 4095) for i in range(4096))]) for nm in ("380", "780")]
        self.write_text("many.csv", "\n".join(lines) + "\n")
        colors = self.json_of("color", "many.csv", "--basis", "sharpened:5")["colors"]
        self.assertEqual([c["name"] for c in colors], names)
        self.assertAlmostEqual(colors[4095]["xyz"][1], 4095 * colors[1]["xyz"][1], delta=1e-9)

    def test_names_that_are_not_utf_8(self):
        with open(self.path("latin.csv"), "wb") as stream:
            stream.write(b"wavelength_nm,gr\xfcn\n380,1\n780,1\n")
        self.assertEqual(self.json_of("color", "latin.csv")["colors"][0]["name"], "gr?n")
        self.assertIn("gr?n", self.succeed("color", "latin.csv"))


class Refusals(ColorTest):
    def test_bad_usage(self):
        self.refuse("color", texts=["spectra"], status=2)
        self.refuse("color", "--json", texts=["spectra"], status=2)
        self.refuse("color", "a.csv", "b.csv", texts=["a.csv", "b.csv"], status=2)
        self.refuse("color", "a.csv", "--illuminant", texts=["--illuminant", "NAME"], status=2)
        self.refuse("color", "a.csv", "--lamp", "D65", texts=["--lamp"], status=2)
        self.refuse("color", "a.csv", *["--through=a"] * 65, texts=["64", "--through"], status=2)

    def test_files_that_do_not_serve(self):
        self.refuse("color", "missing.csv", texts=["missing.csv"])
        self.refuse("color", "blob.nrrd", texts=["blob.nrrd"])
        self.write_text("bad.csv", "wavelength_nm,a\n380,x\n")
        self.refuse("color", "bad.csv", texts=["bad.csv:2", "'x'"])
        self.refuse("color", OHTA, "--observer", "missing.csv", texts=["--observer", "missing.csv"])
        self.refuse("color", OHTA, "--observer", OHTA, texts=["reflectance_colorchecker_ohta.csv"])
        self.refuse("color", OHTA, "--illuminant", "missing.csv:a", texts=["--illuminant", "missing.csv"])

    def test_names_that_are_not_known(self):
        self.refuse("color", OHTA, "--illuminant", "D66", texts=["--illuminant", "D66", "D65"])
        self.refuse("color", OHTA, "--observer", "cie1932", texts=["--observer", "cie1932", "cie1931"])
        self.refuse("color", OHTA, "--basis", "factor", texts=["--basis", "factor", "factors"])
        self.refuse("color", OHTA, "--basis", "factors:20", texts=["--basis", "factors:20", "3 … 9"])
        for value, name in (("cyam", "cyam"), ("yellow,cyam", "cyam"), ("cyam,yellow", "cyam"), ("cyan,", "''")):
            self.refuse("color", OHTA, "--through", value, texts=["unknown column", name])
        self.refuse("color", OHTA, "--through", "cyam", texts=["'cyan'"])
        self.refuse("color", OHTA, "--through", f"{NIKON}:X", texts=["camera_nikon_d5100.csv", "unknown column 'X'"])

    def test_a_file_without_a_column_is_asked_for_one(self):
        self.refuse("color", OHTA, "--illuminant", OHTA, texts=["--illuminant", "FILE.csv:COLUMN"])

    def test_control_characters_stay_out_of_messages(self):
        message = self.refuse("color", OHTA, "--illuminant", "D65\033[31m\n")
        self.assertTrue(message.isprintable(), message)

    def test_bases_that_cannot_encode_a_spectrum(self):
        self.refuse("color", OHTA, "--basis", "rgb", texts=["--basis", "rgb", "no products"])
        self.refuse("color", OHTA, "--basis", "materials", texts=["--basis", "materials", "no products"])
        self.refuse("color", OHTA, "--basis", "auto", "--through", "cyan", texts=["--basis: auto: ", "no products"])

    def test_lights_that_show_nothing(self):
        self.write_text("lamp.csv", "wavelength_nm,off,odd\n380,0,-1\n780,0,-1\n")
        for name in ("off", "odd"):
            self.refuse("color", OHTA, "--illuminant", f"lamp.csv:{name}", texts=[f"lamp.csv:{name}", "luminance"])
        table = self.write_flat(white=1, black=0)
        for basis in ((), ("--basis", "factors:7")):
            self.refuse("color", table, "--through", "black", *basis, texts=["--through", "luminance is 0"])

    def test_numbers_beyond_any_reflectance(self):
        table = self.write_flat(good=1, bad="1e200")
        for options in ((), ("--json",), ("--observer", NIKON), ("--basis", "wavelengths")):
            self.refuse("color", table, *options, texts=["small.csv", "'bad'"])


if __name__ == "__main__":
    support.main()
