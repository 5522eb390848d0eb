"""Layers of a surface: texture coordinates, colours, materials, weights, shape keys. They go to the library as attributes
of meshes, through a merge, and back."""
import bpy

from .meshes import floats, integers, read

_GROUP = "vertex_group."
_EDGE_FLAGS = ("use_seam", "use_edge_sharp", "crease", "bevel_weight")


class Layers:
    """The layers of several meshes, matched by their names: those of the first come first."""

    def __init__(self, objects):
        self.objects = list(objects)
        self.uvs = _names(obj.data.uv_layers for obj in self.objects)
        self.colors = _names(obj.data.color_attributes for obj in self.objects)
        self.groups = _names(obj.vertex_groups for obj in self.objects)
        self.keys = _names(_keys_of(obj) for obj in self.objects)
        self.materials = _names((slot.material for slot in obj.material_slots if slot.material) for obj in self.objects)

    def give(self, obj, mesh):
        """Writes the layers of an object to its mesh of the library."""
        self._give_uvs(obj, mesh)
        self._give_colors(obj, mesh)
        self._give_groups(obj, mesh)
        self._give_keys(obj, mesh)
        self._give_materials(obj, mesh)

    def take(self, obj, mesh):
        """Writes the layers of a result to an object of Blender that was made from it. The origins of the result number the
        objects in their order: the target of a merge, then its source."""
        self._take_uvs(obj, mesh)
        self._take_colors(obj, mesh)
        self._take_groups(obj, mesh)
        self._take_keys(obj, mesh)
        self._take_materials(obj, mesh)
        _take_smoothness(obj, mesh, self.objects)
        _take_edges(obj, mesh, self.objects)

    # ---- Texture coordinates

    def _give_uvs(self, obj, mesh):
        for layer in obj.data.uv_layers:
            values = read(layer.data, "uv", floats(2 * len(layer.data)))
            mesh.write_attribute(_numbered("uv", self.uvs.index(layer.name)), "corners", 2, values)

    def _take_uvs(self, obj, mesh):
        for number, name in enumerate(self.uvs):
            values = _values(mesh, _numbered("uv", number))
            if values:
                obj.data.uv_layers.new(name=name, do_init=False).data.foreach_set("uv", values)

    # ---- Colours: on corners, as one mesh may have them there and the other on vertices

    def _give_colors(self, obj, mesh):
        for layer in obj.data.color_attributes:
            values = read(layer.data, "color", floats(4 * len(layer.data)))
            if layer.domain == "POINT":
                values = _to_corners(values, obj.data)
            mesh.write_attribute(_numbered("color", self.colors.index(layer.name)), "corners", 4, values)

    def _take_colors(self, obj, mesh):
        kinds = {layer.name: layer.data_type for one in self.objects for layer in one.data.color_attributes}
        for number, name in enumerate(self.colors):
            values = _values(mesh, _numbered("color", number), missing=1.0)
            if values:
                obj.data.color_attributes.new(name, kinds[name], "CORNER").data.foreach_set("color", values)

    # ---- Weights: 0 is no weight

    def _give_groups(self, obj, mesh):
        for group in obj.vertex_groups:
            values = floats(len(obj.data.vertices))
            for vertex in obj.data.vertices:
                for entry in vertex.groups:
                    if entry.group == group.index:
                        values[vertex.index] = entry.weight
            mesh.write_attribute(_GROUP + group.name, "vertices", 1, values)

    def _take_groups(self, obj, mesh):
        for name in self.groups:
            group = obj.vertex_groups.new(name=name)
            for vertex, weight in enumerate(_values(mesh, _GROUP + name) or ()):
                if weight > 0:
                    group.add([vertex], min(weight, 1.0), "REPLACE")

    # ---- Shape keys: offsets from the Basis

    def _give_keys(self, obj, mesh):
        keys = _keys_of(obj)
        if not keys:
            return
        base = read(keys[0].data, "co", floats(3 * len(obj.data.vertices)))
        for key in keys[1:]:
            values = read(key.data, "co", floats(len(base)))
            for i, number in enumerate(base):
                values[i] -= number
            mesh.write_attribute(f"morph.{self.keys.index(key.name)}.position", "vertices", 3, values)

    def _take_keys(self, obj, mesh):
        if not self.keys:
            return
        obj.shape_key_add(name=self.keys[0], from_mix=False)
        base = read(obj.data.vertices, "co", floats(3 * len(obj.data.vertices)))
        for number, name in enumerate(self.keys[1:], 1):
            key = obj.shape_key_add(name=name, from_mix=False)
            offsets = _values(mesh, f"morph.{number}.position")
            if offsets:
                key.data.foreach_set("co", [a + b for a, b in zip(base, offsets)])
            key.value = next((one.value for other in self.objects for one in _keys_of(other) if one.name == name), 0.0)

    # ---- Materials

    def _give_materials(self, obj, mesh):
        if not self.materials:
            return
        slots = [self.materials.index(slot.material.name) if slot.material else -1 for slot in obj.material_slots]
        labels = read(obj.data.polygons, "material_index", integers(len(obj.data.polygons)))
        for face, slot in enumerate(labels):
            labels[face] = slots[slot] if slot < len(slots) else -1
        mesh.write_labels("material", self.materials, labels)

    def _take_materials(self, obj, mesh):
        for name in self.materials:
            obj.data.materials.append(bpy.data.materials[name])
        if not self.materials or not mesh.label_count("material"):
            return
        slots = [self.materials.index(mesh.label_name("material", i)) for i in range(mesh.label_count("material"))]
        labels = mesh.labels("material", out=integers(len(obj.data.polygons)))
        obj.data.polygons.foreach_set("material_index", [slots[label] if label >= 0 else 0 for label in labels])


