#!/usr/bin/env bash
# Makes the package, unpacks it, and checks that it holds what it should and nothing of this build
# folder, that its text names what the files need, and that they work:
# package_works.sh BUILD_DIR RELEASE SCALAR TOOL APPLY_FILTER WORK_DIR
#
# TOOL is empty if it is not built, APPLY_FILTER if the plugin's MeshLab is not here.
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
# Told that Ninja made the build folder, cpack does not make everything in it first.
cpack --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_CMAKE_GENERATOR=Ninja
host=meshlab-$release
[ "$scalar" = float ] || host=pymeshlab-${release/.0/.}
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
name=tracked-mcf-$version-$host-$scalar-linux-$(uname -m)
[ "$(echo ./*.tar.gz)" = "./$name.tar.gz" ] || fail "made $(echo ./*.gz) rather than $name.tar.gz"
expected=$(printf '%s\n' "$name/INSTALL.txt" "$name/$plugin" ${tool:+"$name/$tool"})
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
# Instructions of the AVX family, with names that begin with v, only in the kernels that are chosen
# for the processor when the program runs. The build's files still have their names.
for file in "$build/filter_tracked_mcf/plugin/$plugin" \
    ${tool:+"$build/filter_tracked_mcf/tool/$tool"}; do
    objdump -d --no-show-raw-insn "$file" | awk -v file="$file" '
        /^[0-9a-f]+ <.*>:$/ { name = $2; any = name !~ /kernels_avx/ }
        $2 ~ /^v[a-z]/ { vectors++; if (any) others[name] = 1 }
        END {
            for (name in others) print name " of " file " is for some processors only"
            for (name in others) failed = 1
            print vectors + 0 " instructions of the AVX family, all in chosen versions"
            exit failed
        }' || fail "not for any processor"
done

echo "== What the text says is needed"
# The other way to ask: by symbols, rather than by the files' lists of versions.
largest() { # SET FILE...
    objdump -T "${@:2}" | sed -n "s/.*\*UND\*.*[ (]$1_\([0-9.]*\)[) ].*/\1/p" | sort -V | tail -n 1
}
says() { grep -q -- "$1" INSTALL.txt || fail "INSTALL.txt does not say $1"; }
for file in "${binaries[@]}"; do
    line=$(grep -A 1 "^ *$file\$" INSTALL.txt)
    for set in GLIBC GLIBCXX CXXABI GOMP; do
        version=$(largest "$set" "$file")
        [ -n "$version" ] || fail "no symbol of $file is of a $set"
        grep -qwF "${set}_$version" <<< "$line" || fail "$file needs ${set}_$version"
    done
done
says "MeshLab ${host##*-}, $scalar precision"
says " glibc $(largest GLIBC "${binaries[@]}") or later"
says "GLIBCXX $(largest GLIBCXX "${binaries[@]}") and CXXABI $(largest CXXABI "${binaries[@]}") or"
says " Qt $(largest Qt "$plugin"),"
[ "$scalar" = float ] || says "load_plugin('/path/$plugin')"
! grep -n '@\|.\{101\}' INSTALL.txt || fail "INSTALL.txt has lines that are not for a reader"

echo "== It works"
"$source/tests/hosts/bumpy_bowl.py" "$work/bowl.off"
"$source/tests/hosts/float_ply.py" "$work/bowl.off" "$work/in.ply"
if [ -n "$tool" ]; then
    [[ $("./$tool" --help) == *--step-size* ]] || fail "no help"
    "./$tool" "$work/in.ply" "$work/tool.ply" --depth 5 --step-size 1e-4 --iterations 2 --quiet
    "$source/tests/hosts/compare_positions.py" "$work/tool.ply" "$work/tool.ply" "$work/in.ply" 0.5
fi
if [ -n "$apply_filter" ]; then
    "$apply_filter" "./$plugin" "$work/in.ply" "$work/host.ply" depth=5 step_size=1e-4 iterations=2
fi
if [ -n "$tool" ] && [ -n "$apply_filter" ]; then
    ulps=0.5 # the host's floats are the tool's doubles, rounded
    [ "$scalar" = float ] || ulps=0
    "$source/tests/hosts/compare_positions.py" "$work/host.ply" "$work/tool.ply" "$work/in.ply" \
        "$ulps"
fi
