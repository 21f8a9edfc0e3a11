# SPDX-License-Identifier: GPL-3.0-or-later
"""pip's build backend: scikit-build-core, whose sdist also gets the core and the CMake files, which lie outside of this folder."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from scikit_build_core import build as _backend
from scikit_build_core.build import *  # noqa: F401,F403

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[2]
INSIDE = HERE.relative_to(TOP).as_posix()  # of an sdist, as of a clone

# What the package is not built from.
LEFT_OUT = ["pictures", "meshlab", "bridge", "cli", "*.ipynb", "__pycache__"]


def _version():
    done = subprocess.run(["cmake", "-P", HERE / "print_version.cmake"], check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def _replaced(text, *rules):
    for pattern, replacement in rules:
        text, count = re.subn(pattern, replacement, text, flags=re.MULTILINE | re.DOTALL)
        if count != 1:
            raise ValueError(f"pyproject.toml or version.cmake has not one {pattern!r}")
    return text


def build_sdist(sdist_directory, config_settings=None):
    """Builds the sdist in a copy of the project, whose pyproject.toml is on top and states the version."""
    version = _version()
    with tempfile.TemporaryDirectory() as name:
        copy = pathlib.Path(name)
        shutil.copy(TOP / "CMakeLists.txt", copy)
        for folder in "external", "filter_tracked_mcf":
            shutil.copytree(TOP / folder, copy / folder, ignore=shutil.ignore_patterns(*LEFT_OUT))
        project = _replaced((HERE / "pyproject.toml").read_text(encoding="utf-8"),
                            (r'^build-backend = "backend"\nbackend-path = \["\."\]$',
                             'build-backend = "scikit_build_core.build"'),
                            (r'^dynamic = \["version"\]$', f'version = "{version}"'),
                            (r'^readme = "', f'readme = "{INSIDE}/'),
                            (r'^cmake\.source-dir = "\.\./\.\./\.\."$', 'cmake.source-dir = "."'),
                            (r'^wheel\.packages = \["', f'wheel.packages = ["{INSIDE}/'),
                            (r'^# The version counts.*$', ""))
        (copy / "pyproject.toml").write_text(project, encoding="utf-8")
        numbers = copy / "filter_tracked_mcf" / "version.cmake"
        numbers.write_text(_replaced(numbers.read_text(encoding="utf-8"),
                                     (r"^set\(TRACKED_MCF_VERSION [\d.]+\)$", f"set(TRACKED_MCF_VERSION {version})")),
                           encoding="utf-8")
        readme = copy / INSIDE / "README.md"  # PyPI shows it, where links to other pages would be dead
        readme.write_text(re.sub(r"\[([^]]+)\]\((?!https?:)[^)]*\)", r"\1", readme.read_text(encoding="utf-8")), encoding="utf-8")
        (copy / INSIDE / "pyproject.toml").unlink()
        here = pathlib.Path.cwd()
        try:
            os.chdir(copy)
            return _backend.build_sdist(str(here / sdist_directory), config_settings)
        finally:
            os.chdir(here)
