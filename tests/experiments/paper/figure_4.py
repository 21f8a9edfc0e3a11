#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 4: an open spiral of flat walls with a locked boundary.

The spiral's walls are closer than a cell of the octree, so functions in space join walls that are far apart
on the surface (section 5.5), and they stick. The paper's flow also keeps every point in a cell that the
boundary meets. Here the spiral flows by the paper's solver, and by the converged one with glued and with
separate sheets and with both locks. The reference is the cotangent flow with the boundary's vertices fixed.

Targets: with separate sheets and the boundary's curve locked, the surface is closer to the reference than
with glued sheets, than with locked cells, and than the paper's. RMS distances as MeshLab measures them.
"""

import numpy

from reproduction import CONVERGED, PAPER, Reproduction  # finds the folder of ply.py

from ply import write_ply

CASES = {"paper's solver, glued, cells locked": (PAPER, "locked-cells"),
         "glued, curve locked": (f"{CONVERGED},glued", "locked"),
         "separate, cells locked": (CONVERGED, "locked-cells"),
         "separate, curve locked": (CONVERGED, "locked")}
OURS = "separate, curve locked"
STEP_SIZE, STEPS = 1e-5, [5, 10, 20, 40, 80]
TURNS, HEIGHT = 3, 0.4  # the longest wall has length 1
LARGEST_RATIO = 0.7
VIEW = ["--view", -0.5, 0.7, -1, "--up", 0, 0, 1, "--zoom", 4, "--center", 0.85, 0.25, "--height",
        260]


def add_options(parser):
    parser.add_argument("--depth", type=int, default=5, help="of the octree")
    parser.add_argument("--gap", type=float, default=0.025, help="between walls")


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
    rows = round(HEIGHT / spacing) + 1
    heights = numpy.linspace(0, HEIGHT, rows)
    vertices = numpy.array([[*point, z] for point in curve for z in heights])
    triangles = []
    for column in range(len(curve) - 1):
        for row in range(rows - 1):
            a = column * rows + row
            triangles += [[a, a + rows, a + rows + 1], [a, a + rows + 1, a + 1]]
    return vertices, numpy.array(triangles)


def main():
    figure = Reproduction("figure_4", __doc__, add_options)
    options = figure.options
    quick = options.quick
    gap, depth, steps = options.gap, options.depth, [8] if quick else STEPS
    step_size = STEP_SIZE * (10 if quick else 1)
    figure.surfaces.mkdir(parents=True, exist_ok=True)
    scan = figure.surfaces / "spiral.ply"
    write_ply(scan, *spiral(gap, gap / 2))
    reference = figure.flow(scan, step_size, steps, "cotangent", boundary="locked")
    flows = {name: figure.flow(scan, step_size, steps, configuration=solver, boundary=boundary,
                               depth=depth) for name, (solver, boundary) in CASES.items()}
    ends = {name: {**rows[-1], **figure.distance(rows[-1]["surface"], reference[-1]["surface"],
                                                 100000)} for name, rows in flows.items()}
    figure.record([{"case": name, "rms": row["rms"], "max": row["max"]}
                   for name, row in ends.items()])
    figure.table([f"after {steps[-1]} steps of {step_size:g}", "area", "RMS distance",
                  "largest distance"],
                 [["cotangent", reference[-1]["area"], 0.0, 0.0]]
                 + [[name, row["area"], row["rms"], row["max"]] for name, row in ends.items()])
    figure.say(
        f"An open spiral with walls {gap:g} apart; the longest has length 1, and an octree of depth "
        f"{depth} has cells of {1.1 / 2 ** depth:.2g}. After {steps[-1]} steps of {step_size:g} the "
        f"cotangent flow leaves {reference[-1]['area']:.4g} of the area. RMS distances from it, in "
        "diagonals: " + "; ".join(f"{name} {row['rms']:.2g}" for name, row in ends.items()) + ".\n")
    for name, row in ends.items():
        if name != OURS:
            figure.check(f"RMS distance of '{OURS}', relative to '{name}'",
                         ends[OURS]["rms"] / row["rms"], at_most=LARGEST_RATIO)
    if not quick:
        for suffix, rows in (("_paper", list(flows.values())[0]), ("_ours", flows[OURS])):
            figure.draw(suffix, [scan] + [row["surface"] for row in rows],
                        [0] + [row["steps"] for row in rows], *VIEW)
        figure.draw("", [row["surface"] for row in ends.values()] + [reference[-1]["surface"]],
                    [*ends, "cotangent"], *VIEW)
    figure.finish()


if __name__ == "__main__":
    main()
