#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares conformalized flow, which turns closed surfaces of genus 0 into spheres, with plain flow.

Both flows keep the area. The script prints the standard deviation of the radius about the surface's
centroid relative to its mean, weighted by area, in per cent. Targets: after 100 steps of 1e-2 the
conformalized flow is below 1 %, and below 3 % at each vertex, without collapsed samples or NaN; within
20 steps of 1e-2 the plain flow collapses in part and stays above 10 %. The smallest scan also flows with
other step sizes. Look at the pictures of both.
"""

import pathlib
import subprocess
import sys

from experiment import CONVERGED, Experiment, label

SHARED_SPHERES = ["hand_8k.ply", "armadillo_50k.ply", "nefertiti_50k.ply"]
CGAL_SPHERES = ["hand.off", "armadillo.off", "nefertiti.off"]
CONFORMALIZED = f"{CONVERGED},conformalized,preserve-area"
PLAIN = f"{CONVERGED},preserve-area"
NAMES = {CONFORMALIZED: "conformalized", PLAIN: "plain"}
STEPS = {CONFORMALIZED: [5, 10, 20, 50, 100], PLAIN: [2, 5, 10, 20]}
DRAWN = {CONFORMALIZED: [5, 10, 20, 100], PLAIN: [2, 5, 10, 20]}
ALL_STEPS = sorted({steps for some in STEPS.values() for steps in some})
CHECKED_STEP_SIZE = 1e-2
LARGEST_DEVIATION = 0.01
LARGEST_VERTEX = 0.03
SMALLEST_PLAIN = 0.1
SMALLEST_PINCHED = 1e-3

UP = (0, 1, 0)
VIEWS = {"armadillo_50k": ((0, 0, 1), UP), "armadillo": ((0, 0, 1), UP)}
USUAL_VIEW = ((0, 0, -1), UP)


def add_options(parser):
    parser.add_argument("--depth", type=int, default=0, help="0: automatic")
    parser.add_argument("--step-sizes", nargs="+", type=float, default=[1e-3, 1e-1, 1],
                        help="further step sizes for the smallest scan")
    parser.add_argument("--no-pictures", action="store_true")


def folder_of(experiment, scan, configuration, step_size):
    return experiment.output / f"{NAMES[configuration]}_{label(scan)}_{step_size:g}"


def measure(experiment, scan, configuration, step_size):
    return experiment.run("stages", scan, "--depth", experiment.options.depth, "--step-size",
                          step_size, "--steps", *STEPS[configuration], "--configurations",
                          configuration, "--folder",
                          folder_of(experiment, scan, configuration, step_size), mesh=label(scan))


def print_table(experiment, rows, meshes):
    table = []
    for mesh in meshes:
        for configuration, name in NAMES.items():
            of_flow = [row for row in rows
                       if (row["mesh"], row["configuration"]) == (mesh, configuration)]
            for step_size in dict.fromkeys(row["step_size"] for row in of_flow):
                line = {row["steps"]: row for row in of_flow if row["step_size"] == step_size}
                last = line[max(line)]
                table.append([mesh, last["depth"], name, step_size,
                              *(100 * line[steps]["by_area"] if steps in line else ""
                                for steps in ALL_STEPS),
                              100 * last["worst"], 100 * last["collapsed"], last["steps_made"]])
    experiment.say("Deviation of the radius in per cent of its mean\n")
    experiment.table(["mesh", "depth", "flow", "δ", *(f"{steps} steps" for steps in ALL_STEPS),
                      "worst vertex", "collapsed", "steps made"], table)


def check(experiment, rows, meshes):
    for mesh in meshes:
        last = {row["configuration"]: row for row in rows
                if (row["mesh"], row["step_size"]) == (mesh, CHECKED_STEP_SIZE)}
        conformalized = last[CONFORMALIZED]
        experiment.check(f"{mesh}: deviation", conformalized["by_area"],
                         at_most=LARGEST_DEVIATION)
        experiment.check(f"{mesh}: worst vertex", conformalized["worst"], at_most=LARGEST_VERTEX)
        experiment.check(f"{mesh}: collapsed share of the samples", conformalized["collapsed"],
                         at_most=0.0)
        experiment.check(f"{mesh}: deviation, plain flow", last[PLAIN]["by_area"],
                         at_least=SMALLEST_PLAIN)
        experiment.check(f"{mesh}: collapsed share of the samples, plain flow",
                         last[PLAIN]["collapsed"], at_least=SMALLEST_PINCHED)
    experiment.check("runs that are not finite, or lack steps under the conformalized flow",
                     sum(not row["finite"] or (row["configuration"] == CONFORMALIZED and
                                               row["steps_made"] < row["steps"]) for row in rows),
                     at_most=0)


def plot(experiment, rows, meshes):
    figure, axes = experiment.figure(columns=len(meshes), size=(4, 3.5))
    for ax, mesh in zip(axes[0], meshes):
        lines = {}
        for row in rows:
            if row["mesh"] == mesh:
                name = f"{NAMES[row['configuration']]}, {row['step_size']:g}"
                lines.setdefault(name, []).append((row["steps"], row["by_area"]))
        for name, line in lines.items():
            ax.loglog(*zip(*line), "o-", label=name)
        ax.axhline(LARGEST_DEVIATION, color="k", linestyle=":", linewidth=0.8)
        ax.set_title(mesh, fontsize=9)
        ax.set_xlabel("steps")
        ax.set_ylabel("deviation of the radius")
        ax.legend(fontsize=6)
    experiment.save(figure)


def draw(experiment, scan):
    """Draws a row for each flow: the scan and some stages."""
    view, up = VIEWS.get(label(scan), USUAL_VIEW)
    for configuration, name in NAMES.items():
        picture = experiment.output / f"{experiment.name}_{label(scan)}_{name}.png"
        folder = folder_of(experiment, scan, configuration, CHECKED_STEP_SIZE)
        stages = [folder / f"0_{steps}.ply" for steps in DRAWN[configuration]]
        subprocess.run([sys.executable, str(pathlib.Path(__file__).parent / "render.py"),
                        str(scan), *map(str, stages), "--labels", "before",
                        *(f"{name}, {steps}" for steps in DRAWN[configuration]), "--view",
                        *map(str, view), "--up", *map(str, up), "--zoom", "0.7", "--height", "600",
                        "--output", str(picture)], check=True)
        experiment.say(f"![{label(scan)}, {name} flow]({picture.name})")


def main():
    experiment = Experiment("conformalized", __doc__, add_options)
    options = experiment.options
    scans = experiment.scans(SHARED_SPHERES, CGAL_SPHERES)
    meshes = [label(scan) for scan in scans]
    rows = []
    for scan in scans:
        for configuration in NAMES:
            rows += measure(experiment, scan, configuration, CHECKED_STEP_SIZE)
    smallest = min(scans, key=lambda path: path.stat().st_size)
    for step_size in [] if options.quick else options.step_sizes:
        rows += measure(experiment, smallest, CONFORMALIZED, step_size)
    print_table(experiment, rows, meshes)
    check(experiment, rows, meshes)
    plot(experiment, rows, meshes)
    if not options.no_pictures:
        for scan in scans:
            draw(experiment, scan)
    experiment.finish()


if __name__ == "__main__":
    main()
