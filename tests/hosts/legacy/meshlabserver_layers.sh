#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the filter in meshlabserver with two layers. The filter must smooth the current one, which was
# opened last, as if it were alone, and leave the other as it is:
# meshlabserver_layers.sh PREFIX MESH OTHER_MESH WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 mesh=$2 other=$3 work=$4
rm -rf "$work"
mkdir -p "$work"
cd "$work"
"$here/flow_script.sh" depth=5 quality=1 > smooth.mlx
meshlab() { "$prefix/bin/meshlabserver" "$@" > log.txt 2>&1 || { cat log.txt && exit 1; }; }
for name in mesh other; do
    meshlab -i "${!name}" -o "$name.ply" -m vq
    meshlab -i "${!name}" -s smooth.mlx -o "$name-alone.ply" -m vq
    ! cmp -s "$name.ply" "$name-alone.ply"
done
meshlab -i "$mesh" -i "$other" -s smooth.mlx -o first.ply -l 0 -m vq -o second.ply -l 1 -m vq
cmp first.ply mesh.ply
cmp second.ply other-alone.ply
meshlab -i "$other" -i "$mesh" -s smooth.mlx -o first.ply -l 0 -m vq -o second.ply -l 1 -m vq
cmp first.ply other.ply
cmp second.ply mesh-alone.ply
