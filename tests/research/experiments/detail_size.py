#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which detail size of the flow helps noisy scans most.

Each entry is the geometric mean over the scans of two ratios to the noisy mesh: of the RMS distance from the clean
vertices along the clean normals, and of the mean angle between normals of faces and those of the clean mesh. Noise is
normally distributed along the normals; its standard deviation is in mean edge lengths. Detail sizes are in mean edge
lengths of the noisy mesh. MeshLab's Taubin smoother has the best of many settings for each scan, for the distance and for
the angle each, which only somebody can choose who has the clean mesh.

Needs PyMeshLab and SciPy: README.md says how to install them.
"""

import itertools
from statistics import geometric_mean

import numpy
from experiment import CGAL_MESHES, Experiment
from measures import angles, distance
from removing_noise import SCANS
from scan import Scan
from smoothers import best, taubin_families
from surface import Surface

NOISES = [0.1, 0.2, 0.3]
SIZES = [2.5, 3, 4, 5, 6, 8]
ORDERS = [1, 2]
TAUBIN = "Taubin, best"


def figures(scan, vertices):
    return distance(scan, vertices), float(angles(scan, vertices).mean())


def results(experiment, scan, noise):
    """Returns, by setting, the ratios of distance and angle to those of the noisy scan."""
    noisy = scan.noisy(noise)
    edge = Surface("noisy", noisy, scan.faces).edge
    found = {}
    for order, size in itertools.product(ORDERS, SIZES):
        moved, *_ = experiment.smoothed(noisy, scan.faces, "--order", order, "--detail-size", size * edge)
        found[order, size] = figures(scan, moved)
    taubin, angle = best(scan, noisy, taubin_families(scan, noisy))
    found[TAUBIN] = taubin["RMS"], angle
    before = figures(scan, noisy)
    return {setting: tuple(numpy.divide(one, before)) for setting, one in found.items()}


def main():
    experiment = Experiment("detail_size", __doc__)
    options = experiment.options
    folders = [CGAL_MESHES, *([options.meshes] if options.meshes else [])]
    paths = [folder / name for name in SCANS for folder in folders if (folder / name).exists()]
    scans = [Scan(path) for path in (paths[:1] if options.quick else paths)]
    ratios = {}
    for scan, noise in itertools.product(scans, NOISES):
        print(f"... {scan.name}, {noise}", flush=True)
        for setting, pair in results(experiment, scan, noise).items():
            ratios.setdefault((noise, setting), []).append(pair)
            experiment.record([{"scan": scan.name, "noise": noise, "setting": setting, "distance": pair[0],
                                "angle": pair[1]}])

    def cell(noise, setting):
        distances, of_normals = zip(*ratios[noise, setting])
        return f"{geometric_mean(distances):.3f}, {geometric_mean(of_normals):.3f}"

    for noise in NOISES:
        experiment.say(f"\n## Noise of {noise} edges\n")
        experiment.table(["order", *(f"{size:g} edges" for size in SIZES)],
                         [[order, *(cell(noise, (order, size)) for size in SIZES)] for order in ORDERS])
        experiment.say(f"{TAUBIN}: {cell(noise, TAUBIN)}\n")
    experiment.finish()


if __name__ == "__main__":
    main()
