#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove Noise with its default parameters on surfaces of labels: voxels and slices.

Solids are sampled, and the samples' surface is smoothed. Each entry is the RMS distance from the solid's surface in the
shortest side of a cell, and the mean angle between normals of faces and the solid's in degrees, both weighted by area; then
the volume's change against the input, in per cent. Surfaces are by marching cubes at half a cell, or the faces of cells.
Soft ones are by marching cubes of labels that were blurred first; "Laplace" ones were smoothed by others. Beside ours are
VTK's windowed sinc filter at two settings (20 iterations with a pass band of 0.1, 50 with 0.01), MeshLab's Taubin smoother
at its defaults, and VTK's surface nets at PyVista's, which have the volume as their input, not its surface.

A second table counts labels that smoothing should find: random ones of 30 to 20,000 voxels. A third one counts models whose
steps are their shape, which should keep their bits.

Needs PyMeshLab, PyVista and SciPy: README.md says how to install them.
"""

import numpy
import scipy.ndimage
import scipy.sparse
from experiment import Experiment
from smoothers import applied
from surface import Surface
from voxels import (box, capsule, faces_of_voxels, gradient, isosurface, lattice_around, models_of_steps, normalised, rotation,
                    sampled, surface_nets, torus, turned)
from windowed_sinc import smoothed

SINC = {"sinc 20": {"n_iter": 20, "pass_band": 0.1}, "sinc 50": {"n_iter": 50, "pass_band": 0.01}}
SMOOTHERS = ["ours", *SINC, "Taubin", "surface nets"]
VOXELS = [30, 60, 120, 300, 800, 2000, 6000, 20000]  # of random labels
SEEDS = 5


def ellipsoid(radius, turn):
    axes = radius * numpy.array([1.3, 1, 0.8])

    def distance_of(points):
        scaled = numpy.linalg.norm(points @ turn / axes, axis=-1)
        return scaled * (scaled - 1) / numpy.maximum(numpy.linalg.norm(points @ turn / axes ** 2, axis=-1), 1e-9)
    return distance_of


def kidney(turn):
    def function(points):
        x, y, z = numpy.moveaxis(points @ turn, -1, 0)
        return numpy.linalg.norm(numpy.stack([x / 9, (y + 0.05 * z ** 2 - 4) / 11, z / 17], -1), axis=-1) - 1
    return normalised(function)


def gear(thickness):
    def function(points):
        x, y, z = numpy.moveaxis(points, -1, 0)
        outline = 20 + 2.5 * numpy.tanh(3 * numpy.sin(9 * numpy.arctan2(y, x)))
        radius = numpy.hypot(x, y)
        return numpy.maximum(numpy.maximum(radius - outline, 6 - radius), abs(z) - thickness / 2)
    return normalised(function)


def bone(turn):
    """Returns a bone that the scan's ends cut off."""
    def function(points):
        x, y, z = numpy.moveaxis(points, -1, 0)
        radius = 6 + 4 * (z / 24) ** 4
        return numpy.maximum(numpy.hypot(x - 0.2 * z * turn[0, 1], y - 0.2 * z) - radius, abs(z) - 24.3)
    return normalised(function)


def neurites(random):
    lines = [capsule(*random.uniform(-25, 25, (2, 3)), random.uniform(1.5, 3)) for _ in range(9)]
    return lambda points: numpy.minimum.reduce([line(points) for line in lines])


def faulted_block(turn):
    low, high = box(numpy.eye(3), (10, 10, 6)), box(numpy.eye(3), (5, 10, 8))
    return turned(lambda points: numpy.minimum(low(points), high(points - (-5, 0, 2))), turn)


def cases(random):
    """Yields name, solid, sides of a cell and kind of surface."""
    turn = rotation(*random.uniform(0.2, 1.2, 2))
    cube = numpy.eye(3)
    for radius in (1.9, 3, 6.5, 11.5):
        yield f"ellipsoid of radius {radius}", ellipsoid(radius, turn), cube, "marching cubes"
    for radius in (3, 11.5):
        yield f"ellipsoid of radius {radius}, faces", ellipsoid(radius, turn), cube, "faces"
    yield "ellipsoid 1:4", ellipsoid(11.5, turn), numpy.diag([0.7, 0.7, 2.8]), "marching cubes"
    yield "ellipsoid 1:4, faces", ellipsoid(11.5, turn), numpy.diag([0.7, 0.7, 2.8]), "faces"
    for height in (1, 2.5, 6, 10):
        yield f"kidney 1:{height}", kidney(turn), numpy.diag([1, 1, height]), "marching cubes"
    yield "kidney, faces", kidney(turn), cube, "faces"
    yield "kidney 1:2, lattice turned", kidney(turn), numpy.diag([1, 1, 2]) @ rotation(0.4, 0.7), "marching cubes"
    yield "kidney 1:2.2, sheared by 15 degrees", kidney(turn), [[1, 0, 0], [0, 1, 0], [0, 0.59, 2.2]], "marching cubes"
    for kind in ("cell to point", "Gaussian 0.4", "Gaussian 0.6", "Gaussian 0.8", "Laplace 5", "twice as fine",
                 "twice as fine, turned"):
        yield f"kidney, {kind}", kidney(turn), cube, kind
    yield "torus 14, 5", torus(turn, 14, 5), cube, "marching cubes"
    yield "torus 14, 2.2", torus(turn, 14, 2.2), cube, "marching cubes"
    yield "box, turned", box(turn), cube, "marching cubes"
    yield "rod of radius 1.3", capsule(*(random.uniform(0.8, 1, 3) * ((-9, -7, -5), (9, 7, 5))), 1.3), cube, "marching cubes"
    for thickness in (6, 24):
        yield f"gear {thickness} thick", gear(thickness), cube, "marching cubes"
    yield "gear 20 thick, faces", gear(20), cube, "faces"
    yield "bone, cut off", bone(turn), cube, "marching cubes"
    yield "neurites 16 x 16 x 40", neurites(random), numpy.diag([16, 16, 40]) / 16, "marching cubes"
    yield "faulted block", faulted_block(turn), cube, "marching cubes"


