#!/usr/bin/env bash
# Runs the filter with every value of every choice in a host and with the command-line tool on the
# same mesh, and compares vertex by vertex; where the tool refuses, as it must refuse to keep the
# volume of an open mesh, the host must do so in the same words:
# matches_tool.sh TOOL MESH WORK_DIR ULPS HOST...
#
# HOST is what runs the filter, given IN OUT NAME=VALUE... ULPS is how far the two may differ, in
# units in the last place of a float: 0.5 where the host rounds to floats, 0 where it does not.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
tool=$1 mesh=$2 work=$3 ulps=$4 host=("${@:5}")
rm -rf "$work"
mkdir -p "$work"

# So that both start from the same floats whatever the format.
"$here/float_ply.py" "$mesh" "$work/in.ply"

run() { # NAME PARAMETERS TOOL_OPTIONS: those as a script takes them, these as the tool does
    local parameters options in_host=0 ours=0
    read -ra parameters <<< "depth=6 step_size=$step_size iterations=5 $2"
    read -ra options <<< "--depth 6 --step-size $step_size --iterations 5 $3"
    "${host[@]}" "$work/in.ply" "$work/host-$1.ply" "${parameters[@]}" \
        > "$work/log.txt" 2>&1 || in_host=$?
    "$tool" "$work/in.ply" "$work/tool-$1.ply" "${options[@]}" --quiet --report "$work/$1.json" \
        2> "$work/errors.txt" || ours=$?
    # The tool tells bad parameters, 1, from bad meshes, 2; hosts end with 1 or 255.
    [ "$in_host $ours" = "0 0" ] || [[ "$in_host $ours" =~ ^(1|255)\ [12]$ ]] || {
        cat "$work/log.txt" "$work/errors.txt"
        echo "$1: the host ends with $in_host, the tool with $ours"
        exit 1
    } >&2
    return "$ours"
}
compare() { # NAME PARAMETERS TOOL_OPTIONS
    run "$@"
    grep -o "Smoothed .*" "$work/log.txt" | tail -n 1
    "$here/compare_positions.py" "$work/host-$1.ply" "$work/tool-$1.ply" "$work/in.ply" "$ulps" |
        tee -a "$work/differences.txt"
}
both_refuse() { # NAME PARAMETERS TOOL_OPTIONS
    if run "$@"; then
        echo "$1 was not refused" >&2
        exit 1
    fi
    local message
    message=$(sed 's/^tracked_mcf: //' "$work/errors.txt")
    echo "both refuse: $message"
    grep -qF "$message" "$work/log.txt"
}
step_size=3e-5
compare default "" ""
compare locked_cells boundary=1 "--boundary locked-cells"
compare free boundary=2 "--boundary free"
compare conformalized flow=1 "--flow conformalized"
compare glued separate_sheets=false "--separate-sheets off"
compare paper "boundary=1 separate_sheets=false solver=1" \
    "--boundary locked-cells --separate-sheets off --solver w-cycle"
compare area "boundary=2 rescale=1" "--boundary free --rescale area"
if grep -q '"boundary_edges": 0,' "$work/default.json"; then
    compare volume rescale=2 "--rescale volume"
    compare sphere "flow=1 rescale=1" "--flow conformalized --rescale area"
else
    both_refuse volume_of_an_open_mesh "boundary=2 rescale=2" "--boundary free --rescale volume"
    both_refuse rescaling_of_what_is_held rescale=1 "--rescale area"
fi

# A tenth of a squared cell, in units of the mesh.
step_size=$(sed -n 's/^  "cell_size": \(.*\),$/\1/p' "$work/default.json" |
    awk '{printf "%.4g", $1 * $1 / 10}')
compare absolute absolute=true --absolute
