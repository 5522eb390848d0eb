#!/usr/bin/env bash
# Makes docs/window.png: the bent bar of docs/guide/window.md, coloured by its stretch, with a line being completed in
# the console. Usage: picture.sh PROGRAM FILE.png
set -euo pipefail

here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
picture=$(realpath "$2")
guide=$(realpath "$here/../../docs/guide/window.md")
# shellcheck source=tests/window/hand.sh
. "$here/hand.sh"

sed -n '/^```lua$/,/^```$/{//!p}' "$guide" >bend.lua
open_view bend.lua --width 1000 --height 720
wait_for "at rest"
xdotool mousemove --window "$window" 700 300
type_text 'lissom.shapes.'
xdotool key Tab
wait_for "completed"
wait_for "at rest"
import -window "$window" "$picture"
close_view 0
