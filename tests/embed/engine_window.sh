#!/usr/bin/env bash
# The window of examples/engine with a hand made by xdotool: what is dragged moves, stays where it was left and goes on
# from there, and Escape ends the program. Usage: engine_window.sh ENGINE SCENE [FOLDER FOR PICTURES]
set -euo pipefail
scene=$2
# shellcheck source=tests/window/hand.sh
. "$(dirname "${BASH_SOURCE[0]}")/../window/hand.sh" "$1" "${3:-}"

open_engine() { # LAST : its last frame
    seen=0
    : >told
    "$program" "$scene" --last "$1" >told 2>&1 &
    view=$!
    pids+=("$view")
    window=$(timeout 60 xdotool search --sync --onlyvisible --name '^engine$' | head -n 1)
    wait_for ready
}

close_engine() {
    local status=0
    xdotool mousemove --window "$window" 640 700 key Escape
    for _ in $(seq 300); do
        kill -0 "$view" 2>/dev/null || break
        sleep 0.1
    done
    if kill -0 "$view" 2>/dev/null; then fail "Escape did not end the engine"; fi
    wait "$view" || status=$?
    [ $status -eq 0 ] || fail "the engine ended with $status"
}

# Released when a frame has seen where the hand has come to.
drag_tip() {
    xdotool mousemove --window "$window" 350 200
    sleep 0.5
    xdotool mousedown 1
    sleep 0.5
    xdotool mousemove_relative -- 120 60
    sleep 0.5
    xdotool mouseup 1
    sleep 0.5
}

equal() { cmp -s "$1.png" "$2.png"; }

open_engine rest.png
close_engine
open_engine dragged.png
drag_tip
close_engine
open_engine clicked.png
drag_tip
# Only pressed, where the hand left it.
xdotool mousemove --window "$window" 470 260 mousedown 1
sleep 0.5
xdotool mouseup 1
sleep 0.5
close_engine
[ -z "$shots" ] || cp ./*.png "$shots"

if equal rest dragged; then fail "nothing moved"; fi
equal dragged clicked || fail "a handle did not stay where it was left"
echo "the window of the engine: passed"
