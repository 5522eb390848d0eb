"""Hair onto heads: from curves drawn by hand, from styles of Lissom, and again when a head has changed."""
import json

import bpy
from bpy.app.handlers import persistent
from bpy.props import FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from .curves import begin_at, drawn_curves, new_curves, put_on_surface, set_material
from .meshes import floats, leave_edit_mode, read, shown_positions, surface_of, vertices_in_group
from .native import lissom, new_context
from .problems import Problem, check_mesh
from .work import Work

# The custom property of Curves objects that tells how they were groomed.
RECORD = "lissom"
COLOR = (0.144, 0.068, 0.028)
# Kinds of curves by the beginning of their names.
_KINDS = {"parting": "dividing", "tail": "ponytail"}


def head_mesh(head, context, library):
    """Returns the mesh of a head as it is shown, with its texture coordinates, and its vertex groups as regions."""
    mesh = surface_of(head, library, shown_positions(head, context))
    layer = head.data.uv_layers.active
    if layer:
        mesh.write_attribute("uv", "corners", 2, read(layer.data, "uv", floats(2 * len(layer.data))))
    give_regions(head, mesh)
    return mesh


def give_regions(obj, mesh):
    """Names the vertex groups of an object as regions of its mesh."""
    for group in obj.vertex_groups:
        vertices = vertices_in_group(obj, group.name)
        if vertices:
            mesh.set_region(group.name, lissom.Region.of_vertices(mesh, vertices))


def put_hair(context, head, strands, unit, record, name, color=COLOR, replaced=None):
    """Adds a Curves object with hair of a head. `record` tells how it was groomed. An object that it replaces gives it its
    name, its material and its settings."""
    if not strands.size:
        raise Problem("no hair grows: does the scalp lie on the head, and do curves begin at it?")
    uvs = strands.read("root_uv", out=floats(2 * strands.size)) if strands.has("root_uv") else None
    obj = new_curves(context, name, strands, unit, head.matrix_world)
    put_on_surface(obj, head, uvs)
    obj[RECORD] = json.dumps(record)
    context.view_layer.update()
    _changed.discard(head.name)
    if replaced:
        _take_place(obj, replaced)
    else:
        obj.parent, obj.matrix_parent_inverse = head, head.matrix_world.inverted()
        set_material(obj, color)
    return obj


def _take_place(obj, replaced):
    """Gives an existing object the content of a new one, which is removed."""
    data, before = obj.data, replaced.data
    for material in before.materials:
        data.materials.append(material)
    replaced[RECORD] = obj[RECORD]
    name = before.name
    replaced.data = data
    bpy.data.objects.remove(obj)
    bpy.data.hair_curves.remove(before)
    data.name = name
    replaced.select_set(True)
    bpy.context.view_layer.objects.active = replaced


def head_of(context):
    """Returns the head that an operator works on: the active mesh, or the one below active hair."""
    obj = context.object
    if obj is not None and obj.type == "CURVES" and obj.data.surface:
        obj = obj.data.surface
    check_mesh(obj, "the head")
    return obj


class _Grown:
    """Parameters of growth."""
    count: IntProperty(name="Strands", default=10000, min=1, soft_max=100000, max=2000000)
    length: FloatProperty(name="Length", default=0.3, min=0.001, max=3, precision=3,
                          description="Of a strand, in metres of an average head")
    variation: FloatProperty(name="Variation", default=0.1, min=0, max=1, description="Fraction by which the length varies")
    seed: IntProperty(name="Seed", default=1, min=0, description="Chance")
    resolution: IntProperty(name="Resolution", default=50000, min=1000, max=2000000,
                            description="Grid points of the field of directions, at most")
    scalp: StringProperty(name="Scalp", description="Vertex group that hair grows on; empty: above the hairline")

    def values(self):
        """Returns the parameters by name."""
        return {name: getattr(self, name) for name in ("count", "length", "variation", "seed", "resolution", "scalp")}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("count", "length", "variation", "seed", "resolution"):
            layout.prop(self, name)
        obj = context.object
        head = obj.data.surface if obj and obj.type == "CURVES" else obj
        if head and head.type == "MESH":
            layout.prop_search(self, "scalp", head, "vertex_groups")


def _style_options(head, mesh, values):
    options = {"resolution": values["resolution"]}
    if values["scalp"]:
        if values["scalp"] not in head.vertex_groups:
            raise Problem(f"'{head.name}' has no vertex group '{values['scalp']}': choose another scalp")
        options["scalp"] = lissom.Region.of_vertices(mesh, vertices_in_group(head, values["scalp"]))
    return options


def _grown(style, values):
    """Solves and grows, as steps of an operator; returns the strands."""
    yield style.begin_solve()
    strands = yield style.begin_grow(count=values["count"], seed=values["seed"], length=values["length"],
                                     variation=values["variation"])
    return strands


def style_of_curves(head, mesh, curves, context, values):
    """Returns a style of the curves of objects: streams, partings and ponytails."""
    style = lissom.Hairstyle.create(mesh, **_style_options(head, mesh, values))
    for obj in curves:
        kind = next((kind for start, kind in _KINDS.items() if obj.name.lower().startswith(start)), "stream")
        for line in drawn_curves(obj, context, head.matrix_world.inverted()):
            add = getattr(style, "add_" + kind)
            add(begin_at(line, head) if kind != "dividing" else line)
    if not style.curve_count:
        raise Problem("the selected curves have no line of two points: draw on the head with the pen of curves, or comb hair "
                      "in sculpt mode")
    return style


