#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the unit sphere with its exact semi-implicit radius.

163,842 vertices flow 100 absolute steps of 1e-3. The script prints the errors of the mean radius and of
the worst vertex by depth. Targets for the converged solver: at most 4e-6 and 3e-5 at depth 7, and second
order in the cell size. The mesh has an error of its own, the same at each depth, because only its
vertices lie on the sphere. So the order of the mean radius is that of its differences between depths. It
is measured at a tolerance of 1e-8, at which the solver's error is negligible.
"""

import math

from experiment import CONVERGED, PAPER, Experiment, kappa

TARGET_DEPTH = 7
LARGEST_MEAN_ERROR = 4e-6
LARGEST_WORST_VERTEX = 3e-5
SMALLEST_ORDER = 1.8  # fitted over all depths; 2 except for the errors of mesh and tolerance
TIGHT = f"{CONVERGED},tolerance=1e-8"
FREQUENCY = 128
MESH_FREQUENCY = 64  # for the mesh's own error, which is of second order
ERRORS = {"mean_error": "mean radius", "worst_vertex": "worst vertex"}


def add_options(parser):
    parser.add_argument("--depths", nargs="+", type=int, default=[4, 5, 6, 7, 8])
    parser.add_argument("--kappas", nargs="+", type=float, default=[],
                        help="further stabilisation weights to compare")
    parser.add_argument("--configurations", nargs="+", default=[],
                        help="further configurations to compare, see configuration.h")


def slope(xs, ys):
    """Returns the slope of the best fit of log y over log x."""
    xs, ys = [[math.log(value) for value in values] for values in (xs, ys)]
    x_mean, y_mean = sum(xs) / len(xs), sum(ys) / len(ys)
    return (sum((x - x_mean) * (y - y_mean) for x, y in zip(xs, ys))
            / sum((x - x_mean) ** 2 for x in xs))


def order(rows, error):
    sizes, errors = [row["cell_size"] for row in rows], [row[error] for row in rows]
    if error == "mean_error":
        errors = [coarse - fine for coarse, fine in zip(errors, errors[1:])]
        sizes = sizes[:-1]
    return slope(sizes, [max(1e-17, abs(value)) for value in errors])


def print_table(experiment, lines):
    for configuration, rows in lines.items():
        experiment.say(f"{configuration}\n")
        experiment.table(["depth", "cell size", *ERRORS.values(), "iterations in all"], [
            [row["depth"], row["cell_size"], *(row[error] for error in ERRORS), row["iterations"]]
            for row in rows] + [["order", "", *(order(rows, error) for error in ERRORS), ""]])


def print_mesh_error(experiment, frequency):
    [row] = experiment.run("sphere", "--frequency", MESH_FREQUENCY, "--method",
                           "cotangent")
    scale = (MESH_FREQUENCY / frequency) ** 2
    experiment.say(f"The mesh's own error, by the cotangent flow at frequency {MESH_FREQUENCY}, "
                   f"scaled to {frequency}: mean radius {row['mean_error'] * scale:.2g}, worst "
                   f"vertex {row['worst_vertex'] * scale:.2g}\n")


def check(experiment, rows, tight):
    for row in rows:
        if row["depth"] == TARGET_DEPTH:
            experiment.check("error of the mean radius", abs(row["mean_error"]),
                             at_most=LARGEST_MEAN_ERROR)
            experiment.check("worst vertex", row["worst_vertex"], at_most=LARGEST_WORST_VERTEX)
    for error, name in ERRORS.items():
        experiment.check(f"order in the cell size, {name}", order(tight, error),
                         at_least=SMALLEST_ORDER)


def plot(experiment, lines):
    figure, axes = experiment.figure(columns=len(ERRORS))
    for ax, (error, name) in zip(axes[0], ERRORS.items()):
        for configuration, rows in lines.items():
            ax.loglog([row["cell_size"] for row in rows], [abs(row[error]) for row in rows], "o-",
                      label=configuration)
        rows = lines[CONVERGED]
        ax.loglog([row["cell_size"] for row in rows],
                  [abs(rows[0][error]) * (row["cell_size"] / rows[0]["cell_size"]) ** 2
                   for row in rows], "k:", linewidth=0.8, label="order 2")
        ax.set_title(f"error, {name}")
        ax.set_xlabel("cell size (the sphere's radius is 1)")
        ax.legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("sphere", __doc__, add_options)
    options = experiment.options
    configurations = [PAPER, CONVERGED, TIGHT, *map(kappa, options.kappas), *options.configurations]
    frequency, depths = (64, [3, 4, 5]) if options.quick else (FREQUENCY, options.depths)
    rows = experiment.run("sphere", "--frequency", frequency, "--depths", *depths,
                          "--configurations", *configurations)
    lines = {configuration: [row for row in rows if row["configuration"] == configuration]
             for configuration in configurations}
    print_table(experiment, lines)
    print_mesh_error(experiment, frequency)
    if not options.quick:  # on a small sphere the mesh's own error hides all others
        check(experiment, lines[CONVERGED], lines[TIGHT])
    plot(experiment, lines)
    experiment.finish()


if __name__ == "__main__":
    main()
