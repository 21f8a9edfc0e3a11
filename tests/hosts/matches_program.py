#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the filters as runs.py says, in a host and by the program, and compares positions and qualities of the vertices.
What the program refuses, the host must refuse with the same message.

HOST is a command that runs a filter, given FILTER IN OUT NAME=VALUE..., or with --options the program's arguments.
"""

import argparse
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


class Comparison:
    """Of a host with the program, for the runs of one filter."""

    def __init__(self, program, host, takes_options, scalar, tolerances, solves):
        self.program, self.host, self.takes_options = program, host, takes_options
        self.scalar, self.tolerances, self.solves = scalar, tolerances, solves

    def compare(self, command, work, settings):
        """Returns the bytes of the program's result, which the host's must match, or b"" if both refuse."""
        mesh, ours, theirs = (work / name for name in ("in.ply", "program.ply", "host.ply"))
        theirs.unlink(missing_ok=True)
        options = [*runs.program_options(settings), "--quiet", *(["--double"] if self.scalar == "double" else [])]
        code, message = run([self.program, command, mesh, ours, "--overwrite", *options])
        if self.takes_options:
            host_code, log = run([*self.host, command, mesh, theirs, *options])
        else:
            given = [f"{name}={value}" for name, value in runs.by_index(command, settings).items()]
            host_code, log = run([*self.host, runs.FILTERS[command], mesh, theirs, *given])
        # The program exits with 1 for bad meshes and 2 for bad parameters; hosts exit with 1, 2 or 255.
        if (code, host_code) != (0, 0) and not (code in (1, 2) and host_code in (1, 2, 255)):
            sys.exit(f"{settings}: the host ends with {host_code}, the program with {code}\n{log}\n{message}")
        if code == 0:
            compare_positions.main(theirs, ours, mesh, *self.tolerances)
            return ours.read_bytes()
        said = message.strip().removeprefix("tracked_mcf: ")
        if said not in log:
            sys.exit(f"{settings}: '{said}' is not in\n{log}")
        print(f"both refuse: {said}")
        return b""

    def compare_all(self, command, mesh, work):
        edge = runs.write_mesh(work / "in.ply", command, *mesh)
        results = {}
        for parameters in runs.RUNS[command]:
            settings = runs.settings_of(command, parameters, edge)
            if not self.takes_options and runs.OF_THE_PROGRAM & set(settings):
                continue
            if command == "smooth" and self.solves:
                settings.setdefault("tolerance", self.solves)
            print(command, parameters or "default", end=": ", flush=True)
            results[parameters] = self.compare(command, work, settings)
            if (results[parameters] == results[""]) != runs.same_as_default(parameters):
                sys.exit("the result is not as different from the default's as it must be")
        if list(results.values()).count(b"") > 0.3 * len(results):
            sys.exit("too many runs were refused")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--options", action="store_true", help="HOST is a program")
    parser.add_argument("--ulps", type=float, default=0, help="the largest permitted difference, in units in the last "
                        "place of the largest number as a float")
    parser.add_argument("--share", type=float, default=0, help="the largest permitted difference, relative to the "
                        "largest movement")
    parser.add_argument("--tolerance", help="of the flow's solves, with --options, in runs that give none")
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path, help="a folder, which is made anew")
    parser.add_argument("scalar", choices=["float", "double"], help="what the host has")
    parser.add_argument("host", nargs=argparse.REMAINDER)
    given = parser.parse_args()
    shutil.rmtree(given.work, ignore_errors=True)
    given.work.mkdir(parents=True)
    comparison = Comparison(given.program, given.host, given.options, given.scalar, (given.ulps, given.share),
                            given.tolerance)
    for command in runs.FILTERS:
        comparison.compare_all(command, float_ply.read_mesh(given.mesh), given.work)


if __name__ == "__main__":
    main()
