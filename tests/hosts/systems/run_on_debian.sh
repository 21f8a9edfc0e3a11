#!/usr/bin/env bash
# Does on another Debian what a person there would: installs what is needed, builds the plugin for its
# MeshLab, and runs the host tests in that: run_on_debian.sh SUITE FOLDER CGAL_MESHES SHARED_MESHES
#
# FOLDER keeps the system and the build, so that only the first time takes long. Ends with exit code
# 77 where no system can be laid.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
suite=$1 folder=$(realpath -m "$2") cgal_meshes=$3 shared_meshes=$4
"$here/lay_system.sh" "$suite" "$folder/system"

readable=(-r "$cgal_meshes")
[ ! -d "$shared_meshes" ] || readable+=(-r "$shared_meshes")
mkdir -p "$folder/build"
cd "$folder/build"
inside() { "$here/in_system.sh" "${readable[@]}" "$folder/system" "$@"; }
inside "$here/../../../external/install_debian.sh" tests
inside "$here/../run_host_tests.sh" "$folder/build" -DTRACKED_MCF_CGAL_MESHES="$cgal_meshes" \
    -DTRACKED_MCF_SHARED_MESHES="$shared_meshes"
