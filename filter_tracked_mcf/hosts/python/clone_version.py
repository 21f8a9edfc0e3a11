# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells scikit-build-core the version that CMake finds."""

import pathlib
import shutil
import subprocess

SCRIPT = pathlib.Path(__file__).resolve().parent / "print_version.cmake"


def dynamic_metadata(field, settings=None, project=None):
    return subprocess.run(["cmake", "-P", SCRIPT], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()


def get_requires_for_dynamic_metadata(settings=None):
    return ["cmake>=3.22"] if shutil.which("cmake") is None else []
