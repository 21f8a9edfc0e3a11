#!/usr/bin/env python3
"""Compares the vertices of PLY files: compare_positions.py A.ply B.ply REFERENCE.ply ULPS

Fails unless A and B have the same vertices in the same order, each coordinate to within ULPS units
in the last place of a float as large as the largest coordinate, and they have moved from REFERENCE
by a hundred times that.
"""

import math
import struct
import sys

CODES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
         "float": "f", "double": "d", "float32": "f", "float64": "d", "uint8": "B", "int32": "i"}
BYTE_ORDER = {"binary_little_endian": "<", "binary_big_endian": ">"}


def read_header(file):
    """The encoding, the number of vertices and the {name: type code} of their properties."""
    encoding, count, properties, element = "", 0, {}, ""
    for line in iter(file.readline, b"end_header\n"):
        words = line.decode().split()
        if words[0] == "format":
            encoding = words[1]
        elif words[0] == "element":
            element = words[1]
            count = int(words[2]) if element == "vertex" else count
        elif words[0] == "property" and element == "vertex":
            properties[words[2]] = CODES[words[1]]
    return encoding, count, properties


def read_rows(file, encoding, count, codes):
    if encoding == "ascii":
        return [[float(word) for word in file.readline().split()] for _ in range(count)]
    row = struct.Struct(BYTE_ORDER[encoding] + "".join(codes))
    return [row.unpack(file.read(row.size)) for _ in range(count)]


def read_coordinates(path):
    """x, y, z of the first vertex, then of the second, and so on."""
    with open(path, "rb") as file:
        encoding, count, properties = read_header(file)
        columns = [list(properties).index(axis) for axis in "xyz"]
        rows = read_rows(file, encoding, count, properties.values())
    return [row[column] for row in rows for column in columns]


def float_ulp(number):
    return 2.0 ** (math.frexp(number)[1] - 24)


def largest_difference(a, b):
    """Infinite where one is not a number, so that no comparison passes by accident."""
    return max(math.inf if math.isnan(p - q) else abs(p - q) for p, q in zip(a, b))


def main(first, second, reference, ulps):
    a, b, start = (read_coordinates(path) for path in (first, second, reference))
    if not len(a) == len(b) == len(start):
        sys.exit(f"different numbers of coordinates: {len(a)}, {len(b)}, {len(start)}")
    tolerance = float(ulps) * float_ulp(max(map(abs, a)))
    difference, movement = largest_difference(a, b), largest_difference(a, start)
    print(f"{len(a) // 3} vertices: largest difference {difference:.3g}, tolerance "
          f"{tolerance:.3g}, largest movement {movement:.3g}")
    if difference > tolerance:
        sys.exit("the positions differ")
    if movement < 100 * tolerance:
        sys.exit("nothing has moved")


if __name__ == "__main__":
    main(*sys.argv[1:])
