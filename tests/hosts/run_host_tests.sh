#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the plugin for a MeshLab and its host tests, and runs the tests:
# run_host_tests.sh BUILD_DIR [CMAKE_OPTION]...
#
# This is for hosts other than the main build's: another Debian's MeshLab, or PyMeshLab's.
set -euo pipefail

root=$(realpath "$(dirname "$0")/../..")
build=$1
cmake -S "$root" -B "$build" -DTRACKED_MCF_OTHER_HOSTS=OFF "${@:2}"
cmake --build "$build" -j "$(nproc)" --target host_tests
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -L hosts
# ctest does not tell why a test was skipped.
grep -h '^skipped: ' "$build/Testing/Temporary/LastTest.log" || true
