#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the flow at every wavelength that a mesh has, on its own elements and on a grid.

The tables:

- the share of the height that plane waves keep, on a plane whose axes are turned against the grid's. The ideal is that of a
  flow without elements: 1 - h^m in each of three steps of order m, with h = δk² / (1 + δk²);
- terrain whose heights are rounded to whole metres: RMS distance from the terrain, beside MeshLab's Taubin smoother and
  VTK's windowed sinc filter, which have the best of many settings for the exact terrain;
- a wave over a plane whose edges are five times as long on one side as on the other: the share that either side keeps;
- a cylinder between two rings, which comes to rest at the catenoid: area over that of the catenoid, and triangles whose
  normals have turned round.

"grid" is the method shared-cells, at the depth that it chooses.

Needs PyMeshLab and VTK: external/pymeshlab.sh build/pymeshlab, build/pymeshlab/bin/python -m pip install vtk, then
build/pymeshlab/bin/python every_wavelength.py.
"""

import pathlib
import tempfile

import numpy
import shapes
from experiment import Experiment
from leaving_in_place import CELL, terrain
from measures import area, distance
from other_noise import rotation
from ply import read_mesh, write_ply
from smoothers import best, taubin_families
from surface import Surface
from windowed_sinc import sinc_families

METHODS = {"mesh": "converged", "grid": "shared-cells"}
STEPS = 3
DETAIL_SIZES = [2.5, 4, 8, 16, 32]  # in edges, and so are waves
WAVES = [2.5, 3.3, 5, 8, 16, 32, 64]
SIDE = 180  # of the plane, in quads
TURN = rotation(0.7, 0.3)
HEIGHT = 0.6  # half that of the cylinder


def kept(wave, detail_size, order):
    """Returns the share of its height that a plane wave ideally keeps."""
    h = (1 - 2 ** (-1 / STEPS)) ** (1 / order)
    waves = h / (1 - h) * (detail_size / wave) ** 2  # δk²
    return (1 - (waves / (1 + waves)) ** order) ** STEPS


class Flow:
    """Runs the program on vertices and faces."""

    def __init__(self, experiment, folder):
        self.experiment, self.folder = experiment, folder

    def __call__(self, method, vertices, faces, *words):
        """Returns the moved vertices, and the report."""
        source, target = self.folder / "in.ply", self.folder / "out.ply"
        write_ply(source, vertices, faces)
        report, _ = self.experiment.smooth(source, target, "--method", METHODS[method], *words)
        return read_mesh(target)[0], report


def share(flow, method, surface, wave, inside, *words):
    """Returns the share of its height that a wave over a plane keeps where `inside` is true."""
    height = 0.01 * min(wave, 10) * numpy.sin(2 * numpy.pi * surface.vertices[:, 0] / wave)
    waved = surface.vertices + height[:, None] * (0, 0, 1)
    moved = flow(method, waved @ TURN.T, surface.faces, *words)[0] @ TURN
    return float((moved[inside, 2] * height[inside]).sum() / (height[inside] ** 2).sum())


def waves_over_a_plane(experiment, flow):
    plane = Surface("plane", *shapes.sheet(SIDE, SIDE))
    plane = Surface("plane", plane.vertices / plane.edge, plane.faces)  # edges of length 1
    x, y = plane.vertices[:, :2].T / plane.vertices[:, 0].max()
    inside = (abs(x - 0.5) < 0.25) & (abs(y - 0.5) < 0.25)
    rows, errors = [], {"at ℓ and 2 ℓ": [], "below ℓ / 2": []}
    for detail_size in DETAIL_SIZES:
        waves = sorted({*(wave for wave in WAVES if wave <= 2 * detail_size), detail_size, 2 * detail_size})
        for order in (1, 2):
            exact = [kept(wave, detail_size, order) for wave in waves]
            rows += [{"detail size": detail_size, "order": order, "of": "ideal", **dict(zip(waves, exact))}]
            for method in METHODS:
                found = [share(flow, method, plane, wave, inside, "--detail-size", detail_size, "--order", order)
                         for wave in waves]
                rows += [{"detail size": detail_size, "order": order, "of": method, **dict(zip(waves, found))}]
                if method == "grid" or detail_size < 4:
                    continue
                for wave, value, ideal in zip(waves, found, exact):
                    if wave in (detail_size, 2 * detail_size):
                        errors["at ℓ and 2 ℓ"].append(abs(value / ideal - 1))
                    elif wave < detail_size / 2:
                        errors["below ℓ / 2"].append(value - ideal)
    columns = sorted({key for row in rows for key in row if not isinstance(key, str)})
    experiment.say("## Plane waves: the share of their height that stays\n")
    experiment.table(["ℓ, edges", "order", "", *(f"{wave:g}" for wave in columns)],
                     [[row["detail size"], row["order"], row["of"],
                       *(f"{row[wave]:.3f}" if wave in row else "" for wave in columns)] for row in rows])
    experiment.record([{"table": "waves", **row} for row in rows])
    experiment.check("mesh, ℓ of 4 edges or more, waves of ℓ and 2 ℓ: largest relative error", max(errors["at ℓ and 2 ℓ"]),
                     at_most=0.02)
    experiment.check("mesh, the same, waves below ℓ / 2: most that stays above the ideal", max(errors["below ℓ / 2"]),
                     at_most=0.05)


def terraces(experiment, flow):
    ground = terrain(200, 200)
    rounded = ground.vertices.copy()
    rounded[:, 2] = numpy.round(rounded[:, 2])
    rows = [["input", "", distance(ground, rounded) * ground.edge]]
    for metres, order in ((100, 2), (150, 2), (250, 3)):
        for method in METHODS:
            moved = flow(method, rounded, ground.faces, "--detail-size", metres, "--order", order)[0]
            rows.append([method, f"{metres} m, order {order}", distance(ground, moved) * ground.edge])
    if not experiment.options.quick:
        for name, families in (("Taubin", taubin_families), ("windowed sinc", sinc_families)):
            result, _ = best(ground, rounded, families(ground, rounded))
            rows.append([name, "best setting", distance(ground, result["vertices"]) * ground.edge])
    experiment.say(f"\n## Terrain in whole metres, cells of {CELL:g} m\n")
    experiment.table(["", "detail size", "RMS distance, m"], rows)
    experiment.record([{"table": "terrain", "of": of, "setting": setting, "RMS": value} for of, setting, value in rows])


def two_resolutions(experiment, flow):
    """A plane with columns five wide, then one wide, and waves across them."""
    coarse, fine = 40, 5
    widths = [fine] * coarse + [1] * (coarse * fine)
    x = numpy.concatenate([[0], numpy.cumsum(widths)])
    vertices, faces = shapes.sheet(len(widths), 4 * coarse)
    vertices[:, 0], vertices[:, 1] = x[vertices[:, 0].astype(int)], vertices[:, 1] * fine / 2
    plane = Surface("two resolutions", vertices, faces)
    across, middle = vertices[:, 0], coarse * fine
    inside = abs(vertices[:, 1] / vertices[:, 1].max() - 0.5) < 0.25
    sides = {"coarse": inside & (across > 0.3 * middle) & (across < 0.8 * middle),
             "fine": inside & (across > 1.2 * middle) & (across < 1.7 * middle)}
    detail_size = 8 * fine
    rows = []
    for waves in (3, 5, 8, 16):
        rows.append([waves, "ideal", *[kept(waves * fine, detail_size, 2)] * 2])
        for method in METHODS:
            rows.append([waves, method, *(share(flow, method, plane, waves * fine, side, "--detail-size", detail_size,
                                                "--order", 2) for side in sides.values())])
    experiment.say("\n## Two resolutions, 1 : 5, ℓ of 8 coarse edges\n")
    experiment.table(["wave, coarse edges", "", *sides], rows)
    experiment.record([{"table": "two resolutions", "wave": wave, "of": of, "coarse": here, "fine": there}
                       for wave, of, here, there in rows])


def catenoid(experiment, flow):
    columns, rows_of = 96, 41
    faces = shapes.grid_faces(columns, rows_of - 1, 1)
    turn, z = numpy.meshgrid(numpy.arange(columns) * 2 * numpy.pi / columns, numpy.linspace(-HEIGHT, HEIGHT, rows_of),
                             indexing="ij")
    cylinder = numpy.stack([numpy.cos(turn).ravel(), numpy.sin(turn).ravel(), z.ravel()], 1)
    below, above = 0.6, 1.0  # the waist c, where c cosh(h / c) = 1
    while above - below > 1e-12:
        c = (below + above) / 2
        below, above = (c, above) if c * numpy.cosh(HEIGHT / c) < 1 else (below, c)
    exact = numpy.pi * c * (2 * HEIGHT + c * numpy.sinh(2 * HEIGHT / c))

    def normals(vertices):
        corners = vertices[faces]
        return numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])

    rows = []
    for size, steps in ((1, 20), (0.01, 200), (0.001, 1000))[:2 if experiment.options.quick else 3]:
        for method in METHODS:
            moved, report = flow(method, cylinder, faces, "--step-size", size, "--absolute", "--iterations", steps)
            folded = int(((normals(moved) * normals(cylinder)).sum(1) <= 0).sum())
            rows.append([f"{steps} steps of {size:g}", method, area(faces, moved) / exact, folded, report["stop"]])
            if method == "mesh":
                experiment.check(f"catenoid, {steps} steps: distance of the area from the exact one, relative",
                                 abs(rows[-1][2] - 1), at_most=1e-3)
                experiment.check(f"catenoid, {steps} steps: folded triangles", folded, at_most=0)
    experiment.say("\n## A cylinder between two rings\n")
    experiment.table(["", "", "area over the catenoid's", "folded", "stop"],
                     [[*row[:2], f"{row[2]:.5f}", *row[3:]] for row in rows])
    experiment.record([{"table": "catenoid", "setting": setting, "of": of, "area": value, "folded": folded, "stop": stop}
                       for setting, of, value, folded, stop in rows])


def main():
    experiment = Experiment("every_wavelength", __doc__)
    with tempfile.TemporaryDirectory() as folder:
        flow = Flow(experiment, pathlib.Path(folder))
        for table in (waves_over_a_plane, terraces, two_resolutions, catenoid):
            table(experiment, flow)
    experiment.finish()


if __name__ == "__main__":
    main()
