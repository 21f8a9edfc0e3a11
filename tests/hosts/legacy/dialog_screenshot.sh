#!/usr/bin/env bash
# Works the filter's dialog in stock MeshLab 2020.09 as a person would and takes pictures on the way;
# fails if the preview does not show the result, take it back, and agree with what Apply does:
# xvfb-run -a -s "-screen 0 1360x1280x24" dialog_screenshot.sh PREFIX MESH OUT_DIR
#
# A dialog grows by itself to two thirds of the screen's height, hence a high screen: all help fits.
set -euo pipefail

source "$(dirname "$0")/../window.sh"
prefix=$1 mesh=$2 out=$(realpath -m "$3") filter="Mean Curvature Flow"
make_home
start_meshlab "$prefix/bin/meshlab" "$mesh"
start_filter
picture dialog
surface before

# The focus starts at Apply; Tab goes on to Default and Preview, and backwards to Close and Help.
xdotool key shift+Tab shift+Tab space
picture dialog_with_help
# Were it as high as MeshLab lets it grow, nearly two thirds of this screen, help would be cut off.
wait_for "the dialog fits a screen of 1280 by 960 with all of its help" smaller_than 1280 830
xdotool key space sleep 0.5 key Tab Tab Tab Tab space
wait_for "the preview shows the result" unlike before
wait_for "the filter logs what it did" grep -q "mean-curvature flow" "$out/log.txt"
picture preview
surface previewed
xdotool key space
wait_for "the preview is taken back" same_as before
xdotool key shift+Tab shift+Tab space
wait_for "Apply agrees with the preview" same_as previewed
picture applied
if grep -i "filter failed" "$out/log.txt"; then exit 1; fi
echo "pictures are in $out"
