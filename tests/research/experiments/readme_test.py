#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests that README's figures are those of the kept results.

Its table and sentences are written anew from the results and compared as text. A failure shows what README should say.
"""

import csv
import math
import pathlib
import re
import unittest

HERE = pathlib.Path(__file__).resolve().parent
README = HERE.parents[2] / "README.md"

NOISE = "0.2"
OTHERS = "Other "  # how the names of the lists begin whose meshes chose no constants
MESHES = ["anchor_dense", "skull_50k", "boot_genus12"]
SMOOTHERS = {"noisy": "noisy", "ours": "Remove Noise", "Taubin, default": "Taubin, default",
             "Taubin": "Taubin, best of 22 settings"}


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
             if row["noise"] == NOISE and row["list"].startswith(OTHERS)}

    def cell(mesh, smoother):
        row = found[mesh, smoother]
        return f"{two_digits(row['RMS'])}, {two_digits(row['angle'])}°"

    return table([f"noise of {NOISE} edges: RMS error in edges, error of the normals", *SMOOTHERS.values()],
                 *([f"`{mesh}`", *(cell(mesh, smoother) for smoother in SMOOTHERS)] for mesh in MESHES))


def over_peers():
    found = {}
    for row in results("removing_noise"):
        found.setdefault(row["list"], {}).setdefault((row["mesh"], row["noise"]), {})[row["smoother"]] = row

    def over(peer, title):
        pairs = [(row["ours"], row[peer]) for row in found[title].values() if peer in row]
        logarithms = ([math.log(float(ours[figure]) / float(other[figure])) for ours, other in pairs]
                      for figure in ("RMS", "angle"))
        return len(pairs), *(two_digits(math.exp(sum(values) / len(values))) for values in logarithms)

    parts, rms_of_parts, angle_of_parts = over("Taubin", "Other parts")
    scans, rms_of_scans, angle_of_scans = over("Taubin", "Other scans")
    _, rms, angle = over("bilateral", "Other scans")
    return (f"Over {parts} cases of parts, its RMS error is {rms_of_parts} times that of the best of Taubin's 22 settings, "
            f"and its error of normals {angle_of_parts} times; over {scans} cases of scans {rms_of_scans} and "
            f"{angle_of_scans} times. On scans, they are {rms} and {angle} times those of a bilateral filter of normals at "
            f"its best")


def of_long_waves():
    [row] = [row for row in results("long_waves") if float(row["percentage"]) == 10]
    return (f"To halve waves of 10 % of the diagonal on the scan above, the flow takes "
            f"{duration(float(row['seconds']))} of processor time, Taubin's filter "
            f"{duration(float(row['seconds of Taubin']))}, ")


def of_whole_jobs():
    text = (HERE.parent / "benchmark" / "whole_jobs.md").read_text(encoding="utf-8")
    [noise] = re.findall(r"\| bunny_scan_871k \| remove noise, default parameters \| ([\d.]+), ", text)
    return (f"A scan of 871,000 vertices takes {two_digits(noise)} s with Remove Noise, as it has hardly any noise, from file to "
            f"file, on two cores")


def of_benchmark():
    text = (HERE.parent / "benchmark" / "results.md").read_text(encoding="utf-8")
    targets = re.findall(r"^\|.*\| (met|\*\*not met\*\*) \|$", text, re.MULTILINE)
    return f"the benchmark misses {targets.count('**not met**')} of its {len(targets)} targets"


class ReadmeTest(unittest.TestCase):
    maxDiff = None

    def check(self, expected):
        readme = README.read_text(encoding="utf-8")
        words = " ".join(re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", readme).split())  # links as their text
        self.assertTrue(" ".join(expected.split()) in words, f"README should say\n\n{expected}")

    def test_figures_are_of_the_kept_results(self):
        for expected in of_removing_noise(), over_peers(), of_long_waves(), of_whole_jobs(), of_benchmark():
            with self.subTest(expected):
                self.check(expected)


if __name__ == "__main__":
    unittest.main()
