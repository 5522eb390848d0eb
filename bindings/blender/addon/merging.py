"""Merge and paste: operators on two meshes, by the selection on them."""
import array
import math

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty

from .layers import Layers
from .meshes import add_object, leave_edit_mode, new_mesh, positions_of, rows_of, selected_vertices, surface_of
from .native import lissom, new_context
from .problems import Problem, check_mesh, notes_of
from .work import Work


def source_and_target(context):
    """Returns the other selected mesh, and the active one, which it goes onto."""
    target = context.object
    check_mesh(target)
    sources = [obj for obj in context.selected_objects if obj != target and obj.type == "MESH"]
    if len(sources) != 1:
        raise Problem("select two meshes: the part first, then, as the active object, the one that it goes onto")
    check_mesh(sources[0], "the part")
    return sources[0], target


def boundaries_of(mesh):
    """Returns the open boundaries of a mesh of the library, each a list of vertices in order."""
    return [list(mesh.boundary(number)) for number in range(mesh.boundary_count)]


def chosen_boundaries(obj, boundaries):
    """Returns the numbers of boundaries that selected vertices lie on, each with the selected ones in order. A selection
    that touches none is a Problem; without a selection, or if all is selected, no boundary is chosen."""
    selected = set(selected_vertices(obj))
    if len(selected) == len(obj.data.vertices):
        return {}
    found = {}
    for number, loop in enumerate(boundaries):
        on = [vertex for vertex in loop if vertex in selected]
        if on:
            found[number] = on
    if selected and not found:
        raise Problem(f"the selection of '{obj.name}' lies on no open boundary: select the loop of a hole, or delete the "
                      "faces on one side of the loop")
    return found


def _center(points):
    return [sum(point[k] for point in points) / len(points) for k in range(3)]


def _distance(a, b):
    return math.dist(a, b)


class _Side:
    """One of both meshes of a merge: its object, its mesh in the space of the target, and the selection on it."""

    def __init__(self, obj, mesh):
        self.obj, self.mesh = obj, mesh
        flat = positions_of(mesh)
        self.positions = [tuple(flat[i:i + 3]) for i in range(0, len(flat), 3)]
        self.boundaries = boundaries_of(mesh)
        if not self.boundaries:
            raise Problem(f"'{obj.name}' is closed and has no boundary to merge at: delete the faces where the other shall "
                          "join, or use Paste")
        self.chosen = chosen_boundaries(obj, self.boundaries)

    def center(self, number):
        return _center([self.positions[vertex] for vertex in self.boundaries[number]])

    def keys(self, number):
        """Points that are selected one by one; none if the whole loop is."""
        chosen = self.chosen.get(number, [])
        return [self.positions[vertex] for vertex in chosen] if len(chosen) < len(self.boundaries[number]) else []


def _paired(source, target):
    """Pairs of boundaries, nearest first."""
    a, b = source.chosen or range(len(source.boundaries)), target.chosen or range(len(target.boundaries))
    near = sorted((_distance(source.center(i), target.center(j)), i, j) for i in a for j in b)
    pairs, used = [], set()
    for _, i, j in near:
        if ("source", i) not in used and ("target", j) not in used:
            used |= {("source", i), ("target", j)}
            pairs.append((i, j))
    return pairs[:max(len(source.chosen), len(target.chosen))]


def matched_keys(source, target):
    """Orders the points of both sides so that they meet: the turn around the loop, either way, whose pairs lie closest."""
    if len(source) != len(target):
        raise Problem(f"{len(source)} vertices are selected on one boundary and {len(target)} on the other: select as many, "
                      "which then meet, or the whole loops")
    ways = [turned[i:] + turned[:i] for turned in (target, target[::-1]) for i in range(len(target))]
    return source, min(ways, key=lambda way: sum(map(_distance, source, way)))


def joins_of(source, target):
    """Returns the joins of the selected boundaries; none without a selection: the nearest boundaries then meet."""
    if not source.chosen and not target.chosen:
        return []
    joins = []
    for i, j in _paired(source, target):
        keys = (source.keys(i), target.keys(j))
        source_keys, target_keys = matched_keys(*keys) if all(keys) else ((), ())
        joins.append(lissom.Join(i, 0, j, source_keys, target_keys))
    return joins


def _told(report):
    return [line for line in (report.verdict + "\n" + report.warnings).splitlines() if line]


