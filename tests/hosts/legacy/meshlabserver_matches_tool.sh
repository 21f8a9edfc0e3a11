#!/usr/bin/env bash
# Runs the filter with every value of every choice in stock meshlabserver and with the command-line tool on the
# same mesh, and compares vertex by vertex:
# meshlabserver_matches_tool.sh PREFIX TOOL MESH WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 tool=$2 mesh=$3 work=$4
depth=6 step_size=3e-5 iterations=5
mkdir -p "$work"

# Through MeshLab once, so that both start from the same floats whatever the format.
"$prefix/bin/meshlabserver" -i "$mesh" -o "$work/in.ply"

compare() { # NAME BOUNDARY SEPARATE_SHEETS SOLVER TOOL_OPTIONS...
    "$here/flow_script.sh" $depth $step_size $iterations "${@:2:3}" > "$work/$1.mlx"
    "$prefix/bin/meshlabserver" -i "$work/in.ply" -s "$work/$1.mlx" -o "$work/plugin-$1.ply" |
        tee "$work/log.txt"
    grep -q "steps of mean-curvature flow" "$work/log.txt"
    "$tool" "$work/in.ply" "$work/tool-$1.ply" --depth $depth --step-size $step_size \
        --iterations $iterations "${@:5}" --quiet
    # Half a unit in the last place: the plugin's floats are the tool's doubles, rounded.
    "$here/compare_positions.py" "$work/plugin-$1.ply" "$work/tool-$1.ply" "$work/in.ply" 0.5
}
compare default 0 true 0
compare free 1 true 0 --boundary free
compare glued 0 false 0 --separate-sheets off
compare paper 0 false 1 --separate-sheets off --solver w-cycle
