#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 8: quadrature points of a split triangle.

The unit sphere flows a hundred steps of 1e-3 at depth 8, as in the paper, with 1, 3 and 12 quadrature
points (the paper: 1, 3 and 11): with one W-cycle (the paper: a V-cycle), and with the converged solver, whose
error does not hide that of the quadrature. The claim: three points give what the exact rule gives, and one
point much less. Samples at random instead, a fixed number for each element, are far less accurate: section
5.5 reports the same.
"""

from reproduction import CONVERGED, PAPER, Reproduction

STEPS = [1, 2, 5, 10, 20, 50, 100]
POINTS = [1, 3, 12]
RANDOM = [8, 64]  # samples of each element
SOLVERS = {PAPER: "one W-cycle", CONVERGED: "converged"}
COLOURS = dict(zip(POINTS, ["tab:blue", "tab:orange", "tab:red"]))


def main():
    figure = Reproduction("figure_8", __doc__)
    quick = figure.options.quick
    steps = STEPS[:4] if quick else STEPS
    frequency, depth = (48, 6) if quick else (192, 8)
    rows = {(solver, points): figure.run(
        "sphere", "--frequency", frequency, "--depth", depth, "--step-size", 1e-3, "--steps", *steps,
        "--configurations", f"{solver},cubature={points}", points=points)
        for solver in SOLVERS for points in POINTS}

    drawn = {count: figure.run(
        "sphere", "--frequency", frequency, "--depth", depth, "--step-size", 1e-3, "--steps", *steps,
        "--method", f"monte-carlo-{count}", points=f"{count} random") for count in RANDOM}

    figure.table(["solver", "points", "steps", "RMS", "worst vertex"], [
        [SOLVERS[solver], points, row["steps"], row["rms"], row["worst_vertex"]]
        for (solver, points), of in rows.items() for row in of[-1:]]
        + [[SOLVERS[CONVERGED], f"{count} random", row["steps"], row["rms"], row["worst_vertex"]]
           for count, of in drawn.items() for row in of[-1:]])
    much_less, as_good = [], []
    for solver, name in SOLVERS.items():
        one, three, exact = (rows[solver, points][-1]["rms"] for points in POINTS)
        if solver == CONVERGED or not quick:  # on coarse octrees, what one W-cycle leaves hides it
            much_less.append(figure.check(f"{name}: RMS with one point over that with 12",
                                          one / exact, at_least=2))
        as_good.append(figure.check(f"{name}: RMS with three points over that with 12",
                                    three / exact, at_most=1.1))
    fails = figure.check(f"converged: RMS with {RANDOM[-1]} random samples over that with 12 points",
                         drawn[RANDOM[-1]][-1]["rms"] / rows[CONVERGED, 12][-1]["rms"], at_least=3)
    figure.claim("three quadrature points are as good as the exact rule, and one is much worse",
                 all(much_less + as_good))
    figure.claim("samples at random fail", fails)

    panels, axes = figure.figure(columns=2)
    for ax, solver in zip(axes[0], SOLVERS):
        for points in POINTS:
            for error, style in (("rms", "-"), ("worst_vertex", "--")):
                ax.loglog(steps, [row[error] for row in rows[solver, points]], style,
                          color=COLOURS[points],
                          label=f"{points} points" if error == "rms" else None)
        ax.set_title(f"error of the sphere's radius ({SOLVERS[solver]})", fontsize=9)
        ax.set_xlabel("steps")
        ax.legend(fontsize=7)
    figure.save(panels)
    figure.finish()


if __name__ == "__main__":
    main()
