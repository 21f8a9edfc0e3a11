#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command as root in a Debian that lay_system.sh has installed:
# in_system.sh [-r FOLDER]... SYSTEM COMMAND...
#
# The command sees the project's sources and the folders of -r, both read-only, and the current
# directory, all at their usual paths. It gets proxies from the environment, and trusts the certificates of this machine.
# Mounts and remaining processes end with the command.
set -euo pipefail

if [ "${1:-}" != --unshared ]; then # Restart with own mounts and processes.
    unshare --mount --pid --fork --kill-child "$0" --unshared "$@" <&0 &
    unshared=$!
    trap 'kill -KILL $unshared 2> /dev/null || true' EXIT # It ignores other signals.
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
for file in /etc/resolv.conf /etc/hosts /etc/ssl/certs/ca-certificates.crt; do
    [ ! -e "$file" ] || mount --bind "$(realpath "$file")" "$system$file"
done
for folder in "${readable[@]}"; do
    mkdir -p "$system$folder"
    mount -o bind,ro "$folder" "$system$folder"
done
mkdir -p "$system$here"
mount --bind "$here" "$system$here"

environment=(HOME=/root USER=root LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin)
for name in TERM http_proxy https_proxy no_proxy PIP_CERT PIP_INDEX_URL; do
    [ -z "${!name:-}" ] || environment+=("$name=${!name}")
done
# Not exec: this shell is process 1 here and must reap orphans.
env -i "${environment[@]}" chroot "$system" env -C "$here" "$@"
