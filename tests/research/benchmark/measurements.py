# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmark's driver and keeps the measurements."""

import contextlib
import csv
import dataclasses
import io
import itertools
import os
import statistics
import subprocess
import sys

OURS, CGAL = "ours", "CGAL"
# Of tracked_mcf_benchmark solvers.
SOLVERS = (OURS, "IC(0)-CG", "CHOLMOD")
# Of ours, then of PyMeshLab.
WHOLE_JOBS = ("flow, default parameters", "flow, one thread", "flow, detail of 10 edges", "flow, detail of 40 edges",
              "remove noise, default parameters", "remove noise, one thread",
              "MeshLab's Taubin", "MeshLab's Laplacian")
# Those that are compared by size.
JOBS_BY_SIZE = (WHOLE_JOBS[0], WHOLE_JOBS[4], WHOLE_JOBS[6])
RELIEF = "relief"


@dataclasses.dataclass(frozen=True)
class Case:
    """One configuration. `mesh` is its name in tables; `words` are the arguments of `program`, by default
    the driver."""
    peer: str
    mesh: str = ""
    step_size: float = 0
    threads: int = 1
    words: tuple = ()
    environment: tuple = ()
    program: str = ""
    busy: int = 0  # endless loops that run meanwhile


@contextlib.contextmanager
def endless_loops(count):
    """Keeps `count` processors busy, as other programs do."""
    loops = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def has_cgal(driver):
    """Returns whether the driver was built with CGAL."""
    text = subprocess.run([driver, "--help"], check=True, stdout=subprocess.PIPE, text=True).stdout
    return "  cgal " in text


class Measurements:
    """Runs cases and keeps all measurements."""

    KEYS = ("peer", "mesh", "step_size", "threads", "busy")

    def __init__(self, driver):
        self._driver = driver
        self._rows = []
        self.failures = []  # arguments of failed runs

    def run(self, cases, repetitions):
        """Runs the cases in turn, so that other load on the machine affects all alike."""
        for repetition, case in itertools.product(range(repetitions), cases):
            self._run_once(case, repetition)

    def _run_once(self, case, repetition):
        program = case.program or self._driver
        words = [str(word) for word in case.words]
        print(f"... {' '.join(words)} {' '.join('='.join(e) for e in case.environment)}",
              file=sys.stderr, flush=True)
        self._add(case, repetition, "load_average", 0, os.getloadavg()[0])
        with endless_loops(case.busy):
            result = subprocess.run([program, *words], env={**os.environ, **dict(case.environment)},
                                    stdout=subprocess.PIPE, text=True, check=False)
        if result.returncode != 0:
            # Possibly out of memory, which is a result, too. The measurements so far count.
            print(f"... ended with {result.returncode}", file=sys.stderr)
            self.failures.append(" ".join(words))
        for row in csv.DictReader(io.StringIO(result.stdout)):
            self._add(case, repetition, row["quantity"], int(row["step"]), float(row["value"]))

    def _add(self, case, repetition, quantity, step, value):
        self._rows.append({**{key: getattr(case, key) for key in self.KEYS}, "repetition": repetition,
                           "quantity": quantity, "step": step, "value": value})

    def values(self, quantity, **case):
        """Returns all values of a quantity, of cases with these properties."""
        return [row["value"] for row in self._rows if row["quantity"] == quantity
                and all(row[key] == value for key, value in case.items())]

    def median(self, quantity, **case):
        """Returns the median over steps and repetitions, or None if there is no value."""
        values = self.values(quantity, **case)
        return statistics.median(values) if values else None

    def quantities(self, prefix, **case):
        """Returns the quantities with this prefix, in the order of the output."""
        return list(dict.fromkeys(row["quantity"] for row in self._rows
                                  if row["quantity"].startswith(prefix)
                                  and all(row[key] == value for key, value in case.items())))

    def meshes(self, **case):
        return list(dict.fromkeys(row["mesh"] for row in self._rows
                                  if all(row[key] == value for key, value in case.items())))

    def loads(self, **case):
        return sorted({row["busy"] for row in self._rows
                       if all(row[key] == value for key, value in case.items())})

    def write(self, path):
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, [*self.KEYS, "repetition", "quantity", "step", "value"])
            writer.writeheader()
            writer.writerows(self._rows)

    def read(self, path):
        """Reads the file that write() wrote."""
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                self._rows.append({**row, "step_size": float(row["step_size"]),
                                   "threads": int(row["threads"]), "busy": int(row["busy"]),
                                   "step": int(row["step"]), "value": float(row["value"])})
