#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 8: quadrature points of a split triangle.

The unit sphere flows a hundred steps of 1e-3 with 1, 3 and 12 quadrature points (the paper: 1, 3 and 11): at
depth 8 with one W-cycle (the paper: a V-cycle), and at depth 7 with 10 W-cycles, whose error hides less of that
of the quadrature. The claim: three points give what the exact rule gives, and one point much less. Samples at
random instead, a fixed number for each element, are far less accurate: section 5.5 reports the same. A flow ends
where its surface leaves the initial box. Errors are compared after the last measured step that both flows made.
"""

from reproduction import PAPER, Reproduction

STEPS = [1, 2, 5, 10, 20, 50, 100]
POINTS = [1, 3, 12]
RANDOM = [8, 64]  # samples of each element
MANY = f"{PAPER},cycles=10"
SOLVERS = {PAPER: "one W-cycle", MANY: "10 W-cycles"}
SPHERES = {PAPER: (192, 8), MANY: (96, 7)}  # frequency and depth
STYLES = {1: {"color": "tab:blue"}, 12: {"color": "tab:red", "linewidth": 5, "alpha": 0.35}, 3: {"color": "black"},
          8: {"color": "0.75"}, 64: {"color": "0.5"}}


def ratio(rows, others):
    """Returns the ratio of two flows' RMS errors after the last step that both have made."""
    errors = {row["steps"]: row["rms"] for row in others}
    last = [row for row in rows if row["steps"] in errors][-1]
    return last["rms"] / errors[last["steps"]]


def main():
    figure = Reproduction("figure_8", __doc__)
    quick = figure.options.quick
    steps = STEPS[:4] if quick else STEPS

    def sphere(solver, points, configuration, method="tracked"):
        frequency, depth = SPHERES[MANY if quick else solver]
        return figure.run("sphere", "--frequency", frequency, "--depth", depth, "--step-size", 1e-3,
                          "--steps", *steps, "--configurations", configuration, "--method", method,
                          points=points)

    rows = {(solver, points): sphere(solver, points, f"{solver},cubature={points}")
            for solver in SOLVERS for points in POINTS}
    drawn = {count: sphere(MANY, f"{count} random", MANY, f"monte-carlo-{count}") for count in RANDOM}

    figure.table(["solver", "points", "steps", "RMS", "worst vertex"], [
        [SOLVERS[solver], points, row["steps"], row["rms"], row["worst_vertex"]]
        for (solver, points), of in rows.items() for row in of[-1:]]
        + [[SOLVERS[MANY], f"{count} random", row["steps"], row["rms"], row["worst_vertex"]]
           for count, of in drawn.items() for row in of[-1:]])
    worse, as_good = [], []
    for solver, name in SOLVERS.items():
        one, three, exact = (rows[solver, points] for points in POINTS)
        if solver == MANY or not quick:  # on coarse octrees, what one W-cycle leaves hides it
            worse.append(ratio(one, exact))
            figure.check(f"{name}: RMS with one point over that with 12", worse[-1], at_least=1)
        as_good.append(ratio(three, exact))
        figure.check(f"{name}: RMS with three points over that with 12", as_good[-1], at_most=1.1)
    at_random = ratio(drawn[RANDOM[-1]], rows[MANY, 12])
    figure.claim(f"three quadrature points are as good as the exact rule: at most {max(as_good):.3g} times its error",
                 max(as_good) <= 1.1)
    figure.claim(f"one quadrature point is worse than the exact rule: at least {min(worse):.3g} times its error", min(worse) > 1)
    figure.claim(f"{RANDOM[-1]} samples at random are worse than the exact rule: {at_random:.3g} times its error", at_random > 1)

    plot(figure, rows, drawn)
    figure.finish()


def plot(figure, rows, drawn):
    """Draws RMS and worst vertex over the steps. Three points hide the exact rule, unless its line is wider."""
    panels, axes = figure.figure(columns=2)
    for ax, solver in zip(axes[0], SOLVERS):
        lines = [(f"{points} point{'s' if points > 1 else ''}", STYLES[points], rows[solver, points]) for points in STYLES if points in POINTS]
        if solver == MANY:
            lines += [(f"{count} random samples", STYLES[count], of) for count, of in drawn.items()]
        for name, style, of in lines:
            steps = [row["steps"] for row in of]
            ax.loglog(steps, [row["rms"] for row in of], label=name, **style)
            ax.loglog(steps, [row["worst_vertex"] for row in of], "--", **style)
        ax.set_title(SOLVERS[solver], fontsize=9)
        ax.set_xlabel("steps")
        ax.set_ylabel("error of the radius: RMS, worst (dashed)")
        ax.legend(fontsize=7)
    figure.save(panels)


if __name__ == "__main__":
    main()
