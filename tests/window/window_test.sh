#!/usr/bin/env bash
# Drives the real window under Xvfb with a hand made by xdotool: opens, turns, selects, drags a handle, undoes, drops
# files, tells errors, runs scripts again, takes pictures, types, stops a script that never ends, and closes.
# Usage: window_test.sh PROGRAM [FOLDER FOR SCREENSHOTS]
# LISSOM_DROP_FILE is the program that drops files onto it, LISSOM_LOSE_CONTEXT the library by which the driver loses
# what it has drawn; what needs them is left out where they are not set.
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
golden=$here/../scenes/golden
# shellcheck source=tests/window/hand.sh
. "$here/hand.sh"

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
xdotool key 1
wait_for "at rest"
if command -v import >/dev/null && command -v compare >/dev/null; then
    import -window root -crop 910x682+290+0 +repage plain.png
    xdotool key w
    wait_for "at rest"
    import -window root -crop 910x682+290+0 +repage wire.png
    [ "$(compare -metric AE plain.png wire.png null: 2>&1)" != 0 ] || fail "the key for the wire changes nothing"
fi
xdotool windowsize "$window" 900 700
wait_for "at rest"
shot resized
close_view 0

# --- While the console has the keys a picture is taken and the window is closed as ever
open_view box.obj
wait_for "at rest"
type_text 'print(1'
xdotool key F12
wait_for "picture lissom-3.png"
xdotool key ctrl+q
for _ in $(seq 100); do
    kill -0 "$view" 2>/dev/null || break
    sleep 0.1
done
kill -0 "$view" 2>/dev/null && fail "it does not close while the console has the keys"

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
drag 60 357 9 0
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
close_view 0

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

# --- Selecting, and a handle that is dragged by its gizmo; a disk that is full
cp "$golden/cactus.lua" .
open_view cactus.lua --tool select
wait_for "tool select"
wait_for "at rest"
drag 700 300 6 2
wait_for "history 1 of 1"
xdotool key i
wait_for "history 2 of 2"
close_view 0
largest=100 open_view cactus.lua --tool deform --journal handle.lua
wait_for "tool deform"
wait_for "at rest"
drag 700 605 4 0
wait_for "history 1 of 1"
xdotool key p
wait_for "history 2 of 2"
drag 700 110 4 0
wait_for "history 3 of 3"
xdotool key Return
wait_for "history 4 of 4"
wait_for "at rest"
shot handle
# The middle of the gizmo moves the handle in the plane of the picture.
drag 720 110 5 2
wait_for "history 5 of 5"
wait_for "at rest"
shot handle_dragged
grep -q "set_matrix" handle.lua || fail "no handle was dragged"
xdotool key ctrl+z
wait_for "history 4 of 5"
grep -q "^error .*recovery" told || fail "a copy that cannot be written is not told"
xdotool key ctrl+shift+z
wait_for "history 5 of 5"
close_view 0

# --- Files are dropped: a broken one is told and changes nothing; the scene that another replaces is kept
printf 'ply\nformat nonsense 1.0\n' >broken.ply
cat >own.lua <<'LUA'
return require("lissom").tool{ name = "own", help = "Does nothing.", press = function() print("own is pressed") end }
LUA
if [ -n "${LISSOM_DROP_FILE:-}" ]; then
    open_view ball.obj --tool bulge.lua
    wait_for "at rest"
    drag 700 300 5 2
    wait_for "history 1 of 1"
    sleep 2
    "$LISSOM_DROP_FILE" "$window" broken.ply
    wait_for "error "
    # The hand comes back from where the file was, and presses before that is seen.
    xdotool mousemove --window "$window" 100 500
    sleep 0.5
    xdotool mousemove --window "$window" 700 320 mousedown 1 mousemove_relative 40 10 mouseup 1
    wait_for "history 2 of 2"
    sleep 2
    wait_for "at rest"
    # A script that fails, and a tool, leave the scene and its history.
    echo 'error("no")' >fails.lua
    "$LISSOM_DROP_FILE" "$window" fails.lua
    wait_for "fails.lua:1: no"
    "$LISSOM_DROP_FILE" "$window" own.lua
    wait_for "tool own"
    drag 700 320 5 2
    wait_for "line own is pressed"
    shot own_tool
    # The file that is open is read again, not the one that failed.
    xdotool mousemove --window "$window" 700 300 key ctrl+z
    wait_for "history 1 of 2"
    xdotool key ctrl+shift+z
    wait_for "history 2 of 2"
    sleep 2
    "$LISSOM_DROP_FILE" "$window" box.obj
    wait_for "line the scene before was not saved"
    wait_for "at rest"
    close_view 0
    if grep -q "lissom: the scene was not saved" told; then fail "a scene without changes is told as unsaved"; fi
    open_view "$(find state/lissom -name 'unsaved-*.lissom' | head -n 1)"
    wait_for "shown "
    close_view 0
else
    echo "skipped: dropping files (no LISSOM_DROP_FILE)"
fi

