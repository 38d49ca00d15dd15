# SPDX-License-Identifier: BSD-3-Clause
"""Files that are missing, broken or cannot be written, and runs that are ended: one sentence, exit status 1, and
nothing left behind."""
import json
import os
import resource
import signal
import stat
import subprocess
import time

import support


def limit_files(byte_count):
    """For a child process: writing beyond this size fails, as on a full disk (EFBIG instead of ENOSPC)."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (byte_count, byte_count))
    return {"preexec_fn": limit, "restore_signals": False}


def as_nobody():
    """For a child process: without the administrator's rights, who may write everywhere."""
    def drop():
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)
    return {"preexec_fn": drop} if os.geteuid() == 0 else {}


class BadInput(support.CliTest):
    def setUp(self):
        super().setUp()
        self.write_json("scene.json", support.make_scene())

    def test_missing_files(self):
        self.refuse("render", "missing.json", "-o", "a.png", texts=["missing.json"])
        self.refuse("render", "missing.png", "-o", "a.png", texts=["missing.png"])
        self.refuse("render", "scene.json", "-o", "a.png", "--volume", "missing.nrrd", texts=["missing.nrrd"])
        self.refuse("info", "missing", texts=["missing"])
        self.refuse("info", "missing", "--json", texts=["missing"])
        self.refuse("convert", "missing.nrrd", "-o", "a.nrrd", texts=["missing.nrrd"])
        os.remove(self.path("blob.nrrd"))
        self.refuse("render", "scene.json", "-o", "a.png", texts=["scene.json", "blob.nrrd", "METAMER_DATA"])

    def test_folders_and_empty_files(self):
        os.mkdir(self.path("folder"))
        os.mkdir(self.path("folder.json"))
        for name in ("empty.json", "empty.png", "empty.exr", "empty.nrrd", "empty"):
            self.write_text(name, "")
        for name in ("folder", "folder.json", "empty.json", "empty.png", "empty.exr", "empty.nrrd", "empty"):
            self.refuse("render", name, "-o", "a.png", texts=[name])
            self.refuse("info", name, texts=[name])
            self.refuse("relight", name, "-o", "a.png", texts=[name])
            self.refuse("compare", name, name, texts=[name])
            self.refuse("convert", name, "-o", "a.nrrd", texts=[name])
            self.refuse("render", "scene.json", "-o", "a.png", "--volume", name, texts=[name])

    def test_a_volume_whose_name_a_document_cannot_hold(self):
        os.rename(self.path("blob.nrrd"), os.fsencode(self.path("bl")) + b"\xf6b.nrrd")
        self.refuse("render", b"bl\xf6b.nrrd", "-o", "a.png", texts=["UTF-8"])
        self.refuse("render", "scene.json", "-o", "a.png", "--volume", b"bl\xf6b.nrrd", texts=["UTF-8"])

    def test_files_of_another_kind(self):
        self.succeed("render", "scene.json", "-o", "a.exr")
        self.succeed("render", "scene.json", "-o", "a.png")
        self.refuse("relight", "a.png", "-o", "b.png", texts=["a.png"])
        self.refuse("relight", "scene.json", "-o", "b.png", texts=["scene.json"])
        self.refuse("convert", "a.png", "-o", "b.nrrd", texts=["a.png"])
        self.refuse("compare", "scene.json", "a.png", texts=["scene.json"])
        self.refuse("render", "scene.json", "-o", "b.png", "--volume", "a.exr", texts=["a.exr"])
        self.write_json("palette.json", {"materials": support.MATERIALS, "lights": support.LIGHTS})
        self.refuse("render", "palette.json", "-o", "b.png", texts=["palette.json"])

    def test_truncated_files(self):
        self.succeed("render", "scene.json", "-o", "a.exr")
        self.succeed("render", "scene.json", "-o", "a.png")
        support.write_nrrd(self.path("zipped.nrrd"), encoding="gzip")
        for name in ("blob.nrrd", "zipped.nrrd", "a.exr", "a.png"):
            whole = support.read_bytes(self.path(name))
            for part in (1, 7, 9, len(whole) // 4, len(whole) // 2, len(whole) - 3):
                cut = "cut" + os.path.splitext(name)[1]
                with open(self.path(cut), "wb") as stream:
                    stream.write(whole[:part])
                self.refuse("info", cut, texts=[cut])
                if name.endswith("nrrd"):
                    self.refuse("render", "scene.json", "-o", "b.png", "--volume", cut, texts=[cut])
                if name.endswith("exr"):
                    self.refuse("relight", cut, "-o", "b.png", texts=[cut])
                os.remove(self.path(cut))

    def test_a_damaged_embedded_scene(self):
        self.succeed("render", "scene.json", "-o", "a.exr")
        data = support.read_bytes(self.path("a.exr"))
        for old, new in ((b"\"observer\"", b"\"observes\""), (b"\"metamer\": 1", b"\"metamer\": 9"),
                         (b"\"composite\"", b"\"compotite\"")):
            self.assertIn(old, data)
            with open(self.path("b.exr"), "wb") as stream:
                stream.write(data.replace(old, new))
            self.refuse("render", "b.exr", "-o", "c.png", texts=["b.exr"])
            self.refuse("relight", "b.exr", "-o", "c.png", texts=["b.exr"])
            self.refuse("info", "b.exr", texts=["b.exr"])


class Pipe(support.CliTest):
    def test_inputs_that_are_pipes_are_refused_at_once(self):
        os.mkfifo(self.path("pipe"))
        os.mkfifo(self.path("pipe.json"))
        for name in ("pipe", "pipe.json"):
            self.refuse("info", name, texts=[name, "pipe"])
            self.refuse("render", name, "-o", "out.png", texts=[name, "pipe"])


class Input(support.CliTest):
    def test_a_detached_volume_without_its_data(self):
        for data in ("gone.raw", "."):
            self.write_text("head.nhdr", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                                         f"data file: {data}\n")
            self.refuse("info", "head.nhdr", texts=["head.nhdr", "data file", data])

    def test_values_too_far_apart_for_a_default_scene(self):
        support.write_nrrd(self.path("far.nrrd"), (2, 2, 2), [-1.7e308, 1.7e308] * 4, "double")
        self.refuse("render", "far.nrrd", "-o", "out.png", texts=["far.nrrd", "1.7e+308"])

    def test_a_volume_has_no_volume_to_replace(self):
        support.write_nrrd(self.path("blob.nrrd"))
        self.refuse("render", "blob.nrrd", "--volume", "other.nrrd", "-o", "out.png", texts=["blob.nrrd", "--volume"])

    def test_text_that_is_no_utf8_is_shown_all_the_same(self):
        support.write_nrrd(self.path("unit.nrrd"), fields=("space: LPS", "space directions: (1,0,0) (0,1,0) (0,0,1)"))
        text = support.read_bytes(self.path("unit.nrrd")).replace(b"encoding:", b'space units: "\xb5m" "\xb5m" "\xb5m"\nencoding:')
        with open(self.path("unit.nrrd"), "wb") as stream:
            stream.write(text)
        self.assertIn("?m", self.succeed("info", "unit.nrrd"))

    def test_an_embedded_scene_names_no_files(self):
        support.write_nrrd(self.path("blob.nrrd"))
        scene = support.make_scene()
        self.write_json("scene.json", scene)
        self.succeed("render", "scene.json", "-o", "in.png")
        document = json.loads(support.embedded_scene(self.path("in.png")))
        document["palette"] = {"file": "palette.json"}
        support.embed_scene(self.path("in.png"), self.path("bad.png"), json.dumps(document))
        self.refuse("render", "bad.png", "-o", "out.png", texts=["bad.png", "palette.file", "stands alone"])
        self.refuse("info", "bad.png", texts=["bad.png", "stands alone"])

    def test_an_utf8_mark_before_a_scene_is_passed_over(self):
        text = "\ufeff" + json.dumps(support.make_scene())
        with open(self.path("marked.json"), "w", encoding="utf-8") as stream:
            stream.write(text)
        support.write_nrrd(self.path("blob.nrrd"))
        self.succeed("render", "marked.json", "-o", "out.png")


class Output(support.CliTest):
    def setUp(self):
        super().setUp()
        self.write_json("scene.json", support.make_scene())
        self.succeed("render", "scene.json", "-o", "in.exr")
        self.succeed("render", "scene.json", "-o", "in.png")
        self.commands = [(["render", "scene.json"], "exr"), (["render", "scene.json"], "png"),
                         (["relight", "in.exr"], "png"), (["convert", "blob.nrrd"], "nrrd"),
                         (["convert", "blob.nrrd"], "nhdr"), (["compare", "in.png", "in.png"], "png")]

    def refuse_all(self, output, texts, **options):
        """Every command that writes fails on this output; {} in it is the extension."""
        for words, extension in self.commands:
            with self.subTest(words=words, extension=extension):
                name = output.format(extension)
                stem = os.path.splitext(name)[0]  # an .nhdr fails at its data file
                self.refuse(*words, "-o", name, texts=[stem, *texts], **options)

    def test_folders_that_do_not_exist(self):
        self.refuse_all("none/out.{}", ["No such file"])
        self.refuse_all("blob.nrrd/out.{}", [])

    def test_a_folder_in_the_place_of_the_file(self):
        for extension in ("png", "exr", "nrrd", "nhdr"):
            os.mkdir(self.path(f"folder.{extension}"))
        self.refuse_all("folder.{}", ["directory"])

    def test_a_name_that_says_something_else(self):
        for words, extension in self.commands:
            for name in ("out", "out.jpg", ".png", "png"):
                self.refuse(*words, "-o", name, texts=[name, ".nrrd" if "convert" in words else ".png"])
        self.refuse("relight", "in.exr", "-o", "in.exr", texts=["in.exr", ".png"])
        self.refuse("compare", "in.exr", "in.png", "-o", "in.exr", texts=["in.exr", ".png"])

    def test_an_empty_name(self):
        for words, extension in self.commands:
            self.refuse(*words, "-o", "")

    def check_nobody(self):
        os.chmod(self.folder, 0o755)
        try:
            self.call("--version", **as_nobody())
        except PermissionError:
            self.skipTest("nobody may run the program here")

    def test_folders_that_cannot_be_written(self):
        self.check_nobody()
        os.mkdir(self.path("locked"), 0o555)
        self.refuse_all("locked/out.{}", ["denied"], **as_nobody())

    def test_a_file_its_owner_has_locked(self):
        self.check_nobody()
        for extension in ("png", "exr", "nrrd"):
            self.write_text(f"kept.{extension}", "old")
            os.chmod(self.path(f"kept.{extension}"), 0o444)
        os.chmod(self.folder, 0o777)
        for words, extension in self.commands:
            if extension != "nhdr":
                self.refuse(*words, "-o", f"kept.{extension}", texts=["kept", "denied"], **as_nobody())

    def test_a_file_size_limit_that_ends_programs(self):
        for extension in ("exr", "png"):
            # 8 blocks of 512 bytes: room for what a sanitizer writes when a program starts, not for a picture.
            line = f"ulimit -f 8; exec '{support.METAMER}' render scene.json --size 200x150 -o limited.{extension}"
            before = self.listing()
            result = subprocess.run(["sh", "-c", line], cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("limited", result.stderr)
            self.assertEqual(self.listing(), before)

    def test_a_full_device(self):
        before = os.stat("/dev/full")
        for words, extension in self.commands:
            if extension == "nhdr":
                continue
            link = f"full.{extension}"
            if not os.path.islink(self.path(link)):
                os.symlink("/dev/full", self.path(link))
            with self.subTest(words=words):
                self.refuse(*words, "-o", link, texts=["full", "No space left"])
        self.refuse("render", "scene.json", "-o", "/dev/full", texts=["/dev/full", "No space left"])
        after = os.stat("/dev/full")
        self.assertTrue(stat.S_ISCHR(after.st_mode))
        self.assertEqual((before.st_ino, before.st_rdev), (after.st_ino, after.st_rdev))

    def test_devices_that_swallow_everything(self):
        self.check_nobody()
        self.succeed("render", "scene.json", "-o", "/dev/null", **as_nobody())
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))

    def test_a_disk_that_fills_up(self):
        for limit in (0, 50):
            self.refuse_all("out.{}", [], **limit_files(limit))

    def test_a_full_file_system(self):
        folder = self.path("small")
        os.mkdir(folder)
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4k", "none", folder], capture_output=True, check=False)
        if mount.returncode != 0:
            self.skipTest("file systems cannot be mounted here")
        try:
            with open(os.path.join(folder, "filling"), "wb") as stream:
                stream.write(bytes(4096))
            self.refuse_all("small/out.{}", ["No space left"])
        finally:
            subprocess.run(["umount", folder], check=True)

    def test_an_old_file_survives_a_failure(self):
        for extension in ("png", "exr", "nrrd", "nhdr"):
            self.write_text(f"out.{extension}", "old")
        self.refuse_all("out.{}", [], **limit_files(50))

    def test_a_file_behind_a_link_is_replaced_and_the_link_stays(self):
        os.mkdir(self.path("real"))
        self.write_text("real/out.png", "old")
        os.symlink("real/out.png", self.path("out.png"))
        self.succeed("render", "scene.json", "-o", "out.png")
        self.assertTrue(os.path.islink(self.path("out.png")))
        self.assert_same_bytes("real/out.png", "in.png")

    def test_the_picture_may_replace_its_own_input(self):
        self.succeed("render", "in.png", "-o", "in.png")
        self.succeed("relight", "in.exr", "-o", "in.exr.png")
        self.assert_same_bytes("in.png", "in.exr.png")


