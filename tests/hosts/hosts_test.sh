#!/usr/bin/env bash
# Runs the five scripts of examples/hosts in every host there is; each must return the same to the bit. Usage:
# hosts_test.sh ROOT LIBRARY [PROGRAM=... WINDOW=... C=... LUA54=... LUAJIT=... PYTHON=... BLENDER=... LOVE=...] : files and commands of hosts
set -euo pipefail

# The hosts are tried by a shell of their own, which this one tidies up after: a trap of theirs could run at any time.
if [ -z "${HOSTS_WORK:-}" ]; then
    work=$(mktemp -d) status=0
    HOSTS_WORK=$work "$0" "$@" || status=$?
    if [ -s "$work/screen" ]; then kill "$(cat "$work/screen")" || true; fi
    rm -rf "$work"
    exit $status
fi

root=$1 library=$2 work=$HOSTS_WORK
shift 2
export LISSOM_HOSTS=$root/examples/hosts LISSOM_LIBRARY=$library
here=$root/tests/hosts

# A screen of its own, without a window manager.
start_screen() {
    [ ! -s "$work/screen" ] || return 0
    command -v Xvfb >/dev/null || return 1
    Xvfb -displayfd 3 -screen 0 800x600x24 -noreset -nolisten tcp 3>"$work/display" >/dev/null 2>&1 &
    echo $! >"$work/screen"
    for _ in $(seq 200); do
        if [ -s "$work/display" ]; then break; fi
        sleep 0.1
    done
    DISPLAY=:$(cat "$work/display")
    export DISPLAY
}

declare -A host=()
for word in "$@"; do host[${word%%=*}]=${word#*=}; done

# Whether a host is there; makes what it needs.
prepare() { # HOST
    case $1 in
    window) start_screen ;;
    lua54) command -v lua5.4 >/dev/null ;;
    luajit) command -v luajit >/dev/null ;;
    python)
        cp -r "$root/bindings/python/lissom" "$work/lissom" &&
            "${host[PYTHON]}" -B "$root/bindings/python/generate.py" "$root/bindings/c/lissom.h" "$work/lissom"
        ;;
    blender)
        command -v "${host[BLENDER]}" >/dev/null &&
            python3 -B "$root/bindings/blender/make.py" --unpacked "$work/blender"
        ;;
    love)
        command -v "${host[LOVE]}" >/dev/null && start_screen && mkdir "$work/love" &&
            cp "$here"/love/*.lua "$here/hosts.lua" "${host[LUAJIT]}/lissom.so" "$work/love"
        ;;
    esac
}

# A window stays open: it is closed once the script has told its hash.
in_window() {
    XDG_STATE_HOME=$work/state "${host[WINDOW]}" view --tell "$here/hosts.lua" >"$work/told" 2>&1 &
    local window=$!
    for _ in $(seq 600); do
        if grep -q '^line HASH ' "$work/told" || ! kill -0 $window 2>/dev/null; then break; fi
        sleep 0.1
    done
    kill $window 2>/dev/null || true
    wait $window || true
    sed 's/^line HASH /HASH /' "$work/told"
}

# Runs the script LISSOM_SCRIPT.
run_in() { # HOST
    case $1 in
    program) "${host[PROGRAM]}" run "$here/hosts.lua" ;;
    window) in_window ;;
    c) "${host[C]}" "$LISSOM_HOSTS" "$LISSOM_SCRIPT" ;;
    lua54) LUA_CPATH="${host[LUA54]}/?.so" lua5.4 "$here/hosts.lua" ;;
    luajit) LUA_CPATH="${host[LUAJIT]}/?.so" luajit "$here/hosts.lua" ;;
    python) PYTHONPATH=$work "${host[PYTHON]}" -B "$here/hosts.py" "$LISSOM_HOSTS" "$LISSOM_SCRIPT" ;;
    blender)
        "${host[BLENDER]}" --background --factory-startup --python-exit-code 1 --python "$here/hosts.py" \
            -- "$LISSOM_HOSTS" "$LISSOM_SCRIPT" "$work/blender"
        ;;
    love)
        XDG_DATA_HOME=$work XDG_CONFIG_HOME=$work "${host[LOVE]}" "$work/love"
        ;;
    esac
}

status=0
for name in program window c lua54 luajit python blender love; do
    key=${name^^}
    if [ -z "${host[$key]:-}" ] || ! prepare "$name"; then
        echo "skipped: $name is not installed or not built"
        continue
    fi
    for script in bend horn ponytail stroke batch; do
        LISSOM_SCRIPT=$script run_in "$name" >"$work/out" 2>&1 || {
            cat "$work/out"
            status=1
        }
        grep '^HASH ' "$work/out" >>"$work/$name.txt" || echo "failed: $script returns nothing in $name"
    done
    [ -e "$work/first.txt" ] || { cp "$work/$name.txt" "$work/first.txt" && cat "$work/first.txt"; }
    if diff "$work/first.txt" "$work/$name.txt"; then echo "$name: the same"; else status=1; fi
done
[ "$(grep -c . "$work/first.txt")" = 5 ] || status=1
exit $status
