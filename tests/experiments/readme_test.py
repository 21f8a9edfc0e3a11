#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that README's tables of measurements are those of the kept results.

The tables are written anew from results/denoising.csv and results/long_waves.csv and compared as text, so
that no number escapes. A failure shows the table that README should have.
"""

import csv
import pathlib
import unittest

HERE = pathlib.Path(__file__).resolve().parent
README = HERE.parents[1] / "README.md"

NOISE = "0.2"
MESHES = ["fandisk", "anchor_dense", "hand_8k", "nefertiti_50k", "armadillo_50k"]
SMOOTHERS = {"noisy": "noisy", "edges": "this filter, 25°, 3 edges, order 2", "Taubin": "Taubin, best",
             "Laplacian": "Laplacian, best", "two-step": "two-step, best"}


def results(name):
    with open(HERE / "results" / f"{name}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def two_digits(text):
    return f"{float(text):.2g}"


def duration(seconds):
    return f"{seconds / 3600:.0f} h" if seconds >= 3600 else f"{seconds:.2g} s"


def table(*rows):
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([lines[0], "|" + "---|" * len(rows[0]), *lines[1:]]) + "\n"


def of_denoising():
    found = {(row["mesh"], row["smoother"]): row for row in results("denoising")
             if row["noise"] == NOISE}

    def cell(mesh, smoother):
        row = found[mesh, smoother]
        return f"{two_digits(row['RMS'])}, {two_digits(row['angle'])}°"

    return table([f"noise of {NOISE} edges (`denoising.py`)", *SMOOTHERS.values()],
                 *([f"`{mesh}`", *(cell(mesh, smoother) for smoother in SMOOTHERS)] for mesh in MESHES),
                 ["seconds, on `hand_8k`", "",
                  *(two_digits(found["hand_8k", smoother]["seconds"]) for smoother in SMOOTHERS
                    if smoother != "noisy")])


def of_long_waves():
    rows = {float(row["percentage"]): row for row in results("long_waves")}
    vertices = round(int(rows[1]["vertices"]), -3)

    def cells(percentage, of_what):
        row = rows[percentage]
        return [f"{float(row['edges']):.0f} edges{of_what}", f"{duration(float(row['seconds']))}",
                f"{duration(float(row['seconds of Taubin']))}, {int(row['iterations of Taubin']):,} "
                "iterations"]

    return table([f"waves to halve on a scan of {vertices:,} vertices (`long_waves.py`)", "this filter",
                  "Taubin"],
                 cells(1, " long, 1 % of the diagonal"), cells(10, ", 10 %"))


class ReadmeTest(unittest.TestCase):
    maxDiff = None

    def check(self, expected):
        readme = README.read_text(encoding="utf-8")
        self.assertTrue(f"\n\n{expected}\n" in readme, f"README's table should be\n\n{expected}")

    def test_table_of_denoising_is_of_the_kept_results(self):
        self.check(of_denoising())

    def test_table_of_long_waves_is_of_the_kept_results(self):
        self.check(of_long_waves())


if __name__ == "__main__":
    unittest.main()
