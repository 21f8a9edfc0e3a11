#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Configures where nothing can be fetched: without MeshLab's sources, which must stop with the command that
# fetches them; with sources where that command puts them; and with sources elsewhere. Then does what the pages say
# one after the other in one build folder: a build without a plugin makes no package.
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
pages=("$root"/README.md "$root"/filter_tracked_mcf/package/README.md "$root"/README.md)
while read -ra options; do
    configure "${options[@]}" || fail "cannot configure as the pages say: ${options[*]}"
    [[ ${options[*]} = *PLUGIN=OFF* ]] || continue
    (cd "$build" && cpack -G DEB > "$work/log.txt" 2>&1) && fail "cpack packs a build without a plugin"
    grep -q -- "-DTRACKED_MCF_PLUGIN=ON" "$work/log.txt" || fail "cpack does not say what to do"
done < <(sed -n 's/^cmake -S \. -B build \([^&#]*\).*/\1/p' "${pages[@]}")
# The version counts the clone's commits.
if grep -vE '^git -C [^ ]+ (describe|log|rev-list) ' "$work/calls.txt"; then fail "configuring ran something that may fetch"; fi
echo "configuring ran nothing that fetches"
