#!/usr/bin/env bash
# Gets the example meshes of CGAL (scans among them, as .off files) that Debian's package libcgal-demo
# carries: cgal_meshes.sh DESTINATION
#
# The package is downloaded and unpacked rather than installed: slim Debian systems leave
# documentation, which these files count as, out when they install.
set -euo pipefail

destination=${1:?usage: cgal_meshes.sh DESTINATION}
stamp="$destination/.complete"
if [ -e "$stamp" ]; then
    exit 0
fi
command -v apt-get > /dev/null && command -v dpkg-deb > /dev/null || {
    echo "cgal_meshes.sh: needs Debian's apt-get and dpkg-deb; elsewhere, take the .off files of" \
        "data/meshes from CGAL's source release" >&2
    exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# apt's own user cannot write to our folder: say so now instead of being warned about it.
(cd "$work" && apt-get -q -o APT::Sandbox::User=root download libcgal-demo)
dpkg-deb -x "$work"/libcgal-demo_*.deb "$work/package"
tar -xzf "$work/package/usr/share/doc/libcgal-dev/data.tar.gz" -C "$work"

mkdir -p "$destination"
cp "$work"/data/meshes/*.off "$destination/"
touch "$stamp"
