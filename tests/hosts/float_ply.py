#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts a PLY or OFF file to a binary PLY file of floats. All hosts read the same bits from it:
float_ply.py IN OUT.ply [quality]

With a third argument, each vertex has a number from 0 to 1 as its quality."""

import struct
import sys

from ply_file import positions, read_ply


def read_off(path):
    """Returns the vertices and faces of an OFF file without colours."""
    with open(path, encoding="ascii") as file:
        words = iter([word for line in file for word in line.split("#")[0].split()])
    if next(words) != "OFF":
        sys.exit(f"{path} is not an OFF file")
    vertex_count, face_count, _ = (int(next(words)) for _ in range(3))
    vertices = [tuple(float(next(words)) for _ in range(3)) for _ in range(vertex_count)]
    faces = [tuple(int(next(words)) for _ in range(int(next(words)))) for _ in range(face_count)]
    return vertices, faces


def read_mesh(path):
    if path.endswith(".off"):
        return read_off(path)
    elements = read_ply(path)
    faces = elements["face"]
    name = next(n for n in ("vertex_indices", "vertex_index") if n in faces.properties)
    return positions(elements), [tuple(map(int, face)) for face in faces.column(name)]


def write_ply(path, vertices, faces, *quality):
    names = ["x", "y", "z", *quality]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property float {name}" for name in names), f"element face {len(faces)}",
              "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        for i, vertex in enumerate(vertices):
            numbers = [*vertex, *(i % 5 / 4 for _ in quality)]
            file.write(struct.pack(f"<{len(numbers)}f", *numbers))
        for face in faces:
            file.write(struct.pack("<B3i", 3, *face))


if __name__ == "__main__":
    write_ply(sys.argv[2], *read_mesh(sys.argv[1]), *sys.argv[3:])
