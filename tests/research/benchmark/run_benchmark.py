#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the set-up and the steps of the flow and of its peers, and writes the results page.

Each run is a separate process. The output folder gets measurements.csv with all numbers; the page is made
from this file alone. A whole run takes about 20 minutes, a quick run two.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

import numpy

from measurements import CGAL, JOBS_BY_SIZE, OURS, RELIEF, SOLVERS, WHOLE_JOBS, Case, Measurements, has_cgal
from results_page import Page

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "tests" / "research" / "experiments"))

import shapes  # noqa: E402
from ply import unpacked, write_ply  # noqa: E402

ARMADILLO = TOP / "build" / "cgal-meshes" / "armadillo.off"
STEP_SIZES = (1e-5, 5e-4, 5e-3)
MIDDLE = 5e-4
STEPS = 10  # the default of a flow
NOISE = 0.2  # in mean edge lengths
LARGE_SCAN = "bunny_scan_871k"
RELIEF_SIDES = (100, 316, 1000, 3162)  # in vertices
PYMESHLAB_FILTERS = ("apply_coord_taubin_smoothing", "apply_coord_laplacian_smoothing")


def options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TOP / "build" / "research", metavar="FOLDER",
                        help="where tests/research was built")
    parser.add_argument("--meshes", type=pathlib.Path, metavar="FOLDER",
                        help=f"folder with {LARGE_SCAN}.ply.xz (default: that scan is not measured)")
    parser.add_argument("--output", type=pathlib.Path, metavar="FOLDER",
                        help="for the measurements (default: benchmark in the build folder)")
    parser.add_argument("--page", type=pathlib.Path, metavar="FILE",
                        help="the page (default: results.md in this script's folder; with --quick, in the "
                        "output folder)")
    parser.add_argument("--quick", action="store_true",
                        help="164,000 vertices instead of 655,000, one repetition, fewer cases")
    parser.add_argument("--frequency", type=int, metavar="N",
                        help="frequency of the main sphere (default: 256; with --quick, 128); it and the "
                        "other generated meshes have about 10 N² + 2 vertices")
    parser.add_argument("--repetitions", type=int, metavar="N",
                        help="of the cases that are compared directly (default: 3)")
    parser.add_argument("--largest", type=int, metavar="FREQUENCY",
                        help="largest frequency of the scaling test (default: 1024, which has 10.5 million vertices)")
    parser.add_argument("--whole-jobs", action="store_true",
                        help="only jobs from file to file, alone and beside endless loops, for whole_jobs.md; "
                        "takes ten minutes")
    parser.add_argument("--page-only", action="store_true",
                        help="make the page from the measurements of the last run")
    return parser.parse_args()


def sphere(frequency):
    """Returns the name for the driver of a sphere with noise."""
    return f"sphere:{frequency}:{NOISE}"


def label(frequency):
    """Returns the mesh's name in tables."""
    vertices = 10 * frequency * frequency + 2
    return f"sphere, {vertices / 1e6:.1f} M" if vertices >= 1e6 else f"sphere, {vertices // 1000} k"


def ours(mesh, name, step_size, threads=1, steps=STEPS):
    return Case(OURS, name, step_size, threads,
                ("flow", mesh, "--step-size", step_size, "--threads", threads, "--steps", steps))


def solvers(mesh, name, step_size):
    return [Case(solver, name, step_size, 1, ("solvers", mesh, solver, "--step-size", step_size)) for solver in SOLVERS]


def cgal(mesh, name, step_size):
    return Case(CGAL, name, step_size, 1, ("cgal", mesh, "--step-size", step_size))


