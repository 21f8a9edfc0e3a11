#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Remove Noise moves that should stay: rims, tiles, rasters, textures, cracks and small parts.

measures.py defines the measures; lengths are in mean edges of the clean surface. The cases:

- flat open sheets of 61 x 61 vertices with noise of 0.05 and 0.02 edges in z, or of 0.2 edges in each coordinate; a flat
  irregular disc with noise of 0.05 edges in z;
- a range map, with noise of 0.1 edges along z, and bumps with an irregular mesh, with noise of 0.1 edges along the normals.
  A texture drifts by the sideways movement;
- terrain in cells of 10 m whose heights are rounded to whole metres, and two tiles of one noisy terrain, smoothed one by
  one. The gap is that between their common vertices;
- a torus cut open along a circle, one side of which differs by 1e-19 instead of 0 or by one rounding (a crack), or by a
  thousandth of an edge (a slit). The gap is that across the cut;
- small clean parts;
- a cube, and hand_8k of --meshes, with noise of 0.2 edges in each coordinate;
- a cap of a sphere whose rim is displaced within the sphere, across the rim, by 0.3 edges;
- with --findings, files that misbehaved. The input itself stands for their clean surface.

Beside the program with its defaults, and with the options of each --also, are MeshLab's two-step and Taubin smoothers and
VTK's windowed sinc filter, with their defaults and with the settings of least RMS, which only somebody can choose who has
the clean surface. A program that refuses an input leaves it as it is. The table has the program's results, the CSV file also
those of the other smoothers.

Needs PyMeshLab, PyVista and SciPy: README.md says how to install them.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy
import shapes
from experiment import Experiment
from ply import read_mesh, write_ply
from scan import Scan
from smoothers import STEPS, best, result, taubin_families, two_step_families
from surface import SEED, Surface
from windowed_sinc import VTK_VERSION, sinc_families

REFUSED = 1  # exit code
CELL = 10.0  # metres, of the terrain

# The largest permitted magnitude of measures.
FLAT = {"area": 0.1, "rim max": 0.05}
TILES = {"gap max": 0.05}
CRACK = {"gap max": 1e-3}
UNCHANGED = {"moved": 1e-3}
TERRAIN_CELLS = 0.06  # sideways
FOUND = {"real/crack_one_ulp.stl.xz": CRACK, "real/terraces.ply.xz": {}, "files/noise_octagonal_pocket.ply": CRACK,
         "files/noise_block_obb.stl": UNCHANGED, "files/noise_2triangles.off": UNCHANGED}
COINCIDENT = 1e-4  # edges

# Columns of the table.
COLUMNS = ["RMS", "angle", "sideways max", "moved", "rim max", "gap max", "area", "volume", "newly turned", "folded"]


class Case:
    """An input and its clean surface, in pieces that are smoothed one by one.

    `pairs` are vertices that coincide on the clean surface, numbered through all pieces. `targets` are the largest
    permitted magnitudes of measures."""

    def __init__(self, name, *pieces, pairs=None, targets=None):
        self.name, self.pieces, self.pairs = name, pieces, pairs
        self.targets = {**(targets or {}), "newly turned": 0}
        self.noisy = numpy.concatenate([noisy for _, noisy in pieces])
        begins = numpy.cumsum([0, *(len(noisy) for _, noisy in pieces)])
        self.surface = Surface(name, numpy.concatenate([surface.vertices for surface, _ in pieces]),
                               numpy.concatenate([surface.faces + begin for (surface, _), begin in zip(pieces, begins)]))

    def result(self, vertices, seconds):
        return result(self.surface, self.noisy, vertices, seconds, self.pairs)


def random():
    return numpy.random.default_rng(SEED)


def along_z(surface, noise):
    heights = random().normal(0, noise * surface.edge, len(surface.vertices))
    return surface.vertices + numpy.stack([0 * heights, 0 * heights, heights], 1)


def isotropic(surface, noise):
    return surface.vertices + random().normal(0, noise * surface.edge, surface.vertices.shape)


def bumps(x, y):
    return 6 * numpy.sin(x / 8) * numpy.cos(y / 11) + 12 * numpy.exp(-((x - 50) ** 2 + (y - 40) ** 2) / 300)


def hills(x, y):
    """Returns the height of terrain in metres."""
    return (60 * numpy.exp(-((x - 700) ** 2 + (y - 900) ** 2) / 4e5)
            + 25 * numpy.sin(x / 310) * numpy.cos(y / 270) + 0.01 * x)


