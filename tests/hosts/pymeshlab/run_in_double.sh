#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds MeshLab in double precision and runs the host tests in it:
# run_in_double.sh BUILD_DIR [CMAKE_OPTION]...
#
# MeshLab uses doubles in PyMeshLab and floats elsewhere. Neither loads the other's plugins. The tests
# include the official PyMeshLab, which is installed once. Without a network they are skipped.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
build=$(realpath -m "$1")
external=$here/../../../external
python=$build/python/bin/python
"$external/pymeshlab.sh" "$build/python" || python=/usr/bin/python3
"$external/meshlab_source.sh" "$build/meshlab-source" 2025.07
"$here/../build_meshlab.sh" "$build/meshlab-source" "$build/meshlab" double io_base
library=$build/meshlab/src/distrib
"$here/../run_host_tests.sh" "$build/plugin" -DMESHLAB_SCALAR=double \
    -DMESHLAB_SOURCE_DIR="$build/meshlab-source" -DTRACKED_MCF_PYTHON="$python" \
    -DMESHLAB_COMMON_LIBRARY="$library/libmeshlab-common.so" \
    -DTRACKED_MCF_PLUGIN_OF_MESHLAB="$library/plugins/libfilter_tracked_mcf.so" "${@:2}"
