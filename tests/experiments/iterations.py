#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the iterations of the converged solver in the first step.

The script measures tolerances of 1e-5 and the default, over step sizes and depths, on the sphere and
five scans. Targets: at most 12 iterations to 1e-5, and at the greatest depth no more than at the others;
at most 6 to the default tolerance for steps of 1e-5 and more.
"""

from experiment import CONVERGED, SPHERE, Experiment, kappa, label

TIGHT = f"{CONVERGED},tolerance=1e-5"
MOST_TO_TIGHT = 12
MOST_TO_DEFAULT = 6
SMALLEST_DEFAULT_STEP = 1e-5


def add_options(parser):
    parser.add_argument("--depths", nargs="+", type=int, default=[5, 6, 7, 8, 9])
    parser.add_argument("--step-sizes", nargs="+", type=float,
                        default=[1e-6, 1e-5, 1e-4, 1e-2, 1e-1])
    parser.add_argument("--kappas", nargs="+", type=float, default=[],
                        help="stabilisation weights to compare, such as 0 0.01 0.1 1")


def measure(experiment, configurations):
    options = experiment.options
    depths = [depth for depth in options.depths if depth <= 7] if options.quick else options.depths
    rows = []
    for mesh in [SPHERE, *experiment.scans()]:
        rows += experiment.run("iterations", mesh, "--depths", *depths, "--step-sizes",
                               *options.step_sizes, "--configurations", *configurations,
                               mesh=label(mesh))
    return rows


def of(rows, **wanted):
    """Returns the rows with these values."""
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def distinct(rows, key):
    return list(dict.fromkeys(row[key] for row in rows))


def count(rows):
    """Returns the largest number of iterations, marked if a solver missed its tolerance."""
    largest = str(max(row["iterations"] for row in rows))
    return largest if all(row["reached_tolerance"] for row in rows) else f"{largest} not reached"


def print_counts(experiment, rows, configuration):
    experiment.say(f"Iterations, {configuration}\n")
    steps = distinct(rows, "step_size")
    experiment.table(["mesh", "depth", *(f"δ = {step:g}" for step in steps)], [
        [mesh, depth, *(count(of(rows, configuration=configuration, mesh=mesh, depth=depth,
                                 step_size=step)) for step in steps)]
        for mesh in distinct(rows, "mesh") for depth in distinct(rows, "depth")])


def print_comparison(experiment, rows, kappas):
    experiment.say("Largest number of iterations over meshes and depths until 1e-5\n")
    steps = distinct(rows, "step_size")
    experiment.table(["κ", *(f"δ = {step:g}" for step in steps)], [
        [name, *(count(of(rows, configuration=configuration, step_size=step)) for step in steps)]
        for name, configuration in [("default", TIGHT), *((k, tight(k)) for k in kappas)]])


def tight(k):
    return f"{kappa(k)},tolerance=1e-5"


def largest(rows):
    return max(row["iterations"] for row in rows)


def check(experiment, rows):
    to_tight = of(rows, configuration=TIGHT)
    to_default = of(rows, configuration=CONVERGED)
    long_enough = [row for row in to_default if row["step_size"] >= SMALLEST_DEFAULT_STEP]
    depths = distinct(rows, "depth")
    by_depth = [largest(of(to_tight, depth=depth)) for depth in depths]
    experiment.say(f"Most iterations to 1e-5, by depth from {depths[0]}: "
                   f"{', '.join(map(str, by_depth))}\n")
    experiment.check("fewest iterations, which shows that they were counted",
                     min(row["iterations"] for row in to_tight + to_default), at_least=1)
    experiment.check("most iterations to 1e-5", largest(to_tight), at_most=MOST_TO_TIGHT)
    if len(depths) > 1:
        experiment.check(f"of these, at depth {depths[-1]}", by_depth[-1],
                         at_most=max(by_depth[:-1]))
    experiment.check(f"most to the default tolerance, δ ≥ {SMALLEST_DEFAULT_STEP:g}",
                     largest(long_enough), at_most=MOST_TO_DEFAULT)
    experiment.check("solves that stopped short of their tolerance",
                     sum(not row["reached_tolerance"] for row in to_tight + to_default), at_most=0)


def plot(experiment, rows):
    steps = distinct(rows, "step_size")
    figure, axes = experiment.figure(columns=len(steps), size=(3, 3.5))
    for ax, step in zip(axes[0], steps):
        for mesh in distinct(rows, "mesh"):
            line = of(rows, configuration=TIGHT, mesh=mesh, step_size=step)
            ax.plot([row["depth"] for row in line], [row["iterations"] for row in line], "o-",
                    label=mesh)
        ax.axhline(MOST_TO_TIGHT, color="black", linewidth=0.8, linestyle=":")
        ax.set_ylim(bottom=0)
        ax.set_title(f"δ = {step:g}")
        ax.set_xlabel("depth")
    axes[0][0].set_ylabel("iterations to 1e-5")
    axes[0][0].legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("iterations", __doc__, add_options)
    kappas = experiment.options.kappas
    rows = measure(experiment, [TIGHT, CONVERGED, *map(tight, kappas)])
    print_counts(experiment, rows, TIGHT)
    print_counts(experiment, rows, CONVERGED)
    if kappas:
        print_comparison(experiment, rows, kappas)
    check(experiment, rows)
    plot(experiment, rows)
    experiment.finish()


if __name__ == "__main__":
    main()
