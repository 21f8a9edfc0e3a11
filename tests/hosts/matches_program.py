#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the filter as runs.py says, in a host and by the program, and compares the vertices. What the program
refuses, the host must refuse with the same message:
matches_program.py [--options] PROGRAM MESH WORK_DIR ULPS HOST...

HOST is a command that runs the filter, given IN OUT NAME=VALUE..., or with --options the program's options. ULPS is
the largest permitted difference in units in the last place of a float: 0.5 if the host rounds to floats.
"""

import json
import pathlib
import shutil
import subprocess
import sys

import compare_positions
import float_ply
import runs


def run(command):
    """Returns the exit code and all that the command prints."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


def compare(program, host, takes_options, work, settings, ulps):
    """Returns whether both smooth the mesh, with the same result, rather than refuse to."""
    mesh, ours, theirs = (work / name for name in ("in.ply", "program.ply", "host.ply"))
    theirs.unlink(missing_ok=True)
    options = [*runs.program_options(settings), "--quiet", "--double", "--report", work / "report.json"]
    code, message = run([program, mesh, ours, *options])
    given = options[:-2] if takes_options else [f"{name}={value}" for name, value in runs.by_index(settings).items()]
    host_code, log = run([*host, mesh, theirs, *given])
    # The program exits with 1 for bad parameters and 2 for bad meshes; hosts exit with 1, 2 or 255.
    if (code, host_code) != (0, 0) and not (code in (1, 2) and host_code in (1, 2, 255)):
        sys.exit(f"{settings}: the host ends with {host_code}, the program with {code}\n{log}\n{message}")
    if code == 0:
        compare_positions.main(theirs, ours, mesh, ulps)
        return True
    said = message.strip().removeprefix("tracked_mcf: ")
    if said not in log:
        sys.exit(f"{settings}: '{said}' is not in\n{log}")
    print(f"both refuse: {said}")
    return False


def main(program, mesh, work, ulps, *host, takes_options=False):
    work = pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    # All start from the same floats.
    float_ply.write_ply(work / "in.ply", *float_ply.read_mesh(mesh), "quality")
    detail_size, compared = 0, 0
    for parameters in runs.RUNS:
        print(parameters or "default", end=": ", flush=True)
        settings = runs.settings_of(parameters, detail_size)
        compared += compare(program, host, takes_options, work, settings, ulps)
        if not detail_size:
            detail_size = json.loads((work / "report.json").read_text(encoding="utf-8"))["detail_size"]
    if compared < 0.7 * len(runs.RUNS):
        sys.exit(f"only {compared} of {len(runs.RUNS)} runs were compared")


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--options"]
    main(*words, takes_options=len(words) < len(sys.argv) - 1)
