#!/usr/bin/env bash
# Tests how ./dev finds and installs packages, with stubs in place of dpkg-query and apt-get.
# Usage: dev_test.sh ROOT
set -euo pipefail

root=$1
sandbox=$(mktemp -d)
trap 'rm -rf "$sandbox"' EXIT
mkdir "$sandbox/bin" "$sandbox/empty"
failures=0

stub() { # NAME : a program of that name in the sandbox, its text on stdin
    { echo '#!/bin/bash' && cat; } >"$sandbox/bin/$1"
    chmod +x "$sandbox/bin/$1"
}

# What dpkg-query and apt-get would do: installed packages are lines of the file `installed`.
stub dpkg-query <<'STUB'
for name in "${@:3}"; do
    if grep -qxF -- "$name" "$SANDBOX/installed"; then echo "installed $name"; else status=1; fi
done
exit "${status:-0}"
STUB
stub apt-get <<'STUB'
echo "apt-get $*" >>"$SANDBOX/log"
[ ! -e "$SANDBOX/no-network" ] || exit 100
if [ "$1" = install ]; then printf '%s\n' "$@" >>"$SANDBOX/installed"; fi
STUB
stub cmake <<'STUB'
echo "$*" >>"$SANDBOX/fetched"
[ ! -e "$SANDBOX/no-network" ] || exit 1
STUB
stub sudo <<'STUB'
echo "sudo" >>"$SANDBOX/log"
"$@"
STUB
stub id <<'STUB'
cat "$SANDBOX/uid"
STUB

reset() { # UID ID ID_LIKE : a system without any package
    : >"$sandbox/installed"
    : >"$sandbox/log"
    rm -f "$sandbox/no-network"
    echo "$1" >"$sandbox/uid"
    printf 'ID=%s\nID_LIKE="%s"\n' "$2" "$3" >"$sandbox/os-release"
}

dev() { # ARGS : runs ./dev under the stubs; its output goes to the file `output`, its status to $status
    status=0
    SANDBOX=$sandbox DEV_OS_RELEASE=$sandbox/os-release PATH=${path:-$sandbox/bin:$PATH} \
        /bin/bash "$root/dev" "$@" >"$sandbox/output" 2>&1 || status=$?
}

expect() { # WHAT COMMAND...
    local what=$1
    shift
    if "$@" >/dev/null 2>&1; then return; fi
    echo "FAILED: $what"
    sed 's/^/    output: /' "$sandbox/output"
    sed 's/^/    log: /' "$sandbox/log"
    failures=$((failures + 1))
}

says() { grep -qF -- "$1" "$sandbox/output"; }
logged() { grep -qE -- "$1" "$sandbox/log"; }
silent() { [ ! -s "$sandbox/log" ]; }

reset 0 debian ""
dev setup build
expect "a bare Debian is set up" test "$status" = 0
expect "every package is named with its reason" says "CHOLMOD, which changes sparse Cholesky factors"
expect "the package lists are fetched first" logged '^apt-get update'
expect "missing packages are installed" logged '^apt-get install .*libopenmesh-dev'
expect "packages of other commands are not" eval '! logged "clang-tidy|libcgal-dev|valgrind"'
expect "root needs no sudo" eval '! logged sudo'
expect "the sources of Lua are fetched" grep -qE -- '^-P .*/cmake/FetchLua.cmake$' "$sandbox/fetched"

: >"$sandbox/log"
dev setup build
expect "nothing is fetched when nothing is missing" silent

sed -i '/^libopenmesh-dev$/d; s/^pkg-config$/pkgconf/' "$sandbox/installed"
dev setup build
expect "only what is missing is installed" logged 'Use-Pty=0 libopenmesh-dev *$'

reset 1000 ubuntu debian
dev setup bench
expect "other users go through sudo" logged '^sudo'
expect "derivatives of Debian are set up" logged 'libcgal-dev'

