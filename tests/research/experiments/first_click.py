#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether Remove Noise acts where it must, and nowhere else.

The program runs with its defaults on meshes that are clean, and on the same meshes with noise along their normals. A clean
mesh that moves is a false alarm, and a noisy one that does not is a miss. The meshes:

- scans and parts: CGAL's demos, and those of --meshes. `noisy` and `doubtful` lists those that are not clean: they were
  looked at, or their authors say so. Meshes of fewer than 400 vertices are too small to measure noise;
- generated ones: parts, and reliefs of cloth, bricks, hair and letters, with other wavelengths and heights each;
- --parts FOLDER: all STL files of a folder, which are clean.

Noise: white; shared by neighbours, so many edges wide (the standard deviation of a Gaussian that averages white noise);
on a tenth of the mesh, on one side of a random plane; spikes of 2 to 5 edges on a hundredth of the vertices. Its height is
in mean edges. Parts are those of these meshes of which more than PART of the inner edges are flat; the others count as scans.

Moved: by more than a thousandth of an edge, RMS. The ratios compare the RMS distance to the clean surface along its normals,
and the mean angle of faces to it, with those of the noisy mesh: geometric means over all cases, also those that were missed.

Real scans that are not clean have no clean surface to compare with. There, the median turn between neighbouring faces is
measured, beside MeshLab's Taubin smoother at its defaults; and the same on clean scans, to see what *Lumps, too* costs.

Needs PyMeshLab and SciPy: README.md says how to install them.
"""

import concurrent.futures
import itertools
import pathlib
import zlib

import numpy
import scipy.sparse
import shapes
from experiment import CGAL_MESHES, Experiment
from measures import angles, distance, pair_cosines, topology_of
from scan import Scan
from smoothers import applied
from surface import Surface

LEAST_VERTICES, MOST_VERTICES = 400, 60000
MOVED = 1e-3  # edges
# Published as noisy, or anyone sees it.
NOISY = {"angel_scan", "bunny0.2_noisy", "nicolo0.2_noisy", "fandisk0.3_noisy", "fandisk0.7_noisy", "block0.4_noisy",
         "nasty_noisy_colour_sphere", "mesh_with_border", "fandisk0.6_noisy", "nicolo_impulsive_noisy", "iron",
         "rabbit"}
# Simplified or extracted scans whose roughness may be either, and meshes that are broken on purpose.
DOUBTFUL = {"b9_mesh", "femur", "bones", "boot_genus12", "armadillo_50k", "armadillo", "ellipe0.003", "nasty_far_offset",
            "nasty_soup", "nasty_nonmanifold"}
WHITE = [0.05, 0.1, 0.2, 0.3, 0.5]
SHARED = [(0.1, 0.6), (0.2, 0.6), (0.2, 0.8), (0.3, 0.8), (0.3, 1.2)]
IN_PLACES = [0.1, 0.3]
SPIKES = 0.01
PART = 0.05  # of the inner edges
# Scans, for the table of turns.
ROUGH = ["angel_scan", "iron", "rabbit", "b9_mesh", "femur", "bones", "armadillo_50k", "boot_genus12", "mesh_with_border"]
SMOOTH = ["nefertiti_50k", "laurana50k", "stanford_bunny", "skull_50k", "demosthenes_8k", "hand_8k", "fandisk"]


def averages(surface):
    """Returns the matrix that replaces a value by the mean of a vertex's neighbours."""
    count = len(surface.vertices)
    begin, end = surface.faces.ravel(), numpy.roll(surface.faces, -1, axis=1).ravel()
    sides = scipy.sparse.coo_matrix((numpy.ones(2 * len(begin)), (numpy.r_[begin, end], numpy.r_[end, begin])),
                                    shape=(count, count)).tocsr()
    sides.data[:] = 1
    degrees = numpy.maximum(numpy.asarray(sides.sum(axis=1)).ravel(), 1)
    return scipy.sparse.diags(1 / degrees) @ sides


def shared(surface, width, random):
    """Returns noise with a standard deviation of 1 that neighbours share. `width` is in edges."""
    noise, average = random.normal(size=len(surface.vertices)), averages(surface)
    steps = int(numpy.ceil(4 * width ** 2))
    for _ in range(steps):
        noise += 2 * width ** 2 / steps * (average @ noise - noise)
    return noise / noise.std()


