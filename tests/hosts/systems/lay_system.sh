#!/usr/bin/env bash
# Lays a minimal Debian of another suite into a folder, for tests in that suite's MeshLab, once:
# lay_system.sh SUITE FOLDER
#
# Root alone can, with debootstrap: without, this ends with exit code 77, for a test to be skipped.
# Packages come from where this system's own do.
set -euo pipefail

suite=$1 folder=$(realpath -m "$2") half="$(realpath -m "$2").half-laid"

skip() { echo "skipped: no Debian $suite can be laid here: $1" && exit 77; }
unshare --mount true 2> /dev/null || skip "that takes root, allowed to mount"
command -v debootstrap > /dev/null || skip "there is no debootstrap (apt-get install debootstrap)"

# One at a time; nor before what another left running, should it have been killed, has ended.
mkdir -p "$(dirname "$folder")"
exec {parent}< "$(dirname "$folder")"
flock "$parent"
stamp="$folder/etc/laid_suite"
if [ "$(cat "$stamp" 2> /dev/null)" = "$suite" ]; then exit 0; fi
if [ -e "$folder" ]; then
    echo "lay_system.sh: $folder is there, but is no $suite that this script laid" >&2
    exit 1
fi

mirror=$(apt-get indextargets --format '$(SITE)|$(RELEASE)|$(COMPONENT)|$(ORIGIN)' \
    'Created-By: Packages' |
    awk -F'|' '$2 !~ /-security$/ && $3 == "main" && $4 == "Debian" && !site { print site = $1 }')
[ -n "$mirror" ] || {
    echo "lay_system.sh: apt has no package lists; run 'apt-get update' as root, then try again" >&2
    exit 1
}
proxies=$(apt-config dump | grep -E '^Acquire::https?::Proxy ' || true)
eval "$(apt-config shell proxy Acquire::http::Proxy)"
[ -z "${proxy:-}" ] || export http_proxy="$proxy"

# All suites are laid as sid is: an older debootstrap need not know them. What it mounts goes with it.
rm -rf --one-file-system "$half"
unshare --mount debootstrap --variant=minbase --include=ca-certificates "$suite" "$half" "$mirror" sid

# A mirror that stands still for a while serves as well. Nothing here must survive a power cut.
cat > "$half/etc/apt/apt.conf.d/90laid" << END
$proxies
Acquire::Check-Valid-Until "false";
APT::Keep-Downloaded-Packages "false";
END
echo force-unsafe-io > "$half/etc/dpkg/dpkg.cfg.d/90laid"
# Where in_system.sh puts this system's own.
rm -f "$half"/etc/{resolv.conf,hosts} && touch "$half"/etc/{resolv.conf,hosts}
echo "$suite" > "$half/etc/laid_suite"
mv "$half" "$folder"
