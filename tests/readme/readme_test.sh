#!/usr/bin/env bash
# Runs the commands of sh blocks, the Lua scripts, and the C and C++ programs (against an installed copy of the
# library) of README.md and the guide, and checks that their links lead to files. Ends with the count.
# Usage: readme_test.sh ROOT [COMMAND...]   A COMMAND that has been run already is not run again.
set -uo pipefail

root=$(cd "$1" && pwd)
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

check() { # WHAT COMMAND...
    local what=$1
    shift
    printf '== %s\n' "$what"
    if "$@"; then
        passed=$((passed + 1))
    else
        printf 'FAILED: %s\n' "$what"
        failed=$((failed + 1))
    fi
}

pages=("$root/README.md" "$root"/docs/guide/*.md)

# Each fenced block becomes $work/blocks/NUMBER.LANGUAGE.
extract_blocks() {
    mkdir "$work/blocks"
    awk -v folder="$work/blocks" '
        /^```/ && file { close(file); file = ""; next }
        /^```[a-z]/ { file = sprintf("%s/%03d.%s", folder, ++count, substr($0, 4)); printf "" >file; next }
        file { print >file }' "${pages[@]}"
}

# A command that does not end, such as a server, fails.
run_command() { (cd "$root" && timeout 600 bash -euo pipefail -c "$1") </dev/null; }

run_script() {
    mkdir -p "$work/lua"
    (cd "$work/lua" && "$root/dev" lissom run "$1")
}

run_tests() { "$root/dev" lissom test "$1"; }

run_program() {
    local name prefix=$work/prefix
    name=$(basename "$1" .cpp)
    if [ ! -d "$prefix" ]; then
        "$root/dev" build release && cmake --install "$root/build/release" --prefix "$prefix" >/dev/null
    fi &&
        cmake -S "$root/tests/embed/consumer" -B "$work/$name" -G Ninja -DHELLO="$1" \
            -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null &&
        cmake --build "$work/$name" && (cd "$work" && "$work/$name/consumer")
}

# Compiled as C against the installed library, by what pkg-config says of it.
run_c_program() {
    local prefix=$work/prefix flags libraries
    libraries=$(dirname "$(find "$prefix" -name 'liblissom.so' | head -n 1)") &&
        flags=$(PKG_CONFIG_PATH=$libraries/pkgconfig pkg-config --cflags --libs lissom) || return 1
    # shellcheck disable=SC2086
    cc -std=c11 -Wall -Wextra -Werror "$1" $flags -lm -o "$work/c_program" &&
        LD_LIBRARY_PATH=$libraries "$work/c_program"
}

already_run() { # LINE COMMAND...
    local line=$1 command
    shift
    for command in "$@"; do [ "$command" != "$line" ] || return 0; done
    return 1
}

extract_blocks
check "there are commands, scripts and programs" \
    bash -c "ls '$work'/blocks/*.sh '$work'/blocks/*.lua '$work'/blocks/*.cpp '$work'/blocks/*.c"
check "README.md has at most 150 lines" test "$(wc -l <"$root/README.md")" -le 150
for block in "$work"/blocks/*; do
    case $block in
    *.sh)
        while read -r line; do
            line=$(printf '%s' "${line%%#*}" | sed 's/ *$//')
            [ -n "$line" ] || continue
            already_run "$line" "$@" || check "$line" run_command "$line"
        done <"$block"
        ;;
    *.lua)
        run=run_script
        ! grep -q '^test(' "$block" || run=run_tests
        check "Lua block $(basename "$block")" $run "$block"
        ;;
    *.cpp) check "C++ block $(basename "$block")" run_program "$block" ;;
    esac
done
# After the C++ program, which installs the library.
for block in "$work"/blocks/*.c; do check "C block $(basename "$block")" run_c_program "$block"; done

for page in "${pages[@]}" "$root"/docs/*.md "$root/CONTRIBUTING.md"; do
    while read -r link; do
        check "$(basename "$page") links to $link" test -e "$(dirname "$page")/$link"
    done < <(grep -oE '\]\([^)#:]+[)#]' "$page" | sed 's/^](//; s/[)#]$//' | sort -u)
done

printf '%d passed, %d failed\n' $passed $failed
[ $failed -eq 0 ]