def in_one_place(surface, random):
    """Returns which vertices are in the tenth of them that is farthest in a random direction."""
    along = surface.vertices @ random.normal(size=3)
    return along >= numpy.quantile(along, 0.9)


def spikes(surface, random):
    """Returns heights in edges: 2 to 5 outwards or inwards on a few vertices."""
    chosen = random.random(len(surface.vertices)) < SPIKES
    return chosen * random.uniform(2, 5, len(chosen)) * random.choice((-1, 1), len(chosen))


def noises(surface, seed):
    """Yields the kind of noise, its height and width, and the heights in edges."""
    random = numpy.random.default_rng([seed, zlib.crc32(surface.name.encode())])
    count = len(surface.vertices)
    for height in WHITE:
        yield "white", height, 0, height * random.normal(size=count)
    for height, width in SHARED:
        yield "shared", height, width, height * shared(surface, width, random)
    for height in IN_PLACES:
        yield "in one place", height, 0, height * random.normal(size=count) * in_one_place(surface, random)
    yield "spikes", 3.5, 0, spikes(surface, random)


def relief(name, height, size=90):
    """Returns a curved sheet with a relief, whose heights are a function of the place."""
    vertices, faces = shapes.sheet(size, size, lambda x, y: 6 * numpy.sin(x / 31) * numpy.cos(y / 27) + height(x, y))
    return Surface(name, vertices, faces)


def generated(random):
    """Yields clean surfaces."""
    wave = lambda x, length: numpy.sin(2 * numpy.pi * x / length)  # noqa: E731
    for length, height in itertools.product((4, 5.3, 8, 12), (0.1, 0.3, 0.6)):
        turn, phase = random.uniform(0, 3), random.uniform(0, 6)
        # Where patterns begin, so that vertices are at other places of it.
        a, b = random.uniform(0, length, 2)
        along = lambda x, y, t=turn: x * numpy.cos(t) + y * numpy.sin(t)  # noqa: E731
        patch = lambda x, y: (x > 30) & (x < 75) & (y > 20) & (y < 70)  # noqa: E731
        yield relief(f"cords {length}, {height}", lambda x, y: height * wave(along(x, y) + phase, length))
        yield relief(f"weave {length}, {height}", lambda x, y: height * wave(x + a, length) * wave(y + b, length))
        yield relief(f"weave in a patch {length}, {height}",
                     lambda x, y: patch(x, y) * height * wave(x + a, length) * wave(y + b, length))
        yield relief(f"bricks {length}, {height}",
                     lambda x, y: -height * (((x + a) % (2 * length) < 1.5) | ((y + b) % length < 1.5)))
        if length > 4:  # else each is a single vertex
            yield relief(f"pits {length}, {height}",
                         lambda x, y: -height * (numpy.hypot((x + a) % length - length / 2, (y + b) % length - length / 2)
                                                 < length / 4))
        letters = random.random((20, 20)) < 0.4
        yield relief(f"letters {length}, {height}",
                     lambda x, y: height * letters[(x / length).astype(int) % 20, (y / length).astype(int) % 20])
        hairs = [(random.uniform(0, 90, 2), random.uniform(0, 3)) for _ in range(150)]

        def hair(x, y, hairs=hairs, length=length, height=height):
            total = 0 * x
            for (a, b), turn in hairs:
                u = (x - a) * numpy.cos(turn) + (y - b) * numpy.sin(turn)
                v = (y - b) * numpy.cos(turn) - (x - a) * numpy.sin(turn)
                total = numpy.maximum(total, height * numpy.exp(-(v / 1.2) ** 2) * (abs(u) < 2 * length))
            return total
        yield relief(f"hair {length}, {height}", hair)
    for number in range(60):
        sides, turns = int(random.integers(5, 80)), random.uniform(0, 1, 3)
        outline = 10 + turns[0] * 6 * numpy.cos(2 * numpy.pi * numpy.arange(sides) * 3 / sides)
        levels = int(random.integers(3, 30))
        yield Surface(f"part {number}", *lathe(outline, numpy.cumsum(random.uniform(0.2, 4, levels)),
                                               1 + 0.3 * turns[1] * random.random(levels)))


