#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Operates the filter's dialog in MeshLab 2022.02 or 2025.07 as a user would, and takes pictures. Fails
# unless the preview shows the result, is undone again, and agrees with Apply:
# xvfb-run -a -s "-screen 0 1920x1080x24" dialog_screenshot.sh RELEASE PLUGIN MESH OUT_DIR [FILTER]
#
# PLUGIN is copied to the folder of a user's plugins. If PLUGIN is '', FILTER is one of MeshLab's own
# smoothers. The order of Tab differs between releases and changes after clicks, so the script uses the
# mouse.
set -euo pipefail

source "$(dirname "$0")/../window.sh"
release=$1 plugin=$2 mesh=$3 out=$(realpath -m "$4") filter=${5:-Mean Curvature Flow}
set_buttons "$release"

make_home
if [ -n "$plugin" ]; then
    install -D -t "$HOME/.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/$release" "$plugin"
fi
start_meshlab meshlab "$mesh"
start_filter
picture dialog
surface before

wait_for "the dialog fits a screen of 1280 by 960" smaller_than 1280 830
click_help
sleep 0.5
wait_for "the dialog with its help fits this screen, too" smaller_than 1280 830
# Help makes the dialog wider than window.sh leaves room for.
xdotool windowmove --sync "$dialog" $((width - 890)) 80
picture dialog_with_help
click_help
xdotool windowmove --sync "$dialog" $((width - 790)) 80 sleep 0.5
click_preview
wait_for "the preview shows the result" unlike before
wait_for "MeshLab logs that the filter succeeded" grep -q "Applied filter:\? $filter in" "$out/log.txt"
picture preview
surface previewed
click_preview
wait_for "the preview is undone" same_as before
click_apply
wait_for "Apply agrees with the preview" same_as previewed
picture applied
if grep -iE "(filter|plugin).*(failed|cannot|error)" "$out/log.txt"; then exit 1; fi
echo "pictures are in $out"
