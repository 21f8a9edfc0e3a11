#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how exactly the volume is preserved over a hundred steps.

The volume swept between the initial and the final surface is the difference of the volumes of two cones
over them with the same apex: their rims agree where they are locked. Cases: two ellipsoids of unequal
size, each of which must keep its volume and its centre; an open scan with a locked rim; a selection.
"""

import pathlib
import tempfile

import numpy
from experiment import Experiment, label, skip
from ply import read_vertices, write_ply

STEPS = 100
STEP_SIZE = 1e-5  # alone, all steps would halve waves a sixth as long as the longest side
AXES = (1.1, 1, 0.9)  # of the ellipsoids, in radii
KEPT = 1e-6
CENTRE_KEPT = 1e-3  # in radii
RADII = (1, 0.3)


def ellipsoid(radius, centre, rows=64):
    """Returns its vertices and triangles."""
    columns = 2 * rows
    polar, azimuth = numpy.meshgrid(numpy.pi * (numpy.arange(rows) + 0.5) / rows,
                                    2 * numpy.pi * numpy.arange(columns) / columns, indexing="ij")
    ring = numpy.stack([numpy.sin(polar) * numpy.cos(azimuth),
                        numpy.sin(polar) * numpy.sin(azimuth), numpy.cos(polar)], -1).reshape(-1, 3)
    directions = numpy.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
    index = numpy.arange(rows * columns).reshape(rows, columns)
    following = numpy.roll(index, -1, axis=1)
    triangles = [numpy.stack([index[:-1], index[1:], following[1:]], -1).reshape(-1, 3),
                 numpy.stack([index[:-1], following[1:], following[:-1]], -1).reshape(-1, 3),
                 numpy.stack([numpy.full(columns, rows * columns), index[0], following[0]], -1),
                 numpy.stack([numpy.full(columns, rows * columns + 1), following[-1], index[-1]],
                             -1)]
    return centre + radius * numpy.array(AXES) * directions, numpy.concatenate(triangles)


def cone_volume(vertices, triangles, apex):
    a, b, c = numpy.moveaxis(vertices[triangles] - apex, 1, 0)
    return float((a * numpy.cross(b, c)).sum() / 6)


def centre_of(vertices, triangles):
    """Returns the centroid of the surface."""
    a, b, c = numpy.moveaxis(vertices[triangles], 1, 0)
    areas = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    return ((a + b + c) / 3 * areas[:, None]).sum(axis=0) / areas.sum()


class Flow:
    """Runs the program on meshes in a temporary folder."""

    def __init__(self, experiment, folder):
        self._experiment, self._folder = experiment, pathlib.Path(folder)

    def __call__(self, path, *options):
        output = self._folder / "out.ply"
        self._experiment.smooth(path, output, "--preserve", "volume", "--iterations", STEPS,
                                "--step-size", STEP_SIZE, *options)
        return output

    def vertices(self, vertices, triangles, *options, selected=None):
        """Returns the vertices after the flow."""
        path = self._folder / "in.ply"
        write_ply(path, vertices, triangles, selected)
        return read_vertices(self(path, *options), len(vertices))


def two_ellipsoids(experiment, flow):
    parts = [ellipsoid(radius, numpy.array([3.0 * i, 0, 0])) for i, radius in enumerate(RADII)]
    count = len(parts[0][0])
    vertices = numpy.concatenate([part[0] for part in parts])
    triangles = numpy.concatenate([parts[0][1], parts[1][1] + count])
    after = flow.vertices(vertices, triangles)
    for i, (part, radius) in enumerate(zip(parts, RADII)):
        moved = after[i * count:(i + 1) * count]
        before_volume, volume = (cone_volume(v, part[1], v.mean(axis=0)) for v in (part[0], moved))
        experiment.check(f"ellipsoid of radius {radius}, relative change of volume",
                         abs(volume / before_volume - 1), at_most=KEPT)
        shift = numpy.linalg.norm(centre_of(moved, part[1]) - centre_of(*part)) / radius
        experiment.check("its centre moved, in radii", float(shift), at_most=CENTRE_KEPT)


def check_swept(experiment, what, before, after, triangles):
    box = numpy.ptp(before, axis=0)
    apex = before.mean(axis=0)
    swept = cone_volume(after, triangles, apex) - cone_volume(before, triangles, apex)
    moved = float(numpy.linalg.norm(after - before, axis=1).max() / numpy.linalg.norm(box))
    experiment.say(f"- {what}: vertices moved by up to {100 * moved:.2g} % of the diagonal")
    experiment.check("swept volume, relative to the bounding box", abs(swept) / float(box.prod()),
                     at_most=KEPT)


def selection(experiment, flow):
    vertices, triangles = ellipsoid(1, numpy.zeros(3))
    selected = vertices[triangles][:, :, 2].min(axis=1) > 0.2
    after = flow.vertices(vertices, triangles, "--selected", "selected", selected=selected)
    check_swept(experiment, "selected cap of an ellipsoid", vertices, after, triangles)


def read_off(path):
    """Returns the vertices and the triangles of an OFF file without comments."""
    words = path.read_text(encoding="ascii").split()
    count, faces = int(words[1]), int(words[2])
    vertices = numpy.array(words[4:4 + 3 * count], float).reshape(-1, 3)
    rows = numpy.array(words[4 + 3 * count:4 + 3 * count + 4 * faces], int).reshape(-1, 4)
    if (rows[:, 0] != 3).any():
        skip(f"volume: {path} has faces that are not triangles")
    return vertices, rows[:, 1:]


def main():
    experiment = Experiment("volume", __doc__)
    with tempfile.TemporaryDirectory() as folder:
        flow = Flow(experiment, folder)
        two_ellipsoids(experiment, flow)
        for path in experiment.scans(["mannequin-devil.off"], ["mannequin-devil.off"]):
            vertices, triangles = read_off(path)
            after = flow.vertices(vertices, triangles)
            check_swept(experiment, f"{label(path)}, open, rim locked", vertices, after, triangles)
        selection(experiment, flow)
    experiment.finish()


if __name__ == "__main__":
    main()
