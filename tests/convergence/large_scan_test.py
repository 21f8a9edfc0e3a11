#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the command-line program on the largest test scan and compares sizes and memory with known
values: large_scan_test.py TOOL bunny_scan_871k.ply.xz
"""

import json
import lzma
import pathlib
import shutil
import subprocess
import sys
import tempfile

GIGABYTE = 1e9


def flow(tool, compressed):
    """Returns the report of five steps at depth 9."""
    with tempfile.TemporaryDirectory() as folder:
        scan, report = pathlib.Path(folder, "scan.ply"), pathlib.Path(folder, "report.json")
        with lzma.open(compressed) as source, open(scan, "wb") as target:
            shutil.copyfileobj(source, target)
        subprocess.run([tool, scan, pathlib.Path(folder, "smooth.ply"), "--method", "paper", "--depth", "9",
                        "--iterations", "5", "--report", report], check=True)
        return json.loads(report.read_text())


def check(what, value, expected, tolerance):
    print(f"{what}: {value:.6g}, expected {expected:.6g} within {tolerance:.2g}")
    return abs(value - expected) <= tolerance


def main():
    tool, compressed = sys.argv[1:]
    report = flow(tool, compressed)
    memory = report["peak_memory_bytes"]
    print(f"peak memory: {memory / GIGABYTE:.2f} GB, must be below 3")
    passed = [
        check("cells", report["cells"], 0.76e6, 0.0076e6),
        check("unknowns", report["unknowns"], 1.52e6, 0.0152e6),
        check("split triangles", report["split_triangles"], 9.49e6, 0.0949e6),
        check("steps", report["iterations"], 5, 0),
        memory < 3 * GIGABYTE,
    ]
    sys.exit(0 if all(passed) else 1)


if __name__ == "__main__":
    main()
