# SPDX-License-Identifier: BSD-3-Clause
"""The same scene gives the same bytes, whatever the number of threads, the locale and the day."""
import support
import subprocess


class Determinism(support.CliTest):
    def check_threads(self, scene, name):
        self.write_json("scene.json", scene)
        for extension in ("exr", "png"):
            self.succeed("render", "scene.json", "-o", f"{name}1.{extension}", "--threads", 1)
            for threads in (2, 3, 7):
                self.succeed("render", "scene.json", "-o", f"{name}{threads}.{extension}", "--threads", threads)
                self.assert_same_bytes(f"{name}1.{extension}", f"{name}{threads}.{extension}")

    def test_threads_do_not_change_a_byte(self):
        self.check_threads(support.make_scene(), "plain")

    def test_threads_do_not_change_a_byte_with_jitter(self):
        scene = support.make_scene()
        scene["render"]["jitter"] = True
        self.check_threads(scene, "jitter")
        scene["render"]["jitter"] = False
        self.write_json("scene.json", scene)
        self.succeed("render", "scene.json", "-o", "still.png")
        self.assertNotEqual(support.read_bytes(self.path("still.png")), support.read_bytes(self.path("jitter1.png")))

    def test_threads_do_not_change_a_byte_of_every_blend_and_basis(self):
        for blend in ("sum", "maximum"):
            for basis in ("materials", "wavelengths", "rgb"):
                scene = support.make_scene()
                scene["render"].update(blend=blend, basis=basis)
                self.check_threads(scene, blend + basis)

    def test_threads_do_not_change_a_relit_byte(self):
        self.write_json("scene.json", support.make_scene())
        self.succeed("render", "scene.json", "-o", "image.exr")
        for threads in (1, 2, 3, 7):
            self.succeed("relight", "image.exr", "-o", f"lit{threads}.png", "--light", "lamp=1", "--threads", threads)
            self.assert_same_bytes("lit1.png", f"lit{threads}.png")

    def test_the_locale_does_not_matter(self):
        installed = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split()
        locales = [name for name in ("de_DE.utf8", "C.utf8", "POSIX") if name in installed]
        if "de_DE.utf8" not in installed:
            print("note: de_DE.UTF-8 is not installed; C.UTF-8 alone is checked")
        self.write_json("scene.json", support.make_scene())
        self.succeed("render", "scene.json", "-o", "a.png", env={"LC_ALL": "C"})
        texts = {self.succeed("info", "a.png", "--json", env={"LC_ALL": "C"})}
        for name in locales:
            self.succeed("render", "scene.json", "-o", "b.png", env={"LC_ALL": name})
            self.assert_same_bytes("a.png", "b.png")
            texts.add(self.succeed("info", "a.png", "--json", env={"LC_ALL": name}))
        self.assertEqual(len(texts), 1)


if __name__ == "__main__":
    support.main()
