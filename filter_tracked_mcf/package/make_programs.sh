#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes archives of the program for other systems than this one: make_programs.sh DESTINATION [SYSTEM]...
#
# The systems are macos-arm64 and macos-x86_64 (macOS 13 or later), linux-x86_64 and linux-arm64 (glibc 2.28 or
# later), all by Zig, and windows-x86_64 by MinGW-w64; by default all of them. Those by Zig use one thread, and on
# x86-64 its plain instructions. Nobody has run the programs for macOS yet, and their archives say so. Build folders
# stay in build/programs for the next time.
set -euo pipefail

destination=$(realpath -m "${1:?usage: make_programs.sh DESTINATION [SYSTEM]...}")
shift
systems=("$@")
[ $# -gt 0 ] || systems=(macos-arm64 macos-x86_64 linux-x86_64 linux-arm64 windows-x86_64)
root=$(realpath "$(dirname "$0")/../..")
work=$root/build/programs
mkdir -p "$destination"
# The user's own flags may be for the user's own processor.
unset CXXFLAGS LDFLAGS

configure() { # BUILD TOOLCHAIN CMAKE_ARGUMENT...
    cmake -S "$root" -B "$1" --toolchain "$root/external/toolchains/$2" -DTRACKED_MCF_PLUGIN=OFF \
        -DTRACKED_MCF_TESTS=OFF "${@:3}"
}
with_zig() { # BUILD TARGET
    [ -x "$work/zig/zig" ] || "$root/external/zig.sh" "$work/zig"
    configure "$1" zig.cmake "-DTRACKED_MCF_ZIG=$work/zig/zig" "-DTRACKED_MCF_ZIG_TARGET=$2"
}

for system in "${systems[@]}"; do
    build=$work/$system remark='' program=tracked_mcf
    case $system in
        macos-arm64) with_zig "$build" aarch64-macos.13.0 && remark=-never-run ;;
        macos-x86_64) with_zig "$build" x86_64-macos.13.0 && remark=-never-run ;;
        linux-x86_64) with_zig "$build" x86_64-linux-gnu.2.28 ;;
        linux-arm64) with_zig "$build" aarch64-linux-gnu.2.28 ;;
        windows-x86_64)
            program=tracked_mcf.exe
            "$root/external/install_debian.sh" windows
            configure "$build" x86_64-w64-mingw32.cmake "-DCMAKE_EXE_LINKER_FLAGS=-s"
            ;;
        *) echo "make_programs.sh: unknown system '$system'" >&2 && exit 2 ;;
    esac
    cmake --build "$build" -j "$(nproc)" --target tracked_mcf
    version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
    name=tracked-mcf-$version-$system$remark
    rm -rf "${work:?}/$name" && mkdir "$work/$name"
    cp "$build/filter_tracked_mcf/tool/$program" "$root/filter_tracked_mcf/LICENSE" \
        "$root/filter_tracked_mcf/package/THIRD_PARTY.txt" "$root/filter_tracked_mcf/tool/README.md" "$work/$name"
    tar -C "$work" -czf "$destination/$name.tar.gz" "$name"
    echo "$destination/$name.tar.gz"
done
