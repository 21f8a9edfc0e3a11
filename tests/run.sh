#!/usr/bin/env bash
# README's second command: installs what is needed, builds everything into build/, and runs all
# tests: run.sh [arguments for ctest, such as -L unit]
set -euo pipefail
cd "$(dirname "$0")/.."

external/install_debian.sh tests
external/cgal_meshes.sh build/cgal-meshes
cmake -S . -B build -DTRACKED_MCF_TOOL=ON -DTRACKED_MCF_PLUGIN=ON -DTRACKED_MCF_TESTS=ON
cmake --build build -j "$(nproc)"
ctest --test-dir build --output-on-failure "$@"
# Why, where a test was skipped: ctest itself does not tell.
grep -h '^skipped: ' build/Testing/Temporary/LastTest.log || true
tests/hosts/host_table.py build
