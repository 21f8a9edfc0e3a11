#!/usr/bin/env python3
"""Compares the vertices of PLY files: compare_positions.py A.ply B.ply REFERENCE.ply ULPS

Fails unless A and B have the same vertices in the same order, each coordinate to within ULPS units
in the last place of a float as large as the largest coordinate, and they have moved from REFERENCE
by a hundred times that.
"""

import math
import sys

from ply_file import positions, read_ply


def read_coordinates(path):
    """x, y, z of the first vertex, then of the second, and so on."""
    return [coordinate for point in positions(read_ply(path)) for coordinate in point]


def float_ulp(number):
    return 2.0 ** (math.frexp(number)[1] - 24)


def largest_difference(a, b):
    """Infinite where one is not a number, so that no comparison passes by accident."""
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