class Benchmark:
    """All cases. `main` is the sphere of most tables."""

    def __init__(self, arguments, output):
        self._arguments = arguments
        self._output = output
        self._frequency = arguments.frequency or (128 if arguments.quick else 256)
        self._repetitions = 1 if arguments.quick else arguments.repetitions or 3
        self.main = label(self._frequency)

    def run(self, measurements):
        if self._arguments.whole_jobs:
            measurements.run(self._whole_jobs(), self._repetitions)
            measurements.run(self._sizes(), self._repetitions)
            return
        measurements.run(self._flows(), self._repetitions)
        measurements.run(self._solvers() + self._cgal() + self._scale(), 1)

    def _flows(self):
        mesh = sphere(self._frequency)
        return [ours(mesh, self.main, step_size) for step_size in STEP_SIZES] + [ours(mesh, self.main, MIDDLE, threads=2)]

    def _cgal(self):
        if not has_cgal(self._arguments.build / "tracked_mcf_benchmark"):
            return []
        step_sizes = [MIDDLE] if self._arguments.quick else STEP_SIZES
        return [cgal(sphere(self._frequency), self.main, step_size) for step_size in step_sizes]

    def _scale(self):
        largest = 2 * self._frequency if self._arguments.quick else self._arguments.largest or 1024
        frequencies = [f for f in (16, 32, 64, 128, 256, 512, 1024, 2048)
                       if self._frequency // 4 <= f <= largest]
        # δ is the same for all in squared edges. The first step also allocates memory.
        return [ours(sphere(f), f"{label(f)}, scaled", MIDDLE * (256 / f)**2, steps=4)
                for f in frequencies]

    def _solvers(self):
        step_sizes = [MIDDLE] if self._arguments.quick else STEP_SIZES
        return [case for mesh, name in [(sphere(self._frequency), self.main), *self._files()]
                for step_size in step_sizes for case in solvers(mesh, name, step_size)]

    def _whole_jobs(self):
        """Returns jobs from file to file, on an idle machine and beside endless loops."""
        return [case for mesh, name in self._job_meshes() for busy in (0, 1, os.cpu_count())
                for case in self._jobs(mesh, name, WHOLE_JOBS, busy)]

    def _sizes(self):
        """Returns jobs of single programs on meshes of different sizes."""
        return [case for side in RELIEF_SIDES[:2 if self._arguments.quick else None]
                for case in self._jobs(relief(side, self._output), f"{RELIEF}, {side * side // 1000} k",
                                       JOBS_BY_SIZE, 0)]

    def _jobs(self, mesh, name, jobs, busy):
        """Returns the jobs of these names, but those of PyMeshLab only if it is there."""
        script = pathlib.Path(__file__).parent / "whole_job.py"
        tool = self._arguments.build / "tracked_mcf"
        python = TOP / "build" / "pymeshlab" / "bin" / "python"
        edge = mean_edge(tool, mesh, self._output)
        commands = [(sys.executable, (tool, *words, "--overwrite"))
                    for words in ((), ("--threads", 1), ("--detail-size", 10 * edge), ("--detail-size", 40 * edge),
                                  ("remove-noise",), ("remove-noise", "--threads", 1))]
        if python.exists():
            commands += [(python, ("pymeshlab", name)) for name in PYMESHLAB_FILTERS]
        return [Case(job, name, words=(script, *words, mesh, self._output / f"job{mesh.suffix}"),
                     program=program, busy=busy)
                for job, (program, words) in zip(WHOLE_JOBS, commands) if job in jobs]

    def _job_meshes(self):
        """Returns files and names."""
        folder = self._arguments.meshes
        if folder and not self._arguments.quick:
            return [(folder / f"{name}.ply", name) for name in ("hand_8k", "skull_50k")] + [
                (unpacked(folder / f"{LARGE_SCAN}.ply.xz", self._output), LARGE_SCAN)]
        return [(ARMADILLO, "armadillo")] if ARMADILLO.exists() else []

    def _files(self):
        """Returns names for the driver and for tables."""
        quick = self._arguments.quick
        meshes = [(f"{ARMADILLO}:{1 if quick else 2}", "armadillo, refined")] if ARMADILLO.exists() else []
        if self._arguments.meshes and not quick:
            packed = self._arguments.meshes / f"{LARGE_SCAN}.ply.xz"
            meshes.append((unpacked(packed, self._output), LARGE_SCAN))
        return meshes


def relief(side, folder):
    """Writes a square with waves, and with noise of 0.2 edges, of side² vertices. Returns its file."""
    path = folder / f"relief_{side}.ply"
    if path.exists():
        return path
    noise = numpy.random.default_rng(1).normal(scale=NOISE, size=side * side)
    vertices, faces = shapes.sheet(side - 1, side - 1, lambda x, y: side / 30 * numpy.sin(20 / side * x) + noise)
    write_ply(path, vertices.astype(numpy.float32), faces)
    return path


def mean_edge(tool, mesh, folder):
    """Returns the mesh's mean edge length, a third of the default detail size."""
    report = folder / "mean_edge.json"
    subprocess.run([tool, "--quiet", "--overwrite", "--iterations", "1", "--report", report, mesh, folder / f"mean_edge{mesh.suffix}"],
                   check=True)
    return json.loads(report.read_text(encoding="utf-8"))["detail_size"] / 3


def command_line(arguments):
    """Returns the command without the options that do not affect the measurements."""
    words = ["tests/research/benchmark/run_benchmark.py"]
    words += [f"--{name.replace('_', '-')}" for name in ("quick", "whole_jobs") if getattr(arguments, name)]
    words += [f"--{name} {getattr(arguments, name)}" for name in ("frequency", "largest", "repetitions") if getattr(arguments, name)]
    return " ".join([*words, *(["--meshes FOLDER"] if arguments.meshes else [])])


def main():
    arguments = options()
    output = arguments.output or arguments.build / "benchmark_results"
    output.mkdir(parents=True, exist_ok=True)
    figures = output / ("whole_jobs.csv" if arguments.whole_jobs else "measurements.csv")
    driver = arguments.build / "tracked_mcf_benchmark"
    measurements = Measurements(driver)
    benchmark = Benchmark(arguments, output)
    if arguments.page_only:
        measurements.read(figures)
    else:
        try:
            benchmark.run(measurements)
        finally:
            measurements.write(figures)
    beside = output if arguments.quick else pathlib.Path(__file__).parent
    page = Page(measurements, arguments.build, benchmark.main, STEP_SIZES, MIDDLE, command_line(arguments))
    if arguments.whole_jobs:
        (arguments.page or beside / "whole_jobs.md").write_text(page.text_of_whole_jobs(), encoding="utf-8")
    else:
        (arguments.page or beside / "results.md").write_text(page.text(), encoding="utf-8")
    if measurements.failures:
        sys.exit("These runs failed:\n" + "\n".join(measurements.failures))


if __name__ == "__main__":
    main()
