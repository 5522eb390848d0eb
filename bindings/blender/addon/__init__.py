"""Lissom in Blender: deformation by handles, merging, pasting, hair, and scripts in Lua as operators."""
bl_info = {
    "name": "Lissom",
    "description": "Deforms meshes by handles, merges them, and grooms hair; Lua scripts are operators",
    "author": "Lissom",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Lissom",
    "category": "Mesh",
}

import bpy

from . import deform, hair, handles, merging, native, panels, preferences, scripts

# Without the library only a panel and the preferences, which tell why it is missing.
_MODULES = (preferences, panels) if native.problem else (preferences, handles, deform, merging, hair, scripts, panels)


def register():
    """Adds the classes and properties of the add-on."""
    for module in _MODULES:
        for one in module.CLASSES:
            bpy.utils.register_class(one)
        getattr(module, "register", lambda: None)()


def unregister():
    """Removes them."""
    for module in reversed(_MODULES):
        getattr(module, "unregister", lambda: None)()
        for one in reversed(module.CLASSES):
            bpy.utils.unregister_class(one)
