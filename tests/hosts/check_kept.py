#!/usr/bin/env python3
"""Checks that a flow has left alone what it must: check_kept.py BEFORE.ply AFTER.ply

Vertices of boundary edges, which one face alone has once vertices at the same place are one, must
have the same bits, and so must, if the faces have flags, all vertices of faces that MeshLab's flags
do not select; at least 99 in 100 of the others must have moved. Everything else of the file must be
the same: faces, order, colours, flags, whatever there is.
"""

import itertools
import struct
import sys
from collections import Counter

from ply_file import positions, read_ply

SELECTED = 0x20  # among MeshLab's flags
COMPUTED = {"x", "y", "z", "nx", "ny", "nz"}


def bits(point):
    """As doubles: two floats have the same bits if these have."""
    return struct.pack("<3d", *point)


def vertex_indices(elements):
    faces = elements["face"]
    name = "vertex_indices" if "vertex_indices" in faces.properties else "vertex_index"
    return [tuple(map(int, corners)) for corners in faces.column(name)]


def on_boundary(points, faces):
    """The places of vertices of boundary edges."""
    edges = Counter()
    for corners in faces:
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if points[a] != points[b]:
                edges[min(points[a], points[b]), max(points[a], points[b])] += 1
    return set(itertools.chain(*(edge for edge, count in edges.items() if count == 1)))


def unselected(points, faces, elements):
    """The places of vertices of faces that are not selected; none if faces have no flags."""
    if "flags" not in elements["face"].properties:
        return set()
    flags = elements["face"].column("flags")
    return {points[corner] for corners, flag in zip(faces, flags)
            if not int(flag) & SELECTED for corner in corners}


def everything_else(elements):
    for element in elements.values():
        for name in element.properties:
            if element.name != "vertex" or name not in COMPUTED:
                if element.name != "face" or name not in COMPUTED:
                    yield element.name, name, repr(element.column(name))


def main(before_path, after_path):
    before, after = read_ply(before_path), read_ply(after_path)
    if list(everything_else(before)) != list(everything_else(after)):
        sys.exit("something else than positions has changed")
    start, end, faces = positions(before), positions(after), vertex_indices(before)
    boundary, left_out = on_boundary(start, faces), unselected(start, faces, before)
    used = set(itertools.chain(*faces))
    held = [i for i, p in enumerate(start) if i not in used or p in boundary or p in left_out]
    free = sorted(set(range(len(start))).difference(held))
    changed = [i for i in held if bits(start[i]) != bits(end[i])]
    moved = sum(bits(start[i]) != bits(end[i]) for i in free)
    print(f"{len(held)} vertices keep their bits, {len(boundary)} places of the boundary and "
          f"{len(left_out)} of faces left out among them; {moved} of {len(free)} others moved")
    if changed:
        sys.exit(f"{len(changed)} vertices that are held have moved, the first is {changed[0]}")
    if not boundary and not left_out or moved < 0.99 * len(free) or not free:
        sys.exit("nothing to see here: nothing is held, or nothing moves")


if __name__ == "__main__":
    main(*sys.argv[1:])
