# SPDX-License-Identifier: BSD-3-Clause
"""metamer render --memory: little of it makes rendering slower and leaves the picture."""
import support


class Memory(support.CliTest):
    def setUp(self):
        super().setUp()
        self.write_json("scene.json", support.make_scene())
        for extension in ("exr", "png"):
            self.succeed("render", "scene.json", "-o", f"default.{extension}")

    def render(self, size):
        for extension in ("exr", "png"):
            self.succeed("render", "scene.json", "-o", f"{size}.{extension}", "--memory", size)

    def test_the_picture_is_the_same_to_the_eye(self):
        for size in ("1", "1K"):
            self.render(size)
            for extension in ("exr", "png"):
                compared = self.json_of("compare", f"{size}.{extension}", f"default.{extension}")
                self.assertGreaterEqual(compared["psnr_db"], 50)

    def test_voxels_are_packed_only_where_they_fit(self):
        """The volume has 1680 voxels, of 4 or 8 bytes when packed; gradients of packed ones are rounded."""
        images = {}
        for size in ("1K", "1023", "100K", "102400", "1M", "1G", "16777215T", "18014398509481983K"):
            self.render(size)
            images[size] = support.read_bytes(self.path(f"{size}.exr"))
        default = support.read_bytes(self.path("default.exr"))
        self.assertTrue(images["1K"] == images["1023"] != default)
        for size in ("100K", "102400", "1M", "1G", "16777215T", "18014398509481983K"):
            self.assertTrue(images[size] == default, size)

    def test_it_is_no_part_of_the_scene(self):
        self.render("1K")
        self.assertEqual(support.embedded_scene(self.path("1K.png")), support.embedded_scene(self.path("default.png")))


if __name__ == "__main__":
    support.main()
