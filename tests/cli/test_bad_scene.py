# SPDX-License-Identifier: BSD-3-Clause
"""Scene documents that are wrong: every key with a value of the wrong type and out of its range, unknown keys at every
level, names that nothing has. Each is one sentence that names the file, the key and what was expected."""
import json

import support

LONG = "n" * 64

# Where in the document, the bad value, what the message must say. Keys are joined with dots, [i] is an element.
BAD = [
    ("metamer", "1", ["metamer", "\"1\""]), ("metamer", 2, ["version 2", "version 1"]),
    ("volume", 5, ["volume is 5", "an object"]), ("volume", None, ["volume", "object"]),
    ("volume.file", 5, ["volume.file is 5", "text"]), ("volume.file", "", ["volume.file", "not empty"]),
    ("volume.size", [14, 12], ["volume.size", "3 numbers"]), ("volume.size", 5, ["volume.size", "3 numbers"]),
    ("volume.size", [14, 12, 0], ["volume.size[2] is 0"]), ("volume.size", [14, "x", 1], ["volume.size[1]"]),
    ("volume.size", [14.5, 12, 10], ["volume.size[0] is 14.5", "whole"]),
    ("volume.sha256", 5, ["volume.sha256"]), ("volume.sha256", "12ab", ["volume.sha256", "12ab", "64"]),
    ("volume.sha256", "Z" * 64, ["volume.sha256", "hexadecimal"]),
    ("palette", 5, ["palette is 5", "object"]), ("palette", {}, ["palette", "light"]),
    ("palette.file", "p.json", ["palette.file", "one or the other"]),
    ("palette", {"file": 5}, ["palette.file is 5", "text"]),
    ("palette", {"file": "missing.palette.json"}, ["palette.file", "missing.palette.json"]),
    ("palette.materials", 5, ["palette.materials", "array"]),
    ("palette.materials[0]", 5, ["palette.materials[0] is 5", "object"]),
    ("palette.materials[0].name", 5, ["palette.materials[0].name is 5", "text"]),
    ("palette.materials[0].name", "", ["palette.materials[0].name"]),
    ("palette.materials[0].name", LONG, ["palette.materials[0].name", "64 bytes", "63"]),
    ("palette.materials[1].name", "haze", ["palette.materials[1].name", "\"haze\"", "earlier"]),
    ("palette.materials[0].srgb", 5, ["palette.materials[0].srgb is 5", "text"]),
    ("palette.materials[0].srgb", "blue", ["palette.materials[0].srgb", "blue"]),
    ("palette.materials[0].srgb", "#12345", ["palette.materials[0].srgb", "#12345"]),
    ("palette.materials[0].srgb", "#12345g", ["palette.materials[0].srgb", "#12345g"]),
    ("palette.materials[0].values", [1] * 81, ["palette.materials[0].", "exactly one source"]),
    ("palette.materials[0]", {"name": "haze"}, ["palette.materials[0]", "spectrum"]),
    ("palette.materials[0]", {"srgb": "#808080"}, ["palette.materials[0].name is missing"]),
    ("palette.materials[0]", {"name": "haze", "illuminant": "A"}, ["palette.materials[0].illuminant", "reflectance"]),
    ("palette.materials[0]", {"name": "haze", "blackbody": 3000}, ["palette.materials[0].blackbody", "reflectance"]),
    ("palette.materials[0]", {"name": "haze", "daylight": 6500}, ["palette.materials[0].daylight", "reflectance"]),
    ("palette.materials[0]", {"name": "haze", "values": [1] * 80}, ["palette.materials[0].values", "81"]),
    ("palette.materials[0]", {"name": "haze", "values": [1] * 80 + ["x"]}, ["palette.materials[0].values[80]"]),
    ("palette.materials[0]", {"name": "haze", "values": 1}, ["palette.materials[0].values", "81"]),
    ("palette.materials[0]", {"name": "haze", "spectrum": 5}, ["palette.materials[0].spectrum is 5"]),
    ("palette.materials[0]", {"name": "haze", "spectrum": "s.csv"}, ["palette.materials[0].spectrum", "s.csv"]),
    ("palette.materials[0]", {"name": "haze", "spectrum": "no.csv:red"}, ["palette.materials[0].spectrum", "no.csv"]),
    ("palette.materials[0]", {"name": "haze", "spectrum": "s.csv:rad"}, ["s.csv", "rad", "red"]),
    ("palette.materials[0]", {"name": "haze", "spectrum": "nan.csv:red"}, ["nan.csv:3", "nan"]),
    ("palette.materials[0]", {"name": "haze", "spectrum": "blob.nrrd:red"}, ["blob.nrrd"]),
    ("palette.lights", 5, ["palette.lights", "array"]), ("palette.lights", [], ["palette", "light"]),
    ("palette.lights[0]", 5, ["palette.lights[0] is 5", "object"]),
    ("palette.lights[0].name", 5, ["palette.lights[0].name is 5"]),
    ("palette.lights[0].name", LONG, ["palette.lights[0].name", "63"]),
    ("palette.lights[1].name", "day", ["palette.lights[1].name", "\"day\"", "earlier"]),
    ("palette.lights[0].illuminant", 5, ["palette.lights[0].illuminant is 5"]),
    ("palette.lights[0].illuminant", "D66", ["palette.lights[0].illuminant", "D66", "D65"]),
    ("palette.lights[0].through", "haze", ["palette.lights[0].through", "array"]),
    ("palette.lights[0].through", ["shall"], ["palette.lights[0].through", "\"shall\""]),
    ("palette.lights[0].through", [5], ["palette.lights[0].through", "5"]),
    ("palette.lights[0].blackbody", 3000, ["palette.lights[0].", "exactly one source"]),
    ("palette.lights[0]", {"name": "day"}, ["palette.lights[0]", "spectrum"]),
    ("palette.lights[0]", {"name": "day", "blackbody": "hot"}, ["palette.lights[0].blackbody is \"hot\"", "number"]),
    ("palette.lights[0]", {"name": "day", "blackbody": -5}, ["palette.lights[0].blackbody", "-5"]),
    ("palette.lights[0]", {"name": "day", "daylight": 100}, ["palette.lights[0].daylight", "100"]),
    ("palette.lights[0]", {"name": "day", "daylight": []}, ["palette.lights[0].daylight is []"]),
    ("palette.lights[0]", {"name": "day", "srgb": "#000000"}, ["palette.lights[0]", "light"]),
    ("palette.lights[0]", {"name": "day", "srgb": 1}, ["palette.lights[0].srgb is 1"]),
    ("palette.lights[0]", {"name": "day", "values": [0] * 81}, ["palette.lights[0]", "light"]),
    ("palette.lights[0]", {"name": "day", "values": [-1] * 81}, ["palette.lights[0]", "light"]),
    ("palette.lights[0]", {"name": "day", "spectrum": "s.csv:rad"}, ["palette.lights[0].spectrum", "rad"]),
    ("transfer", 5, ["transfer is 5", "object"]),
    ("transfer.opacity_length", "x", ["transfer.opacity_length is \"x\"", "number"]),
    ("transfer.opacity_length", 0, ["transfer.opacity_length is 0"]),
    ("transfer.opacity_length", -1, ["transfer.opacity_length is -1"]),
    ("transfer.points", 5, ["transfer.points", "array"]), ("transfer.points", [], ["transfer.points", "1"]),
    ("transfer.points[1]", 5, ["transfer.points[1] is 5", "object"]),
    ("transfer.points[1]", {"opacity": 1, "material": "haze"}, ["transfer.points[1].value is missing"]),
    ("transfer.points[1]", {"value": 100, "material": "haze"}, ["transfer.points[1].opacity is missing"]),
    ("transfer.points[1]", {"value": 100, "opacity": 1}, ["transfer.points[1].material is missing"]),
    ("transfer.points[1].value", "x", ["transfer.points[1].value is \"x\"", "number"]),
    ("transfer.points[1].value", 10, ["transfer.points[1].value is 10", "rise"]),
    ("transfer.points[1].opacity", "x", ["transfer.points[1].opacity is \"x\""]),
    ("transfer.points[1].opacity", -0.1, ["transfer.points[1].opacity is -0.1", "from 0 to 1"]),
    ("transfer.points[1].opacity", 1.5, ["transfer.points[1].opacity is 1.5", "from 0 to 1"]),
    ("transfer.points[1].emission", "x", ["transfer.points[1].emission is \"x\""]),
    ("transfer.points[1].emission", -1, ["transfer.points[1].emission is -1"]),
    ("transfer.points[1].material", 5, ["transfer.points[1].material is 5"]),
    ("transfer.points[1].material", "shall", ["transfer.points[1].material is \"shall\"", "\"shell\""]),
    ("camera", [], ["camera is []", "object"]),
    ("camera.azimuth", "x", ["camera.azimuth is \"x\"", "number"]),
    ("camera.elevation", True, ["camera.elevation is true", "number"]),
    ("camera.distance", 0, ["camera.distance is 0"]), ("camera.distance", "far", ["camera.distance is \"far\""]),
    ("camera.target", [1, 2], ["camera.target is [1,2]", "3 numbers"]),
    ("camera.target", [1, 2, "x"], ["camera.target[2] is \"x\""]),
    ("camera.up", [0, 0, 0], ["camera.up", "nowhere"]), ("camera.up", 1, ["camera.up is 1", "3 numbers"]),
    ("camera.fov", 176, ["camera.fov is 176", "from 0 to 175"]), ("camera.fov", -1, ["camera.fov is -1"]),
    ("camera.fov", "x", ["camera.fov is \"x\""]),
    ("camera.height", -1, ["camera.height is -1"]), ("camera.height", "x", ["camera.height is \"x\""]),
    ("shading", 5, ["shading is 5", "object"]),
    ("shading.ambient", -1, ["shading.ambient is -1"]), ("shading.ambient", "x", ["shading.ambient"]),
    ("shading.diffuse", -1, ["shading.diffuse is -1"]), ("shading.diffuse", "x", ["shading.diffuse"]),
    ("shading.specular", -1, ["shading.specular is -1"]), ("shading.specular", "x", ["shading.specular"]),
    ("shading.shininess", -1, ["shading.shininess is -1"]), ("shading.shininess", "x", ["shading.shininess"]),
    ("shading.direction", "lamp", ["shading.direction is \"lamp\"", "headlight"]),
    ("shading.direction", 5, ["shading.direction is 5"]), ("shading.direction", [1, 2], ["shading.direction"]),
    ("shading.direction", [0, 0, 0], ["shading.direction", "nowhere"]),
    ("shading.gradient_threshold", -1, ["shading.gradient_threshold is -1"]),
    ("shading.gradient_threshold", "x", ["shading.gradient_threshold is \"x\""]),
    ("clip", 5, ["clip is 5", "object"]), ("clip", {}, ["clip.box is missing"]),
    ("clip.box", 5, ["clip.box", "corners"]), ("clip.box", [[0, 0, 0]], ["clip.box", "corners"]),
    ("clip.box[0]", [0, 0], ["clip.box[0]", "3 numbers"]), ("clip.box[1]", 5, ["clip.box[1] is 5"]),
    ("clip.box[1]", [1, 1, 1.5], ["clip.box[1][2] is 1.5", "from 0 to 1"]),
    ("clip.box[0]", [1, 0, 0], ["clip.box", "axis 0"]),
    ("transfer.points[0].emission", 1e7, ["emission is 1", "from 0 to 1e+06"]),
    ("lights.intensity", 1e40, ["intensity", "1e+06"]),
    ("background", 5, ["background is 5", "object"]), ("background", {}, ["background", "srgb", "material"]),
    ("background.srgb", 5, ["background.srgb is 5"]), ("background.srgb", "blue", ["background.srgb", "blue"]),
    ("background.material", "haze", ["background", "either"]),
    ("background", {"material": 5}, ["background.material is 5"]),
    ("background", {"material": "shall"}, ["background.material is \"shall\"", "\"shell\""]),
    ("render", 5, ["render is 5", "object"]),
    ("render.renderer", 5, ["render.renderer is 5"]),
    ("render.renderer", "ray", ["render.renderer is \"ray\"", "raycast"]),
    ("render.basis", 5, ["render.basis is 5"]), ("render.basis", "rbg", ["render.basis", "rbg", "rgb"]),
    ("render.basis", "materials:3", ["render.basis", "materials:3"]),
    ("render.size", 5, ["render.size is 5", "2 numbers"]), ("render.size", [40], ["render.size", "2 numbers"]),
    ("render.size", [0, 40], ["render.size[0] is 0"]), ("render.size", [40, 40000], ["render.size[1] is 40000"]),
    ("render.size", [40.5, 33], ["render.size[0] is 40.5", "whole"]),
    ("render.step", 0, ["render.step is 0"]), ("render.step", "x", ["render.step is \"x\""]),
    ("render.blend", "mix", ["render.blend is \"mix\"", "\"sum\""]), ("render.blend", 1, ["render.blend is 1"]),
    ("render.jitter", 1, ["render.jitter is 1", "true or false"]),
    ("render.termination", -1, ["render.termination is -1"]), ("render.termination", 2, ["render.termination is 2"]),
    ("render.termination", "x", ["render.termination is \"x\""]),
    ("observer", 5, ["observer is 5", "name or an object"]), ("observer", "cie1932", ["observer", "cie1932", "cie1931"]),
    ("observer", {"file": "missing.csv"}, ["observer.file", "missing.csv"]),
    ("observer", {"name": "eye", "x": [1, 2]}, ["observer.x is [1,2]", "81 numbers"]),
    ("observer", {"name": "eye", "r": [0] * 81, "g": [0] * 81, "b": [0] * 81}, ["observer", "curve r has the sum 0"]),
    ("white", "d65", ["white is \"d65\"", "\"light\""]), ("white", 5, ["white is 5"]),
    ("lights", 5, ["lights is 5", "object"]),
    ("lights.weights", 5, ["lights.weights", "object"]),
    ("lights.weights.lamp", "x", ["lights.weights.lamp is \"x\"", "number"]),
    ("lights.weights.lamp", -1, ["lights.weights.lamp is -1"]),
    ("lights.weights.lamb", 1, ["lights.weights.lamb", "\"lamp\""]),
    ("lights.intensity", -1, ["lights.intensity is -1"]), ("lights.intensity", "x", ["lights.intensity"]),
    ("lights.dial", 5, ["lights.dial is 5", "object"]),
    ("lights.dial.dot", [1], ["lights.dial.dot", "2 numbers"]),
    ("lights.dial.dot", ["x", 1], ["lights.dial.dot[0]"]),
    ("lights.dial.bulbs", 5, ["lights.dial.bulbs", "object"]),
    ("lights.dial.bulbs.lamb", {"at": [0, 0]}, ["lights.dial.bulbs.lamb", "\"lamp\""]),
    ("lights.dial.bulbs.day", 5, ["lights.dial.bulbs.day is 5", "object"]),
    ("lights.dial.bulbs.day", {}, ["lights.dial.bulbs.day.at is missing"]),
    ("lights.dial.bulbs.day.at", [1], ["lights.dial.bulbs.day.at", "2 numbers"]),
    ("lights.dial.bulbs.day.on", 1, ["lights.dial.bulbs.day.on is 1", "true or false"]),
    ("lights.stops", 5, ["lights.stops", "array"]),
    ("lights.stops[0]", 5, ["lights.stops[0] is 5", "object"]),
    ("lights.stops[0]", {"weights": {}}, ["lights.stops[0].name is missing"]),
    ("lights.stops[0]", {"name": "evening"}, ["lights.stops[0].weights is missing"]),
    ("lights.stops[0].name", 5, ["lights.stops[0].name is 5"]),
    ("lights.stops[0].name", LONG, ["lights.stops[0].name", "63"]),
    ("lights.stops", [{"name": "a", "weights": {}}, {"name": "a", "weights": {}}], ["lights.stops[1].name", "earlier"]),
    ("lights.stops[0].weights", {"lamb": 1}, ["lights.stops[0].weights.lamb", "\"lamp\""]),
    ("lights.stops[0].weights", 5, ["lights.stops[0].weights", "object"]),
    ("lights.stops[0].intensity", -1, ["lights.stops[0].intensity is -1"]),
    ("lights.stops[0].dial", 5, ["lights.stops[0].dial is 5"]),
    ("lights.stops[0].dial.dot", 5, ["lights.stops[0].dial.dot is 5"]),
]

