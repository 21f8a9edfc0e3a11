#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Smooths a scan from a fresh clone: installs what is missing (Debian bookworm), fetches the Stanford
# bunny of CGAL's examples, builds, smooths the bunny in stock meshlabserver with our plugin, and
# draws it before and after: smooth_a_scan.sh
#
# All results are in build/. The installed MeshLab stays as it is.
set -euo pipefail

root=$(realpath "$(dirname "$0")/../..")
build=$root/build
demo=$build/demo
hosts=$root/tests/hosts/legacy
mesh=$build/cgal-meshes/bunny00.off

say() { printf '\n== %s\n' "$*"; }

say "Installing what is missing"
"$root/external/install_debian.sh" demo
"$root/external/cgal_meshes.sh" "$build/cgal-meshes"
"$root/external/meshlab_source.sh" "$build/meshlab-source"

say "Building"
cmake -S "$root" -B "$build" -DTRACKED_MCF_TOOL=ON -DTRACKED_MCF_PLUGIN=ON -DTRACKED_MCF_TESTS=OFF
cmake --build "$build" --parallel "$(nproc)"

say "Smoothing in meshlabserver"
mkdir -p "$demo"
plugin=$build/filter_tracked_mcf/hosts/meshlab/libfilter_tracked_mcf.so
libraries=$(sed -n 's/^MESHLAB_LIBRARY_DIR:INTERNAL=//p' "$build/CMakeCache.txt")
"$hosts/private_prefix.sh" "$demo/meshlab" "$libraries/plugins" "$plugin"
"$hosts/flow_script.sh" detail_size=0.08 > "$demo/smooth.mlx" # 5 % of the diagonal
rm -f "$demo/smooth.ply"
if ! xvfb-run -a "$demo/meshlab/bin/meshlabserver" -i "$mesh" -s "$demo/smooth.mlx" \
    -o "$demo/smooth.ply" > "$demo/meshlabserver.log" 2>&1 || [ ! -e "$demo/smooth.ply" ] ||
    ! grep -m1 -o "Smoothed .*" "$demo/meshlabserver.log"; then
    cat "$demo/meshlabserver.log"
    echo "smooth_a_scan.sh: meshlabserver failed; see above" >&2
    exit 1
fi

say "Drawing"
/usr/bin/python3 "$root/tests/demo/render.py" --output "$demo/before_and_after.png" \
    --labels before after -- "$mesh" "$demo/smooth.ply"

say "Done"
cat << TEXT
the scan:                 $mesh
smoothed:                 $demo/smooth.ply
before and after:         $demo/before_and_after.png
the MeshLab script:       $demo/smooth.mlx
MeshLab with the plugin:  $demo/meshlab/bin/meshlab
the command-line program: $build/filter_tracked_mcf/hosts/cli/tracked_mcf
TEXT
