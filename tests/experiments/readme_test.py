#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that README's tables of measurements are those of the kept results.

The tables are written anew from results/removing_noise.csv and results/long_waves.csv and compared as text, so
that no number escapes. A failure shows the table that README should have.
"""

import csv
import pathlib
import unittest

HERE = pathlib.Path(__file__).resolve().parent
README = HERE.parents[1] / "README.md"

NOISE = "0.2"
MESHES = ["anchor_dense", "mech-holes-shark", "skull_50k", "stanford_bunny", "boot_genus12"]
SMOOTHERS = {"noisy": "noisy", "ours": "Remove Noise", "Taubin": "Taubin, best of 22 settings",
             "Taubin, default": "Taubin, default"}


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


def of_removing_noise():
    found = {(row["mesh"], row["smoother"]): row for row in results("removing_noise")
             if row["noise"] == NOISE and row["list"] == "Other meshes"}

    def cell(mesh, smoother):
        row = found[mesh, smoother]
        return f"{two_digits(row['RMS'])} edges, {two_digits(row['angle'])}°"

    return table([f"noise of {NOISE} edges (`removing_noise.py`)", *SMOOTHERS.values()],
                 *([f"`{mesh}`", *(cell(mesh, smoother) for smoother in SMOOTHERS)] for mesh in MESHES))


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

    def test_table_of_removing_noise_is_of_the_kept_results(self):
        self.check(of_removing_noise())

    def test_table_of_long_waves_is_of_the_kept_results(self):
        self.check(of_long_waves())


if __name__ == "__main__":
    unittest.main()
