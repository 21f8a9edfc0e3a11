#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares two builds of tracked_mcf: do they write the same bytes and report the same numbers?

same_bits.py OLD NEW MESH...

Makes all runs of tests/hosts/runs.py, which together use every parameter of every filter, for each PLY or OFF file.
Prints a line for each difference, and the number of comparisons. Exits with 1 if anything differs. Use it before
and after a change that should not change results.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

TESTS = next(folder for folder in pathlib.Path(__file__).resolve().parents if folder.name == "tests")
sys.path.append(str(TESTS / "hosts"))
import float_ply  # noqa: E402
import runs  # noqa: E402

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


def run(program, command, options, folder):
    """What the program writes for the mesh in.ply: exit code, bytes and sorted numbers."""
    output, report = folder / "out.ply", folder / "report.json"
    output.unlink(missing_ok=True)
    report.unlink(missing_ok=True)
    done = subprocess.run([program, command, folder / "in.ply", output, "--double", "--report", report, *options],
                          capture_output=True, check=False)
    data = output.read_bytes() if output.exists() else b""
    numbers = numbers_of(json.loads(report.read_text())) if report.exists() else []
    return done.returncode, data, sorted(numbers)


def options_of_runs(mesh, folder):
    """Yields the command and the options of each run, after writing its mesh."""
    shape = float_ply.read_mesh(mesh)
    for command, table in runs.RUNS.items():
        edge = runs.write_mesh(folder / "in.ply", command, *shape)
        for words in table:
            yield command, list(runs.program_options(runs.settings_of(command, words, edge)))


def main():
    old, new, *meshes = sys.argv[1:]
    compared = different = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for mesh in meshes:
            for command, options in options_of_runs(mesh, folder):
                before, after = (run(program, command, options, folder) for program in (old, new))
                compared += 1
                names = ("exit code", "bytes", "report")
                unequal = [n for n, a, b in zip(names, before, after) if a != b]
                if unequal:
                    different += 1
                    print(f"{mesh} {command} {' '.join(options)}: {', '.join(unequal)}")
    print(f"{compared} comparisons, {different} different")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
