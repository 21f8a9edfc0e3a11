#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a table of the differences between the hosts' results and the command-line tool's, from the
last host tests: host_table.py BUILD_DIR

Each number is the largest difference of a coordinate over all tested parameters, relative to the mesh's
largest coordinate.
"""

import pathlib
import re
import sys

MESHES = ["bumpy_bowl", "mannequin-devil", "armadillo"]
WAYS = {"matches_tool": "meshlabserver", "without_a_display": "plugin, without a display",
        "in_meshlabs_tree": "plugin built in MeshLab's tree",
        "pymeshlab": "Python, load_plugin", "pymeshlab_wheel": "Python, wheel"}
DIFFERENCE = re.compile(r"largest difference (\S+) of the largest coordinate")


def cached(build, name):
    """Returns a value of CMake's cache."""
    text = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    return re.search(rf"^{name}:\w+=(.*)$", text, re.MULTILINE).group(1)


def largest_difference(folder):
    """Returns the difference as text; empty if the test has not run."""
    file = folder / "differences.txt"
    found = DIFFERENCE.findall(file.read_text(encoding="utf-8")) if file.exists() else []
    return f"{max(map(float, found)):.1e}" if found else ""


def rows(build):
    tests = build / "tests" / "hosts"
    precision = cached(build, "MESHLAB_SCALAR")
    for test, way in WAYS.items():
        differences = [largest_difference(tests / f"{test}.{mesh}") for mesh in MESHES]
        if any(differences):
            host = "PyMeshLab" if test.startswith("pymeshlab") else "MeshLab"
            yield [host, cached(build, "MESHLAB_SDK_RELEASE"), precision, way, *differences]
    if (tests / "dialog" / "applied.png").exists():
        yield ["MeshLab", cached(build, "MESHLAB_SDK_RELEASE"), precision, "window, by its picture",
               "Apply shows what Preview does", "", ""]


def main(build):
    builds = [build, *(file.parent for file in sorted(build.glob("other-hosts/*/plugin/CMakeCache.txt")))]
    table = [row for folder in builds for row in rows(folder)]
    if not table:
        return
    print("| host | release | precision | how |", " | ".join(MESHES), "|")
    print("|---" * (4 + len(MESHES)) + "|")
    for row in table:
        print("|", " | ".join(row), "|")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
