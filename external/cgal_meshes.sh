#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fetches the example meshes of Debian's package libcgal-demo, .off files with scans among them:
# cgal_meshes.sh DESTINATION
#
# The script unpacks the package instead of installing it: slim Debian systems do not install
# documentation, and the meshes count as documentation.
set -euo pipefail

destination=${1:?usage: cgal_meshes.sh DESTINATION}
stamp="$destination/.complete"
if [ -e "$stamp" ]; then
    exit 0
fi
command -v apt-get > /dev/null && command -v dpkg-deb > /dev/null || {
    echo "cgal_meshes.sh: this system has no apt-get or dpkg-deb. Copy the .off files of data/meshes" \
        "from CGAL's source release to $destination, then touch $stamp." >&2
    exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Without this option apt warns that its own user cannot write to our folder.
(cd "$work" && apt-get -q -o APT::Sandbox::User=root download libcgal-demo)
dpkg-deb -x "$work"/libcgal-demo_*.deb "$work/package"
tar -xzf "$work/package/usr/share/doc/libcgal-dev/data.tar.gz" -C "$work"

mkdir -p "$destination"
cp "$work"/data/meshes/*.off "$destination/"
touch "$stamp"
