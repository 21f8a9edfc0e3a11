#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 9: an open head with a locked boundary under short and under long steps.

Short steps pinch at the neck and leave the head as a thread. Long steps approach a minimal surface without
pinching (section 5.3). A minimal surface lies in the convex hull of its boundary, so the largest distance of
a vertex from the boundary's bounding box tells a thread from a minimal surface. A single very long step
should reach the minimiser of the Dirichlet energy over the initial surface. The cotangent method computes it
with the boundary's vertices fixed and a step so long that a longer one changes nothing.

The product holds a part that has collapsed in its place. Where the first long step collapses a thin part, such
as a horn, later ones pull a thread, too. So there are two claims: one for the product, and one for long steps
that hold nothing, which the checks are for. Short steps need to hold such parts: without, the flow stops at the
pinch.

Lengths are in diagonals of the scan, areas relative to the start. Ten long steps are compared with a hundred
short ones.
"""

from reproduction import CONVERGED, PAPER, Reproduction

SHORT, LONG, LONGEST = 1e-3, 1.0, 20.0
ENDLESS = 1e6  # as a step, the Dirichlet minimiser
STEPS = {SHORT: [5, 10, 20, 30, 40, 60, 100], LONG: [1, 2, 3, 5, 9, 10]}
DRAWN = {"short": [10, 20, 30, 40, 100], "long": [1, 2, 3, 10]}
FLOWS = {"short": (SHORT, CONVERGED), "long": (LONG, CONVERGED),
         "long, nothing held": (LONG, f"{CONVERGED},free-pinches")}
LOCKS = {(CONVERGED, "locked"): "curve locked", (CONVERGED, "locked-cells"): "cells locked",
         (PAPER, "locked-cells"): "cells locked, paper's solver"}
LARGEST_CHANGE = 1e-3
SHORTEST_THREAD, LARGEST_BULGE = 0.1, 0.01  # in diagonals
LARGEST_DISTANCE = 0.02  # RMS, in diagonals of the minimiser
SAMPLES = 20000  # for the distance
VIEW = ["--view", -1, 0.4, -0.45, "--up", 0, 0, 1, "--height", 450]


def add_options(parser):
    parser.add_argument("--depth", type=int, default=6, help="of the octree")


def measure_steps(figure, scan):
    """Returns, by flow and number of steps, the driver's rows."""
    stages = {name: {row["steps"]: row for row in figure.flow(
        scan, step_size, STEPS[step_size], configuration=solver, depth=figure.options.depth,
        boundary="locked")} for name, (step_size, solver) in FLOWS.items()}
    figure.table(["flow", "steps of", "after", "area", "beyond the boundary's box"],
                 [[name, FLOWS[name][0], steps, row["area"], row["beyond_boundary"]]
                  for name, rows in stages.items() for steps, row in rows.items()])
    return stages


def measure_longest(figure, scan):
    """Returns the minimiser's row, and for each lock the row of the very long step."""
    [minimiser] = figure.flow(scan, ENDLESS, [1], "cotangent", boundary="locked")
    rows = {}
    for (solver, boundary), name in LOCKS.items():
        [row] = figure.flow(scan, LONGEST, [1], configuration=solver, boundary=boundary,
                            depth=figure.options.depth)
        rows[name] = {**row, **figure.distance(row["surface"], minimiser["surface"],
                                                2000 if figure.options.quick else SAMPLES)}
    figure.record([{"boundary": name, "rms": row["rms"], "max": row["max"]}
                   for name, row in rows.items()])
    figure.table([f"one step of {LONGEST:g}", "area", "RMS distance", "largest distance"],
                 [["minimiser", minimiser["area"], 0.0, 0.0]]
                 + [[name, row["area"], row["rms"], row["max"]] for name, row in rows.items()])
    return minimiser, rows


def tell(figure, scan, stages, longest):
    short, long, free = stages["short"][100], *(stages[name][10] for name in list(FLOWS)[1:])
    curve, cells, paper = longest.values()
    figure.say(
        f"{scan.stem}, an open head. After 100 steps of {SHORT:g} the area is {short['area']:.3g}, and a "
        f"vertex is still {short['beyond_boundary']:.2g} of a diagonal from the boundary's box. After 10 "
        f"steps of {LONG:g} the area is {long['area']:.3g}, and the farthest vertex is "
        f"{long['beyond_boundary']:.2g} from the box, {free['beyond_boundary']:.2g} if no collapsed part "
        f"is held. One step of {LONGEST:g} ends {curve['rms']:.2g} of a "
        "diagonal (RMS) from the Dirichlet minimiser with the boundary's curve locked, "
        f"{cells['rms']:.2g} with its cells locked, and {paper['rms']:.2g} with one cycle of the paper's "
        "solver.\n")


def check(figure, stages, longest):
    short, long = stages["short"], stages["long, nothing held"]
    curve, cells, _ = longest.values()
    minimal = [
        figure.check("area after ten long steps, relative to that after a hundred short ones",
                     long[10]["area"] / short[100]["area"], at_most=1.0),
        figure.check("change of the area in the tenth long step",
                     abs(1 - long[10]["area"] / long[9]["area"]), at_most=LARGEST_CHANGE),
        figure.check("distance from the boundary's box after a hundred short steps: pinched",
                     short[100]["beyond_boundary"], at_least=SHORTEST_THREAD),
        figure.check("the same after ten long steps: not pinched", long[10]["beyond_boundary"],
                     at_most=LARGEST_BULGE)]
    figure.claim("short steps pinch, and long ones that hold nothing approach the minimal surface "
                 "without pinching", all(minimal))
    bulge = stages["long"][10]["beyond_boundary"]
    figure.claim("the product's long steps, which hold what has collapsed, do not pinch: a vertex is "
                 f"{bulge:.2g} diagonals from the boundary's box", bulge <= LARGEST_BULGE)
    near = [figure.check("RMS distance of the very long step from the minimiser, curve locked",
                         curve["rms"], at_most=LARGEST_DISTANCE),
            figure.check("the same, relative to that with cells locked", curve["rms"] / cells["rms"],
                         at_most=0.5)]
    figure.claim("a very long step is near the minimiser of the Dirichlet energy", all(near))


def plot(figure, stages):
    curves, axes = figure.figure()
    ax = axes[0][0]
    for name, rows in stages.items():
        ax.semilogx(list(rows), [row["area"] for row in rows.values()], "o-",
                    label=f"{name}: steps of {FLOWS[name][0]:g}")
    ax.set_xlabel("steps")
    ax.set_ylabel("area, relative to the start")
    ax.legend(fontsize=7)
    figure.save(curves)


def draw(figure, scan, stages, minimiser, longest):
    for name, steps in DRAWN.items():
        figure.draw(f"_{name}", [scan] + [stages[name][n]["surface"] for n in steps],
                    ["before"] + [f"{n} × {FLOWS[name][0]:g}" for n in steps], *VIEW)
    figure.draw("_minimiser", [minimiser["surface"]] + [row["surface"] for row in longest.values()],
                ["minimiser"] + list(longest), *VIEW[:-1], 220)


def main():
    figure = Reproduction("figure_9", __doc__, add_options)
    [scan] = figure.scans(["mannequin_11k.ply"], ["mannequin-devil.off"])
    if figure.options.quick:
        figure.options.depth = 5
    stages = measure_steps(figure, scan)
    minimiser, longest = measure_longest(figure, scan)
    tell(figure, scan, stages, longest)
    check(figure, stages, longest)
    if not figure.options.quick:
        plot(figure, stages)
        draw(figure, scan, stages, minimiser, longest)
    figure.finish()


if __name__ == "__main__":
    main()
