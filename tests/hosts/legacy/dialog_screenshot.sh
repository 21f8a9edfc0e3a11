#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Operates the filter's dialog in MeshLab 2020.09 as a user would, and takes pictures. Fails unless the
# preview shows the result, is undone again, and agrees with Apply:
# xvfb-run -a -s "-screen 0 1920x1080x24" dialog_screenshot.sh PREFIX MESH FILTER OUT_DIR
#
# A dialog grows to two thirds of the screen's height: 720 pixels on this screen.
set -euo pipefail

source "$(dirname "$0")/../window.sh"
prefix=$1 mesh=$2 filter=$3 out=$(realpath -m "$4")
make_home
start_meshlab "$prefix/bin/meshlab" "$mesh"
start_filter
picture dialog
surface before

# The focus starts at Apply. Tab leads to Default and Preview, Shift+Tab to Close and Help.
xdotool key shift+Tab shift+Tab space
picture dialog_with_help
# At its largest height, two thirds of this screen, the dialog would cut help off.
wait_for "the dialog is not as high as it may be, so all help is readable" smaller_than 1280 720
xdotool key space sleep 0.5 key Tab Tab Tab Tab space
wait_for "the preview shows the result" unlike before
wait_for "the filter logs what it did" grep -q "Vertices moved" "$out/log.txt"
picture preview
surface previewed
xdotool key space
wait_for "the preview is undone" same_as before
xdotool key shift+Tab shift+Tab space
wait_for "Apply agrees with the preview" same_as previewed
picture applied
if grep -i "filter failed" "$out/log.txt"; then exit 1; fi
echo "pictures are in $out"
