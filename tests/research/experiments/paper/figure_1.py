#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 1: the octree's cells tracked with the surface.

The first picture shows the finest cells that a scan's leg carries with it, after several numbers of steps.
The second one shows the cells of the fixed grid around the same part of the surface: an octree that is not
tracked has to be built from them anew. A check of the drawing: all vertices stay in the bounding boxes of their
tracked cells. The claim: the surface leaves its initial cells, so that a tenth of the cells of a rebuilt octree
are new.
"""

import numpy

from reproduction import Reproduction  # finds the folder of ply.py

from ply import write_ply

STEPS = [0, 4, 16]
STEP_SIZE = 5e-5
LEG = [0, 0.12, 0, 0.4, 0.42, 1]  # in fractions of the bounding box
VIEW = ["--view", -0.3, -0.2, 1, "--zoom", 2.4, "--center", 0.3, -0.45, "--height", 340]
CORNERS = numpy.array([[corner >> axis & 1 for axis in range(3)] for corner in range(8)])
SIDES = numpy.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])  # of a cell
LARGEST_DISTANCE = 1e-6  # in sides of a cell
SMALLEST_SHARE = 0.1  # of new cells


def add_options(parser):
    parser.add_argument("--depth", type=int, default=5, help="of the octree")


def outside(positions, corners):
    """Returns the distances of positions (n x 3) from the bounding boxes of corners (n x 8 x 3)."""
    below, above = corners.min(axis=1) - positions, positions - corners.max(axis=1)
    return numpy.linalg.norm(numpy.maximum(numpy.maximum(below, above), 0), axis=1)


class Leg:
    """The finest cells with their centre in the box LEG, and the vertices in them, in units of the grid."""

    def __init__(self, folder):
        self._folder = folder
        self._cells = self._numbers("cells.i32", numpy.int32, 3)
        start = self._numbers("vertices_0.f64", float, 3)
        low, high = start.min(axis=0) + numpy.reshape(LEG, (2, 3)) * numpy.ptp(start, axis=0)
        self._inside = ((self._cells + 0.5 >= low) & (self._cells + 0.5 <= high)).all(axis=1)
        elements = self._numbers("elements.i32", numpy.int32, 1)[:, 0]
        self._vertices = numpy.flatnonzero((elements >= 0) & self._inside[elements])
        self._elements = elements[self._vertices]

    def _numbers(self, name, kind, width):
        return numpy.fromfile(self._folder / name, kind).reshape(-1, width)

    def measured(self, row):
        """Adds the measures after the steps of a row of the driver, and writes the cells."""
        corners = self._numbers(f"corners_{row['steps']}.f64", float, 24).reshape(-1, 8, 3)
        positions = self._numbers(f"vertices_{row['steps']}.f64", float, 3)[self._vertices]
        present = numpy.unique(numpy.floor(positions).astype(int), axis=0)
        initial = set(map(tuple, self._cells[self._inside].tolist()))
        left = outside(positions, self._cells[self._elements][:, None] + CORNERS)
        self._write(row, "tracked", corners[self._inside])
        self._write(row, "grid", present[:, None] + CORNERS)
        row.update({"tracked_cells": int(self._inside.sum()), "grid_cells": len(present),
                    "fresh_grid_cells": sum(tuple(cell) not in initial for cell in present.tolist()),
                    "vertices": len(positions), "crossed": float((left > 1e-6).mean()),
                    "outside": float(outside(positions, corners[self._elements]).max()),
                    "outside_initial": float(left.max())})

    def _write(self, row, kind, corners):
        """Writes cells (n x 8 x 3) as quads in the units of the surface."""
        vertices = numpy.array([row[axis] for axis in "xyz"]) + row["cell_size"] * corners.reshape(-1, 3)
        quads = 8 * numpy.arange(len(corners))[:, None, None] + SIDES
        write_ply(self._folder / f"{kind}_{row['steps']}.ply", vertices, quads.reshape(-1, 4))


def main():
    figure = Reproduction("figure_1", __doc__, add_options)
    [scan] = figure.scans(["armadillo_50k.ply"], ["armadillo.off"])
    folder = figure.surfaces / f"{scan.stem}_cells"
    rows = figure.run("cells", scan, "--depth", figure.options.depth, "--step-size", STEP_SIZE,
                      "--steps", *STEPS, "--folder", folder, mesh=scan.stem)
    leg = Leg(folder)
    for row in rows:
        leg.measured(row)
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
