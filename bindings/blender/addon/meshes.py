"""Meshes of Blender as meshes of the library, and back."""
import array

import bpy
from mathutils import Matrix

from .native import lissom
from .problems import check_mesh


def floats(count):
    """Returns an array of `count` numbers as Blender and the library exchange them."""
    return array.array("f", bytes(4 * count))


def integers(count):
    """Returns an array of `count` integers."""
    return array.array("i", bytes(4 * count))


def read(elements, name, values):
    """Reads a property of all elements into an array, which it returns."""
    elements.foreach_get(name, values)
    return values


def base_positions(obj):
    """Returns the coordinates of the mesh, those of the Basis if it has shape keys."""
    return read(obj.data.vertices, "co", floats(3 * len(obj.data.vertices)))


def shown_positions(obj, context):
    """Returns the coordinates as modifiers and shape keys show them, if they keep the vertices; else those of the mesh."""
    mesh = obj.evaluated_get(context.evaluated_depsgraph_get()).data
    if len(mesh.vertices) != len(obj.data.vertices):
        return base_positions(obj)
    return read(mesh.vertices, "co", floats(3 * len(mesh.vertices)))


def faces_of(mesh):
    """Returns the vertices of all corners, and the number of corners of each face."""
    return (read(mesh.loops, "vertex_index", integers(len(mesh.loops))),
            read(mesh.polygons, "loop_total", integers(len(mesh.polygons))))


def surface_of(obj, library_context, positions=None):
    """Returns the mesh of an object, without attributes, in the space of the object. The object is shown and has faces.

    Errors: those of lissom.Mesh.create for surfaces that are not manifold, naming the elements.
    """
    check_mesh(obj)
    corners, sizes = faces_of(obj.data)
    return lissom.Mesh.create(positions or base_positions(obj), corners, sizes, context=library_context)


def rows_of(matrix):
    """Returns the rows of an affine map as the library takes them."""
    return [list(row) for row in Matrix(matrix)[:3]]


def is_same_surface(mesh, result):
    """Returns whether a result has the vertices and faces of a mesh of Blender, in the same order."""
    if result.vertex_count != len(mesh.vertices) or result.corner_count != len(mesh.loops):
        return False
    corners, sizes = integers(len(mesh.loops)), integers(result.face_count)
    result.faces(out_corners=corners, out_sizes=sizes)
    return (corners, sizes) == faces_of(mesh)


def positions_of(result):
    """Returns the coordinates of a mesh of the library."""
    return result.positions(out=floats(3 * result.vertex_count))


def new_mesh(name, result):
    """Returns a new mesh of Blender with the vertices and faces of a result."""
    corners, sizes = integers(result.corner_count), integers(result.face_count)
    result.faces(out_corners=corners, out_sizes=sizes)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(result.vertex_count)
    mesh.vertices.foreach_set("co", positions_of(result))
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", _starts(sizes))
    mesh.polygons.foreach_set("loop_total", sizes)
    mesh.update(calc_edges=True)
    return mesh


def _starts(sizes):
    starts, place = integers(len(sizes)), 0
    for face, size in enumerate(sizes):
        starts[face] = place
        place += size
    return starts


def add_object(context, name, data, matrix=None, beside=None):
    """Adds an object, selects it alone and makes it active. It goes into the collections of the object `beside`."""
    obj = bpy.data.objects.new(name, data)
    collections = beside.users_collection if beside else ()
    for collection in collections or (context.collection,):
        collection.objects.link(obj)
    if matrix is not None:
        obj.matrix_world = matrix
    for other in context.selected_objects:
        other.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj
    return obj


def leave_edit_mode(context):
    """Ends the edit mode, so that the mesh has its changes. Returns the mode as it was."""
    mode = context.object.mode if context.object else "OBJECT"
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    return mode


def vertices_in_group(obj, name, threshold=0.5):
    """Returns the vertices of a vertex group whose weight is at least `threshold`."""
    group = obj.vertex_groups[name].index
    return [vertex.index for vertex in obj.data.vertices
            if any(entry.group == group and entry.weight >= threshold for entry in vertex.groups)]


def selected_vertices(obj):
    """Returns the selected vertices of a mesh."""
    flags = read(obj.data.vertices, "select", array.array("b", bytes(len(obj.data.vertices))))
    return [vertex for vertex, flag in enumerate(flags) if flag]
