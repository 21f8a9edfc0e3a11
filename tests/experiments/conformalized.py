#!/usr/bin/python3
"""Conformalized flow: closed surfaces without handles become spheres, where the plain flow pinches.

Both flows with the area kept after every step, by step size: standard deviation of the radius about the
surface's centroid over its mean, vertices weighted by their area, in per cent. Targets: under the
conformalized flow, 100 steps of 1e-2 come under 1 %, at every vertex under 3 %, with nothing collapsed and no NaN;
the plain flow of the same scans does not come under 10 %. Pictures of both: look at them.
"""

import pathlib
import subprocess
import sys

from experiment import CONVERGED, Experiment, label

SHARED_SPHERES = ["hand_8k.ply", "armadillo_50k.ply", "nefertiti_50k.ply"]
CGAL_SPHERES = ["hand.off", "armadillo.off", "nefertiti.off"]
CONFORMALIZED = f"{CONVERGED},conformalized,keep-area"
PLAIN = f"{CONVERGED},keep-area"
NAMES = {CONFORMALIZED: "conformalized", PLAIN: "plain"}
STEPS = [5, 10, 20, 50, 100]
DRAWN = [5, 10, 20, 100]
CHECKED_STEP_SIZE = 1e-2
LARGEST_DEVIATION = 0.01
LARGEST_VERTEX = 0.03
SMALLEST_PLAIN = 0.1

UP = (0, 1, 0)
VIEWS = {"armadillo_50k": ((0, 0, 1), UP), "armadillo": ((0, 0, 1), UP)}
USUAL_VIEW = ((0, 0, -1), UP)


def add_options(parser):
    parser.add_argument("--depth", type=int, default=0, help="0: automatic")
    parser.add_argument("--step-sizes", nargs="+", type=float, default=[1e-3, 1e-2, 1e-1, 1],
                        help="of the conformalized flow; the plain one takes 1e-2")
    parser.add_argument("--no-pictures", action="store_true")


def measure(experiment, scan, step_size, configurations):
    folder = experiment.output / f"conformalized_{label(scan)}_{step_size:g}"
    return experiment.run("stages", scan, "--depth", experiment.options.depth, "--step-size",
                          step_size, "--steps", *STEPS, "--configurations", *configurations,
                          "--folder", folder, mesh=label(scan))


def print_table(experiment, rows, meshes):
    table = []
    for mesh in meshes:
        for configuration, name in NAMES.items():
            of_flow = [row for row in rows
                       if (row["mesh"], row["configuration"]) == (mesh, configuration)]
            for step_size in dict.fromkeys(row["step_size"] for row in of_flow):
                line = [row for row in of_flow if row["step_size"] == step_size]
                table.append([mesh, line[0]["depth"], name, step_size,
                              *(100 * row["by_area"] for row in line),
                              100 * line[-1]["worst"], 100 * line[-1]["collapsed"],
                              line[-1]["steps_made"]])
    experiment.say("Deviation of the radius in per cent of its mean\n")
    experiment.table(["mesh", "depth", "flow", "δ", *(f"{steps} steps" for steps in STEPS),
                      "worst vertex", "collapsed", "steps made"], table)


def check(experiment, rows, meshes):
    for mesh in meshes:
        last = {row["configuration"]: row for row in rows
                if (row["mesh"], row["step_size"], row["steps"]) ==
                (mesh, CHECKED_STEP_SIZE, STEPS[-1])}
        conformalized = last[CONFORMALIZED]
        experiment.check(f"{mesh}: deviation", conformalized["by_area"],
                         at_most=LARGEST_DEVIATION)
        experiment.check(f"{mesh}: worst vertex", conformalized["worst"], at_most=LARGEST_VERTEX)
        experiment.check(f"{mesh}: collapsed share of the samples", conformalized["collapsed"],
                         at_most=0.0)
        experiment.check(f"{mesh}: deviation, plain flow", last[PLAIN]["by_area"],
                         at_least=SMALLEST_PLAIN)
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
    """A row for each flow: the scan, and some stages."""
    folder = experiment.output / f"conformalized_{label(scan)}_{CHECKED_STEP_SIZE:g}"
    view, up = VIEWS.get(label(scan), USUAL_VIEW)
    for index, name in enumerate(NAMES.values()):
        picture = experiment.output / f"conformalized_{label(scan)}_{name}.png"
        stages = [folder / f"{index}_{steps}.ply" for steps in DRAWN]
        subprocess.run([sys.executable, str(pathlib.Path(__file__).parent / "render.py"),
                        str(scan), *map(str, stages), "--labels", "before",
                        *(f"{name}, {steps}" for steps in DRAWN), "--view", *map(str, view),
                        "--up", *map(str, up), "--height", "600", "--output", str(picture)],
                       check=True)
        experiment.say(f"![{label(scan)}, {name} flow]({picture.name})")


def main():
    experiment = Experiment("conformalized", __doc__, add_options)
    options = experiment.options
    scans = experiment.scans(SHARED_SPHERES, CGAL_SPHERES)
    meshes = [label(scan) for scan in scans]
    others = [] if options.quick else [size for size in options.step_sizes
                                       if size != CHECKED_STEP_SIZE]
    rows = []
    for scan in scans:
        rows += measure(experiment, scan, CHECKED_STEP_SIZE, list(NAMES))
        for step_size in others:
            rows += measure(experiment, scan, step_size, [CONFORMALIZED])
    print_table(experiment, rows, meshes)
    check(experiment, rows, meshes)
    plot(experiment, rows, meshes)
    if not options.no_pictures:
        for scan in scans:
            draw(experiment, scan)
    experiment.finish()


if __name__ == "__main__":
    main()
