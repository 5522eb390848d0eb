#!/usr/bin/env bash
# Runs the tests of the add-on in Blender without a window. Usage: addon_test.sh ROOT LIBRARY BLENDER [NAME...]
set -euo pipefail

root=$1 library=$2 blender=$3
shift 3
command -v "$blender" >/dev/null || {
    echo "skipped: blender is not installed"
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

in_blender() { # SCRIPT ARGS... : with no preferences but those of the factory
    PYTHONDONTWRITEBYTECODE=1 "$blender" --background --factory-startup --python-exit-code 1 --python "$@" 2>&1
}

python3 -B "$root/bindings/blender/make.py" --unpacked "$work"
LISSOM_LIBRARY=$library in_blender "$root/tests/blender/addon_test.py" -- "$work" "$@"

# A library that is not there, has another version or misses one that it needs: the add-on says so, and ends well.
told() { # TEXT LIBRARY
    local text
    text=$(LISSOM_LIBRARY=$2 in_blender "$root/tests/blender/broken_test.py" -- "$work" || echo "and ends badly")
    if ! grep -q "$1" <<<"$text" || grep -q 'and ends badly' <<<"$text"; then
        printf 'failed: with %s the add-on does not say: %s\n%s\n' "$2" "$1" "$text"
        exit 1
    fi
}
told 'library of another version' libm.so.6
told 'cannot be loaded' /nothing/liblissom.so
if command -v cc >/dev/null; then
    echo 'int needed;' >"$work/needed.c"
    echo 'extern int needed; int* lissom = &needed;' >"$work/lissom.c"
    cc -shared -fPIC "$work/needed.c" -o "$work/libneeded.so.1" -Wl,-soname,libneeded.so.1
    cc -shared -fPIC "$work/lissom.c" "$work/libneeded.so.1" -o "$work/liblissom.so"
    rm "$work/libneeded.so.1"
    told 'libneeded.so.1.*another library is missing' "$work/liblissom.so"
fi