reset 1000 linuxmint "ubuntu"
mv "$sandbox/bin/sudo" "$sandbox/sudo"
path=$sandbox/bin:$sandbox/tools
mkdir "$sandbox/tools"
for tool in awk bash cat cut dirname env grep mktemp sed tr xargs; do
    ln -s "$(command -v $tool)" "$sandbox/tools/$tool"
done
dev setup bench
expect "without sudo it stops" test "$status" = 1
expect "and says what to run" says "apt-get install libcgal-dev"
expect "and installs nothing" silent
mv "$sandbox/sudo" "$sandbox/bin/sudo"
path=

reset 0 debian ""
touch "$sandbox/no-network"
dev setup bench
expect "a failing apt-get stops it" test "$status" = 1
expect "and names the packages" says "try again: libcgal-dev"

printf '%s\n' libcgal-dev libopenblas-dev >"$sandbox/installed"
dev setup bench
expect "without a network the sources of Lua may be absent" test "$status" = 0
expect "which is said" says "links the system's: not for hosts that have LuaJIT"

reset 0 arch ""
path=$sandbox/tools
dev setup build
expect "another system without the tools stops with status 2" test "$status" = 2
expect "and lists the packages" says "libsuitesparse-dev"
expect "and runs no package manager" silent
path=

# The program is not built again, nor is anything said, where the build tool has nothing to do. A pipe to
# grep -q would fail when the tool goes on writing after the line looked for.
project=$sandbox/project
mkdir -p "$project/build/release/viewer"
cp "$root/dev" "$project/"
touch "$project/CMakePresets.json"
sleep 0.01
touch "$project/build/release/build.ninja"
printf '#!/bin/bash\necho "program $*"\n' >"$project/build/release/viewer/lissom"
chmod +x "$project/build/release/viewer/lissom"
stub ninja <<'STUB'
case " $* " in
*" -n "*)
    echo "ninja: no work to do."
    for ((i = 0; i < 20000; i++)); do echo "more of its chatter"; done
    ;;
*) echo "ninja builds" ;;
esac
STUB
reset 0 debian ""
dev setup build
root=$project dev lissom inspect cup.obj
expect "a program that is up to date is run" test "$status" = 0
expect "and the build tool says nothing" test "$(cat "$sandbox/output")" = "program inspect cup.obj"

# A fresh clone gets the program by the preset `quick`, a changed one by `release`.
stub cmake <<'STUB'
[ "$1" = --preset ] || exit 0
mkdir -p "$SANDBOX/project/build/$2"
touch "$SANDBOX/project/build/$2/build.ninja"
STUB
stub ninja <<'STUB'
case " $* " in
*" -n "*) if [ -e "$2/viewer/lissom" ] && [ ! -e "$SANDBOX/changed" ]; then echo "ninja: no work to do."; fi ;;
*)
    mkdir -p "$2/viewer"
    printf '#!/bin/bash\necho "${0##*/} built in ${0%%/viewer/*}"\n' >"$2/viewer/$3"
    chmod +x "$2/viewer/$3"
    ;;
esac
STUB
built_in() { grep -q "built in $project/build/$1\$" "$sandbox/output"; }
rm -rf "$project/build"
mkdir "$project/build"
root=$project dev demo
expect "a first demo is of the quick preset" built_in quick
expect "and waits for no window" grep -q '^lissom_headless built' "$sandbox/output"
root=$project dev lissom
expect "the first program is that of the quick preset" built_in quick
expect "and has its window" grep -q '^lissom built' "$sandbox/output"
root=$project dev demo
expect "which a demo takes where it is there" grep -q '^lissom built' "$sandbox/output"
root=$project dev lissom
expect "and stays so" built_in quick
touch "$sandbox/changed"
root=$project dev lissom
expect "changed sources are built by the release preset" built_in release
rm "$sandbox/changed"
root=$project dev lissom
expect "which is taken from then on" built_in release

dev frobnicate
expect "an unknown command is a usage error" test "$status" = 2
dev setup frobnicate
expect "an unknown group is a usage error" test "$status" = 2

[ $failures = 0 ] || exit 1
echo "dev: all expectations hold"
