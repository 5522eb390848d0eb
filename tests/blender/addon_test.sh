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
printf 'int unused;' | cc -shared -fPIC -x c - -o "$work/libneeded.so" 2>/dev/null &&
    printf 'int lissom;' | cc -shared -fPIC -x c - -o "$work/liblissom.so" -Wl,--no-as-needed "$work/libneeded.so" &&
    rm "$work/libneeded.so"
told() { # TEXT LIBRARY
    LISSOM_LIBRARY=$2 in_blender "$root/tests/blender/broken_test.py" -- "$work" | grep -q "$1" || {
        echo "failed: with $2 the add-on does not say: $1"
        exit 1
    }
}
told 'library of another version' libm.so.6
told 'cannot be loaded' /nothing/liblissom.so
[ ! -e "$work/liblissom.so" ] || told 'libneeded.so' "$work/liblissom.so"
