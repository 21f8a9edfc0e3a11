#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Reproduces the paper's evaluation, in under two hours on two cores: reproduce_paper.sh [OPTION]...
#
# Installs what is needed, builds, runs the scripts of tests/research/experiments/paper with these options, such as
# --meshes FOLDER or --quick, and writes their pages with tables, plots and pictures into build/research/results.
# --output tests/research/experiments/results replaces the kept pages. Exits with 1 if a script's check failed.
set -euo pipefail
cd "$(dirname "$0")/../../.."

external/install_debian.sh research
external/cgal_meshes.sh build/cgal-meshes
cmake -S tests/research -B build/research -DTRACKED_MCF_CGAL=ON
cmake --build build/research -j "$(nproc)"

failed=()
for script in tests/research/experiments/paper/{table,error,figure}*.py; do
    "$script" "$@" || failed+=("$script")
done
[ ${#failed[@]} = 0 ] || { echo "reproduce_paper.sh: failed: ${failed[*]}" >&2 && exit 1; }
