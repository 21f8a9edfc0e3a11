#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws README's picture of a laser scan, as it is, smoothed by MeshLab's Taubin filter, and by the flow, both with their
defaults: build/pymeshlab/bin/python scan_picture.py angel_scan.ply PROGRAM PICTURE.png

The view is that of the scan of an angel that the page of meshes lists.
"""

import pathlib
import subprocess
import sys
import tempfile

import pymeshlab

RENDER = pathlib.Path(__file__).resolve().parents[2] / "demo" / "render.py"
VIEW = ["--up", "0", "-1", "0", "--zoom", "2.2", "--center", "0.05", "-0.1", "--height", "420"]


def main(scan, program, picture):
    with tempfile.TemporaryDirectory() as name:
        taubin, flow = (pathlib.Path(name) / file for file in ("taubin.ply", "flow.ply"))
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(scan)
        meshes.apply_coord_taubin_smoothing()
        meshes.save_current_mesh(str(taubin))
        subprocess.run([program, "smooth", scan, flow], check=True)
        subprocess.run(["/usr/bin/python3", RENDER, "--output", picture, *VIEW, scan, taubin, flow, "--labels",
                        "as scanned", "MeshLab's Taubin filter", "Mean Curvature Flow"], check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
