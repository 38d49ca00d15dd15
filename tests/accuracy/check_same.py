#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_same.py FIRST REPORT SOURCE OUT: the report in the folder FIRST comes out the same again, to the byte, from one
thread. check_same.py FIRST --clang CLANG SOURCE OUT: its numbers come out the same, to 1e-9, from another compiler, with
which the program is built in OUT first."""
import json
import math
import os
import pathlib
import subprocess
import sys

TIMES = "## Why a basis at all?"


def build(clang, source, folder):
    """The report program of that compiler."""
    subprocess.run(["nice", "cmake", "-S", source, "-B", folder, "-G", "Ninja", "-D", f"CMAKE_C_COMPILER={clang}",
                    "-D", "METAMER_BUILD_TESTS=OFF", "-D", "CMAKE_BUILD_TYPE=Release"], check=True)
    subprocess.run(["nice", "cmake", "--build", folder, "--target", "accuracy_report"], check=True)
    return folder / "accuracy" / "report"


def run(report, source, out):
    out.mkdir(parents=True, exist_ok=True)
    subprocess.run([report, "--quick", "--threads", "1", "--json", out / "accuracy.json", source, out], check=True)


def fail(sentence):
    print(sentence)
    sys.exit(1)


def compare_bytes(first, out):
    for path in sorted(first.rglob("*")):
        if path.suffix not in (".json", ".svg", ".md"):
            continue
        one, two = (folder.joinpath(path.relative_to(first)).read_text(encoding="utf-8") for folder in (first, out))
        if one.partition(TIMES)[0] != two.partition(TIMES)[0]:
            fail(f"{path.name} differs")
        if path.suffix == ".md" and TIMES not in one:
            fail(f"{path.name} has no section of times")


def compare_numbers(one, two, place):
    """The number of numbers compared."""
    if isinstance(one, dict) and one.keys() == two.keys():
        return sum(compare_numbers(one[key], two[key], f"{place}/{key}") for key in one)
    if isinstance(one, list) and len(one) == len(two):
        return sum(compare_numbers(a, b, place) for a, b in zip(one, two))
    if not math.isclose(one, two, rel_tol=0, abs_tol=1e-9):
        fail(f"{place}: {one!r} and {two!r}")
    return 1


def main(first, *arguments):
    source, out = (pathlib.Path(argument).resolve() for argument in arguments[-2:])
    first = pathlib.Path(first).resolve()
    is_clang = arguments[0] == "--clang"
    run(build(arguments[1], source, out) if is_clang else arguments[0], source, out / "report")
    if not is_clang:
        compare_bytes(first, out / "report")
        return
    one, two = (json.loads((folder / "accuracy.json").read_text(encoding="utf-8")) for folder in (first, out / "report"))
    print(f"{compare_numbers(one, two, '')} numbers are the same")


if __name__ == "__main__":
    os.environ.pop("CC", None)
    main(*sys.argv[1:])
