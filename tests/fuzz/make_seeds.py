#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a few small files of each format for the fuzzers to start from: make_seeds.py FOLDER

The files of a format go to FOLDER/FORMAT, where FORMAT is ply, obj, off, stl or evolve.
"""

import itertools
import pathlib
import struct
import sys

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def lines(*texts):
    return "".join(text + "\n" for text in texts).encode()


def ply_header(form, extra_vertex=(), extra_face=()):
    return lines("ply", f"format {form} 1.0", "comment a tetrahedron", "element vertex 4",
                 "property float x", "property float y", "property float z", *extra_vertex,
                 "element face 4", "property list uchar int vertex_indices", *extra_face,
                 "end_header")


def ply_files():
    points = [" ".join(map(str, point)) for point in POINTS]
    faces = ["3 " + " ".join(map(str, face)) for face in FACES]
    yield ply_header("ascii") + lines(*points, *faces)
    colours = [f"property uchar {name}" for name in ("red", "green", "blue")]
    texture = ["property list uchar float texcoord", "property int flags"]
    yield (ply_header("ascii", colours, texture) + lines(*(p + " 255 0 7" for p in points))
           + lines(*(f + " 6 0 0 1 0 0 1 32" for f in faces)))
    yield (ply_header("ascii").replace(b"element face 4", b"element tristrips 1") + lines(*points)
           + b"9 0 1 2 3 -1 0 2 -1 1\n").replace(b"\n", b"\r")
    yield (ply_header("ascii", ["property int64 s"]).upper()
           + lines("", *(p + " 255.0 more" for p in points), *faces))
    for form, order in ("binary_little_endian", "<"), ("binary_big_endian", ">"):
        yield (ply_header(form) + b"".join(struct.pack(order + "3f", *p) for p in POINTS)
               + b"".join(struct.pack(order + "B3i", 3, *f) for f in FACES))


def obj_files():
    points = ["v " + " ".join(map(str, point)) for point in POINTS]
    faces = ["f " + " ".join(str(i + 1) for i in face) for face in FACES]
    yield lines("# a tetrahedron", *points, *faces)
    yield lines("mtllib a.mtl", *(p + " 1 0 0.5" for p in points), "vt 0 0", "vn 0 0 1", "g part",
                "usemtl red", "f 1/1/1 3/1/1 2/1/1", "f 1//1 2//1 4//1", "f -3 -2 -1", "l 1 2 3", "s off")
    yield b"\xef\xbb\xbf" + lines("f 1//1 2//9 \\\r", "3 # a\r", "v 0 0\r", "v 1 0 # b\r", "v 0 1\r",
                                  "vn -1.#IND 0 1 1\r", "f 1 2\r")


def off_files():
    points = [" ".join(map(str, point)) for point in POINTS]
    faces = ["3 " + " ".join(map(str, face)) for face in FACES]
    yield lines("OFF", "4 4 6", *points, *faces)
    yield lines("COFF", "4 2 0", *(p + " 255 0 0 255" for p in points), "4 0 1 2 3 0.5 0.5 0.5",
                "3 0 1 2 9")
    yield lines("# a", "4 2", *(p + " 1 # b" for p in points), "3 0 1 2 # c", "2 0 1")
    yield lines("OFF 4 4 6 " + " ".join(points + faces))
    yield (b"COFF BINARY\n" + struct.pack(">3i", 4, 4, 6)
           + b"".join(struct.pack(">7f", *p, 1, 0, 0, 1) for p in POINTS)
           + b"".join(struct.pack(">4iif", 3, *f, 1, 0.5) for f in FACES))


def stl_files():
    facet = ["facet normal 0 0 1", "outer loop", "vertex 0 0 0", "vertex 1 0 0", "vertex 0 1 0",
             "endloop", "endfacet"]
    yield lines("solid a", *facet, *facet, "endsolid a")
    yield lines("\t\r\n", "SOLID a", *facet, *facet, "solid b " + " ".join(facet)) + b"\0\0"
    facets = [[c for i in face for c in POINTS[i]] for face in FACES]
    yield (b"binary".ljust(80) + struct.pack("<I", len(facets))
           + b"".join(struct.pack("<12fH", 0, 0, 0, *facet, 0) for facet in facets) + b"more")


def evolve_files():
    """Meshes and parameters in the bytes of evolve_fuzzer.cpp, with some flows, boundaries and solvers."""
    tetrahedron = [len(POINTS)]
    tetrahedron += [byte for point in POINTS for x in point for byte in (0, 8 + 8 * x)]
    tetrahedron += [i + 1 for face in FACES for i in face]
    depth, iterations, order = 5, 2, 1
    no_selection = [0]
    for flow, boundary, solver in itertools.product((0, 1), (0, 1, 2), (0, 1)):
        parameters = [depth, iterations, order, 0, 0, 0, flow, boundary, 0, 0, 0, 1, solver, 1, 0, 0, 0,
                      0, 1, 1]
        no_noise = [0]
        yield bytes(parameters + no_noise + no_selection + tetrahedron)
    for boundary, quality in itertools.product((0, 1), (0, 1)):
        remove_noise = [1, 0, 0, 0, 0, boundary, quality]
        yield bytes(parameters + remove_noise + no_selection + tetrahedron)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for name, files in (("ply", ply_files()), ("obj", obj_files()), ("off", off_files()),
                        ("stl", stl_files()), ("evolve", evolve_files())):
        folder = pathlib.Path(sys.argv[1]) / name
        folder.mkdir(parents=True, exist_ok=True)
        for number, content in enumerate(files):
            (folder / f"seed{number}").write_bytes(content)


if __name__ == "__main__":
    main()
