#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests .ci/check_spdx: it fails for each kind of file without a licence line, and adds the lines."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / ".ci" / "check_spdx"
LINE = "SPDX-License-Identifier: GPL-3.0-or-later"

FILES = ["a.cpp", "a.h", "a.inc", "a.sh", "a.py", "a.cmake", "CMakeLists.txt", "Containerfile", ".ci/run"]


class CheckSpdx(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        (self.top / ".ci").mkdir()

    def check(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *arguments], cwd=self.top, text=True,
                              check=False, stderr=subprocess.PIPE)

    def test_fails_for_each_kind_of_file_without_the_line(self):
        for name in FILES:
            with self.subTest(name=name):
                (self.top / name).write_text("first\nsecond\nthird\n// " + LINE + "\n")
                result = self.check(name)
                self.assertEqual(result.returncode, 1)
                self.assertIn(f"{name}: no ", result.stderr)

    def test_fails_for_another_licence(self):
        (self.top / "a.h").write_text("// " + LINE.replace("GPL-3.0", "LGPL-3.0") + "\n")
        self.assertEqual(self.check("a.h").returncode, 1)

    def test_ignores_other_files(self):
        (self.top / "a.md").write_text("words\n")
        (self.top / "a.h").write_text("// " + LINE + "\n")
        self.assertEqual(self.check("a.md", "a.h").returncode, 0)

    def test_fails_without_files(self):
        (self.top / "a.md").write_text("words\n")
        self.assertEqual(self.check("a.md").returncode, 2)

    def test_adds_the_line_once(self):
        for name in FILES:
            (self.top / name).write_text("#!/bin/sh\nwords\n" if name == "a.sh" else "words\n")
        for _ in range(2):
            self.assertEqual(self.check("--add", *FILES).returncode, 0)
            self.assertEqual(self.check(*FILES).returncode, 0)
        self.assertEqual((self.top / "a.h").read_text(), f"// {LINE}\nwords\n")
        self.assertEqual((self.top / "CMakeLists.txt").read_text(), f"# {LINE}\nwords\n")
        self.assertEqual((self.top / "a.sh").read_text(), f"#!/bin/sh\n# {LINE}\nwords\n")


if __name__ == "__main__":
    unittest.main()
