# SPDX-License-Identifier: BSD-3-Clause
"""metamer info for every kind of file, and metamer convert there and back."""
import hashlib
import os
import struct

import support

SIZE = (3, 2, 2)
VALUES = {"int8": [-128, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 127], "uint8": list(range(0, 240, 20)),
          "int16": [-32768, -300] + list(range(9)) + [32767], "uint16": list(range(11)) + [65535],
          "int32": [-2**31, -70000] + list(range(9)) + [2**31 - 1], "uint32": list(range(11)) + [2**32 - 1],
          "float": [i / 8 - 0.5 for i in range(12)], "double": [i / 3 for i in range(12)]}


class Info(support.CliTest):
    def test_colors_are_those_of_the_scene_s_observer(self):
        scene = support.make_scene()
        scene["palette"]["materials"] = [{"name": "one", "values": [1] * 81}, *support.MATERIALS]
        self.write_json("plain.json", scene)
        scene["observer"] = "cie1964"
        self.write_json("wide.json", scene)
        scene["white"] = "light"
        self.write_json("adapted.json", scene)
        plain, wide, adapted = (self.json_of("info", f"{name}.json")["materials"][0]["srgb_picture"]
                                for name in ("plain", "wide", "adapted"))
        self.assertNotEqual(plain["tube"], wide["tube"])
        for light in ("day", "lamp", "tube"):
            self.assertTrue(all(value > 0.999 for value in adapted[light]), adapted)

    def test_a_volume(self):
        support.write_nrrd(self.path("v.nrrd"), SIZE, VALUES["int16"], "int16", fields=[
            "space: left-posterior-superior", "space directions: (2,0,0) (0,1.5,0) (0,0,1)",
            "space origin: (10,20,30)", "space units: \"mm\" \"mm\" \"mm\""])
        found = self.json_of("info", "v.nrrd")
        self.assertEqual((found["kind"], found["type"], found["size"]), ("volume", "int16", [3, 2, 2]))
        self.assertEqual((found["spacing"], found["origin"], found["unit"]), ([2, 1.5, 1], [10, 20, 30], "mm"))
        self.assertEqual(found["axes"], [[2, 0, 0], [0, 1.5, 0], [0, 0, 1]])
        self.assertEqual((found["range"], found["oriented"], found["bytes"]), ([-32768, 32767], True, 24))
        voxels = struct.pack("<12h", *VALUES["int16"])
        self.assertEqual(found["sha256"], hashlib.sha256(voxels).hexdigest())
        self.assertEqual(found["file"], "v.nrrd")

    def test_a_scene(self):
        self.write_json("scene.json", support.make_scene())
        found = self.json_of("info", "scene.json")
        self.assertEqual((found["kind"], found["volume"], found["renderer"]), ("scene", "blob.nrrd", "raycast"))
        self.assertEqual((found["size"], found["points"], found["stops"]), ([40, 33], 3, ["evening"]))
        self.assertEqual(found["weights"], {"day": 0.7, "lamp": 0.3, "tube": 0})
        self.assertEqual(found["intensity"], 1.1)
        shell = found["materials"][1]
        self.assertEqual((shell["name"], set(shell["srgb_picture"])), ("shell", {"day", "lamp", "tube"}))
        for channel, expected in zip(shell["srgb_picture"]["day"], (0xe0, 0xa0, 0x40)):
            self.assertAlmostEqual(channel, expected / 255, delta=2e-3)

    def test_an_image_and_a_picture(self):
        self.write_json("scene.json", support.make_scene())
        self.succeed("render", "scene.json", "-o", "a.exr")
        self.succeed("render", "scene.json", "-o", "a.png")
        image, picture = self.json_of("info", "a.exr"), self.json_of("info", "a.png")
        self.assertEqual((image["kind"], image["basis"], image["dimension"]), ("spectral image", "materials", 4))
        self.assertTrue(0.05 < image["fill"] < 1)
        self.assertEqual((picture["kind"], picture["size"], image["size"]), ("picture", [40, 33], [40, 33]))
        self.assertEqual(picture["scene"], image["scene"])
        self.assertEqual(picture["scene"]["volume"], "blob.nrrd")

    def test_a_picture_of_another_program(self):
        support.write_png(self.path("foreign.png"), 4, 3)
        found = self.json_of("info", "foreign.png")
        self.assertEqual((found["kind"], found["size"], found["scene"]), ("picture", [4, 3], None))

    def test_a_palette(self):
        self.write_json("p.json", {"materials": support.MATERIALS, "lights": support.LIGHTS})
        found = self.json_of("info", "p.json")
        self.assertEqual((found["kind"], found["lights"]), ("palette", ["day", "lamp", "tube"]))
        self.assertEqual([m["name"] for m in found["materials"]], ["haze", "shell", "core"])

    def test_the_analysis_of_a_palette(self):
        # Narrow lights: red paint and white are the same to the first, red and black to the second.
        def band(low, high, inside, outside):
            return [inside if low <= 380 + 5 * i <= high else outside for i in range(81)]
        self.write_json("p.json", {
            "materials": [{"name": "white", "values": [0.9] * 81},
                          {"name": "red", "values": band(590, 780, 0.9, 0)},
                          {"name": "soot", "values": [0] * 81}],
            "lights": [{"name": "amber", "values": band(595, 610, 1, 0)},
                       {"name": "green", "values": band(520, 535, 1, 0)},
                       {"name": "both", "values": [a + b for a, b in zip(band(595, 610, 1, 0), band(520, 535, 1, 0))]}]})
        found = self.json_of("info", "p.json")["analysis"]
        self.assertEqual(found["thresholds"], {"match": 1, "similar": 5, "invisible": 2})
        self.assertEqual(set(found["left_out"].values()), {0})
        verdicts = {(pair["light"], *pair["materials"]): pair["verdict"] for pair in found["pairs"]}
        self.assertEqual(len(verdicts), 9)
        self.assertEqual(verdicts["amber", "white", "red"], "match")
        self.assertEqual(verdicts["green", "white", "red"], "differ")
        self.assertEqual(verdicts["green", "red", "soot"], "match")
        self.assertTrue(all(set(pair["ciede2000"]) == {"normal", "protan", "deutan", "tritan"}
                            for pair in found["pairs"]))
        invisible = {(entry["light"], entry["material"]) for entry in found["invisible"]}
        self.assertEqual(invisible, {("amber", "soot"), ("green", "soot"), ("both", "soot"), ("green", "red")})
        metamers = {(entry["match"], entry["other"]): entry for entry in found["metamers"]}
        self.assertEqual(set(metamers), {("amber", "green"), ("amber", "both")})
        for entry in metamers.values():
            self.assertEqual(entry["materials"], ["white", "red"])
            self.assertGreater(entry["ciede2000"], 10)
            self.assertGreater(entry["largest"], 0.98 * entry["ciede2000"])
        self.assertEqual(found["constant"], [])
        text = self.succeed("info", "p.json")
        for sentence in ("look the same\n    white and red under amber (0.0)\n", "black, so not seen\n    soot under amber\n",
                         "white and red match under amber and part by "):
            self.assertIn(sentence, text)
        self.assertNotIn("red and soot under green", text)  # both black: no news

    def test_the_analysis_of_a_scene_is_for_its_observer_and_white(self):
        scene = support.make_scene()
        scene["palette"]["materials"] = [{"name": "gray", "values": [0.4] * 81}, *support.MATERIALS]
        self.write_json("plain.json", scene)
        scene["white"] = "light"
        self.write_json("adapted.json", scene)
        plain, adapted = (self.json_of("info", f"{name}.json")["analysis"] for name in ("plain", "adapted"))
        def lights_of_gray(analysis):
            return {tuple(entry["lights"]) for entry in analysis["constant"] if entry["material"] == "gray"}
        self.assertEqual(lights_of_gray(plain), set())
        self.assertEqual(lights_of_gray(adapted), {("day", "lamp"), ("day", "tube"), ("lamp", "tube")})

    def test_color_blind_eyes_are_told_of(self):
        self.write_json("p.json", {"materials": [{"name": "rust", "srgb": "#c08070"}, {"name": "moss", "srgb": "#939170"}],
                                   "lights": support.LIGHTS[:1]})
        text = self.succeed("info", "p.json")
        self.assertRegex(text, r"hard for color-blind eyes.*\n    rust and moss under day \(24\.\d; protan \d\.\d deutan 2\.\d\)")

    def test_a_palette_without_news_says_so(self):
        self.write_json("p.json", {"materials": [{"name": "white", "values": [1] * 81}, {"name": "dark", "values": [0.1] * 81}],
                                   "lights": support.LIGHTS[:1]})
        self.assertIn("every material is seen and told apart from the others under every light", self.succeed("info", "p.json"))

    def test_of_a_large_palette_what_is_left_out_is_said(self):
        self.write_json("p.json", {
            "materials": [{"name": f"m{i}", "values": [0.01 * (i + 1)] * 81} for i in range(60)] +
                         [{"name": f"same{i}", "values": [0.3] * 81} for i in range(6)] +
                         [{"name": "rust", "srgb": "#c08070"}, {"name": "moss", "srgb": "#939170"}],
            "lights": support.LIGHTS})
        found = self.json_of("info", "p.json")["analysis"]
        total = 3 * 68 * 67 // 2
        self.assertEqual(len(found["pairs"]) + found["left_out"]["pairs"], total)
        self.assertTrue(all(min(pair["ciede2000"].values()) <= 5 for pair in found["pairs"]))
        self.assertIn(["rust", "moss"], [pair["materials"] for pair in found["pairs"]])
        self.assertEqual(len(found["metamers"]), 16)
        self.assertGreaterEqual(found["left_out"]["metamers"], 3 * 2 * 6 * 5 // 2 - 16)
        text = self.succeed("info", "p.json")
        self.assertIn(f"of this large palette {found['left_out']['pairs']} pairs are not listed", text)
        self.assertRegex(text, r"same\n(    .*\n){12}    and \d+ more\n")

    def test_spectra(self):
        self.write_text("s.csv", "wavelength_nm,red,green\n400,0,1\n500,0.5,0.5\n600,1,0\n")
        found = self.json_of("info", "s.csv")
        self.assertEqual((found["kind"], found["columns"]), ("spectra", ["red", "green"]))
        self.assertEqual((found["wavelength_nm"], found["rows"]), ([400, 600], 3))

    def test_for_people(self):
        self.write_json("scene.json", support.make_scene())
        for name, text in (("scene.json", "raycast"), ("blob.nrrd", "uint8")):
            self.assertIn(text, self.succeed("info", name))


class Convert(support.CliTest):
    def check(self, source, output, *options):
        self.succeed("convert", source, "-o", output, *options)
        before, after = self.json_of("info", source), self.json_of("info", output)
        del before["file"], after["file"]
        self.assertEqual(before, after)

    def test_every_type_in_every_form(self):
        for type_, values in VALUES.items():
            for endian in ("little", "big"):
                for encoding in ("raw", "gzip"):
                    support.write_nrrd(self.path("v.nrrd"), SIZE, values, type_, encoding, endian)
                    self.check("v.nrrd", "out.nrrd", "--encoding", encoding, "--endian", endian)
                    self.check("v.nrrd", "out.nhdr", "--encoding", encoding, "--endian", endian)
                    self.check("out.nhdr", "back.nrrd")
                    data = "out.raw" if encoding == "raw" else "out.raw.gz"
                    self.assertTrue(os.path.exists(self.path(data)))

    def test_geometry_is_kept(self):
        for fields in (["spacings: 1 1.5 2.25"],
                       ["space: right-anterior-superior", "space directions: (0.6,0.8,0) (-0.8,0.6,0) (0,0,2.5)",
                        "space origin: (-1,2,3.125)"],
                       ["space dimension: 3", "space directions: (1,0,0) (0,1,0) (0.5,0,1)", "space origin: (0,0,0)"]):
            support.write_nrrd(self.path("v.nrrd"), SIZE, VALUES["uint8"], fields=fields)
            self.check("v.nrrd", "out.nrrd")
            self.check("out.nrrd", "out.nhdr", "--encoding", "raw", "--endian", "big")

    def test_the_same_volume_gives_the_same_bytes(self):
        self.succeed("convert", "blob.nrrd", "-o", "a.nrrd")
        self.succeed("convert", "a.nrrd", "-o", "b.nrrd")
        self.assert_same_bytes("a.nrrd", "b.nrrd")

    def test_a_volume_replaces_itself(self):
        before = self.json_of("info", "blob.nrrd")
        self.succeed("convert", "blob.nrrd", "-o", "blob.nrrd")
        self.assertEqual(self.json_of("info", "blob.nrrd"), before)

    def test_other_names_are_refused(self):
        self.refuse("convert", "blob.nrrd", "-o", "out.raw", texts=["out.raw", ".nrrd"])
        self.refuse("convert", "missing.nrrd", "-o", "out.nrrd", texts=["missing.nrrd"])


if __name__ == "__main__":
    support.main()
