#!/usr/bin/env bash
# Draws in the real window with a hand made by xdotool, a scene for each tool that ships, and writes what it did: events
# and journals, which ../golden.lua does again without a window. To be run where a tool, a model or the format of
# recordings has changed on purpose; look at the pictures then.
# Usage: record.sh PROGRAM [FOLDER FOR SCREENSHOTS]
set -euo pipefail

program=$(realpath "$1")
shots=${2:+$(realpath "$2")}
folder=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
pids=()
end() {
    [ ${#pids[@]} -eq 0 ] || kill "${pids[@]}" 2>/dev/null || true
    rm -rf "$work"
}
trap end EXIT
cp "$folder"/{cactus,head,parts}.lua "$work"
cd "$work"
export XDG_STATE_HOME=$work/state
Xvfb -displayfd 3 -screen 0 1400x1000x24 -noreset -nolisten tcp 3>display >/dev/null 2>&1 &
pids+=($!)
for _ in $(seq 200); do
    if [ -s display ]; then break; fi
    sleep 0.1
done
DISPLAY=:$(cat display)
export DISPLAY

rest() { # Waits until nothing happens any more.
    sleep 0.4
    for _ in $(seq 600); do
        if [ "$(tail -n 1 told)" = "at rest" ]; then return; fi
        sleep 0.1
    done
    echo "record.sh: the window never rests" >&2
    exit 1
}

shot() { # NAME
    rest
    [ -z "$shots" ] || import -window root -crop 1280x800+0+0 +repage "$shots/$1.png"
}

open_tool() { # TOOL MODEL
    "$program" view --tell --size 1280x800 --tool "$1" --record "$1.events.lua" --journal "$1.calls.lua" "$2" \
        >told 2>&1 &
    view=$!
    pids+=("$view")
    window=$(timeout 60 xdotool search --sync --onlyvisible --name lissom | head -n 1)
    rest
}

close_tool() { # TOOL
    rest
    xdotool mousemove --window "$window" 500 500 key ctrl+q
    wait "$view"
    if grep "^error" told; then exit 1; fi
    (cd / && "$program" run "$work/$1.events.lua")
    "$program" run "$1.calls.lua"
    cp "$1.events.lua" "$1.calls.lua" "$folder"
}

move() { # X Y
    xdotool mousemove --window "$window" "$1" "$2"
    sleep 0.04
}

drag() { # X Y X Y... : through these points, in steps between them
    local x=$1 y=$2 step
    move "$x" "$y"
    xdotool mousedown 1
    shift 2
    while [ $# -gt 1 ]; do
        for step in 1 2 3 4 5; do move $((x + ($1 - x) * step / 5)) $((y + ($2 - y) * step / 5)); done
        x=$1 y=$2
        shift 2
    done
    sleep 0.2
    xdotool mouseup 1
    rest
}

click() { # X Y
    move "$1" "$2"
    xdotool click 1
    rest
}

keys() { # KEY...
    xdotool key --delay 80 "$@"
    rest
}

# --- What is painted, added to, grown, inverted and taken back
open_tool select cactus.lua
drag 720 330 760 340 790 335
xdotool keydown shift
drag 890 180 900 250
xdotool keyup shift
keys plus plus
shot select
keys i
keys ctrl+z
close_tool select

# --- Bent by hand and by a number, undone, done again, saved
open_tool deform cactus.lua
drag 715 605 760 615 805 605
shot deform_painted
keys p
drag 710 130 760 60 810 130
drag 700 90 760 95 815 90
shot deform_second
keys Return
shot deform_gizmo
keys e z
keys minus 3 5 Return
keys w x
keys 0 period 3 Return
shot deform_bent
drag 840 100 870 130 900 150
keys ctrl+z
keys ctrl+shift+z
keys ctrl+s
shot deform
close_tool deform

# --- Across the trunk
open_tool cut cactus.lua
drag 620 520 880 480
shot cut
close_tool cut

# --- Two loops and two keys
open_tool merge parts.lua
click 565 250
shot merge_first
click 880 411
shot merge_second
click 526 224
click 862 410
shot merge_key
keys Return
shot merge
close_tool merge

# --- An object is moved by hand and by a number
open_tool transform parts.lua
click 600 150
shot transform_gizmo
keys w x
keys 1 period 5 Return
keys e y
keys 3 0 Return
shot transform
close_tool transform

# --- From tip to tip
open_tool measure cactus.lua
click 629 215
click 895 150
shot measure
close_tool measure

# --- The ribs of the trunk
open_tool smooth cactus.lua
drag 730 130 730 500 770 500 770 130
drag 800 130 800 330
shot smooth
close_tool smooth

# --- A tail in profile, gathered and taken back
open_tool ponytail head.lua
click 172 77
drag 690 150 560 150 520 400
shot ponytail_spine
keys g
shot ponytail
keys ctrl+z
close_tool ponytail

# --- A parting from above, its tilt, another one
open_tool parting head.lua
click 42 104
drag 785 400 790 340 792 280
drag 830 390 870 395 910 410
shot parting
close_tool parting

# --- A line over the face, and a closed one
open_tool line head.lua
click 42 77
drag 640 200 700 180 760 200
drag 690 300 720 285 750 300 720 315 690 300
shot line
close_tool line
