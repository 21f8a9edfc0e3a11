#!/usr/bin/env bash
# Fetches Debian's sources of a MeshLab release, for its headers and vcglib, which no -dev package
# carries: meshlab_source.sh DESTINATION [RELEASE]
#
# RELEASE is 2020.09, 2022.02 or 2025.07; without it, the one that is installed or that this Debian
# offers. A private sources list is used, made from the system's own apt configuration, so that
# neither /etc/apt nor the system's package lists change.
set -euo pipefail

destination=${1:?usage: meshlab_source.sh DESTINATION [RELEASE]} release=${2:-}
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

# "SITE SUITE" for every place where the system itself gets Debian's main packages from.
places=$(apt-get indextargets --format '$(SITE)|$(RELEASE)|$(COMPONENT)|$(ORIGIN)' \
    'Created-By: Packages' |
    awk -F'|' '$3 == "main" && $4 == "Debian" && !seen[$1 $2]++ { print $1, $2 }')
[ -n "$places" ] || {
    echo "meshlab_source.sh: apt has no package lists; run 'apt-get update' as root, then try again" >&2
    exit 1
}
# A release that another Debian offers comes from there.
case $release in
    2020.09) suite=bookworm ;;
    2022.02) suite=trixie ;;
    2025.07) suite=sid ;;
    "") suite= ;;
    *) echo "meshlab_source.sh: unknown release $release" >&2 && exit 1 ;;
esac
[ -z "$suite" ] || places+=$'\n'"$(head -n 1 <<< "$places" | cut -d' ' -f1) $suite"
sed 's/.*/deb-src & main/' <<< "$places" | sort -u > "$work/sources.list"

private_apt=(-q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o Dir::State::Lists="$work/lists" -o APT::Sandbox::User=root)
apt-get "${private_apt[@]}" update

# Where MeshLab is installed, exactly that version: the plugin will be linked with it.
version=$(dpkg-query -W -f '${source:Version}' meshlab 2> /dev/null || true)
if [[ -z $version || $version != "$release"* ]]; then
    version=$(apt-cache "${private_apt[@]}" showsrc meshlab | sed -n 's/^Version: //p' |
        awk -v release="$release" 'index($0, release) == 1' | sort -V | tail -n 1)
fi
[ -n "$version" ] || {
    echo "meshlab_source.sh: Debian $suite no longer offers MeshLab $release; unpack its sources" \
        "yourself and give their path to CMake: -DMESHLAB_SOURCE_DIR=/path/to/meshlab" >&2
    exit 1
}
# The tarball alone: not every mirror has the description that goes with it.
(cd "$work/source" &&
    apt-get "${private_apt[@]}" source --tar-only --download-only "meshlab=$version")
mkdir -p "$destination"
tar -xf "$work"/source/meshlab_*.tar.* -C "$destination" --strip-components=1
touch "$stamp"
