#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian package into a minimal system of this Debian, smooths a mesh with its filter in
# stock meshlabserver and with its program, removes the package, and checks that nothing is left. lintian
# must find no errors: installed_package_works.sh PACKAGE_DIR FOLDER
#
# FOLDER keeps the system for the next time. Exits with 77 if this machine cannot install one.
set -euo pipefail

packages=$(realpath "$1") folder=$(realpath -m "$2")
hosts=$(realpath "$(dirname "$0")/../hosts")
system=$folder/system work=$folder/work name=meshlab-plugin-tracked-mcf
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
"$hosts/systems/lay_system.sh" "$suite" "$system"

rm -rf "$work"
mkdir -p "$work/home"
cd "$work"
cp "$packages"/*.deb .
package=$(echo ./*.deb)
inside() { "$hosts/systems/in_system.sh" "$system" "$@" > log.txt 2>&1 || fail "$*"; }
fail() {
    tail -n 40 log.txt
    echo "FAILED: $*"
    exit 1
}
apt_get() { inside env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends "$@"; }
# From outside, where nothing is mounted on the system. Caches, logs and the X server's keymap may differ.
files_of_system() { find "$system" -print | grep -vE "^$system/var/(cache|log|lib/xkb)/" | sort; }

echo "== Install"
apt_get update
apt_get install lintian xvfb xauth meshlab
inside dpkg --purge "$name" # that an interrupted run left
files_of_system > before.txt
apt_get install "$package"
inside dpkg --verify "$name"
[ ! -s log.txt ] || fail "dpkg --verify"
comm -13 before.txt <(files_of_system) | sed "s|^$system||"
apt_get -s remove meshlab
grep "^Remv $name " log.txt || fail "the package does not depend on meshlab"

echo "== Use"
"$hosts/bumpy_bowl.py" bowl.off
"$hosts/float_ply.py" bowl.off in.ply
"$hosts/legacy/flow_script.sh" depth=5 detail_size=0.125 iterations=2 > smooth.mlx
inside env HOME="$work/home" XDG_CACHE_HOME="$work/home" xvfb-run -a meshlabserver -i in.ply -s smooth.mlx -o host.ply
grep -m1 -o "Smoothed .*" log.txt || fail "meshlabserver did not smooth"
inside tracked_mcf in.ply tool.ply --depth 5 --detail-size 0.125 --iterations 2 --quiet
"$hosts/compare_positions.py" host.ply tool.ply in.ply 0.5

mkdir -p scans/sub
cp in.ply scans/sub
inside tracked_mcf_folder scans smooth --depth 5 --detail-size 0.125 --iterations 2
cmp smooth/sub/in.ply tool.ply

echo "== lintian"
inside lintian --fail-on error,warning "$package"
cat log.txt

echo "== Remove"
apt_get purge "$name"
diff before.txt <(files_of_system) || fail "files are left behind"
inside sh -c "! dpkg-query -W $name"
echo "nothing is left"
