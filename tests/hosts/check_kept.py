#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks what a flow must not change: check_kept.py BEFORE.ply AFTER.ply

Vertices of boundary edges must keep their bits. A boundary edge has one face after coincident vertices
are merged. If faces have MeshLab's flags, the vertices of unselected faces must keep their bits, too. At
least 99 % of the other vertices must have moved. All other data of the file must stay.
"""

import itertools
import struct
import sys
from collections import Counter

from ply_file import positions, read_ply

SELECTED = 0x20  # among MeshLab's flags
COMPUTED = {"x", "y", "z", "nx", "ny", "nz"}


def bits(point):
    """Returns the bits of a point's coordinates as doubles. Floats are equal if and only if these are."""
    return struct.pack("<3d", *point)


def vertex_indices(elements):
    faces = elements["face"]
    name = "vertex_indices" if "vertex_indices" in faces.properties else "vertex_index"
    return [tuple(map(int, corners)) for corners in faces.column(name)]


def on_boundary(points, faces):
    """Returns the positions of the vertices of boundary edges."""
    edges = Counter()
    for corners in faces:
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if points[a] != points[b]:
                edges[min(points[a], points[b]), max(points[a], points[b])] += 1
    return set(itertools.chain(*(edge for edge, count in edges.items() if count == 1)))


def unselected(points, faces, elements):
    """Returns the positions of the vertices of unselected faces; none if faces have no flags."""
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
        sys.exit("data other than positions has changed")
    start, end, faces = positions(before), positions(after), vertex_indices(before)
    boundary, left_out = on_boundary(start, faces), unselected(start, faces, before)
    used = set(itertools.chain(*faces))
    constrained = [i for i, p in enumerate(start) if i not in used or p in boundary or p in left_out]
    free = sorted(set(range(len(start))).difference(constrained))
    changed = [i for i in constrained if bits(start[i]) != bits(end[i])]
    moved = sum(bits(start[i]) != bits(end[i]) for i in free)
    print(f"{len(constrained)} vertices must keep their bits, {len(boundary)} positions of the boundary "
          f"and {len(left_out)} of unselected faces among them; {moved} of {len(free)} others moved")
    if changed:
        sys.exit(f"{len(changed)} constrained vertices have moved; the first is {changed[0]}")
    if not boundary and not left_out or moved < 0.99 * len(free) or not free:
        sys.exit("the test is void: no vertex is constrained, or too few others have moved")


if __name__ == "__main__":
    main(*sys.argv[1:])
