#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints how many meshes a minute tracked_mcf_folder.sh smooths with 1, 2 and 4 workers, and one worker with all cores:
folder.py BUILD MESH...

BUILD is the build folder of the program. Each run smooths 20 files, copies of the meshes in turn. The table has the medians
of three runs, which take turns.
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import machine

FILES, ROUNDS = 20, 3
CORES = len(os.sched_getaffinity(0))
RUNS = [(1, CORES), (1, 1), (2, 1), (4, 1)]  # workers, and threads of each
SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "filter_tracked_mcf/hosts/cli" / "tracked_mcf_folder.sh"


def seconds(program, meshes, output, workers, threads):
    """Returns the wall time."""
    environment = {**os.environ, "PATH": f"{program.parent}{os.pathsep}{os.environ['PATH']}",
                   "WORKERS": str(workers), "THREADS": str(threads)}
    shutil.rmtree(output, ignore_errors=True)
    begin = time.perf_counter()
    subprocess.run([SCRIPT, meshes, output], check=True, env=environment)
    return time.perf_counter() - begin


def main(build, *scans):
    program = pathlib.Path(build).resolve() / "filter_tracked_mcf/hosts/cli" / "tracked_mcf"
    times = {run: [] for run in RUNS}
    with tempfile.TemporaryDirectory() as folder:
        meshes = pathlib.Path(folder) / "scans"
        meshes.mkdir()
        for i in range(FILES):
            scan = pathlib.Path(scans[i % len(scans)])
            shutil.copy(scan, meshes / f"{i:02}_{scan.name}")
        for _ in range(ROUNDS):
            for run in RUNS:
                times[run].append(seconds(program, meshes, pathlib.Path(folder) / "smooth", *run))
    version = subprocess.run([program, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
    print(f"{version}, {CORES} cores, {machine.processor()}, {', '.join(pathlib.Path(scan).stem for scan in scans)}\n")
    print("| workers | threads of each | meshes a minute |\n|---|---|---|")
    for (workers, threads), measured in times.items():
        print(f"| {workers} | {threads} | {60 * FILES / statistics.median(measured):.0f} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
