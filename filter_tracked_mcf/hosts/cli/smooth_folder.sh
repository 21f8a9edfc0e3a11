#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Smooths the meshes of a folder that another folder does not have yet, or removes their noise:
# smooth_folder.sh INPUT OUTPUT [remove-noise] [OPTION]...
#
# Runs the program tracked_mcf, which must be in the PATH, on each mesh. OPTIONs go to the program. Variables:
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
[ "${1:-}" != remove-noise ] || { COMMAND=$1 && shift; }
mkdir -p "$output"
[ ! "$input" -ef "$output" ] || { echo "smooth_folder.sh: INPUT and OUTPUT are the same folder." >&2 && exit 1; }
cores=$(nproc) workers=${WORKERS:-$cores}
export THREADS=${THREADS:-$((workers < cores ? cores / workers : 1))}
memory=${MEMORY:-$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)}
# The program refuses a flow that needs more than this limit leaves.
ulimit -d $((memory * 1024 / workers))

smooth() { # MESH OUTPUT [OPTION]...
    local name=${1##*/} messages status=0
    [ ! -e "$2/$name" ] || return 0
    messages=$(tracked_mcf $COMMAND "$1" "$2/$name" --quiet --threads "$THREADS" "${@:3}" 2>&1) || status=$?
    [ "$status" = 0 ] || messages+=" (failed, exit code $status)"
    [ -z "$messages" ] || echo "$name: $messages" >&2
    [ "$status" = 0 ]
}
export -f smooth
find "$input" -maxdepth 1 -type f -iregex '.*\.\(ply\|obj\|off\|stl\)' -print0 |
    xargs -0 -P "$workers" -I '{}' bash -c 'smooth "$@"' smooth '{}' "$output" "$@" || exit 1
