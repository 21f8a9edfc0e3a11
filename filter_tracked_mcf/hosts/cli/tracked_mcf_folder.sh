#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installed as the command tracked_mcf_folder.
set -euo pipefail

help() {
    cat << 'TEXT'
Usage: tracked_mcf_folder INPUT OUTPUT [smooth|remove-noise|fair] [OPTION]...

Smooths, denoises or fairs each mesh of the folder INPUT and its subfolders, unless
OUTPUT has it already.

Runs the program tracked_mcf on each mesh, and writes the mesh and its report,
NAME.json, under the same name. Links are followed. OPTIONs go to the program. Prints
what the program says, after the name of the mesh, and at the end how many meshes were
done, were there already, and failed. A mesh that fails does not stop the others. Ends
with 1 if one has failed or if there is none, and with 2 if the program does not take
the OPTIONs.

Variables:
  WORKERS    meshes at the same time; by default, as many as cores
  THREADS    of each worker; by default, the workers share the cores
  MEMORY     of all workers, in MB; by default, what is free. Each worker may have an
             equal share

Examples:
  tracked_mcf_folder scans clean remove-noise

  WORKERS=1 tracked_mcf_folder scans smooth --detail-size 1%
TEXT
}
fail() { # CODE MESSAGE
    echo "tracked_mcf_folder: $2" >&2
    exit "$1"
}
[ "${1:-}" != --help ] || { help && exit; }
[ $# -ge 2 ] || { help >&2 && exit 2; }
PATH=$PATH:$(dirname "$(realpath "$0")") # the program in the PATH, or else the one beside this script
input=$1 output=$2
shift 2
[ -d "$input" ] || fail 1 "$input is no folder."
export COMMAND=
[[ ! ${1:-} =~ ^(smooth|remove-noise|fair)$ ]] || { COMMAND=$1 && shift; }
mkdir -p "$output"
[ ! "$input" -ef "$output" ] || fail 1 "INPUT and OUTPUT are the same folder."
# The program looks at its options before it looks for its INPUT.
status=0
messages=$(tracked_mcf $COMMAND "$output/no.ply" "$output/no.ply" "$@" 2>&1) || status=$?
[ "$status" != 2 ] || { echo "$messages" >&2 && exit 2; }
cores=$(nproc) workers=${WORKERS:-$cores}
export THREADS=${THREADS:-$((workers < cores ? cores / workers : 1))}
memory=${MEMORY:-$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)}
# The program refuses a flow that needs more than this limit leaves.
ulimit -d $((memory * 1024 / workers))

# Says what has become of a mesh: a line "done", "there" or "failed".
smooth() { # INPUT OUTPUT [OPTION]... NAME
    local name=${*: -1} messages status=0
    local target=$2/$name
    [ ! -e "$target" ] || { echo there && return; }
    mkdir -p "$(dirname "$target")"
    messages=$(tracked_mcf $COMMAND "$1/$name" "$target" --quiet --threads "$THREADS" --report "$target.json" "${@:3:$#-3}" 2>&1) ||
        status=$?
    [ "$status" = 0 ] || messages+=" (failed, exit code $status)"
    [ -z "$messages" ] || echo "$name: $messages" >&2
    [ "$status" = 0 ] && echo done || echo failed
}
export -f smooth
# OUTPUT may lie in INPUT.
mapfile -d '' meshes < <(find -L "$input" -type d -samefile "$output" -prune -o \
    -type f -iregex '.*\.\(ply\|obj\|off\|stl\)' -printf '%P\0')
[ ${#meshes[@]} -gt 0 ] || fail 1 "there is no mesh in $input: no .ply, .obj, .off or .stl."
declare -A counts=([done]=0 [there]=0 [failed]=0)
while read -r result; do
    counts[$result]=$((counts[$result] + 1))
    [ ! -t 1 ] || printf '\r%d of %d' $((counts[done] + counts[there] + counts[failed])) ${#meshes[@]}
done < <(printf '%s\0' "${meshes[@]}" | xargs -0 -n 1 -P "$workers" bash -c 'smooth "$@"' smooth "$input" "$output" "$@")
[ ! -t 1 ] || printf '\r'
echo "${counts[done]} done, ${counts[there]} there already, ${counts[failed]} failed"
[ $((counts[done] + counts[there])) = ${#meshes[@]} ]
