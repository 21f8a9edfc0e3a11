#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how much noise disturbs the mean curvature of a scan, beside MeshLab's own filters.

Each method computes the mean curvature of a clean scan and of the same scan with noise. The table shows
the correlation of the two, and the RMS of their difference relative to the RMS of the clean one; each
method is compared with itself. Ours is the quality "mean curvature" of one step, at several detail
sizes; its seconds include files. "Scale Dependent Quadric Fitting" has the same lengths as radius. The
picture shows the clean and the noisy scan by ours and by the best of MeshLab's without a scale.

Needs PyMeshLab: external/pymeshlab.sh build/pymeshlab, then build/pymeshlab/bin/python curvature.py.
"""

import pathlib
import subprocess
import tempfile

import numpy
from experiment import TOP, Experiment, processor_seconds
from scan import Scan, loaded, pymeshlab

NOISE = 0.1  # in mean edge lengths
SIZES = [3, 6, 12]  # detail sizes, in mean edge lengths
OURS = "this filter, ℓ = {} edges"
SCALED = "Scale Dependent Quadric Fitting, {} edges"


def ours(experiment, scan, detail_size):
    """Returns a function from vertices to a MeshSet whose quality is the curvature."""
    def compute(vertices):
        with tempfile.TemporaryDirectory() as folder:
            source, target = pathlib.Path(folder) / "in.ply", pathlib.Path(folder) / "out.ply"
            scan.mesh_set(vertices).save_current_mesh(str(source), save_vertex_quality=False)
            experiment.smooth(source, target, "--iterations", 1, "--quality", "mean-curvature",
                              "--detail-size", repr(detail_size))
            return loaded(target)
    return compute


def stock(scan, name, **parameters):
    def compute(vertices):
        meshes = scan.mesh_set(vertices)
        meshes.apply_filter(name, **parameters)
        return meshes
    return compute


def disturbance(clean, disturbed):
    """Returns the correlation of two arrays and the relative RMS of their difference."""
    correlation = numpy.corrcoef(clean, disturbed)[0, 1]
    return float(correlation), float(numpy.sqrt(((disturbed - clean) ** 2).mean()
                                                / (clean ** 2).mean()))


def draw(experiment, results):
    """Draws the clean and the noisy scan of each method. `results` is a list of (text, MeshSet)."""
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for i, (_, meshes, largest) in enumerate(results):
            meshes.compute_color_from_scalar_per_vertex(minval=-largest, maxval=largest,
                                                        colormap="Turbo")
            paths.append(f"{folder}/{i}.ply")
            meshes.save_current_mesh(paths[-1], save_vertex_color=True, save_vertex_quality=False)
        picture = experiment.output / "curvature.png"
        # In a process of its own: VTK and PyMeshLab have different versions of some libraries.
        subprocess.run(["/usr/bin/python3", TOP / "tests" / "experiments" / "render.py", "--colours",
                        "--view", "0", "0", "1", "--output", picture, *paths,
                        "--labels", *(text for text, *_ in results)], check=True)
        experiment.say(f"\n![picture]({picture.name})")


def main():
    experiment = Experiment("curvature", __doc__)
    rows, drawn = [], []
    for path in experiment.scans(["nefertiti_50k.ply"], ["nefertiti.off"]):
        scan = Scan(path)
        disturbed = scan.noisy(NOISE)
        directions = "compute_curvature_principal_directions_per_vertex"
        methods = {OURS.format(size): ours(experiment, scan, size * scan.edge) for size in SIZES}
        methods["discrete"] = stock(scan, "compute_scalar_by_discrete_curvature_per_vertex")
        for method in ("Taubin approximation", "Quadric Fitting", "Normal Cycles"):
            methods[method] = stock(scan, directions, method=method)
        for size in SIZES:
            methods[SCALED.format(size)] = stock(
                scan, directions, method="Scale Dependent Quadric Fitting",
                scale=pymeshlab.PureValue(size * scan.edge))
        for name, compute in methods.items():
            begin = processor_seconds()
            results = [compute(scan.vertices), compute(disturbed)]
            seconds = (processor_seconds() - begin) / 2
            clean, found = (meshes.current_mesh().vertex_scalar_array() for meshes in results)
            correlation, difference = disturbance(clean, found)
            rows.append({"scan": scan.name, "method": name, "correlation": correlation,
                         "difference": difference, "seconds": seconds, "results": results,
                         "largest": float(numpy.percentile(abs(clean), 95))})
    by_stock = max((row for row in rows if "edges" not in row["method"]),
                   key=lambda row: row["correlation"])
    by_us = next(row for row in rows if row["method"] == OURS.format(6))
    for row in (by_us, by_stock):
        for meshes, kind in zip(row["results"], ("clean", "noisy")):
            drawn.append((f"{kind}, {row['method'].replace('ℓ', 'l')}", meshes, row["largest"]))
    draw(experiment, drawn)
    rows = [{key: value for key, value in row.items() if key != "results"} for row in rows]
    experiment.record(rows)
    experiment.table(["scan", "method", "correlation", "relative difference", "processor seconds"],
                     [list(row.values())[:5] for row in rows])
    experiment.check("correlation of ours at 6 edges less that of the best of MeshLab's without a scale",
                     by_us["correlation"] - by_stock["correlation"], at_least=0)
    experiment.finish()


if __name__ == "__main__":
    main()
