# shellcheck shell=bash
# Steps with a time budget: each runs to its end whatever the others did, keeps its output in build/ci,
# and is counted. Sourced by .ci/run and .ci/check.

ci_log=$PWD/build/ci
mkdir -p "$ci_log"
ci_passed=0 ci_failed=0 ci_table=
jobs=$(nproc 2>/dev/null || echo 2)

# step NAME SECONDS COMMAND... : counts the tests of its last line "N passed, N failed" where it prints one,
# else 1. Machines are noisy, so only twice the SECONDS allowed is a failure.
step() {
    local name=$1 allowed=$2 log=$ci_log/$1.log started=$SECONDS status=0 counts passed failed used
    shift 2
    printf '== %s\n' "$name"
    "$@" >"$log" 2>&1 </dev/null || status=$?
    used=$((SECONDS - started))
    counts=$(grep -oE '[0-9]+ passed, [0-9]+ failed' "$log" | tail -n 1) || true
    passed=${counts%% passed*} failed=${counts##*, } failed=${failed%% failed}
    if [ -z "$counts" ]; then passed=$((status == 0)) failed=$((status != 0)); fi
    if [ $status -ne 0 ] && [ "$failed" -eq 0 ]; then failed=1; fi
    if [ "$failed" -gt 0 ]; then
        printf -- '-- %s failed; the end of %s:\n' "$name" "$log"
        tail -n 80 "$log"
    fi
    if [ $used -gt $((2 * allowed)) ]; then
        printf -- '-- %s took %s s, allowed are %s s\n' "$name" $used "$allowed"
        failed=$((failed + 1))
    fi
    printf '   %s s\n' $used
    ci_passed=$((ci_passed + passed)) ci_failed=$((ci_failed + failed))
    ci_table+=$(printf '%-16s %6s %8s %8s %8s' "$name" "$used" "$allowed" "$passed" "$failed")$'\n'
}

# step_until LAST NAME SECONDS COMMAND... : a step that is left out, and says so, where it would begin after LAST.
step_until() {
    local last=$1
    shift
    if [ $SECONDS -le "$last" ]; then
        step "$@"
        return
    fi
    printf -- '-- %s is left out: %s s are over\n' "$1" $SECONDS
    ci_table+=$(printf '%-16s %6s %8s %8s %8s' "$1" - "$2" - -)$'\n'
}

# finish SECONDS : prints the budget table and the last line; the exit status says whether all passed.
finish() {
    local used=$SECONDS allowed=$1
    printf '\n%-16s %6s %8s %8s %8s\n' step seconds allowed passed failed
    printf '%s' "$ci_table"
    printf '%-16s %6s %8s\n\n' total "$used" "$allowed"
    if [ "$used" -gt $((2 * allowed)) ]; then ci_failed=$((ci_failed + 1)); fi
    printf '%d passed, %d failed\n' $ci_passed $ci_failed
    [ $ci_failed -eq 0 ]
}

# sources EXTENSION... : the project's own files with one of these extensions.
sources() {
    local extension
    for extension in "$@"; do
        find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -name "*.$extension" -print
    done | sort
}

# compiled FOLDER REGEX : units of the compile database of FOLDER, single sources and rooms that are compiled
# together, whose path from the root or from FOLDER matches.
compiled() {
    sed -n "s|^ *\"file\": \"$PWD/\(.*\)\".*|\1|p" "$1/compile_commands.json" | sort -u |
        grep -E "^($1/)?($2)"
}

# tidy REGEX : clang-tidy, with the checks of .clang-tidy, over the units that match, as clang built them.
tidy() {
    local units
    units=$(compiled build/asan "$1") || { echo "no source matches $1"; return 1; }
    printf '%s\n' "$units" | xargs -P "$jobs" -n 1 clang-tidy --quiet -p build/asan
}

# sanitized_tests MODULE... : builds and runs their unit tests with sanitizers, without the real models, which take
# long.
sanitized_tests() {
    local status=0 names
    names=$(printf '|%s' "$@")
    ./dev build asan "${@/#/test_}" || return 1
    cmake -S . -B build/asan -DLISSOM_TEST_DATA=/nonexistent >/dev/null || return 1
    ./dev ctest asan -R "^unit_(${names#|})\$" || status=1
    ./dev summary asan
    return $status
}
