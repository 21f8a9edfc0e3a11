#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remove Noise with its default parameters, beside other smoothers at their best.

Lists: meshes on which the filter's constants were chosen, other parts (CAD models), other scans, and public pairs of
noisy and original meshes, one for each folder of --pairs. A folder may also have NAME_gcn.ply: results of GCN-Denoiser,
a network that was trained for this, by its authors. Noise is normally distributed; its standard deviation is in mean
edge lengths of the clean mesh. It moves the vertices along their normals, in each coordinate ("isotropic"), or every
fifth vertex along its normal ("impulsive"). Each entry is the RMS displacement from the clean vertices along the clean
normals, in mean edge lengths, and the mean angle between normals of faces and those of the clean mesh, in degrees.
MeshLab's Taubin and two-step smoothers and a bilateral filter of normals have the best of many settings, for the
distance and for the angle each, which only somebody can choose who has the clean mesh; the last two are measured with
noise of 0.2 edges and on the pairs. Guided normal filtering is quoted: its authors' code, measured in November 2026.
Our seconds include reading and writing files, the others' do not. A second table has what the first cannot see, for our
results: measures.py defines its columns. Each entry is the worst over all noise of a mesh.

Needs PyMeshLab and SciPy: README.md says how to install them.
"""

import csv
import itertools
import pathlib
import subprocess
import tempfile
from statistics import geometric_mean

import numpy
from experiment import CGAL_MESHES, RENDER, Experiment
from measures import angles
from ply import read_mesh
from scan import Scan, loaded, pymeshlab
from shapes import cube
from smoothers import STEPS, best, bilateral_families, result, taubin_families, two_step_families
from surface import SEED, Surface

CHOSEN_ON = ["fandisk.off", "hand_8k.ply", "nefertiti_50k.ply", "armadillo_50k.ply"]  # and a cube
PARTS = ["anchor_dense.off", "mech-holes-shark.off", "holes.off"]
SCANS = ["camel.off", "lion-head.off", "bear.off", "dino.off", "skull_50k.ply", "boot_genus12.ply", "shepherdboy.ply",
         "mannequin_11k.ply", "demosthenes_8k.ply", "elephant_5cc.ply", "laurana50k.ply", "stanford_bunny.ply"]
NAMES = ["list", "mesh", "noise", "smoother"]  # columns of the results that are no measures
CUBE = 40  # edges along each of its own
NOISES = ["0", "0.1", "0.2", "0.3", "0.2 isotropic", "0.3 impulsive"]
WITH_ALL_PEERS = ["0.2", ""]  # noise of these rows; the pairs' is theirs
OURS, TAUBIN, TAUBIN_DEFAULT, TWO_STEP, BILATERAL = "ours", "Taubin", "Taubin, default", "two-step", "bilateral"
GUIDED, GUIDED_DEFAULT, NETWORK = "guided", "guided, default", "GCN-Denoiser"
PEERS = [TAUBIN, TAUBIN_DEFAULT, TWO_STEP, BILATERAL, GUIDED, GUIDED_DEFAULT, NETWORK]

# Zhang, Deng, Zhang, Bouaziz and Liu, "Guided Mesh Normal Filtering" (2015): RMS and angle of their code at its default
# and at its best.
OF_GUIDED = {"block0.4": ((0.097, 4.1), (0.084, 3.4)), "bunny0.2": ((0.116, 6.7), (0.078, 5.3)),
             "fandisk0.3": ((0.082, 2.9), (0.076, 2.5)), "fandisk0.7": ((0.192, 8.4), (0.152, 5.6)),
             "nicolo0.2": ((0.120, 7.8), (0.085, 6.4))}

OTHER_MEASURES = {"sideways RMS": "sideways RMS", "sideways max": "max", "worst": "worst vertex", "rim RMS": "rim RMS",
                  "area": "area, %", "volume": "volume, %", "turned": "turned faces", "newly turned": "newly turned",
                  "folded": "folded pairs"}

# Drawn with noise of 0.2 edges, or as a pair: the camera's direction and what is up.
DRAWN = {"fandisk": ("-0.6 -0.6 1", "0 1 0"), "anchor_dense": ("-1 -1 -1", "0 0 1"), "skull_50k": ("0 0 -1", "0 1 0"),
         "block0.4_original": ("-1 -1 -1", "0 1 0")}
LARGEST_COLOURED_ANGLE = 20  # degrees
PLASTER, RED = numpy.array([0.93, 0.89, 0.83]), numpy.array([0.75, 0.05, 0.05])


def noisy(scan, noise, seed):
    """Returns the noisy vertices; `noise` is one of NOISES."""
    deviation, *kind = noise.split()
    random = numpy.random.default_rng(seed)
    if kind == ["isotropic"]:
        return scan.vertices + random.normal(0, float(deviation) * scan.edge, scan.vertices.shape)
    vertices = scan.noisy(float(deviation), seed)
    if kind == ["impulsive"]:
        spared = random.random(len(vertices)) >= 0.2
        vertices[spared] = scan.vertices[spared]
    return vertices


def ours(experiment, scan, vertices):
    """Returns the result of the program with its default parameters."""
    clean, _, seconds = experiment.smoothed(vertices, scan.faces, command="remove-noise")
    return result(scan, vertices, clean, seconds)


def kept_peers(experiment, scan, noise):
    """Returns the results of the other smoothers in the file that --peers names. They do not depend on the program."""
    if not experiment.options.peers:
        return {}
    with open(experiment.options.peers, newline="", encoding="utf-8") as file:
        return {row["smoother"]: {key: float(row[key]) for key in row if key not in NAMES and row[key]}
                for row in csv.DictReader(file)
                if (row["mesh"], row["noise"]) == (scan.name.removesuffix("_original"), noise)
                and row["smoother"] not in ("noisy", OURS)}


def at_best(scan, vertices, families):
    """Returns the result with the least distance, with the least angle of all instead of its own."""
    found, angle = best(scan, vertices, families)
    return {**found, "angle": angle}


def measure(experiment, scan, noise, vertices):
    """Returns a result for each smoother, for a mesh with noise."""
    row = {"noisy": result(scan, vertices, vertices, 0), OURS: ours(experiment, scan, vertices)}
    if noise == "0":
        return row
    families = taubin_families(scan, vertices)
    measured = {TAUBIN: lambda: at_best(scan, vertices, families),
                TAUBIN_DEFAULT: lambda: result(scan, vertices, *families[0][STEPS.index(10)]())}
    if noise in WITH_ALL_PEERS:
        if len(numpy.unique(scan.faces)) == len(scan.vertices):  # others make the filter fail
            measured[TWO_STEP] = lambda: at_best(scan, vertices, two_step_families(scan, vertices))
        measured[BILATERAL] = lambda: at_best(scan, vertices, bilateral_families(scan, vertices))
    kept = kept_peers(experiment, scan, noise)
    if noise in WITH_ALL_PEERS and scan.name in DRAWN:
        kept.pop(TAUBIN, None)  # the picture needs the vertices
    for name, result_of in measured.items():
        row[name] = kept[name] if name in kept else result_of()
    return row


def without_vertices(row):
    return {name: {key: value for key, value in one.items() if key != "vertices"} for name, one in row.items()}


def rows_of(experiment, scan, noises):
    print(f"... {scan.name}", flush=True)
    rows = {}
    for noise in noises:
        row = measure(experiment, scan, noise, noisy(scan, noise, experiment.options.seed))
        if noise == "0.2" and scan.name in DRAWN:
            draw(experiment, scan, row)
        rows[scan.name, noise] = without_vertices(row)
    return rows


def rows_of_pairs(experiment, folder):
    rows = {}
    for original in sorted(folder.glob("*_original.ply")):
        name = original.stem.removesuffix("_original")
        vertices = loaded(folder / f"{name}_noisy.ply")
        scan = Scan(original)
        row = measure(experiment, scan, "", vertices.current_mesh().vertex_matrix())
        if scan.name in DRAWN:
            draw(experiment, scan, row)
        for (rms, angle), smoother in zip(OF_GUIDED.get(name, ()), (GUIDED_DEFAULT, GUIDED)):
            row[smoother] = {"RMS": rms, "angle": angle, "seconds": numpy.nan}
        network = folder / f"{name}_gcn.ply"
        if network.exists():
            row[NETWORK] = result(scan, vertices.current_mesh().vertex_matrix(), read_mesh(network)[0], numpy.nan)
        rows[name, ""] = without_vertices(row)
    return rows


def draw(experiment, scan, row):
    """Draws a mesh with noise, and without; red is the error of the normals."""
    shown = {"noisy": "noisy", TAUBIN: "Taubin, best", OURS: "Remove Noise"}
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
        picture = experiment.output / f"removing_noise_{scan.name}.png"
        # In a process of its own: VTK and PyMeshLab have different versions of some libraries.
        subprocess.run(["/usr/bin/python3", RENDER, "--colours",
                        "--flat", "--height", "360", "--view", *forward.split(), "--up", *up.split(),
                        "--output", picture, *paths, "--labels", *shown.values()], check=True)
        experiment.say(f"\n![{scan.name}]({picture.name})")


def report(experiment, title, rows):
    experiment.say(f"\n## {title}\n")
    experiment.record([{"list": title, "mesh": mesh, "noise": noise, "smoother": name, **one}
                       for (mesh, noise), row in rows.items() for name, one in row.items()])
    peers = [name for name in PEERS if any(name in row for row in rows.values())]
    names = ["noisy", OURS, *peers]
    experiment.table(["mesh", "noise", *names, "our seconds"],
                     [[*key, *(f"{row[name]['RMS']:.3f}, {row[name]['angle']:.3g}" if name in row else ""
                               for name in names), row[OURS]["seconds"]] for key, row in rows.items()])
    tell_of_ours(experiment, rows)
    clean = [row[OURS]["RMS"] for row in rows.values() if TAUBIN not in row]
    if clean:
        experiment.check(f"{title}: clean meshes, RMS", max(clean), at_most=0.03)
    for peer, figure in itertools.product(peers, ("RMS", "angle")):
        compare(experiment, title, rows, peer, figure)


def tell_of_ours(experiment, rows):
    """Prints a table of our other measures, the worst over all noise of a mesh."""
    def worst(mesh, measure):
        values = [row[OURS][measure] for (name, _), row in rows.items() if name == mesh and measure in row[OURS]]
        return max(values, key=abs, default="")

    experiment.table(["ours", *OTHER_MEASURES.values()],
                     [[mesh, *(worst(mesh, measure) for measure in OTHER_MEASURES)]
                      for mesh in dict.fromkeys(mesh for mesh, _ in rows)])


def compare(experiment, title, rows, peer, figure):
    """Says the ratios of our figure to a peer's."""
    ratios = {", ".join(key).strip(", "): row[OURS][figure] / row[peer][figure]
              for key, row in rows.items() if peer in row}
    worst = max(ratios, key=ratios.get)
    behind = sum(ratio > 1 for ratio in ratios.values())
    what = f"{title}: {figure} over {peer}"
    experiment.say(f"- {what}: {behind} of {len(ratios)} rows behind, the worst is {worst} with {ratios[worst]:.3g}")
    mean = geometric_mean(ratios.values())
    if peer == NETWORK:  # it was trained on such meshes; a filter without training need not reach it
        experiment.say(f"- {what}, geometric mean: {mean:.3g}")
    else:
        experiment.check(f"{what}, geometric mean", mean, at_most=1)


