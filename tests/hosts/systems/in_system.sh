#!/usr/bin/env bash
# Runs a command in a Debian that lay_system.sh laid, as root there:
# in_system.sh [-r FOLDER]... SYSTEM COMMAND...
#
# Inside are this project's sources and the folders of -r, to be read only, and the current directory,
# all at the paths that they have outside. Of the environment OMP_NUM_THREADS and proxies get inside.
# What is mounted, and whatever is still running, goes when the command ends.
set -euo pipefail

if [ "${1:-}" != --unshared ]; then # Once more, where mounts and processes are its own.
    unshare --mount --pid --fork --kill-child "$0" --unshared "$@" <&0 &
    unshared=$!
    trap 'kill -KILL $unshared 2> /dev/null || true' EXIT # It ignores weaker signals.
    wait $unshared
    exit
fi
shift
readable=("$(realpath "$(dirname "$0")/../../..")")
while [ "$1" = -r ]; do
    readable+=("$(realpath "$2")")
    shift 2
done
system=$(realpath "$1") here=$(pwd -P)
shift

mount -t proc proc "$system/proc"
mount --rbind /dev "$system/dev"
mount -t tmpfs tmpfs "$system/tmp"
for file in /etc/resolv.conf /etc/hosts; do
    mount --bind "$(realpath "$file")" "$system$file"
done
for folder in "${readable[@]}"; do
    mkdir -p "$system$folder"
    mount -o bind,ro "$folder" "$system$folder"
done
mkdir -p "$system$here"
mount --bind "$here" "$system$here"

environment=(HOME=/root USER=root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin)
for name in TERM OMP_NUM_THREADS http_proxy https_proxy no_proxy; do
    [ -z "${!name:-}" ] || environment+=("$name=${!name}")
done
# Not exec: this shell, process 1 here, buries the orphans.
env -i "${environment[@]}" chroot "$system" env -C "$here" "$@"
