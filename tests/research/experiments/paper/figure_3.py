#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 3: a scan through 80 long steps.

The paper shows Neptune after up to 80 steps of 5e-4: long steps reach the scan's skeleton quickly. Here a
scan flows by the paper's method (one W-cycle) and by the product's (the mesh's own elements). Targets for
both: all steps are made, or the surface vanishes; all positions are finite; the area rises in no step; the
surface stays in its initial bounding box; little of the area is left.

The paper's method misses one of them. Only threads are left after 20 steps, and their area rises in some of the
later ones.
"""

from figure_2 import Stability


def main():
    stability = Stability("figure_3", __doc__, 5e-4, [0, 5, 10, 20, 40, 80], 0.2)
    [scan] = stability.figure.scans(["hand_8k.ply"], ["hand.off"])
    stability.run(scan)


if __name__ == "__main__":
    main()
