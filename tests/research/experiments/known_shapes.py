#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The flow on surfaces whose exact shape is known: terrain, thin plates, a staircase, a depth image, a catenoid.

ℓ is the detail size in mean edges of the exact surface, if there is no unit. The tables:

- terrain whose heights are rounded to whole metres: RMS distance from the terrain;
- closed plates of 100 by 100 quads and one to three quads thick, with noise in each coordinate. "Crossing" counts the
  triangles that cross others, folds of one side included; "of both sides" those among them, without the walls, that no longer
  do once the two sides are moved apart; "turned" the triangles whose normals turned by more than 90 degrees from the exact
  ones. "RMS inside" and the "thickness", the mean distance of opposite vertices over the exact one, leave the outer 5 quads
  out;
- with --findings, a torus by marching cubes of slices four times as far apart as their pixels. RMS is the distance of the
  vertices from the exact torus in edges, wherever they slide, and the angle is that to its normals;
- a depth image of 320 x 240 pixels (depth_camera in other_noise.py), with much noise far away and little within 1.5 m, which
  is "near". The RMS is along the normals, with and without the rim, which is locked; "sideways" is the RMS distance from the
  exact place across the normals;
- a cylinder between two rings, which comes to rest at the catenoid: area over that of the catenoid, and triangles whose
  normals have turned round.

"Stop" is the flow's reason to end before its last step. MeshLab's Taubin smoother and VTK's windowed sinc filter have the best
of many settings for the RMS, which only somebody can choose who has the exact surface.

Needs PyMeshLab and VTK: external/pymeshlab.sh build/pymeshlab, build/pymeshlab/bin/python -m pip install vtk, then
build/pymeshlab/bin/python known_shapes.py.
"""

import pathlib

import numpy
import shapes
from experiment import Experiment
from flow import Flow
from leaving_in_place import CELL, isotropic, terrain
from measures import across, angles, area, distance, heights, root_mean_square, topology_of, turned, volume
from other_noise import depth_camera, nearest, rotation, torus
from scan import Scan, mesh_set
from smoothers import best, taubin_families
from surface import SEED, Surface
from windowed_sinc import VTK_VERSION, sinc_families

HEIGHT = 0.6  # half that of the cylinder
RIM = 5  # of a plate, in quads
PLATES = [(1, 0.3), (2, 0.2), (2, 0.3), (3, 0.3)]  # thickness in quads, and noise in edges
OF_PLATES = [(3, 2), (4, 2), (8, 2), (8, 1)]  # detail size and order; the default first
OF_STAIRCASE = [(3, 2), (4, 2), (8, 2), (12, 2), (16, 2), (24, 2)]
OF_DEPTH_IMAGE = [(3, 2), (8, 2), (16, 2), (24, 2), (32, 2), (48, 2)]


def by_flow(flow, surface, noisy, settings):
    """Yields names, the flow's results for detail sizes in edges and orders, and the reason to stop."""
    for detail_size, order in settings:
        moved, report = flow(noisy, surface.faces, "--detail-size", detail_size * surface.edge, "--order", order)
        yield f"flow, ℓ = {detail_size:g}, order {order}", moved, report["stop"]


def by_peers(experiment, surface, noisy):
    """Yields names and the best results of other smoothers."""
    if not experiment.options.quick:
        for name, families in (("Taubin", taubin_families), ("windowed sinc", sinc_families)):
            yield f"{name}, best setting", best(surface, noisy, families(surface, noisy))[0]["vertices"], ""


def all_results(experiment, flow, surface, noisy, settings):
    yield "input", noisy, ""
    yield from by_flow(flow, surface, noisy, settings[:2] if experiment.options.quick else settings)
    yield from by_peers(experiment, surface, noisy)


def show(experiment, table, title, headers, rows):
    """Prints and records a table."""
    experiment.say(f"\n## {title}\n")
    experiment.table(headers, rows)
    experiment.record([{"table": table, **dict(zip(["of" if header == "" else header for header in headers], row))}
                       for row in rows])


