#!/usr/bin/env bash
# Tests what the program does with the system around it: signals, a full disk, a killed process.
# Usage: program_test.sh PROGRAM
set -euo pipefail

program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failures=0

expect() { # WHAT COMMAND...
    local what=$1
    shift
    if "$@"; then return; fi
    echo "FAILED: $what"
    failures=$((failures + 1))
}

status_of() { # OUT COMMAND... : the exit status of the command, whose output goes to OUT
    local out=$1 status=0
    shift
    "$@" >"$out" 2>/dev/null || status=$?
    echo "$status"
}

# Runs a command, sends it SIGINT after a while, and tells its status. In a shell that is no terminal's, a
# command in the background ignores the signal unless it sets its own.
interrupted() { # SECONDS COMMAND...
    local seconds=$1 status=0
    shift
    timeout --preserve-status --signal=INT --kill-after=20 "$seconds" "$@" >/dev/null 2>&1 || status=$?
    echo "$status"
}

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >a.obj

if [ -w /dev/full ]; then
    expect "a full standard output is a failure of inspect" \
        test "$(status_of /dev/full "$program" inspect a.obj)" = 1
    expect "and of a script that prints" \
        test "$(echo 'print(1)' | status_of /dev/full "$program" run -)" = 1
    expect "and of the help" test "$(status_of /dev/full "$program" --help)" = 1
    expect "it is said" grep -q "could not be written" <("$program" --version 2>&1 >/dev/full)
fi
expect "an open one is not" test "$(status_of /dev/null "$program" inspect a.obj)" = 0

echo 'while true do end' >endless.lua
expect "Ctrl-C ends a script with 130" test "$(interrupted 1 "$program" run endless.lua)" = 130
# Scripts that catch every error, and work that no hook of Lua sees.
while IFS= read -r script; do
    echo "$script" >stubborn.lua
    expect "Ctrl-C ends: $script" test "$(interrupted 0.3 "$program" run stubborn.lua)" = 130
done <<'LUA'
while true do pcall(function() while true do end end) end
while true do xpcall(function() while true do end end, function() while true do end end) end
while true do pcall(coroutine.wrap(function() pcall(function() while true do end end) end)) end
return ('a'):rep(300):find('a*a*a*a*a*a*b')
while true do pcall(string.gsub, ('a'):rep(300), 'a*a*a*a*a*a*b', '') end
table.move({}, 1, math.maxinteger - 1, 2)
while true do setmetatable({}, { __gc = function() while true do end end }) end
LUA
echo 'X = setmetatable({}, { __gc = function() while true do pcall(function() while true do end end) end end })' \
    >stubborn.lua
expect "Ctrl-C ends a finalizer at the end" test "$(interrupted 0.3 "$program" run stubborn.lua)" = 0
expect "a script has no crashing functions of debug" \
    test "$(echo 'debug.getregistry()' | status_of /dev/null "$program" run -)" = 1
expect "unless it is asked for" \
    test "$(echo 'debug.getregistry()' | status_of /dev/null "$program" run --unsafe-debug -)" = 0
expect "which is not for a sandbox" \
    test "$(echo 'x = 1' | status_of /dev/null "$program" run --unsafe-debug --sandbox -)" = 2
cat >smooth.lua <<'LUA'
local lissom = require "lissom"
lissom.shapes.grid():boundaries()[1]:smooth{ iterations = 2147483647 }
LUA
expect "and an operation" test "$(interrupted 1 "$program" run smooth.lua)" = 130

# Killed while it writes: the file that was being written goes with the next save beside it.
cat >save.lua <<'LUA'
local lissom = require "lissom"
local mesh = lissom.shapes.grid{ segments = 700 }
while true do assert(mesh:save("out/big.ply")) end
LUA
mkdir out
left_over() { compgen -G 'out/.lissom-*.tmp' >/dev/null; }
for _ in $(seq 20); do
    "$program" run save.lua 2>/dev/null &
    process=$!
    for _ in $(seq 500); do
        if left_over; then break; fi
        sleep 0.01
    done
    kill -9 "$process" 2>/dev/null || true
    wait "$process" 2>/dev/null || true
    if left_over; then break; fi
done
expect "a killed process leaves a file" left_over
"$program" convert a.obj out/a.obj
expect "the next save beside it removes it" eval '! left_over'

[ $failures = 0 ] || exit 1
echo "program: all expectations hold"
