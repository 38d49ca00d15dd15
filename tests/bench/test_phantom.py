# SPDX-License-Identifier: BSD-3-Clause
"""The phantom has the bytes of its closed form, or is not there at all. Usage: test_phantom.py PHANTOM."""
import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PHANTOM = ""
HEADER = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: {0} {0} {0}\nencoding: raw\n\n"
USAGE = "usage: phantom EDGE FILE.nrrd, EDGE from 2 to 8192\n"


def closed_form(x, y, z):
    """The formula of bench/phantom.c, before it is rounded."""
    ripple = math.cos(2 * math.pi * 6 * math.cos(math.pi / 2 * math.hypot(x, y)))
    signal_ = (1 - math.sin(math.pi / 2 * z) + 0.25 * (1 + ripple)) / (2 * (1 + 0.25))
    r = math.hypot(x, y, z)
    shells = sum(max(0.0, 1 - abs(r - radius) / 0.03) for radius in (0.8, 0.92))
    return 255 * signal_ * min(max((0.7 - r) / 0.03, 0.0), 1.0) + 96 * shells


class Phantom(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def call(self, *arguments, **options):
        return subprocess.run([PHANTOM, *arguments], cwd=self.folder, capture_output=True, text=True, check=False,
                              **options)

    def check_bytes(self, edge):
        result = self.call(str(edge), "a.nrrd")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        with open(self.path("a.nrrd"), "rb") as stream:
            data = stream.read()
        header = HEADER.format(edge).encode()
        self.assertEqual(data[:len(header)], header)
        voxels = data[len(header):]
        self.assertEqual(len(voxels), edge**3)
        places = [-1 + 2 * i / (edge - 1) for i in range(edge)]
        expected = (closed_form(x, y, z) for z in places for y in places for x in places)
        for index, (byte, value) in enumerate(zip(voxels, expected)):
            if abs(byte - value) > 0.5 + 1e-9:
                self.fail(f"voxel {index} of {edge}^3 is {byte}, not {value}")
        return voxels

    def test_the_bytes_are_those_of_the_closed_form(self):
        voxels = self.check_bytes(41)
        self.assertGreater(max(voxels), 220)
        self.assertGreater(voxels.count(0), len(voxels) // 3)  # empty space to skip

    def test_the_smallest_edges(self):
        for edge in (2, 3):
            self.check_bytes(edge)

    def test_an_old_file_is_replaced(self):
        with open(self.path("a.nrrd"), "w", encoding="utf-8") as stream:
            stream.write("old")
        self.check_bytes(5)
        self.assertEqual(os.listdir(self.folder), ["a.nrrd"])

    def test_bad_arguments_are_status_2(self):
        for arguments in ((), ("8",), ("8", ""), ("8", "a.nrrd", "b"), ("1", "a.nrrd"), ("0", "a.nrrd"), ("-8", "a.nrrd"),
                          ("8193", "a.nrrd"), ("99999999999999999999", "a.nrrd"), ("8x", "a.nrrd"), ("x", "a.nrrd"),
                          ("8.5", "a.nrrd"), ("", "a.nrrd")):
            with self.subTest(arguments=arguments):
                result = self.call(*arguments)
                self.assertEqual((result.returncode, result.stdout, result.stderr), (2, "", USAGE))
                self.assertEqual(os.listdir(self.folder), [])

    def test_a_folder_that_does_not_exist(self):
        result = self.call("8", "none/a.nrrd")
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("none/a.nrrd: cannot be written: No such file", result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_folder_in_the_place_of_the_file(self):
        os.mkdir(self.path("a.nrrd"))
        self.assertEqual(self.call("8", "a.nrrd").returncode, 1)
        self.assertEqual(os.listdir(self.folder), ["a.nrrd"])

    def test_a_full_disk_leaves_nothing_and_the_old_file(self):
        with open(self.path("a.nrrd"), "w", encoding="utf-8") as stream:
            stream.write("old")
        for limit in (0, 5000):
            bound = (limit, limit)
            result = self.call("64", "a.nrrd", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, bound))
            self.assertEqual((result.returncode, result.stdout), (1, ""))
            self.assertIn("a.nrrd: cannot be written: File too large", result.stderr)
            self.assertEqual(os.listdir(self.folder), ["a.nrrd"])
        with open(self.path("a.nrrd"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "old")

    def test_a_user_who_ends_it_finds_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([PHANTOM, "2000", "a.nrrd"], cwd=self.folder, stderr=subprocess.PIPE) as process:
                deadline = time.monotonic() + 20
                while not os.listdir(self.folder) and time.monotonic() < deadline:
                    time.sleep(0.01)
                self.assertEqual(len(os.listdir(self.folder)), 1, "nothing was begun")
                process.send_signal(number)
                process.wait(timeout=60)
                self.assertEqual(process.returncode, -number)
            self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    PHANTOM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
