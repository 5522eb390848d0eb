"""Registers the add-on with a library that cannot be loaded, and prints what it says.

blender --background --factory-startup --python-exit-code 1 --python broken_test.py -- FOLDER
"""
import sys

import bpy

sys.path.insert(0, sys.argv[-1])

import lissom_blender  # noqa: E402
from lissom_blender import native  # noqa: E402

lissom_blender.register()
assert native.problem and native.lissom is None
assert hasattr(bpy.types, "LISSOM_PT_main") and not hasattr(bpy.types, "LISSOM_PT_deform")
print(native.problem)
lissom_blender.unregister()
assert not hasattr(bpy.types, "LISSOM_PT_main")
