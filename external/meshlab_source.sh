#!/usr/bin/env bash
# Fetches the source package of the MeshLab release that this Debian offers, for its headers and
# vcglib, which no -dev package carries: meshlab_source.sh DESTINATION
#
# A private sources list is used, made from the system's own apt configuration, so that neither
# /etc/apt nor the system's package lists change.
set -euo pipefail

destination=${1:?usage: meshlab_source.sh DESTINATION}
stamp="$destination/.complete"
if [ -e "$stamp" ]; then
    exit 0
fi
command -v apt-get > /dev/null || {
    echo "meshlab_source.sh: no apt-get here; unpack a MeshLab source tree yourself and give its" \
        "path to CMake: -DMESHLAB_SOURCE_DIR=/path/to/meshlab" >&2
    exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/source"

# One deb-src line for every place where the system itself gets Debian's main packages from.
apt-get indextargets --format '$(SITE)|$(RELEASE)|$(COMPONENT)|$(ORIGIN)' 'Created-By: Packages' |
    awk -F'|' '$3 == "main" && $4 == "Debian" && !seen[$1 $2]++ {
        print "deb-src " $1 " " $2 " main" }' > "$work/sources.list"

[ -s "$work/sources.list" ] || {
    echo "meshlab_source.sh: apt has no package lists; run 'apt-get update' as root, then try again" >&2
    exit 1
}

# The same release as the library that the plugin will be linked with, where that is installed.
version=$(dpkg-query -W -f '${source:Version}' meshlab 2> /dev/null || true)

private_apt=(apt-get -q -o Dir::Etc::SourceList="$work/sources.list"
    -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists="$work/lists"
    -o APT::Sandbox::User=root)
"${private_apt[@]}" update
(cd "$work/source" && "${private_apt[@]}" source --only-source "meshlab${version:+=$version}")

mkdir -p "$destination"
cp -a "$work"/source/meshlab-*/. "$destination/"
touch "$stamp"
