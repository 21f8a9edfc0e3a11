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
