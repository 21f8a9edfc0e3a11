#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 9: an open head with a locked boundary under short and under long steps.

Short steps pinch at the neck and leave the head as a thread. Long steps approach a minimal surface without
pinching (section 5.3). A minimal surface lies in the convex hull of its boundary, so the largest distance of
a vertex from the boundary's bounding box tells a thread from a minimal surface. A single very long step
should reach the minimiser of the Dirichlet energy over the initial surface. The cotangent method computes it
with the boundary's vertices fixed and a step so long that a longer one changes nothing.

The paper's method leaves what has collapsed where it is, so its short steps keep the thread. Where the first long
step collapses a thin part, such as a horn, the later ones pull a thread, too. The product's method leaves nothing
behind: its short steps reach the minimal surface, too. But the product limits a step to 5e4 squared mean edges,
which is 8.5 here. So its very long step is shorter than asked for, and the last claim does not hold.

Lengths are in diagonals of the scan, areas relative to the start. Ten long steps are compared with a hundred
short ones.
"""

from reproduction import CONVERGED, PAPER, Reproduction

SHORT, LONG, LONGEST = 1e-3, 1.0, 20.0
ENDLESS = 1e6  # as a step, the Dirichlet minimiser
STEPS = {SHORT: [5, 10, 20, 30, 40, 60, 100], LONG: [1, 2, 3, 5, 9, 10]}
METHODS = {PAPER: "paper's method", CONVERGED: "product"}
FLOWS = {"short": (SHORT, PAPER), "long": (LONG, PAPER), "product_short": (SHORT, CONVERGED),
         "product_long": (LONG, CONVERGED)}
DRAWN = {"short": [10, 20, 30, 40, 100], "long": [1, 2, 3, 10], "product_short": [10, 20, 30, 40, 100]}
LARGEST_CHANGE = 1e-3
SHORTEST_THREAD, LARGEST_BULGE = 0.1, 0.01  # in diagonals
LARGEST_DISTANCE = 0.02  # RMS, in diagonals of the minimiser
SAMPLES = 20000  # for the distance
VIEW = ["--view", -1, 0.4, -0.45, "--up", 0, 0, 1, "--height", 450]


def add_options(parser):
    parser.add_argument("--depth", type=int, default=6, help="of the paper's octree")


def flow(figure, scan, step_size, steps, method):
    return figure.flow(scan, step_size, steps, configuration=method, boundary="locked",
                       depth=figure.options.depth if method == PAPER else 0)


def measure_steps(figure, scan):
    """Returns, by flow and number of steps, the driver's rows."""
    stages = {name: {row["steps"]: row for row in flow(figure, scan, step_size, STEPS[step_size], method)}
              for name, (step_size, method) in FLOWS.items()}
    figure.table(["method", "steps of", "after", "area", "beyond the boundary's box"],
                 [[METHODS[FLOWS[name][1]], FLOWS[name][0], steps, row["area"], row["beyond_boundary"]]
                  for name, rows in stages.items() for steps, row in rows.items()])
    return stages


def measure_longest(figure, scan):
    """Returns the minimiser's row, and for each method the row of the very long step."""
    [minimiser] = figure.flow(scan, ENDLESS, [1], "cotangent", boundary="locked")
    rows = {}
    for method in METHODS:
        [row] = flow(figure, scan, LONGEST, [1], method)
        rows[method] = {**row, **figure.distance(row["surface"], minimiser["surface"],
                                                 2000 if figure.options.quick else SAMPLES)}
    figure.record([{"method": METHODS[method], "rms": row["rms"], "max": row["max"]}
                   for method, row in rows.items()])
    figure.table([f"one step of {LONGEST:g}", "area", "RMS distance", "largest distance"],
                 [["minimiser", minimiser["area"], 0.0, 0.0]]
                 + [[METHODS[method], row["area"], row["rms"], row["max"]] for method, row in rows.items()])
    return minimiser, rows


def check(figure, stages, longest):
    """Checks the product, and says what holds for the paper's method."""
    short, long = (stages[name] for name in ("short", "long"))
    thread, bulge = short[100]["beyond_boundary"], long[10]["beyond_boundary"]
    figure.claim(f"short steps pinch: a hundred leave a vertex {thread:.2g} diagonals from the boundary's box",
                 thread >= SHORTEST_THREAD)
    figure.claim("long steps approach the minimal surface without pinching: ten leave a vertex "
                 f"{bulge:.2g} diagonals from the boundary's box, and {long[10]['area'] / short[100]['area']:.3g} "
                 "times the area of a hundred short ones",
                 bulge <= LARGEST_BULGE and long[10]["area"] <= short[100]["area"])
    short, long = (stages[f"product_{name}"] for name in ("short", "long"))
    reached = [
        figure.check("product: distance from the boundary's box after ten long steps", long[10]["beyond_boundary"],
                     at_most=LARGEST_BULGE),
        figure.check("product: change of the area in the tenth long step",
                     abs(1 - long[10]["area"] / long[9]["area"]), at_most=LARGEST_CHANGE),
        figure.check("product: distance from the boundary's box after a hundred short steps",
                     short[100]["beyond_boundary"], at_most=LARGEST_BULGE),
        figure.check("product: change of the area from ten long steps to a hundred short ones",
                     abs(1 - short[100]["area"] / long[10]["area"]), at_most=LARGEST_CHANGE)]
    figure.claim("the product's short steps reach the minimal surface, too", all(reached))
    for method, name in METHODS.items():
        distance = longest[method]["rms"]
        figure.claim(f"{name}: a very long step is near the minimiser of the Dirichlet energy, at most "
                     f"{LARGEST_DISTANCE} of a diagonal away (RMS): {distance:.2g}", distance <= LARGEST_DISTANCE)


def plot(figure, stages):
    curves, axes = figure.figure()
    ax = axes[0][0]
    for name, rows in stages.items():
        ax.semilogx(list(rows), [row["area"] for row in rows.values()], "o-",
                    label=f"{METHODS[FLOWS[name][1]]}: steps of {FLOWS[name][0]:g}")
    ax.set_xlabel("steps")
    ax.set_ylabel("area, relative to the start")
    ax.legend(fontsize=7)
    figure.save(curves)


def draw(figure, scan, stages, minimiser, longest):
    for name, steps in DRAWN.items():
        figure.draw(f"_{name}", [scan] + [stages[name][n]["surface"] for n in steps],
                    ["before"] + [f"{n} × {FLOWS[name][0]:g}" for n in steps], *VIEW)
    figure.draw("_minimiser", [minimiser["surface"]] + [row["surface"] for row in longest.values()],
                ["minimiser", *METHODS.values()], *VIEW[:-1], 220)


def main():
    figure = Reproduction("figure_9", __doc__, add_options)
    [scan] = figure.scans(["mannequin_11k.ply"], ["mannequin-devil.off"])
    stages = measure_steps(figure, scan)
    minimiser, longest = measure_longest(figure, scan)
    check(figure, stages, longest)
    if not figure.options.quick:
        plot(figure, stages)
        draw(figure, scan, stages, minimiser, longest)
    figure.finish()


if __name__ == "__main__":
    main()