def terrain(n, m, begin=0):
    """Returns terrain of n by m cells from the column `begin`."""
    vertices, faces = shapes.sheet(n, m)
    vertices = (vertices + (begin, 0, 0)) * CELL
    vertices[:, 2] = hills(*vertices.T[:2])
    return Surface("terrain", vertices, faces)


def cases_of_sheets():
    sheet = Surface("sheet", *shapes.sheet(60, 60))
    for noise in (0.05, 0.02):
        yield Case(f"flat sheet, {noise} in z", (sheet, along_z(sheet, noise)), targets=FLAT)
    yield Case("flat sheet, 0.2 isotropic", (sheet, isotropic(sheet, 0.2)))
    disc = Surface("disc", *shapes.disc(30, 0.15, random()))
    yield Case("flat disc, 0.05 in z", (disc, along_z(disc, 0.05)), targets=FLAT)
    range_map = Surface("range map", *shapes.sheet(100, 80, bumps))
    yield Case("range map, 0.1 in z", (range_map, along_z(range_map, 0.1)))
    vertices, faces = shapes.disc(45, 0.15, random())
    vertices[:, 2] = bumps(*vertices.T[:2])
    textured = Surface("textured bumps", vertices, faces)
    yield Case("textured bumps, 0.1", (textured, textured.noisy(0.1)))


def cases_of_terrain():
    land = terrain(140, 140)
    rounded = land.vertices.copy()
    rounded[:, 2] = numpy.round(rounded[:, 2])
    yield Case("terrain in whole metres", (land, rounded),
               targets={"sideways max": TERRAIN_CELLS * CELL / land.edge})
    n, m = 70, 70
    both = terrain(2 * n, m)
    noisy = along_z(both, 0.1).reshape(2 * n + 1, m + 1, 3)
    seam = numpy.arange(m + 1)
    yield Case("two tiles, 0.1 in z", (terrain(n, m), noisy[:n + 1].reshape(-1, 3)),
               (terrain(n, m, n), noisy[n:].reshape(-1, 3)), targets=TILES,
               pairs=numpy.stack([n * (m + 1) + seam, (n + 1) * (m + 1) + seam], 1))


def cases_of_cracks():
    vertices, faces, normals, pairs = shapes.torus_with_seam(80, 32)
    torus = Surface("torus", vertices, faces)
    heights = random().normal(0, 0.1 * torus.edge, len(vertices))
    heights[pairs[:, 1]] = heights[pairs[:, 0]]
    noisy = vertices + heights[:, None] * normals

    def cut(points, other_side):
        points = points.copy()
        points[pairs[:, 1]] = other_side(points[pairs[:, 1]])
        return torus, points

    yield Case("torus, crack of 1e-19", cut(vertices, lambda side: side + (0, 0, 1e-19)), pairs=pairs, targets=CRACK)
    for name, points in (("torus", vertices), ("torus, 0.1", noisy)):
        yield Case(f"{name}, crack of a rounding", cut(points, lambda side: numpy.nextafter(side, numpy.inf)), pairs=pairs,
                   targets=CRACK)
    yield Case("torus, 0.1, slit of 1e-3", cut(noisy, lambda side: side + (0, 0, 1e-3 * torus.edge)), pairs=pairs)


def cases_of_small_parts():
    vertices, faces = shapes.cube(1)
    parts = {"block of 12 faces": (vertices * (3, 2, 1), faces), "oblique block of 12 faces": shapes.oblique_block(),
             "cube of 24 faces": shapes.cube_with_middles(), "cube of 48 faces": shapes.cube(2),
             "notched cube of 48 faces": shapes.notched_cube(), "hexagonal prism": shapes.prism(6),
             "open cube": (vertices, faces[:-2])}
    for name, part in parts.items():
        yield Case(name, (Surface(name, *part), part[0]), targets=UNCHANGED)


def cases_of_closed_meshes(folder):
    closed = [Surface("cube", *shapes.cube(40))]
    if folder:
        closed.append(Scan(folder / "hand_8k.ply"))
    for surface in closed:
        yield Case(f"{surface.name}, 0.2 isotropic", (surface, isotropic(surface, 0.2)))


def case_of_ragged_rim():
    rings, angle = 30, numpy.radians(60)
    cap = Surface("cap", *shapes.cap(rings, 0.15, random(), angle))
    ragged = cap.vertices.copy()
    radius = rings / angle
    rim = slice(-6 * rings, None)
    longitude = numpy.arctan2(ragged[rim, 1], ragged[rim, 0])
    ragged[rim] = shapes.on_sphere(radius, angle + random().normal(0, 0.3 * cap.edge / radius, 6 * rings), longitude)
    return Case("cap with a ragged rim", (cap, ragged))


