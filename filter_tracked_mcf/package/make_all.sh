#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the packages for all four hosts on one Debian, whichever MeshLab is
# installed, and lists them with the versions that they need: make_all.sh DESTINATION [arguments for cmake]
#
# A package runs on the Debian that made it and on later ones, so make packages on the oldest. Sources
# and build folders stay in build/packages for the next time.
set -euo pipefail

destination=$(realpath -m "${1:?usage: make_all.sh DESTINATION [arguments for cmake]}")
root=$(realpath "$(dirname "$0")/../..")
work=$root/build/packages
mkdir -p "$destination"
# The user's own flags may be for the user's own processor.
unset CXXFLAGS LDFLAGS

make_one() { # RELEASE SCALAR CMAKE_ARGUMENT...
    local build=$work/$1-$2 sources=$work/meshlab-source-$1
    printf '\n== MeshLab %s, %s\n' "$1" "$2"
    "$root/external/meshlab_source.sh" "$sources" "$1"
    rm -rf "$build"/package
    cmake -S "$root" -B "$build" -DMESHLAB_SOURCE_DIR="$sources" \
        -DMESHLAB_SCALAR="$2" -DTRACKED_MCF_TESTS=OFF -DCMAKE_BUILD_TYPE=Release "${@:3}"
    cmake --build "$build" -j "$(nproc)"
    cpack --config "$build/CPackConfig.cmake" -B "$build/package"
    cp "$build"/package/*.tar.gz "$destination/"
    made+=("$(basename "$build"/package/*.tar.gz)")
}
made=()
"$root/external/install_debian.sh" package
for kind in "2020.09 float" "2022.02 float" "2025.07 float" "2025.07 double"; do
    # shellcheck disable=SC2086 # KIND is two words
    make_one $kind "${@:2}"
done

printf '\n== Packages in %s\n' "$destination"
for archive in "${made[@]}"; do
    echo "$archive: $(stat -c %s "$destination/$archive") bytes"
    tar -xOzf "$destination/$archive" "${archive%.tar.gz}/INSTALL.txt" |
        sed -n '/^What is needed/,$p' | grep '^    '
done
