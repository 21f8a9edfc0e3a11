#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Does what the README and the pages of the plugin and the tool say: the filter scripts in stock
# meshlabserver, and all commands of the tool:
# readme_works.sh PREFIX TOOL README CGAL_MESHES WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 tool=$2 readme=$3 meshes=$4 work=$5
pages=("$readme" "$(dirname "$readme")"/filter_tracked_mcf/hosts/{meshlab,cli}/README.md)
rm -rf "$work"
mkdir -p "$work"

# The meshes of the README: a closed scan with noise, one with a boundary, and one with a selection.
awk 'NF == 3 && NR > 2 { for (i = 1; i <= 3; ++i) $i += 0.02 * (rand() - 0.5) } 1' "$meshes/hand.off" \
    > "$work/noisy.off"
"$prefix/bin/meshlabserver" -i "$work/noisy.off" -o "$work/scan.ply"
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

# The filter scripts of the pages, which must do what the program does by default.
awk '/^```xml$/ { file = "script_" ++count ".mlx"; next } /^```$/ { file = "" } file { print > file }' "${pages[@]}"
compare() { # SCRIPT LOG [SUBCOMMAND]
    "$prefix/bin/meshlabserver" -i scan.ply -s "$1" -o host.ply | grep "$2"
    "$tool" "${@:3}" scan.ply tool.ply --quiet --overwrite
    "$here/../compare_positions.py" host.ply tool.ply scan.ply 0.5
}
compare script_1.mlx "Smoothed"
compare script_2.mlx "Removed noise" remove-noise
# The script that fills holes, and what it has before the last filter. The mesh's edges are 0.2 long.
sed -i 's/name="TargetLen" value="0.01"/name="TargetLen" value="0.2"/' script_3.mlx
sed '/Fair Selected Faces/,/<\/filter>/d' script_3.mlx > fill.mlx
"$prefix/bin/meshlabserver" -i open.ply -s fill.mlx -o closed.ply -m ff
"$prefix/bin/meshlabserver" -i open.ply -s script_3.mlx -o host.ply | grep "Faired"
"$tool" fair closed.ply tool.ply --selected flags --overwrite
"$here/../compare_positions.py" host.ply tool.ply closed.ply 0.5

commands=$(sed -n '/^```sh$/,/^```$/p' "${pages[@]}" | grep '^tracked_mcf ')
while read -r _ arguments; do
    echo "== tracked_mcf $arguments"
    read -ra words <<< "$arguments"
    "$tool" "${words[@]}" 2> errors.txt
    # The hand is coarser than a scan, and the mannequin's neck is rough for the size of its hole.
    ! grep -vE "warning: (The detail size is .* mean edges|The surface around .* is rough|A part of the .* lost 3)" \
        errors.txt || exit 1
done <<< "$commands"
[ "$(wc -l <<< "$commands")" -ge 5 ]
