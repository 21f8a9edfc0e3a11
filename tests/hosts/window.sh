# How the scripts that source this work MeshLab's window, as a person would, and look at it. They run
# on a display of their own, xvfb-run -a -s "-screen 0 1360x1280x24", and say $out, a folder for
# pictures and MeshLab's log, and $filter, the filter's name. Here $window becomes MeshLab's window
# and $dialog the filter's.

# MeshLab's own, so that nothing of the user's is read or changed.
make_home() {
    rm -rf "$out"
    mkdir -p "$out"
    mkdir -m 700 "$out/home"
    unset XDG_CONFIG_HOME XDG_DATA_HOME
    export HOME="$out/home" XDG_RUNTIME_DIR="$out/home"
}
start_meshlab() { # PROGRAM MESH
    LIBGL_ALWAYS_SOFTWARE=1 "$@" > "$out/log.txt" 2>&1 &
    meshlab=$!
    trap 'kill $meshlab' EXIT
    wait_for "MeshLab opens the mesh" grep -q "All files opened" "$out/log.txt"
    window=$(timeout 30 xdotool search --sync --onlyvisible --name "Project_1")
    wait_for "the window fills the screen" fill_screen
}
# Away from the mesh, and with the keyboard's focus.
start_filter() {
    wait_for "the filter is found and its dialog opens" open_dialog
    dialog=$(find_dialog)
    xdotool windowmove --sync "$dialog" 750 80 windowfocus --sync "$dialog"
}

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
find_dialog() { timeout 10 xdotool search --sync --onlyvisible --name "^$filter\$"; }
# On a busy machine keys come before the search is there to take them: begin again.
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
# The mesh's part of the window: left of where the dialog is put, above the frame rate.
surface() { import -window root -crop 740x740+5+75 +repage "$out/$1.png"; }
differing_pixels() { # PICTURE: of the surface at another time
    surface now
    convert "$out/$1.png" "$out/now.png" -compose difference -composite -colorspace Gray \
        -threshold 0 -format "%[fx:round(mean*w*h)]" info:
}
same_as() { [ "$(differing_pixels "$1")" -le 50 ]; }
unlike() { [ "$(differing_pixels "$1")" -ge 5000 ]; }
