#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Gives an open mesh colours, qualities and texture coordinates. Smooths it with a locked boundary, then
# also preserves its volume, then smooths only its upward faces, in meshlabserver and with the
# command-line tool. Constrained vertices must keep their bits, all data except positions must stay, and
# the two results must agree:
# meshlabserver_keeps.sh PREFIX TOOL MESH WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 tool=$2 mesh=$3 work=$4
rm -rf "$work"
mkdir -p "$work"

meshlab() { # IN SCRIPT OUT WHAT: names without .ply and .mlx; the attributes to save
    local in=$work/$1.ply
    [ "$1" != mesh ] || in=$mesh
    # shellcheck disable=SC2086 # WHAT is several words
    "$prefix/bin/meshlabserver" -i "$in" -s "$work/$2.mlx" -o "$work/$3.ply" -m $4 \
        > "$work/log.txt" 2>&1 || {
        cat "$work/log.txt"
        exit 1
    } >&2
    grep -o "Smoothed .*" "$work/log.txt" | tail -n 1 || true
}
check() { # BEFORE PLUGIN TOOL
    "$here/../check_kept.py" "$work/$1.ply" "$work/$2.ply"
    "$here/../check_kept.py" "$work/$1.ply" "$work/$3.ply"
    "$here/../compare_positions.py" "$work/$2.ply" "$work/$3.ply" "$work/$1.ply" 0.5
}
function_filter() { # NAME PARAMETER=VALUE...: a filter of MeshLab that takes functions
    local type parameter
    echo " <filter name=\"$1\">"
    for parameter in "${@:2}"; do
        type=RichString
        [ "${parameter#*=}" != false ] || type=RichBool
        echo "  <Param type=\"$type\" name=\"${parameter%%=*}\" value=\"${parameter#*=}\"/>"
    done
    echo " </filter>"
}
dress_script() { # gives each vertex and face its own values
    local plain=(normalize=false map=false onselected=false)
    echo "<!DOCTYPE FilterScript><FilterScript>"
    function_filter "Per Vertex Color Function" x="200*abs(sin(vi))" y="200*abs(cos(vi))" \
        z="100+y" a=255 onselected=false
    function_filter "Per Vertex Quality Function" q="vi/7" "${plain[@]}"
    function_filter "Per Face Quality Function" q="fi/7" "${plain[@]}"
    function_filter "Per Face Color Function" r="200*abs(sin(fi))" g="200*abs(cos(fi))" b=7 a=255 \
        onselected=false
    function_filter "Per Vertex Texture Function" u=x v=y onselected=false
    function_filter "Convert PerVertex UV into PerWedge UV"
    echo "</FilterScript>"
}
dress_script > "$work/dress.mlx"

# Hosts read floats, and the step size is one.
settings=(iterations=5) options=(--iterations 5 --quiet)
looks="vc vq fc fq wt" looks_and_flags="vc vq vf fc ff fq wt"

echo "== Boundary locked"
"$here/flow_script.sh" "${settings[@]}" > "$work/locked.mlx"
meshlab mesh dress in "$looks"
meshlab in locked plugin-locked "$looks"
"$tool" "$work/in.ply" "$work/tool-locked.ply" "${options[@]}"
check in plugin-locked tool-locked

echo "== Boundary locked, volume preserved"
if "$tool" "$work/in.ply" "$work/tool-volume.ply" "${options[@]}" --preserve volume \
    2> "$work/errors.txt"; then
    "$here/flow_script.sh" "${settings[@]}" preserve=2 > "$work/volume.mlx"
    meshlab in volume plugin-volume "$looks"
    check in plugin-volume tool-volume
else
    grep "cannot be oriented alike" "$work/errors.txt"
fi

echo "== Upward faces"
"$here/flow_script.sh" --select "fnz > 0" "${settings[@]}" > "$work/up.mlx"
sed '/<filter name="Mean/,/<\/filter>/d' "$work/up.mlx" > "$work/select.mlx"
meshlab in select in-up "$looks_and_flags"
meshlab in up plugin-up "$looks_and_flags"
"$tool" "$work/in-up.ply" "$work/tool-up.ply" "${options[@]}" --selected flags
check in-up plugin-up tool-up

echo "== The same, with the selection in the file"
"$here/flow_script.sh" "${settings[@]}" selected=true > "$work/selected.mlx"
meshlab in-up selected plugin-file "$looks_and_flags"
cmp "$work/plugin-file.ply" "$work/plugin-up.ply"
