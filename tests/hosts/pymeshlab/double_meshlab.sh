#!/usr/bin/env bash
# Builds as much of MeshLab in double precision as a host of PyMeshLab's plugins needs, from the
# sources of MeshLab 2025.07: double_meshlab.sh SOURCE_DIR BUILD_DIR
#
#   BUILD_DIR/lib/libmeshlab-common.so           what plugins link, of version 2025.07d
#   BUILD_DIR/lib/plugins/libio_base.so          reads and writes PLY, OBJ, OFF and STL
#   BUILD_DIR/lib/plugins/libfilter_unsharp.so   MeshLab's own smoothers, to compare with
#
# PyMeshLab's MeshLab computes with doubles, Debian's with floats, and neither loads the other's
# plugins.
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

# A unity build takes a third of the time. Batches of eleven keep the two sources apart that include
# GLExtensionsManager.h, which has no include guard.
unity=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=11)
# The source package leaves out libraries that MeshLab would download: optional ones are not looked
# for in a mini build.
parts=(-DMESHLAB_BUILD_MINI=ON -DMESHLAB_BUILD_ONLY_LIBRARIES=ON
    "-DMESHLAB_PLUGINS=meshlabplugins/io_base;meshlabplugins/filter_unsharp")
# MeshLab's CMake wants the folders for installing too, though nothing is installed.
folders=(-DMESHLAB_USE_DEFAULT_BUILD_AND_INSTALL_DIRS=OFF
    -DMESHLAB_LIB_OUTPUT_DIR="$build/lib" -DMESHLAB_PLUGIN_OUTPUT_DIR="$build/lib/plugins"
    -DMESHLAB_LIB_INSTALL_DIR=lib -DMESHLAB_PLUGIN_INSTALL_DIR=lib/plugins)

cmake -S "$source_dir" -B "$build/objects" -DMESHLAB_BUILD_WITH_DOUBLE_SCALAR=ON \
    -DCMAKE_CXX_FLAGS=-w "${unity[@]}" "${parts[@]}" "${folders[@]}"
cmake --build "$build/objects" -j "$(nproc)" --target meshlab-common io_base filter_unsharp
touch "$stamp"
