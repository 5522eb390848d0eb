#!/usr/bin/env bash
# Installs the Debian packages into a folder that holds a bare Debian, and uses each as a stranger would: scripts in
# the program, in lua5.4 and in LuaJIT; then C by pkg-config and C++ by CMake. Needs root, debootstrap and a mirror.
# Usage: bare_debian.sh ROOT PACKAGES WORK     (the bare system is kept in WORK/bare.tar)
set -euo pipefail

root=$1 packages=$2 work=$3
suite=bookworm mirror=http://deb.debian.org/debian
mkdir -p "$work"
if [ ! -e "$work/bare.tar" ]; then
    rm -rf "$work/bare"
    debootstrap --variant=minbase "$suite" "$work/bare" "$mirror"
    tar -C "$work/bare" -cf "$work/bare.tar" .
fi
rm -rf "$work/system"
mkdir "$work/system"
tar -C "$work/system" -xf "$work/bare.tar"
cp /etc/resolv.conf "$work/system/etc/resolv.conf"
mkdir "$work/system/work"
cp "$packages"/*.deb "$root"/examples/hello.{c,cpp} "$root/examples/hello.lua" "$work/system/work"
cp -r "$root/tests/embed/consumer" "$work/system/work/consumer"

# The program finds its scripts by way of /proc.
mount -t proc proc "$work/system/proc"
trap 'umount "$work/system/proc"' EXIT
passed=0 failed=0
inside() { chroot "$work/system" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
    bash -euo pipefail -c "cd /work; $1"; }
check() { # WHAT COMMANDS
    printf '== %s\n' "$1"
    if inside "$2"; then passed=$((passed + 1)); else
        printf 'FAILED: %s\n' "$1"
        failed=$((failed + 1))
    fi
}
install="apt-get install -y -qq --no-install-recommends"

check "the program installs" "apt-get update -qq && $install ./lissom_*.deb"
check "nothing under the GPL came with it" "! dpkg -l | grep -E 'libcholmod|libreadline|libopenblas'"
check "its version" "lissom --version | grep -F 'MIT'"
check "a script" "mkdir -p out && lissom run hello.lua && test -s hello.obj"
check "the scripts that ship" "lissom run /usr/share/lissom/examples/merge/sphinx.lua --help >/dev/null"
check "no picture without OpenGL, and it says what to install" \
    "echo 'local l = require \"lissom\"; print(l.render{ mesh = l.shapes.box(), file = \"a.png\" })' >draw.lua;
     { lissom run draw.lua 2>&1 || true; } | grep -F 'apt-get install'"
check "a window needs GLFW, and it says so" "{ lissom view hello.obj 2>&1 || true; } | grep -F 'libglfw3'"
check "the modules install" "$install ./lua-lissom_*.deb lua5.4 luajit"
check "lua5.4 finds its module" "lua5.4 -e 'assert(#require(\"lissom\").shapes.box() == 8)'"
check "LuaJIT finds its module" "luajit -e 'assert(#require(\"lissom\").shapes.box() == 8)'"
check "the C library alone" "$install ./liblissom_*.deb && test ! -e /usr/include/lissom"
check "development installs with what it needs" "$install ./liblissom-dev_*.deb g++ cmake make pkg-config"
check "C by pkg-config" \
    "cc -std=c99 hello.c \$(pkg-config --cflags --libs lissom) -lm -o hello_c && ./hello_c bent_c.obj && test -s bent_c.obj"
check "C++ by CMake" \
    "cmake -S consumer -B built -DHELLO=/work/hello.cpp -DCOMPONENTS=kernel,c >/dev/null &&
     cmake --build built --target consumer solver && built/solver && built/consumer"
check "all goes again" "apt-get remove -y -qq 'lissom' 'lua-lissom' 'liblissom*' && test ! -e /usr/share/lissom"

printf '%d passed, %d failed\n' $passed $failed
[ $failed -eq 0 ]
