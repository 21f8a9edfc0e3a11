#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# README's test command: installs what is needed, builds everything into build/, and runs all tests:
# run.sh [-DOPTION=VALUE]... [ARGUMENT]...
#
# Options go to CMake, arguments to ctest, such as -L unit. -DTRACKED_MCF_OTHER_HOSTS=ON adds the
# tests in double precision, which need PyMeshLab's MeshLab, and, as root, those on other Debians.
set -euo pipefail
cd "$(dirname "$0")/.."

options=() arguments=()
for word in "$@"; do
    case $word in
        -D*=*) options+=("$word") ;;
        *) arguments+=("$word") ;;
    esac
done
external/install_debian.sh tests
external/cgal_meshes.sh build/cgal-meshes
external/meshlab_source.sh build/meshlab-source
cmake -S . -B build -DTRACKED_MCF_TOOL=ON -DTRACKED_MCF_PLUGIN=ON -DTRACKED_MCF_TESTS=ON \
    "-DTRACKED_MCF_PYTHON=$PWD/build/python/bin/python" "${options[@]}"
cmake --build build -j "$(nproc)"
external/python_package.sh build/python build
# README's script and the tests need them. PyVista takes VTK with it, 110 MB.
build/python/bin/python -m pip install -q trimesh meshio pyvista
# One more than processors: tests of windows wait for a part of their time.
ctest --test-dir build --output-on-failure -j $(($(nproc) + 1)) "${arguments[@]}"
# ctest does not tell why a test was skipped.
grep -h '^skipped: ' build/Testing/Temporary/LastTest.log || true
