#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two builds of tracked_mcf: do they write the same bytes and report the same numbers?

same_bits.py OLD NEW MESH...

Each mesh flows once for each set of options below, which together use every option. Prints a line
for each difference, and the number of comparisons. Exits with 1 if anything differs. Use it before
and after a change that should not change results.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

OPTION_SETS = [
    "--step-size 1e-5 --iterations 10",
    "--depth 6 --step-size 1e-4 --iterations 3",
    "--step-size 0.01 --absolute --iterations 2",
    "--flow conformalized --step-size 1e-3 --iterations 4",
    "--boundary free --step-size 1e-5 --iterations 3",
    "--boundary free --flow conformalized --step-size 1e-2 --iterations 5",
    "--method paper --step-size 1e-5 --iterations 3",
    "--method paper --boundary free --cycles 2 --depth 6 --step-size 1e-5 --iterations 2",
    "--tolerance 1e-6 --step-size 1e-5 --iterations 2",
    "--method paper --cubature 1 --step-size 1e-5 --iterations 2",
    "--method paper --cubature 12 --step-size 1e-5 --iterations 2 --depth 6",
    "--threads 2 --step-size 1 --iterations 6",
    "--step-size 5e-3 --iterations 20 --depth 6",
]

NOT_RESULTS = ("seconds", "memory", "version", "input", "output", "cubature")


def numbers_of(report):
    """The report's numbers in order, without names, times and memory."""
    if isinstance(report, dict):
        return [
            number
            for key, value in report.items()
            if not any(word in key for word in NOT_RESULTS)
            for number in numbers_of(value)
        ]
    if isinstance(report, list):
        return [number for value in report for number in numbers_of(value)]
    return [report] if isinstance(report, (int, float)) else []


def run(program, mesh, options, folder):
    """What the program writes for a mesh: exit code, bytes and sorted numbers."""
    output, report = folder / "out.ply", folder / "report.json"
    output.unlink(missing_ok=True)
    report.unlink(missing_ok=True)
    command = [program, mesh, output, "--report", report, *options.split()]
    done = subprocess.run(command, capture_output=True, check=False)
    data = output.read_bytes() if output.exists() else b""
    numbers = numbers_of(json.loads(report.read_text())) if report.exists() else []
    return done.returncode, data, sorted(numbers)


def main():
    old, new, *meshes = sys.argv[1:]
    compared = different = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for mesh in meshes:
            for options in OPTION_SETS:
                before, after = (run(program, mesh, options, folder) for program in (old, new))
                compared += 1
                names = ("exit code", "bytes", "report")
                unequal = [n for n, a, b in zip(names, before, after) if a != b]
                if unequal:
                    different += 1
                    print(f"{mesh} {options}: {', '.join(unequal)}")
    print(f"{compared} comparisons, {different} different")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
