"""Problems that operators refuse, remedies for errors of the library, and the selection of the elements concerned."""


class Problem(Exception):
    """Something that the user can mend; its text names the fault and the remedy."""


def check_editable(obj):
    """Raises a Problem if the data of an object cannot be changed."""
    if obj.library or obj.data.library:
        raise Problem(f"'{obj.name}' is linked from another file: make it local first (Object > Relations > Make Local)")
    if obj.override_library or obj.data.override_library:
        raise Problem(f"'{obj.name}' is a library override: make it local first (Object > Relations > Make Local)")


def check_mesh(obj, role="the active object"):
    """Raises a Problem if an object is not a mesh that is seen, has faces, and a size."""
    if obj is None or obj.type != "MESH":
        raise Problem(f"{role} must be a mesh: select one")
    if not obj.visible_get():
        raise Problem(f"'{obj.name}' is hidden: show it first (Alt H, or the eye in the Outliner)")
    if not obj.data.polygons:
        raise Problem(f"'{obj.name}' has no faces: add some, or select another object")
    if abs(obj.matrix_world.to_3x3().determinant()) < 1e-18:
        raise Problem(f"'{obj.name}' is scaled by zero: reset its scale (Alt S), or type another in the sidebar")


def notes_of(obj):
    """Returns sentences on modifiers, which operators ignore, and on other users of the mesh."""
    notes = []
    names = [modifier.name for modifier in obj.modifiers if modifier.show_viewport]
    if names:
        notes.append(f"'{obj.name}' is taken without its modifiers ({', '.join(names)}); apply them first to work on "
                     "their result")
    if obj.data.users > 1:
        notes.append(f"the mesh of '{obj.name}' has {obj.data.users} users, which change together; Object > Relations > "
                     "Make Single User parts them")
    return notes


_REMEDIES = {
    "nonmanifold_edge": "the edges are selected: delete the faces that are too many, or Mesh > Split them",
    "nonmanifold_vertex": "the vertices are selected: Mesh > Split > Selection parts the surfaces that touch there",
    "inconsistent_orientation": "Mesh > Normals > Recalculate Outside turns faces to agree",
    "duplicate_face": "Mesh > Merge > By Distance and Mesh > Clean Up > Delete Loose remove doubles",
    "zero_area": "Mesh > Clean Up > Degenerate Dissolve removes faces without area",
    "handle_overlap": "the vertices are selected: take them out of one of the vertex groups",
}


def text_of(error):
    """Returns the text of an error of the library with its remedy in Blender."""
    remedy = _REMEDIES.get(error.code)
    return f"{error.message} ({remedy})" if remedy else error.message


def select_elements(obj, error):
    """Selects the elements of a mesh that an error of the library names, and nothing else of it."""
    mesh = obj.data
    count = {"vertex": len(mesh.vertices), "edge": len(mesh.vertices), "face": len(mesh.polygons)}.get(error.element)
    ids = [number for number in error.ids if count and 0 <= number < count]
    if not ids:
        return
    for elements in (mesh.polygons, mesh.edges, mesh.vertices):
        elements.foreach_set("select", [False] * len(elements))
    if error.element == "face":
        _select_faces(mesh, ids)
    else:
        for vertex in ids:
            mesh.vertices[vertex].select = True
    if error.element == "edge":
        pairs = {frozenset(ids[i:i + 2]) for i in range(0, len(ids) - 1, 2)}
        for edge in mesh.edges:
            edge.select = frozenset(edge.vertices) in pairs


def _select_faces(mesh, ids):
    for number in ids:
        face = mesh.polygons[number]
        face.select = True
        for vertex in face.vertices:
            mesh.vertices[vertex].select = True
