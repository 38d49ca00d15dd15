# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the command line share: running the program, small volumes and scenes, the pixels of pictures.
Every test program is called as: test_SUBJECT.py METAMER. Python's standard library only."""
import gzip
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import exr_file  # noqa: E402

METAMER = ""

# NRRD's word and struct's letter.
TYPES = {"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "int64": "q",
         "uint64": "Q", "float": "f", "double": "d"}

MATERIALS = [{"name": "haze", "srgb": "#4080d0"}, {"name": "shell", "srgb": "#e0a040"},
             {"name": "core", "srgb": "#f02818"}]
LIGHTS = [{"name": "day", "illuminant": "D65"}, {"name": "lamp", "illuminant": "A"},
          {"name": "tube", "illuminant": "FL11"}]


def blob(size=(14, 12, 10), shift=0.0):
    """Values 0..200 that fall off from the middle, x fastest."""
    def value(x, y, z):
        distance = math.dist((x, y, z), [(n - 1) / 2 + shift for n in size])
        return int(max(0, 200 - 30 * distance))
    return [value(x, y, z) for z in range(size[2]) for y in range(size[1]) for x in range(size[0])]


def write_nrrd(path, size=(14, 12, 10), values=None, type_="uint8", encoding="raw", endian="little", fields=()):
    values = blob(size) if values is None else values
    data = struct.pack(("<" if endian == "little" else ">") + f"{len(values)}{TYPES[type_]}", *values)
    lines = ["NRRD0004", f"type: {type_}", "dimension: 3", "sizes: " + " ".join(map(str, size)),
             f"encoding: {encoding}", f"endian: {endian}", *(fields or ["spacings: 1 1 1"]), "", ""]
    with open(path, "wb") as stream:
        stream.write("\n".join(lines).encode() + (gzip.compress(data) if encoding == "gzip" else data))


def make_scene(volume="blob.nrrd"):
    """A new scene document with every kind of key, small enough to render in a moment."""
    return json.loads(json.dumps({
        "metamer": 1,
        "volume": {"file": volume},
        "palette": {"materials": MATERIALS, "lights": LIGHTS},
        "transfer": {"opacity_length": 1.0,
                     "points": [{"value": 20, "opacity": 0, "material": "haze"},
                                {"value": 80, "opacity": 0.05, "material": "shell"},
                                {"value": 150, "opacity": 0.4, "emission": 0.3, "material": "core"}]},
        "camera": {"azimuth": 25, "elevation": 15, "distance": 30, "target": [6.5, 5.5, 4.5], "up": [0, 1, 0],
                   "fov": 30, "height": 0},
        "shading": {"ambient": 0.3, "diffuse": 0.7, "specular": 0.2, "shininess": 20, "direction": [1, 1, 1],
                    "gradient_threshold": 0.01},
        "clip": {"box": [[0, 0, 0], [1, 1, 0.9]]},
        "background": {"srgb": "#203040"},
        "render": {"renderer": "raycast", "basis": "auto", "size": [40, 33], "step": 0.5, "blend": "composite",
                   "jitter": False, "termination": 0.001},
        "observer": "cie1931",
        "white": "none",
        "lights": {"weights": {"day": 0.7, "lamp": 0.3}, "intensity": 1.1,
                   "dial": {"dot": [0.1, 0.2], "bulbs": {"day": {"at": [0, 1], "on": True}}},
                   "stops": [{"name": "evening", "weights": {"lamp": 1}, "intensity": 0.8,
                              "dial": {"dot": [0, 0], "bulbs": {}}}]},
    }))


def read_bytes(path):
    with open(path, "rb") as stream:
        return stream.read()


def png_chunks(path):
    """(kind, body) of every chunk."""
    data = read_bytes(path)
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, chunks = 8, []
    while at < len(data):
        (size,) = struct.unpack_from(">I", data, at)
        chunks.append((data[at + 4:at + 8].decode(), data[at + 8:at + 8 + size]))
        at += size + 12
    return chunks


def embedded_scene(path):
    """The text of the chunk metamer.scene: keyword, 0, is compressed, method, language, 0, keyword, 0, text."""
    body = next(body for kind, body in png_chunks(path) if kind == "iTXt" and body.startswith(b"metamer.scene"))
    keyword, rest = body.split(b"\0", 1)
    text = rest[2:].split(b"\0", 2)[2]
    return (zlib.decompress(text) if rest[0] == 1 else text).decode()


