#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Does what the pages say, in their order, in one clone on a Debian where nothing was installed:
# pages_work.sh FOLDER
#
# Left out is what needs a cluster, a browser or hours, what is built in other folders than build, and what other tests
# run: the gallery, filter scripts, the plugin in PyMeshLab, and the contributor's guide. Exits with 77 if this machine
# cannot install another Debian.
set -euo pipefail

here=$(dirname "$(realpath "$0")")
root=$(realpath "$here/../../..") folder=$(realpath -m "$1")
pages=(README.md filter_tracked_mcf/{package,hosts/{meshlab,python,cli}}/README.md filter_tracked_mcf/hosts/cli/folder.md
    tests/research{,/experiments,/benchmark}/README.md)
lines_left_out='^jupyter lab|figure_2|tests/run\.sh'
blocks_left_out='SCHEDULER|load_plugin|xvfb-run|-B build-'

"$here/lay_system.sh" bookworm "$folder/system"
system=$folder/pages_system clone=$folder/clone
rm -rf --one-file-system "$system" "$clone"
cp -a "$folder/system" "$system"
git clone -q "$root" "$clone"

# The meshes of the pages: a scan, one whose new faces are selected, and a folder of scans.
cd "$clone"
"$here/../bumpy_bowl.py" scan.off selected.ply
"$here/../float_ply.py" scan.off scan.ply
cp selected.ply closed.ply
mkdir scans && cp scan.off scan.ply scans
xz -k scan.ply

# What a page takes for granted.
cat > for_python.py << 'END'
import numpy, tracked_mcf, trimesh
scan = trimesh.load_mesh("scan.ply", process=False)
vertices, faces = numpy.asarray(scan.vertices), numpy.asarray(scan.faces)
new_faces, meshes = numpy.arange(2000), [(vertices, faces)] * 2
END
inside() { "$here/in_system.sh" "$system" "$@"; }
inside bash -c 'apt-get -q update && apt-get -q install -y --no-install-recommends git ca-certificates
    echo "APT::Get::Assume-Yes \"true\";" > /etc/apt/apt.conf.d/91yes
    git config --global --add safe.directory "*"'

# Each block is a file: NUMBER.sh or NUMBER.py.
mkdir blocks
awk '/^```(sh|python)$/ { file = sprintf("blocks/%02d.%s", ++count, $1 ~ /sh/ ? "sh" : "py"); print "# " FILENAME > file; next }
    /^```$/ { file = "" } file { print > file }' "${pages[@]}"
sed -i -E "\\;$lines_left_out;d; s/run_benchmark\.py/& --quick/" blocks/*
for block in $(grep -LE -- "$blocks_left_out" blocks/*); do
    echo "== $(cat "$block")"
    # The user is root, who needs no sudo. A block finds what the ones before have installed.
    if [[ $block = *.sh ]]; then
        inside bash -euc 'sudo() { "$@"; }; export PATH=~/smooth/bin:$PATH; . "$0"' "$block"
    else
        cat for_python.py "$block" > block.py
        inside /root/smooth/bin/python block.py
    fi
    # Some examples of the package's page import it.
    [[ $(cat "$block") != *trimesh*compiles* ]] || inside /root/smooth/bin/pip install -q joblib
done
