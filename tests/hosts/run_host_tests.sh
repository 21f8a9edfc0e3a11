#!/usr/bin/env bash
# Builds the plugin for a MeshLab, and what tests it there, and runs these tests:
# run_host_tests.sh BUILD_DIR [CMAKE_OPTION]...
#
# For hosts besides the one that the caller's own build is for: another Debian's, or PyMeshLab's.
set -euo pipefail

root=$(realpath "$(dirname "$0")/../..")
build=$1
cmake -S "$root" -B "$build" -DTRACKED_MCF_OTHER_HOSTS=OFF "${@:2}"
cmake --build "$build" -j "$(nproc)" --target host_tests
ctest --test-dir "$build" --output-on-failure -L hosts
# Why, where a test was skipped: ctest itself does not tell.
grep -h '^skipped: ' "$build/Testing/Temporary/LastTest.log" || true
