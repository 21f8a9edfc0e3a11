#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how well noise is removed from scans, beside MeshLab's smoothers at their best settings.

Normally distributed noise moves the vertices of a clean scan along its normals. The table shows the RMS
distance of the smoothed vertices to the clean surface, in mean edge lengths of the scan: for the default
parameters, the same with order 2, the best settings of this filter (order 2 or 3, ten steps, one more
than the automatic depth, with and without a local detail size), and the best settings of each of
MeshLab's smoothers. "uneven" scans had one half subdivided before. Our seconds include reading and
writing files, MeshLab's do not.

Needs PyMeshLab: external/pymeshlab.sh build/pymeshlab, then build/pymeshlab/bin/python denoising.py.
"""

import itertools
import pathlib
import tempfile

import numpy
from experiment import Experiment, geometric_mean, processor_seconds
from scan import Scan, loaded, pymeshlab

SCANS = ["hand_8k.ply", "nefertiti_50k.ply", "skull_50k.ply", "armadillo_50k.ply"]
CGAL = ["hand.off", "nefertiti.off", "elephant.off", "armadillo.off"]
NOISES = [0, 0.05, 0.1, 0.2, 0.3]  # standard deviations, in mean edge lengths
# Largest RMS distances of the default parameters where noise is small, and the largest ratio of our
# best settings to the best of MeshLab's smoothers: as good as them within a fifth.
DEFAULT_ON_SMALL_NOISE = {0: 0.06, 0.05: 0.065}
RATIO = 1.2
RATIO_ON_UNEVEN = 1

DETAIL_SIZES = [2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7]  # in mean edge lengths
STEPS = [1, 2, 3, 4, 6, 8, 10, 14, 20, 30, 50]


def error(scan, vertices):
    """Returns the RMS distance from `vertices` to the clean surface, in mean edge lengths."""
    meshes = scan.mesh_set(vertices)
    meshes.add_mesh(pymeshlab.Mesh(scan.vertices, scan.faces))
    found = meshes.get_hausdorff_distance(sampledmesh=0, targetmesh=1, samplenum=len(vertices))
    return found["RMS"] / scan.edge


def rough_error(scan, vertices):
    """Returns nearly the same, much faster: the RMS displacement along the clean normals."""
    along = ((vertices - scan.vertices) * scan.normals).sum(axis=1)
    return float(numpy.sqrt((along ** 2).mean())) / scan.edge


class Tool:
    """The program tracked_mcf, applied to the noisy vertices of a scan."""

    def __init__(self, experiment, scan, vertices, folder):
        self._experiment, self._folder = experiment, pathlib.Path(folder)
        self._edge = scan.edge
        scan.mesh_set(vertices).save_current_mesh(str(self._folder / "in.ply"),
                                                  save_vertex_quality=False)

    def smooth(self, detail_size=None, order=1, steps=3, depth=0, local=False):
        """Returns the vertices after the filter, and its processor seconds. `detail_size` is in mean edge
        lengths; None is the default."""
        words = ["--order", order, "--iterations", steps, "--depth", depth]
        if local:
            words.append("--local-detail-size")
        if detail_size is not None:
            words += ["--detail-size", repr(detail_size * self._edge)]
        target = self._folder / "out.ply"
        report, seconds = self._experiment.smooth(self._folder / "in.ply", target, *words)
        self.depth = report["depth"]
        result = loaded(target)
        return result.current_mesh().vertex_matrix(), seconds


def applied(scan, vertices, name, repeat=1, **parameters):
    """Returns the vertices after MeshLab's filter `name`, and its processor seconds. A parameter `delta` is
    in mean edge lengths."""
    meshes = scan.mesh_set(vertices)
    if "delta" in parameters:
        parameters["delta"] = pymeshlab.PureValue(parameters["delta"] * scan.edge)
    begin = processor_seconds()
    for _ in range(repeat):
        meshes.apply_filter(name, **parameters)
    return meshes.current_mesh().vertex_matrix(), processor_seconds() - begin


def best(scan, families):
    """Returns the best result over families of settings: its error, its settings, its seconds.

    A family yields (settings, function) by increasing strength. The search leaves a family once it got
    worse twice.
    """
    found = None
    for family in families:
        least, worse = None, 0
        for settings, smooth in family:
            vertices, seconds = smooth()
            rough = rough_error(scan, vertices)
            if least is None or rough < least:
                least, worse = rough, 0
            else:
                worse += 1
            if found is None or rough < found[0]:
                found = (rough, settings, seconds, vertices)
            if worse == 2:
                break
    _, settings, seconds, vertices = found
    return error(scan, vertices), settings, seconds


def our_families(tool, depth):
    for order, local in itertools.product((2, 3), (False, True)):
        yield [(f"{'local ' if local else ''}ℓ {size:g}, order {order}, depth {depth}",
                lambda size=size, order=order, local=local: tool.smooth(size, order, 10, depth, local))
               for size in DETAIL_SIZES]


def stock_families(scan, vertices):
    """Returns MeshLab's smoothers by name, each with its families of settings."""
    def family(name, settings, **fixed):
        return [(", ".join(f"{key} {value}" for key, value in {**setting, **fixed}.items()),
                 lambda setting=setting: applied(scan, vertices, name, **setting, **fixed))
                for setting in settings]

    steps = [{"stepsmoothnum": n} for n in STEPS]
    return {
        "Taubin": [family("apply_coord_taubin_smoothing", steps),
                   family("apply_coord_taubin_smoothing", steps, lambda_=0.33, mu=-0.34)],
        "Laplacian": [family("apply_coord_laplacian_smoothing", steps, cotangentweight=weight)
                      for weight in (False, True)],
        "HC": [family("apply_coord_hc_laplacian_smoothing", [{"repeat": n} for n in (1, 2, 3, 4, 6)])],
        "two-step": [family("apply_coord_two_steps_smoothing", steps[:5], normalthr=float(angle))
                     for angle in (60, 30)],
        "scale-dependent": [family("apply_coord_laplacian_smoothing_scale_dependent", steps,
                                   delta=delta) for delta in (0.01, 0.1)]}


