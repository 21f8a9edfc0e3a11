#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 1: the octree's cells tracked with the surface.

The first picture shows the finest cells that a scan's leg carries with it, after several numbers of steps.
The second one shows the cells of the fixed grid around the same part of the surface: an octree that is not
tracked has to be built from them anew. A check of the drawing: all vertices stay in the bounding boxes of their
tracked cells. The claim: the surface leaves its initial cells, so that a tenth of the cells of a rebuilt octree
are new.
"""

from reproduction import Reproduction

STEPS = [0, 4, 16]
STEP_SIZE = 5e-5
LEG = [0, 0.12, 0, 0.4, 0.42, 1]  # in fractions of the bounding box
VIEW = ["--view", -0.3, -0.2, 1, "--zoom", 2.4, "--center", 0.3, -0.45, "--height", 340]
LARGEST_DISTANCE = 1e-6  # in sides of a cell
SMALLEST_SHARE = 0.1  # of new cells


def add_options(parser):
    parser.add_argument("--depth", type=int, default=5, help="of the octree")


def main():
    figure = Reproduction("figure_1", __doc__, add_options)
    [scan] = figure.scans(["armadillo_50k.ply"], ["armadillo.off"])
    folder = figure.surfaces / f"{scan.stem}_cells"
    rows = figure.run("cells", scan, "--depth", figure.options.depth, "--step-size", STEP_SIZE,
                      "--steps", *STEPS, "--box", *LEG, "--folder", folder, mesh=scan.stem)
    figure.table(["steps", "tracked cells", "grid cells", "of these new", "vertices that left",
                  "outside tracked cell", "outside initial cell"],
                 [[row["steps"], row["tracked_cells"], row["grid_cells"], row["fresh_grid_cells"],
                   row["crossed"], row["outside"], row["outside_initial"]] for row in rows])
    end = rows[-1]
    figure.say(
        f"A leg of {scan.stem} after {', '.join(map(str, STEPS))} steps of {STEP_SIZE:g}, on an octree "
        f"of depth {end['depth']}. Lengths are in sides of a cell. The flow deforms the leg's "
        f"{end['tracked_cells']} cells with the surface, so no vertex is farther than "
        f"{max(row['outside'] for row in rows):.2g} from its cell's bounding box. In the fixed grid, "
        f"{100 * end['crossed']:.3g} % of the leg's {end['vertices']} vertices have left their cell, by "
        f"up to {end['outside_initial']:.3g}. A method without tracking starts again with "
        f"{end['grid_cells']} cells, of which {end['fresh_grid_cells']} are new.\n")
    figure.check("distance of a vertex from its tracked cell's bounding box",
                 max(row["outside"] for row in rows), at_most=LARGEST_DISTANCE)
    has_new_cells = figure.check("share of new cells in an octree built anew",
                 end["fresh_grid_cells"] / end["grid_cells"], at_least=SMALLEST_SHARE)
    figure.claim("an octree that is not tracked changes with the surface", has_new_cells)
    if not figure.options.quick:
        surfaces = [folder / f"surface_{steps}.ply" for steps in STEPS]
        for kind in ("tracked", "grid"):
            figure.draw(f"_{kind}", surfaces, STEPS, *VIEW, "--edges",
                        *[folder / f"{kind}_{steps}.ply" for steps in STEPS])
    figure.finish()


if __name__ == "__main__":
    main()
