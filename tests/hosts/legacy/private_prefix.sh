#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a private MeshLab with the plugin, and does not change the installed MeshLab:
# private_prefix.sh PREFIX MESHLAB_PLUGIN_DIR PLUGIN
#
# MeshLab looks for plugins relative to its program. So the script copies the programs and links
# everything else.
set -euo pipefail

prefix=$1 plugin_dir=$2 plugin=$(realpath "$3")
programs=$(dirname "$(command -v meshlabserver)")
inside=${plugin_dir#"$(dirname "$programs")/"}

rm -rf "$prefix"
mkdir -p "$prefix/bin" "$prefix/$inside"
cp "$programs/meshlab" "$programs/meshlabserver" "$prefix/bin/"
ln -s "$(dirname "$plugin_dir")"/*.so "$(dirname "$prefix/$inside")/"
ln -s "$plugin_dir"/*.so "$prefix/$inside/"
ln -sf "$plugin" "$prefix/$inside/"
