"""Handles of a mesh: vertex groups, each with an empty that moves them, or that stay."""
import bpy
from bpy.props import EnumProperty, FloatVectorProperty, PointerProperty, StringProperty
from mathutils import Matrix, Vector

from .meshes import leave_edit_mode, selected_vertices, vertices_in_group
from .problems import Problem, check_editable, check_mesh


class LissomHandle(bpy.types.PropertyGroup):
    """The mesh and the vertex group that an empty moves."""
    subject: PointerProperty(type=bpy.types.Object, name="Object", description="The mesh that the handle belongs to")
    group: StringProperty(name="Vertex Group", description="The vertices that follow the empty")
    rest: FloatVectorProperty(size=16, description="Matrix of the empty in the space of the mesh, at rest")


PIN = "Pin"


def empties_of(obj):
    """Returns the empties that are handles of a mesh."""
    return [one for one in bpy.data.objects if one.lissom_handle.subject == obj and one.users_scene]


def rest_of(empty):
    """Returns the matrix of a handle at rest, in the space of its mesh."""
    numbers = list(empty.lissom_handle.rest)
    return Matrix([numbers[i:i + 4] for i in range(0, 16, 4)])


def set_rest(empty, obj):
    """Makes the present place of an empty that of the handle at rest."""
    matrix = obj.matrix_world.inverted() @ empty.matrix_world
    empty.lissom_handle.rest = [number for row in matrix for number in row]


def transform_of(empty, obj):
    """Returns the transform of a handle from its rest shape, in the space of its mesh; at rest the identity, to the bit."""
    now, rest = obj.matrix_world.inverted() @ empty.matrix_world, rest_of(empty)
    return Matrix() if now == rest else now @ rest.inverted()


def pinned_groups(obj):
    """Returns the names of the vertex groups that stay: "Pin", "Pin.001", ..."""
    return [group.name for group in obj.vertex_groups if group.name.split(".")[0] == PIN]


def group_vertices(obj, name):
    """Returns the vertices of a group of a handle. Errors: Problem if the group is gone or empty."""
    if name not in obj.vertex_groups:
        raise Problem(f"'{obj.name}' has no vertex group '{name}' any more: delete the empty of that handle, or make the "
                      "group again")
    vertices = vertices_in_group(obj, name)
    if not vertices:
        raise Problem(f"no vertex has a weight of .5 or more in the vertex group '{name}' of '{obj.name}'")
    return vertices


class LISSOM_OT_add_handle(bpy.types.Operator):
    """Makes the selected vertices a handle: a vertex group, and an empty that moves it. Or pins them"""
    bl_idname, bl_label, bl_options = "lissom.add_handle", "Add Handle", {"REGISTER", "UNDO"}

    kind: EnumProperty(name="Kind", items=[("MOVE", "Handle", "The vertices follow an empty"),
                                           ("PIN", "Pin", "The vertices stay where they are")])

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        obj = context.object
        mode = leave_edit_mode(context)
        try:
            check_mesh(obj)
            check_editable(obj)
            self.add(context, obj)
        except Problem as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        finally:
            if mode == "EDIT" and context.view_layer.objects.active == obj:
                bpy.ops.object.mode_set(mode=mode)
        return {"FINISHED"}

    def add(self, context, obj):
        """Adds the group and, unless the vertices are to stay, the empty."""
        vertices = selected_vertices(obj)
        if not vertices:
            raise Problem("select the vertices of the handle in edit mode")
        group = obj.vertex_groups.new(name=PIN if self.kind == "PIN" else "Handle")
        group.add(vertices, 1.0, "REPLACE")
        if self.kind == "MOVE":
            add_empty(context, obj, group.name, vertices)


class LISSOM_OT_select_handle(bpy.types.Operator):
    """Selects the empty of this handle, to move it"""
    bl_idname, bl_label, bl_options = "lissom.select_handle", "Select Handle", {"REGISTER", "UNDO"}

    name: StringProperty(name="Empty")

    def execute(self, context):
        empty = context.view_layer.objects.get(self.name)
        if empty is None:
            self.report({"ERROR"}, f"there is no empty '{self.name}' any more")
            return {"CANCELLED"}
        leave_edit_mode(context)
        for other in context.selected_objects:
            other.select_set(False)
        empty.select_set(True)
        context.view_layer.objects.active = empty
        return {"FINISHED"}


def add_empty(context, obj, group, vertices):
    """Adds the empty of a handle in the middle of its vertices."""
    points = [obj.data.vertices[vertex].co for vertex in vertices]
    center = sum(points, Vector()) / len(points)
    size = max(((obj.matrix_world @ point) - (obj.matrix_world @ center)).length for point in points)
    empty = bpy.data.objects.new(f"{obj.name} {group}", None)
    (obj.users_collection or (context.collection,))[0].objects.link(empty)
    empty.empty_display_type, empty.empty_display_size = "SPHERE", max(size, 1e-4)
    empty.show_in_front = True
    empty.rotation_mode = "QUATERNION"
    empty.matrix_world = Matrix.Translation(obj.matrix_world @ center)
    empty.lissom_handle.subject, empty.lissom_handle.group = obj, group
    context.view_layer.update()
    set_rest(empty, obj)
    return empty


CLASSES = (LissomHandle, LISSOM_OT_add_handle, LISSOM_OT_select_handle)


def register():
    """Adds the property of empties."""
    bpy.types.Object.lissom_handle = PointerProperty(type=LissomHandle)


def unregister():
    """Removes it."""
    del bpy.types.Object.lissom_handle