def measure(experiment, scan, noise):
    """Returns the row of one scan with one noise."""
    vertices = scan.noisy(noise)
    row = {"scan": scan.name, "noise": noise, "before": error(scan, vertices) if noise else 0.0}
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(experiment, scan, vertices, folder)
        row["default"] = error(scan, tool.smooth()[0])
        row["order 2"] = error(scan, tool.smooth(order=2)[0])
        if noise == 0:
            return row
        row["best"], row["best settings"], row["best seconds"] = best(
            scan, our_families(tool, tool.depth + 1))
    for name, families in stock_families(scan, vertices).items():
        row[name], row[f"{name} settings"], row[f"{name} seconds"] = best(scan, families)
    return row


def main():
    experiment = Experiment("denoising", __doc__, lambda parser: parser.add_argument(
        "--noises", nargs="+", type=float, default=NOISES, help="in mean edge lengths"))
    quick = experiment.options.quick
    stock = ["Taubin", "Laplacian", "HC", "two-step", "scale-dependent"]
    rows = []
    for path in experiment.scans(SCANS, CGAL):
        for scan in (Scan(path, uneven) for uneven in (False, True)):
            for noise in [0, 0.2] if quick else experiment.options.noises:
                rows.append(measure(experiment, scan, noise))
    experiment.record(rows)
    experiment.table(
        ["scan", "noise", "default", "order 2", "best", "its settings", *stock],
        [[row["scan"], row["noise"], row["default"], row["order 2"], row.get("best", ""),
          row.get("best settings", ""), *(row.get(name, "") for name in stock)] for row in rows])
    noisy = [row for row in rows if row["noise"] > 0]
    experiment.table(
        ["scan", "noise", "processor seconds of our best", *(f"of {name}" for name in stock)],
        [[row["scan"], row["noise"], row["best seconds"], *(row[f"{name} seconds"] for name in stock)]
         for row in noisy])
    check(experiment, rows, noisy, stock)
    experiment.finish()


def check(experiment, rows, noisy, stock):
    even = [row for row in rows if "uneven" not in row["scan"]]
    for noise, most in DEFAULT_ON_SMALL_NOISE.items():
        errors = [row["default"] for row in even if row["noise"] == noise]
        if errors:
            experiment.check(f"default on scans with noise {noise:g}", max(errors), at_most=most)
    experiment.check("default, RMS after over RMS before, from noise 0.1 on",
                     max(row["default"] / row["before"] for row in even if row["noise"] >= 0.1),
                     at_most=1)
    experiment.check("order 2 over order 1, in each row",
                     max(row["order 2"] / row["default"] for row in even), at_most=1)
    for kind, most in (("even", RATIO), ("uneven", RATIO_ON_UNEVEN)):
        ratios = [row["best"] / min(row[name] for name in stock) for row in noisy
                  if ("uneven" in row["scan"]) == (kind == "uneven")]
        experiment.say(f"- geometric mean of these ratios: {geometric_mean(ratios):.3g}")
        experiment.check(f"our best over the best of MeshLab's, {kind} scans, in each row",
                         max(ratios), at_most=most)


if __name__ == "__main__":
    main()
