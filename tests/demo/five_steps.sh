#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws the README's picture of five steps in MeshLab: opens a noisy mesh in stock MeshLab 2020.09, opens the
# filter's dialog, switches the preview on, and numbers the steps on a screenshot of the window, which also shows
# the mesh before:
# xvfb-run -a -s "-screen 0 1280x930x24" five_steps.sh PREFIX MESH OUT_DIR
#
# PREFIX is a MeshLab that has the plugin, such as build/demo/meshlab, which smooth_a_scan.sh makes.
set -euo pipefail

source "$(dirname "$0")/../hosts/window.sh"
prefix=$(realpath "$1") mesh=$2 out=$(realpath -m "$3") filter="Remove Noise"

# These replace window.sh's functions, which are for a larger screen.
fill_screen() {
    xdotool windowsize "$window" 1280 930 sleep 1
    xdotool getwindowgeometry "$window" | grep -q 1280x930
}
surface() { import -window root -crop 740x640+5+75 +repage "$out/$1.png"; }

make_home
cd "$(dirname "$mesh")" # MeshLab's log on the picture shows no folder
start_meshlab "$prefix/bin/meshlab" "$(basename "$mesh")"
start_filter
xdotool windowmove --sync "$dialog" 752 80 windowsize --sync "$dialog" 500 600 sleep 0.5
eval "$(xdotool getwindowgeometry --shell "$dialog")"
surface before
xdotool key Tab Tab space # from Apply over Default to Preview
wait_for "the preview shows the result" unlike before
picture window

badges=()
number() { # LABEL X Y: of the badge's centre
    badges+=(-fill '#c02020' -draw "circle $2,$3 $(($2 + 14)),$3"
        -fill white -draw "text $(($2 - 7)),$(($3 + 7)) '$1'")
}
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
echo "the picture is $out/five_steps.png"