def laplace(vertices, faces, steps):
    """Returns the vertices after steps to the mean of their neighbours, half of the way each."""
    begin, end = faces.ravel(), numpy.roll(faces, -1, axis=1).ravel()
    sides = scipy.sparse.coo_matrix((numpy.ones(len(begin)), (begin, end)), shape=(len(vertices),) * 2).tocsr()
    degrees = numpy.asarray(sides.sum(axis=1)).ravel()[:, None]
    for _ in range(steps):
        vertices = (vertices + sides @ vertices / degrees) / 2
    return vertices


def surface_of(solid, sides, kind, random):
    """Returns the surface of a solid's samples, these, and the first one's place."""
    first, counts = lattice_around(sides, 34, random)
    inside = sampled(solid, sides, first, counts)
    if kind == "faces":
        vertices, faces = faces_of_voxels(inside, sides)
        return (vertices + first, faces), inside, first
    values = inside.astype(float)
    if kind == "cell to point":
        values = scipy.ndimage.uniform_filter(values, 2)
        first = first - 0.5 * numpy.sum(sides, axis=0)
    elif kind.startswith("Gaussian"):
        values = scipy.ndimage.gaussian_filter(values, float(kind.split()[1]))
    elif kind == "twice as fine":
        values = values.repeat(2, 0).repeat(2, 1).repeat(2, 2)
        first, sides = first - 0.25 * numpy.sum(sides, axis=0), numpy.asarray(sides) / 2
    elif kind == "twice as fine, turned":
        fine = rotation(0.2, 0.1) / 2
        coarse = inside, numpy.array(first), numpy.linalg.inv(sides)
        first, counts = lattice_around(fine, 34, random)

        def label_at(points):
            index = numpy.clip(numpy.rint((points - coarse[1]) @ coarse[2]).astype(int), 0, numpy.array(coarse[0].shape) - 1)
            return 0.5 - coarse[0][tuple(numpy.moveaxis(index, -1, 0))]
        inside, sides = sampled(label_at, fine, first, counts), fine
        values = inside.astype(float)
    vertices, faces = isosurface(values, sides)
    if kind.startswith("Laplace"):
        vertices = laplace(vertices, faces, int(kind.split()[1]))
    return (vertices + first, faces), inside, first


def volume(vertices, faces):
    a, b, c = numpy.moveaxis(vertices[faces], 1, 0)
    return abs(float((a * numpy.cross(b, c)).sum()) / 6)


def error(solid, vertices, faces, side, before):
    """Returns the measures of a surface."""
    corners = vertices[faces]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = numpy.linalg.norm(normals, axis=1)
    true = gradient(solid, corners.mean(axis=1))
    cosines = abs((normals * true).sum(axis=1)) / numpy.maximum(areas * numpy.linalg.norm(true, axis=1), 1e-300)
    distances = (solid(corners) ** 2).mean(axis=1)
    return {"RMS": float(numpy.sqrt(numpy.average(distances, weights=areas))) / side,
            "angle": float(numpy.average(numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1))), weights=areas)),
            "volume": 100 * (volume(vertices, faces) / before - 1)}


def row_of(experiment, case, random):
    name, solid, sides, kind = case
    print(f"... {name}", flush=True)
    (vertices, faces), inside, first = surface_of(solid, sides, kind, random)
    surface, before = Surface(name, vertices, faces), volume(vertices, faces)
    side = min(numpy.linalg.norm(sides, axis=1))
    measure = lambda vertices, faces=faces: error(solid, vertices, faces, side, before)  # noqa: E731
    moved, report, seconds = experiment.smoothed(vertices, faces, command="remove-noise")
    row = {"input": measure(vertices), "ours": {**measure(moved), "kind": report["kind"], "seconds": seconds}}
    for peer, setting in SINC.items():
        row[peer] = measure(smoothed(surface, vertices, normalize_coordinates=True, **setting)[0])
    row["Taubin"] = measure(applied(surface, vertices, "apply_coord_taubin_smoothing")[0])
    if kind in ("marching cubes", "faces"):
        nets, triangles = surface_nets(inside, sides)
        row["surface nets"] = measure(nets + first, triangles)
    return row


