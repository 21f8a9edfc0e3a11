# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the results page, tables and verdicts, from the measurements alone."""

import os

import machine
from measurements import (BASELINE_INSTRUCTIONS, CGAL, IC, MIC, OTHER_BINARY, OURS, REBUILT, TRACKED, TRIAD,
                          JOBS_BY_SIZE, RELIEF, WHOLE_JOBS)

PROTOTYPE_NANOSECONDS = 41  # for the assembly of a sample

BYTES_OF_ITERATION = 252  # of IC(0)-CG, for each vertex


def digits(value, unit=""):
    if value is None:
        return "-"
    text = f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    return f"{text} {unit}".rstrip()


def ratio(a, b):
    return a / b if a is not None and b else None


class Page:
    """The page. `main` is the mesh of the targets, `middle` the step size of most tables, `steps` the
    number of steps and `command` the command of the run."""

    def __init__(self, measurements, build, main, step_sizes, middle, steps, command):
        self._of = measurements
        self._build = build
        self._main = main
        self._step_sizes = step_sizes
        self._middle = middle
        self._steps_made = steps
        self._command = command
        self._lines = []

    def text(self):
        self._say("# Results of the benchmark\n")
        self._say("Made by `run_benchmark.py` alone; [README.md](README.md) says what is measured and "
                  "how the peers are tuned. To reproduce:\n")
        self._say("```sh\nexternal/install_debian.sh benchmark && external/cgal_meshes.sh "
                  "build/cgal-meshes\ncmake -S . -B build -DTRACKED_MCF_PLUGIN=OFF -DTRACKED_MCF_TESTS=ON "
                  "-DTRACKED_MCF_BENCHMARK=ON\ncmake --build build -j --target "
                  "tracked_mcf_benchmark\n" + self._command + "\n```\n")
        self._say(f"Unless said otherwise: medians; the noisy {self._main}; one thread; seconds of "
                  "processor time, of all threads, which other work on the machine hardly changes.\n")
        self._machine()
        self._verdicts()
        self._steps()
        self._setup()
        self._rebuilt()
        self._threads()
        self._instructions()
        self._accuracy()
        self._scale()
        self._floors()
        self._other_meshes()
        self._tuning()
        return "\n".join(self._lines)

    def text_of_whole_jobs(self):
        self._say("# Whole jobs, alone and beside other programs\n")
        self._say("A mesh is read, smoothed and written, with the default parameters and all processors. "
                  "MeshLab's filters are those of the official PyMeshLab, which use one thread. *Beside 2* means "
                  "that two other processes, which never wait, run meanwhile. Medians; wall seconds, then "
                  "processor seconds. To reproduce:\n")
        self._say("```sh\nexternal/pymeshlab.sh build/pymeshlab\ncmake -S . -B build -DTRACKED_MCF_PLUGIN=OFF -DTRACKED_MCF_TESTS=ON\n"
                  "cmake --build build -j --target tracked_mcf tracked_mcf_benchmark\n" + self._command + "\n```\n")
        self._machine()
        self._whole_jobs()
        self._sizes()
        return "\n".join(self._lines)

    # Measurements.

    def _ours(self, quantity, step_size=None, **more):
        case = {"peer": OURS, "mesh": self._main, "threads": 1, **more}
        return self._of.median(quantity, step_size=step_size or self._middle, **case)

    def _step(self, peer, step_size, **more):
        case = {"peer": peer, "mesh": self._main, "threads": 1, "step_size": step_size, **more}
        return self._of.median("step_cpu_seconds", **case)

    def _phase(self, phase, **case):
        """Returns processor seconds of a phase: the step's, times the phase's share of wall time."""
        wall, whole, cpu = (self._of.median(f"{what}_seconds", **case)
                            for what in (phase, "step", "step_cpu"))
        return ratio(wall, whole) * cpu if wall is not None else None

    def _bandwidth(self, threads=1):
        return self._of.median("best_bytes_per_second", peer=TRIAD, threads=threads)

    # Output.

    def _say(self, line=""):
        self._lines.append(line)

    def _title(self, title, remark=""):
        self._say(f"## {title}\n")
        if remark:
            self._say(f"{remark}\n")

    def _table(self, headers, rows):
        self._say(f"| {' | '.join(headers)} |")
        self._say(f"|{'---|' * len(headers)}")
        for row in rows:
            self._say(f"| {' | '.join(row)} |")
        self._say()

    # Sections.

    def _machine(self):
        self._title("Machine")
        rows = machine.table(self._build)
        for threads in (1, 2):
            median = self._of.median("median_bytes_per_second", peer=TRIAD, threads=threads)
            if median is None:  # not measured for the page of whole jobs
                continue
            rows.append([f"memory bandwidth, {threads} thread{'s' if threads > 1 else ''} (triad, best, "
                         "median)", f"{digits(ratio(self._bandwidth(threads), 1e9))}, "
                         f"{digits(ratio(median, 1e9))} GB/s"])
        loads = self._of.values("load_average")
        rows.append(["load average, this process included",
                     f"{min(loads):.1f} to {max(loads):.1f}" if loads else "not recorded"])
        self._table(["what", "is"], rows)
        # Whole jobs run beside endless loops on purpose.
        if self._of.values("load_average", peer=TRIAD) and max(loads) > os.cpu_count() + 0.5:
            self._say("**The machine was busy with other work.** Processor times hold; wall times, and with them the "
                      "speed-up of two threads, are those of a busy machine.\n")

    def _verdicts(self):
        self._title("Targets")
        rows = []

        def target(what, measured, limit, at_least=False, unit=""):
            met = "not measured" if measured is None else (
                "met" if (measured >= limit if at_least else measured <= limit) else "**not met**")
            rows.append([what, digits(measured, unit),
                         f"at {'least' if at_least else 'most'} {digits(limit, unit)}", met])

        small, middle, large = self._step_sizes
        for step_size, limit in ((middle, 0.5), (large, 0.2), (small, 1.5)):
            target(f"step at δ = {step_size:g}, relative to {IC}",
                   ratio(self._step(OURS, step_size), self._step(IC, step_size)), limit)
        nanoseconds = ratio(*(self._ours(quantity, peer=TRACKED) for quantity in ("kernel_cpu_seconds", "samples")))
        target("paper's method: element matrices, per sample", nanoseconds and 1e9 * nanoseconds,
               PROTOTYPE_NANOSECONDS / 3, unit="ns")
        setup = self._ours("setup_cpu_seconds")
        microseconds = ratio(setup, self._ours("triangles"))
        target("set-up, per triangle", microseconds and 1e6 * microseconds, 1.2, unit="µs")
        target(f"set-up, in steps of δ = {middle:g}", ratio(setup, self._step(OURS, middle)), 8)
        target("paper's method: rebuilt at every step, relative to tracked",
               ratio(self._step(REBUILT, middle), self._step(TRACKED, middle)), 7, at_least=True)
        for what in ("setup", "step"):
            one, two = (self._ours(f"{what}_seconds", threads=threads) for threads in (1, 2))
            target(f"two threads, {what}: speed-up", ratio(one, two), 1.7, at_least=True)
            one, two = (self._ours(f"{what}_cpu_seconds", threads=threads) for threads in (1, 2))
            target(f"two threads, {what}: processor time, relative to one thread", ratio(two, one), 1.15)
        target("memory", ratio(self._ours("peak_memory_bytes"), 1e6), 700, unit="MB")
        for what, spread in (("step", self._spread("step_cpu_seconds")),
                             ("memory", self._spread("peak_memory_bytes"))):
            target(f"{what} per vertex, largest relative to smallest", spread, 1.25)
        largest = self._of.values("peak_memory_bytes", peer=OURS)
        target("memory of the largest run", max(largest) / 1e9 if largest else None, 20,
               unit="GB")
        target("speed of the chosen instructions, relative to the other binary",
               ratio(self._step(OTHER_BINARY, middle), self._step(OURS, middle)), 0.9, at_least=True)
        target("forced baseline instructions: difference of the radius, relative to the displacement",
               self._instruction_difference(), 1e-5)
        target(f"CGAL, relative to ours, δ = {middle:g}",
               ratio(self._step(CGAL, middle), self._step(OURS, middle)), 20, at_least=True)
        self._table(["what", "measured", "target", "verdict"], rows)

    def _steps(self):
        self._title("Steps", "Processor seconds of a step (and wall seconds), iterations, memory: medians over a "
                    "flow's steps. "
                    f"{MIC} is the same peer with what its factorisation leaves out put on the "
                    "diagonal: stronger on good triangles, useless on bad ones.")
        rows = []
        for step_size in self._step_sizes:
            reference = self._step(IC, step_size)
            for peer in (OURS, IC, MIC, CGAL):
                case = {"peer": peer, "mesh": self._main, "threads": 1, "step_size": step_size}
                cpu = self._of.median("step_cpu_seconds", **case)
                if cpu is None:
                    continue
                rows.append([
                    f"{step_size:g}", peer,
                    f"{digits(cpu)} ({digits(self._of.median('step_seconds', **case))})",
                    digits(self._of.median("iterations", **case)),
                    digits(self._of.median("setup_cpu_seconds", **case)),
                    digits(ratio(self._of.median("peak_memory_bytes", **case), 1e6), "MB"),
                    digits(ratio(cpu, reference)), digits(ratio(cpu, self._step(OURS, step_size)))])
        self._table(["δ", "peer", "step", "iterations", "set-up", "memory", f"of {IC}", "of ours"],
                    rows)
        self._say("By phase:\n")
        rows = []
        for step_size in self._step_sizes:
            for peer in (OURS, IC, MIC):
                case = {"peer": peer, "mesh": self._main, "threads": 1, "step_size": step_size}
                rows.append([f"{step_size:g}", peer, *(
                    digits(self._phase(phase, **case))
                    for phase in ("assemble", "factorize", "solve"))])
        self._table(["δ", "peer", "assemble", "factorise", "solve"], rows)

    def _setup(self):
        self._title("Set-up", "Ours, by phase.")
        case = {"peer": OURS, "mesh": self._main, "step_size": self._middle}
        triangles = self._ours("triangles")
        rows = []
        for name in self._of.quantities("setup", **case):
            if not name.endswith("_cpu_seconds"):
                continue
            wall = name.replace("_cpu_seconds", "_seconds")
            one = self._of.median(name, threads=1, **case)
            rows.append([name[:-len("_cpu_seconds")].replace("setup: ", "").replace("setup", "all"),
                         digits(one), digits(self._of.median(wall, threads=1, **case)),
                         digits(self._of.median(wall, threads=2, **case)),
                         digits(1e6 * one / triangles, "µs")])
        self._table(["phase", "processor seconds", "wall", "wall, two threads", "a triangle"], rows)

    def _rebuilt(self):
        self._title("Tracked against rebuilt", "The paper's method. The non-tracked octree is set up anew from "
                    "the evolved mesh before every step.")
        rows = []
        for peer in (TRACKED, REBUILT):
            case = {"peer": peer, "mesh": self._main, "threads": 1, "step_size": self._middle}
            setup = self._of.median("setup_cpu_seconds", **case) if peer == REBUILT else None
            rows.append([peer, *map(digits, (
                setup, self._phase("assemble", **case), self._phase("solve", **case),
                self._of.median("move_cpu_seconds", **case) if peer == REBUILT else None,
                self._step(peer, self._middle)))])
        self._table(["", "set-up", "assemble", "solve", "move vertices", "whole step"], rows)

    def _threads(self):
        self._title("Threads", f"δ = {self._middle:g}. Wall seconds mean something only if nothing else "
                    "runs.")
        rows = []
        for peer in (OURS, IC):
            for what in ("setup", "step"):
                figures = [self._ours(f"{what}{kind}_seconds", peer=peer, threads=threads)
                           for kind in ("", "_cpu") for threads in (1, 2)]
                rows.append([peer, what, *map(digits, figures), digits(ratio(*figures[:2]))])
        self._table(["peer", "what", "wall, 1 thread", "wall, 2", "processor, 1", "processor, 2",
                     "times faster"], rows)

    def _instruction_difference(self):
        """Returns the difference of the mean radius, relative to the sphere's shrinkage."""
        chosen, forced = (self._ours("mean_radius_error", peer=peer)
                          for peer in (OURS, BASELINE_INSTRUCTIONS))
        if chosen is None or forced is None:
            return None
        return abs(chosen - forced) / (2 * self._steps_made * self._middle / 0.5)

    def _instructions(self):
        self._title("Instructions", "Forced by `TRACKED_MCF_INSTRUCTIONS=ssse3`; the other binary is "
                    "that of `--binary`, such as one built with `-march=native`.")
        self._table(["", "step", "mean radius error"], [
            [peer, digits(self._step(peer, self._middle)), digits(self._ours("mean_radius_error", peer=peer))]
            for peer in (OURS, BASELINE_INSTRUCTIONS, OTHER_BINARY)])

    def _accuracy(self):
        self._title("Geometric error at equal time", "Spheres of radius 0.5 without noise after steps of "
                    f"δ = {self._middle:g}, against the exact radius of semi-implicit steps. Seconds are "
                    "those of set-up and all steps.")
        rows = []
        for mesh in self._of.meshes():
            if "without noise" not in mesh:
                continue
            for peer in (OURS, IC, CGAL):
                case = {"peer": peer, "mesh": mesh}
                steps = self._of.values("step_cpu_seconds", **case)
                if steps:
                    rows.append([mesh, peer, digits(self._of.median("mean_radius_error", **case)),
                                 digits(self._of.median("worst_radius_error", **case)),
                                 digits(self._of.median("setup_cpu_seconds", **case) + sum(steps))])
        self._table(["mesh", "peer", "mean radius off by", "worst vertex", "seconds"], rows)

    def _tuning(self):
        self._title("The baseline's tuning", "What single choices gain: the same without them.")
        rows = []
        tuned = [peer for peer in self._of.peers() if peer.startswith(f"{IC}, ")]
        for peer in (IC, *tuned):
            cells = []
            for step_size in self._step_sizes[:2]:
                case = {"peer": peer, "mesh": self._main, "threads": 1, "step_size": step_size}
                cells += [digits(self._of.median("step_cpu_seconds", **case)),
                          digits(self._of.median("iterations", **case))]
            rows.append(["as tuned" if peer == IC else peer[len(IC) + 2:], *cells])
        heads = [f"{what}, δ = {step_size:g}" for step_size in self._step_sizes[:2]
                 for what in ("step", "iterations")]
        self._table(["baseline", *heads], rows)

    def _scaled(self):
        return [mesh for mesh in self._of.meshes(peer=OURS) if mesh.endswith(", scaled")]

    def _per_vertex(self, quantity, mesh):
        return ratio(self._of.median(quantity, peer=OURS, mesh=mesh),
                     self._of.median("vertices", peer=OURS, mesh=mesh))

    def _spread(self, quantity):
        values = [self._per_vertex(quantity, mesh) for mesh in self._scaled()]
        values = [value for value in values if value is not None]
        return max(values) / min(values) if len(values) > 1 else None

    def _scale(self):
        self._title("Scale", "δ is the same in squared edges at every size.")
        rows = []
        for mesh in self._scaled():
            case = {"peer": OURS, "mesh": mesh}
            rows.append([
                mesh.replace(", scaled", ""),
                digits(self._of.median("step_cpu_seconds", **case)),
                digits(1e6 * self._per_vertex("step_cpu_seconds", mesh), "µs"),
                digits(1e6 * self._per_vertex("setup_cpu_seconds", mesh), "µs"),
                digits(self._per_vertex("peak_memory_bytes", mesh)),
                digits(self._of.median("peak_memory_bytes", **case) / 1e9, "GB"),
                digits(self._of.median("iterations", **case))])
        self._table(["mesh", "step", "a vertex", "set-up, a vertex", "bytes a vertex", "memory", "iterations"], rows)

    def _floors(self):
        self._title("Floors", f"What a solve of {IC} must at least move, over the best bandwidth that the triad "
                    f"reached: {BYTES_OF_ITERATION} bytes a vertex and iteration, matrix, factor and five vectors.")
        bandwidth = self._bandwidth()
        rows = []
        for step_size in self._step_sizes:
            case = {"peer": IC, "mesh": self._main, "threads": 1, "step_size": step_size}
            vertices, iterations = (self._of.median(quantity, **case) for quantity in ("vertices", "iterations"))
            seconds = self._phase("solve", **case)
            if None in (bandwidth, vertices, iterations, seconds):
                continue
            moved = BYTES_OF_ITERATION * vertices * iterations
            rows.append([f"{step_size:g}", digits(moved / 1e6, "MB"), digits(moved / bandwidth), digits(seconds),
                         digits(seconds * bandwidth / moved)])
        self._table(["δ", "bytes", "floor", "measured", "times the floor"], rows)

    def _other_meshes(self):
        self._title("Other meshes", f"{IC} stops after 1000 iterations.")
        rows = []
        for mesh in self._of.meshes():
            if mesh == "" or mesh.startswith("sphere"):
                continue
            for step_size in self._step_sizes:
                for peer in (OURS, IC, MIC):
                    case = {"peer": peer, "mesh": mesh, "step_size": step_size}
                    cpu = self._of.median("step_cpu_seconds", **case)
                    if cpu is not None:
                        rows.append([
                            mesh, f"{step_size:g}", peer, digits(cpu),
                            digits(self._of.median("iterations", **case)),
                            digits(self._of.median("setup_cpu_seconds", **case)),
                            digits(self._of.median("unknowns", **case)),
                            digits(self._of.median("peak_memory_bytes", **case) / 1e6, "MB")])
        self._table(["mesh", "δ", "peer", "step", "iterations", "set-up", "unknowns", "memory"], rows)

    def _whole_jobs(self):
        self._title("Times")
        loads = self._of.loads(peer=WHOLE_JOBS[0])
        rows = []
        for mesh in self._of.meshes(peer=WHOLE_JOBS[1]):
            for job in WHOLE_JOBS:
                if mesh not in self._of.meshes(peer=job):
                    continue
                case = {"peer": job, "mesh": mesh}
                rows.append([mesh, job, *(self._seconds(busy=busy, **case) for busy in loads),
                             digits(self._of.median("peak_memory_bytes", **case) / 1e6, "MB")])
        self._table(["mesh", "job", *("alone" if busy == 0 else f"beside {busy}" for busy in loads), "memory"],
                    rows)

    def _sizes(self):
        self._title("By size", "Squares with waves, and with noise of 0.2 edges. Wall seconds, then processor seconds; other work on the "
                    "machine changes the first.")
        rows = []
        for job in JOBS_BY_SIZE:
            for mesh in [mesh for mesh in self._of.meshes(peer=job) if mesh.startswith(RELIEF)]:
                case = {"peer": job, "mesh": mesh}
                vertices = 1000 * int(mesh.split()[1])
                rows.append([mesh.removeprefix(f"{RELIEF}, "), job, self._seconds(**case),
                             digits(1e6 * self._of.median("whole_job_cpu_seconds", **case) / vertices),
                             digits(self._of.median("peak_memory_bytes", **case) / 1e6, "MB")])
        self._table(["vertices", "job", "seconds", "processor µs a vertex", "memory"], rows)

    def _seconds(self, **case):
        return ", ".join(digits(self._of.median(f"whole_job_{kind}seconds", **case)) for kind in ("", "cpu_"))
