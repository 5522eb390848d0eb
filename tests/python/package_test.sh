#!/usr/bin/env bash
# Runs the tests of the Python package with a library that was just built. Usage: package_test.sh ROOT LIBRARY PYTHON
set -euo pipefail

root=$1 python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cp -r "$root/bindings/python/lissom" "$work/lissom"
"$python" -B "$root/bindings/python/generate.py" "$root/bindings/c/lissom.h" "$work/lissom"
cd "$work"
LISSOM_LIBRARY=$2 PYTHONPATH=$work "$python" -B "$root/tests/python/python_test.py" "$root/bindings/c/abi.txt"