class _OnTwoMeshes(Work):
    """Part of an operator that makes one mesh of two."""
    hide: BoolProperty(name="Hide Originals", default=True, description="Hide both meshes; they are kept as they are")

    @classmethod
    def poll(cls, context):
        """Whether a mesh is active."""
        return context.object is not None and context.object.type == "MESH"

    def sides(self, source, target, library):
        """Returns the meshes of both objects with their layers, in the space of the target, and these layers."""
        layers = Layers((target, source))
        self.subject = source
        part = surface_of(source, library)
        layers.give(source, part)
        part.transform(rows_of(target.matrix_world.inverted() @ source.matrix_world))
        self.subject = target
        body = surface_of(target, library)
        layers.give(target, body)
        return part, body, layers

    def put(self, context, mesh, report, layers):
        """Adds the result as an object in the place of the target, and tells the report."""
        target, source = layers.objects
        data = new_mesh(f"{target.name} merged", mesh)
        obj = add_object(context, data.name, data, target.matrix_world, target)
        layers.take(obj, mesh)
        for one in layers.objects if self.hide else ():
            one.hide_set(True)
        self.tell("INFO" if report.ok else "WARNING", _told(report) + notes_of(source) + notes_of(target))


class LISSOM_OT_merge(_OnTwoMeshes, bpy.types.Operator):
    """Merges the selected mesh onto the active one at open boundaries, without a seam. Selected loops are those that meet,
    else the nearest; as many selected vertices on both loops meet each other"""
    bl_idname, bl_label, bl_options = "lissom.merge", "Merge", {"REGISTER", "UNDO"}

    in_place: BoolProperty(name="Bend in Place", default=False,
                           description="Keep the part where it is and bend its end, instead of moving it to the boundary")
    smooth: IntProperty(name="Smooth", default=3, min=0, max=20, description="Umbrella steps at the seam, at most")
    transition: BoolProperty(name="Transition", default=False, description="Let details of both sides fade into each other")

    def steps(self, context):
        leave_edit_mode(context)
        source, target = source_and_target(context)
        with new_context() as library:
            part, body, layers = self.sides(source, target, library)
            joins = joins_of(_Side(source, part), _Side(target, body))
            mesh, report = yield part.begin_merge(body, joins, fixed_configuration=self.in_place, smooth=self.smooth,
                                                  transition=self.transition)
            self.put(context, mesh, report, layers)


class LISSOM_OT_paste(_OnTwoMeshes, bpy.types.Operator):
    """Pastes the selected faces of the other mesh onto the active one: at its selected vertices, else at the 3D cursor"""
    bl_idname, bl_label, bl_options = "lissom.paste", "Paste Feature", {"REGISTER", "UNDO"}

    scale: FloatProperty(name="Scale", default=1, min=1e-3, soft_max=10, description="Size of the feature on the target")
    fit: BoolProperty(name="Best Angle", default=True, description="Turn the feature about the normal as it fits best")
    angle: FloatProperty(name="Angle", default=0, subtype="ANGLE", description="Turn about the normal of the surface")
    iterations: IntProperty(name="Optimize", default=20, min=0, max=100,
                            description="Steps of the search for the boundary of least distortion")

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        for name in ("scale", "fit") + (() if self.fit else ("angle",)) + ("iterations", "hide"):
            layout.prop(self, name)

    def steps(self, context):
        leave_edit_mode(context)
        source, target = source_and_target(context)
        chosen = selected_vertices(source)
        if not chosen or len(chosen) == len(source.data.vertices):
            raise Problem(f"select the feature on '{source.name}' with some of the surface around it, in edit mode")
        with new_context() as library:
            part, body, layers = self.sides(source, target, library)
            region = lissom.Region.of_vertices(part, array.array("i", chosen))
            paste = yield lissom.Paste.begin_create(part, body, region, **self.placement(context, target))
            if self.iterations:
                yield paste.begin_optimize(self.iterations)
            mesh, report = yield paste.begin_merge()
            self.put(context, mesh, report, layers)

    def placement(self, context, target):
        """Returns where the feature goes."""
        chosen = selected_vertices(target)
        points = [target.data.vertices[vertex].co for vertex in chosen if len(chosen) < len(target.data.vertices)]
        place = _center(points) if points else target.matrix_world.inverted() @ context.scene.cursor.location
        return {"at": list(place), "scale": self.scale, "angle": math.nan if self.fit else self.angle}


CLASSES = (LISSOM_OT_merge, LISSOM_OT_paste)
