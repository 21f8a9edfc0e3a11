#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Passes invalid meshes and values to meshlabserver. For each, expects a message in the log, a failure as
# exit code and no output file: meshlabserver_refuses.sh PREFIX WORK_DIR
set -euo pipefail

here=$(dirname "$(realpath "$0")")
prefix=$1 work=$2
mkdir -p "$work"

off() { # NAME VERTICES FACES LINES...
    { printf 'OFF\n%s %s 0\n' "$2" "$3"; printf '%s\n' "${@:4}"; } > "$work/$1.off"
}
square=("0 0 0" "1 0 0" "0 1 0" "1 1 0")
off good 4 2 "${square[@]}" "3 0 1 2" "3 1 3 2"
# A band with one side.
off twisted 5 5 "1 0 0" "0 1 0" "-1 0 1" "0 -1 0" "0 0 3" "3 0 1 2" "3 1 2 3" "3 2 3 4" "3 3 4 0" "3 4 0 1"
off empty 0 0
off no_faces 4 0 "${square[@]}"
off nan 4 2 "${square[@]:0:3}" "1 nan 0" "3 0 1 2" "3 1 3 2"
off infinite 4 2 "${square[@]:0:3}" "1 inf 0" "3 0 1 2" "3 1 3 2"
off degenerate 4 2 "0 0 0" "1 0 0" "2 0 0" "3 0 0" "3 0 1 2" "3 1 3 2"

failures=0
refuses() { # MESSAGE MESH [NAME=VALUE]...
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
refuses "mesh is empty" empty
refuses "no faces" no_faces
refuses "not a finite number" nan
refuses "not a finite number" infinite
refuses "are degenerate" degenerate
refuses "depth is 13" good depth=13
refuses "detail_size is nan" good detail_size=nan
refuses "order is 5" good order=5
refuses "flow is -1" good flow=-1
refuses "No face is selected; select" good selected=true
refuses "No face is selected; select" good --select "x0 > 5"
refuses "surface is open" good flow=1 boundary=1 preserve=2
refuses "Preserving the area would move vertices that must stay" good preserve=1
refuses "cannot be oriented alike" twisted preserve=2
exit "$((failures > 0))"
