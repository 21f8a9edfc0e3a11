# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes, reads and unpacks binary PLY files."""

import lzma
import shutil

import numpy


def write_ply(path, vertices, faces, selected=None):
    """Writes vertices (n x 3), faces (m x 3 for triangles) and, if given, m numbers as the faces' property
    "selected". Vertices of float32 stay in single precision."""
    kind, real = ("float", "<f4") if vertices.dtype == numpy.float32 else ("double", "<f8")
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property {kind} {axis}" for axis in "xyz"), f"element face {len(faces)}",
              "property list uchar int vertex_indices", *(["property uchar selected"] if selected is not None else []),
              "end_header\n"]
    rows = numpy.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", faces.shape[1]),
                                          *([("selected", "u1")] if selected is not None else [])])
    rows["count"], rows["corners"] = faces.shape[1], faces
    if selected is not None:
        rows["selected"] = selected
    path.write_bytes("\n".join(header).encode() + vertices.astype(real).tobytes() + rows.tobytes())


def unpacked(packed, folder):
    """Returns the path of the unpacked copy in a folder of a file that is packed by xz."""
    path = folder / packed.stem
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        with lzma.open(packed) as source, open(path, "wb") as target:
            shutil.copyfileobj(source, target)
    return path


def read_mesh(path):
    """Returns the vertices and triangles of a binary file whose vertices begin with x, y and z, and whether each
    triangle is selected: MeshLab's flag 32 of its faces."""
    header, _, data = path.read_bytes().partition(b"end_header\n")
    types = {"double": "<f8", "float": "<f4", "uchar": "u1", "int": "<i4"}

    def layout(lines):
        return [(line[2], types[line[1]]) for line in lines if line[:1] == ["property"] and line[1] != "list"]

    of_vertices, of_faces = (part.splitlines() for part in header.decode().split("element vertex ")[1].split(
        "element face "))
    vertex = numpy.dtype(layout(map(str.split, of_vertices)))
    rows = numpy.frombuffer(data, vertex, int(of_vertices[0]))
    face = [("count", "u1"), ("corners", "<i4", 3), *layout(map(str.split, of_faces))]
    faces = numpy.frombuffer(data, face, int(of_faces[0]), rows.nbytes)
    selected = faces["flags"] & 32 != 0 if "flags" in faces.dtype.names else numpy.zeros(len(faces), bool)
    return numpy.stack([rows[axis].astype(float) for axis in "xyz"], 1), faces["corners"].astype(int), selected
