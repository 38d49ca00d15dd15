#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_docs.py SOURCE METAMER: the documents tell the truth as far as a program can see: links lead somewhere, the
example scene is read, every key that the readers know and every subcommand is described."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

METAMER = pathlib.Path(sys.argv.pop()).resolve()
SOURCE = pathlib.Path(sys.argv.pop()).resolve()
SCENE_MANUAL = (SOURCE / "docs/scene.md").read_text(encoding="utf-8")
DESIGN_MANUAL = (SOURCE / "docs/design.md").read_text(encoding="utf-8")
FILES_MANUAL = (SOURCE / "docs/files.md").read_text(encoding="utf-8")


def documents():
    for folder in (".", "docs", "examples", "data"):
        pattern = "*.md" if folder in (".", "docs") else "**/*.md"
        yield from (SOURCE / folder).glob(pattern)


def info(path):
    done = subprocess.run([METAMER, "info", "--json", path], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def keys_of(document):
    """Of the objects in a document, however deep."""
    if isinstance(document, list):
        return set().union(*map(keys_of, document))
    return set(document).union(*map(keys_of, document.values())) if isinstance(document, dict) else set()


class Docs(unittest.TestCase):
    def test_links_lead_to_files(self):
        for document in documents():
            for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", document.read_text(encoding="utf-8")):
                if "://" not in target:
                    self.assertTrue((document.parent / target).exists(), f"{document.name}: {target}")

    def test_the_example_scene_is_read(self):
        examples = re.findall(r"<!-- test: scene -->\n```json\n(.*?)```", SCENE_MANUAL, re.DOTALL)
        self.assertEqual(len(examples), 1)
        with tempfile.TemporaryDirectory() as folder:
            for table, column in (("reflectances.csv", "block"), ("lights.csv", "light 2")):
                text = f"wavelength_nm,{column}\n380,0.2\n780,0.8\n"
                pathlib.Path(folder, table).write_text(text, encoding="utf-8")
            path = pathlib.Path(folder, "example.json")
            path.write_text(examples[0], encoding="utf-8")
            status, output, message = info(path)
            self.assertEqual((status, message), (0, ""))
            self.assertEqual(json.loads(output)["kind"], "scene")

    def test_every_key_of_the_readers_is_described(self):
        described = set(re.findall(r'[`"]([a-z0-9_]+)[`"]', SCENE_MANUAL))
        for name in ("src/scene/read.c", "src/scene/read_lights.c", "src/scene/read_observer.c", "src/palette/json.c"):
            text = (SOURCE / name).read_text(encoding="utf-8")
            lists = re.findall(r"(?:keys|reserved|names|blends|whites)\[\] = \{(.*?)\};", text, re.DOTALL)
            self.assertGreater(len(lists), 2)
            for key in re.findall(r'"([^"]+)"', " ".join(lists)):
                self.assertIn(key, described, f"{key} of {name}")

    def test_every_key_of_the_goals_document_and_every_recipe_is_described(self):
        described = set(re.findall(r"`([a-z0-9_ ]+)`", DESIGN_MANUAL))
        for name, least in (("goals_read.c", 18), ("goals_cells.c", 11), ("recipes.c", 18), ("recipes_figures.c", 10)):
            text = (SOURCE / "src/palette" / name).read_text(encoding="utf-8")
            lists = re.findall(r"(?:keys\[\]|\.materials|\.lights) = \{(.*?)\}[;,]\n", text, re.DOTALL)
            lists += re.findall(r" recipes\[\] = \{(.*?)\n\};", text, re.DOTALL)
            keys = set(re.findall(r'"([a-z0-9_ ]+)"', " ".join(lists)))
            self.assertGreaterEqual(len(keys), least, name)
            for key in keys:
                self.assertIn(key, described, f"{key} of {name}")

    def test_the_colors_of_the_figures_are_those_of_the_recipes(self):
        text = (SOURCE / "src/palette/recipes_figures.c").read_text(encoding="utf-8")
        figures = re.findall(r"mtm_figure_(\d) = \{\s*\.materials = \{(.*?)\},\s*\.colors = \{(.*?)\},", text, re.DOTALL)
        self.assertEqual(len(figures), 4)
        for number, names, colors in figures:
            row = re.search(rf"^\| {number} \| (.*) \|$", DESIGN_MANUAL, re.MULTILINE).group(1)
            expected = dict(zip(re.findall(r'"(.*?)"', names), re.findall(r'"(.*?)"', colors)))
            self.assertEqual(dict(re.findall(r"`([a-z]+)` (#[0-9a-f]+)", row)), expected)

    def test_the_renderers_and_bases_described_are_those_there_are(self):
        text = (SOURCE / "src/render").glob("*.c")
        names = re.findall(r'\.name = "([a-z-]+)"', " ".join(path.read_text(encoding="utf-8") for path in text))
        text = (SOURCE / "src/basis").glob("*.c")
        names += re.findall(r'\.name = "([a-z-]+)"', " ".join(path.read_text(encoding="utf-8") for path in text))
        self.assertGreater(len(names), 3)
        for name in names:
            self.assertIn(f"`{name}`", SCENE_MANUAL)

    def test_info_prints_the_keys_that_are_described(self):
        for path in ("examples/engine/engine.json", "examples/engine/engine.palette.json",
                     "examples/engine/engine.nrrd", "data/spectra/lights_xenon.csv", "docs/pictures/engine-lights.png"):
            status, output, message = info(SOURCE / path)
            self.assertEqual((status, message), (0, ""))
            facts = json.loads(output)
            row = re.search(rf"^\| `{facts['kind']}` \| (.*) \|$", FILES_MANUAL, re.MULTILINE)
            self.assertIsNotNone(row, facts["kind"])
            described = set(re.findall(r"`([a-z0-9_]+)`", row.group(1)))
            self.assertEqual(set(facts) - {"kind", "file"}, described, path)

    def test_color_prints_the_keys_that_are_described(self):
        table = SOURCE / "data/spectra/reflectance_colorchecker_ohta.csv"
        printed = set()
        for options in (["--through=cyan", "--basis=factors:7"],
                        ["--observer", SOURCE / "data/spectra/camera_nikon_d5100.csv"]):
            done = subprocess.run([METAMER, "color", table, "--json", *options], capture_output=True, check=True)
            printed |= keys_of(json.loads(done.stdout))
        section = FILES_MANUAL.split("## `metamer color")[1].split("\n## ")[0]
        rows = re.findall(r"^\| (`.*?) \| (.*) \|$", section, re.MULTILINE)
        inner = next(text for keys, text in rows if keys == "`light`")
        described = re.findall(r"`([a-z_]+)`", " ".join([inner, *(keys for keys, _ in rows)]))
        self.assertEqual(printed, set(described))

    def test_every_subcommand_is_in_the_readme_and_has_help(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        overview = subprocess.run([METAMER, "--help"], capture_output=True, text=True, check=True).stdout
        names = re.findall(r"^  ([a-z]+) ", overview, re.MULTILINE)
        self.assertGreater(len(names), 4)
        for name in names:
            self.assertIn(f"metamer {name}", readme)
            subprocess.run([METAMER, name, "--help"], capture_output=True, check=True)

    def test_the_make_words_are_described(self):
        contributing = (SOURCE / "CONTRIBUTING.md").read_text(encoding="utf-8")
        for word in re.findall(r"^([a-z]+):.*##", (SOURCE / "Makefile").read_text(encoding="utf-8"), re.MULTILINE):
            if word != "help":
                self.assertIn(f"make {word}", contributing)


if __name__ == "__main__":
    unittest.main()
