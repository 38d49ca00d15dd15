# SPDX-License-Identifier: BSD-3-Clause
"""How the program is called: help, version, exit status 0, 1 and 2."""
import support

COMMANDS = ("render", "relight", "info", "compare", "convert", "color", "bench")


class Usage(support.CliTest):
    def test_no_arguments_show_the_overview(self):
        result = self.call()
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        for command in COMMANDS:
            self.assertIn(command, result.stderr)

    def test_help_of_everything(self):
        for words in (["--help"], ["-h"], ["help"]):
            overview = self.succeed(*words)
            for command in COMMANDS:
                self.assertIn(command, overview)
        for command in COMMANDS:
            for word in ("--help", "-h"):
                self.assertTrue(self.succeed(command, word).startswith(f"usage: metamer {command}"))
            self.assertIn("options:", self.succeed(command, "anything", "--help"))

    def test_the_version_and_the_licence(self):
        text = self.succeed("--version")
        self.assertRegex(text, r"^metamer \d+\.\d+\.\d+\n")
        self.assertIn("BSD-3-Clause", text)

    def test_the_instruction_set_obeys_the_environment(self):
        self.assertRegex(self.succeed("--version"), r"\nInstruction set on this machine: (baseline|x86-64-v[34])\n$")
        lowered = self.succeed("--version", env={"METAMER_ISA": "baseline"})
        self.assertIn("machine: baseline\n", lowered)

    def test_bad_usage_is_one_line_and_status_2(self):
        for words, texts in (
                (["paint"], ["paint"]), (["--paint"], ["--paint"]), ([""], ["\"\""]),
                (["render"], ["render", "needed"]), (["render", "blob.nrrd"], ["-o"]),
                (["render", "-o", "a.png"], ["needed"]), (["render", "blob.nrrd", "-o"], ["-o"]),
                (["render", "blob.nrrd", "-o", "a.png", "x.json"], ["blob.nrrd", "x.json"]),
                (["render", "blob.nrrd", "-o", "a.png", "--sise", "4x4"], ["--sise"]),
                (["render", "blob.nrrd", "-o", "a.png", "--half=yes"], ["--half"]),
                (["render", "blob.nrrd", "-o", "a.png", "-x"], ["-x"]),
                (["relight"], ["needed"]), (["relight", "a.exr"], ["-o"]), (["relight", "a.exr", "b.exr"], ["b.exr"]),
                (["relight", "a.exr", "-o", "a.png", "--light", "lamp"], ["lamp", "NAME=WEIGHT"]),
                (["relight", "a.exr", "-o", "a.png", "--light", "a=1", "--stop", "b"], ["exclude"]),
                (["relight", "a.exr", "-o", "a.png", "--intensity", "-1"], ["--intensity", "-1"]),
                (["relight", "a.exr", "-o", "a.png", "--intensity", "nan"], ["--intensity", "nan"]),
                (["info"], ["needed"]), (["info", "a", "b"], ["a", "b"]), (["info", "a", "--jason"], ["--jason"]),
                (["compare"], ["two"]), (["compare", "a.png"], ["two"]), (["compare", "a", "b", "c"], ["c"]),
                (["compare", "a", "b", "--tolerance", "x"], ["--tolerance", "x"]),
                (["compare", "a", "b", "--tolerance"], ["--tolerance", "MAX_ERROR"]),
                (["convert"], ["needed"]), (["convert", "blob.nrrd"], ["-o"]),
                (["convert", "blob.nrrd", "-o", "a.nrrd", "--encoding", "zip"], ["zip", "gzip"]),
                (["convert", "blob.nrrd", "-o", "a.nrrd", "--endian", "middle"], ["middle", "little"])):
            self.refuse(*words, texts=texts, status=2)

    def test_bad_sizes_and_counts(self):
        for size in ("40", "40x", "x30", "0x30", "40x-1", "40x30x2", "40 x30", "1e2x30", "40000x30", "99999999999x1", ""):
            self.refuse("render", "blob.nrrd", "-o", "a.png", "--size", size, texts=["--size"], status=2)
        for threads in ("0", "-1", "1.5", "x", "", "2000", "inf"):
            self.refuse("render", "blob.nrrd", "-o", "a.png", "--threads", threads, texts=["--threads"], status=2)

    def test_bad_amounts_of_memory(self):
        for size in ("0", "0K", "-1", "+1", "1.5G", "1k", "1KB", "G", "1 G", " 1G", "1GG", "", "inf",
                     "16777216T", "17179869184G", "17592186044416M", "18014398509481984K", "18446744073709551616"):
            self.refuse("render", "blob.nrrd", "-o", "a.png", "--memory", size, texts=["--memory", f'"{size}"'], status=2)

    def test_unknown_names_are_failures(self):
        self.refuse("render", "blob.nrrd", "-o", "a.png", "--renderer", "ray", texts=["ray", "raycast"])
        self.refuse("render", "blob.nrrd", "-o", "a.png", "--basis", "rgbb", texts=["rgbb", "rgb"])
        self.refuse("render", "blob.nrrd", "-o", "a.png", "--basis", "x" * 100, texts=["xxx"])

    def test_values_may_stand_behind_an_equals_sign(self):
        self.succeed("render", "blob.nrrd", "-o=a.png", "--size=8x6")
        self.assertEqual(self.json_of("info", "a.png")["size"], [8, 6])

    def test_file_names_that_look_like_options(self):
        support.write_nrrd(self.path("-v.nrrd"))
        self.succeed("render", "-o", "a.png", "--size", "8x6", "--", "-v.nrrd")
        self.assertIn("uint8", self.succeed("info", "--", "-v.nrrd"))

    def test_results_that_cannot_be_printed(self):
        for words in (["--version"], ["--help"], ["info", "blob.nrrd"], ["info", "blob.nrrd", "--json"],
                      ["render", "--help"]):
            with open("/dev/full", "w", encoding="utf-8") as full:
                result = self.call(*words, stdout=full)
            self.assertEqual(result.returncode, 1, words)
            self.assertIn("standard output", result.stderr)


if __name__ == "__main__":
    support.main()
