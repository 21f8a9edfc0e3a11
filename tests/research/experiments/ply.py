# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes and reads binary PLY files in double precision."""

import numpy


def write_ply(path, vertices, triangles, selected=None):
    """Writes vertices (n x 3), triangles (m x 3) and, if given, m numbers as the faces' property
    "selected"."""
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
              "property double x\nproperty double y\nproperty double z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\n"
              "property uchar selected\nend_header\n")
    faces = numpy.zeros(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3),
                                               ("selected", "u1")])
    faces["count"], faces["corners"] = 3, triangles
    if selected is not None:
        faces["selected"] = selected
    path.write_bytes(header.encode() + vertices.astype("<f8").tobytes() + faces.tobytes())


def read_vertices(path, count):
    """Returns the positions (count x 3) of a file whose vertices have nothing else."""
    data = path.read_bytes()
    begin = data.index(b"end_header\n") + len(b"end_header\n")
    return numpy.frombuffer(data, "<f8", 3 * count, begin).reshape(-1, 3)


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
