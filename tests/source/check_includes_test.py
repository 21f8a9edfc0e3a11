#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests .ci/check_includes: it passes the sources as they are, and fails once for each planted violation."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = TOP / ".ci" / "check_includes"
CORE = "filter_tracked_mcf/core"

# Lowest first. A room of one line does not include a room of a later line.
ROOMS = ["kernels parallel", "mesh", "cells", "memory", "plan", "surface", "octree", "elements", "system", "solver", "flow"]

KERNELS_ALONE = "kernels include only kernels"
PAPER = "only flow/paper_flow.h includes solver/paper"
CORE_ALONE = "the core includes nothing of the project but the core"
FOREIGN = "the core knows the standard library, Eigen and Highway alone"
PUBLIC = "only the core includes the core's rooms"
FROM_TOP = "paths of our files begin at the top"

# (where, what is included there, the rule in the message)
VIOLATIONS = [
    ("core/kernels/planted.h", f'"{CORE}/parallel/parallel.h"', KERNELS_ALONE),
    ("core/kernels/planted.h", f'"{CORE}/triangle_mesh.h"', KERNELS_ALONE),
    ("core/kernels/planted.inc", f'"{CORE}/mesh/domain.h"', KERNELS_ALONE),
    ("core/parallel/planted.h", f'"{CORE}/kernels/kernels.h"', "parallel ranks below kernels"),
    ("core/solver/planted.cpp", f'"{CORE}/solver/paper/multigrid.h"', PAPER),
    ("core/flow/paper_flow.cpp", f'"{CORE}/solver/paper/multigrid.h"', PAPER),
    ("core/flow/planted.cpp", f'"{CORE}/solver/paper/multigrid.h"', PAPER),
    ("core/flow/planted.cpp", f'"{CORE}/attic/planted.h"', "no rank"),
    ("core/attic/planted.h", f'"{CORE}/triangle_mesh.h"', "no rank"),
    ("core/planted.h", '"filter_tracked_mcf/parameters/parameter_table.h"', CORE_ALONE),
    ("core/planted.h", '"filter_tracked_mcf/mesh_bridge/mesh_bridge.h"', CORE_ALONE),
    ("core/mesh/planted.cpp", "<vcg/complex/complex.h>", FOREIGN),
    ("core/mesh/planted.cpp", "<wrap/io_trimesh/import.h>", FOREIGN),
    ("core/mesh/planted.cpp", "<common/ml_document/mesh_model.h>", FOREIGN),
    ("core/mesh/planted.cpp", "<QString>", FOREIGN),
    ("core/mesh/planted.cpp", "<QtCore/qstring.h>", FOREIGN),
    ("core/mesh/planted.cpp", "<nlohmann/json.hpp>", FOREIGN),
    ("core/mesh/planted.cpp", '"domain.h"', FROM_TOP),
    ("tool/planted.cpp", '"../core/flow/mesh_flow.h"', FROM_TOP),
    ("plugin/planted.cpp", f'"{CORE}/flow/mesh_flow.h"', PUBLIC),
    ("plugin/modern/planted.cpp", f'"{CORE}/mesh/domain.h"', PUBLIC),
    ("tool/planted.cpp", f'"{CORE}/parallel/parallel.h"', PUBLIC),
    ("parameters/planted.cpp", f'"{CORE}/memory/process_memory.h"', PUBLIC),
    ("mesh_bridge/planted.h", f'"{CORE}/mesh/measures.h"', PUBLIC),
    ("tool/planted.cpp", '"filter_tracked_mcf/plugin/run_filter.h"', "tool does not include plugin"),
    ("tool/planted.cpp", '"filter_tracked_mcf/mesh_bridge/mesh_bridge.h"', "tool does not include mesh_bridge"),
    ("tool/planted.cpp", '"filter_tracked_mcf/mesh_bridge/mesh_bridge.h"', "tool does not include mesh_bridge"),
    ("plugin/planted.cpp", '"filter_tracked_mcf/tool/mesh_file.h"', "plugin does not include tool"),
    ("parameters/planted.h", '"filter_tracked_mcf/tool/mesh_file.h"', "does not include tool"),
    ("mesh_bridge/planted.h", '"filter_tracked_mcf/plugin/run_filter.h"', "does not include plugin"),
]

ALLOWED = [
    ("core/kernels/planted.cpp", f'"{CORE}/errors.h"'),
    ("core/kernels/planted.cpp", "<hwy/highway.h>"),
    ("core/parallel/planted.cpp", "<unistd.h>"),
    ("core/memory/planted.cpp", "<sys/resource.h>"),
    ("core/memory/planted.cpp", "<windows.h>"),
    ("core/flow/planted.cpp", "<Eigen/SparseCore>"),
    ("core/evolve.cpp", f'"{CORE}/flow/mesh_flow.h"'),
    ("core/flow/paper_flow.h", f'"{CORE}/solver/paper/multigrid.h"'),
    ("plugin/planted.cpp", '"meshlab_api.h"'),
    ("plugin/planted.cpp", "<QString>"),
    ("tool/planted.cpp", f'"{CORE}/evolve.h"'),
    ("tool/planted.cpp", '"filter_tracked_mcf/parameters/parameter_table.h"'),
]


def upward_includes():
    for rank, lower in enumerate(ROOMS):
        for higher in " ".join(ROOMS[rank + 1:]).split():
            for room in lower.split():
                rule = KERNELS_ALONE if room == "kernels" else f"{room} ranks below {higher}"
                yield f"core/{room}/planted.h", f'"{CORE}/{higher}/planted.h"', rule
    for room in " ".join(ROOMS).split():
        yield "core/planted.h", f'"{CORE}/{room}/planted.h"', f". ranks below {room}"


def downward_includes():
    for rank, higher in enumerate(ROOMS[1:], start=1):
        for lower in " ".join(ROOMS[:rank]).split():
            yield f"core/{higher}/planted.h", f'"{CORE}/{lower}/planted.h"'


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        shutil.copytree(TOP / "filter_tracked_mcf", self.top / "filter_tracked_mcf",
                        ignore=shutil.ignore_patterns("*.png"))

    def check(self):
        return subprocess.run([sys.executable, SCRIPT, self.top], text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def plant(self, where, included):
        file = self.top / "filter_tracked_mcf" / where
        file.parent.mkdir(exist_ok=True)
        text = file.read_text() if file.exists() else ""
        file.write_text(f"#include {included}\n{text}")
        return file, text

    def test_passes_the_sources_as_they_are(self):
        result = self.check()
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_fails_for_each_planted_violation(self):
        for where, included, rule in VIOLATIONS:
            with self.subTest(where=where, included=included):
                file, before = self.plant(where, included)
                result = self.check()
                self.assertEqual(result.returncode, 1)
                self.assertIn(f"filter_tracked_mcf/{where}:1: ", result.stderr)
                self.assertIn(rule, result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1)
                if before:
                    file.write_text(before)
                else:
                    file.unlink()

    def test_reports_each_upward_include(self):
        upward = list(upward_includes())
        for where, included, _ in upward:
            self.plant(where, included)
        result = self.check()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), len(upward))
        for where, included, rule in upward:
            line = rf"filter_tracked_mcf/{where}:\d+: includes {included[1:-1]}: {rule}"
            self.assertRegex(result.stderr, line)

    def test_passes_allowed_includes(self):
        for where, included in [*ALLOWED, *downward_includes()]:
            self.plant(where, included)
        result = self.check()
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_fails_where_there_is_no_core(self):
        shutil.rmtree(self.top / CORE)
        self.assertEqual(self.check().returncode, 2)


if __name__ == "__main__":
    unittest.main()
