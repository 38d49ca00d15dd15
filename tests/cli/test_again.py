# SPDX-License-Identifier: BSD-3-Clause
"""A picture carries its scene: rendering it again gives the same picture, and another volume is noticed."""
import os

import support


class RenderAgain(support.CliTest):
    def setUp(self):
        super().setUp()
        self.write_json("scene.json", support.make_scene())

    def move_to(self, folder, *names):
        os.makedirs(self.path(folder), exist_ok=True)
        for name in names:
            os.rename(self.path(name), self.path(os.path.join(folder, name)))

    def test_a_picture_gives_itself(self):
        self.succeed("render", "scene.json", "-o", "a.png")
        self.succeed("render", "a.png", "-o", "b.png")
        self.assert_same_bytes("a.png", "b.png")

    def test_a_spectral_image_gives_itself(self):
        self.succeed("render", "scene.json", "-o", "a.exr")
        self.succeed("render", "a.exr", "-o", "b.exr")
        self.assert_same_bytes("a.exr", "b.exr")

    def test_image_and_picture_give_each_other(self):
        self.succeed("render", "scene.json", "-o", "a.exr")
        self.succeed("render", "scene.json", "-o", "a.png")
        self.succeed("render", "a.exr", "-o", "b.png")
        self.succeed("render", "a.png", "-o", "b.exr")
        self.assert_same_bytes("a.png", "b.png")
        self.assert_same_bytes("a.exr", "b.exr")

    def test_a_picture_with_every_default_gives_itself(self):
        self.write_json("few.json", {"volume": {"file": "blob.nrrd"}, "transfer": {
            "points": [{"value": 0, "opacity": 0, "material": "soft"},
                       {"value": 100, "opacity": 0.2, "material": "dense"}]}})
        self.succeed("render", "few.json", "-o", "a.png", "--size", "40x30")
        self.succeed("render", "a.png", "-o", "b.png")
        self.assert_same_bytes("a.png", "b.png")

    def test_the_default_picture_of_a_volume_gives_itself(self):
        self.succeed("render", "blob.nrrd", "-o", "a.png", "--size", "40x30")
        self.succeed("render", "a.png", "-o", "b.png")
        self.assert_same_bytes("a.png", "b.png")

    def test_options_of_the_command_line_are_remembered(self):
        self.succeed("render", "scene.json", "-o", "a.png", "--size", "20x10", "--basis", "wavelengths")
        self.succeed("render", "a.png", "-o", "b.png")
        self.assert_same_bytes("a.png", "b.png")
        scene = self.json_of("info", "b.png")["scene"]
        self.assertEqual((scene["size"], scene["basis"]), ([20, 10], "wavelengths"))

    def test_the_volume_is_found_in_a_folder_of_metamer_data(self):
        self.succeed("render", "scene.json", "-o", "a.png")
        self.move_to("data", "blob.nrrd")
        self.refuse("render", "a.png", "-o", "b.png", texts=["a.png", "blob.nrrd", "METAMER_DATA"])
        os.makedirs(self.path("empty"))
        folders = self.path("empty") + "::" + self.path("data")
        self.succeed("render", "a.png", "-o", "b.png", env={"METAMER_DATA": folders})
        self.assert_same_bytes("a.png", "b.png")

    def test_the_volume_is_found_by_option(self):
        self.succeed("render", "scene.json", "-o", "a.png")
        self.move_to("data", "blob.nrrd")
        self.succeed("render", "a.png", "-o", "b.png", "--volume", "data/blob.nrrd")
        self.assert_same_bytes("a.png", "b.png")

    def test_a_picture_in_another_folder_finds_its_volume_beside_itself(self):
        self.succeed("render", "scene.json", "-o", "a.png")
        self.move_to("both", "a.png", "blob.nrrd")
        self.succeed("render", "both/a.png", "-o", "b.png")
        self.assert_same_bytes("both/a.png", "b.png")

    def test_the_same_voxels_in_another_file_are_the_same_volume(self):
        self.succeed("render", "scene.json", "-o", "a.png")
        support.write_nrrd(self.path("blob.nrrd"), encoding="gzip")
        self.succeed("render", "a.png", "-o", "b.png")
        self.assert_same_bytes("a.png", "b.png")

    def test_another_volume_of_that_name_is_refused_unless_named(self):
        self.succeed("render", "scene.json", "-o", "a.png")
        support.write_nrrd(self.path("blob.nrrd"), values=support.blob(shift=1.0))
        self.refuse("render", "a.png", "-o", "b.png", texts=["blob.nrrd", "a.png", "--volume"])
        self.succeed("render", "a.png", "-o", "b.png", "--volume", "blob.nrrd")
        self.assertGreater(self.json_of("compare", "a.png", "b.png")["max_error"], 0.01)
        self.succeed("render", "b.png", "-o", "c.png")
        self.assert_same_bytes("b.png", "c.png")

    def test_a_volume_of_another_size_is_refused_unless_named(self):
        self.succeed("render", "scene.json", "-o", "a.exr")
        support.write_nrrd(self.path("blob.nrrd"), size=(9, 8, 7))
        self.refuse("render", "a.exr", "-o", "b.exr", texts=["blob.nrrd", "9 x 8 x 7", "14 x 12 x 10", "--volume"])
        self.succeed("render", "a.exr", "-o", "b.exr", "--volume", "blob.nrrd")

    def test_a_picture_of_another_program_is_refused(self):
        support.write_png(self.path("foreign.png"), 4, 3)
        self.refuse("render", "foreign.png", "-o", "b.png", texts=["foreign.png", "scene"])


if __name__ == "__main__":
    support.main()
