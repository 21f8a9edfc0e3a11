#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the results of several builds of tracked_mcf: other processors, instructions, compilers.

platforms.py [--at-most DIFFERENCE] NAME=COMMAND... -- MESH.off...

A command may have several words, such as "env TRACKED_MCF_INSTRUCTIONS=avx2 build/tracked_mcf" or
"qemu-aarch64 -L /usr/aarch64-linux-gnu build-arm64/tracked_mcf". Each mesh, an OFF file, flows once for each set of
options below. Prints a Markdown table of the largest difference of a coordinate from the result of the
first command, in diagonals of that result's bounding box, or "same bits". Exits with 1 if a build fails or if a
difference is larger than DIFFERENCE.

same_bits.py asks whether two builds agree for all options, and in their reports, too.
"""

import argparse
import math
import pathlib
import shlex
import subprocess
import sys
import tempfile

OPTION_SETS = ["", "--detail-size 5% --order 2 --preserve volume", "--tolerance 1e-7"]


def result_of(command, mesh, options, folder):
    """Returns what the command writes for a mesh. OFF files have all digits of a double."""
    output = folder / "out.off"
    output.unlink(missing_ok=True)
    subprocess.run([*shlex.split(command), mesh, output, "--quiet", *options.split()], check=True)
    return output.read_text(encoding="ascii")


def positions_of(text):
    """Returns the positions in an OFF file as the program writes it: OFF, counts, vertices, faces."""
    words = text.split()
    vertices = int(words[1])
    return [tuple(map(float, words[begin:begin + 3])) for begin in range(4, 4 + 3 * vertices, 3)]


def difference(text, reference):
    """Returns the largest difference of a coordinate, in diagonals; 0 for the same text."""
    if text == reference:
        return 0.0
    positions, expected = positions_of(text), positions_of(reference)
    largest = max(abs(a - b) for p, q in zip(positions, expected, strict=True)
                  for a, b in zip(p, q))
    diagonal = math.hypot(*(max(axis) - min(axis) for axis in zip(*expected)))
    return largest / diagonal


def print_row(cells):
    print(f"| {' | '.join(cells)} |", flush=True)


def text_of(number):
    return f"{number:.1e}" if number else "same bits"


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n")[1])
    parser.add_argument("--at-most", type=float, default=math.inf)
    parser.add_argument("builds", nargs="+")
    if "--" not in sys.argv:
        parser.error("-- is missing before the meshes")
    separator = sys.argv.index("--")
    options = parser.parse_args(sys.argv[1:separator])
    builds = [build.split("=", 1) for build in options.builds]
    meshes = [pathlib.Path(mesh) for mesh in sys.argv[separator + 1:]]
    (reference, _), *others = builds
    print_row(["mesh", f"options ({reference} is the reference)", *(name for name, _ in others)])
    print_row(["---"] * (2 + len(others)))
    all_near = True
    with tempfile.TemporaryDirectory() as folder:
        for mesh in meshes:
            for words in OPTION_SETS:
                expected, *results = (result_of(c, mesh, words, pathlib.Path(folder))
                                      for _, c in builds)
                differences = [difference(result, expected) for result in results]
                all_near = all_near and all(d <= options.at_most for d in differences)
                print_row([mesh.stem, f"`{words}`" if words else "defaults",
                           *map(text_of, differences)])
    if not all_near:
        sys.exit(f"platforms: a difference is larger than {options.at_most:g}")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as failure:
        sys.exit(f"platforms: {failure}")