class Interrupted(support.CliTest):
    def test_a_long_rendering_that_is_ended_leaves_nothing(self):
        scene = support.make_scene()
        scene["render"].update(size=[3000, 3000], step=0.005, termination=0)
        self.write_json("scene.json", scene)
        self.write_text("old.png", "old")
        before = self.listing()
        for number in (signal.SIGTERM, signal.SIGINT):
            for output in ("new.png", "new.exr", "old.png"):
                with subprocess.Popen([support.METAMER, "render", "scene.json", "-o", output], cwd=self.folder,
                                      stderr=subprocess.PIPE) as process:
                    time.sleep(0.2)
                    self.assertIsNone(process.poll(), "the rendering is too short for this test")
                    process.send_signal(number)
                    process.wait(timeout=20)
                self.assertNotEqual(process.returncode, 0)
                self.assertEqual(self.listing(), before)

    def test_whenever_it_is_ended_the_file_is_whole_or_not_there(self):
        scene = support.make_scene()
        scene["render"]["size"] = [300, 300]
        self.write_json("scene.json", scene)
        self.succeed("render", "scene.json", "-o", "whole.exr")
        whole = support.read_bytes(self.path("whole.exr"))
        for attempt in range(25):
            with subprocess.Popen([support.METAMER, "render", "scene.json", "-o", "new.exr"], cwd=self.folder) as process:
                time.sleep(0.004 * attempt)
                process.kill()
            if os.path.exists(self.path("new.exr")):
                self.assertEqual(support.read_bytes(self.path("new.exr")), whole)
                os.remove(self.path("new.exr"))


if __name__ == "__main__":
    support.main()
