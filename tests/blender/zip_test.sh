#!/usr/bin/env bash
# Installs the add-on's zip as a user does, in a new home, and bends a mesh with it. Usage: zip_test.sh ROOT ZIP BLENDER
set -euo pipefail

root=$1 zip=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export HOME=$work XDG_CONFIG_HOME=$work/config BLENDER_USER_RESOURCES=$work/blender
unset LISSOM_LIBRARY PYTHONPATH

"$3" --background --factory-startup --python-exit-code 1 --python "$root/tests/blender/install.py" -- "$zip"
# The next start has it, as the preferences were saved.
"$3" --background --python-exit-code 1 --python-expr \
    'import bpy; assert "lissom_blender" in bpy.context.preferences.addons; assert hasattr(bpy.types, "LISSOM_OT_deform")'
