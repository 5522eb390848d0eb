"""The preferences of the add-on."""
import bpy
from bpy.props import StringProperty

from . import native


def _reload(_preferences, _context):
    if not native.problem:
        bpy.ops.lissom.reload_scripts()


class LissomPreferences(bpy.types.AddonPreferences):
    """The folder of the user's own scripts."""
    bl_idname = __package__

    folder: StringProperty(name="Scripts", subtype="DIR_PATH", update=_reload,
                           description="Folder whose Lua scripts become operators")

    def draw(self, _context):
        if native.problem:
            self.layout.label(text=native.problem, icon="ERROR")
        self.layout.prop(self, "folder")


CLASSES = (LissomPreferences,)
