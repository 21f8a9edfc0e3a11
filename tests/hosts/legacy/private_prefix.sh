#!/usr/bin/env bash
# Lays out a MeshLab of one's own that has the plugin, without touching the one that is installed:
# private_prefix.sh PREFIX MESHLAB_PLUGIN_DIR PLUGIN
#
# MeshLab looks for plugins relative to the place of its program alone, so the programs are copied
# and everything else is linked.
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
