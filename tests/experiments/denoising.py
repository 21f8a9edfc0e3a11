#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how well noise is removed from parts and scans, beside MeshLab's smoothers and a bilateral filter.

Noise is normally distributed; its standard deviation is in mean edge lengths of the clean mesh. It moves the
vertices along their normals, in each coordinate ("isotropic"), or every fifth vertex along its normal
("impulsive"). Each entry is the RMS distance of the vertices to the clean surface, in mean edge lengths, and
the mean angle between normals of faces and those of the clean mesh, in degrees. "default" is the filter with
its default parameters, "order 2" with that order, "edges" with one setting that keeps edges (25 degrees,
detail size 3 edges, order 2). All others are the best of many settings, for the distance and for the angle
each. "uneven" scans had one half subdivided before. Our seconds include reading and writing files,
the others' do not.

Needs PyMeshLab: external/pymeshlab.sh build/pymeshlab, then build/pymeshlab/bin/python denoising.py.
"""

import itertools
import pathlib
import subprocess
import tempfile

import numpy
from bilateral import BilateralFilter, area_vectors, unit
from experiment import TOP, Experiment, geometric_mean, processor_seconds
from scan import SEED, Scan, loaded, pymeshlab

PARTS = ["fandisk.off", "anchor_dense.off", "mech-holes-shark.off"]  # of libcgal-demo
SCANS = ["hand_8k.ply", "skull_50k.ply", "nefertiti_50k.ply", "armadillo_50k.ply"]
CGAL = ["hand.off", "nefertiti.off", "elephant.off", "armadillo.off"]
CUBE = 40  # edges along each of its own
UNEVEN = "hand"
NOISES = ["0", "0.1", "0.2", "0.3", "0.2 isotropic", "0.3 impulsive"]
DRAWN = {"fandisk": ("-0.6 -0.6 1", "0 1 0"), "anchor_dense": ("-1 -1 -1", "0 0 1"),
         "skull_50k": ("0 0 -1", "0 1 0")}  # with the camera's direction and what is up

ONE_SETTING = {"keep_edges": 25, "detail_size": 3, "order": 2}
DETAIL_SIZES = [2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7]  # in mean edge lengths
STEPS = [1, 2, 3, 4, 6, 8, 10, 14, 20, 30, 50]
OURS = ["default", "order 2", "edges"]
OUR_BEST = "best with edges"
STOCK = ["Taubin", "Laplacian", "two-step"]

LARGEST_COLOURED_ANGLE = 20  # degrees
PLASTER, RED = numpy.array([0.93, 0.89, 0.83]), numpy.array([0.75, 0.05, 0.05])


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


def angles(scan, vertices):
    """Returns the angle of each face's normal to that of the clean mesh, in degrees."""
    clean = unit(area_vectors(scan.vertices, scan.faces))
    cosines = (clean * unit(area_vectors(vertices, scan.faces))).sum(axis=1)
    return numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1)))


def mean_angle(scan, vertices):
    return float(angles(scan, vertices).mean())


def noisy(scan, noise):
    """Returns the noisy vertices; `noise` is one of NOISES."""
    deviation, *kind = noise.split()
    random = numpy.random.default_rng(SEED)
    if kind == ["isotropic"]:
        return scan.vertices + random.normal(0, float(deviation) * scan.edge, scan.vertices.shape)
    vertices = scan.noisy(float(deviation))
    if kind == ["impulsive"]:
        spared = random.random(len(vertices)) >= 0.2
        vertices[spared] = scan.vertices[spared]
    return vertices


class Tool:
    """The program tracked_mcf, applied to the noisy vertices of a scan."""

    def __init__(self, experiment, scan, vertices, folder):
        self._experiment, self._folder = experiment, pathlib.Path(folder)
        self._edge = scan.edge
        scan.mesh_set(vertices).save_current_mesh(str(self._folder / "in.ply"),
                                                  save_vertex_quality=False)

    def smooth(self, detail_size=None, order=1, steps=3, depth=0, local=False, keep_edges=0):
        """Returns the vertices after the filter, and its processor seconds. `detail_size` is in mean edge
        lengths; None is the default."""
        words = ["--order", order, "--iterations", steps, "--depth", depth, "--keep-edges",
                 keep_edges]
        if local:
            words.append("--local-detail-size")
        if detail_size is not None:
            words += ["--detail-size", repr(detail_size * self._edge)]
        target = self._folder / "out.ply"
        report, seconds = self._experiment.smooth(self._folder / "in.ply", target, *words)
        self.depth = report["depth"]
        result = loaded(target)
        return result.current_mesh().vertex_matrix(), seconds


def applied(scan, vertices, name, **parameters):
    """Returns the vertices after MeshLab's filter `name`, and its processor seconds."""
    meshes = scan.mesh_set(vertices)
    begin = processor_seconds()
    meshes.apply_filter(name, **parameters)
    return meshes.current_mesh().vertex_matrix(), processor_seconds() - begin


