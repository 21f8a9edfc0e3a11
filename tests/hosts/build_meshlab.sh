#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds parts of MeshLab by MeshLab's own CMake, with the plugin in MeshLab's tree:
# build_meshlab.sh SOURCE_DIR BUILD_DIR float|double [PLUGIN]...
#
#   BUILD_DIR/src/distrib/libmeshlab-common.so             the library that plugins link
#   BUILD_DIR/src/distrib/plugins/libfilter_tracked_mcf.so our plugin
#   BUILD_DIR/src/distrib/plugins/libPLUGIN.so             each PLUGIN of MeshLab, such as io_base
#
# SOURCE_DIR holds the sources of MeshLab 2022.02 or 2025.07. It gets a link to filter_tracked_mcf, and
# a header of it an include guard.
set -euo pipefail

root=$(realpath "$(dirname "$0")/../..")
source_dir=$1 build=$2 precision=$3 plugins=(filter_tracked_mcf "${@:4}")

ln -sfn "$root/filter_tracked_mcf" "$source_dir/src/meshlabplugins/filter_tracked_mcf"

# A unity build takes a third of the time, but needs include guards.
header=$source_dir/src/common/GLExtensionsManager.h
grep -q '#pragma once' "$header" || sed -i '1i #pragma once' "$header"

# The source package lacks libraries that MeshLab would download. A mini build does not look for
# optional libraries.
release=$(cat "$source_dir/ML_VERSION")
case $release in
    2022.02)
        folders=(-S "$source_dir/src" -B "$build/src")
        on=(BUILD_MESHLAB_MINI BUILD_ONLY_MESHLAB_LIBRARIES) double=BUILD_WITH_DOUBLE_SCALAR
        ;;
    2025.07)
        folders=(-S "$source_dir" -B "$build")
        on=(MESHLAB_BUILD_MINI MESHLAB_BUILD_ONLY_LIBRARIES) double=MESHLAB_BUILD_WITH_DOUBLE_SCALAR
        ;;
    *) echo "build_meshlab.sh: $source_dir holds MeshLab $release" >&2 && exit 1 ;;
esac
[ "$precision" = float ] || on+=("$double")
on=("${on[@]/#/-D}")
printf -v plugin_folders 'meshlabplugins/%s;' "${plugins[@]}"

cmake "${folders[@]}" "${on[@]/%/=ON}" \
    "-DMESHLAB_PLUGINS=$plugin_folders" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-w \
    -DCMAKE_UNITY_BUILD=ON
cmake --build "${folders[3]}" -j "$(nproc)" --target meshlab-common "${plugins[@]}"