def main():
    def add_options(parser):
        parser.add_argument("--pairs", type=pathlib.Path, metavar="FOLDER", nargs="+",
                            help="pairs NAME_noisy.ply and NAME_original.ply")
        parser.add_argument("--peers", type=pathlib.Path, metavar="FILE",
                            help="results of an earlier run, of which the other smoothers' are taken")
        parser.add_argument("--seed", type=int, default=SEED, metavar="NUMBER", help="of the noise")

    experiment = Experiment("removing_noise", __doc__, add_options)
    options = experiment.options
    if options.peers:
        experiment.say("The other smoothers' results are those of an earlier run: they do not depend on the program.")
    folders = [CGAL_MESHES, *([options.meshes] if options.meshes else [])]

    def scans(names):
        found = [folder / name for name in names for folder in folders if (folder / name).exists()]
        return [Scan(path) for path in (found[:1] if options.quick else found)]

    noises = ["0", "0.2"] if options.quick else NOISES
    chosen = scans(CHOSEN_ON) + ([] if options.quick else [Surface("cube", *cube(CUBE))])
    for title, surfaces in (("Meshes on which constants were chosen", chosen), ("Other parts", scans(PARTS)),
                            ("Other scans", scans(SCANS))):
        rows = {}
        for scan in surfaces:
            rows.update(rows_of(experiment, scan, noises))
        report(experiment, title, rows)
    for folder in options.pairs or []:
        title = "Public pairs, with a network's results" if any(folder.glob("*_gcn.ply")) else "Public pairs"
        report(experiment, title, rows_of_pairs(experiment, folder))
    experiment.finish()


if __name__ == "__main__":
    main()
