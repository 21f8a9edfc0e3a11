#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Smooths the meshes of a folder and its subfolders that another folder does not have yet, or removes their noise:
# smooth_folder.sh INPUT OUTPUT [smooth|remove-noise|fair] [OPTION]...
#
# Runs the program tracked_mcf, which must be in the PATH, on each mesh, and writes the mesh and its report, NAME.json, under
# the same name. OPTIONs go to the program. Variables:
#   WORKERS  meshes at the same time; by default, as many as cores
#   THREADS  of each worker; by default, the workers share the cores
#   MEMORY   of all workers, in MB; by default, what is free. Each worker may have an equal share
# Prints what the program says, after the name of the mesh. A mesh that fails does not stop the others.
# Ends with 1 if one has failed.
set -euo pipefail

[ $# -ge 2 ] || { sed -n '/^# Smooths/,/^set/s/^# \{0,1\}//p' "$0" >&2 && exit 2; }
input=$1 output=$2
shift 2
export COMMAND=
[[ ! ${1:-} =~ ^(smooth|remove-noise|fair)$ ]] || { COMMAND=$1 && shift; }
mkdir -p "$output"
[ ! "$input" -ef "$output" ] || { echo "smooth_folder.sh: INPUT and OUTPUT are the same folder." >&2 && exit 1; }
cores=$(nproc) workers=${WORKERS:-$cores}
export THREADS=${THREADS:-$((workers < cores ? cores / workers : 1))}
memory=${MEMORY:-$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)}
# The program refuses a flow that needs more than this limit leaves.
ulimit -d $((memory * 1024 / workers))

smooth() { # NAME INPUT OUTPUT [OPTION]...
    local target=$3/$1 messages status=0
    [ ! -e "$target" ] || return 0
    mkdir -p "$(dirname "$target")"
    messages=$(tracked_mcf $COMMAND "$2/$1" "$target" --quiet --threads "$THREADS" --report "$target.json" "${@:4}" 2>&1) ||
        status=$?
    [ "$status" = 0 ] || messages+=" (failed, exit code $status)"
    [ -z "$messages" ] || echo "$1: $messages" >&2
    [ "$status" = 0 ]
}
export -f smooth
# OUTPUT may lie in INPUT.
find "$input" -type d -samefile "$output" -prune -o -type f -iregex '.*\.\(ply\|obj\|off\|stl\)' -printf '%P\0' |
    xargs -0 -P "$workers" -I '{}' bash -c 'smooth "$@"' smooth '{}' "$input" "$output" "$@" || exit 1
