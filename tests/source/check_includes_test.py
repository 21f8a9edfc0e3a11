#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests check_includes.py: it passes the sources as they are, and finds each of the planted violations."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
CORE = "filter_tracked_mcf/core"

# (the file, what it includes, the rule in the message): one of each rule.
VIOLATIONS = [
    ("core/mesh/surface.cpp", f'"{CORE}/flow/cells/clip.h"', "mesh ranks below flow/cells"),
    ("core/noise/rim.cpp", f'"{CORE}/fair/patches.h"', "noise does not include fair"),
    ("core/flow/stepping/mesh_flow.cpp", f'"{CORE}/flow/solver/paper/multigrid.h"', "only flow/stepping/paper_flow.h"),
    ("core/attic/planted.h", f'"{CORE}/errors.h"', "this room has no rank"),
    ("core/evolve.cpp", "<QString>", "the core knows the standard library and Eigen alone"),
    ("core/evolve.cpp", '"filter_tracked_mcf/presentation/run.h"', "the core includes nothing of the project but the core"),
    ("presentation/summary.cpp", f'"{CORE}/mesh/measures.h"', "only the core includes the core's rooms"),
    ("hosts/cli/main.cpp", '"filter_tracked_mcf/hosts/meshlab/run_filter.h"', "hosts/cli does not include hosts/meshlab"),
    ("hosts/cli/main.cpp", '"command_line.h"', "paths of our files begin at the top"),
]


def check(top):
    result = subprocess.run([sys.executable, TOP / "tests/source/check_includes.py", top], stderr=subprocess.PIPE, text=True,
                            check=False)
    return result.returncode, result.stderr


def main():
    assert check(TOP) == (0, "")
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder)
        assert check(top)[0] == 2  # there is no core
        shutil.copytree(TOP / "filter_tracked_mcf", top / "filter_tracked_mcf",
                        ignore=shutil.ignore_patterns("*.png", "*.gif"))
        for where, included, rule in VIOLATIONS:
            file = top / "filter_tracked_mcf" / where
            before = file.read_text() if file.exists() else ""
            file.parent.mkdir(exist_ok=True)
            file.write_text(f"#include {included}\n{before}")
            code, messages = check(top)
            assert code == 1 and len(messages.splitlines()) == 1, messages
            assert f"filter_tracked_mcf/{where}:1: " in messages and rule in messages, messages
            file.write_text(before)


if __name__ == "__main__":
    main()
