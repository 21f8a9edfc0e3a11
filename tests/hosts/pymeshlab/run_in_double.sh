#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds MeshLab in double precision and runs the host tests in it:
# run_in_double.sh BUILD_DIR [CMAKE_OPTION]...
#
# The tests include PyMeshLab if this Python has it. No Debian package has PyMeshLab.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
build=$(realpath -m "$1")
"$here/../../../external/meshlab_source.sh" "$build/meshlab-source" 2025.07
"$here/double_meshlab.sh" "$build/meshlab-source" "$build/meshlab"
"$here/../run_host_tests.sh" "$build/plugin" -DMESHLAB_RELEASE=2025.07 -DMESHLAB_SCALAR=double \
    -DMESHLAB_SOURCE_DIR="$build/meshlab-source" \
    -DMESHLAB_COMMON_LIBRARY="$build/meshlab/lib/libmeshlab-common.so" "${@:2}"
