#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The time to remove waves that are many edges long, beside MeshLab's Taubin smoother.

Taubin's smoother multiplies a wave by 1 - (λκ)² in one iteration if μ = -λ. Here κ is the wave's
eigenvalue of the umbrella operator, (2π/length)² times a quarter of the mean squared edge length. (With
its default μ, it lengthens waves whose κ is below 1/λ + 1/μ, so it never removes them.) The number of
iterations that halve the wave follows. Its processor seconds are those of ten iterations, multiplied; ours
are measured, and include reading and writing files.

Needs PyMeshLab: external/pymeshlab.sh build/pymeshlab, then build/pymeshlab/bin/python long_waves.py.
"""

import math
import pathlib
import tempfile

import numpy
from experiment import Experiment, processor_seconds
from scan import Scan, mesh_set

PERCENTAGES = [0.3, 1, 3, 10]  # detail sizes, of the diagonal of the bounding box
LAMBDA = 0.5
MEASURED_ITERATIONS = 10


def seconds_of_taubin(scan):
    """Returns the processor seconds of one iteration."""
    meshes = mesh_set(scan, scan.vertices)
    begin = processor_seconds()
    meshes.apply_coord_taubin_smoothing(lambda_=LAMBDA, mu=-LAMBDA,
                                        stepsmoothnum=MEASURED_ITERATIONS)
    return (processor_seconds() - begin) / MEASURED_ITERATIONS


def measure(experiment, path, folder):
    """Returns a row for each percentage."""
    scan = Scan(path)
    diagonal = float(numpy.linalg.norm(numpy.ptp(scan.vertices, axis=0)))
    seconds = seconds_of_taubin(scan)
    rows = []
    for percentage in PERCENTAGES:
        length = percentage / 100 * diagonal
        eigenvalue = (2 * math.pi / length) ** 2 * scan.mean_squared_edge / 4
        iterations = math.ceil(math.log(0.5) / math.log(1 - (LAMBDA * eigenvalue) ** 2))
        report, ours = experiment.smooth(path, folder / "out.ply", "--order", 2, "--detail-size",
                                         f"{percentage}%")
        rows.append({"scan": scan.name, "vertices": len(scan.vertices), "percentage": percentage,
                     "edges": length / math.sqrt(scan.mean_squared_edge), "depth": report["depth"],
                     "seconds": ours, "iterations of Taubin": iterations,
                     "seconds of Taubin": iterations * seconds})
    return rows


def main():
    experiment = Experiment("long_waves", __doc__)
    with tempfile.TemporaryDirectory() as folder:
        rows = [row for path in experiment.scans(["bunny_scan_871k.ply.xz"], ["armadillo.off"])
                for row in measure(experiment, path, pathlib.Path(folder))]
    experiment.record(rows)
    experiment.table(["scan", "vertices", "detail size, %", "in edges", "depth", "our seconds",
                      "iterations of Taubin", "its seconds"], [list(row.values()) for row in rows])
    figure, axes = experiment.figure()
    axes[0][0].loglog([row["percentage"] for row in rows], [row["seconds"] for row in rows], "o-",
                      label="this filter, order 2")
    axes[0][0].loglog([row["percentage"] for row in rows],
                      [row["seconds of Taubin"] for row in rows], "o-", label="Taubin")
    axes[0][0].set(xlabel="wavelength to halve, % of the diagonal", ylabel="processor seconds")
    axes[0][0].legend()
    experiment.save(figure)
    longest = [row for row in rows if row["percentage"] == PERCENTAGES[-1]]
    experiment.check("Taubin's seconds over ours, for the longest waves",
                     min(row["seconds of Taubin"] / row["seconds"] for row in longest), at_least=1)
    experiment.finish()


if __name__ == "__main__":
    main()
