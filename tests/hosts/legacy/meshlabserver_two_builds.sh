#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the filter in a meshlabserver that finds two builds of the plugin, in either order of their
# names. The result must be that of one build: meshlabserver_two_builds.sh PREFIX MESH WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 mesh=$2 work=$3
rm -rf "$work"
mkdir -p "$work"
"$here/flow_script.sh" depth=5 > "$work/smooth.mlx"
smooth() { # PREFIX OUT
    "$1/bin/meshlabserver" -i "$mesh" -s "$work/smooth.mlx" -o "$work/$2.ply" > "$work/log.txt" 2>&1 || {
        cat "$work/log.txt"
        exit 1
    }
    [ "$(grep -c "^LOG.*Smoothed" "$work/log.txt")" = 1 ]
}
smooth "$prefix" one
for other in libfilter_tracked_mcf-0.9.so libfilter_tracked_mcf_old.so; do
    rm -rf "$work/prefix"
    cp -a "$prefix" "$work/prefix"
    plugin=$(find "$work/prefix" -name libfilter_tracked_mcf.so)
    cp -L "$plugin" "$(dirname "$plugin")/$other"
    smooth "$work/prefix" two
    cmp "$work/one.ply" "$work/two.ply"
done
