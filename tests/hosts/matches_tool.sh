#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the filter with each value of each choice, in a host and with the command-line tool, and compares
# the vertices. If the tool refuses an option, the host must refuse it with the same message:
# matches_tool.sh TOOL MESH WORK_DIR ULPS HOST...
#
# HOST is a command that runs the filter, given IN OUT NAME=VALUE... ULPS is the largest permitted
# difference in units in the last place of a float: 0.5 if the host rounds to floats, else 0.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
tool=$1 mesh=$2 work=$3 ulps=$4 host=("${@:5}")
rm -rf "$work"
mkdir -p "$work"

# Both start from the same floats.
"$here/float_ply.py" "$mesh" "$work/in.ply" quality

run() { # NAME PARAMETERS TOOL_OPTIONS: as in a script, and as the tool takes them
    local parameters options in_host=0 ours=0
    # A dialog's own detail size is a float, so that the host would round it.
    read -ra parameters <<< "depth=6 detail_size=0 iterations=5 $2"
    read -ra options <<< "--depth 6 --iterations 5 $3"
    "${host[@]}" "$work/in.ply" "$work/host-$1.ply" "${parameters[@]}" \
        > "$work/log.txt" 2>&1 || in_host=$?
    "$tool" "$work/in.ply" "$work/tool-$1.ply" "${options[@]}" --quiet --report "$work/$1.json" \
        2> "$work/errors.txt" || ours=$?
    # The tool exits with 1 for bad parameters and 2 for bad meshes; hosts exit with 1 or 255.
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
report() { sed -n "s/^  \"$1\": \(.*\),\$/\1/p" "$work/default.json"; } # KEY: of the default run

compare default "" ""
detail_size=$(report detail_size | awk '{printf "%.4g", 2 * $1}')
compare detail_size "detail_size=$detail_size" "--detail-size $detail_size"
compare local_detail_size local_detail_size=true --local-detail-size
for order in 2 3 4; do
    compare order_$order order=$order "--order $order"
done
compare step_size step_size=3e-5 "--step-size 3e-5"
# A tenth of a squared cell, in units of the mesh.
step_size=$(report cell_size | awk '{printf "%.4g", $1 * $1 / 10}')
compare absolute "absolute=true step_size=$step_size" "--absolute --step-size $step_size"
compare locked_cells boundary=1 "--boundary locked-cells"
compare free boundary=2 "--boundary free"
compare conformalized flow=1 "--flow conformalized"
compare shared_cells method=1 "--method shared-cells"
compare strength strength=true "--strength quality"
compare paper "boundary=1 method=2" "--boundary locked-cells --method paper"
compare area "boundary=2 preserve=1" "--boundary free --preserve area"
compare sphere "boundary=2 flow=1 preserve=1" "--boundary free --flow conformalized --preserve area"
if [ "$(report volume_change)" = null ]; then
    both_refuse volume_without_orientation preserve=2 "--preserve volume"
else
    compare volume preserve=2 "--preserve volume"
    compare volume_order_2 "order=2 preserve=2" "--order 2 --preserve volume"
    compare volume_free "boundary=2 preserve=2" "--boundary free --preserve volume"
fi
if [ "$(report boundary_edges)" != 0 ]; then
    both_refuse conformalized_open_volume "boundary=2 flow=1 preserve=2" \
        "--boundary free --flow conformalized --preserve volume"
    both_refuse area_with_constrained_vertices preserve=1 "--preserve area"
fi
