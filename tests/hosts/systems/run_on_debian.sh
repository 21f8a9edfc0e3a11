#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Does on another Debian what a user would do there: installs what is needed, builds the plugin for that
# Debian's MeshLab, and runs the host tests: run_on_debian.sh SUITE FOLDER CGAL_MESHES
#
# FOLDER keeps the system and the build, so that only the first run takes long. Exits with 77 if this
# machine cannot install another Debian.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
suite=$1 folder=$(realpath -m "$2") cgal_meshes=$(realpath "$3")
"$here/lay_system.sh" "$suite" "$folder/system"

mkdir -p "$folder/plugin"
cd "$folder/plugin"
inside() { "$here/in_system.sh" -r "$cgal_meshes" "$folder/system" "$@"; }
inside "$here/../../../external/install_debian.sh" tests
inside "$here/../../../external/meshlab_source.sh" meshlab-source
options=(-DTRACKED_MCF_CGAL_MESHES="$cgal_meshes")
# MeshLab 2022.02 with the plugin in its tree. The tests in double precision have 2025.07's.
if [ "$suite" = trixie ]; then
    inside "$here/../build_meshlab.sh" meshlab-source meshlab float
    options+=(-DTRACKED_MCF_PLUGIN_OF_MESHLAB="$PWD/meshlab/src/distrib/plugins/libfilter_tracked_mcf.so")
fi
inside "$here/../run_host_tests.sh" "$folder/plugin" "${options[@]}"
