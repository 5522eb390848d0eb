#!/usr/bin/env bash
# Tests that every name in tests/slow_tests.txt is a test, but for kinds that this build leaves out whole.
# Usage: slow_tests_test.sh ROOT BUILD
set -euo pipefail

known=$(ctest --test-dir "$2" -N | sed -n 's/^ *Test *#[0-9]*: //p')
failures=0
while read -r name; do
    if grep -qxF -- "$name" <<<"$known"; then continue; fi
    if grep -q "^${name%%_*}" <<<"$known"; then
        echo "FAILED: tests/slow_tests.txt names $name, which is no test"
        failures=$((failures + 1))
    fi
done < <(grep -v '^#' "$1/tests/slow_tests.txt")
exit $((failures > 0))