def best(scan, families):
    """Returns the best result over families of settings, as a dictionary.

    A family yields (settings, function) by increasing strength. The search leaves a family once neither
    distance nor angle got better twice.
    """
    found, angle = None, numpy.inf
    for family in families:
        least, worse = (numpy.inf, numpy.inf), 0
        for settings, smooth in family:
            vertices, seconds = smooth()
            now = rough_error(scan, vertices), mean_angle(scan, vertices)
            worse = 0 if now[0] < least[0] or now[1] < least[1] else worse + 1
            least = tuple(numpy.minimum(least, now))
            angle = min(angle, now[1])
            if found is None or now[0] < found[0]:
                found = (now[0], settings, seconds, vertices)
            if worse == 2:
                break
    _, settings, seconds, vertices = found
    return {"RMS": error(scan, vertices), "angle": angle, "settings": settings, "seconds": seconds,
            "vertices": vertices}


def single(scan, smoothed):
    vertices, seconds = smoothed
    return {"RMS": error(scan, vertices), "angle": mean_angle(scan, vertices), "seconds": seconds,
            "vertices": vertices}


def our_families(tool, depth):
    """Returns families of settings that keep edges, at this depth."""
    return [[(f"{angle} degrees, ℓ {size:g}{', local' if local else ''}",
              lambda size=size, angle=angle, local=local: tool.smooth(
                  size, order=2, depth=depth, keep_edges=angle, local=local))
             for size in DETAIL_SIZES]
            for angle, local in itertools.product((15, 25), (False, True))]


def stock_families(scan, vertices):
    """Returns MeshLab's smoothers by name, each with its families of settings."""
    def family(name, counts=tuple(STEPS), **fixed):
        words = ", ".join(f"{key} {value}" for key, value in fixed.items())
        return [(f"{count} steps, {words}", lambda count=count: applied(
            scan, vertices, name, stepsmoothnum=count, **fixed)) for count in counts]

    return {
        "Taubin": [family("apply_coord_taubin_smoothing", lambda_=0.5, mu=-0.53),
                   family("apply_coord_taubin_smoothing", lambda_=0.33, mu=-0.34)],
        "Laplacian": [family("apply_coord_laplacian_smoothing", cotangentweight=weight)
                      for weight in (False, True)],
        "two-step": [family("apply_coord_two_steps_smoothing", STEPS[:5], normalthr=float(angle))
                     for angle in (60, 30)]}


def bilateral_families(scan, vertices):
    """Yields the families of the bilateral filter, whose steps follow each other."""
    for width in (0.25, 0.35, 0.5):
        yield bilateral_family(scan, vertices, width)


def bilateral_family(scan, vertices, width):
    bilateral, seconds, done = BilateralFilter(vertices, scan.faces, width), 0, 0

    def smooth():
        nonlocal seconds, done
        begin = processor_seconds()
        while done < step:
            bilateral.filter_normals()
            done += 1
        result = bilateral.fitted_vertices()
        seconds += processor_seconds() - begin
        return result, seconds

    for step in STEPS[:-1]:
        yield f"width {width}, {step} steps", smooth


def measure(experiment, scan, noise):
    """Returns the row of one mesh with one noise: a result for each smoother."""
    vertices = noisy(scan, noise)
    print(f"... {scan.name}, {noise}", flush=True)
    row = {"noisy": {"RMS": error(scan, vertices), "angle": mean_angle(scan, vertices),
                     "vertices": vertices}}
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(experiment, scan, vertices, folder)
        row["default"] = single(scan, tool.smooth())
        row["order 2"] = single(scan, tool.smooth(order=2))
        row["edges"] = single(scan, tool.smooth(**ONE_SETTING))
        if noise == "0":
            return row
        row[OUR_BEST] = best(scan, our_families(tool, tool.depth))
    for name, families in stock_families(scan, vertices).items():
        row[name] = best(scan, families)
    row["bilateral"] = best(scan, bilateral_families(scan, vertices))
    return row


def cube(folder):
    """Writes a triangulated cube, and returns its path."""
    index, faces = {}, []

    def vertex(axis, end, i, j):
        at = numpy.roll([end * CUBE, i, j], axis)
        return index.setdefault(tuple(at.tolist()), len(index))

    for axis, end, i, j in itertools.product(range(3), (0, 1), range(CUBE), range(CUBE)):
        a, b, c, d = (vertex(axis, end, i + x, j + y) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        faces += [(a, b, c), (a, c, d)] if end else [(a, c, b), (a, d, c)]
    path = pathlib.Path(folder) / "cube.ply"
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(numpy.array(list(index), float), numpy.array(faces)))
    meshes.save_current_mesh(str(path))
    return path


