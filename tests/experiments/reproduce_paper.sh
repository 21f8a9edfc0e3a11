#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Reproduces the paper's evaluation, in under two hours on two cores: reproduce_paper.sh [OPTION]...
#
# Installs what is needed, builds, runs the scripts of tests/experiments/paper with these options, such as
# --meshes FOLDER or --quick, and writes their tables, plots and pictures into tests/experiments/results,
# with a page that shows them. Exits with 1 if a script's check failed.
set -euo pipefail
cd "$(dirname "$0")/../.."

external/install_debian.sh experiments benchmark
external/cgal_meshes.sh build/cgal-meshes
external/gravomg.sh build/gravomg ||
    echo "reproduce_paper.sh: Gravo MG could not be installed and is left out." >&2
cmake -S . -B build -DTRACKED_MCF_PLUGIN=OFF -DTRACKED_MCF_BENCHMARK=ON
cmake --build build -j "$(nproc)" --target tracked_mcf_experiments tracked_mcf_benchmark

results=$PWD/tests/experiments/results
mkdir -p "$results"
failed=()
# The scripts that measure time run first: only they need an otherwise idle machine.
for script in tests/experiments/paper/{table,error,kappa,figure}*.py; do
    "$script" --output "$results" "$@" || failed+=("$script")
done

{
    echo "# The paper's evaluation, reproduced"
    echo
    echo "Written by [reproduce_paper.sh](../reproduce_paper.sh). Commit $(git rev-parse --short=12 HEAD)," \
        "$(date +%F), $(nproc) cores, $(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -n 1)."
    printf '\n%s\n\n' "The paper's claims:"
    sed -n '/^- \*\*\(holds\|does not hold\)\*\*/p' "$results"/{figure,table}*.md
    for page in "$results"/{figure,table,error,kappa}*.md; do
        printf '\n'
        sed 's/^# /## /' "$page"
        rm "$page"
    done
} > "$results/README.md"
[ ${#failed[@]} = 0 ] || { echo "reproduce_paper.sh: failed: ${failed[*]}" >&2 && exit 1; }