def grow_from_curves(context, library, head, curves, values):
    """Grows hair along curves, as steps; returns the strands and the unit of the head."""
    mesh = head_mesh(head, context, library)
    style = style_of_curves(head, mesh, curves, context, values)
    strands = yield from _grown(style, values)
    return strands, style.unit()[0]


def grow_from_text(context, library, head, text, values):
    """Grows hair of a style of Lissom, as steps; returns the strands and the unit of the head."""
    mesh = head_mesh(head, context, library)
    style = lissom.Hairstyle.decode(text.encode(), mesh, **_style_options(head, mesh, values))
    strands = yield from _grown(style, values)
    return strands, style.unit()[0]


def selected_curves(context):
    """Returns the selected curves of both kinds. Without any it is a Problem."""
    curves = [obj for obj in context.selected_objects if obj.type in {"CURVES", "CURVE"}]
    if not curves:
        raise Problem("select the curves that hair shall follow, and, as the active object, the head")
    return curves


class LISSOM_OT_hair_from_curves(_Grown, Work, bpy.types.Operator):
    """Grows hair on the active head along the selected curves. A curve whose name begins with "Parting" parts hair, one that
    begins with "Tail" gathers it in a ponytail"""
    bl_idname, bl_label, bl_options = "lissom.hair_from_curves", "Hair from Curves", {"REGISTER", "UNDO"}

    def steps(self, context):
        leave_edit_mode(context)
        head, curves = head_of(context), selected_curves(context)
        with new_context() as library:
            strands, unit = yield from grow_from_curves(context, library, head, curves, self.values())
            record = {"curves": [obj.name for obj in curves], "values": self.values()}
            put_hair(context, head, strands, unit, record, "Hair")


class LISSOM_OT_hair_from_style(_Grown, Work, ImportHelper, bpy.types.Operator):
    """Grows hair on the active head by a style that Lissom has saved"""
    bl_idname, bl_label, bl_options = "lissom.hair_from_style", "Hair from Style", {"REGISTER", "UNDO"}
    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    def invoke(self, context, event):
        return ImportHelper.invoke(self, context, event)

    def steps(self, context):
        leave_edit_mode(context)
        head, text = head_of(context), read_text(self.filepath)
        with new_context() as library:
            strands, unit = yield from grow_from_text(context, library, head, text, self.values())
            put_hair(context, head, strands, unit, {"style": text, "values": self.values()}, "Hair")


def read_text(path):
    """Returns the text of a file; a Problem if it cannot be read."""
    try:
        with open(bpy.path.abspath(path), encoding="utf-8") as file:
            return file.read()
    except (OSError, UnicodeDecodeError) as error:
        raise Problem(f"{path} cannot be read: {error}") from None


class LISSOM_OT_save_style(ExportHelper, bpy.types.Operator):
    """Saves the selected curves on the active head as a style of Lissom, which its window and scripts open"""
    bl_idname, bl_label, bl_options = "lissom.save_style", "Save Style", {"REGISTER"}
    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        try:
            with new_context() as library:
                head = head_of(context)
                mesh = head_mesh(head, context, library)
                style = style_of_curves(head, mesh, selected_curves(context), context, {"resolution": 50000, "scalp": ""})
                with open(self.filepath, "wb") as file:
                    file.write(style.encode())
        except (lissom.Error, Problem, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def record_of(obj):
    """Returns how hair was groomed; None for curves that were not."""
    text = obj.get(RECORD) if obj is not None and obj.type == "CURVES" else None
    return json.loads(text) if isinstance(text, str) else None


# Names of meshes that have changed since hair of them was groomed.
_changed = set()


@persistent
def _note_changes(_scene, depsgraph):
    """Hears of each change of Blender's data."""
    for update in depsgraph.updates:
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Object) and update.id.type == "MESH":
            _changed.add(update.id.name)


def has_changed(obj):
    """Returns whether the head of hair has changed since it was groomed."""
    return obj.data.surface is not None and obj.data.surface.name in _changed


def register():
    """Begins to listen to changes."""
    bpy.app.handlers.depsgraph_update_post.append(_note_changes)


def unregister():
    """Ends it."""
    bpy.app.handlers.depsgraph_update_post.remove(_note_changes)


class LISSOM_OT_groom_again(Work, bpy.types.Operator):
    """Grooms the active hair again: on its head as it is now, along its curves as they are now"""
    bl_idname, bl_label, bl_options = "lissom.groom_again", "Groom Again", {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return record_of(context.object) is not None

    def steps(self, context):
        obj, record = context.object, record_of(context.object)
        if obj.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        head = obj.data.surface
        if head is None:
            raise Problem(f"'{obj.name}' has lost its head: set the surface of the curves, in the properties of their data")
        with new_context() as library:
            strands, unit = yield from self.grow(context, library, head, record)
            put_hair(context, head, strands, unit, record, obj.name, replaced=obj)

    def grow(self, context, library, head, record):
        """Repeats the groom of the record, as steps."""
        if "script" in record:
            from .scripts import groom_by_script
            return (yield from groom_by_script(context, library, head, record))
        if "style" in record:
            return (yield from grow_from_text(context, library, head, record["style"], record["values"]))
        curves = [bpy.data.objects.get(name) for name in record["curves"]]
        if not all(curves):
            gone = ", ".join(name for name, one in zip(record["curves"], curves) if one is None)
            raise Problem(f"the curves of this hair are gone ({gone}): rename them back, or use Hair from Curves")
        return (yield from grow_from_curves(context, library, head, curves, record["values"]))


CLASSES = (LISSOM_OT_hair_from_curves, LISSOM_OT_hair_from_style, LISSOM_OT_save_style, LISSOM_OT_groom_again)
