#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the converged solver and the paper's by their distance to the cotangent flow.

Five scans flow 1 and 10 steps of 1e-5 at depths 7 and 8 with free boundaries. The distance is the root
mean square along the normal, in 1e-5 of the diagonal of the initial bounding box. Targets: the converged
solver's distance is at most 1.1 times the paper's, and at most equal in the geometric mean.
"""

from experiment import (CONVERGED, PAPER, Experiment, geometric_mean, kappa, label)

UNIT = 1e-5
LARGEST_RATIO = 1.1
LARGEST_MEAN_RATIO = 1.0


def add_options(parser):
    parser.add_argument("--depths", nargs="+", type=int, default=[7, 8])
    parser.add_argument("--steps", nargs="+", type=int, default=[1, 10])
    parser.add_argument("--step-size", type=float, default=1e-5)
    parser.add_argument("--kappas", nargs="+", type=float, default=[],
                        help="further stabilisation weights to compare")
    parser.add_argument("--configurations", nargs="+", default=[],
                        help="further configurations to compare, see configuration.h")


def measure(experiment, configurations):
    """Returns the rows by (mesh, depth, steps) and configuration."""
    options = experiment.options
    cases = {}
    depths = options.depths[:1] if options.quick else options.depths
    for scan in experiment.scans():
        rows = experiment.run("accuracy", scan, "--depths", *depths, "--steps",
                              *options.steps, "--step-size", options.step_size,
                              "--configurations", *configurations, mesh=label(scan))
        for row in rows:
            case = (row["mesh"], row["depth"], row["steps"])
            cases.setdefault(case, {})[row["configuration"]] = row
    return cases


def ratios(cases, configuration, figure="rms"):
    """Returns the ratio to the paper's solver for each case."""
    return [case[configuration][figure] / case[PAPER][figure] for case in cases.values()]


def print_tables(experiment, cases, configurations):
    experiment.say("RMS distance, in 1e-5 of the diagonal\n")
    experiment.table(["mesh", "depth", "steps", "moved", *configurations], [
        [*key, case[PAPER]["moved"] / UNIT, *(case[c]["rms"] / UNIT for c in configurations)]
        for key, case in cases.items()])
    experiment.say("The same as ratios to the paper's solver\n")
    others = configurations[1:]
    rows = [[*key, *(case[c]["rms"] / case[PAPER]["rms"] for c in others)]
            for key, case in cases.items()]
    rows.append(["largest", "", "", *(max(ratios(cases, c)) for c in others)])
    rows.append(["geometric mean", "", "", *(geometric_mean(ratios(cases, c)) for c in others)])
    rows.append(["  of worst vertices", "", "",
                 *(geometric_mean(ratios(cases, c, "worst")) for c in others)])
    experiment.table(["mesh", "depth", "steps", *others], rows)
    experiment.say("Iterations of the solver over all steps, and processor seconds, summed over meshes "
                   "and depths\n")
    last = [case for key, case in cases.items() if key[2] == max(experiment.options.steps)]
    experiment.table(["", *configurations], [
        [figure, *(sum(case[c][figure] for case in last) for c in configurations)]
        for figure in ("iterations", "seconds")])


def plot(experiment, cases, configurations):
    figure, axes = experiment.figure(size=(10, 4.5))
    ax = axes[0][0]
    indices = range(len(cases))
    for configuration in configurations[1:]:
        ax.plot(indices, ratios(cases, configuration), "o-", label=configuration)
    ax.axhline(1, color="black", linewidth=0.8)
    ax.axhline(LARGEST_RATIO, color="black", linewidth=0.8, linestyle=":")
    ax.set_xticks(indices, [f"{m}, depth {d}, {s} steps" for m, d, s in cases], rotation=40,
                  ha="right", fontsize=7)
    ax.set_ylabel("RMS distance to the cotangent flow,\nrelative to the paper's solver")
    ax.legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("accuracy", __doc__, add_options)
    options = experiment.options
    configurations = [PAPER, CONVERGED, *map(kappa, options.kappas), *options.configurations]
    cases = measure(experiment, configurations)
    print_tables(experiment, cases, configurations)
    experiment.check("largest ratio of the converged solver to the paper's",
                     max(ratios(cases, CONVERGED)), at_most=LARGEST_RATIO)
    experiment.check("geometric mean of the ratios", geometric_mean(ratios(cases, CONVERGED)),
                     at_most=LARGEST_MEAN_RATIO)
    plot(experiment, cases, configurations)
    experiment.finish()


if __name__ == "__main__":
    main()
