#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the package, unpacks it, and checks its files, that they name no folder of this machine, that
# INSTALL.txt names the libraries that they need, and that they work:
# package_works.sh BUILD_DIR RELEASE SCALAR TOOL APPLY_FILTER WORK_DIR
#
# TOOL is empty if it is not built, APPLY_FILTER if the plugin's MeshLab is not installed.
set -euo pipefail

build=$(realpath "$1") release=$2 scalar=$3 tool=$4 apply_filter=$5 work=$(realpath -m "$6")
here=$(dirname "$(realpath "$0")")
source=$(realpath "$here/../..")
plugin=libfilter_tracked_mcf.so
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
    echo "FAILED: $*"
    exit 1
}

echo "== The archive"
# With Ninja as the generator, cpack does not build everything first.
cpack --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_CMAKE_GENERATOR=Ninja
host=meshlab-$release
[ "$scalar" = float ] || host=pymeshlab-${release/.0/.}
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
name=tracked-mcf-$version-$host-$scalar-linux-$(uname -m)
[ "$(echo ./*.tar.gz)" = "./$name.tar.gz" ] || fail "made $(echo ./*.gz) rather than $name.tar.gz"
expected=$(printf '%s\n' "$name/INSTALL.txt" "$name/LICENSE" "$name/THIRD_PARTY.txt" \
    "$name/$plugin" ${tool:+"$name/$tool"})
found=$(tar -tzf "$name.tar.gz" | grep -v '/$' | LC_ALL=C sort)
[ "$found" = "$expected" ] || fail "$name.tar.gz holds $found"
mkdir elsewhere
tar -xzf "$name.tar.gz" -C elsewhere
cd "elsewhere/$name"
binaries=("$plugin" ${tool:+"$tool"})
cat INSTALL.txt

echo "== Nothing of this build folder"
grep -rF -e "$build" -e "$source" . && fail "names a folder of this machine"
for file in "${binaries[@]}"; do
    readelf -d "$file" | grep -E 'RPATH|RUNPATH' && fail "$file looks for libraries in a folder"
done

echo "== Any processor"
# Only the kernels, which the program chooses for its processor at run time, may have AVX instructions,
# whose names begin with v. The files of the build, unlike the packed ones, still have symbols.
for file in "$build/filter_tracked_mcf/plugin/$plugin" \
    ${tool:+"$build/filter_tracked_mcf/tool/$tool"}; do
    objdump -d --no-show-raw-insn "$file" | awk -v file="$file" '
        /^[0-9a-f]+ <.*>:$/ { name = $2; any = name !~ /N_AVX[23]/ }
        $2 ~ /^v[a-z]/ { vectors++; if (any) others[name] = 1 }
        END {
            for (name in others) print name " of " file " needs AVX"
            for (name in others) failed = 1
            print vectors + 0 " AVX instructions, all in kernels chosen at run time"
            exit failed
        }' || fail "not for any processor"
done

echo "== The library versions in INSTALL.txt"
# needed_versions.sh reads the files' lists of versions; this test reads their symbols.
largest() { # SET FILE...
    objdump -T "${@:2}" | sed -n "s/.*\*UND\*.*[ (]$1_\([0-9.]*\)[) ].*/\1/p" | sort -V | tail -n 1
}
says() { grep -q -- "$1" INSTALL.txt || fail "INSTALL.txt does not say $1"; }
for file in "${binaries[@]}"; do
    line=$(grep -A 1 "^ *$file\$" INSTALL.txt)
    for set in GLIBC GLIBCXX CXXABI; do
        version=$(largest "$set" "$file")
        [ -n "$version" ] || fail "$file has no symbol of $set"
        grep -qwF "${set}_$version" <<< "$line" || fail "$file needs ${set}_$version"
    done
done
says "MeshLab ${host##*-}, $scalar precision"
says " glibc $(largest GLIBC "${binaries[@]}") or later"
says "GLIBCXX $(largest GLIBCXX "${binaries[@]}") and CXXABI $(largest CXXABI "${binaries[@]}") or"
says " Qt $(largest Qt "$plugin"),"
[ "$release" != 2020.09 ] ||
    says " /usr/lib/$(dpkg-architecture -q DEB_HOST_MULTIARCH)/meshlab/plugins/\$"
[ "$scalar" = float ] || says "load_plugin('/path/$plugin')"
! grep -n '@\|.\{101\}' INSTALL.txt || fail "INSTALL.txt has long lines or unset variables"

echo "== It works"
"$source/tests/hosts/bumpy_bowl.py" "$work/bowl.off"
"$source/tests/hosts/float_ply.py" "$work/bowl.off" "$work/in.ply"
if [ -n "$tool" ]; then
    [[ $("./$tool" --help) == *--detail-size* ]] || fail "no help"
    "./$tool" "$work/in.ply" "$work/tool.ply" --depth 5 --detail-size 0.1 --iterations 2 --quiet
    "$source/tests/hosts/compare_positions.py" "$work/tool.ply" "$work/tool.ply" "$work/in.ply" 0.5
fi
if [ -n "$apply_filter" ]; then
    "$apply_filter" "./$plugin" "$work/in.ply" "$work/host.ply" depth=5 detail_size=0.1 iterations=2
fi
if [ -n "$tool" ] && [ -n "$apply_filter" ]; then
    ulps=0.5 # the host's floats are the tool's doubles, rounded
    [ "$scalar" = float ] || ulps=0
    "$source/tests/hosts/compare_positions.py" "$work/host.ply" "$work/tool.ply" "$work/in.ply" \
        "$ulps"
fi
