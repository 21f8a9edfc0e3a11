#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a minimal Debian of another suite into a folder, unless it is there already, for tests with
# the MeshLab of this suite: lay_system.sh SUITE FOLDER
#
# This needs root and debootstrap. Without them, the script exits with 77, so that ctest skips the test.
# Packages come from the sources of this system.
set -euo pipefail

suite=$1 folder=$(realpath -m "$2") half="$(realpath -m "$2").half-laid"

skip() { echo "skipped: Debian $suite cannot be installed here: $1" && exit 77; }
unshare --mount true 2> /dev/null || skip "run as root, with permission to mount"
command -v debootstrap > /dev/null || skip "install debootstrap"

# One at a time. The lock also waits for processes that a killed run has left.
mkdir -p "$(dirname "$folder")"
exec {parent}< "$(dirname "$folder")"
flock "$parent"
stamp="$folder/etc/laid_suite"
if [ "$(cat "$stamp" 2> /dev/null)" = "$suite" ]; then exit 0; fi
if [ -e "$folder" ]; then
    echo "lay_system.sh: $folder exists, but this script did not install $suite there. Remove it." >&2
    exit 1
fi

mirror=$(apt-get indextargets --format '$(SITE)|$(RELEASE)|$(COMPONENT)|$(ORIGIN)' \
    'Created-By: Packages' |
    awk -F'|' '$2 !~ /-security$/ && $3 == "main" && $4 == "Debian" && !site { print site = $1 }')
[ -n "$mirror" ] || {
    echo "lay_system.sh: apt has no package lists. Run 'apt-get update' as root, then try again." >&2
    exit 1
}
proxies=$(apt-config dump | grep -E '^Acquire::https?::Proxy ' || true)
eval "$(apt-config shell proxy Acquire::http::Proxy)"
[ -z "${proxy:-}" ] || export http_proxy="$proxy"

# The script for sid works for all suites, also with an older debootstrap. unshare ends its mounts.
rm -rf --one-file-system "$half"
unshare --mount debootstrap --variant=minbase --include=ca-certificates "$suite" "$half" "$mirror" sid

# Accept a mirror that is not updated any more, and skip fsync.
cat > "$half/etc/apt/apt.conf.d/90laid" << END
$proxies
Acquire::Check-Valid-Until "false";
APT::Keep-Downloaded-Packages "false";
END
echo force-unsafe-io > "$half/etc/dpkg/dpkg.cfg.d/90laid"
# in_system.sh mounts this system's files here.
rm -f "$half"/etc/{resolv.conf,hosts} && touch "$half"/etc/{resolv.conf,hosts}
echo "$suite" > "$half/etc/laid_suite"
mv "$half" "$folder"