def lathe(outline, levels, scales):
    """Returns a part whose outline is scaled at each level, with caps."""
    sides = len(outline)
    turn = 2 * numpy.pi * numpy.arange(sides) / sides
    ring = numpy.stack([outline * numpy.cos(turn), outline * numpy.sin(turn)], 1)
    rows = [numpy.c_[scale * ring, numpy.full(sides, level)] for level, scale in zip(levels, scales)]
    ends = [[0, 0, levels[0]], [0, 0, levels[-1]]]
    a = numpy.arange(sides)
    b, top, last = (a + 1) % sides, (len(levels) - 1) * sides, len(levels) * sides
    faces = [numpy.stack([b, a, numpy.full(sides, last)], 1), numpy.stack([top + a, top + b, numpy.full(sides, last + 1)], 1)]
    for row in range(len(levels) - 1):
        low, high = row * sides, (row + 1) * sides
        faces += [numpy.stack([low + a, low + b, high + b], 1), numpy.stack([low + a, high + b, high + a], 1)]
    return numpy.concatenate([*rows, ends]), numpy.concatenate(faces)


def label_of(name):
    return "noisy" if name in NOISY else "doubtful" if name in DOUBTFUL else "clean"


class FirstClick:
    """The runs of the program."""

    def __init__(self, experiment):
        self.experiment = experiment
        self.rows = []

    def result(self, surface, vertices, **facts):
        moved, report, seconds = self.experiment.smoothed(vertices, surface.faces, *self.experiment.options.also,
                                                          command="remove-noise")
        rms = report["rms_displacement"] / surface.edge
        row = {"mesh": surface.name, "vertices": len(vertices), **facts, "moved": rms, "stop": report["stop"],
               **{key: report.get(key) for key in ("kind", "flat_edges", "evenness", "kept_parts", "turned_triangles",
                                                   "lost_area", "lost_volume", "outliers")},
               "noise size": report["noise_size"] / surface.edge, "seconds": seconds}
        if facts["noise"] != "none":
            row.update({"RMS before": distance(surface, vertices), "RMS after": distance(surface, moved),
                        "angle before": float(angles(surface, vertices).mean()),
                        "angle after": float(angles(surface, moved).mean())})
        return row

    def run(self, jobs):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for row in pool.map(lambda job: self.result(*job[0], **job[1]), jobs):
                self.rows.append(row)
        self.experiment.record([{key: float(f"{value:.3g}") if isinstance(value, float) else value
                                 for key, value in row.items() if key != "seed" or self.experiment.options.seeds > 1}
                                for row in self.rows])


def scans(experiment, most_vertices=MOST_VERTICES):
    folders = [CGAL_MESHES, *([experiment.options.meshes] if experiment.options.meshes else [])]
    names = {}
    for path in sorted(path for folder in folders for path in folder.rglob("*")):
        if path.suffix.lower() in (".off", ".ply", ".obj", ".stl") and "gcn" not in path.name:
            names.setdefault(path.stem, path)
    for path in names.values():
        surface = Scan(path)
        if LEAST_VERTICES <= len(surface.vertices) <= most_vertices:
            yield surface


def jobs(experiment):
    """Yields surface and vertices, and what is known of them."""
    seeds = range(1, 1 + experiment.options.seeds)
    for surface in scans(experiment):
        label = label_of(surface.name)
        yield (surface, surface.vertices), {"set": "scans and parts", "label": label, "noise": "none", "height": 0, "width": 0}
        if label == "clean" and not experiment.options.clean:
            for seed in seeds:
                for kind, height, width, heights in noises(surface, seed):
                    vertices = surface.vertices + surface.edge * heights[:, None] * surface.normals
                    yield (surface, vertices), {"set": "scans and parts", "label": "noisy", "noise": kind, "height": height,
                                                "width": width, "seed": seed}
    for seed in seeds:
        for surface in generated(numpy.random.default_rng(seed)):
            yield (surface, surface.vertices), {"set": "generated", "label": "clean", "noise": "none", "height": 0, "width": 0}
    for folder in experiment.options.parts:
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() == ".stl":
                surface = Scan(path)
                yield (surface, surface.vertices), {"set": "parts", "label": "clean", "noise": "none", "height": 0, "width": 0}


def share(rows, condition):
    return sum(map(condition, rows)) / len(rows) if rows else float("nan")


def is_moved(row):
    return row["moved"] > MOVED


def mean_ratio(rows, name):
    return float(numpy.exp(numpy.mean([numpy.log(max(row[f"{name} after"], 1e-9) / max(row[f"{name} before"], 1e-9))
                                       for row in rows])))


