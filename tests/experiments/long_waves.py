#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the time to remove waves that are many edges long, beside MeshLab's Taubin smoother.

Taubin's smoother multiplies a wave by 1 - (λκ)² in one iteration if μ = -λ. Here κ is the wave's
eigenvalue of the umbrella operator, (2π/length)² times a quarter of the mean squared edge length. (With
its default μ, it lengthens waves whose κ is below 1/λ + 1/μ, so it never removes them.) The number of
iterations that halve the wave follows. Its seconds are those of ten iterations, multiplied; ours are
measured. Both without reading and writing files.

Needs PyMeshLab: external/pymeshlab.sh build/pymeshlab, then build/pymeshlab/bin/python long_waves.py.
"""

import json
import lzma
import math
import pathlib
import subprocess
import tempfile
import time

import numpy
from experiment import Experiment, skip

try:
    import pymeshlab
except ImportError:
    skip("long_waves: this Python has no PyMeshLab; external/pymeshlab.sh installs it")

PERCENTAGES = [0.3, 1, 3, 10]  # detail sizes, of the diagonal of the bounding box
LAMBDA = 0.5
MEASURED_ITERATIONS = 10


def unpacked(path, folder):
    """Returns the path of a scan that may be compressed."""
    if path.suffix != ".xz":
        return path
    target = pathlib.Path(folder) / path.stem
    target.write_bytes(lzma.decompress(path.read_bytes()))
    return target


def smooth(tool, path, percentage, folder):
    """Returns the report of the tool, and its seconds without files."""
    report = pathlib.Path(folder) / "report.json"
    subprocess.run([tool, path, pathlib.Path(folder) / "out.ply", "--quiet", "--order", "2",
                    "--detail-size", f"{percentage}%", "--report", report], check=True)
    found = json.loads(report.read_text())
    seconds = found["setup_seconds"] + sum(step["assemble_seconds"] + step["solve_seconds"]
                                           for step in found["steps"])
    return found, seconds


def seconds_of_taubin(meshes):
    """Returns the seconds of one iteration."""
    begin = time.perf_counter()
    meshes.apply_coord_taubin_smoothing(lambda_=LAMBDA, mu=-LAMBDA,
                                        stepsmoothnum=MEASURED_ITERATIONS)
    return (time.perf_counter() - begin) / MEASURED_ITERATIONS


def main():
    experiment = Experiment("long_waves", __doc__)
    tool = experiment.options.build / "filter_tracked_mcf" / "tool" / "tracked_mcf"
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for scan in experiment.scans(["bunny_scan_871k.ply.xz"], ["armadillo.off"]):
            path = unpacked(scan, folder)
            meshes = pymeshlab.MeshSet()
            meshes.load_new_mesh(str(path))
            corners = meshes.current_mesh().vertex_matrix()[meshes.current_mesh().face_matrix()]
            edges = corners - numpy.roll(corners, 1, axis=1)
            mean_square = float((edges ** 2).sum(axis=2).mean())
            diagonal = float(numpy.linalg.norm(numpy.ptp(corners.reshape(-1, 3), axis=0)))
            seconds = seconds_of_taubin(meshes)
            for percentage in PERCENTAGES:
                length = percentage / 100 * diagonal
                eigenvalue = (2 * math.pi / length) ** 2 * mean_square / 4
                iterations = math.log(0.5) / math.log(1 - (LAMBDA * eigenvalue) ** 2)
                report, ours = smooth(tool, path, percentage, folder)
                rows.append({"scan": path.stem, "percentage": percentage,
                             "edges": length / math.sqrt(mean_square), "depth": report["depth"],
                             "seconds": ours, "iterations of Taubin": math.ceil(iterations),
                             "seconds of Taubin": math.ceil(iterations) * seconds})
    experiment.record(rows)
    experiment.table(["scan", "detail size, %", "in edges", "depth", "our seconds",
                      "iterations of Taubin", "its seconds"], [list(row.values()) for row in rows])
    figure, axes = experiment.figure()
    axes[0][0].loglog([row["percentage"] for row in rows], [row["seconds"] for row in rows], "o-",
                      label="this filter, order 2")
    axes[0][0].loglog([row["percentage"] for row in rows],
                      [row["seconds of Taubin"] for row in rows], "o-", label="Taubin")
    axes[0][0].set(xlabel="wavelength to halve, % of the diagonal", ylabel="seconds")
    axes[0][0].legend()
    experiment.save(figure)
    longest = [row for row in rows if row["percentage"] == PERCENTAGES[-1]]
    experiment.check("Taubin's seconds over ours, for the longest waves",
                     min(row["seconds of Taubin"] / row["seconds"] for row in longest), at_least=100)
    seconds = [row["seconds"] for row in rows]
    experiment.check("longest over shortest of our times", max(seconds) / min(seconds), at_most=2)
    experiment.finish()


if __name__ == "__main__":
    main()