def terraces(experiment, flow):
    ground = terrain(200, 200)
    rounded = ground.vertices.copy()
    rounded[:, 2] = numpy.round(rounded[:, 2])
    rows = [["input", distance(ground, rounded) * ground.edge]]
    for metres, order in ((100, 2), (150, 2), (250, 3)):
        moved = flow(rounded, ground.faces, "--detail-size", metres, "--order", order)[0]
        rows.append([f"flow, ℓ = {metres} m, order {order}", distance(ground, moved) * ground.edge])
    rows += [[name, distance(ground, moved) * ground.edge] for name, moved, _ in by_peers(experiment, ground, rounded)]
    show(experiment, "terrain", f"Terrain in whole metres, cells of {CELL:g} m", ["", "RMS distance, m"], rows)


def crossing(surface, vertices):
    """Returns which faces cross others."""
    meshes = mesh_set(surface, vertices)
    meshes.compute_selection_by_self_intersections_per_face()
    return meshes.current_mesh().face_selection_array().astype(bool)


def plates(experiment, flow):
    rows = []
    for quads, noise in PLATES[:1] if experiment.options.quick else PLATES:
        vertices, faces = shapes.box((100, 100, quads))
        plate = Surface("plate", vertices, faces)
        noisy = isotropic(plate, noise)
        walls = numpy.ptp(vertices[faces, 2], axis=1) > 0
        apart = numpy.where(vertices[:, 2] > quads / 2, 10 * quads, 0)[:, None] * (0, 0, 1)
        sides = [numpy.flatnonzero((vertices[:, 2] == z) & (abs(vertices[:, :2] - 50) <= 50 - RIM).all(axis=1))
                 for z in (0, quads)]
        below, above = (side[numpy.lexsort(vertices[side, :2].T)] for side in sides)  # opposite vertices
        for name, moved, stop in all_results(experiment, flow, plate, noisy, OF_PLATES):
            inside = heights(plate, moved)[numpy.concatenate([below, above])]
            crossed = crossing(plate, moved)
            rows.append([f"{quads}, {noise}", name, distance(plate, moved), root_mean_square(inside), int(crossed.sum()),
                         int((crossed & ~walls & ~crossing(plate, moved + apart)).sum()),
                         turned(plate, noisy, moved)["turned"], float((moved[above] - moved[below])[:, 2].mean()) / quads,
                         100 * (volume(faces, moved) / volume(faces, vertices) - 1), stop])
    headers = ["quads, noise", "", "RMS", "RMS inside", "crossing", "of both sides", "turned", "thickness", "volume, %",
               "stop"]
    show(experiment, "plates", "Thin closed plates with noise", headers, rows)
    for plate in dict.fromkeys(row[0] for row in rows):
        of_input, *others = [row for row in rows if row[0] == plate]
        of_flow = [row for row in others if row[1].startswith("flow")]
        experiment.check(f"plate of {plate}: those of both sides, most of the flow's, beyond the input's",
                         max(row[5] for row in of_flow) - of_input[5], at_most=0)


def staircase(experiment, flow):
    if not experiment.options.findings:
        experiment.say("\nThe staircase torus was left out: it needs --findings.\n")
        return
    scan = Scan(experiment.unpacked(experiment.options.findings / "real" / "staircase_torus.ply.xz"))
    solid = torus(rotation(0.5, 0.3))
    exact = Surface("torus", nearest(solid, scan.vertices), scan.faces)

    def angle(vertices):
        """Returns the mean angle between the faces' normals and those of the torus nearest to their centres."""
        corners = vertices[exact.faces]
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        centres, step = corners.mean(axis=1), 1e-4
        gradient = numpy.stack([solid(centres + step * axis) - solid(centres - step * axis) for axis in numpy.eye(3)], -1)
        lengths = numpy.linalg.norm(normals, axis=1) * numpy.linalg.norm(gradient, axis=1)
        cosines = (normals * gradient).sum(axis=1) / numpy.maximum(lengths, 1e-300)
        return float(numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1))).mean())

    rows = [[name, root_mean_square(solid(moved)) / exact.edge, float(solid(moved).mean()) / exact.edge, angle(moved), stop]
            for name, moved, stop in all_results(experiment, flow, exact, scan.vertices, OF_STAIRCASE)]
    show(experiment, "staircase", "Torus of slices four times as far apart as pixels",
         ["", "RMS", "mean distance", "angle", "stop"], rows)


