#!/usr/bin/env bash
# Works the filter's dialog in stock MeshLab 2022.02 or 2025.07 as a person would and takes pictures on
# the way; fails if the preview does not show the result, take it back, and agree with what Apply does:
# xvfb-run -a -s "-screen 0 1360x1280x24" dialog_screenshot.sh RELEASE PLUGIN MESH OUT_DIR [FILTER]
#
# PLUGIN is put where MeshLab looks for a user's own; with none (''), FILTER is a smoother of MeshLab's.
# The order in which Tab goes differs between the releases and after every click, so the mouse it is.
set -euo pipefail

source "$(dirname "$0")/../window.sh"
release=$1 plugin=$2 mesh=$3 out=$(realpath -m "$4") filter=${5:-Mean Curvature Flow}
case $release in # How far above the dialog's lower edge the box is.
    2022.02) preview_height=79 ;;
    *) preview_height=169 ;;
esac
click() { # X HEIGHT: from the dialog's left, or, if negative, right, and from its lower edge
    eval "$(xdotool getwindowgeometry --shell "$dialog")"
    xdotool mousemove --window "$dialog" $(($1 < 0 ? WIDTH + $1 : $1)) $((HEIGHT - $2)) click 1
}
click_help() { click -85 51; }
click_apply() { click -85 22; }
click_preview() { click 17 "$preview_height"; }

make_home
if [ -n "$plugin" ]; then
    install -D -t "$HOME/.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/$release" "$plugin"
fi
start_meshlab meshlab "$mesh"
start_filter
picture dialog
surface before

wait_for "the dialog fits a screen of 1280 by 960" smaller_than 1280 960
click_help
# It scrolls what does not fit, unless enlarged.
xdotool windowsize --sync "$dialog" 600 930
picture dialog_with_help
click_help
sleep 0.5
click_preview
wait_for "the preview shows the result" unlike before
wait_for "MeshLab logs that the filter succeeded" grep -q "Applied filter:\? $filter in" "$out/log.txt"
picture preview
surface previewed
click_preview
wait_for "the preview is taken back" same_as before
click_apply
wait_for "Apply agrees with the preview" same_as previewed
picture applied
if grep -iE "(filter|plugin).*(failed|cannot|error)" "$out/log.txt"; then exit 1; fi
echo "pictures are in $out"
