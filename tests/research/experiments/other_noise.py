#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove Noise on noise that is not independent from vertex to vertex, or not the same everywhere.

Each entry is the RMS displacement from the clean vertices along the clean normals, in mean edges of the clean surface, and
the mean angle between normals of faces and those of the clean surface, in degrees. The cases:

- surfaces of voxels, at the boundaries of sampled solids: a torus and a box in slices that are three or four times as far
  apart as their pixels, and in cubes, by marching cubes; and the faces of the voxels themselves. The clean vertices are the
  nearest points of the solid;
- terrain whose heights are rounded to whole metres;
- lumps: noise averaged over neighbours four or sixteen times, in all coordinates of a building or along the normals; ripples
  and layers of a print;
- a depth camera: noise grows with the squared distance from it, along the rays. The near part is within 1.5 m, where most
  filters do more harm than good;
- noise that grows from 0.05 to 0.35 edges along the longest axis of a mesh.

The program runs with its defaults, and where noise has a size that the mesh does not show, with this size, too. MeshLab's
Taubin and two-step smoothers, VTK's windowed sinc filter and our flow have the best of many settings, for the distance and
for the angle each, which only somebody can choose who has the clean surface. --seed makes other noise.

Needs PyMeshLab, PyVista and SciPy: README.md says how to install them.
"""

import numpy
import shapes
from experiment import CGAL_MESHES, Experiment
from leaving_in_place import terrain
from measures import angles, distance, heights
from scan import Scan
from smoothers import best, taubin_families, two_step_families
from surface import Surface
from voxels import box, faces_of_voxels, isosurface, nearest, rotation, sampled, torus
from windowed_sinc import sinc_families

DETAIL_SIZES = [4, 8, 12, 16]  # of the flow, in edges
NEAR = 1.5  # metres
FIRST = -32  # sample of a solid, in each coordinate
PIXELS = 200  # of the depth camera, along each side


class Case:
    """A noisy surface, and the size of its noise in edges, if the mesh does not show it."""

    def __init__(self, name, surface, noisy, size=None, part=None):
        self.name, self.surface, self.noisy, self.size = name, surface, noisy, size
        self.part = part  # which vertices are measured on their own


def cases_of_voxels(random):
    for name, kind, spacing in (("torus", torus, (0.7, 0.7, 2.8)), ("box", box, (0.7, 0.7, 2.1)),
                                ("torus", torus, (0.9, 0.9, 0.9)), ("box", box, (0.7, 0.7, 0.7)),
                                ("torus, faces of", torus, None)):
        solid = kind(rotation(0.5 + random.normal(0, 0.1), 0.3 + random.normal(0, 0.1)))
        sides = numpy.diag(spacing or (1, 1, 1))
        inside = sampled(solid, sides, FIRST, numpy.ceil(-2 * FIRST / numpy.diag(sides)).astype(int))
        vertices, faces = isosurface(inside, sides) if spacing else faces_of_voxels(inside)
        vertices = vertices + FIRST
        what = "voxels" if spacing is None or len(set(spacing)) == 1 else "slices"
        yield Case(f"{name} {what}" if spacing is None else f"{name}, {what}",
                   Surface(name, nearest(solid, vertices), faces), vertices)
    land = terrain(140, 140)
    rounded = land.vertices.copy()
    rounded[:, 2] = numpy.round(rounded[:, 2])
    yield Case("terrain in whole metres", land, rounded)


def building():
    vertices, faces = shapes.box((40, 32, 24))
    vertices = vertices / 4
    roof = vertices[:, 2] > 5.999
    vertices[roof, 2] += 2.5 * (1 - abs(vertices[roof, 1] - 4) / 4)
    return Surface("building", vertices, faces)


def averaged(surface, random, times, width):
    """Returns noise with a standard deviation of 1, averaged over neighbours."""
    noise = random.normal(size=(len(surface.vertices), width))
    begin, end = surface.faces[:, [0, 1, 2]].ravel(), surface.faces[:, [1, 2, 0]].ravel()
    for _ in range(times):
        sums, counts = noise.copy(), numpy.ones(len(noise))
        for a, b in ((begin, end), (end, begin)):
            numpy.add.at(sums, a, noise[b] / 2)
            numpy.add.at(counts, a, 1 / 2)
        noise = sums / counts[:, None]
    return noise / noise.std()


def along_normals(surface, values):
    """Returns the vertices moved along their normals by values in edges."""
    return surface.vertices + surface.edge * numpy.asarray(values).reshape(-1, 1) * surface.normals


def cases_of_lumps(experiment, random):
    house = building()
    for times, size in ((4, 4), (16, 6)):
        yield Case(f"building, lumps {times}", house,
                   house.vertices + 0.25 * house.edge * averaged(house, random, times, 3), size)
    cube = Surface("cube", *shapes.cube(40))
    fandisk = Scan(CGAL_MESHES / "fandisk.off")
    for surface in (cube, fandisk, *hands(experiment)):
        yield Case(f"{surface.name}, lumps 4", surface, along_normals(surface, 0.2 * averaged(surface, random, 4, 1)), 3)
    wave = numpy.sin(2 * numpy.pi * (fandisk.vertices @ (0.8, 0.5, 0.4)) / (6 * fandisk.edge) + random.uniform(0, 6))
    yield Case("fandisk, ripples of 6 edges", fandisk, along_normals(fandisk, 0.15 * numpy.sqrt(2) * wave), 3)
    for hand in hands(experiment):
        phase = numpy.pi * (hand.vertices @ (0.15, 0.1, 0.98)) / (6 * hand.edge) + random.uniform(0, 6)
        yield Case("hand_8k, layers of 6 edges", hand, along_normals(hand, 0.33 * (abs(numpy.cos(phase)) - 2 / numpy.pi)), 3)


def hands(experiment):
    return [Scan(experiment.options.meshes / "hand_8k.ply")] if experiment.options.meshes else []


def depth_camera(random):
    """Returns what a depth camera sees of spheres on a floor, before a wall, with its noise."""
    x, y = numpy.meshgrid(*[(numpy.arange(PIXELS) - PIXELS / 2) / (0.9 * PIXELS)] * 2)
    rays = numpy.stack([x, y, numpy.ones_like(x)], -1)
    depth = numpy.minimum(4.5, numpy.where(y > 0, 1 / numpy.maximum(y, 1e-9), numpy.inf))
    for centre, radius in (((-0.35, 0.3, 1.2), 0.3), ((0.5, 0.4, 2.2), 0.5), ((-0.8, 0.2, 3.2), 0.7)):
        a, b = (rays ** 2).sum(axis=-1), rays @ centre
        inside = b ** 2 - a * (numpy.dot(centre, centre) - radius ** 2)
        hit = (b - numpy.sqrt(numpy.maximum(inside, 0))) / a
        depth = numpy.where((inside > 0) & (hit < depth), hit, depth)
    faces = shapes.grid_faces(PIXELS - 1, PIXELS - 1, 0)[:, ::-1]
    corners = depth.ravel()[faces]
    faces = faces[corners.max(axis=1) - corners.min(axis=1) < 0.08 * corners.min(axis=1)]
    used, faces = numpy.unique(faces, return_inverse=True)
    vertices = (rays * depth[..., None]).reshape(-1, 3)[used]
    surface = Surface("depth camera", vertices, faces.reshape(-1, 3))
    deviation = 0.0012 + 0.0019 * (vertices[:, 2] - 0.4) ** 2  # metres
    rays = vertices / numpy.linalg.norm(vertices, axis=1)[:, None]
    noisy = vertices + (deviation * random.normal(size=len(vertices)))[:, None] * rays
    return Case("depth camera", surface, noisy, part=("near part", vertices[:, 2] < NEAR))


def cases_of_varying_noise(experiment, random):
    yield depth_camera(random)
    scans = [Surface("cube", *shapes.cube(40)), Scan(CGAL_MESHES / "bear.off")]
    for surface in (*scans, *hands(experiment)):
        axis = numpy.argmax(numpy.ptp(surface.vertices, axis=0))
        share = (surface.vertices[:, axis] - surface.vertices[:, axis].min()) / numpy.ptp(surface.vertices[:, axis])
        yield Case(f"{surface.name}, 0.05 to 0.35", surface,
                   along_normals(surface, (0.05 + 0.3 * share) * random.normal(size=len(share))))


def cases(experiment, random):
    yield from cases_of_voxels(random)
    if not experiment.options.quick:
        yield from cases_of_lumps(experiment, random)
        yield from cases_of_varying_noise(experiment, random)


def program(experiment, case, command, *words):
    """Returns the vertices of the program's result, and its processor seconds."""
    vertices, _, seconds = experiment.smoothed(case.noisy, case.surface.faces, *words, command=command)
    return vertices, seconds


