# SPDX-License-Identifier: BSD-3-Clause
"""metamer bench: the form of what it prints, and what it does without volumes. No test looks at how long anything took."""
import json
import os
import re

import support

MANUAL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/files.md")

# Columns of every row; of those that end in _ms, _p95_ms and _spread_ms stand beside.
COLUMNS = {
    "frames": "frame fill spectral_raycast_ms rgb_raycast_ms spectral15_raycast_ms postilluminate_ms spectral_per_rgb "
              "spectral15_per_rgb project_per_relight prepare_ms classify_ms",
    "table1": "volume fill spectral_raycast_ms rgb_raycast_ms postilluminate_ms transfer_change_ms classify_ms "
              "spectral_per_rgb relight_per_project relight_per_transfer_change relight_per_classify spectral_splat_ms "
              "rgb_splat_ms splat_relight_ms fourier_prepare_ms fourier_ms fourier_relight_ms rgb_fourier_ms paper_fill "
              "paper_spectral_raycast_fps paper_postilluminate_fps paper_rgb_raycast_fps paper_spectral_splat_fps "
              "paper_rgb_splat_fps paper_fourier_fps paper_fourier_relight_fps paper_fourier_prepare_s",
    "kernels": "kernel width height lanes format isa threads postilluminate_ms gigabytes_per_s triad_gigabytes_per_s "
               "share_of_triad spectral_raycast_ms",
    "scaling": "varied value threads picture_edge volume_edge lanes fill raycast_ms postilluminate_ms classify_ms "
               "affine_r_squared",
    "ablation": "frame device isa spectral_raycast_ms per_everything prepare_ms classify_ms psnr_db",
    "design": "problem method threads documents goals failures solved everything_solved solved_basis ciede2000_median "
              "ciede2000_p95 ciede2000_worst ciede2000_basis_median ciede2000_basis_p95 ciede2000_basis_worst physical "
              "design_ms slowest_s",
}
NOT_THERE = {column for column in COLUMNS["table1"].split() if re.search("splat|fourier", column)
             and not column.startswith("paper")}


def keys_of(suite):
    keys = []
    for column in COLUMNS[suite].split():
        keys.append(column)
        if column.endswith("_ms"):
            keys += [column[:-3] + "_p95_ms", column[:-3] + "_spread_ms"]
    return keys