# Every object of the document, a misspelt key of it and the key that was meant.
MISSPELT = [
    ("", "camara", "camera"), ("volume", "flie", "file"), ("palette", "material", "materials"),
    ("palette.materials[0]", "srbg", "srgb"), ("palette.lights[0]", "blackbodi", "blackbody"),
    ("transfer", "opacity_lenght", "opacity_length"), ("transfer.points[0]", "emision", "emission"),
    ("camera", "azimut", "azimuth"), ("shading", "ambiant", "ambient"), ("clip", "boxes", "box"),
    ("background", "sgrb", "srgb"), ("render", "steps", "step"), ("lights", "weight", "weights"),
    ("lights.dial", "dots", "dot"), ("lights.dial.bulbs.day", "onn", "on"), ("lights.stops[0]", "nam", "name"),
    ("lights.stops[0].dial", "bulb", "bulbs"),
]

REQUIRED = ["volume", "volume.file", "transfer", "transfer.points"]


def steps_of(path):
    return [int(step[:-1]) if step.endswith("]") else step
            for step in path.replace("[", ".[").replace("[", "").split(".") if step]


def put(document, path, value):
    *parents, last = steps_of(path)
    for step in parents:
        document = document[step]
    document[last] = value


def remove(document, path):
    *parents, last = steps_of(path)
    for step in parents:
        document = document[step]
    del document[last]


