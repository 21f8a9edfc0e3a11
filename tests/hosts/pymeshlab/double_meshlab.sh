#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the parts of MeshLab 2025.07 that load PyMeshLab's plugins, in double precision:
# double_meshlab.sh SOURCE_DIR BUILD_DIR
#
#   BUILD_DIR/lib/libmeshlab-common.so           the library that plugins link, version 2025.07d
#   BUILD_DIR/lib/plugins/libio_base.so          reads and writes PLY, OBJ, OFF and STL
#   BUILD_DIR/lib/plugins/libfilter_unsharp.so   MeshLab's own smoothers, to compare with
#
# PyMeshLab's MeshLab uses doubles and Debian's uses floats. Neither loads the other's plugins.
set -euo pipefail

source_dir=${1:?usage: double_meshlab.sh SOURCE_DIR BUILD_DIR}
build=$(realpath -m "${2:?usage: double_meshlab.sh SOURCE_DIR BUILD_DIR}")
stamp="$build/.complete"
if [ -e "$stamp" ]; then
    exit 0
fi
release=$(cat "$source_dir/ML_VERSION")
[ "$release" = 2025.07 ] || {
    echo "double_meshlab.sh: $source_dir holds MeshLab $release, not 2025.07" >&2
    exit 1
}

# A unity build takes a third of the time. GLExtensionsManager.h has no include guard; batches of eleven
# separate the two sources that include it.
unity=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=11)
# The source package lacks libraries that MeshLab would download. A mini build does not look for
# optional libraries.
parts=(-DMESHLAB_BUILD_MINI=ON -DMESHLAB_BUILD_ONLY_LIBRARIES=ON
    "-DMESHLAB_PLUGINS=meshlabplugins/io_base;meshlabplugins/filter_unsharp")
# MeshLab's CMake requires the installation folders, although nothing is installed.
folders=(-DMESHLAB_USE_DEFAULT_BUILD_AND_INSTALL_DIRS=OFF
    -DMESHLAB_LIB_OUTPUT_DIR="$build/lib" -DMESHLAB_PLUGIN_OUTPUT_DIR="$build/lib/plugins"
    -DMESHLAB_LIB_INSTALL_DIR=lib -DMESHLAB_PLUGIN_INSTALL_DIR=lib/plugins)

cmake -S "$source_dir" -B "$build/objects" -DMESHLAB_BUILD_WITH_DOUBLE_SCALAR=ON \
    -DCMAKE_CXX_FLAGS=-w "${unity[@]}" "${parts[@]}" "${folders[@]}"
cmake --build "$build/objects" -j "$(nproc)" --target meshlab-common io_base filter_unsharp
touch "$stamp"