class Bench(support.CliTest):
    def setUp(self):
        super().setUp()
        support.write_nrrd(self.path("engine.nrrd"))
        self.data = {"METAMER_DATA": self.folder}

    def bench(self, suite, only, *options, env=None):
        """The document of a suite, in the right form."""
        document = self.json_of("bench", "--suite", suite, "--only", only, "--runs", 1, *options,
                                env=self.data if env is None else env)
        self.check_suite(document, suite)
        return document

    def check_suite(self, document, suite):
        self.assertEqual(set(document), {"suite", "size", "threads", "isa", "runs", "rows"})
        self.assertEqual((document["suite"], document["size"]), (suite, [512, 512]))
        self.assertGreaterEqual(document["threads"], 1)
        self.assertIn(document["isa"], ("baseline", "x86-64-v3", "x86-64-v4"))
        for row in document["rows"]:
            self.assertEqual(list(row), keys_of(suite))
            for key, value in row.items():
                if key.endswith("_ms") and value is not None:
                    self.assertGreaterEqual(value, 0, key)

    def check_timed(self, row, but=()):
        """Everything that is not in `but` has a value; the statistics of the times fit together."""
        self.assertEqual({key for key, value in row.items() if value is None}, set(but))
        for key in row:
            if key.endswith("_p95_ms") and row[key] is not None:
                self.assertLessEqual(row[key.replace("_p95", "")], row[key])
                self.assertLessEqual(row[key.replace("_p95", "_spread")], row[key])

    def check_ratio(self, row, ratio, numerator, denominator):
        expected = row[numerator] / row[denominator]
        self.assertAlmostEqual(row[ratio] / expected, 1, 4)

    def test_frames(self):
        document = self.bench("frames", "engine", "--threads", 1)
        self.assertEqual((document["threads"], document["runs"]), (1, 1))
        self.assertEqual([row["frame"] for row in document["rows"]], ["engine smoke", "engine solid"])
        for row in document["rows"]:
            self.check_timed(row)
            self.assertTrue(0 < row["fill"] < 1)
            self.check_ratio(row, "spectral_per_rgb", "spectral_raycast_ms", "rgb_raycast_ms")
            self.check_ratio(row, "spectral15_per_rgb", "spectral15_raycast_ms", "rgb_raycast_ms")
            self.check_ratio(row, "project_per_relight", "spectral_raycast_ms", "postilluminate_ms")

    def test_frames_of_another_size_and_classification(self):
        words = ("bench", "--suite", "frames", "--only", "engine solid", "--runs", 1, "--size", "64x48")
        for more in ((), ("--post-classified",)):
            document = self.json_of(*words, *more, env=self.data)
            self.assertEqual(document["size"], [64, 48])
            self.check_timed(document["rows"][0])

    def test_one_run_does_not_scatter_and_several_may(self):
        (row,) = self.bench("frames", "engine solid")["rows"]
        for key in row:
            if key.endswith("_spread_ms"):
                self.assertEqual(row[key], 0)
                self.assertEqual(row[key.replace("_spread", "_p95")], row[key.replace("_spread", "")])
        (row,) = self.bench("frames", "engine solid", "--runs", 3)["rows"]
        self.check_timed(row)
        self.assertGreater(row["spectral_raycast_spread_ms"], 0)

    def test_volumes_that_are_not_there_leave_their_rows_empty(self):
        result = self.call("bench", "--suite", "frames", "--only", "i", "--runs", 1, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(result.stdout)
        self.check_suite(document, "frames")
        rows = {row.pop("frame"): row for row in document["rows"]}
        self.assertEqual(set(rows), {"engine smoke", "engine solid", "neghip", "uncbrain", "bonsai", "aneurism"})
        self.assertEqual(len(result.stderr.splitlines()), 6)
        for file in ("engine.nrrd", "neghip.nrrd", "uncbrain.nrrd", "bonsai.nrrd", "aneurism.nrrd"):
            self.assertIn(file, result.stderr)
        for row in rows.values():
            self.assertEqual(set(row.values()), {None})

    def test_volumes_of_the_examples_are_found(self):
        self.write_example("engine.nrrd")
        (row,) = self.bench("frames", "engine solid", env={"METAMER_DATA": "/nonexistent::"})["rows"]
        self.check_timed(row)

    def test_voxels_that_are_not_bytes_leave_the_row_empty(self):
        support.write_nrrd(self.path("engine.nrrd"), type_="int16")
        result = self.call("bench", "--suite", "frames", "--only", "solid", "--json", env=self.data)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIsNone(json.loads(result.stdout)["rows"][0]["fill"])
        self.assertRegex(result.stderr, "^metamer bench: note: .*engine.nrrd.*int16.*\n$")

    def test_a_broken_volume_is_a_failure(self):
        self.write_text("engine.nrrd", "NRRD0004\ntype: none\n\n")
        self.refuse("bench", "--suite", "frames", "--only", "solid", texts=["engine.nrrd"], env=self.data)

    def write_example(self, volume):
        """The scene examples/engine/engine.json, and its volume where there is one."""
        os.makedirs(self.path("examples/engine"))
        self.write_json("examples/engine/engine.json", support.make_scene("engine.nrrd"))
        if volume is not None:
            support.write_nrrd(self.path("examples/engine/" + volume))

    def test_table1(self):
        self.write_example("engine.nrrd")
        (row,) = self.bench("table1", "engine", env={})["rows"]
        empty = {key for key in keys_of("table1")
                 if key in NOT_THERE or re.sub("_(p95|spread)", "", key) in NOT_THERE}
        self.check_timed(row, but=empty)
        self.assertEqual((row["volume"], row["paper_fill"], row["paper_rgb_raycast_fps"]), ("engine", 0.79, 0.15))
        self.assertEqual((row["paper_fourier_relight_fps"], row["paper_fourier_prepare_s"]), (47.6, 85))
        self.assertTrue(0 < row["fill"] < 1)
        self.assertGreaterEqual(row["transfer_change_ms"], row["classify_ms"])
        for what in ("transfer_change", "classify"):
            self.check_ratio(row, "relight_per_" + what, "postilluminate_ms", what + "_ms")
        self.check_ratio(row, "relight_per_project", "postilluminate_ms", "spectral_raycast_ms")

    def test_table1_without_the_volume_is_the_paper_alone(self):
        self.write_example(None)
        result = self.call("bench", "--suite", "table1", "--json", "--runs", 1)
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(result.stdout)
        self.check_suite(document, "table1")
        self.assertEqual([row["volume"] for row in document["rows"]], ["hipiph", "tomato", "uncbrain", "engine", "frog"])
        self.assertEqual(len(result.stderr.splitlines()), 5)
        for row in document["rows"]:
            for key in keys_of("table1"):
                if key.startswith("paper") and "fourier" not in key:
                    self.assertIsInstance(row[key], (int, float))
                elif key != "volume" and not key.startswith("paper"):
                    self.assertIsNone(row[key], key)
        self.assertIsNone(document["rows"][4]["paper_fourier_fps"])

    def test_kernels(self):
        rows = self.bench("kernels", "512x512 4 lanes float", "--threads", 1)["rows"]
        self.assertEqual(rows[0]["isa"], "baseline")
        for row in rows:
            self.check_timed(row, but=[f"spectral_raycast{part}_ms" for part in ("", "_p95", "_spread")])
            self.assertEqual((row["kernel"], row["lanes"], row["format"], row["threads"]), ("relight", 4, "float", 1))
            bytes_ = 512 * 512 * (4 * 4 + 4)
            self.assertAlmostEqual(row["gigabytes_per_s"] / (1e-6 * bytes_ / row["postilluminate_ms"]), 1, 4)
            self.check_ratio(row, "share_of_triad", "gigabytes_per_s", "triad_gigabytes_per_s")
        rows = self.bench("kernels", "raycast engine smoke baseline")["rows"]
        self.assertEqual([row["threads"] for row in rows], list(range(1, len(rows) + 1)))
        for row in rows:
            self.assertIsNotNone(row["spectral_raycast_ms"])

    def test_scaling(self):
        rows = self.bench("scaling", "fill")["rows"]
        self.assertEqual([row["value"] for row in rows], [0.05, 0.1, 0.25, 0.5, 0.75, 1])
        self.assertEqual(len({row["affine_r_squared"] for row in rows}), 1)
        self.assertTrue(0 <= rows[0]["affine_r_squared"] <= 1)
        (row,) = self.bench("scaling", "volume_edge 64", "--threads", 1)["rows"]
        self.check_timed(row, but=["affine_r_squared"])
        self.assertEqual((row["varied"], row["value"], row["volume_edge"]), ("volume_edge", 64, 64))
        self.assertEqual((row["threads"], row["picture_edge"], row["lanes"]), (1, 512, 8))

    def test_ablation(self):
        (row,) = self.bench("ablation", "engine smoke everything")["rows"]
        self.check_timed(row)
        self.assertEqual((row["frame"], row["device"], row["per_everything"]), ("engine smoke", "everything", 1))
        self.assertTrue(40 < row["psnr_db"] <= 200)
        (row,) = self.bench("ablation", "engine smoke without termination")["rows"]
        self.check_timed(row, but=["per_everything"])

    def test_ablation_names_every_device(self):
        result = self.call("bench", "--suite", "ablation", "--only", " with", "--json")
        document = json.loads(result.stdout)
        self.check_suite(document, "ablation")
        for frame in ("engine smoke", "bonsai smoke"):
            without = [row["device"] for row in document["rows"]
                       if row["frame"] == frame and row["device"].startswith("without ")]
            self.assertEqual(without, ["without " + device for device in
                                       ("packets", "skipping", "prefetch", "termination", "pre-integration",
                                        "derived layout")])
        self.assertEqual(len(result.stderr.splitlines()), 2)

    def check_design_row(self, row, but=()):
        self.check_timed(row, but)
        for key in ("solved", "solved_basis", "physical"):
            self.assertTrue(0 <= row[key] <= 1, key)
        for key in ("ciede2000", "ciede2000_basis"):
            self.assertTrue(0 <= row[key + "_median"] <= row[key + "_p95"] <= row[key + "_worst"], key)
        self.assertAlmostEqual(row["slowest_s"] / (1e-3 * row["design_p95_ms"]), 1, 4)  # of so few it is the 95th, too

    def test_design_of_fixed_problems(self):
        (row,) = self.bench("design", "metamers D65/A")["rows"]
        self.check_design_row(row, but=["everything_solved"])
        self.assertEqual((row["method"], row["documents"], row["goals"], row["failures"]), ("everything", 1, 3, 0))
        self.assertEqual((row["solved"], row["physical"]), (1, 1))
        (row,) = self.bench("design", "21 equalities", "--threads", 2)["rows"]
        self.check_design_row(row, but=["everything_solved"])
        self.assertEqual((row["method"], row["threads"], row["goals"]), ("without basis rows", 1, 7))
        self.assertEqual(row["solved"], 1)

    def test_design_of_random_documents_is_the_same_again(self):
        rows = [self.bench("design", "reachable without starts", "--threads", threads)["rows"][0] for threads in (1, 2)]
        for row in rows:
            self.check_design_row(row, but=["everything_solved"])
            self.assertEqual((row["problem"], row["method"], row["documents"]), ("reachable", "without starts", 10))
        for key in keys_of("design"):
            if key != "threads" and not key.endswith(("_ms", "_s")):
                self.assertEqual(rows[0][key], rows[1][key], key)

    def test_without_a_suite_all_of_them_run(self):
        self.write_example("engine.nrrd")
        documents = self.json_of("bench", "--runs", 1, "--only", "engine smoke everything", env=self.data)
        self.assertEqual([document["suite"] for document in documents], list(COLUMNS))
        for document in documents:
            self.check_suite(document, document["suite"])
        self.assertEqual([len(document["rows"]) for document in documents], [0, 0, 0, 0, 1, 0])

    def test_the_table_holds_the_rows_in_any_locale(self):
        locale = {"LC_ALL": "", "LC_NUMERIC": "comma", "LOCPATH": self.folder} if self.make_comma_locale() else {}
        table = self.succeed("bench", "--suite", "frames", "--only", "engine solid", "--runs", 1,
                             env={**self.data, **locale})
        (line,) = [line for line in table.splitlines() if re.match(r"engine solid +0\.\d+  ", line)]
        self.assertNotIn(",", line)

    def test_the_manual_describes_every_column(self):
        with open(MANUAL, encoding="utf-8") as stream:
            section = stream.read().split("## `metamer bench")[1].split("\n## ")[0]
        described = set(re.findall(r"`([a-z0-9_]+)`", section))
        for columns in COLUMNS.values():
            self.assertLessEqual(set(columns.split()), described)

    def test_bad_usage(self):
        for words, texts in ((["--suite", "frame"], ["frame", "frames, table1, kernels, scaling, ablation or design"]),
                             (["--suite"], ["--suite"]), (["frames"], ["frames"]), (["--runs", "0"], ["--runs", "0"]),
                             (["--runs", "257"], ["257"]), (["--runs", "1.5"], ["1.5"]), (["--threads", "x"], ["x"]),
                             (["--json=yes"], ["--json"]), (["--size", "8"], ["--size", "8"])):
            self.refuse("bench", *words, texts=texts, status=2)

    def test_names_that_no_row_has(self):
        self.refuse("bench", "--only", "no such row", texts=["no such row"])


if __name__ == "__main__":
    support.main()
