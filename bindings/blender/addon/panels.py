"""The sidebar and the menus of the add-on."""
import textwrap

import bpy

from . import native
from .deform import subject_of
from .hair import has_changed, record_of
from .handles import empties_of, pinned_groups
from .scripts import registry


class _Panel:
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Lissom"


class LISSOM_PT_main(_Panel, bpy.types.Panel):
    """Tells why the library cannot be loaded."""
    bl_label = "Lissom"

    def draw(self, _context):
        self.layout.label(text="The library is not there", icon="ERROR")
        for line in textwrap.wrap(native.problem, 44):
            self.layout.label(text=line)


class LISSOM_PT_deform(_Panel, bpy.types.Panel):
    """Handles of the active mesh, and the deformation."""
    bl_label = "Deform"

    def draw(self, context):
        layout, obj = self.layout, subject_of(context)
        row = layout.row(align=True)
        row.operator("lissom.add_handle", icon="EMPTY_DATA").kind = "MOVE"
        row.operator("lissom.add_handle", text="Add Pin", icon="PINNED").kind = "PIN"
        if obj is None:
            layout.label(text="Select a mesh", icon="INFO")
            return
        column = layout.column(align=True)
        for empty in empties_of(obj):
            row = column.row()
            row.alignment = "LEFT"
            button = row.operator("lissom.select_handle", text=empty.lissom_handle.group, icon="EMPTY_DATA", emboss=False)
            button.name = empty.name
        for name in pinned_groups(obj):
            column.label(text=name, icon="PINNED")
        layout.operator_context = "INVOKE_DEFAULT"
        row = layout.row()
        row.scale_y = 1.4
        row.operator("lissom.deform", icon="MOD_SIMPLEDEFORM")


class LISSOM_PT_merge(_Panel, bpy.types.Panel):
    """Operators on two meshes."""
    bl_label = "Merge"

    def draw(self, _context):
        column = self.layout.column(align=True)
        column.operator_context = "INVOKE_DEFAULT"
        column.operator("lissom.merge", icon="AUTOMERGE_ON")
        column.operator("lissom.paste", icon="PASTEDOWN")


class LISSOM_PT_hair(_Panel, bpy.types.Panel):
    """Hair on heads."""
    bl_label = "Hair"

    def draw(self, context):
        column = self.layout.column(align=True)
        column.operator_context = "INVOKE_DEFAULT"
        column.menu("LISSOM_MT_presets", icon="OUTLINER_OB_CURVES")
        column.operator("lissom.hair_from_curves", icon="CURVE_PATH")
        column.operator("lissom.hair_from_style", icon="FILE_FOLDER")
        column.operator("lissom.save_style", icon="FILE_TICK")
        if record_of(context.object):
            column = self.layout.column()
            column.operator_context = "INVOKE_DEFAULT"
            if has_changed(context.object):
                column.label(text="The head has changed", icon="INFO")
            column.operator("lissom.groom_again", icon="FILE_REFRESH")


class LISSOM_PT_scripts(_Panel, bpy.types.Panel):
    """The scripts of the add-on's folder and of the user's."""
    bl_label = "Scripts"

    def draw(self, _context):
        column = self.layout.column(align=True)
        column.operator_context = "INVOKE_DEFAULT"
        for operator in registry.operators:
            if not operator.source.is_preset:
                column.operator(operator.bl_idname, icon="SCRIPT")
        for name, error in registry.failures.items():
            column.label(text=f"{name}: {error}", icon="ERROR")
        self.layout.operator("lissom.reload_scripts", icon="FILE_REFRESH")


class LISSOM_MT_presets(bpy.types.Menu):
    """The presets of hair."""
    bl_label = "Hair Preset"

    def draw(self, _context):
        self.layout.operator_context = "INVOKE_DEFAULT"
        for operator in registry.operators:
            if operator.source.is_preset:
                self.layout.operator(operator.bl_idname)


CLASSES = (LISSOM_PT_main,) if native.problem else (
    LISSOM_PT_deform, LISSOM_PT_merge, LISSOM_PT_hair, LISSOM_PT_scripts, LISSOM_MT_presets)
