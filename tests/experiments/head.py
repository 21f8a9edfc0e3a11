#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 9: an open head with a locked boundary under short and under long steps.

Short steps pinch at the neck and leave the head as a thread. Long steps approach the minimiser of the
Dirichlet energy, and so a minimal surface, without pinching (section 5.3). Areas are relative to the
start. Targets: ten long steps end with at most the area of a hundred short ones; the tenth changes the
area by at most 1e-3 of it; the short steps have pinched the head off: between steps 40 and 60 the area
hardly changes, and a part of the surface has collapsed. Look at the pictures.
"""

import pathlib
import subprocess
import sys

from experiment import CONVERGED, Experiment, label

SHARED_HEADS = ["mannequin_11k.ply"]
CGAL_HEADS = ["mannequin-devil.off"]
LOCKED = f"{CONVERGED},locked"
SHORT, LONG = 1e-3, 1.0
STEPS = {SHORT: [5, 10, 20, 30, 40, 60, 100], LONG: [1, 2, 3, 5, 9, 10]}
DRAWN = {SHORT: [10, 20, 30, 40, 100], LONG: [1, 2, 3, 10]}
NAMES = {SHORT: "short", LONG: "long"}
LARGEST_CHANGE = 1e-3
SMALLEST_COLLAPSED = 0.01
VIEW, UP = (-1, 0.4, -0.45), (0, 0, 1)


def add_options(parser):
    parser.add_argument("--depth", type=int, default=6)
    parser.add_argument("--no-pictures", action="store_true")


def folder_of(experiment, scan, step_size):
    return experiment.output / f"head_{label(scan)}_{NAMES[step_size]}"


def measure(experiment, scan):
    rows = []
    for step_size, steps in STEPS.items():
        rows += experiment.run("stages", scan, "--depth", experiment.options.depth, "--step-size",
                               step_size, "--steps", *steps, "--configurations", LOCKED,
                               "--folder", folder_of(experiment, scan, step_size),
                               mesh=label(scan))
    return {step_size: {row["steps"]: row for row in rows if row["step_size"] == step_size}
            for step_size in STEPS}


def check(experiment, stages):
    short, long = stages[SHORT], stages[LONG]
    experiment.check("area after ten long steps, relative to that after a hundred short ones",
                     long[10]["area"] / short[100]["area"], at_most=1.0)
    experiment.check("change of the area in the tenth long step",
                     abs(1 - long[10]["area"] / long[9]["area"]), at_most=LARGEST_CHANGE)
    experiment.check("collapsed share of the samples after a hundred short steps",
                     short[100]["collapsed"], at_least=SMALLEST_COLLAPSED)


def plot(experiment, stages):
    figure, axes = experiment.figure()
    ax = axes[0][0]
    for step_size, rows in stages.items():
        ax.semilogx(list(rows), [row["area"] for row in rows.values()], "o-",
                    label=f"steps of {step_size:g}")
    ax.set_xlabel("steps")
    ax.set_ylabel("area, relative to the start")
    ax.legend(fontsize=7)
    experiment.save(figure)


def draw(experiment, scan):
    for step_size, name in NAMES.items():
        picture = experiment.output / f"head_{label(scan)}_{name}.png"
        stages = [folder_of(experiment, scan, step_size) / f"0_{steps}.ply"
                  for steps in DRAWN[step_size]]
        subprocess.run([sys.executable, str(pathlib.Path(__file__).parent / "render.py"),
                        str(scan), *map(str, stages), "--labels", "before",
                        *(f"{steps} × {step_size:g}" for steps in DRAWN[step_size]), "--view",
                        *map(str, VIEW), "--up", *map(str, UP), "--height", "600", "--output",
                        str(picture)], check=True)
        experiment.say(f"![{label(scan)}, {name} steps]({picture.name})")


def main():
    experiment = Experiment("head", __doc__, add_options)
    [scan] = experiment.scans(SHARED_HEADS, CGAL_HEADS)
    stages = measure(experiment, scan)
    experiment.table(["steps of", "after", "area", "collapsed", "iterations"],
                     [[step_size, steps, row["area"], row["collapsed"], row["iterations"]]
                      for step_size, rows in stages.items() for steps, row in rows.items()])
    check(experiment, stages)
    plot(experiment, stages)
    if not experiment.options.no_pictures:
        draw(experiment, scan)
    experiment.finish()


if __name__ == "__main__":
    main()