def depth_image(experiment, flow):
    case = depth_camera(numpy.random.default_rng(SEED), 320, 240)
    exact, near = case.surface, case.part[1]
    inside = numpy.isin(numpy.arange(len(near)), topology_of(exact).rim, invert=True)
    rows = []
    for name, moved, stop in all_results(experiment, flow, exact, case.noisy, OF_DEPTH_IMAGE):
        off = heights(exact, moved)
        sideways = numpy.linalg.norm(across(exact, moved - exact.vertices), axis=1) / exact.edge
        rows.append([name, distance(exact, moved), root_mean_square(off[inside]), root_mean_square(off[inside & near]),
                     root_mean_square(sideways), float(angles(exact, moved).mean()), stop])
    show(experiment, "depth image", f"Depth image of {len(near)} vertices",
         ["", "RMS", "RMS inside", "RMS near", "sideways", "angle", "stop"], rows)


def catenoid(experiment, flow):
    columns, rows_of = 96, 41
    faces = shapes.grid_faces(columns, rows_of - 1, 1)
    turn, z = numpy.meshgrid(numpy.arange(columns) * 2 * numpy.pi / columns, numpy.linspace(-HEIGHT, HEIGHT, rows_of),
                             indexing="ij")
    cylinder = Surface("cylinder", numpy.stack([numpy.cos(turn).ravel(), numpy.sin(turn).ravel(), z.ravel()], 1), faces)
    below, above = 0.6, 1.0  # the waist c, where c cosh(h / c) = 1
    while above - below > 1e-12:
        c = (below + above) / 2
        below, above = (c, above) if c * numpy.cosh(HEIGHT / c) < 1 else (below, c)
    exact = numpy.pi * c * (2 * HEIGHT + c * numpy.sinh(2 * HEIGHT / c))
    rows = []
    for size, steps in ((1, 20), (0.01, 200), (0.001, 1000))[:2 if experiment.options.quick else 3]:
        moved, report = flow(cylinder.vertices, faces, "--order", 1, "--step-size", size, "--iterations", steps)
        rows.append([f"{steps} steps of {size:g}", area(faces, moved) / exact,
                     turned(cylinder, cylinder.vertices, moved)["turned"], report["stop"]])
    show(experiment, "catenoid", "A cylinder between two rings", ["", "area over the catenoid's", "turned", "stop"],
         [[row[0], f"{row[1]:.5f}", *row[2:]] for row in rows])
    for name, ratio, count, _ in rows:
        experiment.check(f"catenoid, {name}: distance of the area from the exact one, relative", abs(ratio - 1), at_most=1e-3)
        experiment.check(f"catenoid, {name}: turned triangles", count, at_most=0)


def main():
    def add_options(parser):
        parser.add_argument("--findings", type=pathlib.Path, metavar="FOLDER", help="folder of files that misbehaved")

    experiment = Experiment("known_shapes", __doc__, add_options)
    experiment.say(f"The windowed sinc is that of VTK {VTK_VERSION}.")
    flow = Flow(experiment)
    for table in (terraces, plates, staircase, depth_image, catenoid):
        table(experiment, flow)
    experiment.finish()


if __name__ == "__main__":
    main()
