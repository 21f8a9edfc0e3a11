#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Flows a cylinder between two unit rings 0.8 apart to rest and measures its distance to the catenoid.

The mesh has 360 by 48 quads and makes 40 relative steps of 4. The script prints the RMS error of the
vertices' radius by depth, for the exact lock of the boundary and for the paper's lock of cells, with the
axis along the grid and tilted. Along the grid, a trilinear function cannot be better than chords between
grid planes; their error is printed, too. Targets: order at least 1.5 in the cell size down to the mesh's
own error; at most 3e-4 at depth 5 when tilted; at most 1.1 times the chords along the grid; the paper's
lock at least 10 times farther; the same surface for any step size. Enneper's surface, started as a cone:
order at least 1.3 over all depths.
"""

import math

from experiment import CONVERGED, Experiment

EXACT = f"{CONVERGED},locked"
PAPERS = f"{CONVERGED},locked-cells"
PAPERS_SOLVER = "paper,locked-cells"
NAMES = {EXACT: "boundary locked", PAPERS: "cells locked", PAPERS_SOLVER: "cells locked, paper's solver"}
TILT = 0.3
ORIENTATIONS = {0: "along the grid", TILT: "tilted"}
STEP_SIZES = [0.1, 1, 4, 100]
DEPTH = 5
MESH_ERROR = 1 - math.cos(math.pi / 360)  # largest distance of a circle from its chords
SMALLEST_ORDER = 1.5
SMALLEST_ENNEPER_ORDER = 1.3  # over all depths; the last includes the mesh's own error
LARGEST_TILTED = 3e-4
TARGET = 3e-4  # for either orientation; below the error of the chords along the grid
LARGEST_OVER_CHORDS = 1.1
SMALLEST_GAIN = 10
LARGEST_SPREAD = 0.1  # of the distances over the step sizes


def add_options(parser):
    parser.add_argument("--depths", nargs="+", type=int, default=[4, 5, 6, 7])


def orders(rows):
    """Returns the orders between consecutive depths, except where the error is the mesh's own."""
    return [math.log2(coarse["rms"] / fine["rms"]) for coarse, fine in zip(rows, rows[1:])
            if coarse["rms"] > 2 * MESH_ERROR]


def chosen(rows, **wanted):
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def by_depth(experiment, depths):
    rows = experiment.run("minimal", "--tilts", *ORIENTATIONS, "--depths", *depths,
                          "--configurations", *NAMES)
    experiment.say("RMS distance to the catenoid\n")
    table = []
    for tilt, orientation in ORIENTATIONS.items():
        for configuration, name in NAMES.items():
            line = chosen(rows, tilt=tilt, configuration=configuration)
            table.append([orientation, name, *(row["rms"] for row in line),
                          ", ".join(f"{order:.2f}" for order in orders(line))])
        if tilt == 0:
            line = chosen(rows, tilt=tilt, configuration=EXACT)
            table.append([orientation, "chords of the exact catenoid", *(row["chords"] for row in line),
                          ""])
    experiment.table(["axis", "lock", *(f"depth {depth}" for depth in depths), "orders"], table)
    experiment.say("Slip at the rings, boundary locked: RMS, worst\n")
    experiment.table(["axis", *(f"depth {depth}" for depth in depths)], [
        [orientation, *(f"{row['slip_rms']:.2g}, {row['slip_worst']:.2g}"
                        for row in chosen(rows, tilt=tilt, configuration=EXACT))]
        for tilt, orientation in ORIENTATIONS.items()])
    return rows


def by_step_size(experiment):
    rows = experiment.run("minimal", "--tilts", *ORIENTATIONS, "--depths", DEPTH,
                          "--configurations", EXACT, PAPERS, "--step-sizes", *STEP_SIZES)
    experiment.say(f"RMS distance at depth {DEPTH} by step size, after 40 steps\n")
    experiment.table(["axis", "lock", *(f"δ = {size:g}" for size in STEP_SIZES)], [
        [orientation, NAMES[configuration],
         *(row["rms"] for row in chosen(rows, tilt=tilt, configuration=configuration))]
        for tilt, orientation in ORIENTATIONS.items() for configuration in (EXACT, PAPERS)])
    return rows