# --- The driver loses what was drawn: it is drawn again, and all goes on
if [ -n "${LISSOM_LOSE_CONTEXT:-}" ]; then
    LD_PRELOAD=$LISSOM_LOSE_CONTEXT open_view ball.obj --tool bulge.lua
    wait_for "tool swell"
    wait_for "at rest"
    drag 700 300 5 2
    wait_for "history 1 of 1"
    wait_for "at rest"
    kill -USR1 "$view"
    xdotool mousemove --window "$window" 600 500
    wait_for "line the graphics driver had lost the picture"
    wait_for "at rest"
    shot made_again
    xdotool search --name lissom >found
    window=$(head -n 1 found)
    drag 700 320 5 2
    wait_for "history 2 of 2"
    xdotool key ctrl+z
    wait_for "history 1 of 2"
    close_view 0
else
    echo "skipped: a lost context (no LISSOM_LOSE_CONTEXT)"
fi

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
wait_for "line A scene of another window was not saved"
wait_for "at rest"
left=$(sed -n 's/.*A scene of another.*lissom view \(.*lissom\) opens it.*/\1/p' told)
journal=$(sed -n 's/.*lissom run \(.*lua\) does it again.*/\1/p' told)
grep -q "smooth" "$journal" || fail "the journal of a killed window does not tell what was done"
(cd / && "$program" run "$journal") || fail "the journal of a killed window does not come to its scene"
shot offered
# The first button of the console.
xdotool mousemove --window "$window" 320 698 click 1
wait_for "shown "
wait_for "at rest"
shot recovered
close_view 0
[ -e "$left" ] || fail "a scene that was left is gone without being asked"
open_view "$left"
wait_for "shown "
wait_for "at rest"
xdotool mousemove --window "$window" 390 698 click 1
sleep 0.5
close_view 0
[ ! -e "$left" ] || fail "a scene that is not wanted stays"
[ ! -e "$journal" ] || fail "its journal stays"

# --- A window that is terminated: what was saved leaves nothing to recover, what was not is kept
terminate() {
    kill "$view"
    for _ in $(seq 100); do
        kill -0 "$view" 2>/dev/null || break
        sleep 0.1
    done
    if kill -0 "$view" 2>/dev/null; then fail "it does not end when it is terminated"; fi
    wait "$view" || fail "terminated it ends with an error"
}
rm -rf state/lissom
open_view ball.obj --tool smooth
wait_for "at rest"
drag 700 300 5 2
wait_for "history 1 of 1"
sleep 2.5
wait_for "at rest"
xdotool key ctrl+s
wait_for "line saved "
sleep 0.5
[ -z "$(find state/lissom -name '*.lissom')" ] || fail "a saved scene leaves a copy to recover"
terminate
[ -z "$(find state/lissom -name '*.lissom')" ] || fail "a saved scene is left to recover when its window is terminated"
open_view ball.obj --tool smooth
wait_for "at rest"
drag 700 300 5 2
wait_for "history 1 of 1"
sleep 2.5
terminate
[ -n "$(find state/lissom -name 'unsaved-*.lissom')" ] || fail "what was not saved is gone with a terminated window"
rm -rf state/lissom

# --- The console is dragged larger, and cleared
open_view ball.obj
wait_for "at rest"
drag 700 684 0 -20
wait_for "at rest"
shot console_large
close_view 0

# --- Alt counts at once, again and again, also while the cursor rests in the middle of a drag
cat >alt.lua <<'LUA'
local function hear(self, ev)
    if ev.alt ~= (self.alt or false) then
        self.alt = ev.alt
        print(ev.alt and "alt is down" or "alt is up")
    end
end
return require("lissom").tool{ name = "alt", help = "Tells of Alt.", press = hear, drag = hear, release = hear }
LUA
open_view ball.obj --tool alt.lua
wait_for "at rest"
xdotool mousemove --window "$window" 700 400
sleep 0.1
xdotool mousedown 1
xdotool mousemove_relative -- 20 10
for _ in 1 2; do
    xdotool keydown alt
    wait_for "line alt is down"
    xdotool keyup alt
    wait_for "line alt is up"
done
xdotool mouseup 1
close_view 0

# --- What cannot be read is told, and the window stays
open_view broken.ply
wait_for "error "
close_view 0

# --- No screen
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$program" view box.obj >told 2>&1 || status=$?
[ $status -eq 1 ] || fail "without a screen it ended with $status"
grep -q "no_display" told || fail "without a screen it does not say so"

# --- An OpenGL that is too old, where Mesa can act so
status=0
MESA_GL_VERSION_OVERRIDE=3.0 MESA_GLSL_VERSION_OVERRIDE=130 timeout 20 "$program" view box.obj >told 2>&1 || status=$?
if [ $status -ne 124 ]; then
    [ $status -eq 1 ] || fail "without OpenGL 3.3 it ended with $status"
    grep -q "OpenGL 3.3" told || fail "without OpenGL 3.3 it does not say so"
fi
echo "window: all expectations hold"
