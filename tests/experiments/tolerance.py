#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the solver's error at a tolerance with the discretisation's error.

The solver's error is its distance to the solution at a tolerance of 1e-9. It is printed relative to that
solution's distance to the cotangent flow, over tolerances and step sizes. Target: at most a tenth at the
default tolerance.
"""

from experiment import Experiment, label

LARGEST_RATIO = 0.1


def add_options(parser):
    parser.add_argument("--depths", nargs="+", type=int, default=[7, 8])
    parser.add_argument("--step-sizes", nargs="+", type=float,
                        default=[1e-6, 1e-5, 1e-4, 1e-3, 1e-2])
    parser.add_argument("--tolerances", nargs="+", type=float,
                        default=[1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6])
    parser.add_argument("--steps", type=int, default=1)
    parser.add_argument("--configuration", default="converged",
                        help="see configuration.h")


def measure(experiment):
    options = experiment.options
    rows = []
    for scan in experiment.scans():
        rows += experiment.run("tolerance", scan, "--depths", *options.depths, "--step-sizes",
                               *options.step_sizes, "--tolerances", *options.tolerances, "--steps",
                               options.steps, "--configuration", options.configuration,
                               mesh=label(scan))
    for row in rows:
        row["ratio"] = row["solver_rms"] / row["discretisation_rms"]
    return rows


def largest(rows, figure, **wanted):
    return max(row[figure] for row in rows
               if all(row[key] == value for key, value in wanted.items()))


def print_tables(experiment, rows):
    steps = experiment.options.step_sizes
    tolerances = sorted({row["tolerance"] for row in rows}, reverse=True)
    headers = ["tolerance", *(f"δ = {step:g}" for step in steps)]
    for title, figure in [("Solver's error relative to the discretisation's", "ratio"),
                          ("Iterations", "iterations")]:
        experiment.say(f"{title}, the largest over meshes and depths\n")
        experiment.table(headers, [
            [f"{tolerance:g}", *(largest(rows, figure, tolerance=tolerance, step_size=step)
                                 for step in steps)] for tolerance in tolerances])


def plot(experiment, rows):
    figure, axes = experiment.figure()
    ax = axes[0][0]
    tolerances = sorted({row["tolerance"] for row in rows})
    for step in experiment.options.step_sizes:
        # An error of exactly 0 has no logarithm.
        ax.loglog(tolerances, [max(1e-12, largest(rows, "ratio", tolerance=tolerance,
                                                  step_size=step)) for tolerance in tolerances],
                  "o-", label=f"δ = {step:g}")
    ax.axhline(LARGEST_RATIO, color="black", linewidth=0.8, linestyle=":")
    ax.set_xlabel("tolerance")
    ax.set_ylabel("solver's error / discretisation's, largest")
    ax.legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("tolerance", __doc__, add_options)
    rows = measure(experiment)
    print_tables(experiment, rows)
    default = [row for row in rows if row["is_default"]]
    experiment.check(f"error at the default tolerance, {default[0]['tolerance']:g}, relative to "
                     "the discretisation's", largest(default, "ratio"), at_most=LARGEST_RATIO)
    experiment.check("reference solves that missed their tolerance of 1e-9",
                     sum(not row["tightest_reached"] for row in default), at_most=0)
    plot(experiment, rows)
    experiment.finish()


if __name__ == "__main__":
    main()