class BadScene(support.CliTest):
    def setUp(self):
        super().setUp()
        self.write_text("s.csv", "wavelength_nm,red,green\n400,0,1\n500,0.5,0.5\n600,1,0\n")
        self.write_text("nan.csv", "wavelength_nm,red\n400,0\n500,nan\n600,1\n")

    def refuse_scene(self, document, texts):
        self.write_json("scene.json", document)
        return self.refuse("render", "scene.json", "-o", "out.png", texts=["scene.json", *texts])

    def test_the_good_scene_is_good(self):
        self.write_json("scene.json", support.make_scene())
        self.succeed("render", "scene.json", "-o", "out.png")

    def test_every_key_with_a_bad_value(self):
        for path, value, texts in BAD:
            with self.subTest(path=path, value=value):
                document = support.make_scene()
                put(document, path, value)
                self.refuse_scene(document, texts)

    def test_the_table_knows_every_key(self):
        """Each key of the good document, and so each that the next reader adds to it, has a row."""
        def keys_of(value, path):
            if isinstance(value, dict):
                for key, member in value.items():
                    inner = f"{path}.{key}" if path else key
                    yield inner
                    yield from keys_of(member, inner)
            elif isinstance(value, list) and value and isinstance(value[0], dict):
                yield from keys_of(value[0], f"{path}[]")
        rows = {path.replace("[0]", "[]").replace("[1]", "[]") for path, _, _ in BAD}
        known = {path for path in keys_of(support.make_scene(), "")}
        untested = {k for k in known - rows if not k.startswith(("lights.stops[].weights.", "lights.stops[].dial.",
                                                                 "lights.weights.day"))}
        self.assertEqual(untested, set())

    def test_misspelt_keys_at_every_level(self):
        for path, key, meant in MISSPELT:
            with self.subTest(path=path, key=key):
                document = support.make_scene()
                inner = document
                for step in steps_of(path):
                    inner = inner[step]
                inner[key] = 1
                self.refuse_scene(document, [f"{path}.{key}" if path else key, f"\"{meant}\""])

    def test_required_keys(self):
        for path in REQUIRED:
            document = support.make_scene()
            remove(document, path)
            self.refuse_scene(document, [path, "missing"])

    def test_reserved_keys(self):
        for key in ("labels", "channels", "animation", "positions"):
            document = support.make_scene()
            document[key] = {}
            self.refuse_scene(document, [key, "not supported yet"])

    def test_documents_that_are_no_json(self):
        good = json.dumps(support.make_scene(), indent=1)
        cases = [(good.replace("\"white\": \"none\"", "\"white\" \"none\""), "scene.json:"), (good[:len(good) // 2], "scene.json:"),
                 (good + "}", "scene.json:"), ("[]", "object"), ("{\"volume\": {}, \"volume\": {}}", "scene.json:1"),
                 (good.replace("0.7", "NaN"), "scene.json:"), (good.replace("0.7", "1e999"), "scene.json:"),
                 ("", "scene.json"), ("[" * 100000, "scene.json:1"), ("{\"metamer\": \"\\u0000\"}", "scene.json:1"),
                 ("5", "scene.json:1"), ("null", "scene.json:1")]
        for text, expected in cases:
            with self.subTest(text=text[:40]):
                self.write_text("scene.json", text)
                self.refuse("render", "scene.json", "-o", "out.png", texts=["scene.json", expected])

    def test_the_line_of_a_syntax_error_is_named(self):
        self.write_text("scene.json", "{\n \"metamer\": 1,\n \"volume\" 5\n}\n")
        self.refuse("render", "scene.json", "-o", "out.png", texts=["scene.json:3"])

    def test_a_document_that_is_no_text(self):
        with open(self.path("scene.json"), "wb") as stream:
            stream.write(b"{\"metamer\": \"\xff\xfe\"}")
        self.refuse("render", "scene.json", "-o", "out.png", texts=["scene.json"])
        with open(self.path("scene.json"), "wb") as stream:
            stream.write(json.dumps(support.make_scene()).encode() + b"\0garbage")
        self.refuse("render", "scene.json", "-o", "out.png", texts=["scene.json"])

    def test_a_palette_in_a_file_is_checked_as_well(self):
        document = support.make_scene()
        document["palette"] = {"file": "p.json"}
        self.write_json("p.json", {"materials": support.MATERIALS, "lights": support.LIGHTS})
        self.write_json("scene.json", document)
        self.succeed("render", "scene.json", "-o", "good.png")
        for palette, texts in (({"materials": support.MATERIALS, "lights": []}, ["light"]),
                               ({"materials": [{"name": "haze", "srgb": "blue"}]}, ["materials[0].srgb", "blue"]),
                               ({"metamer": 2}, ["version 2"]), ({"light": []}, ["\"lights\""]), ([], ["object"])):
            self.write_json("p.json", palette)
            self.refuse_scene(document, ["palette", *texts])

    def test_messages_stay_short(self):
        document = support.make_scene()
        document["palette"]["materials"][0]["name"] = ["x" * 100000]
        self.assertLess(len(self.refuse_scene(document, ["palette.materials[0].name"])), 400)
        document = support.make_scene()
        document["k" * 100000] = 1
        self.assertLess(len(self.refuse_scene(document, [])), 1500)

    def test_extreme_values_that_are_allowed_do_no_harm(self):
        for path, value in (("camera.distance", 1e300), ("camera.distance", 1e-290), ("camera.azimuth", 1e300),
                            ("camera.target", [1e300, -1e300, 1e300]), ("camera.up", [1e-200, 0, 0]),
                            ("camera.up", [1e200, 1e200, 0]), ("camera.fov", 1e-300), ("camera.fov", 0),
                            ("camera.height", 1e300), ("transfer.opacity_length", 1e-290),
                            ("transfer.opacity_length", 1e300), ("transfer.points[2].emission", 1e300),
                            ("transfer.points[2].value", 1e308), ("transfer.points[0].value", -1e308),
                            ("shading.ambient", 1e300), ("shading.shininess", 1e300), ("shading.direction", [1e-200, 0, 0]),
                            ("lights.intensity", 1e300), ("lights.weights.lamp", 1e300), ("render.step", 1e6),
                            ("lights.intensity", 0)):
            with self.subTest(path=path, value=value):
                document = support.make_scene()
                put(document, path, value)
                self.write_json("scene.json", document)
                for output in ("out.png", "out.exr"):
                    result = self.call("render", "scene.json", "-o", output)
                    self.assertIn(result.returncode, (0, 1), result.stderr)
                    self.assertLessEqual(len(result.stderr.splitlines()), 1)
                    self.assertNotIn("runtime error", result.stderr)


if __name__ == "__main__":
    support.main()