def _names(lists):
    """Returns the names in lists, each once."""
    return list(dict.fromkeys(one.name for each in lists for one in each))


def _keys_of(obj):
    return list(obj.data.shape_keys.key_blocks) if obj.data.shape_keys else []


def _numbered(name, number):
    return name if number == 0 else f"{name}{number + 1}"


def _to_corners(values, mesh):
    corners = floats(4 * len(mesh.loops))
    for corner, vertex in enumerate(read(mesh.loops, "vertex_index", integers(len(mesh.loops)))):
        corners[4 * corner:4 * corner + 4] = values[4 * vertex:4 * vertex + 4]
    return corners


def _values(mesh, name, missing=0.0):
    """Returns an attribute of a result, with a number for those that are missing; None if it has none of this name."""
    names = {mesh.attribute_at(i).name for i in range(mesh.attribute_count)}
    if name not in names:
        return None
    about = mesh.attribute_named(name)
    values = mesh.attribute(name, out=floats(about.width * about.count))
    for i, value in enumerate(values):
        if value != value:
            values[i] = missing
    return values


def _origins(read_origins, count):
    inputs, elements = integers(count), integers(count)
    read_origins(out_inputs=inputs, out_elements=elements)
    return inputs, elements


def _take_smoothness(obj, mesh, inputs):
    """Faces are shaded as those they come from; new ones as most."""
    smooth = [read(one.data.polygons, "use_smooth", integers(len(one.data.polygons))) for one in inputs]
    is_most = 2 * sum(map(sum, smooth)) > sum(map(len, smooth))
    origins = zip(*_origins(mesh.face_origins, len(obj.data.polygons)))
    obj.data.polygons.foreach_set("use_smooth", [bool(smooth[i][face]) if i >= 0 else is_most for i, face in origins])
    for name in ("use_auto_smooth", "auto_smooth_angle"):
        if hasattr(obj.data, name):
            setattr(obj.data, name, getattr(inputs[0].data, name))


def _take_edges(obj, mesh, inputs):
    """Seams, sharp edges, creases and bevel weights go to the edges that are still there."""
    marked = [_marked_edges(one.data) for one in inputs]
    if not any(marked):
        return
    numbers, vertices = _origins(mesh.vertex_origins, len(obj.data.vertices))
    for edge in obj.data.edges:
        a, b = edge.vertices
        if numbers[a] == numbers[b] >= 0:
            flags = marked[numbers[a]].get(frozenset((vertices[a], vertices[b])), {})
            for name, value in flags.items():
                setattr(edge, name, value)


def _marked_edges(mesh):
    marked = {}
    for edge in mesh.edges:
        flags = {name: getattr(edge, name) for name in _EDGE_FLAGS if getattr(edge, name, None)}
        if flags:
            marked[frozenset(edge.vertices)] = flags
    return marked
