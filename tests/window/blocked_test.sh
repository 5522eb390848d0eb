#!/usr/bin/env bash
# The real window is never away for longer than 50 ms, whatever scripts, tools and the kernel do: loops that never end,
# in a script and in a drag, a kernel call that takes long, and meshes of many faces that come and change.
# Usage: blocked_test.sh PROGRAM [FOLDER FOR SCREENSHOTS]; LISSOM_CALL_SECONDS is how long the kernel call takes.
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
# shellcheck source=tests/window/hand.sh
. "$here/hand.sh"

turn_for() { # SECONDS : with the right button, which no tool takes
    local until=$((SECONDS + $1)) side=6
    xdotool mousemove --window "$window" 700 400 mousedown 3
    while [ $SECONDS -lt $until ]; do
        for _ in $(seq 10); do
            xdotool mousemove_relative -- $side 1
            sleep 0.03
        done
        side=$((-side))
    done
    xdotool mouseup 3
}

# --- A script with loops that never end, the first of which catches what would stop it
cat >endless.lua <<'LUA'
local lissom = require "lissom"
lissom.render{ mesh = lissom.shapes.torus{}, file = "seen.png" }
print("going")
while true do pcall(function() while true do end end) end
LUA
open_view endless.lua
wait_for "line going"
turn_for 4
xdotool mousemove --window "$window" 700 300 key Escape
wait_for "error endless.lua:4: cancelled"
wait_for "at rest"
close_view 0
check_work

# --- A tool whose drag never ends, and one that never stops drawing
"$program" new tool stuck >/dev/null
sed -i 's/drag = function(self, ev) self:bulge(ev) end/drag = function() while true do end end/' stuck.lua
grep -q "while true" stuck.lua
cat >ball.lua <<'LUA'
local scene = require("lissom").scene{}
scene:add("ball", require("lissom").shapes.sphere{})
return scene
LUA
open_view ball.lua --tool stuck.lua
wait_for "tool stuck"
wait_for "at rest"
drag 700 300 5 2
turn_for 3
xdotool mousemove --window "$window" 700 300 key Escape
wait_for "error "
wait_for "at rest"
close_view 0
check_work

# --- A kernel call that takes long
cat >long.lua <<LUA
local lissom = require "lissom"
lissom.render{ mesh = lissom.shapes.torus{}, file = "seen.png" }
local mesh = lissom.shapes.cactus{ vertices = 20000 }
local start = os.time()
local clock = os.clock()
mesh:copy():smooth{ iterations = 10 }
local steps = math.ceil(10 * ${LISSOM_CALL_SECONDS:-4} / (os.clock() - clock))
print("going")
mesh:smooth{ iterations = steps }
print("smoothed", os.time() - start)
return mesh
LUA
open_view long.lua
wait_for "line going"
turn_for "${LISSOM_CALL_SECONDS:-4}"
wait_for "line smoothed"
wait_for "at rest"
grep "^line smoothed" told
close_view 0
check_work

# --- A mesh of many faces is made ready beside the window and sent in pieces: it comes, its colours change, it moves
cat >large.lua <<'LUA'
local lissom = require "lissom"
local scene = lissom.scene{}
scene:add("cactus", lissom.shapes.cactus{ vertices = 150000 })
return scene
LUA
open_view large.lua --tool select
turn_for 2
wait_for "tool select"
wait_for "at rest"
drag 700 300 3 3
wait_for "history 1 of 1"
wait_for "at rest"
shot large
type_line 'scene:get("cactus"):transform{ scale = 1.1 }'
wait_for "history 2 of 2"
wait_for "at rest"
type_line 'scene:remove("cactus")'
wait_for "history 3 of 3"
wait_for "at rest"
close_view 0
check_work

echo "window: never away for longer than it may be"
