# SPDX-License-Identifier: BSD-3-Clause
"""metamer relight: one spectral image, every light; compared with rendering again."""
import json
import pathlib
import shutil

import support

NEW_MATERIALS = [{"name": "core", "srgb": "#20c040"}, {"name": "haze", "srgb": "#d0d0d0"}]
DATA = pathlib.Path(__file__).resolve().parents[2] / "data/spectra"
CSV = "wavelength_nm,green,line\n380,0,0\n500,1,0\n560,1,1\n600,0,0\n780,0,0\n"


class Relight(support.CliTest):
    def setUp(self):
        super().setUp()
        self.scene = support.make_scene()
        self.render(self.scene, "image.exr")

    def render(self, scene, output, *options):
        name = self.write_json(output + ".json", scene)
        self.succeed("render", name, "-o", output, *options)

    def scene_with(self, **lights):
        scene = support.make_scene()
        scene["lights"].update(lights)
        return scene

    def test_by_default_it_is_the_rendered_picture(self):
        self.render(self.scene, "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png")
        self.assert_same_bytes("direct.png", "lit.png")

    def test_a_relit_picture_is_the_rendered_one(self):
        self.render(self.scene_with(weights={"tube": 0.5, "lamp": 0.25}), "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png", "--light", "tube=0.5", "--light", "lamp=0.25")
        self.assert_near("direct.png", "lit.png", 1e-5)

    def test_a_relit_picture_rendered_again_is_itself(self):
        self.succeed("relight", "image.exr", "-o", "lit.png", "--light", "tube=0.5", "--intensity", "1.7",
                     "--background", "#405060")
        self.succeed("render", "lit.png", "-o", "again.png")
        self.assert_same_bytes("lit.png", "again.png")

    def test_intensity_scales_the_light(self):
        self.render(self.scene_with(intensity=0.4), "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png", "--intensity", "0.4")
        self.assert_near("direct.png", "lit.png", 1e-5)

    def test_a_stop_is_a_mix_with_its_intensity(self):
        self.render(self.scene_with(weights={"lamp": 1}, intensity=0.8), "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png", "--stop", "evening")
        self.assert_near("direct.png", "lit.png", 1e-5)

    def test_an_illuminant_of_the_palette_is_that_light(self):
        self.succeed("relight", "image.exr", "-o", "a.png", "--light", "tube=1")
        self.succeed("relight", "image.exr", "-o", "b.png", "--illuminant", "FL11")
        self.assert_near("a.png", "b.png", 0)

    def test_an_illuminant_from_a_table(self):
        self.write_text("lamps:1.csv", CSV)
        scene = self.scene_with(weights={"green": 1})
        scene["palette"]["lights"].append({"name": "green", "spectrum": "lamps:1.csv:green"})
        self.render(scene, "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png", "--illuminant", "lamps:1.csv:green")
        self.assert_near("direct.png", "lit.png", 1e-5)
        self.succeed("render", "lit.png", "-o", "again.png")
        self.assert_same_bytes("lit.png", "again.png")

    def test_an_illuminant_with_a_name_too_long_for_a_palette(self):
        for name in ("n" * 80, "x" + "\u00e4" * 40, "xx" + "\u00e4" * 40, "x" * 60 + "\u20ac" * 5):
            self.write_text(name + ".csv", CSV)
            self.succeed("relight", "image.exr", "-o", "lit.png", "--illuminant", f"{name}.csv:green")
            self.succeed("render", "lit.png", "-o", "again.png")
            self.assert_same_bytes("lit.png", "again.png")

    def test_a_picture_with_a_new_palette_rendered_again_is_itself(self):
        self.write_json("new.json", {"materials": NEW_MATERIALS, "lights": [{"name": "sun", "daylight": 5000}]})
        self.succeed("relight", "image.exr", "-o", "lit.png", "--palette", "new.json", "--light", "sun=0.5")
        self.succeed("render", "lit.png", "-o", "again.png")
        self.assert_same_bytes("lit.png", "again.png")

    def check_observer(self, option, in_scene):
        scene = support.make_scene()
        scene["observer"] = in_scene
        self.render(scene, "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png", "--observer", option)
        self.assert_near("direct.png", "lit.png", 1e-5)
        self.succeed("relight", "image.exr", "-o", "usual.png")
        self.assertGreater(self.json_of("compare", "usual.png", "lit.png")["max_error"], 0.005)
        self.succeed("render", "lit.png", "-o", "again.png")
        self.assert_same_bytes("lit.png", "again.png")

    def test_another_observer_looks(self):
        for name in ("cie1964", "cie2015", "cie2015_10deg"):
            self.check_observer(name, name)
            self.assertEqual(json.loads(support.embedded_scene(self.path("lit.png")))["observer"], name)

    def test_a_camera_looks(self):
        shutil.copy(DATA / "camera_nikon_d5100.csv", self.path("my camera.csv"))
        self.check_observer("my camera.csv", {"file": "my camera.csv"})
        observer = json.loads(support.embedded_scene(self.path("lit.png")))["observer"]
        self.assertEqual((observer["name"], len(observer["r"])), ("my camera", 81))

    def test_an_eye_from_a_table_is_that_observer(self):
        shutil.copy(DATA / "cie_observer_1964_10deg.csv", self.path("eye.CSV"))
        self.succeed("relight", "image.exr", "-o", "a.png", "--observer", "eye.CSV")
        self.succeed("relight", "image.exr", "-o", "b.png", "--observer", "cie1964")
        self.assert_near("a.png", "b.png", 0)

    def test_files_that_are_no_observer_are_refused(self):
        self.write_text("two.csv", "wavelength_nm,x,y\n500,1,1\n")
        self.write_text("dark.csv", "wavelength_nm,R,G,B\n500,1,0,1\n")
        self.write_text("binary.csv", "\0\1\2")
        for name, texts in (("two.csv", ["two.csv", "x, y", "x_bar, y_bar, z_bar", "R, G, B"]),
                            ("dark.csv", ["dark.csv", "curve g", "sum 0"]), ("binary.csv", ["binary.csv"]),
                            ("missing.csv", ["missing.csv"]),
                            (str(DATA / "cie_test_color_samples.csv"), ["14 columns", "TCS01"])):
            self.refuse("relight", "image.exr", "-o", "no.png", "--observer", name, texts=["--observer", *texts])

    def test_an_embedded_observer_names_no_file(self):
        self.succeed("relight", "image.exr", "-o", "lit.png")
        scene = json.loads(support.embedded_scene(self.path("lit.png")))
        scene["observer"] = {"file": "eye.csv"}
        support.embed_scene(self.path("lit.png"), self.path("forged.png"), json.dumps(scene))
        self.refuse("render", "forged.png", "-o", "no.png", texts=["observer.file", "embedded"])

    def test_a_background_color(self):
        scene = support.make_scene()
        scene["background"] = {"srgb": "#a05010"}
        self.render(scene, "direct.png")
        for spelling in ("#a05010", "a05010"):
            self.succeed("relight", "image.exr", "-o", "lit.png", "--background", spelling)
            self.assert_same_bytes("direct.png", "lit.png")
        self.assertEqual(support.png_color_type(self.path("lit.png")), 2)

    def test_no_background_keeps_alpha(self):
        self.succeed("relight", "image.exr", "-o", "clear.png", "--background", "none")
        self.assertEqual(support.png_color_type(self.path("clear.png")), 6)
        self.succeed("render", "clear.png", "-o", "again.png")
        self.assert_same_bytes("clear.png", "again.png")

    def test_a_material_behind_is_lit(self):
        scene = support.make_scene()
        scene["background"] = {"material": "haze"}
        self.render(scene, "backed.exr")
        scene["lights"]["weights"] = {"tube": 1}
        self.render(scene, "direct.png")
        self.succeed("relight", "backed.exr", "-o", "lit.png", "--light", "tube=1")
        self.assert_near("direct.png", "lit.png", 1e-5)
        self.refuse("relight", "backed.exr", "-o", "no.png", "--background", "#ffffff", texts=["haze"])

    def check_palette(self, background, weights):
        scene = support.make_scene()
        scene["background"] = background
        scene["lights"]["weights"] = weights
        self.render(scene, "old.exr")
        self.write_json("new.json", {"materials": NEW_MATERIALS})
        self.succeed("relight", "old.exr", "-o", "lit.png", "--palette", "new.json")
        scene["palette"]["materials"] = [NEW_MATERIALS[1], support.MATERIALS[1], NEW_MATERIALS[0]]
        self.render(scene, "direct.png")
        self.assert_near("direct.png", "lit.png", 1e-5)
        self.assertGreater(self.json_of("compare", "old.exr", "lit.png")["max_error"], 0.05)

    def test_new_reflectances_are_as_if_rendered_with_them(self):
        self.check_palette({"srgb": "#203040"}, {"day": 1})
        self.check_palette({"material": "haze"}, {"day": 0.2, "lamp": 0.3, "tube": 0.5})
        self.check_palette(None, {"lamp": 0.3, "tube": 0.5})

    def test_new_lights_are_as_if_rendered_with_them(self):
        self.write_json("new.json", {"lights": [{"name": "lamp", "blackbody": 2000}, {"name": "sun", "daylight": 5000}]})
        scene = self.scene_with(weights={"lamp": 0.5, "sun": 0.5})
        scene["palette"]["lights"][1] = {"name": "lamp", "blackbody": 2000}
        scene["palette"]["lights"].append({"name": "sun", "daylight": 5000})
        self.render(scene, "direct.png")
        self.succeed("relight", "image.exr", "-o", "lit.png", "--palette", "new.json", "--light", "lamp=0.5",
                     "--light", "sun=0.5")
        self.assert_near("direct.png", "lit.png", 1e-5)

    def test_materials_are_as_exact_as_wavelengths(self):
        self.render(self.scene, "exact.exr", "--basis", "wavelengths")
        for blend in ("composite", "sum", "maximum"):
            scene = support.make_scene()
            scene["render"]["blend"] = blend
            self.render(scene, "few.exr", "--basis", "materials")
            self.render(scene, "many.exr", "--basis", "wavelengths")
            self.assert_near("few.exr", "many.exr", 1e-4)
        for light in ("day=1", "lamp=1", "tube=1"):
            self.succeed("relight", "image.exr", "-o", "few.png", "--light", light)
            self.succeed("relight", "exact.exr", "-o", "many.png", "--light", light)
            error = self.json_of("compare", "few.png", "many.png")["max_error"]
            self.assertLess(error, 1.01 / 255, light)  # one step of 8 bits where rounding meets a border

    def test_the_preview_of_an_image_is_its_picture(self):
        image = support.exr_file.Image(self.path("image.exr"))
        self.render(self.scene, "direct.png")
        self.assertEqual(sorted(image.channels), ["A", "B", "C.00", "C.01", "C.02", "C.03", "G", "R"])
        self.assertEqual(image.texts["metamer.basis"], "materials")
        self.assertTrue(max(image.channels["A"]) > 0.5)
        self.assert_near("image.exr", "direct.png", 1 / 255)

    def test_half_floats_are_near(self):
        self.render(self.scene, "half.exr", "--half")
        self.assert_near("image.exr", "half.exr", 2e-3)

    def test_wavelengths_cannot_take_new_reflectances(self):
        self.render(self.scene, "exact.exr", "--basis", "wavelengths")
        self.write_json("new.json", {"materials": NEW_MATERIALS})
        self.refuse("relight", "exact.exr", "-o", "no.png", "--palette", "new.json",
                    texts=["wavelengths", "reflectance", "--basis materials"])
        self.write_json("same.json", {"materials": support.MATERIALS})
        self.succeed("relight", "exact.exr", "-o", "same.png", "--palette", "same.json")

    def test_rgb_cannot_be_relit(self):
        self.render(self.scene, "plain.exr", "--basis", "rgb")
        self.succeed("relight", "plain.exr", "-o", "plain.png")
        self.render(self.scene, "direct.png")
        self.assert_near("plain.png", "direct.png", 1.01 / 255)
        for change in (("--light", "lamp=1"), ("--illuminant", "A"), ("--stop", "evening"), ("--intensity", "2")):
            self.refuse("relight", "plain.exr", "-o", "no.png", *change, texts=["rgb", "spectra", "--basis"])

    def test_an_unknown_light_names_the_nearest(self):
        self.refuse("relight", "image.exr", "-o", "no.png", "--light", "lamb=1", texts=["\"lamb\"", "\"lamp\""])
        self.refuse("relight", "image.exr", "-o", "no.png", "--illuminant", "D66", texts=["D66", "D65"])
        self.refuse("relight", "image.exr", "-o", "no.png", "--stop", "morning", texts=["morning", "evening"])
        self.refuse("relight", "image.exr", "-o", "no.png", "--observer", "cie1932", texts=["cie1932", "cie1931"])

    def test_bad_words_are_bad_usage(self):
        for options, texts in (
                (("--light", "lamp=-1"), ["--light", "-1"]), (("--light", "lamp=x"), ["--light", "x"]),
                (("--light", "lamp="), ["--light"]), (("--light", "lamp=nan"), ["--light", "nan"]),
                (("--light", "lamp=inf"), ["--light", "inf"]), (("--light", "lamp=1e7"), ["--light", "1e7", "1000000"]),
                (("--light", "=1"), ["--light", "=1"]), (("--light", "lamp"), ["lamp", "NAME=WEIGHT"]),
                (("--intensity", "-1"), ["--intensity", "-1"]),
                (("--background", "red"), ["--background", "red"]), (("--background", "#12345"), ["#12345"]),
                (("--background", "20304g"), ["20304g"])):
            self.refuse("relight", "image.exr", "-o", "no.png", *options, texts=texts, status=2)

    def test_bad_requests_are_named(self):
        for options, texts in (
                (("--light", "lamb=1"), ["--light", "lamb"]), (("--stop", "noon"), ["--stop", "noon"]),
                (("--illuminant", "D66"), ["--illuminant", "D66", "D65"]),
                (("--observer", "cie1965"), ["--observer", "cie1965", "cie1964"]),
                (("--illuminant", "lamps.csv:none"), ["lamps.csv", "none", "line"]),
                (("--illuminant", "missing.csv:green"), ["missing.csv"]),
                (("--palette", "missing.json"), ["missing.json"]),
                (("--palette", "lamps.csv"), ["lamps.csv"])):
            self.write_text("lamps.csv", CSV)
            self.refuse("relight", "image.exr", "-o", "no.png", *options, texts=["image.exr", *texts])
        self.refuse("relight", "missing.exr", "-o", "no.png", texts=["missing.exr"])
        self.refuse("relight", "blob.nrrd", "-o", "no.png", texts=["blob.nrrd"])

    def test_a_new_light_of_the_palette_can_be_named(self):
        self.write_json("new.json", {"lights": [{"name": "blue", "srgb": "#4060ff"}]})
        self.succeed("relight", "image.exr", "-o", "blue.png", "--palette", "new.json", "--light", "blue=1")

    def test_a_palette_that_knows_nothing_of_the_image_is_refused(self):
        self.write_json("other.json", {"materials": [{"name": "wood", "srgb": "#806040"}]})
        self.refuse("relight", "image.exr", "-o", "no.png", "--palette", "other.json", texts=["palette"])


if __name__ == "__main__":
    support.main()