def flow_families(experiment, case):
    return [[lambda size=size: program(experiment, case, "smooth", "--detail-size", size * case.surface.edge, "--order", 2)
             for size in DETAIL_SIZES]]


def error(case, vertices):
    """Returns a dictionary of the measures."""
    measured = {"RMS": distance(case.surface, vertices), "angle": float(angles(case.surface, vertices).mean())}
    if case.part:
        measured[case.part[0]] = float(numpy.sqrt((heights(case.surface, vertices)[case.part[1]] ** 2).mean()))
    return measured


def results(experiment, case):
    """Returns a dictionary of the measures of each smoother, and the seconds of the program."""
    vertices, seconds = program(experiment, case, "remove-noise")
    row = {"noisy": error(case, case.noisy), "ours": {**error(case, vertices), "seconds": seconds}}
    if case.size:
        size = case.size * case.surface.edge
        vertices, seconds = program(experiment, case, "remove-noise", "--noise-size", size)
        row["ours, size given"] = {**error(case, vertices), "seconds": seconds}
    if not experiment.options.quick:
        for name, families in (("windowed sinc", sinc_families(case.surface, case.noisy)),
                               ("Taubin", taubin_families(case.surface, case.noisy)),
                               ("two-step", two_step_families(case.surface, case.noisy)),
                               ("flow", flow_families(experiment, case))):
            found, angle = best(case.surface, case.noisy, families)
            row[name] = {**error(case, found["vertices"]), "angle": angle}
    return row


