#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Reproduces the paper's evaluation, in under two hours on two cores: reproduce_paper.sh [OPTION]...
#
# Installs what is needed, builds, runs the scripts of tests/research/experiments/paper with these options, such as
# --meshes FOLDER or --quick, and writes their pages with tables, plots and pictures into build/experiments.
# --output tests/research/experiments/results replaces the kept pages. Exits with 1 if a script's check failed.
set -euo pipefail
cd "$(dirname "$0")/../.."

external/install_debian.sh experiments benchmark
external/cgal_meshes.sh build/cgal-meshes
external/gravomg.sh build/gravomg ||
    echo "reproduce_paper.sh: Gravo MG could not be installed and is left out." >&2
cmake -S . -B build -DTRACKED_MCF_PLUGIN=OFF -DTRACKED_MCF_TESTS=ON -DTRACKED_MCF_BENCHMARK=ON
cmake --build build -j "$(nproc)" --target tracked_mcf_experiments tracked_mcf_benchmark

failed=()
for script in tests/research/experiments/paper/{table,error,figure}*.py; do
    "$script" "$@" || failed+=("$script")
done
[ ${#failed[@]} = 0 ] || { echo "reproduce_paper.sh: failed: ${failed[*]}" >&2 && exit 1; }
