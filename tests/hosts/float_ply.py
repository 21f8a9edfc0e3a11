#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Converts a PLY or OFF file to a binary PLY file of floats. All hosts read the same bits from it:
float_ply.py IN OUT.ply"""

import struct
import sys

from ply_file import positions, read_ply

SELECTED = 0x20  # among MeshLab's flags


def as_float(number):
    """Returns a float near the number. Hosts round others, and the program does not."""
    return struct.unpack("f", struct.pack("f", number))[0]


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
    """Returns the vertices and faces of a PLY or OFF file."""
    if str(path).endswith(".off"):
        return read_off(path)
    elements = read_ply(path)
    faces = elements["face"]
    name = next(n for n in ("vertex_indices", "vertex_index") if n in faces.properties)
    return positions(elements), [tuple(map(int, face)) for face in faces.column(name)]


def write_ply(path, vertices, faces, quality=(), selected=()):
    """Writes positions as floats, qualities as doubles, and the selection of faces as MeshLab does."""
    types = [*(("float", axis) for axis in "xyz"), *(("double", "quality") for _ in quality[:1])]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property {' '.join(kind)}" for kind in types), f"element face {len(faces)}",
              "property list uchar int vertex_indices", *("property int flags" for _ in selected[:1]), "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        for i, vertex in enumerate(vertices):
            file.write(struct.pack("<3f", *vertex) + struct.pack(f"<{len(quality[:1])}d", *quality[i:i + 1]))
        for i, face in enumerate(faces):
            file.write(struct.pack(f"<B{len(face)}i", len(face), *face))
            file.write(struct.pack(f"<{len(selected[:1])}i", *(SELECTED * flag for flag in selected[i:i + 1])))


if __name__ == "__main__":
    write_ply(sys.argv[2], *read_mesh(sys.argv[1]))