def main():
    def add_options(parser):
        parser.add_argument("--seed", type=int, default=1, help="of the noise, and of the places of solids")

    experiment = Experiment("other_noise", __doc__, add_options)
    rows = {}
    for case in cases(experiment, numpy.random.default_rng(experiment.options.seed)):
        print(f"... {case.name}", flush=True)
        rows[case] = results(experiment, case)
    smoothers = list(dict.fromkeys(name for row in rows.values() for name in row))
    experiment.record([{"case": case.name, "smoother": name, **measured} for case, row in rows.items()
                       for name, measured in row.items()])
    experiment.table(["case", *smoothers, "our seconds"],
                     [[case.name, *(f"{row[name]['RMS']:.3f}, {row[name]['angle']:.3g}" if name in row else ""
                                    for name in smoothers), row["ours"]["seconds"]] for case, row in rows.items()])
    for case, row in rows.items():
        ours = row.get("ours, size given", row["ours"])
        noisy = row["noisy"]
        experiment.check(f"{case.name}: RMS over the noisy one", ours["RMS"] / noisy["RMS"], at_most=1)
        if case.part:
            part = case.part[0]
            experiment.say(f"- {case.name}, {part}: RMS " + ", ".join(
                f"{name} {measured[part]:.3g}" for name, measured in row.items()))
        peers = {figure: min(row[name][figure] for name in row if not name.startswith(("ours", "noisy")))
                 for figure in ("RMS", "angle")} if len(row) > 3 else {}
        if peers:
            experiment.say(f"- {case.name}: over the best other one: RMS {ours['RMS'] / peers['RMS']:.3g}, "
                           f"angle {ours['angle'] / peers['angle']:.3g}")
    experiment.finish()


if __name__ == "__main__":
    main()