def entry(measured):
    return f"{measured['RMS']:.3f}, {measured['angle']:.3g}, {measured['volume']:+.1f}" if measured else ""


def random_label(count, random):
    """Returns connected voxels, about so many."""
    size = int(2.5 * count ** (1 / 3)) + 6
    noise = scipy.ndimage.gaussian_filter(random.normal(size=(size,) * 3), size / 8)
    middle = numpy.stack(numpy.meshgrid(*[numpy.linspace(-1, 1, size)] * 3, indexing="ij"))
    noise = noise / noise.std() - 4 * (middle ** 2).sum(axis=0)
    inside = noise > numpy.sort(noise.ravel())[-count]
    labels, _ = scipy.ndimage.label(inside)
    return numpy.pad(labels == numpy.argmax(numpy.bincount(labels.ravel())[1:]) + 1, 2)


def clicks(experiment, name, mesh):
    """Returns what a click does to a mesh: its kind, the largest movement in cells, and whether it is named."""
    vertices, faces = mesh
    moved, report, _ = experiment.smoothed(vertices, faces, command="remove-noise")
    return {"mesh": name, "kind": report["kind"], "stairs": report["stairs"],
            "moved": float(numpy.linalg.norm(moved - vertices, axis=1).max())}


def tell_of_clicks(experiment, title, rows):
    experiment.record(rows)
    experiment.say(f"\n{title}: {sum(row['kind'] == 'stairs' for row in rows)} of {len(rows)} smoothed as stairs, "
                   f"{sum(row['moved'] > 0 and row['kind'] != 'stairs' for row in rows)} moved otherwise; "
                   f"{sum(row['moved'] == 0 and row['stairs'] > 0 for row in rows)} stay and are named.\n")
    return rows


def tell_of_random_labels(experiment, random):
    experiment.say("## Random labels\n")
    for kind, surface in (("marching cubes", lambda inside: isosurface(inside, numpy.eye(3))), ("faces", faces_of_voxels)):
        rows = []
        for count in VOXELS[:2] if experiment.options.quick else VOXELS:
            for number in range(SEEDS):
                inside = random_label(count, random)
                rows.append(clicks(experiment, f"label of {inside.sum()} voxels, {number}, {kind}", surface(inside)))
        tell_of_clicks(experiment, f"By {kind}" if kind != "faces" else "Of faces", rows)
        missed = [row["mesh"] for row in rows if row["kind"] != "stairs"]
        experiment.check(f"labels that stay, {kind}", len(missed) / len(rows), at_most=0.1)
        experiment.say(f"- they are: {'; '.join(missed) or 'none'}")


def tell_of_models(experiment):
    experiment.say("\n## Models of steps\n")
    for kind, surface in (("faces", faces_of_voxels), ("marching cubes", lambda inside: isosurface(inside, numpy.eye(3)))):
        rows = [clicks(experiment, f"{name}, {kind}", surface(inside)) for name, inside in models_of_steps()]
        tell_of_clicks(experiment, f"By {kind}" if kind != "faces" else "Of faces", rows)
        experiment.table(["moved model", "kind", "stairs", "farthest, cells"],
                         [[row["mesh"], row["kind"], row["stairs"], row["moved"]] for row in rows if row["moved"] > 0])


def main():
    experiment = Experiment("labels", __doc__, lambda parser: parser.add_argument(
        "--seed", type=int, default=1, metavar="NUMBER", help="of the places of lattices, and of random labels"))
    random = numpy.random.default_rng(experiment.options.seed)
    rows = {}
    for case in list(cases(random))[:3 if experiment.options.quick else None]:
        rows[case[0]] = row_of(experiment, case, random)
    experiment.record([{"case": case, "smoother": name, **measured} for case, row in rows.items()
                       for name, measured in row.items()])
    experiment.table(["case", "input", "kind", *SMOOTHERS, "our seconds"],
                     [[case, "{RMS:.3f}, {angle:.3g}".format(**row["input"]), row["ours"]["kind"],
                       *(entry(row.get(name)) for name in SMOOTHERS), row["ours"]["seconds"]] for case, row in rows.items()])
    for peer in SMOOTHERS[1:]:
        for figure in ("RMS", "angle"):
            ratios = {case: row["ours"][figure] / row[peer][figure] for case, row in rows.items() if peer in row}
            worst = max(ratios, key=ratios.get)
            experiment.say(f"- {figure} over {peer}: {sum(ratio > 1 for ratio in ratios.values())} of {len(ratios)} rows "
                           f"behind, geometric mean {numpy.exp(numpy.mean(numpy.log(list(ratios.values())))):.3g}, "
                           f"the worst is {worst} with {ratios[worst]:.3g}")
    experiment.check("largest change of the volume, per cent", max(abs(row["ours"]["volume"]) for row in rows.values()), at_most=1)
    experiment.say()
    tell_of_random_labels(experiment, random)
    tell_of_models(experiment)
    experiment.finish()


if __name__ == "__main__":
    main()
