#!/usr/bin/env bash
# Shortcuts and the letters of tools are those that the keyboard's layout gives: us, de, fr, and ru, which has no Latin
# letters and leaves them where US keyboards have them.
# Usage: keyboard_test.sh PROGRAM [FOLDER FOR SCREENSHOTS]
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
if ! command -v setxkbmap >/dev/null; then
    echo "skipped: layouts of a keyboard (no setxkbmap)"
    [ -z "${LISSOM_REQUIRE_GL:-}" ] || exit 1
    exit 0
fi
# shellcheck source=tests/window/hand.sh
. "$here/hand.sh"

cat >letters.lua <<'LUA'
return require("lissom").tool{ name = "letters", help = "Tells letters.",
    press = function(_, ev) ev:hit().mesh:transform{ scale = 1.01 } end,
    key = function(_, ev) print("key " .. ev.key) end }
LUA
echo 'assert(require("lissom").shapes.sphere{}:save("ball.obj"))' >ball.lua
"$program" run ball.lua

# Keys by their places: what they type on a US keyboard, and their numbers.
declare -A places=([a]=38 [q]=24 [z]=52 [y]=29 [w]=25 [1]=10)

press() { # PLACE
    xdotool key "${places[$1]}"
}
press_with_control() { # PLACE
    xdotool keydown ctrl
    xdotool key "${places[$1]}"
    xdotool keyup ctrl
}

check_layout() { # LAYOUT, then the places of its A, Q, W, Y and Z
    local layout=$1 a=$2 q=$3 w=$4 y=$5 z=$6
    setxkbmap -layout "$layout"
    open_view ball.obj --tool letters.lua
    wait_for "tool letters"
    wait_for "at rest"
    drag 700 300 1 0
    wait_for "history 1 of 1"
    wait_for "at rest"
    press_with_control "$z"
    wait_for "history 0 of 1"
    press_with_control "$y"
    wait_for "history 1 of 1"
    press "$w"
    wait_for "line key w"
    # In the console Ctrl-A selects all, which the next letter takes the place of.
    type_text 'print("abc")'
    press_with_control "$a"
    sleep 0.3
    kill -0 "$view" 2>/dev/null || fail "under $layout Ctrl-A in the console ends the program"
    xdotool type --delay 60 -- '"one"'
    xdotool key Return
    wait_for 'line "one"'
    press_with_control "$q"
    for _ in $(seq 100); do
        kill -0 "$view" 2>/dev/null || break
        sleep 0.1
    done
    if kill -0 "$view" 2>/dev/null; then fail "under $layout Ctrl-Q does not end the program"; fi
    wait "$view" || fail "under $layout it ended with an error"
}

check_layout us a q w y z
check_layout de a q w z y
check_layout fr q a z y w
check_layout ru a q w y z

# Without a tool: sides by digits, which AZERTY has above shift.
setxkbmap -layout fr
open_view ball.obj
wait_for "at rest"
press 1
wait_for "at rest"
close_view 0
echo "keyboard: all expectations hold"
