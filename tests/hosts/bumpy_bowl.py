#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes an open surface with noise for the host tests: bumpy_bowl.py OUTPUT.off [SELECTED.ply [SIDE]]

In SELECTED.ply, the faces in the middle are selected; '' writes none. SIDE is in vertices.
"""

import random
import sys

import float_ply

# MeshLab shows meshes of fewer than 50,000 faces with flat shading until a filter has run. Pictures before
# and after would then differ by their shading.
SIDE = int(sys.argv[3]) if len(sys.argv) > 3 else 180


def vertices():
    noise = random.Random(1)
    ticks = [2 * i / (SIDE - 1) - 1 for i in range(SIDE)]
    return [(x, y, (x * x + y * y) / 2 + noise.gauss(0, 0.004)) for y in ticks for x in ticks]


def faces():
    for row in range(SIDE - 1):
        for first in range(row * SIDE, (row + 1) * SIDE - 1):
            opposite = first + SIDE + 1
            yield first, first + 1, opposite
            yield first, opposite, first + SIDE


def is_in_the_middle(face):
    return all(SIDE // 3 < place < 2 * SIDE // 3 for place in divmod(face[0], SIDE))


def main(output, selected=None, _side=None):
    if selected:
        float_ply.write_ply(selected, vertices(), list(faces()), selected=list(map(is_in_the_middle, faces())))
    with open(output, "w") as file:
        print(f"OFF\n{SIDE**2} {2 * (SIDE - 1)**2} 0", file=file)
        for vertex in vertices():
            print(*vertex, file=file)
        for face in faces():
            print(3, *face, file=file)


if __name__ == "__main__":
    main(*sys.argv[1:])