def coincident_pairs(surface):
    """Returns the pairs of vertices that are next to each other, or None."""
    _, cell = numpy.unique(numpy.round(surface.vertices / (COINCIDENT * surface.edge)), axis=0, return_inverse=True)
    order = numpy.argsort(cell, kind="stable")
    same = numpy.flatnonzero(numpy.diff(cell[order]) == 0)
    return numpy.stack([order[same], order[same + 1]], 1) if same.size else None


def cases_of_findings(experiment, folder):
    for name, targets in FOUND.items():
        surface = Scan(experiment.unpacked(folder / name))
        yield Case(pathlib.Path(name).name, (surface, surface.vertices), pairs=coincident_pairs(surface), targets=targets)


def cases(experiment):
    yield from cases_of_sheets()
    yield from cases_of_terrain()
    yield from cases_of_cracks()
    yield from cases_of_small_parts()
    yield from cases_of_closed_meshes(experiment.options.meshes)
    yield case_of_ragged_rim()
    if experiment.options.findings:
        yield from cases_of_findings(experiment, experiment.options.findings)


def ours(experiment, case, words):
    """Returns the program's result for a case."""
    moved = []
    with tempfile.TemporaryDirectory() as folder:
        source, target = pathlib.Path(folder) / "in.ply", pathlib.Path(folder) / "out.ply"
        for surface, noisy in case.pieces:
            write_ply(source, noisy, surface.faces)
            target.unlink(missing_ok=True)
            done = subprocess.run([experiment.program, "remove-noise", source, target, *words], check=False,
                                  capture_output=True, text=True)
            if done.returncode not in (0, REFUSED):
                sys.exit(f"leaving_in_place: {done.stderr}")
            moved.append(noisy if done.returncode == REFUSED else read_mesh(target)[0])
    return case.result(numpy.concatenate(moved), numpy.nan)


def families_of(case, families_of_piece):
    """Returns families of functions that smooth all pieces of a case."""
    def together(functions):
        def smooth():
            vertices, seconds = zip(*(function() for function in functions))
            return numpy.concatenate(vertices), sum(seconds)
        return smooth

    pieces = [families_of_piece(*piece) for piece in case.pieces]
    return [[together(functions) for functions in zip(*families)] for families in zip(*pieces)]


# Families of each other smoother, and the index of its default in the first family.
PEERS = {"two-step": (two_step_families, STEPS.index(3)), "Taubin": (taubin_families, STEPS.index(10)),
         "windowed sinc": (sinc_families, 0)}


def results_of_peers(case):
    row = {}
    for name, (families_of_piece, default) in PEERS.items():
        families = families_of(case, families_of_piece)
        row[f"{name}, default"] = case.result(*families[0][default]())
        row[f"{name}, best"], _ = best(case.surface, case.noisy, families, case.pairs)
    return row


def digits(value):
    return f"{0.0 if abs(value) < 5e-7 else value:.3g}"


def measured(experiment, case):
    """Measures a case, and records all smoothers. Returns the results of the program for each set of its options."""
    rows = {"input": case.result(case.noisy, numpy.nan)}
    names = {"ours": [], **{f"ours {also}": also.split() for also in experiment.options.also}}
    for name, words in names.items():
        rows[name] = ours(experiment, case, words)
    if not experiment.options.quick:
        rows.update(results_of_peers(case))
    experiment.record([{"case": case.name, "smoother": smoother,
                        **{name: value for name, value in row.items() if name not in ("vertices", "seconds")}}
                       for smoother, row in rows.items()])
    return {name: rows[name] for name in names}


def main():
    def add_options(parser):
        parser.add_argument("--findings", type=pathlib.Path, metavar="FOLDER", help="folder of files that misbehaved")
        parser.add_argument("--also", action="append", default=[], metavar='"OPTIONS"',
                            help='measure the program with these options, too: --also="--boundary locked"')

    experiment = Experiment("leaving_in_place", __doc__, add_options)
    experiment.say(f"The windowed sinc is that of VTK {VTK_VERSION}.\n")
    results = [(case, measured(experiment, case)) for case in cases(experiment)]
    experiment.table(["", "", *COLUMNS],
                     [[case.name, name, *(digits(row[measure]) if measure in row else "" for measure in COLUMNS)]
                      for case, rows in results for name, row in rows.items()])
    for case, rows in results:
        for measure, largest in case.targets.items():
            name = max(rows, key=lambda name: abs(rows[name][measure]))
            experiment.check(f"{case.name}: {measure}, most with {name}", abs(rows[name][measure]), at_most=largest)
    experiment.finish()


if __name__ == "__main__":
    main()
