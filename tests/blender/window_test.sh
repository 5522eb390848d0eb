#!/usr/bin/env bash
# Uses the add-on in Blender's window under Xvfb. Usage: window_test.sh ROOT LIBRARY BLENDER [PICTURES]
set -euo pipefail

root=$1 library=$2 blender=$3 pictures=${4:-}
for program in "$blender" xvfb-run; do
    command -v "$program" >/dev/null || {
        echo "skipped: $program is not installed"
        exit 77
    }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

python3 -B "$root/bindings/blender/make.py" --unpacked "$work"
[ -z "$pictures" ] || mkdir -p "$pictures"
LISSOM_LIBRARY=$library PYTHONDONTWRITEBYTECODE=1 timeout 300 \
    xvfb-run -a -s '-screen 0 1280x800x24 -noreset -nolisten tcp' \
    "$blender" --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 --no-window-focus \
    --python "$root/tests/blender/window_test.py" -- "$work" "$pictures"
