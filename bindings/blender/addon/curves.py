"""Strands as Curves objects of Blender, and curves drawn by hand as lists of points."""
import array

import bpy
from mathutils import Vector

from .meshes import add_object, floats, integers, read

MATERIAL = "Lissom Hair"
_NODES = "Lissom Mesh to Curves"


def new_curves(context, name, strands, unit, matrix):
    """Adds a Curves object with these strands, selects it and makes it active. Points are divided by `unit`, the metres in
    one unit of the head's mesh, so that they lie in the space of the head, whose matrix is given."""
    mesh = _mesh_of_edges(name, strands, unit)
    obj = add_object(context, name, mesh, matrix)
    # Blender 3.4 has no other way from Python to a Curves object with curves.
    group = _node_group()
    obj.modifiers.new("Curves", "NODES").node_group = group
    bpy.ops.object.convert(target="CURVES")
    bpy.data.node_groups.remove(group)
    # The conversion leaves the mesh behind with a user that is none.
    mesh.user_clear()
    bpy.data.meshes.remove(mesh)
    obj = context.view_layer.objects.active
    for attribute in [one for one in obj.data.attributes if one.name.startswith(".select")]:
        obj.data.attributes.remove(attribute)
    return obj


def _mesh_of_edges(name, strands, unit):
    """A mesh with an edge for each segment of a strand, and the radius at its vertices."""
    count, offsets = strands.point_count, strands.offsets(out=integers(strands.size + 1))
    points = _scaled(strands.points(out=floats(3 * count)), 1 / unit)
    radii = _scaled(strands.read_at_points("width", out=floats(count)), 0.5 / unit)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(count)
    mesh.vertices.foreach_set("co", points)
    edges = _edges(offsets)
    mesh.edges.add(len(edges) // 2)
    mesh.edges.foreach_set("vertices", edges)
    mesh.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", radii)
    mesh.update()
    return mesh


def _scaled(values, factor):
    return array.array("f", [factor * value for value in values])


def _edges(offsets):
    """The pairs of vertices of all segments."""
    ends = set(offsets)
    first = [point for point in range(offsets[-1]) if point + 1 not in ends]
    edges = integers(2 * len(first))
    edges[0::2] = array.array("i", first)
    edges[1::2] = array.array("i", [point + 1 for point in first])
    return edges


def _node_group():
    group = bpy.data.node_groups.new(_NODES, "GeometryNodeTree")
    if hasattr(group, "interface"):
        for way in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    convert = group.nodes.new("GeometryNodeMeshToCurve")
    group.links.new(start.outputs[0], convert.inputs[0])
    group.links.new(convert.outputs[0], end.inputs[0])
    return group


def put_on_surface(obj, head, uvs):
    """Ties a Curves object to its head: `uvs` are the texture coordinates of the roots, or None."""
    obj.data.surface = head
    if uvs is None or not head.data.uv_layers:
        return
    obj.data.surface_uv_map = head.data.uv_layers.active.name
    obj.data.attributes.new("surface_uv_coordinate", "FLOAT2", "CURVE").data.foreach_set("vector", uvs)


def set_material(obj, color):
    """Gives hair a material of its own with this colour, linear red, green and blue: for Cycles that of hair, which EEVEE
    draws black, for EEVEE a plain one."""
    material = bpy.data.materials.new(MATERIAL)
    material.diffuse_color = (*color, 1)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    for target, shader, place in (("CYCLES", "ShaderNodeBsdfHairPrincipled", 0), ("EEVEE", "ShaderNodeBsdfPrincipled", -400)):
        node, output = nodes.new(shader), nodes.new("ShaderNodeOutputMaterial")
        node.location, output.location, output.target = (0, place), (400, place), target
        node.inputs[0].default_value = (*color, 1)
        links.new(node.outputs[0], output.inputs[0])
    obj.data.materials.append(material)


# ---- Curves drawn by hand

def drawn_curves(obj, context, into):
    """Returns the lines of a curve object, lists of points (flat arrays) in the space that the matrix `into` leads to from
    the world."""
    matrix = into @ obj.matrix_world
    lines = _lines_of_hair(obj.data) if obj.type == "CURVES" else _lines_of_curve(obj, context)
    return [_moved(line, matrix) for line in lines if len(line) >= 6]


def _lines_of_hair(data):
    points = read(data.points, "position", floats(3 * len(data.points)))
    return [points[3 * one.first_point_index:3 * (one.first_point_index + one.points_length)] for one in data.curves]


def _lines_of_curve(obj, context):
    """The lines of a curve as it is drawn, without its thickness."""
    data = obj.data.copy()
    data.bevel_depth = data.extrude = 0
    data.bevel_mode, data.bevel_object = "ROUND", None
    plain = bpy.data.objects.new(obj.name, data)
    try:
        mesh = plain.to_mesh(preserve_all_data_layers=False, depsgraph=context.evaluated_depsgraph_get())
        points = read(mesh.vertices, "co", floats(3 * len(mesh.vertices)))
        return _chains(points, {tuple(sorted(edge.vertices)) for edge in mesh.edges})
    finally:
        bpy.data.objects.remove(plain)
        bpy.data.curves.remove(data)


def _chains(points, edges):
    """Cuts points where no edge leads to the next."""
    count, lines, start = len(points) // 3, [], 0
    for point in range(count):
        if (point, point + 1) not in edges:
            lines.append(points[3 * start:3 * (point + 1)])
            start = point + 1
    return lines


def _moved(line, matrix):
    moved = array.array("f")
    for i in range(0, len(line), 3):
        moved.extend(matrix @ _vector(line, i))
    return moved


def _vector(line, i):
    return Vector(line[i:i + 3])


def begin_at(line, obj):
    """Turns a line so that it begins at the end that is nearer to the surface of an object, in whose space it is."""
    distance = [(obj.closest_point_on_mesh(end)[1] - end).length for end in (_vector(line, 0), _vector(line, len(line) - 3))]
    if distance[0] <= distance[1]:
        return line
    turned = array.array("f")
    for i in range(len(line) - 3, -1, -3):
        turned.extend(line[i:i + 3])
    return turned
