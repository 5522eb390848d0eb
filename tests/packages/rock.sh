#!/usr/bin/env bash
# Builds the rock with luarocks from an export of the tree, for lua5.4 and for LuaJIT, into folders of its own, and
# bends a cactus in each.
# Usage: rock.sh ROOT WORK
set -euo pipefail

root=$1 work=$2
version=$(sed -n 's/^#define LISSOM_VERSION_[A-Z]* \([0-9]*\)$/\1/p' "$root/kernel/core/version.h" | paste -sd.)
rockspec=lissom-$version-1.rockspec
passed=0 failed=0
check() { # WHAT COMMAND...
    printf '== %s\n' "$1"
    if "${@:2}"; then passed=$((passed + 1)); else
        printf 'FAILED: %s\n' "$1"
        failed=$((failed + 1))
    fi
}

# With what was changed and not yet committed.
rm -rf "$work"
mkdir -p "$work/sources"
commit=$(git -C "$root" stash create)
git -C "$root" archive "${commit:-HEAD}" | tar -C "$work/sources" -x
cd "$work/sources"
CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
export CMAKE_BUILD_PARALLEL_LEVEL

# The second installs from the same build folder, where the kernel has been compiled.
installs() { # LUA_VERSION TREE [VARIABLE=VALUE...]
    luarocks --lua-version="$1" --tree="$work/$2" make --deps-mode=none "$rockspec" "${@:3}"
}
bends() { # INTERPRETER LUA_VERSION TREE
    local cpath="$work/$3/lib/lua/$2/?.so"
    mkdir "$work/$1" || return 1
    # Nothing but the module that was just installed can be found.
    (cd "$work/$1" && LUA_CPATH=$cpath LUA_PATH=none "$1" "$root/examples/hello.lua" && [ -s hello.obj ])
}
loads() { # INTERPRETER LUA_VERSION TREE : by the paths that luarocks tells
    (
        eval "$(luarocks --lua-version="$2" --tree="$work/$3" path)"
        "$1" -e "local file = package.searchpath('lissom', package.cpath); print(file)
            assert(file:find('$work/$3', 1, true)); assert(#require('lissom').shapes.box() == 8)
            assert(require('lissom').licence:find('MIT'))"
    )
}

check "the spec is one" luarocks lint "$rockspec"
check "it builds for lua5.4" installs 5.4 lua5.4_tree
check "lua5.4 finds it by the paths of luarocks" loads lua5.4 5.4 lua5.4_tree
check "lua5.4 bends a cactus" bends lua5.4 5.4 lua5.4_tree
check "it builds for LuaJIT" installs 5.1 luajit_tree LUA_INCDIR="$(pkg-config --variable=includedir luajit)"
check "LuaJIT finds it by the paths of luarocks" loads luajit 5.1 luajit_tree
check "LuaJIT bends a cactus" bends luajit 5.1 luajit_tree
check "into the same shape" cmp "$work"/{lua5.4,luajit}/hello.obj
printf '%d passed, %d failed\n' $passed $failed
[ $failed -eq 0 ]
