#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches Debian's sources of a MeshLab release for its headers and vcglib, because no -dev package has
# them: meshlab_source.sh DESTINATION [RELEASE]
#
# RELEASE is 2020.09, 2022.02 or 2025.07. The default is the installed release, or else the one of this
# Debian. CMake looks for the sources in the folder meshlab-source of the build folder. The script derives a private sources list from the system's apt configuration, so that
# /etc/apt and the system's package lists stay unchanged.
set -euo pipefail

destination=${1:?usage: meshlab_source.sh DESTINATION [RELEASE]} release=${2:-}
if [ -e "$destination/ML_VERSION" ]; then
    fetched=$(cat "$destination/ML_VERSION")
    [ "${release:-$fetched}" = "$fetched" ] || {
        echo "meshlab_source.sh: $destination holds MeshLab $fetched rather than $release. Remove it" \
            "or name another folder." >&2
        exit 1
    }
    exit 0
fi
command -v apt-get > /dev/null || {
    echo "meshlab_source.sh: this system has no apt-get. Unpack a MeshLab source tree and pass its" \
        "path to CMake: -DMESHLAB_SOURCE_DIR=/path/to/meshlab" >&2
    exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/source"

# "SITE SUITE" for each source of Debian's main packages in the system's configuration.
sites=$(apt-get indextargets --format '$(SITE)|$(RELEASE)|$(COMPONENT)|$(ORIGIN)' \
    'Created-By: Packages' |
    awk -F'|' '$3 == "main" && $4 == "Debian" && !seen[$1 $2]++ { print $1, $2 }')
[ -n "$sites" ] || {
    echo "meshlab_source.sh: apt has no package lists. Run 'apt-get update' as root, then try again." >&2
    exit 1
}
# The Debian that offers the release.
case $release in
    2020.09) suite=bookworm ;;
    2022.02) suite=trixie ;;
    2025.07) suite=sid ;;
    "") suite= ;;
    *) echo "meshlab_source.sh: unknown release $release" >&2 && exit 1 ;;
esac
[ -z "$suite" ] || sites+=$'\n'"$(head -n 1 <<< "$sites" | cut -d' ' -f1) $suite"
sed 's/.*/deb-src & main/' <<< "$sites" | sort -u > "$work/sources.list"

private_apt=(-q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o Dir::State::Lists="$work/lists" -o APT::Sandbox::User=root)
apt-get "${private_apt[@]}" update

# If MeshLab is installed, exactly this version: the plugin will be linked with it.
version=$(dpkg-query -W -f '${source:Version}' meshlab 2> /dev/null || true)
if [[ -z $version || $version != "$release"* ]]; then
    version=$(apt-cache "${private_apt[@]}" showsrc meshlab | sed -n 's/^Version: //p' |
        awk -v release="$release" 'index($0, release) == 1' | sort -V | tail -n 1)
fi
[ -n "$version" ] || {
    echo "meshlab_source.sh: Debian $suite no longer offers MeshLab $release. Unpack its sources" \
        "and pass their path to CMake: -DMESHLAB_SOURCE_DIR=/path/to/meshlab" >&2
    exit 1
}
# Only the tarball: some mirrors lack the source description.
(cd "$work/source" &&
    apt-get "${private_apt[@]}" source --tar-only --download-only "meshlab=$version")
# Moved when it is complete, so that an interrupted run leaves nothing that looks like sources.
half=$destination.half-unpacked
rm -rf "$half"
mkdir -p "$half"
tar -xf "$work"/source/meshlab_*.tar.* -C "$half" --strip-components=1
mv -T "$half" "$destination"
