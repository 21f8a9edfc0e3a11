# SPDX-License-Identifier: GPL-3.0-or-later
# Functions that operate MeshLab's window as a user would, for scripts that source this file. The
# scripts run on a display of their own, such as xvfb-run -a -s "-screen 0 1920x1080x24". They set $out, a
# folder for pictures and MeshLab's log, and $filter, the filter's name. The functions set $window,
# MeshLab's window, $dialog, the filter's dialog, and $width and $height, the size of the screen.

# A new home folder, so that the test neither reads nor changes the user's settings.
make_home() {
    rm -rf "$out"
    mkdir -p "$out"
    mkdir -m 700 "$out/home"
    unset XDG_CONFIG_HOME XDG_DATA_HOME
    export HOME="$out/home" XDG_RUNTIME_DIR="$out/home"
}
start_meshlab() { # PROGRAM MESH
    read -r width height < <(xdotool getdisplaygeometry)
    LIBGL_ALWAYS_SOFTWARE=1 "$@" > "$out/log.txt" 2>&1 &
    meshlab=$!
    trap 'kill $meshlab' EXIT
    wait_for "MeshLab opens the mesh" grep -q "All files opened" "$out/log.txt"
    window=$(timeout 30 xdotool search --sync --onlyvisible --name "Project_1")
    wait_for "the window fills the screen" fill_screen
}
# Opens the dialog, moves it away from the mesh and gives it the keyboard focus.
start_filter() {
    wait_for "the filter is found and its dialog opens" open_dialog
    dialog=$(find_dialog)
    xdotool windowmove --sync "$dialog" $((width - 790)) 80 windowfocus --sync "$dialog"
}

# The mouse reaches the dialog's buttons at distances from its edges, which differ between releases.
set_buttons() { # RELEASE
    case $1 in # Distance of the box from the dialog's lower edge.
        2020.09) preview_height=83 ;;
        2022.02) preview_height=79 ;;
        *) preview_height=169 ;;
    esac
}
click() { # X HEIGHT: X from the left edge, or from the right if negative; HEIGHT from the lower edge
    eval "$(xdotool getwindowgeometry --shell "$dialog")"
    xdotool mousemove --window "$dialog" $(($1 < 0 ? WIDTH + $1 : $1)) $((HEIGHT - $2)) click 1
}
click_help() { click -85 51; }
click_apply() { click -85 22; }
click_close() { click 85 22; }
click_preview() { click 17 "$preview_height"; }

wait_for() { # WHAT COMMAND...: repeats COMMAND until it succeeds
    for _ in {1..300}; do
        if "${@:2}" > /dev/null 2>&1; then return; fi
        sleep 0.2
    done
    import -window root "$out/failed.png"
    echo "failed: $1 (see $out/failed.png and log.txt)" >&2
    exit 1
}
# MeshLab changes the size of its window at an unknown time during its start.
fill_screen() {
    xdotool windowsize "$window" "$width" "$height" sleep 1
    xdotool getwindowgeometry "$window" | grep -q "${width}x$height"
}
find_dialog() { timeout 10 xdotool search --sync --onlyvisible --name "^$filter\$"; }
# On a busy machine, keys may arrive before the search box is open. Then begin again.
open_dialog() {
    xdotool windowfocus --sync "$window" key Escape sleep 0.5 key ctrl+f sleep 1
    xdotool type --delay 50 "$filter"
    xdotool sleep 1.5 key Down sleep 0.5 key Return
    find_dialog
}
smaller_than() { # WIDTH HEIGHT
    eval "$(xdotool getwindowgeometry --shell "$dialog")"
    [ "$WIDTH" -le "$1" ] && [ "$HEIGHT" -lt "$2" ]
}
picture() { sleep 0.5; import -window root "$out/$1.png"; }
# The mesh's part of the window: left of the dialog, above the frame rate.
surface() { import -window root -crop $((width - 800))x740+5+75 +repage "$out/$1.png"; }
differing_pixels() { # PICTURE: an earlier picture of the surface
    surface now
    convert "$out/$1.png" "$out/now.png" -compose difference -composite -colorspace Gray \
        -threshold 0 -format "%[fx:round(mean*w*h)]" info:
}
same_as() { [ "$(differing_pixels "$1")" -le 50 ]; }
unlike() { [ "$(differing_pixels "$1")" -ge 5000 ]; }
