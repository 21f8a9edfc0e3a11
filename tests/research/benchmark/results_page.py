# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the results page, tables and verdicts, from the measurements alone."""

import os

import machine
from measurements import CGAL, JOBS_BY_SIZE, OURS, RELIEF, SOLVERS, WHOLE_JOBS


def digits(value, unit=""):
    if value is None:
        return "-"
    text = f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    return f"{text} {unit}".rstrip()


def ratio(a, b):
    return a / b if a is not None and b else None


class Page:
    """The page. `main` is the mesh of most tables, `middle` their step size, and `command` the command of the run."""

    def __init__(self, measurements, build, main, step_sizes, middle, command):
        self._of = measurements
        self._build = build
        self._main = main
        self._step_sizes = step_sizes
        self._middle = middle
        self._command = command
        self._lines = []

    def text(self):
        self._say("# Results of the benchmark\n")
        self._say("[README.md](README.md) says what is measured; [removed_peers.md](removed_peers.md) has peers whose code was "
                  "removed. To reproduce:\n")
        self._say(self._commands())
        self._say(f"Unless said otherwise: medians; the noisy {self._main}; one thread; seconds of "
                  "processor time, of all threads, which other work on the machine hardly changes.\n")
        self._machine()
        self._solvers()
        self._steps()
        self._setup()
        self._threads()
        self._scale()
        return "\n".join(self._lines)

    def text_of_whole_jobs(self):
        self._say("# Whole jobs, alone and beside other programs\n")
        self._say("A mesh is read, smoothed and written, with the default parameters and all processors. "
                  "MeshLab's filters are those of the official PyMeshLab, which use one thread. *Beside 2* means "
                  "that two other processes, which never wait, run meanwhile. Medians; wall seconds, then "
                  "processor seconds. To reproduce:\n")
        self._say(self._commands("external/pymeshlab.sh build/pymeshlab"))
        self._machine()
        self._whole_jobs()
        self._sizes()
        return "\n".join(self._lines)

    def _commands(self, *first):
        build = ("external/install_debian.sh research && external/cgal_meshes.sh build/cgal-meshes",
                 "cmake -S tests/research -B build/research -DTRACKED_MCF_CGAL=ON && cmake --build build/research -j 2")
        return "\n".join(["```sh", *first, *build, self._command, "```\n"])

    # Measurements.

    def _ours(self, quantity, step_size=None, **more):
        case = {"peer": OURS, "mesh": self._main, "threads": 1, **more}
        return self._of.median(quantity, step_size=step_size or self._middle, **case)

    def _phase(self, phase, **case):
        """Returns processor seconds of a phase: the step's, times the phase's share of wall time."""
        wall, whole, cpu = (self._of.median(f"{what}_seconds", **case)
                            for what in (phase, "step", "step_cpu"))
        return ratio(wall, whole) * cpu if wall is not None else None

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
        loads = self._of.values("load_average")
        rows.append(["load average, this process included",
                     f"{min(loads):.1f} to {max(loads):.1f}" if loads else "not recorded"])
        self._table(["what", "is"], rows)
        # Whole jobs run beside endless loops on purpose.
        if self._of.values("load_average", peer=OURS) and max(loads) > os.cpu_count() + 0.5:
            self._say("**The machine was busy with other work.** Processor times hold; wall times, and with them the "
                      "speed-up of two threads, are those of a busy machine.\n")

    def _solvers(self):
        self._title("One step, solved to the same error", "The energy norm of the displacement's true error is at most a thousandth of the "
                    "displacement's: each solver's tolerance is the largest of 0.1, 0.05, 0.025, ... with which it is. Seconds of "
                    "ours are of a whole step; of the others, of the factors and the solution.")
        rows = []
        for mesh in [mesh for mesh in self._of.meshes(peer=SOLVERS[1]) if mesh]:
            for step_size in self._step_sizes:
                of_ours = self._of.median("solver_cpu_seconds", peer=OURS, mesh=mesh, step_size=step_size)
                for solver in SOLVERS:
                    case = {"peer": solver, "mesh": mesh, "step_size": step_size}
                    seconds = self._of.median("solver_cpu_seconds", **case)
                    if seconds is not None:
                        rows.append([mesh, f"{step_size:g}", solver, digits(seconds), digits(ratio(seconds, of_ours)),
                                     *(digits(self._of.median(f"solver_{what}", **case))
                                       for what in ("iterations", "tolerance", "error"))])
        self._table(["mesh", "δ", "solver", "seconds", "of ours", "iterations", "tolerance", "error"], rows)

    def _steps(self):
        self._title("Steps", "Processor seconds of a step (and wall seconds), iterations, memory: medians over a "
                    "flow's steps.")
        rows = []
        for step_size in self._step_sizes:
            for peer in (OURS, CGAL):
                case = {"peer": peer, "mesh": self._main, "threads": 1, "step_size": step_size}
                cpu = self._of.median("step_cpu_seconds", **case)
                if cpu is None:
                    continue
                rows.append([
                    f"{step_size:g}", peer,
                    f"{digits(cpu)} ({digits(self._of.median('step_seconds', **case))})",
                    *(digits(self._phase(phase, **case)) for phase in ("assemble", "solve")),
                    digits(self._of.median("iterations", **case)),
                    digits(self._of.median("setup_cpu_seconds", **case)),
                    digits(ratio(self._of.median("peak_memory_bytes", **case), 1e6), "MB")])
        self._table(["δ", "peer", "step", "assemble", "solve", "iterations", "set-up", "memory"], rows)

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

    def _threads(self):
        self._title("Threads", f"Ours, δ = {self._middle:g}. Wall seconds mean something only if nothing else runs.")
        rows = []
        for what in ("setup", "step"):
            figures = [self._ours(f"{what}{kind}_seconds", threads=threads)
                       for kind in ("", "_cpu") for threads in (1, 2)]
            rows.append([what, *map(digits, figures), digits(ratio(*figures[:2]))])
        self._table(["what", "wall, 1 thread", "wall, 2", "processor, 1", "processor, 2", "times faster"], rows)

    def _scaled(self):
        return [mesh for mesh in self._of.meshes(peer=OURS) if mesh.endswith(", scaled")]

    def _per_vertex(self, quantity, mesh):
        return ratio(self._of.median(quantity, peer=OURS, mesh=mesh),
                     self._of.median("vertices", peer=OURS, mesh=mesh))

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
