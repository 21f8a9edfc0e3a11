#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the notebook of the Python package in a new kernel, and checks what it shows: notebook_test.py NOTEBOOK MESH

Ends with 77, which tells CTest that the test was skipped, where a package is not installed.
"""

import base64
import importlib.util
import io
import os
import re
import sys
import tempfile
import unittest

for package in ("tracked_mcf", "trimesh", "matplotlib", "nbclient", "ipykernel"):
    if not importlib.util.find_spec(package):
        print(f"skipped: {sys.executable} has no {package}; "
              "external/python_package.sh installs tracked_mcf, pip the others")
        sys.exit(77)

import jupyter_client
import matplotlib.image
import nbclient
import nbformat


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        cls.kept = [cell.outputs for cell in notebook.cells if cell.cell_type == "code"]
        os.environ["SCAN"] = os.path.abspath(MESH)
        with tempfile.TemporaryDirectory() as folder:
            # Without folders of kernels, the kernel is this Python.
            kernels = jupyter_client.kernelspec.KernelSpecManager(kernel_dirs=[])
            kernel = jupyter_client.AsyncKernelManager(kernel_name="python3", kernel_spec_manager=kernels)
            client = nbclient.NotebookClient(notebook, km=kernel, timeout=300,
                                             resources={"metadata": {"path": folder}})
            # An exception in a cell raises CellExecutionError. cleanup_kc ends the kernel.
            client.execute(cleanup_kc=True)
        cls.outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]

    def numbers_after(self, label):
        text = "".join(output.get("text", "") for output in self.outputs)
        [line] = re.findall(f"^{label}: (.*)$", text, re.MULTILINE)
        return [float(number) for number in re.findall(r"\d+\.\d+", line)]

    def test_is_kept_without_outputs(self):
        self.assertGreater(len(self.kept), 0)
        self.assertEqual([outputs for outputs in self.kept if outputs], [])

    def test_warns_of_nothing(self):
        self.assertEqual([output.text for output in self.outputs if output.get("name") == "stderr"], [])

    def test_measures_the_noise(self):
        measured, added = self.numbers_after("noise")
        self.assertAlmostEqual(measured, added, delta=0.02)

    def test_removes_the_noise(self):
        before, after = self.numbers_after("error of the normals")
        self.assertGreater(before, 20)
        self.assertLess(after, 10)
        before, after, scan = self.numbers_after("area")
        self.assertGreater(before, 1.05 * scan)
        self.assertAlmostEqual(after, scan, delta=0.01 * scan)

    def test_draws_three_surfaces_and_a_curve(self):
        [picture] = [output.data["image/png"] for output in self.outputs if "image/png" in output.get("data", {})]
        pixels = matplotlib.image.imread(io.BytesIO(base64.b64decode(picture)))
        drawn = (pixels[:, :, :3] < 0.99).any(axis=2)
        quarter = drawn.shape[1] // 4
        before, after, curve, curvature = (drawn[:, i * quarter:(i + 1) * quarter].mean() for i in range(4))
        self.assertGreater(min(before, after, curvature), 0.1)
        self.assertGreater(curve, 0.01)
        colors = pixels[:, 3 * quarter:, :3]
        for channel in 0, 2:  # convex parts are red, concave ones blue
            self.assertGreater((colors[:, :, channel] > 1.3 * colors[:, :, 2 - channel]).mean(), 0.01)


if __name__ == "__main__":
    NOTEBOOK, MESH = sys.argv[1:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
