#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws a picture of a filter's dialog in stock MeshLab 2020.09:
# xvfb-run -a -s "-screen 0 1280x930x24" dialog_pictures.sh five_steps|flow_dialog PREFIX MESH OUT_DIR
#
# PREFIX is a MeshLab that has the plugin, such as build/demo/meshlab, which smooth_a_scan.sh makes. The README's
# five_steps is the window with the preview of Remove Noise on a noisy mesh, with a number at each step, and the mesh
# before. flow_dialog is the dialog of Mean Curvature Flow at its defaults, for the page of parameters.
set -euo pipefail

source "$(dirname "$0")/../hosts/window.sh"
kind=$1 prefix=$(realpath "$2") mesh=$3 out=$(realpath -m "$4")
case $kind in
    five_steps) filter="Remove Noise" dialog_height=600 ;;
    flow_dialog) filter="Mean Curvature Flow" dialog_height=630 ;;
    *) echo "dialog_pictures.sh: no picture $kind" >&2 && exit 2 ;;
esac

# These replace window.sh's functions, which are for a larger screen.
fill_screen() {
    xdotool windowsize "$window" 1280 930 sleep 1
    xdotool getwindowgeometry "$window" | grep -q 1280x930
}
surface() { import -window root -crop 740x640+5+75 +repage "$out/$1.png"; }

five_steps() {
    surface before
    xdotool key Tab Tab space # from Apply over Default to Preview
    wait_for "the preview shows the result" unlike before
    picture window
    badges=()
    number 1 36 34
    number 2 121 34
    number 3 $((X - 18)) $((Y + 138))
    number 4 $((X - 18)) $((Y + HEIGHT - 84))
    number 5 $((X + WIDTH - 40)) $((Y + HEIGHT - 22))
    font=$(fc-match -f '%{file}' sans:bold)
    convert "$out/before.png" -resize 40% -bordercolor white -border 2 -font "$font" -pointsize 18 -fill white \
        -gravity NorthWest -annotate +10+8 before "$out/inset.png"
    convert "$out/window.png" "$out/inset.png" -geometry +5+545 -composite -font "$font" -pointsize 20 "${badges[@]}" \
        -strip "$out/five_steps.png"
}
number() { # LABEL X Y: of the badge's centre
    badges+=(-fill '#c02020' -draw "circle $2,$3 $(($2 + 14)),$3"
        -fill white -draw "text $(($2 - 7)),$(($3 + 7)) '$1'")
}
flow_dialog() {
    picture window
    convert "$out/window.png" -crop "${WIDTH}x$HEIGHT+$X+$Y" +repage -strip "PNG24:$out/flow_dialog.png"
}

make_home
cd "$(dirname "$mesh")" # MeshLab's log on the picture shows no folder
start_meshlab "$prefix/bin/meshlab" "$(basename "$mesh")"
start_filter
xdotool windowmove --sync "$dialog" 752 80 windowsize --sync "$dialog" 500 "$dialog_height" sleep 0.5
eval "$(xdotool getwindowgeometry --shell "$dialog")"
"$kind"
echo "the picture is $out/$kind.png"
