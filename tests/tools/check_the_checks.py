#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_the_checks.py TOOLS: the lint's own checks find what they are there to find, and pass what is good."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(sys.argv.pop()).resolve()


def run(tool, *arguments):
    done = subprocess.run([TOOLS / tool, *arguments], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


class CheckLayers(unittest.TestCase):
    def check(self, files):
        with tempfile.TemporaryDirectory() as root:
            for name, text in files.items():
                path = pathlib.Path(root, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return run("check_layers", root)

    def refuse(self, files, sentence):
        status, output = self.check(files)
        self.assertEqual(status, 1)
        self.assertIn(sentence, output)

    def test_own_and_earlier_stages_pass(self):
        status, output = self.check({
            "src/color/color.c": '#include "metamer/color.h"\n#include <png.h>\n#include "base/fail.h"\n',
            "include/metamer/color.h": '#include "metamer/spectrum.h"\n#include <stdint.h>\n',
            "cli/main.c": '#include "command.h"\n#include "metamer/metamer.h"\n',
            "cli/command.h": ""})
        self.assertEqual((status, output), (0, ""))

    def test_a_later_private_header_is_found(self):
        self.refuse({"src/color/a.c": '#include "base/fail.h"\n#include "scene/scene.h"\n'},
                    'a.c:2: "scene/scene.h" belongs to the stage scene, which comes after color')

    def test_a_later_public_header_is_found(self):
        self.refuse({"src/base/a.c": '# include "metamer/image.h"\n'}, "which comes after base")

    def test_all_of_metamer_is_refused_inside_the_library(self):
        self.refuse({"src/scene/a.c": '#include "metamer/metamer.h"\n'}, "is no header of a stage")

    def test_a_public_header_that_includes_a_later_one_is_found(self):
        self.refuse({"include/metamer/base.h": '#include "metamer/color.h"\n'}, "which comes after base")

    def test_a_public_header_that_includes_a_private_one_is_found(self):
        self.refuse({"include/metamer/color.h": '#include "base/fail.h"\n'}, "is private")

    def test_a_program_that_includes_a_private_header_is_found(self):
        for folder in ("cli", "server", "bench", "accuracy", "examples"):
            self.refuse({f"{folder}/a.c": '#include "base/fail.h"\n'}, "is neither a public header")

    def test_programs_share_what_includes_nothing_else(self):
        self.assertEqual(self.check({"cli/a.c": '#include "drawing/svg.h"\n', "drawing/svg.h": "",
                                     "drawing/svg.c": '#include "svg.h"\n'}), (0, ""))
        self.refuse({"drawing/svg.c": '#include "metamer/color.h"\n'}, "is no header of this folder")
        self.refuse({"src/color/a.c": '#include "drawing/svg.h"\n'}, "is no header of a stage")

    def test_a_folder_that_is_no_stage_is_found(self):
        self.refuse({"src/misc/a.c": ""}, "is in no stage")


class CheckText(unittest.TestCase):
    LICENCE = "/* SPDX-License-Identifier: BSD-3-Clause */\n"

    def check(self, text, name="a.c"):
        with tempfile.TemporaryDirectory() as root:
            path = pathlib.Path(root, name)
            path.write_text(text, encoding="utf-8")
            return run("check_text", path)

    def refuse(self, text, sentence, name="a.c"):
        status, output = self.check(text, name)
        self.assertEqual(status, 1)
        self.assertIn(sentence, output)

    def function(self, line_count):
        return self.LICENCE + "\nint f(void) {\n" + "    g();\n" * (line_count - 2) + "}\n"

    def test_good_text_passes(self):
        self.assertEqual(self.check(self.function(70)), (0, ""))

    def test_long_functions_are_found(self):
        self.refuse(self.function(71), "a.c:3: begins a function of 71 lines")

    def test_long_files_are_found(self):
        self.refuse(self.LICENCE + "\n" * 600, "has 601 lines")

    def test_tabs_blanks_and_missing_newlines_are_found(self):
        self.refuse(self.LICENCE + "\tint a;\n", "a.c:2: has a tab")
        self.refuse(self.LICENCE + "int a; \n", "a.c:2: ends with a blank")
        self.refuse(self.LICENCE + "int a;", "a.c:2: does not end with a newline")

    def test_a_missing_licence_is_found(self):
        self.refuse("int a;\n", "names no licence")

    def test_broken_python_is_found(self):
        self.refuse("# SPDX-License-Identifier: BSD-3-Clause\ndef f(:\n", "is no Python", "a.py")


if __name__ == "__main__":
    unittest.main()
