#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Expects that each commit since a release adds one to the version, so that packages are updated: version_grows.sh CMAKE
set -euo pipefail
cmake=$1 source=$(realpath "$(dirname "$0")/../../filter_tracked_mcf")

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
commit() { git -c user.name=test -c user.email=test@localhost commit -q --allow-empty -m "$1"; }
expect() {
    local version
    version=$("$cmake" -P print.cmake 2>&1)
    [ "$version" = "$1" ] || { echo "version_grows: expected $1, got $version" >&2 && exit 1; }
}

mkdir filter_tracked_mcf
sed 's/TRACKED_MCF_VERSION [0-9][0-9.]*/TRACKED_MCF_VERSION 7.8.9/' "$source/version.cmake" > filter_tracked_mcf/version.cmake
echo 'include(filter_tracked_mcf/version.cmake) message("${TRACKED_MCF_VERSION}")' | tr ' ' '\n' > print.cmake
expect 7.8.9 # a release's archive has no commits
git init -q
git add filter_tracked_mcf
commit "release"
expect 7.8.9
commit "first change"
commit "second change"
expect 7.8.9.2
git tag v7.8.8 HEAD~1 # an older one, or one that was forgotten
expect 7.8.9.2
git tag v7.9.0
expect 7.9.0
commit "third change"
expect 7.9.0.1
