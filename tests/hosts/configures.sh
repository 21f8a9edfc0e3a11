#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Configures where nothing can be fetched: without MeshLab's sources, which must stop with the command that
# fetches them; with sources where that command puts them; and with sources elsewhere. Then does what the pages say
# one after the other in one build folder: each must find its targets, and a build without a plugin makes no package.
# configures.sh MESHLAB_SOURCE_DIR WORK_DIR
set -euo pipefail

root=$(realpath "$(dirname "$0")/../..")
sources=$(realpath "$1") work=$(realpath -m "$2")
build=$work/build
rm -rf "$work"
mkdir -p "$work/bin"
for name in apt apt-get curl git pip sudo wget; do
    printf '#!/bin/sh\necho "%s $*" >> "%s"\nexit 1\n' $name "$work/calls.txt" > "$work/bin/$name"
    chmod +x "$work/bin/$name"
done
export PATH=$work/bin:$PATH

fail() {
    cat "$work/log.txt"
    echo "FAILED: $*"
    exit 1
}
configure() { # CMAKE_OPTION...
    cmake -S "$root" -B "$build" -DTRACKED_MCF_OTHER_HOSTS=OFF "$@" > "$work/log.txt" 2>&1
}
! configure || fail "configures without MeshLab's sources"
read -r script folder < <(grep -E '^ +/.*meshlab_source\.sh /' "$work/log.txt") ||
    fail "does not say how to fetch MeshLab's sources"
[ "$script $folder" = "$root/external/meshlab_source.sh $build/meshlab-source" ] ||
    fail "says $script $folder"
configure -DTRACKED_MCF_PLUGIN=OFF || fail "needs MeshLab's sources without the plugin"
configure -DTRACKED_MCF_PLUGIN=ON "-DMESHLAB_SOURCE_DIR=$work" && fail "takes any folder for sources"
tr -s '\n ' ' ' < "$work/log.txt" | grep -q "holds no sources of MeshLab" || fail "the wrong message"

ln -s "$sources" "$folder"
configure -DMESHLAB_SOURCE_DIR= || fail "does not find the sources in $folder"
rm "$folder"
configure "-DMESHLAB_SOURCE_DIR=$sources" || fail "does not find the sources that it was given"
for page in README.md tests/research/experiments/README.md README.md tests/research/benchmark/README.md README.md; do
    read -ra options < <(sed -n 's/^cmake -S \. -B build \([^&#]*\).*/\1/p' "$root/$page")
    # CGAL and hypre need not be here. The target is the same without them.
    configure "${options[@]/BENCHMARK=ON/BENCHMARK=OFF}" || fail "cannot configure as $page says: ${options[*]}"
    cmake --build "$build" --target help > "$work/targets.txt"
    for target in $(sed -n 's/^cmake --build build .*--target //p' "$root/$page"); do
        grep -qw "$target" "$work/targets.txt" || fail "$page needs the target $target"
    done
    if [ "$page" != README.md ]; then
        (cd "$build" && cpack -G DEB > "$work/log.txt" 2>&1) && fail "cpack packs a build without a plugin"
        grep -q -- "-DTRACKED_MCF_PLUGIN=ON" "$work/log.txt" || fail "cpack does not say what to do"
    fi
done
# The version counts the clone's commits.
if grep -vE '^git -C [^ ]+ (log|rev-list) ' "$work/calls.txt"; then fail "configuring ran something that may fetch"; fi
echo "configuring ran nothing that fetches"
