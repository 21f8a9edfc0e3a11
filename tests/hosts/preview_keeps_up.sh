#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Operates the filter's dialog while previews run that take longer than a user takes for a key. Fails unless
# each preview gives way to what the user does next, silently, and the picture is that of the dialog:
# xvfb-run -a -s "-screen 0 1920x1080x24" preview_keeps_up.sh RELEASE FILTER OUT_DIR MESHLAB [PLUGIN]
#
# MESHLAB is the program. PLUGIN is copied to the folder of a user's plugins.
set -euo pipefail

here=$(dirname "$0")
source "$here/window.sh"
release=$1 filter=$2 out=$(realpath -m "$3") program=$4 plugin=${5:-}
case "$filter in $release" in # A percentage, and the distance of its field from the dialog's upper edge.
    "Mean Curvature Flow in 2020.09") percentage=4.25 field_top=183 ;;
    "Mean Curvature Flow in "*) percentage=4.25 field_top=160 ;;
    "Remove Noise in 2020.09") percentage=0.15 field_top=184 ;;
    *) percentage=0.15 field_top=161 ;;
esac

type_percentage() { # PERCENTAGE: one key in 150 ms, then to another field
    eval "$(xdotool getwindowgeometry --shell "$dialog")"
    xdotool mousemove --window "$dialog" $((WIDTH - 70)) "$field_top" click 1 key ctrl+a
    xdotool type --delay 150 "$1"
    xdotool key Tab
    idle
}
click_preview_then() { # COMMAND...: does it while the preview runs
    click_preview
    xdotool sleep 0.5
    "$@"
    idle
}
escape() { xdotool key Escape; }
processor_ticks() { cut -d' ' -f14 "/proc/$meshlab/stat"; }
# MeshLab is idle if it needs less than 5 % of a processor.
is_idle() {
    local before
    before=$(processor_ticks)
    sleep 1
    [ $(($(processor_ticks) - before)) -lt 5 ]
}
idle() { sleep 0.3; wait_for "MeshLab is idle" is_idle; }
# A length's two numbers, or the inside of the box. The rest shows where focus and mouse are.
field() { import -window "$dialog" -crop 70x16+$((WIDTH - 105))+$((field_top - 8)) +repage "$out/$1.png"; }
box() { import -window "$dialog" -crop 8x8+13+$((HEIGHT - preview_height - 4)) +repage "$out/$1.png"; }
is_picture() { # PICTURE PART
    xdotool mousemove 0 0
    "$2" now
    compare -metric AE "$out/$1.png" "$out/now.png" null:
}
finished_runs() { grep -c "Vertices moved" "$out/log.txt" || true; }
runs_that_moved_nothing() { # COMMAND...
    local before
    before=$(finished_runs)
    "$@"
    idle
    wait_for "$* leaves the surface as it was" same_as "$surface_now"
    [ "$(finished_runs)" -eq "$before" ] || { echo "failed: $* did not end the run" >&2 && exit 1; }
}

make_home
if [ -n "$plugin" ]; then
    install -D -t "$HOME/.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/$release" "$plugin"
fi
case $filter in # so many vertices a side that a run takes seconds
    "Mean Curvature Flow") side=600 ;;
    *) side=430 ;;
esac
"$here/bumpy_bowl.py" "$out/large.off" '' "$side"
set_buttons "$release"
start_meshlab "$program" "$out/large.off"
start_filter
surface before

# The picture and the dialog of the percentage, if nothing else runs.
type_percentage "$percentage"
field typed_alone
box unticked
click_preview_then idle
box ticked
wait_for "the preview shows the result" unlike before
surface expected
click_preview
idle
wait_for "the preview is undone" same_as before

type_percentage 8
click_preview_then type_percentage "$percentage"
picture typed
wait_for "the field holds what was typed" is_picture typed_alone field
wait_for "the picture is that of the field" same_as expected
[ "$(grep -c "Applied filter" "$out/log.txt")" -gt "$(finished_runs)" ] ||
    { echo "failed: the previews ran too fast for the keys" >&2 && exit 1; }
click_preview
idle

surface_now=before
runs_that_moved_nothing click_preview_then click_preview
if is_picture ticked box; then exit 1; fi
wait_for "Preview is not ticked" is_picture unticked box
runs_that_moved_nothing click_preview_then escape
wait_for "Esc unticks Preview" is_picture unticked box
click_preview_then idle
wait_for "the next preview runs" same_as expected
click_preview
idle

click_preview_then click_apply
wait_for "Apply ends the preview and applies the filter" same_as expected
click_preview
idle
wait_for "what was applied stays" same_as expected
surface_now=expected
click_apply
xdotool sleep 0.5
runs_that_moved_nothing escape
[ "$(grep -c "was ended. The layer is as it was" "$out/log.txt")" -ge 4 ]
runs_that_moved_nothing click_preview_then click_close
if timeout 2 xdotool search --onlyvisible --name "^$filter\$"; then
    echo "failed: the dialog is open" >&2
    exit 1
fi
if grep -iE "(filter|plugin).*(failed|cannot|error)" "$out/log.txt"; then exit 1; fi
rm "$out/large.off"
echo "pictures are in $out"
