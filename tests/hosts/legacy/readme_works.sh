#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Does what the README and the pages of the plugin and the tool say: the MeshLab script in stock
# meshlabserver, which must do what the tool does by default, and all commands of the tool:
# readme_works.sh PREFIX TOOL README CGAL_MESHES WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 tool=$2 readme=$3 meshes=$4 work=$5
pages=("$readme" "$(dirname "$readme")"/filter_tracked_mcf/{plugin,tool}/README.md)
rm -rf "$work"
mkdir -p "$work"

# The meshes of the README: a closed scan, one with a boundary, and one with a selection.
"$prefix/bin/meshlabserver" -i "$meshes/hand.off" -o "$work/scan.ply"
"$prefix/bin/meshlabserver" -i "$meshes/mannequin-devil.off" -o "$work/open.ply"
cat > "$work/select.mlx" << XML
<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Conditional Face Selection">
  <Param type="RichString" name="condSelect" value="fnz &gt; 0"/>
 </filter>
</FilterScript>
XML
"$prefix/bin/meshlabserver" -i "$meshes/hand.off" -s "$work/select.mlx" -o "$work/selected.ply" -m ff
cd "$work"

# The first script. Its page has one for each filter.
sed -n '/^```xml$/,/^```$/p' "${pages[@]}" | grep -v '^```' | sed '/<\/FilterScript>/q' > smooth.mlx
"$prefix/bin/meshlabserver" -i scan.ply -s smooth.mlx -o smooth.ply | grep "Smoothed"
"$tool" scan.ply tool.ply --quiet
"$here/../compare_positions.py" smooth.ply tool.ply scan.ply 0.5

commands=$(sed -n '/^```sh$/,/^```$/p' "${pages[@]}" | grep '^tracked_mcf ')
while read -r _ arguments; do
    echo "== tracked_mcf $arguments"
    read -ra words <<< "$arguments"
    "$tool" "${words[@]}" 2> errors.txt
    # The hand is coarser than a scan.
    ! grep -v "warning: The cells of depth .* are .* wide" errors.txt || exit 1
done <<< "$commands"
[ "$(wc -l <<< "$commands")" -ge 5 ]
