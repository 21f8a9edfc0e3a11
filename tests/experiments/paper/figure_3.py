#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 3: a scan through 80 long steps.

The paper shows Neptune after up to 80 steps of 5e-4: long steps reach the scan's skeleton quickly. Here a
scan flows by the paper's solver (one W-cycle) and by the converged solver. Targets for both solvers: all
steps are made; all positions are finite; the area rises in no step; the surface stays in its initial bounding
box; little of the area is left.
"""

from figure_2 import Stability


def main():
    stability = Stability("figure_3", __doc__, 5e-4, [0, 5, 10, 20, 40, 80], 0.2)
    [scan] = stability.figure.scans(["hand_8k.ply"], ["hand.off"])
    stability.run(scan)


if __name__ == "__main__":
    main()
