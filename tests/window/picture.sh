#!/usr/bin/env bash
# Makes docs/window.png: the bar of docs/guide/window.md, bent by its slider and coloured by its stretch, with a line
# being completed in the console. Usage: picture.sh PROGRAM FILE.png
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
picture=$(realpath "$2")
guide=$(realpath "$here/../../docs/guide/window.md")
# shellcheck source=tests/window/hand.sh
. "$here/hand.sh"

click() { # X Y
    xdotool mousemove --window "$window" "$1" "$2"
    sleep 0.3
    xdotool click 1
    sleep 0.5
}

# The first shape shown is the one that stretch is measured against.
# shellcheck disable=SC2016
sed -n '/^```lua$/,/^```$/{//!p}' "$guide" | sed 's/default = 70/default = 0/' >bend.lua
open_view bend.lua
wait_for "at rest"
click 170 259
click 122 327
wait_for "at rest"
xdotool mousemove --window "$window" 144 383
sleep 0.3
xdotool keydown ctrl click 1 keyup ctrl
sleep 0.5
xdotool key ctrl+a
xdotool type --delay 60 70
xdotool key Return
wait_for "at rest"
click 247 103
wait_for "at rest"
type_text 'lissom.shapes.'
xdotool key Tab
wait_for "completed"
wait_for "at rest"
import -window root -crop 1200x800+0+0 +repage "$picture"
close_view 0
