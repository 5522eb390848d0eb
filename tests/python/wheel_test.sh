#!/usr/bin/env bash
# Makes a wheel of a library, installs it in a new environment without the network, and runs the tests of the package there.
# Usage: wheel_test.sh ROOT LIBRARY PYTHON
set -euo pipefail

root=$1 library=$2 python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$python" -c 'import ensurepip, venv' 2>/dev/null || {
    echo "skipped: this Python makes no environments (python3-venv)"
    exit 77
}
wheel=$("$python" -B "$root/bindings/python/wheel.py" "$library" "$work")
again=$("$python" -B "$root/bindings/python/wheel.py" "$library" "$work/again")
cmp "$wheel" "$again"
"$python" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --no-index "$wheel"
cd "$work"
unset LISSOM_LIBRARY PYTHONPATH
"$work/venv/bin/python" -B "$root/tests/python/python_test.py" "$root/bindings/c/abi.txt"
# Without its library, or with one of another version, the package says so.
place=$("$work/venv/bin/python" -c 'import lissom, os; print(os.path.dirname(lissom.__file__))')
rm "$place/liblissom.so"
told=$("$work/venv/bin/python" -c 'import lissom' 2>&1) && exit 1
grep -q 'name liblissom.so in LISSOM_LIBRARY' <<<"$told"
told=$(LISSOM_LIBRARY=libm.so.6 "$work/venv/bin/python" -c 'import lissom' 2>&1) && exit 1
grep -q 'library of another version' <<<"$told"
