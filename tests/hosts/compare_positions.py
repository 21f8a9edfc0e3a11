#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the vertices of PLY files: compare_positions.py A.ply B.ply REFERENCE.ply ULPS

Fails unless each coordinate of A and B agrees within a tolerance, and the largest movement from
REFERENCE is more than a hundred times the tolerance. The tolerance is ULPS units in the last place of a float as
large as the largest coordinate. If A and B have qualities, these are compared likewise; if those of A are
floats, with B's rounded.
"""

import math
import sys

import float_ply
from ply_file import positions, read_ply


def coordinates_of(elements):
    """Returns x, y and z of each vertex, in order."""
    return [coordinate for point in positions(elements) for coordinate in point]


def float_ulp(number):
    return 2.0 ** (math.frexp(number)[1] - 24)


def largest_difference(a, b):
    """Returns the largest difference, infinite if a number is a NaN."""
    return max(math.inf if math.isnan(p - q) else abs(p - q) for p, q in zip(a, b))


def compare(what, a, b, tolerance):
    """Ends the program if the numbers differ by more than the tolerance."""
    if len(a) != len(b):
        sys.exit(f"different numbers of {what}: {len(a)}, {len(b)}")
    difference = largest_difference(a, b)
    print(f"{len(a)} {what}: largest difference {difference:.3g}; tolerance {tolerance:.3g}", end="; ")
    if difference > tolerance:
        sys.exit(f"the {what} differ")


def main(first, second, reference, ulps, share=0):
    """`share` is another tolerance, relative to the largest movement and to the largest quality."""
    files = [read_ply(path) for path in (first, second, reference)]
    a, b, start = map(coordinates_of, files)
    movement, rounding = largest_difference(b, start), float(ulps) * float_ulp(max(map(abs, a)))
    compare("coordinates", a, b, max(rounding, share * movement))
    vertices = [file["vertex"] for file in files[:2]]
    if all("quality" in element.properties for element in vertices):
        ours, theirs = (element.column("quality") for element in vertices)
        if vertices[0].types[vertices[0].properties.index("quality")] == ["f"]:
            theirs = [float_ply.as_float(number) for number in theirs]
        largest = max(map(abs, ours))
        compare("qualities", ours, theirs, max(float(ulps) * float_ulp(largest), share * largest))
    print(f"largest movement {movement:.3g}")
    if len(a) != len(start) or movement <= 100 * rounding:
        sys.exit("nothing has moved")


if __name__ == "__main__":
    main(*sys.argv[1:])
