#!/usr/bin/env bash
# Does what the README says: its MeshLab script in stock meshlabserver, which must do what the tool
# does by default, and all its commands of the tool:
# readme_works.sh PREFIX TOOL README CGAL_MESHES WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 tool=$2 readme=$3 meshes=$4 work=$5
rm -rf "$work"
mkdir -p "$work"

# What the README's names stand for: a closed scan, one with a rim, and one with a selection.
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

sed -n '/^```xml$/,/^```$/p' "$readme" | grep -v '^```' > smooth.mlx
"$prefix/bin/meshlabserver" -i scan.ply -s smooth.mlx -o smooth.ply | grep "Smoothed"
"$tool" scan.ply tool.ply --quiet
"$here/../compare_positions.py" smooth.ply tool.ply scan.ply 0.5

commands=$(sed -n '/^```sh$/,/^```$/p' "$readme" | grep '^tracked_mcf ')
while read -r _ arguments; do
    echo "== tracked_mcf $arguments"
    read -ra words <<< "$arguments"
    "$tool" "${words[@]}" 2> errors.txt
    [ ! -s errors.txt ] || { cat errors.txt && exit 1; }
done <<< "$commands"
[ "$(wc -l <<< "$commands")" -ge 5 ]
