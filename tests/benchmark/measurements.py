"""What the benchmark measures: runs of the driver, and the figures that they print."""

import csv
import dataclasses
import io
import itertools
import os
import statistics
import subprocess
import sys

OURS, REBUILT = "ours", "rebuilt"
IC, MIC, CGAL = "IC(0)-CG", "modified IC(0)-CG", "CGAL"
BASELINE_INSTRUCTIONS = "ours, baseline instructions"
OTHER_BINARY = "ours, other binary"
TRIAD = "triad"


@dataclasses.dataclass(frozen=True)
class Case:
    """One configuration. `mesh` is its name in tables; `words` are what the driver is told."""
    peer: str
    mesh: str = ""
    step_size: float = 0
    threads: int = 1
    words: tuple = ()
    environment: tuple = ()


class Measurements:
    """Runs cases and keeps all figures."""

    KEYS = ("peer", "mesh", "step_size", "threads")

    def __init__(self, driver, other_binary=None):
        self._driver = driver
        self._other_binary = other_binary
        self._rows = []
        self.failures = []  # what the driver was told where it did not succeed

    def run(self, cases, repetitions):
        """In turn, so that what else the machine does falls on all alike."""
        for repetition, case in itertools.product(range(repetitions), cases):
            self._run_once(case, repetition)

    def _run_once(self, case, repetition):
        driver = self._other_binary if case.peer == OTHER_BINARY else self._driver
        words = [str(word) for word in case.words]
        print(f"... {' '.join(words)} {' '.join('='.join(e) for e in case.environment)}",
              file=sys.stderr, flush=True)
        # Threads that wait at a barrier would else burn the processor time of other processes.
        self._add(case, repetition, "load_average", 0, os.getloadavg()[0])
        environment = {**os.environ, "OMP_WAIT_POLICY": "passive", **dict(case.environment)}
        result = subprocess.run([driver, *words], env=environment, stdout=subprocess.PIPE,
                                text=True, check=False)
        if result.returncode != 0:
            # Out of memory, perhaps: that is a result, too. Its figures so far count.
            print(f"... ended with {result.returncode}", file=sys.stderr)
            self.failures.append(" ".join(words))
        for row in csv.DictReader(io.StringIO(result.stdout)):
            self._add(case, repetition, row["quantity"], int(row["step"]), float(row["value"]))

    def _add(self, case, repetition, quantity, step, value):
        self._rows.append({"peer": case.peer, "mesh": case.mesh, "step_size": case.step_size,
                           "threads": case.threads, "repetition": repetition,
                           "quantity": quantity, "step": step, "value": value})

    def values(self, quantity, **case):
        """All figures of that name, of cases with these values."""
        return [row["value"] for row in self._rows if row["quantity"] == quantity
                and all(row[key] == value for key, value in case.items())]

    def median(self, quantity, **case):
        """Over steps and repetitions; None if it was not measured."""
        values = self.values(quantity, **case)
        return statistics.median(values) if values else None

    def quantities(self, prefix, **case):
        """Names that begin so, in the order in which they were printed."""
        return list(dict.fromkeys(row["quantity"] for row in self._rows
                                  if row["quantity"].startswith(prefix)
                                  and all(row[key] == value for key, value in case.items())))

    def meshes(self, **case):
        return list(dict.fromkeys(row["mesh"] for row in self._rows
                                  if all(row[key] == value for key, value in case.items())))

    def peers(self):
        return list(dict.fromkeys(row["peer"] for row in self._rows))

    def write(self, path):
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, [*self.KEYS, "repetition", "quantity", "step", "value"])
            writer.writeheader()
            writer.writerows(self._rows)

    def read(self, path):
        """What write() wrote, instead of running."""
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                self._rows.append({**row, "step_size": float(row["step_size"]),
                                   "threads": int(row["threads"]), "step": int(row["step"]),
                                   "value": float(row["value"])})
