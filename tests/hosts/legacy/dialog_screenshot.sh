#!/usr/bin/env bash
# Works the filter's dialog in stock MeshLab as a person would and takes pictures on the way; fails
# if the preview does not show the result, take it back, and agree with what Apply does:
# xvfb-run -a -s "-screen 0 1360x1280x24" dialog_screenshot.sh PREFIX MESH OUT_DIR
#
# A dialog grows by itself to two thirds of the screen's height, hence a high screen: all help fits.
set -euo pipefail

prefix=$1 mesh=$2 out=$(realpath -m "$3")
rm -rf "$out"
mkdir -p "$out"
mkdir -m 700 "$out/home"
export HOME="$out/home" XDG_RUNTIME_DIR="$out/home" LIBGL_ALWAYS_SOFTWARE=1

"$prefix/bin/meshlab" "$mesh" > "$out/log.txt" 2>&1 &
meshlab=$!
trap 'kill $meshlab' EXIT

wait_for() { # WHAT COMMAND...: until it succeeds
    for _ in {1..300}; do
        if "${@:2}" > /dev/null 2>&1; then return; fi
        sleep 0.2
    done
    import -window root "$out/failed.png"
    echo "failed: $1 (see $out/failed.png and log.txt)" >&2
    exit 1
}
# MeshLab gives its window a size of its own as it starts, at any moment.
fill_screen() {
    xdotool windowsize "$window" 1360 1280 sleep 1
    xdotool getwindowgeometry "$window" | grep -q 1360x1280
}
find_dialog() { timeout 10 xdotool search --sync --onlyvisible --name "^Mean Curvature Flow$"; }
# On a busy machine keys come before the search is there to take them: begin again.
open_dialog() {
    xdotool windowfocus --sync "$window" key Escape sleep 0.5 key ctrl+f sleep 1
    xdotool type --delay 50 "Mean Curvature Flow"
    xdotool sleep 1.5 key Down sleep 0.5 key Return
    find_dialog
}
# Were it as high as MeshLab lets it grow, nearly two thirds of this screen, help would be cut off.
fits_a_screen() {
    eval "$(xdotool getwindowgeometry --shell "$dialog")"
    [ "$WIDTH" -le 1280 ] && [ "$HEIGHT" -lt 830 ]
}
picture() { sleep 0.5; import -window root "$out/$1.png"; }
# The mesh's part of the window: left of where the dialog is put, above the frame rate.
surface() { import -window root -crop 740x740+5+75 +repage "$out/$1.png"; }
differing_pixels() { # PICTURE: of the surface at another time
    surface now
    { compare -metric AE "$out/$1.png" "$out/now.png" null: 2>&1 || true; } | cut -d' ' -f1
}
same_as() { [ "$(differing_pixels "$1")" -le 50 ]; }
unlike() { [ "$(differing_pixels "$1")" -ge 5000 ]; }

wait_for "MeshLab opens the mesh" grep -q "All files opened" "$out/log.txt"
window=$(timeout 30 xdotool search --sync --onlyvisible --name "Project_1")
wait_for "the window fills the screen" fill_screen

wait_for "the filter is found and its dialog opens" open_dialog
dialog=$(find_dialog)
xdotool windowmove --sync "$dialog" 750 80 windowfocus --sync "$dialog"
picture dialog
surface before

# The focus starts at Apply; Tab goes on to Default and Preview, and backwards to Close and Help.
xdotool key shift+Tab shift+Tab space
picture dialog_with_help
wait_for "the dialog fits a screen of 1280 by 960 with all of its help" fits_a_screen
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
