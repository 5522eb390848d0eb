"""Installs and enables the add-on's zip, saves the preferences, and bends the default cube.

blender --background --factory-startup --python-exit-code 1 --python install.py -- ZIP
"""
import sys

import bpy

bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
bpy.ops.preferences.addon_enable(module="lissom_blender")
bpy.ops.wm.save_userpref()

from lissom_blender import handles, native  # noqa: E402

assert native.problem == "", native.problem
cube = bpy.data.objects["Cube"]
for kind, side in (("PIN", -1), ("MOVE", 1)):
    flags = [vertex.co.z * side > 0 for vertex in cube.data.vertices]
    cube.data.vertices.foreach_set("select", flags)
    bpy.context.view_layer.objects.active = cube
    bpy.ops.lissom.add_handle(kind=kind)
handles.empties_of(cube)[0].location.x += 1
bpy.context.view_layer.update()
bpy.context.view_layer.objects.active = cube
assert bpy.ops.lissom.deform() == {"FINISHED"}
moved = [key.co.x - vertex.co.x for key, vertex in zip(cube.data.shape_keys.key_blocks["Lissom"].data, cube.data.vertices)]
assert all(abs(shift - (vertex.co.z > 0)) < 1e-5 for shift, vertex in zip(moved, cube.data.vertices)), moved
print("installed")
