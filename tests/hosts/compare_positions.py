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


def compare(what, a, b, ulps):
    """Returns the tolerance."""
    if len(a) != len(b):
        sys.exit(f"different numbers of {what}: {len(a)}, {len(b)}")
    largest = max(map(abs, a))
    tolerance = float(ulps) * float_ulp(largest)
    difference = largest_difference(a, b)
    print(f"{len(a)} {what}: largest difference {difference:.3g}, {difference / largest if largest else 0:.3g} of the "
          f"largest; tolerance {tolerance:.3g}", end="; ")
    if difference > tolerance:
        sys.exit(f"the {what} differ")
    return tolerance


def main(first, second, reference, ulps):
    files = [read_ply(path) for path in (first, second, reference)]
    a, b, start = map(coordinates_of, files)
    tolerance = compare("coordinates", a, b, ulps)
    vertices = [file["vertex"] for file in files[:2]]
    if all("quality" in element.properties for element in vertices):
        ours, theirs = (element.column("quality") for element in vertices)
        if vertices[0].types[vertices[0].properties.index("quality")] == ["f"]:
            theirs = [float_ply.as_float(number) for number in theirs]
        compare("qualities", ours, theirs, ulps)
    movement = largest_difference(a, start)
    print(f"largest movement {movement:.3g}")
    if len(a) != len(start) or movement <= 100 * tolerance:
        sys.exit("nothing has moved")


if __name__ == "__main__":
    main(*sys.argv[1:])