def enneper(experiment, depths):
    rows = experiment.run("minimal", "--surface", "enneper", "--tilts", 0, TILT, 0.7, "--depths",
                          *depths, "--configurations", EXACT, PAPERS)
    experiment.say("Enneper's surface over the disc of radius 0.8: RMS distance\n")
    table = []
    for tilt in (0, TILT, 0.7):
        for configuration in (EXACT, PAPERS):
            line = chosen(rows, tilt=tilt, configuration=configuration)
            table.append([f"tilt {tilt:g}", NAMES[configuration], *(row["rms"] for row in line),
                          ", ".join(f"{order:.2f}" for order in orders(line))])
    experiment.table(["axis", "lock", *(f"depth {depth}" for depth in depths), "orders"], table)
    return rows


def check(experiment, rows, step_rows, enneper_rows):
    for tilt, orientation in ORIENTATIONS.items():
        line = chosen(rows, tilt=tilt, configuration=EXACT)
        experiment.check(f"least order, {orientation}", min(orders(line)),
                         at_least=SMALLEST_ORDER)
        [at_depth] = chosen(line, depth=DEPTH)
        if tilt == 0:
            experiment.check(f"over the chords, {orientation}, depth {DEPTH}",
                             at_depth["rms"] / at_depth["chords"], at_most=LARGEST_OVER_CHORDS)
            experiment.say(f"- for comparison: {at_depth['rms']:.2g} {orientation}, where"
                           f" asks for {TARGET:g} and the chords are off by "
                           f"{at_depth['chords']:.2g}")
        else:
            experiment.check(f"RMS distance, {orientation}, depth {DEPTH}", at_depth["rms"],
                             at_most=LARGEST_TILTED)
        [papers] = chosen(rows, tilt=tilt, configuration=PAPERS, depth=DEPTH)
        experiment.check(f"farther with locked cells, {orientation}, depth {DEPTH}",
                         papers["rms"] / at_depth["rms"], at_least=SMALLEST_GAIN)
        sizes = [row["rms"] for row in chosen(step_rows, tilt=tilt, configuration=EXACT)]
        experiment.check(f"spread of the distance over step sizes, {orientation}",
                         max(sizes) / min(sizes) - 1, at_most=LARGEST_SPREAD)
    for tilt in (0, TILT, 0.7):
        line = chosen(enneper_rows, tilt=tilt, configuration=EXACT)
        whole = math.log2(line[0]["rms"] / line[-1]["rms"]) / (len(line) - 1)
        experiment.check(f"Enneper, tilt {tilt:g}: order over all depths", whole,
                         at_least=SMALLEST_ENNEPER_ORDER)


def plot(experiment, depths, rows):
    figure, axes = experiment.figure(columns=2, size=(6, 5))
    profile, convergence = axes[0]
    profiles = experiment.run("minimal", "--depths", DEPTH, "--configurations", EXACT, PAPERS,
                              "--profile")
    exact = chosen(profiles, configuration=EXACT)
    profile.plot([row["exact"] for row in exact], [row["z"] for row in exact], "k", linewidth=3,
                 alpha=0.3, label="catenoid")
    for configuration, style in ((EXACT, "-"), (PAPERS, "--")):
        line = chosen(profiles, configuration=configuration)
        profile.plot([row["radius"] for row in line], [row["z"] for row in line], style,
                     label=NAMES[configuration])
    profile.set_title(f"profile, axis along the grid, depth {DEPTH}")
    profile.set_xlabel("radius")
    profile.set_ylabel("z")
    profile.legend(fontsize=7)
    for tilt, orientation in ORIENTATIONS.items():
        for configuration in (EXACT, PAPERS):
            line = chosen(rows, tilt=tilt, configuration=configuration)
            convergence.loglog([row["cell_size"] for row in line], [row["rms"] for row in line],
                               "o-", label=f"{NAMES[configuration]}, {orientation}")
    line = chosen(rows, tilt=0, configuration=EXACT)
    convergence.loglog([row["cell_size"] for row in line], [row["chords"] for row in line], "k:",
                       label="chords, along the grid")
    convergence.set_title("RMS distance")
    convergence.set_xlabel("cell size (the rings' radius is 1)")
    convergence.legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("catenoid", __doc__, add_options)
    depths = [4, 5] if experiment.options.quick else experiment.options.depths
    rows = by_depth(experiment, depths)
    step_rows = by_step_size(experiment)
    enneper_rows = enneper(experiment, depths)
    check(experiment, rows, step_rows, enneper_rows)
    plot(experiment, depths, rows)
    experiment.finish()


if __name__ == "__main__":
    main()
