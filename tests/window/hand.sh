# A window under Xvfb and a hand made by xdotool, for the scripts beside this one: to be sourced with the arguments
# PROGRAM [FOLDER FOR SCREENSHOTS]. Leaves them in a folder of its own.
# shellcheck shell=bash
for tool in Xvfb xdotool; do
    command -v $tool >/dev/null && continue
    echo "skipped: the window (no $tool)"
    [ -z "${LISSOM_REQUIRE_GL:-}" ] || exit 1
    exit 0
done

program=$(realpath "$1")
shots=${2:-}
work=$(mktemp -d)
pids=()
end() {
    [ ${#pids[@]} -eq 0 ] || kill "${pids[@]}" 2>/dev/null || true
    rm -rf "$work"
}
trap end EXIT
cd "$work" || exit 1
export XDG_STATE_HOME=$work/state

Xvfb -displayfd 3 -screen 0 1400x1000x24 -noreset -nolisten tcp 3>display >/dev/null 2>&1 &
pids+=($!)
for _ in $(seq 200); do
    if [ -s display ]; then break; fi
    sleep 0.1
done
DISPLAY=:$(cat display)
export DISPLAY

fail() {
    echo "FAILED: $1"
    sed 's/^/    told: /' told
    shot failed
    exit 1
}

shot() { # NAME : a picture of the screen, for whoever asked for them
    if [ -n "$shots" ] && command -v import >/dev/null; then import -window root "$shots/$1.png"; fi
}

# What was told so far is passed over by the next `wait_for`.
seen=0
wait_for() { # TEXT : a line that begins so and was not told before
    local count
    for _ in $(seq 600); do
        count=$(tail -n +$((seen + 1)) told | grep -nF -m 1 -- "$1" | cut -d: -f1) || true
        if [ -n "$count" ]; then
            seen=$((seen + count))
            return
        fi
        kill -0 "$view" 2>/dev/null || fail "the program ended while '$1' was waited for"
        sleep 0.1
    done
    fail "it never told '$1'"
}

# `largest`, where it is set, is the size in KB above which no file can be written: a disk that is full.
open_view() { # ARGS...
    seen=0
    : >told
    # What earlier windows did not save would be offered above what the hand clicks on.
    case $* in *unsaved-*) ;; *) rm -f "$XDG_STATE_HOME"/lissom/unsaved-* ;; esac
    (
        if [ -n "${largest:-}" ]; then
            trap '' XFSZ
            ulimit -f "$largest"
        fi
        exec "$program" view --tell --size 1200x800 "$@"
    ) >told 2>&1 &
    view=$!
    pids+=("$view")
    window=$(timeout 60 xdotool search --sync --onlyvisible --name lissom | head -n 1)
}

close_view() { # STATUS
    local status=0
    xdotool mousemove --window "$window" 700 300 key ctrl+q
    for _ in $(seq 100); do
        kill -0 "$view" 2>/dev/null || break
        sleep 0.1
    done
    kill -0 "$view" 2>/dev/null && fail "it did not close"
    wait "$view" || status=$?
    [ $status -eq "$1" ] || fail "it ended with $status instead of $1"
    if grep -q "^driver " told; then fail "the driver complains"; fi
}

drag() { # X Y DX DY : in ten moves, from where the hand has come to before it presses
    xdotool mousemove --window "$window" "$1" "$2"
    sleep 0.1
    xdotool mousedown 1
    for _ in $(seq 10); do
        xdotool mousemove_relative -- "$3" "$4"
        sleep 0.02
    done
    xdotool mouseup 1
}

# Whatever a script did, the window itself was never busy for longer than 50 ms, nor away for much longer by the clock,
# which other programs change; what the driver takes to draw is its own.
check_work() {
    local work away
    work=$(sed -n 's/^longest.* work \([0-9]*\).*/\1/p' told)
    away=$(sed -n 's/^longest.*without drawing \([0-9]*\).*/\1/p' told)
    grep "^longest" told
    if [ -z "$work" ] || [ -z "$away" ]; then fail "it does not tell how long it was busy"; fi
    [ "$work" -lt "${LISSOM_WINDOW_WORK:-50}" ] || fail "it was busy for $work ms"
    [ "$away" -lt $((10 * ${LISSOM_WINDOW_WORK:-50})) ] || fail "it was away for $away ms"
}

type_text() { # TEXT : into the console
    xdotool mousemove --window "$window" 700 783 click 1
    sleep 0.3
    xdotool type --delay 60 -- "$1"
}

type_line() { # TEXT
    type_text "$1"
    xdotool key Return
}
