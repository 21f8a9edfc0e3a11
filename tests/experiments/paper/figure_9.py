#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 9: an open head with a locked boundary under short and under long steps.

Short steps pinch at the neck and leave the head as a thread. Long steps approach the minimiser of the
Dirichlet energy, and so a minimal surface, without pinching (section 5.3). A single very long step should
reach the minimiser of the initial surface, which the cotangent method computes with the same step and the
boundary's vertices fixed. Areas are relative to the start.

Targets: ten long steps end with at most the area of a hundred short ones; the tenth changes the area by at
most 1e-3 of it; the short steps have pinched the head off, so a part of the surface has collapsed. The
very long step is closer to the minimiser with the boundary's curve locked than with its cells locked.
"""

from reproduction import CONVERGED, PAPER, Reproduction

SHORT, LONG, LONGEST = 1e-3, 1.0, 20.0
STEPS = {SHORT: [5, 10, 20, 30, 40, 60, 100], LONG: [1, 2, 3, 5, 9, 10]}
DRAWN = {SHORT: [10, 20, 30, 40, 100], LONG: [1, 2, 3, 10]}
NAMES = {SHORT: "short", LONG: "long"}
LOCKS = {(CONVERGED, "locked"): "curve locked", (CONVERGED, "locked-cells"): "cells locked",
         (PAPER, "locked-cells"): "cells locked, paper's solver"}
LARGEST_CHANGE = 1e-3
SMALLEST_COLLAPSED = 0.01
LARGEST_DISTANCE = 0.02  # RMS, in diagonals of the minimiser
SAMPLES = 20000  # for the distance
VIEW = ["--view", -1, 0.4, -0.45, "--up", 0, 0, 1, "--height", 450]


def add_options(parser):
    parser.add_argument("--depth", type=int, default=6, help="of the octree")


def measure_steps(figure, scan):
    stages = {step_size: {row["steps"]: row for row in figure.flow(
        scan, step_size, steps, depth=figure.options.depth, boundary="locked")}
              for step_size, steps in STEPS.items()}
    figure.table(["steps of", "after", "area", "collapsed"],
                 [[step_size, steps, row["area"], row["collapsed"]]
                  for step_size, rows in stages.items() for steps, row in rows.items()])
    return stages


def measure_longest(figure, scan):
    """Returns the minimiser's row, and for each lock the row of the very long step."""
    [minimiser] = figure.flow(scan, LONGEST, [1], "cotangent", boundary="locked")
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
    short, long = stages[SHORT], stages[LONG]
    curve, cells, paper = longest.values()
    figure.say(
        f"{scan.stem}, an open head. After 100 steps of {SHORT:g} the area is {short[100]['area']:.3g}, "
        f"and {100 * short[100]['collapsed']:.3g} % of the samples have collapsed: the neck has pinched. "
        f"After 10 steps of {LONG:g} the area is {long[10]['area']:.3g}, and "
        f"{100 * long[10]['collapsed']:.3g} % have collapsed. One step of {LONGEST:g} ends "
        f"{curve['rms']:.2g} of a diagonal (RMS) from the Dirichlet minimiser with the boundary's curve "
        f"locked, {cells['rms']:.2g} with its cells locked, and {paper['rms']:.2g} with one cycle of the "
        "paper's solver.\n")


def check(figure, stages, longest):
    short, long = stages[SHORT], stages[LONG]
    curve, cells, _ = longest.values()
    figure.check("area after ten long steps, relative to that after a hundred short ones",
                 long[10]["area"] / short[100]["area"], at_most=1.0)
    figure.check("change of the area in the tenth long step",
                 abs(1 - long[10]["area"] / long[9]["area"]), at_most=LARGEST_CHANGE)
    figure.check("collapsed share of the samples after a hundred short steps",
                 short[100]["collapsed"], at_least=SMALLEST_COLLAPSED)
    figure.check("RMS distance of the very long step from the minimiser, curve locked",
                 curve["rms"], at_most=LARGEST_DISTANCE)
    figure.check("the same, relative to that with cells locked", curve["rms"] / cells["rms"],
                 at_most=0.5)


def plot(figure, stages):
    curves, axes = figure.figure()
    ax = axes[0][0]
    for step_size, rows in stages.items():
        ax.semilogx(list(rows), [row["area"] for row in rows.values()], "o-",
                    label=f"steps of {step_size:g}")
    ax.set_xlabel("steps")
    ax.set_ylabel("area, relative to the start")
    ax.legend(fontsize=7)
    figure.save(curves)


def draw(figure, scan, stages, minimiser, longest):
    for step_size, name in NAMES.items():
        steps = DRAWN[step_size]
        figure.draw(f"_{name}", [scan] + [stages[step_size][n]["surface"] for n in steps],
                    ["before"] + [f"{n} × {step_size:g}" for n in steps], *VIEW)
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
