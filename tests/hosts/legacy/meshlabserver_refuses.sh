#!/usr/bin/env bash
# Gives stock meshlabserver meshes and values that the filter must refuse: each time a message in
# the log, a failure as exit code, and no output: meshlabserver_refuses.sh PREFIX WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 work=$2
mkdir -p "$work"

off() { # NAME VERTICES FACES LINES...
    { printf 'OFF\n%s %s 0\n' "$2" "$3"; printf '%s\n' "${@:4}"; } > "$work/$1.off"
}
square=("0 0 0" "1 0 0" "0 1 0" "1 1 0")
off good 4 2 "${square[@]}" "3 0 1 2" "3 1 3 2"
off empty 0 0
off no_faces 4 0 "${square[@]}"
off nan 4 2 "${square[@]:0:3}" "1 nan 0" "3 0 1 2" "3 1 3 2"
off infinite 4 2 "${square[@]:0:3}" "1 inf 0" "3 0 1 2" "3 1 3 2"
off degenerate 4 2 "0 0 0" "1 0 0" "2 0 0" "3 0 0" "3 0 1 2" "3 1 3 2"

failures=0
refuses() { # MESSAGE MESH DEPTH STEP_SIZE ITERATIONS BOUNDARY [SEPARATE_SHEETS SOLVER]
    rm -f "$work/out.ply"
    "$here/flow_script.sh" "${@:3}" > "$work/script.mlx"
    local code=0
    "$prefix/bin/meshlabserver" -i "$work/$2.off" -s "$work/script.mlx" -o "$work/out.ply" \
        > "$work/log.txt" 2> "$work/debug.txt" || code=$?
    if [ "$code" -eq 255 ] && grep -q "$1" "$work/log.txt" && [ ! -e "$work/out.ply" ]; then
        echo "refused as it should: $(grep -m1 "$1" "$work/log.txt")"
    else
        failures=$((failures + 1))
        echo "NOT refused with '$1' (exit code $code): $*"
        tail -n 5 "$work/log.txt"
    fi
}
refuses "mesh is empty" empty 0 1e-5 10 0
refuses "no faces" no_faces 0 1e-5 10 0
refuses "not a finite number" nan 0 1e-5 10 0
refuses "not a finite number" infinite 0 1e-5 10 0
refuses "faces are degenerate" degenerate 0 1e-5 10 0
refuses "depth is -1" good -1 1e-5 10 0
refuses "depth is 13" good 13 1e-5 10 0
refuses "iterations is 0" good 0 1e-5 0 0
refuses "step_size is 0" good 0 0 10 0
refuses "step_size is -" good 0 -1e-5 10 0
refuses "step_size is nan" good 0 nan 10 0
refuses "boundary is 2" good 0 1e-5 10 2
refuses "boundary is -1" good 0 1e-5 10 -1
refuses "solver is 2" good 0 1e-5 10 0 true 2
refuses "solver is -1" good 0 1e-5 10 0 true -1
exit "$((failures > 0))"