def embed_scene(path, result, scene):
    """A copy of a PNG with another embedded scene."""
    with open(result, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n")
        for kind, body in png_chunks(path):
            if kind == "iTXt":
                body = b"metamer.scene\0\1\0\0\0" + zlib.compress(scene.encode())
            kind = kind.encode()
            crc = zlib.crc32(kind + body)
            stream.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", crc))


def png_color_type(path):
    """2 for RGB, 6 for RGB and alpha."""
    return png_chunks(path)[0][1][9]


def write_png(path, width, height, pixel=b"\x40\x80\xc0"):
    """A picture of one color that knows of no scene."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = (b"\0" + pixel * width) * height
    with open(path, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class CliTest(unittest.TestCase):
    """A test with a folder of its own, which holds blob.nrrd."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="metamer-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        write_nrrd(self.path("blob.nrrd"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def write_json(self, name, document):
        with open(self.path(name), "w", encoding="utf-8") as stream:
            json.dump(document, stream)
        return name

    def write_text(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as stream:
            stream.write(text)
        return name

    def listing(self):
        """Every file below the folder with its bytes."""
        found = {}
        for folder, folders, files in os.walk(self.folder):
            for name in folders:
                found[os.path.join(folder, name)] = None
            for name in files:
                path = os.path.join(folder, name)
                found[path] = read_bytes(path) if os.path.isfile(path) and not os.path.islink(path) else None
        return found

    def call(self, *arguments, env=None, **options):
        """Runs the program in the folder."""
        environment = {k: v for k, v in os.environ.items() if k != "METAMER_DATA"}
        environment.update(env or {})
        options.setdefault("stdout", subprocess.PIPE)
        words = [word if isinstance(word, bytes) else str(word) for word in arguments]
        return subprocess.run([METAMER, *words], cwd=self.folder, env=environment, timeout=120,
                              stderr=subprocess.PIPE, text=True, errors="replace", **options)

    def succeed(self, *arguments, **options):
        """Standard output of a run that must not complain."""
        result = self.call(*arguments, **options)
        self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        return result.stdout

    def json_of(self, *arguments, **options):
        return json.loads(self.succeed(*arguments, "--json", **options))

    def refuse(self, *arguments, texts=(), status=1, **options):
        """The run fails with one sentence that holds the texts, and leaves the folder as it was."""
        before = self.listing()
        result = self.call(*arguments, **options)
        self.assertEqual(result.returncode, status, f"{arguments}: {result.stderr}")
        self.assertEqual(result.stdout or "", "", arguments)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, f"{arguments}: {result.stderr}")
        self.assertTrue(lines[0].startswith("metamer"), lines[0])
        for text in texts:
            self.assertIn(text, lines[0], arguments)
        self.assertEqual(self.listing(), before, f"{arguments}: files appeared, went or changed")
        return lines[0]

    def make_comma_locale(self):
        """The locale "comma" in the folder (LOCPATH), if it can be made; localedef warns of the parts that its source
        leaves out."""
        program = shutil.which("localedef")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../comma.locale")
        words = ["-c", "-i", source, "-f", "ANSI_X3.4-1968", self.path("comma")]
        if program is not None:
            subprocess.run([program, *words], capture_output=True, check=False)
        return os.path.exists(self.path("comma/LC_NUMERIC"))

    def assert_same_bytes(self, a, b):
        self.assertTrue(read_bytes(self.path(a)) == read_bytes(self.path(b)), f"{a} and {b} differ")

    def assert_near(self, a, b, tolerance):
        error = self.json_of("compare", a, b)["max_error"]
        self.assertLessEqual(error, tolerance, f"{a} and {b}")


def main():
    """Runs the tests of the calling program; the last line tells how many."""
    global METAMER
    METAMER = os.path.abspath(sys.argv.pop(1))
    program = unittest.main(exit=False, verbosity=1)
    result = program.result
    failed = len(result.failures) + len(result.errors)
    for test, reason in result.skipped:
        print(f"skipped {test}: {reason}")
    print(f"{os.path.basename(sys.argv[0])}: {result.testsRun} tests, {failed} failed, {len(result.skipped)} skipped")
    sys.exit(1 if failed else 0)