def tell_of_clean(experiment, rows):
    experiment.say("## Clean meshes\n\nFalse alarms must be at most 1 in 500.\n")
    groups = {(row["set"], row["label"]): None for row in rows if row["noise"] == "none"}
    table = []
    for key in groups:
        chosen = [row for row in rows if (row["set"], row["label"]) == key and row["noise"] == "none"]
        table.append([*key, len(chosen), sum(map(is_moved, chosen)),
                      sum(row["kept_parts"] > 0 for row in chosen),
                      float(numpy.mean([row["seconds"] for row in chosen]))])
    experiment.table(["set", "label", "meshes", "moved", "taken back", "mean seconds"], table)
    alarms = [row for row in rows if row["label"] == "clean" and row["noise"] == "none" and is_moved(row)]
    clean = [row for row in rows if row["label"] == "clean" and row["noise"] == "none"]
    if alarms:
        experiment.table(["false alarm", "kind", "moved, edges", "flat edges", "evenness"],
                         [[row["mesh"], row["kind"], row["moved"], row["flat_edges"], row["evenness"]] for row in alarms])
    experiment.check("false alarms on clean meshes", len(alarms) / len(clean), at_most=1 / 500)


def tell_of_noisy(experiment, rows):
    experiment.say("## Noise\n\nFound: the mesh moves, with the kind that the report names most often.\n")
    table = []
    parts = {row["mesh"] for row in rows if row["noise"] == "none" and (row["flat_edges"] or 0) > PART}

    def group_of(row):
        return "parts" if row["mesh"] in parts else "scans", row["noise"], row["height"], row["width"]

    noisy = sorted((row for row in rows if row["noise"] != "none"), key=lambda row: row["mesh"] in parts)
    for key in {group_of(row): None for row in noisy}:
        chosen = [row for row in noisy if group_of(row) == key]
        kinds = [row["kind"] for row in chosen if is_moved(row)]
        worse = sum(row["RMS after"] > 1.02 * row["RMS before"] for row in chosen)
        table.append([*key, len(chosen), share(chosen, is_moved), max(set(kinds), key=kinds.count) if kinds else "",
                      mean_ratio(chosen, "RMS"), mean_ratio(chosen, "angle"), worse])
    experiment.table(["", "noise", "height", "width", "cases", "found", "kind", "RMS", "angle", "farther than before"], table)


def median_turn(surface, vertices):
    """Returns the median angle between neighbouring faces, in degrees."""
    cosines = pair_cosines(surface.faces, vertices, topology_of(surface).pairs_of_faces)
    return float(numpy.degrees(numpy.arccos(numpy.clip(numpy.median(cosines), -1, 1))))


def tell_of_turns(experiment):
    experiment.say("## Lumps, too\n\nMedian turn between neighbouring faces in degrees, and the RMS movement in edges.\n")
    table = []
    for surface in scans(experiment, most_vertices=200000):
        if surface.name not in ROUGH + SMOOTH:
            continue
        before, row = surface.vertices, [surface.name, "rough" if surface.name in ROUGH else "clean"]
        row.append(median_turn(surface, before))
        results = [applied(surface, before, "apply_coord_taubin_smoothing")[0]]
        results += [experiment.smoothed(before, surface.faces, *words, command="remove-noise")[0] for words in ((), ("--lumps",))]
        for vertices in results:
            moved = numpy.sqrt(((vertices - before) ** 2).sum(axis=1).mean()) / surface.edge
            row += [median_turn(surface, vertices), float(moved)]
        table.append(row)
    experiment.table(["scan", "", "before", "Taubin", "moved", "default", "moved", "lumps", "moved"], table)


def main():
    def add_options(parser):
        parser.add_argument("--parts", type=pathlib.Path, action="append", default=[], metavar="FOLDER",
                            help="folder of clean STL files; may be repeated")
        parser.add_argument("--seeds", type=int, default=1, metavar="NUMBER", help="of noise and generated meshes")
        parser.add_argument("--also", nargs="+", default=[], metavar="OPTION", help="options of the program")
        parser.add_argument("--clean", action="store_true", help="without noise")

    experiment = Experiment("first_click", __doc__, add_options)
    clicks = FirstClick(experiment)
    clicks.run(jobs(experiment))
    tell_of_clean(experiment, clicks.rows)
    tell_of_noisy(experiment, clicks.rows)
    tell_of_turns(experiment)
    experiment.finish()


if __name__ == "__main__":
    main()
