#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 4: an open spiral of flat walls with a locked boundary.

Functions in space join walls that lie in one cell, however far apart they are on the surface (section 5.5),
and the walls stick. The paper's flow also keeps every point in a cell that the boundary meets. Here the spiral
flows by the paper's method and by the product's, whose functions are the mesh's own. The reference is the
cotangent flow with the boundary's vertices fixed. Distances are RMS, as MeshLab measures them, in diagonals.

The picture is the section at half the height, where the boundary is far away. The second table varies the gap between
the walls on a coarser octree. The boundary is free there, because locked cells would hide what the walls do.
"""

import numpy

from reproduction import CONVERGED, PAPER, Reproduction  # finds the folder of ply.py

from ply import read_mesh, write_ply

METHODS = {PAPER: "paper's method", CONVERGED: "product"}
STEP_SIZE, STEPS = 1e-5, 80
TURNS, HEIGHT = 3, 0.4  # the longest wall has length 1
GAPS, GAPS_DEPTH, GAPS_STEPS = [0.025, 0.03, 0.035, 0.04, 0.045, 0.05, 0.06], 4, 10
SAMPLES = 100000  # for the distance
CORNER = [0.88, 1.01, 0.88, 1.01]  # a part of the picture


def rows_of(spacing):
    return round(HEIGHT / spacing) + 1


def spiral(gap, spacing):
    """Returns vertices and triangles of a sheet over a right-angled spiral, `spacing` apart."""
    directions = numpy.array([[1, 0], [0, 1], [-1, 0], [0, -1]])
    curve = [numpy.zeros(2)]
    for wall in range(4 * TURNS):
        length = 1 - gap * max(0, (wall - 1) // 2)
        count = max(1, round(length / spacing))
        along = numpy.arange(1, count + 1) * length / count
        curve += list(curve[-1] + numpy.outer(along, directions[wall % 4]))
    curve = numpy.array(curve)
    rows = rows_of(spacing)
    heights = numpy.linspace(0, HEIGHT, rows)
    vertices = numpy.array([[*point, z] for point in curve for z in heights])
    triangles = []
    for column in range(len(curve) - 1):
        for row in range(rows - 1):
            a = column * rows + row
            triangles += [[a, a + rows, a + rows + 1], [a, a + rows + 1, a + 1]]
    return vertices, numpy.array(triangles)


def section(path, rows):
    """Returns the x and y of the vertices that were at half the height."""
    return read_mesh(path)[0][rows // 2::rows, :2].T


def measure(figure, gap, depth, step_size, steps, boundary):
    """Returns the spiral's file, the cotangent flow's row, and for each method its row with the distance to the
    cotangent flow."""
    figure.surfaces.mkdir(parents=True, exist_ok=True)
    scan = figure.surfaces / f"spiral_{gap:g}.ply"
    write_ply(scan, *spiral(gap, gap / 2))
    [reference] = figure.flow(scan, step_size, [steps], "cotangent", boundary=boundary)
    ends = {}
    for method, name in METHODS.items():
        [end] = figure.flow(scan, step_size, [steps], configuration=method, boundary=boundary,
                            depth=depth if method == PAPER else 0)
        ends[method] = {**end, **figure.distance(end["surface"], reference["surface"], SAMPLES)}
        figure.record([{"gap": gap, "case": name, "rms": ends[method]["rms"], "max": ends[method]["max"]}])
    return scan, reference, ends


def measure_gaps(figure):
    figure.say(f"\nGaps on an octree of depth {GAPS_DEPTH}, cells of {1.1 / 2 ** GAPS_DEPTH:.2g}, "
               f"{GAPS_STEPS} steps of {STEP_SIZE:g}, free boundary: RMS distance\n")
    rows = []
    for gap in GAPS:
        _, _, ends = measure(figure, gap, GAPS_DEPTH, STEP_SIZE, GAPS_STEPS, "free")
        rows.append([gap, *(ends[method]["rms"] for method in METHODS)])
    figure.table(["gap", *METHODS.values()], rows)


def main():
    figure = Reproduction("figure_4", __doc__)
    quick = figure.options.quick
    gap, depth, steps = 0.025, 5, 8 if quick else STEPS
    step_size = STEP_SIZE * (10 if quick else 1)
    scan, reference, ends = measure(figure, gap, depth, step_size, steps, "locked")
    figure.say(f"\nWalls {gap:g} apart, the longest of length 1; an octree of depth {depth} has cells of "
               f"{1.1 / 2 ** depth:.2g}.\n")
    figure.table([f"after {steps} steps of {step_size:g}", "area", "RMS distance", "largest distance"],
                 [["cotangent", reference["area"], 0.0, 0.0]]
                 + [[METHODS[method], row["area"], row["rms"], row["max"]] for method, row in ends.items()])
    ratio = ends[PAPER]["rms"] / ends[CONVERGED]["rms"]
    closer = figure.check("RMS distance of the paper's method, relative to the product", ratio, at_least=1)
    figure.claim("walls in one cell stick together, and locked cells keep what is near the boundary: the paper's method is "
                 f"{ratio:.3g} times as far from the cotangent flow as the product", closer)
    if not quick:
        measure_gaps(figure)
        plot(figure, rows_of(gap / 2), {"before": scan, METHODS[PAPER]: ends[PAPER]["surface"], "cotangent": reference["surface"],
                                        METHODS[CONVERGED]: ends[CONVERGED]["surface"]})
    figure.finish()


def plot(figure, rows, surfaces):
    panels, axes = figure.figure(columns=2, size=(5, 5))
    styles = ({"color": "0.8"}, {"color": "tab:red"}, {"color": "tab:blue", "linewidth": 3, "alpha": 0.4}, {"color": "black"})
    for ax in axes[0]:
        for (name, path), style in zip(surfaces.items(), styles):
            ax.plot(*section(path, rows), label=name, **style)
        ax.set_aspect("equal")
    axes[0][1].axis(CORNER)
    axes[0][1].legend(loc="lower left")
    figure.save(panels)


if __name__ == "__main__":
    main()
