#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooths a folder by tracked_mcf_folder.sh or, on a Dask cluster of two workers, by tracked_mcf_folder.py: folder_test.py PROGRAM SCRIPT

Ends with 77, which tells CTest that the test was skipped, where tracked_mcf_folder.py needs a package that is not installed.
"""

import contextlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

try:
    import distributed
except ImportError as error:
    if sys.argv[-1].endswith(".py"):
        print(f"skipped: {sys.executable}: {error}; pip installs distributed")
        sys.exit(77)

OPTIONS = ["--detail-size", "20%"]

# A pyramid without a base.
MESH = """OFF
5 4 0
0 0 {height}
1 0 0
0 1 0
-1 0 0
0 -1 0
3 0 1 2
3 0 2 3
3 0 3 4
3 0 4 1
"""

# Runs the program, but dies as if memory were exhausted.
WRAPPER = """#!/bin/sh
case $1 in */killed.off) kill -KILL $$ ;; esac
exec "{program}" "$@"
"""


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.meshes, self.output = self.folder / "all scans", self.folder / "smooth"
        self.meshes.mkdir()
        (self.meshes / "sub").mkdir()
        for name, height in (("1.off", 1), ("sub/two words.OFF", 2), ("killed.off", 3)):
            (self.meshes / name).write_text(MESH.format(height=height), encoding="ascii")

    @contextlib.contextmanager
    def workers(self, program, megabytes):
        """Yields the command that gives the folders to two workers, which have this memory together."""
        path = os.environ["PATH"]
        if program.parent != SCRIPT.parent:  # else the script finds the program beside itself
            path = f"{program.parent}{os.pathsep}{path}"
        variables = {"PATH": path, "WORKERS": "2", "MEMORY": str(megabytes)}
        with unittest.mock.patch.dict(os.environ, variables):
            if SCRIPT.suffix != ".py":
                yield [SCRIPT]
                return
            with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None,
                                          memory_limit=megabytes * 500000) as cluster:
                yield [sys.executable, SCRIPT, cluster.scheduler_address]

    def smooth(self, *options, command=(), program=None, megabytes=2000, output=None):
        """Returns the exit code and the messages. `self.counts` is what the command says at its end."""
        with self.workers(program or PROGRAM, megabytes) as script:
            done = subprocess.run([*script, self.meshes, output or self.output, *command, *OPTIONS, *options],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=100)
        self.counts = done.stdout
        return done.returncode, done.stderr

    def outputs(self):
        """Returns the meshes by name. Each must have a report."""
        found = {str(path.relative_to(self.output)): path for path in self.output.rglob("*") if path.is_file()}
        reports = {name for name in found if name.endswith(".json")}
        self.assertEqual({f"{name}.json" for name in found.keys() - reports}, reports)
        return {name: (found[name].stat().st_ino, found[name].read_bytes()) for name in found.keys() - reports}

    def test_a_second_run_makes_what_has_failed(self):
        wrapper = self.folder / "bin" / "tracked_mcf"
        wrapper.parent.mkdir()
        wrapper.write_text(WRAPPER.format(program=PROGRAM), encoding="utf-8")
        wrapper.chmod(0o755)
        (self.meshes / "broken.off").write_text("no mesh", encoding="ascii")
        (self.meshes / "notes.txt").write_text("no mesh", encoding="ascii")
        code, messages = self.smooth(program=wrapper)
        self.assertEqual(code, 1, messages)
        self.assertRegex(messages, r"(?m)^broken.off: tracked_mcf: .*broken.off cannot be used.* \(failed, exit code 1\)$")
        self.assertRegex(messages, r"(?m)^killed.off:  \(failed, exit code (137|-9)\)$")
        first = self.outputs()
        self.assertEqual(set(first), {"1.off", "sub/two words.OFF"}, messages)
        self.assertEqual(self.counts, "2 done, 0 there already, 2 failed\n")

        (self.meshes / "broken.off").write_text(MESH.format(height=4), encoding="ascii")
        code, messages = self.smooth()
        self.assertEqual(code, 0, messages)
        second = self.outputs()
        self.assertEqual(set(second), {*first, "broken.off", "killed.off"})
        self.assertEqual(self.counts, "2 done, 2 there already, 0 failed\n")
        self.assertEqual({name: second[name] for name in first}, first)
        for name, (_, data) in second.items():
            subprocess.run([PROGRAM, self.meshes / name, self.folder / "expected.off", "--quiet", *OPTIONS], check=True)
            self.assertEqual(data, (self.folder / "expected.off").read_bytes())

    def test_removes_noise(self):
        code, messages = self.smooth(command=["remove-noise"])
        self.assertEqual(code, 0, messages)
        for name, (_, data) in self.outputs().items():
            subprocess.run([PROGRAM, "remove-noise", self.meshes / name, self.folder / "expected.off", "--quiet", *OPTIONS],
                           check=True)
            self.assertEqual(data, (self.folder / "expected.off").read_bytes())
        self.assertEqual(len(self.outputs()), 3)

    def test_leaves_out_an_output_that_lies_among_the_meshes(self):
        self.output = self.meshes / "smooth"
        for _ in range(2):
            code, messages = self.smooth()
            self.assertEqual(code, 0, messages)
            self.assertEqual(set(self.outputs()), {"1.off", "sub/two words.OFF", "killed.off"})

    def test_each_worker_has_its_share_of_the_memory(self):
        """A flow at depth 10 needs more than 2 GB."""
        code, messages = self.smooth("--method", "paper", "--depth", "10", megabytes=1000)
        self.assertEqual(code, 1, messages)
        self.assertEqual(len(re.findall("(?m)^.*: tracked_mcf: Depth 10 of the paper's method would need .* Choose a smaller depth", messages)), 3)
        self.assertEqual(self.outputs(), {})

    def test_a_folder_without_meshes_is_an_error(self):
        self.meshes = self.folder / "none"
        self.meshes.mkdir()
        self.assertEqual(self.smooth()[0], 1)
        self.assertIn("there is no mesh in", self.smooth()[1])
        self.meshes = self.folder / "all scans" / "1.off"
        code, messages = self.smooth()
        self.assertEqual(code, 1)
        self.assertIn("is no folder", messages)

    def test_takes_any_name_and_what_links_lead_to(self):
        self.meshes = self.meshes.rename(self.folder / "{} $x")
        (self.meshes / "2.off").symlink_to(self.meshes / "1.off")
        code, messages = self.smooth()
        self.assertEqual(code, 0, messages)
        self.assertEqual(set(self.outputs()), {"1.off", "2.off", "sub/two words.OFF", "killed.off"})

    def test_an_unknown_option_is_named_once(self):
        code, messages = self.smooth("--detial", "3")
        self.assertNotEqual(code, 0)
        self.assertEqual(messages.count("--detial"), 1 if SCRIPT.suffix != ".py" else 3)

    def test_refuses_to_write_into_the_folder_of_the_meshes(self):
        code, messages = self.smooth(output=self.meshes)
        self.assertEqual(code, 1, messages)
        self.assertIn("INPUT and OUTPUT are the same folder", messages)


if __name__ == "__main__":
    PROGRAM, SCRIPT = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    unittest.main(argv=sys.argv[:1], verbosity=2)
