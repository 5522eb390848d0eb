#!/usr/bin/env bash
# Drives the real window under Xvfb with a hand made by xdotool: opens, turns, tells errors, runs scripts again,
# takes pictures, types, stops a script that never ends, and closes.
# Usage: window_test.sh PROGRAM [FOLDER FOR SCREENSHOTS]
set -euo pipefail

for tool in Xvfb xdotool; do
    command -v $tool >/dev/null && continue
    echo "skipped: the window (no $tool)"
    [ -z "${LISSOM_REQUIRE_GL:-}" ] || exit 1
    exit 0
done

program=$(realpath "$1")
shots=${2:-}
work=$(mktemp -d)
pids=()
end() {
    [ ${#pids[@]} -eq 0 ] || kill "${pids[@]}" 2>/dev/null || true
    rm -rf "$work"
}
trap end EXIT
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

fail() {
    echo "FAILED: $1"
    sed 's/^/    told: /' told
    shot failed
    exit 1
}

shot() { # NAME : a picture of the screen, for whoever asked for them
    if [ -n "$shots" ] && command -v import >/dev/null; then import -window root "$shots/$1.png"; fi
}

# What was told so far is passed over by the next `wait_for`.
seen=0
wait_for() { # TEXT : a line that begins so and was not told before
    local count
    for _ in $(seq 600); do
        count=$(tail -n +$((seen + 1)) told | grep -nF -m 1 -- "$1" | cut -d: -f1) || true
        if [ -n "$count" ]; then
            seen=$((seen + count))
            return
        fi
        kill -0 "$view" 2>/dev/null || fail "the program ended while '$1' was waited for"
        sleep 0.1
    done
    fail "it never told '$1'"
}

open_view() { # ARGS...
    seen=0
    : >told
    "$program" view --tell --size 1200x800 "$@" >told 2>&1 &
    view=$!
    pids+=("$view")
    window=$(timeout 60 xdotool search --sync --onlyvisible --name lissom | head -n 1)
}

close_view() { # STATUS
    local status=0
    xdotool mousemove --window "$window" 700 300 key ctrl+q
    for _ in $(seq 100); do
        kill -0 "$view" 2>/dev/null || break
        sleep 0.1
    done
    kill -0 "$view" 2>/dev/null && fail "it did not close"
    wait "$view" || status=$?
    [ $status -eq "$1" ] || fail "it ended with $status instead of $1"
}

drag() { # X Y DX DY : in ten moves
    xdotool mousemove --window "$window" "$1" "$2" mousedown 1
    for _ in $(seq 10); do
        xdotool mousemove_relative -- "$3" "$4"
        sleep 0.02
    done
    xdotool mouseup 1
}

# Whatever a script did, the window itself was never busy for longer; what the driver takes to draw is its own.
check_work() {
    local work
    work=$(sed -n 's/^longest.* work \([0-9]*\).*/\1/p' told)
    [ -n "$work" ] || fail "it does not tell how long it was busy"
    [ "$work" -lt "${LISSOM_WINDOW_WORK:-50}" ] || fail "it was busy for $work ms"
}

type_text() { # TEXT : into the console
    xdotool mousemove --window "$window" 700 783 click 1
    sleep 0.3
    xdotool type --delay 60 -- "$1"
}

type_line() { # TEXT
    type_text "$1"
    xdotool key Return
}

# --- A mesh: turned, seen from a side, drawn into a file that differs after a turn
cat >box.obj <<'OBJ'
v 0 0 0
v 2 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
OBJ
open_view box.obj
wait_for "shown "
wait_for "at rest"
shot mesh
xdotool mousemove --window "$window" 700 300 key F12
wait_for "picture lissom-1.png"
drag 700 300 15 5
wait_for "at rest"
xdotool key F12
wait_for "picture lissom-2.png"
if cmp -s lissom-1.png lissom-2.png; then fail "a drag did not turn the camera"; fi
# What is seen at rest is the picture in the file, to the pixel.
if command -v import >/dev/null && command -v compare >/dev/null; then
    wait_for "at rest"
    import -window root -crop 910x682+290+0 +repage seen.png
    differing=$(compare -metric AE seen.png lissom-2.png null: 2>&1) || true
    [ "$differing" = 0 ] || fail "what is seen differs from the saved picture in $differing pixels"
fi
xdotool key 1 key w
wait_for "at rest"
xdotool windowsize "$window" 900 700
wait_for "at rest"
shot resized
close_view 0

# --- A script: its parameter, an error, its next version, the console, a loop without an end
cat >script.lua <<'LUA'
local lissom = require "lissom"
local p = lissom.params{ size = { type = "number", default = 1, min = 0.5, max = 4 } }
local box = lissom.shapes.box{}
box:transform{ scale = p.size }
print("size", p.size)
return box
LUA
open_view script.lua
wait_for "line size	1.0"
wait_for "at rest"
shot script
# The slider lies in the panel, below its heading.
drag 60 409 9 0
wait_for "line size	"
wait_for "shown "
sed -i 's/default = 1/default = 2/; s/return box/return missing()/' script.lua
wait_for "changed"
wait_for "error script.lua:6:"
sed -i 's/missing()/lissom.shapes.torus{}/' script.lua
wait_for "shown "
wait_for "at rest"
type_line '#lissom.shapes.box{} > 4'
wait_for "line true"
type_text '#lissom.shapes.bo'
xdotool key Tab
wait_for "completed"
xdotool type --delay 60 '{} > 5'
xdotool key Return
wait_for "line #lissom.shapes.box{} > 5"
wait_for "line true"
printf 'print("going")\nwhile true do pcall(function() while true do end end) end\n' >script.lua
wait_for "line going"
sleep 0.5
drag 700 300 10 5
xdotool mousemove --window "$window" 700 300 key Escape
wait_for "error script.lua:2: cancelled"
shot stopped
printf 'print("again")\nwhile true do end\n' >script.lua
wait_for "line again"
drag 700 300 10 5
close_view 0
check_work

# --- A kernel call that takes long
cat >long.lua <<'LUA'
local lissom = require "lissom"
lissom.render{ mesh = lissom.shapes.torus{}, file = "seen.png" }
local big = lissom.shapes.cactus{ vertices = 200000 }
local edit = lissom.deform(big, { region = big:region{ all = true } })
edit:handle(big:region("base"))
edit:handle(big:region("tip"))
print("going")
edit:solve()
print("solved")
while true do end
LUA
open_view long.lua
wait_for "line going"
drag 700 300 10 5
drag 800 350 -10 -5
wait_for "line solved"
drag 700 300 10 5
close_view 0
check_work

# --- Tools: a drag is a step; undo, redo, save; a change of the tool's file; what was recorded repeats
cat >ball.lua <<'LUA'
local lissom = require "lissom"
assert(lissom.shapes.sphere{}:save("ball.obj"))
LUA
"$program" run ball.lua
"$program" new tool bulge >/dev/null
open_view ball.obj --tool bulge.lua --record events.lua --journal calls.lua
wait_for "tool bulge"
wait_for "at rest"
drag 700 300 5 2
wait_for "history 1 of 1"
wait_for "at rest"
shot bulge
xdotool key ctrl+z
wait_for "history 0 of 1"
xdotool key ctrl+shift+z
wait_for "history 1 of 1"
xdotool key ctrl+s
wait_for "line saved ball.lissom"
sed -i 's/name = "bulge"/name = "swell"/' bulge.lua
wait_for "tool swell"
drag 700 320 5 2
wait_for "history 2 of 2"
# Faster than it is seen: the button still goes down where it was pressed.
xdotool mousemove --window "$window" 720 340 mousedown 1 mousemove_relative 90 20 mouseup 1
wait_for "history 3 of 3"
sed -i 's/return lissom.tool/return nonsense.tool/' bulge.lua
wait_for "error "
sed -i 's/return nonsense.tool/return lissom.tool/' bulge.lua
wait_for "tool changed"
sleep 2.5
wait_for "at rest"
close_view 0
grep -q "was not saved" told || fail "an unsaved scene is not told"
grep -q '"press", 430, 340' events.lua || fail "a fast stroke does not begin where it was pressed"
"$program" run events.lua || fail "what was recorded does not repeat"
"$program" run calls.lua || fail "the journal does not come to the same scene"

# --- The recording is played, from another folder; Escape stops it, and the hand goes on
mkdir elsewhere
(cd elsewhere && "$program" run ../events.lua) || fail "a recording does not find the files beside it"
cd elsewhere
open_view ../events.lua --speed 8
wait_for "playing "
wait_for "line played "
wait_for "played"
close_view 0
open_view ../events.lua --speed 0.05
wait_for "playing "
wait_for "tool swell"
drag 700 300 5 2
xdotool key Escape
wait_for "played"
wait_for "at rest"
drag 700 300 5 2
wait_for "history 1 of 1"
close_view 0
cd "$work"

# --- A window that is killed: the next one offers its scene
open_view ball.lissom --tool smooth
wait_for "tool smooth"
wait_for "at rest"
drag 700 300 5 2
wait_for "history 1 of 1"
sleep 2.5
kill -9 "$view"
wait "$view" 2>/dev/null || true
open_view ball.obj
wait_for "line A window was ended"
left=$(sed -n 's/.*lissom view \(.*lissom\) opens what.*/\1/p' told)
close_view 0
open_view "$left"
wait_for "shown "
close_view 0

# --- What cannot be read is told, and the window stays
printf 'ply\nformat nonsense 1.0\n' >broken.ply
open_view broken.ply
wait_for "error "
close_view 0

# --- No screen
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$program" view box.obj >told 2>&1 || status=$?
[ $status -eq 1 ] || fail "without a screen it ended with $status"
grep -q "no_display" told || fail "without a screen it does not say so"
echo "window: all expectations hold"
