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
COLOURS = dict(zip(POINTS, ["tab:blue", "tab:orange", "tab:red"]))


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
    much_less, as_good = [], []
    for solver, name in SOLVERS.items():
        one, three, exact = (rows[solver, points] for points in POINTS)
        if solver == MANY or not quick:  # on coarse octrees, what one W-cycle leaves hides it
            much_less.append(figure.check(f"{name}: RMS with one point over that with 12",
                                          ratio(one, exact), at_least=2))
        as_good.append(figure.check(f"{name}: RMS with three points over that with 12",
                                    ratio(three, exact), at_most=1.1))
    fails = figure.check(f"{SOLVERS[MANY]}: RMS with {RANDOM[-1]} random samples over that with 12 points",
                         ratio(drawn[RANDOM[-1]], rows[MANY, 12]), at_least=3)
    figure.claim("three quadrature points are as good as the exact rule, and one is much worse",
                 all(much_less + as_good))
    figure.claim("samples at random fail", fails)

    panels, axes = figure.figure(columns=2)
    for ax, solver in zip(axes[0], SOLVERS):
        for points in POINTS:
            for error, style in (("rms", "-"), ("worst_vertex", "--")):
                of = rows[solver, points]
                ax.loglog([row["steps"] for row in of], [row[error] for row in of], style,
                          color=COLOURS[points],
                          label=f"{points} points" if error == "rms" else None)
        ax.set_title(f"error of the sphere's radius ({SOLVERS[solver]})", fontsize=9)
        ax.set_xlabel("steps")
        ax.legend(fontsize=7)
    figure.save(panels)
    figure.finish()


if __name__ == "__main__":
    main()
