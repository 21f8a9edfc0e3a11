#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the vertices of PLY files: compare_positions.py A.ply B.ply REFERENCE.ply ULPS

Fails unless each coordinate of A and B agrees within a tolerance, and the largest movement from
REFERENCE is a hundred times the tolerance. The tolerance is ULPS units in the last place of a float as
large as the largest coordinate.
"""

import math
import sys

from ply_file import positions, read_ply


def read_coordinates(path):
    """Returns x, y and z of each vertex, in order."""
    return [coordinate for point in positions(read_ply(path)) for coordinate in point]


def float_ulp(number):
    return 2.0 ** (math.frexp(number)[1] - 24)


def largest_difference(a, b):
    """Returns the largest difference, infinite if a number is a NaN."""
    return max(math.inf if math.isnan(p - q) else abs(p - q) for p, q in zip(a, b))


def main(first, second, reference, ulps):
    a, b, start = (read_coordinates(path) for path in (first, second, reference))
    if not len(a) == len(b) == len(start):
        sys.exit(f"different numbers of coordinates: {len(a)}, {len(b)}, {len(start)}")
    largest = max(map(abs, a))
    tolerance = float(ulps) * float_ulp(largest)
    difference, movement = largest_difference(a, b), largest_difference(a, start)
    print(f"{len(a) // 3} vertices: largest difference {difference / largest:.3g} of the largest "
          f"coordinate, {difference:.3g}; tolerance {tolerance:.3g}, largest movement {movement:.3g}")
    if difference > tolerance:
        sys.exit("the positions differ")
    if movement < 100 * tolerance:
        sys.exit("nothing has moved")


if __name__ == "__main__":
    main(*sys.argv[1:])
