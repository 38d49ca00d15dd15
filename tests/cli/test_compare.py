# SPDX-License-Identifier: BSD-3-Clause
"""metamer compare: numbers, exit status and the difference picture."""
import math

import support

KEYS = {"max_error", "mean_error", "psnr_db", "ciede2000", "pixels"}


class Compare(support.CliTest):
    def setUp(self):
        super().setUp()
        support.write_png(self.path("a.png"), 5, 4, bytes([100, 100, 100]))
        support.write_png(self.path("b.png"), 5, 4, bytes([100, 151, 100]))
        support.write_png(self.path("wide.png"), 6, 4)

    def test_equal_pictures(self):
        found = self.json_of("compare", "a.png", "a.png")
        self.assertEqual(set(found), KEYS)
        self.assertEqual(set(found["ciede2000"]), {"mean", "p99", "max"})
        self.assertEqual(found, {"max_error": 0, "mean_error": 0, "psnr_db": 200, "pixels": 20,
                                 "ciede2000": {"mean": 0, "p99": 0, "max": 0}})
        self.assertIn("equal", self.succeed("compare", "a.png", "a.png"))

    def test_different_pictures(self):
        found = self.json_of("compare", "a.png", "b.png")
        self.assertEqual(set(found), KEYS)
        self.assertAlmostEqual(found["max_error"], 0.2, places=6)
        self.assertAlmostEqual(found["mean_error"], 0.2 / 3, places=6)
        self.assertAlmostEqual(found["psnr_db"], -10 * math.log10(0.04 / 3), places=4)
        self.assertGreater(found["ciede2000"]["mean"], 10)
        self.assertEqual(found["pixels"], 20)
        self.assertEqual(found, self.json_of("compare", "b.png", "a.png"))

    def test_the_tolerance_decides_the_exit_status(self):
        self.succeed("compare", "a.png", "b.png", "--tolerance", "0.21")
        self.succeed("compare", "a.png", "a.png", "--tolerance", "0")
        result = self.call("compare", "a.png", "b.png", "--tolerance", "0.19")
        self.assertEqual(result.returncode, 1)
        self.assertIn("0.19", result.stderr)
        self.assertNotEqual(result.stdout, "")

    def test_sizes_must_be_equal(self):
        self.refuse("compare", "a.png", "wide.png", texts=["5 x 4", "6 x 4"])
        self.refuse("compare", "a.png", "wide.png", "-o", "difference.png", texts=["5 x 4"])

    def test_the_difference_is_a_picture(self):
        self.succeed("compare", "a.png", "b.png", "-o", "difference.png")
        self.assertEqual(self.json_of("info", "difference.png")["size"], [5, 4])
        support.write_png(self.path("green.png"), 5, 4, bytes([0, 255, 0]))
        self.assertLess(self.json_of("compare", "difference.png", "green.png")["max_error"], 1e-6)
        self.succeed("compare", "a.png", "a.png", "-o", "difference.png")
        support.write_png(self.path("black.png"), 5, 4, bytes(3))
        self.assertEqual(self.json_of("compare", "difference.png", "black.png")["max_error"], 0)

    def test_images_are_compared_relit(self):
        scene = support.make_scene()
        self.write_json("scene.json", scene)
        self.succeed("render", "scene.json", "-o", "a.exr")
        self.succeed("render", "scene.json", "-o", "c.exr", "--basis", "rgb")
        self.succeed("render", "scene.json", "-o", "c.png")
        self.assert_near("a.exr", "c.exr", 1e-5)
        self.assert_near("a.exr", "c.png", 0.51 / 255)

    def test_files_that_are_no_pictures_are_named(self):
        self.refuse("compare", "a.png", "missing.png", texts=["missing.png"])
        self.refuse("compare", "blob.nrrd", "a.png", texts=["blob.nrrd"])
        self.refuse("compare", "a.png", ".", texts=["."])
        self.write_text("empty.png", "")
        self.refuse("compare", "empty.png", "a.png", texts=["empty.png"])


if __name__ == "__main__":
    support.main()
