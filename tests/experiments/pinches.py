#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures and draws long flows of scans with thin parts, which pinch.

The scans flow 100 and 200 steps of 1e-5, and 80 of 5e-4. Distances to the cotangent flow are in 1e-3 of
the diagonal and omit degenerated triangles. Targets: after 100 steps of 1e-5 the converged solver is no
farther than the paper's; no vertex leaves the initial bounding box by more than 1e-3 of the diagonal;
collapsed vertices then move by at most 1e-2 of it, in the root mean square.
"""

import pathlib
import subprocess
import sys

from experiment import CGAL_THIN_SCANS, CONVERGED, PAPER, SHARED_THIN_SCANS, Experiment, label

FREE_PINCHES = f"{CONVERGED},free-pinches"
UNIT = 1e-3
FLOWS = [(1e-5, [100, 200]), (5e-4, [80])]
CHECKED_FLOW = (1e-5, 100)
LARGEST_OUTSIDE = 1e-3
LARGEST_DRIFT = 1e-2
LENGTHS = {"sound_rms": "RMS distance", "sound_worst": "worst", "rms": "RMS, all", "moved": "moved",
           "farthest": "farthest", "drift_rms": "RMS drift", "drift_worst": "worst drift",
           "outside": "outside"}

# The directions of the camera and of up.
UP = (0, 1, 0)
USUAL_VIEW = ((0, 0, -1), UP)
VIEWS = {"armadillo_50k": ((0, 0, 1), UP), "armadillo": ((0, 0, 1), UP),
         "elephant_5cc": ((1, 0, 0), UP), "camel": ((1, 0, 0), UP)}


def add_options(parser):
    parser.add_argument("--depth", type=int, default=0, help="0: automatic")
    parser.add_argument("--configurations", nargs="+", default=[],
                        help="further configurations to compare, see configuration.h")
    parser.add_argument("--no-pictures", action="store_true")


def measure(experiment, scan, step_size, steps, configurations):
    """Returns the rows of all configurations, and the folder with the surfaces."""
    folder = experiment.output / f"pinches_{label(scan)}_{step_size:g}"
    rows = experiment.run("pinches", scan, "--depth", experiment.options.depth, "--step-size",
                          step_size, "--steps", *steps, "--configurations", *configurations,
                          "--folder", folder, mesh=label(scan), step_size=step_size)
    return rows, folder


def draw(experiment, scan, folder, steps, configurations):
    """Draws the initial surface, those of all configurations and the cotangent flow's side by side."""
    picture = experiment.output / f"{folder.name}_{steps}.png"
    surfaces = [folder / f"{i}_{steps}.ply" for i in range(len(configurations))]
    surfaces.append(folder / f"cotangent_{steps}.ply")
    labels = ["before", *configurations, "cotangent"]
    kept = [(text, path) for text, path in zip(labels, [scan, *surfaces]) if path.exists()]
    view, up = VIEWS.get(label(scan), USUAL_VIEW)
    subprocess.run([sys.executable, str(pathlib.Path(__file__).parent / "render.py"),
                    *(str(path) for _, path in kept), "--labels", *(text for text, _ in kept),
                    "--view", *map(str, view), "--up", *map(str, up), "--output", str(picture)],
                   check=True)
    experiment.say(f"![{label(scan)} after {steps} steps]({picture.name})")


def print_table(experiment, rows):
    experiment.table(
        ["mesh", "δ", "steps", "configuration", *LENGTHS.values(), "collapsed", "sound part"],
        [[row["mesh"], row["step_size"], row["steps"], row["configuration"],
          *(row[key] / UNIT if row["finite"] else "-" for key in LENGTHS), row["collapsed"],
          row["sound_part"]] for row in rows])


def check(experiment, rows):
    converged = [row for row in rows if row["configuration"] == CONVERGED]
    experiment.check("flows that broke down", sum(not row["finite"] for row in converged),
                     at_most=0)
    sound = [row for row in converged if row["finite"]]
    for row in sound:
        if (row["step_size"], row["steps"]) != CHECKED_FLOW:
            continue
        [paper] = [other for other in rows if other["configuration"] == PAPER and
                   all(other[key] == row[key] for key in ("mesh", "step_size", "steps"))]
        experiment.check(f"{row['mesh']}, {row['steps']} steps of {row['step_size']:g}: distance "
                         "relative to the paper's solver", row["sound_rms"] / paper["sound_rms"],
                         at_most=1.0)
    experiment.check("farthest outside of the box", max(row["outside"] for row in sound),
                     at_most=LARGEST_OUTSIDE)
    experiment.check("drift of what has collapsed", max(row["drift_rms"] for row in sound),
                     at_most=LARGEST_DRIFT)


def plot(experiment, rows, configurations):
    figure, axes = experiment.figure(columns=2, size=(6, 4.5))
    cases = list(dict.fromkeys((row["mesh"], row["step_size"], row["steps"]) for row in rows))
    width = 0.8 / len(configurations)
    for ax, figure_of in zip(axes[0], ["sound_rms", "drift_rms"]):
        for i, configuration in enumerate(configurations):
            chosen = {(row["mesh"], row["step_size"], row["steps"]): row[figure_of] or 0
                      for row in rows if row["configuration"] == configuration}
            ax.bar([place + i * width for place in range(len(cases))],
                   [chosen.get(case, 0) / UNIT for case in cases], width, label=configuration)
        ax.set_xticks(range(len(cases)), [f"{m}\n{n} × {step:g}" for m, step, n in cases],
                      rotation=60, fontsize=7)
        ax.set_title(f"{LENGTHS[figure_of]}, 1e-3 diagonals")
        ax.legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("pinches", __doc__, add_options)
    options = experiment.options
    configurations = [PAPER, CONVERGED, FREE_PINCHES, *options.configurations]
    scans = experiment.scans(SHARED_THIN_SCANS, CGAL_THIN_SCANS)
    rows, drawings = [], []
    for scan in scans:
        for step_size, steps in FLOWS[:1] if options.quick else FLOWS:
            more, folder = measure(experiment, scan, step_size, steps, configurations)
            rows += more
            drawings += [(scan, folder, number) for number in steps]
    print_table(experiment, [row for row in rows if row["configuration"] != "cotangent"])
    check(experiment, rows)
    plot(experiment, [row for row in rows if row["configuration"] != "cotangent"], configurations)
    for scan, folder, steps in drawings:
        if not options.no_pictures:
            draw(experiment, scan, folder, steps, configurations)
    experiment.finish()


if __name__ == "__main__":
    main()