def draw(experiment, scan, row):
    """Draws a mesh with noise, and smoothed; red is the error of the normals."""
    shown = {"noisy": "noisy", "Taubin": "Taubin, best", "edges": "this filter, edges kept"}
    forward, up = DRAWN[scan.name]
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for name in shown:
            vertices = row[name]["vertices"]
            share = numpy.minimum(angles(scan, vertices) / LARGEST_COLOURED_ANGLE, 1)[:, None]
            colours = numpy.ones((len(scan.faces), 4))
            colours[:, :3] = PLASTER * (1 - share) + RED * share
            # Vertices of their own for each face, which so has one colour.
            meshes = pymeshlab.MeshSet()
            meshes.add_mesh(pymeshlab.Mesh(
                vertices[scan.faces].reshape(-1, 3), numpy.arange(3 * len(scan.faces)).reshape(-1, 3),
                v_color_matrix=numpy.repeat(colours, 3, axis=0)))
            paths.append(f"{folder}/{len(paths)}.ply")
            meshes.save_current_mesh(paths[-1], save_vertex_color=True, save_vertex_quality=False)
        picture = experiment.output / f"denoising_{scan.name}.png"
        # In a process of its own: VTK and PyMeshLab have different versions of some libraries.
        subprocess.run(["/usr/bin/python3", TOP / "tests" / "experiments" / "render.py", "--colours",
                        "--flat", "--height", "360", "--view", *forward.split(), "--up", *up.split(),
                        "--output", picture, *paths, "--labels", *shown.values()], check=True)
        experiment.say(f"\n![{scan.name}]({picture.name})")


def main():
    experiment = Experiment("denoising", __doc__)
    quick, named = experiment.options.quick, experiment.options.scans
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        parts = experiment.options.build / "cgal-meshes"
        paths = [*([] if named or quick else [*(parts / name for name in PARTS), cube(folder)]),
                 *experiment.scans(SCANS, CGAL)]
        surfaces = [(Scan(path), NOISES) for path in paths]
        surfaces += [(Scan(path, uneven=True), ["0.2"]) for path in paths if UNEVEN in path.name]
        for scan, noises in surfaces:
            for noise in ["0", "0.2"] if quick else noises:
                row = rows[scan.name, noise] = measure(experiment, scan, noise)
                if scan.name in DRAWN and noise == "0.2":
                    draw(experiment, scan, row)
                for result in row.values():
                    del result["vertices"]
    report(experiment, rows)
    check(experiment, rows)
    experiment.finish()


def report(experiment, rows):
    experiment.record([{"mesh": mesh, "noise": noise, "smoother": name, **result}
                       for (mesh, noise), row in rows.items() for name, result in row.items()])
    names = ["noisy", *OURS, OUR_BEST, *STOCK, "bilateral"]
    experiment.say("\nRMS distance in edges, and mean angle in degrees:\n")
    experiment.table(["mesh", "noise", *names],
                     [[*key, *(f"{row[name]['RMS']:.3f}, {row[name]['angle']:.3g}"
                               if name in row else "" for name in names)]
                      for key, row in rows.items()])
    experiment.say("Processor seconds:\n")
    experiment.table(["mesh", "noise", *names[1:]],
                     [[*key, *(row[name]["seconds"] for name in names[1:])]
                      for key, row in rows.items() if OUR_BEST in row])


def check(experiment, rows):
    noisy_rows = {key: row for key, row in rows.items() if OUR_BEST in row}
    clean = {mesh: row for (mesh, noise), row in rows.items() if noise == "0"}

    def worst(what, ratio, at_most, of=noisy_rows):
        ratios = {", ".join(key): ratio(row) for key, row in of.items()}
        where = max(ratios, key=ratios.get)
        behind = sum(value > at_most for value in ratios.values())
        experiment.say(f"- {what}: geometric mean {geometric_mean(ratios.values()):.3g}, "
                       f"{behind} of {len(ratios)} rows above {at_most:g}, worst is {where}")
        experiment.check(what, ratios[where], at_most=at_most)

    experiment.check("clean meshes, RMS, with default parameters",
                     max(row["default"]["RMS"] for row in clean.values()), at_most=0.06)
    experiment.check("clean meshes, RMS, with edges kept",
                     max(row["edges"]["RMS"] for row in clean.values()), at_most=0.03)
    worst("RMS with default parameters over that of the noise",
          lambda row: row["default"]["RMS"] / row["noisy"]["RMS"], 1)
    for figure in ("RMS", "angle"):
        worst(f"{figure} of the one setting that keeps edges over Taubin's best",
              lambda row, figure=figure: row["edges"][figure] / row["Taubin"][figure], 1)
        worst(f"{figure} of our best over the best of MeshLab's",
              lambda row, figure=figure: (row[OUR_BEST][figure]
                                          / min(row[name][figure] for name in STOCK)), 1)
        worst(f"{figure} of our best over bilateral's best",
              lambda row, figure=figure: (row[OUR_BEST][figure]
                                          / row["bilateral"][figure]), 1.1)


if __name__ == "__main__":
    main()
