#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the filter Remove Noise with its default parameters, beside MeshLab's Taubin smoother at its best.

Three tables: meshes on which the filter's constants were chosen, other meshes, and public pairs of noisy and original
meshes (--pairs). Noise is that of denoising.py. Each entry is the RMS displacement from the clean vertices along
the clean normals, in mean edge lengths, and the mean angle between normals of faces and those of the clean mesh, in
degrees. Taubin's is the best of 22 settings, for the distance and for the angle each, which only somebody can choose
who has the clean mesh. Our seconds include reading and writing files, Taubin's do not.

Needs PyMeshLab: external/pymeshlab.sh build/pymeshlab, then build/pymeshlab/bin/python removing_noise.py.
"""

import pathlib
import tempfile

from denoising import best, cube, mean_angle, noisy, rough_error, stock_families
from experiment import Experiment, geometric_mean
from scan import Scan, loaded

CHOSEN_ON = ["fandisk.off", "hand_8k.ply", "nefertiti_50k.ply", "armadillo_50k.ply"]  # and a cube
OTHERS = ["anchor_dense.off", "mech-holes-shark.off", "holes.off", "camel.off", "lion-head.off", "bear.off", "dino.off",
          "skull_50k.ply", "boot_genus12.ply", "shepherdboy.ply", "mannequin_11k.ply", "demosthenes_8k.ply",
          "elephant_5cc.ply", "laurana50k.ply", "stanford_bunny.ply"]
NOISES = ["0", "0.1", "0.2", "0.3", "0.2 isotropic", "0.3 impulsive"]
SMOOTHERS = ["ours", "Taubin", "Taubin, default"]


def result(scan, vertices, seconds):
    return {"RMS": rough_error(scan, vertices), "angle": mean_angle(scan, vertices), "seconds": seconds}


def ours(experiment, scan, vertices):
    """Returns the result of the program with its default parameters."""
    with tempfile.TemporaryDirectory() as folder:
        source, target = pathlib.Path(folder) / "in.ply", pathlib.Path(folder) / "out.ply"
        scan.mesh_set(vertices).save_current_mesh(str(source), save_vertex_quality=False)
        _, seconds = experiment.smooth(source, target, command="remove-noise")
        clean = loaded(target)
        return result(scan, clean.current_mesh().vertex_matrix(), seconds)


def measure(experiment, scan, vertices):
    """Returns a result for each smoother, for a mesh with noise."""
    row = {"noisy": result(scan, vertices, 0), "ours": ours(experiment, scan, vertices)}
    if row["noisy"]["RMS"] < 1e-3:  # the clean mesh
        return row
    families = stock_families(scan, vertices)["Taubin"]
    found = best(scan, families)
    row["Taubin"] = {**found, "RMS": rough_error(scan, found["vertices"])}
    [default] = [smooth for words, smooth in families[0] if words.startswith("10 steps")]
    row["Taubin, default"] = result(scan, *default())
    return row


def rows_of(experiment, scan, noises):
    print(f"... {scan.name}", flush=True)
    return {(scan.name, noise): measure(experiment, scan, noisy(scan, noise)) for noise in noises}


def rows_of_pairs(experiment, folder):
    rows = {}
    for original in sorted(folder.glob("*_original.ply")):
        name = original.stem.removesuffix("_original")
        vertices = loaded(folder / f"{name}_noisy.ply")
        rows[name, ""] = measure(experiment, Scan(original), vertices.current_mesh().vertex_matrix())
    return rows


def report(experiment, title, rows):
    experiment.say(f"\n## {title}\n")
    experiment.record([{"list": title, "mesh": mesh, "noise": noise, "smoother": name, "RMS": one["RMS"],
                        "angle": one["angle"], "seconds": one["seconds"]}
                       for (mesh, noise), row in rows.items() for name, one in row.items()])
    names = ["noisy", *SMOOTHERS]
    experiment.table(["mesh", "noise", *names, "our seconds"],
                     [[*key, *(f"{row[name]['RMS']:.3f}, {row[name]['angle']:.3g}" if name in row else ""
                               for name in names), row["ours"]["seconds"]] for key, row in rows.items()])
    clean = [row["ours"]["RMS"] for row in rows.values() if "Taubin" not in row]
    if clean:
        experiment.check(f"{title}: clean meshes, RMS", max(clean), at_most=0.03)
    for figure, target in (("RMS", 0.8), ("angle", 0.7)):
        ratios = {", ".join(key).strip(", "): row["ours"][figure] / row["Taubin"][figure]
                  for key, row in rows.items() if "Taubin" in row}
        worst = max(ratios, key=ratios.get)
        behind = sum(ratio > 1 for ratio in ratios.values())
        experiment.say(f"- {figure} over Taubin's best: {behind} of {len(ratios)} rows behind, the worst is {worst} with "
                       f"{ratios[worst]:.3g}")
        experiment.check(f"{title}: {figure} over Taubin's best, geometric mean",
                         geometric_mean(ratios.values()), at_most=target)


def main():
    experiment = Experiment("removing_noise", __doc__, lambda parser: parser.add_argument(
        "--pairs", type=pathlib.Path, metavar="FOLDER", help="pairs NAME_noisy.ply and NAME_original.ply"))
    options = experiment.options
    folders = [options.build / "cgal-meshes", *([options.meshes] if options.meshes else [])]

    def scans(names):
        found = [folder / name for name in names for folder in folders if (folder / name).exists()]
        return [Scan(path) for path in (found[:1] if options.quick else found)]

    noises = ["0", "0.2"] if options.quick else NOISES
    with tempfile.TemporaryDirectory() as folder:
        chosen = scans(CHOSEN_ON) + ([] if options.quick else [Scan(cube(folder))])
    for title, surfaces in (("Meshes on which constants were chosen", chosen), ("Other meshes", scans(OTHERS))):
        rows = {}
        for scan in surfaces:
            rows.update(rows_of(experiment, scan, noises))
        report(experiment, title, rows)
    if options.pairs:
        report(experiment, "Public pairs", rows_of_pairs(experiment, options.pairs))
    experiment.finish()


if __name__ == "__main__":
    main()
