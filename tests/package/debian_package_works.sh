#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian package and checks its fields and files, and that apt would install it here:
# debian_package_works.sh BUILD_DIR RELEASE TOOL MESHLAB_LIBRARY_DIR WORK_DIR
#
# TOOL is empty if it is not built. The package stays in WORK_DIR for installed_package_works.sh.
set -euo pipefail

build=$(realpath "$1") release=$2 tool=$3 library_dir=$4 work=$(realpath -m "$5")
source=$(realpath "$(dirname "$0")/../..")
name=meshlab-plugin-tracked-mcf
plugin=libfilter_tracked_mcf.so
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
    echo "FAILED: $*"
    exit 1
}

echo "== Fields"
# With Ninja as the generator, cpack does not build everything first.
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_CMAKE_GENERATOR=Ninja
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")-1+meshlab$release
package=${name}_${version}_$(dpkg --print-architecture).deb
[ "$(echo ./*.deb)" = "./$package" ] || fail "made $(echo ./*.deb) rather than $package"
dpkg-deb --info "$package"
field() { dpkg-deb --field "$package" "$1"; }
[ "$(field Version)" = "$version" ] || fail "version $(field Version)"
[[ $(field Maintainer) =~ ^[^\<]+' <'[^@]+@[^@]+'>'$ ]] || fail "maintainer $(field Maintainer)"

# Of this release, all versions of Debian's package satisfy the dependency, and no others do.
bounds=$(field Depends | grep -o 'meshlab ([^)]*)' | tr -d '()')
satisfies() { # VERSION
    local relation bound
    while read -r _ relation bound; do
        dpkg --compare-versions "$1" "$relation" "$bound" || return
    done <<< "$bounds"
}
[ "$(wc -l <<< "$bounds")" = 2 ] || fail "depends on $bounds"
for fits in "$(dpkg-query -W -f '${Version}' meshlab)" "$release"{~dfsg-4,-1,+dfsg1-1+b1}; do
    satisfies "$fits" || fail "MeshLab $fits does not satisfy the dependency"
done
for other in 2019.12-1 2021.10-1 "$release.1-1" 2026.01~dfsg-1; do
    ! satisfies "$other" || fail "MeshLab $other satisfies the dependency"
done
echo "== Files"
expected=$({
    printf '/usr/share/doc/%s\n' "$name"/{THIRD_PARTY.txt,changelog.Debian.gz,changelog.gz,copyright}
    echo "$library_dir/plugins/$plugin"
    [ -z "$tool" ] || printf '%s\n' "/usr/bin/$tool"{,_folder} "/usr/share/man/man1/$tool"{,_folder}.1.gz
} | LC_ALL=C sort)
dpkg-deb --extract "$package" files
found=$(cd files && find . -type f | sed 's/^\.//' | LC_ALL=C sort)
[ "$found" = "$expected" ] || fail "holds $found rather than $expected"
[ -z "$(find files ! -perm -a+r -o -perm /022)" ] || fail "wrong modes: $(dpkg-deb -c "$package")"
for file in "files$library_dir/plugins/$plugin" ${tool:+"files/usr/bin/$tool"}; do
    ! readelf -S "$file" | grep -wF .symtab || fail "$file is not stripped"
    ! readelf -d "$file" | grep -E 'RPATH|RUNPATH' || fail "$file looks for libraries in a folder"
    ! grep -F -e "$build" -e "$source" "$file" || fail "$file names a folder of this machine"
done

if [ -n "$tool" ]; then
    echo "== The command for folders"
    "$source/tests/cli/folder_test.py" "files/usr/bin/$tool"{,_folder} || fail "${tool}_folder does not smooth a folder"
    zgrep -q WORKERS "files/usr/share/man/man1/${tool}_folder.1.gz" || fail "the man page does not have the variables"
fi

echo "== Any processor"
# The names of AVX instructions begin with v. The files of the build, unlike the packed ones, still have symbols.
for file in "$build/filter_tracked_mcf/hosts/meshlab/$plugin" ${tool:+"$build/filter_tracked_mcf/hosts/cli/$tool"}; do
    objdump -d --no-show-raw-insn "$file" | awk -v file="$file" '
        /^[0-9a-f]+ <.*>:$/ { name = $2 }
        $2 ~ /^v[a-z]/ { others[name] = 1 }
        END {
            for (name in others) print name " of " file " needs AVX"
            for (name in others) failed = 1
            exit failed
        }' || fail "not for any processor"
done

echo "== Changelog"
zcat "files/usr/share/doc/$name/changelog.Debian.gz" > changelog
said=$(dpkg-parsechangelog -l changelog -S Version 2>&1) || true
[ "$said" = "$version" ] || fail "changelog: $said"

echo "== What apt would do"
would=$(LC_ALL=C apt-get -s install "./$package" | grep -E '^(Inst|Remv)') || fail "apt would not install it"
echo "$would"
[[ $would == "Inst $name "* ]] && [ "$(wc -l <<< "$would")" = 1 ] || fail "apt would do more"
