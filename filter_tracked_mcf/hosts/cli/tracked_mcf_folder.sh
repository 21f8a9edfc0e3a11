#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installed as the command tracked_mcf_folder.
set -euo pipefail

help() {
    cat << 'TEXT'
Usage: tracked_mcf_folder INPUT OUTPUT [smooth|remove-noise|fair] [OPTION]...

Smooths, denoises or fairs each mesh of the folder INPUT and its subfolders, unless OUTPUT has it already.

Runs the program tracked_mcf on each mesh, and writes the mesh and its report, NAME.json, under the same name. OPTIONs go
to the program. Prints what the program says, after the name of the mesh. A mesh that fails does not stop the others. Ends
with 1 if one has failed.

Variables:
  WORKERS    meshes at the same time; by default, as many as cores
  THREADS    of each worker; by default, the workers share the cores
  MEMORY     of all workers, in MB; by default, what is free. Each worker may have an equal share

Examples:
  tracked_mcf_folder scans clean remove-noise

  WORKERS=1 tracked_mcf_folder scans smooth --detail-size 1%
TEXT
}
[ "${1:-}" != --help ] || { help && exit; }
[ $# -ge 2 ] || { help >&2 && exit 2; }
PATH=$PATH:$(dirname "$(realpath "$0")") # the program in the PATH, or else the one beside this script
input=$1 output=$2
shift 2
export COMMAND=
[[ ! ${1:-} =~ ^(smooth|remove-noise|fair)$ ]] || { COMMAND=$1 && shift; }
mkdir -p "$output"
[ ! "$input" -ef "$output" ] || { echo "tracked_mcf_folder: INPUT and OUTPUT are the same folder." >&2 && exit 1; }
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
