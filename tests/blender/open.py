"""Opens mesh files in Blender and compares what it finds with what `lissom inspect` says.

blender --background --factory-startup --python-exit-code 1 --python open.py -- INSPECTED.json

INSPECTED.json is the output of `lissom inspect --json FILE...`; its files are opened. Compared are the
numbers of vertices, faces, corners and texture coordinates, and the bounds. In files called shape_* the
texture coordinates are (x, y) of their vertices, or (x + 2, y).
"""
import json
import os
import sys

import bpy
import numpy
from mathutils import Vector

# The glTF importer of Blender 3.4 uses a name that the numpy beside it no longer has.
if "bool" not in numpy.__dict__:
    numpy.bool = bool


def fresh_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def open_file(path):
    """The mesh objects of the file."""
    fresh_scene()
    if path.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=path, merge_vertices=True)
    else:
        bpy.ops.wm.obj_import(filepath=path)
    return [o for o in bpy.context.scene.objects if o.type == "MESH"]


def in_file_axes(v):
    """Blender turns what comes with y up so that z is up."""
    return Vector((v.x, v.z, -v.y))


def expected(mesh, triangulated):
    """Counts by what `lissom inspect` says; Blender reads only triangles from glTF."""
    border = sum(loop["vertices"] for loop in mesh["boundaries"])
    corners = 2 * mesh["edges"] - border
    triangles = corners - 2 * mesh["faces"]
    uvs = sum(a["name"].startswith("uv") for a in mesh["attributes"])
    return {
        "vertices": mesh["vertices"],
        "faces": triangles if triangulated else mesh["faces"],
        "corners": 3 * triangles if triangulated else corners,
        "uv layers": uvs,
    }


def found(objects):
    meshes = [o.data for o in objects]
    return {
        "vertices": sum(len(m.vertices) for m in meshes),
        "faces": sum(len(m.polygons) for m in meshes),
        "corners": sum(len(m.loops) for m in meshes),
        "uv layers": max((len(m.uv_layers) for m in meshes), default=0),
    }


def positions(o):
    return [in_file_axes(o.matrix_world @ v.co) for v in o.data.vertices]


def problem_of_bounds(objects, bounds):
    points = [p for o in objects for p in positions(o)]
    for axis in range(3):
        have = [f(p[axis] for p in points) for f in (min, max)]
        want = [bounds["min"][axis], bounds["max"][axis]]
        if any(abs(h - w) > 1e-5 * bounds["diagonal"] for h, w in zip(have, want)):
            return f"along axis {axis} from {have[0]} to {have[1]}, not from {want[0]} to {want[1]}"
    return None


def problem_of_uvs(objects):
    shifted = 0
    total = 0
    for o in objects:
        at = positions(o)
        uvs = o.data.uv_layers[0].data
        for loop in o.data.loops:
            p, uv = at[loop.vertex_index], uvs[loop.index].uv
            if abs(uv.y - p.y) > 1e-4 or min(abs(uv.x - p.x), abs(uv.x - p.x - 2)) > 1e-4:
                return f"texture coordinates {tuple(uv)} at {tuple(p)}"
            shifted += abs(uv.x - p.x - 2) < 1e-4
            total += 1
    return None if 0 < shifted < total else "no seams in the texture coordinates"


def problems(mesh):
    path = mesh["file"]
    if "error" in mesh:
        return [mesh["error"]["message"]]
    objects = open_file(path)
    want, have = expected(mesh, path.endswith(".glb")), found(objects)
    result = [f"{have[k]} {k} instead of {want[k]}" for k in want if have[k] != want[k]]
    if not result:
        result.append(problem_of_bounds(objects, mesh["bounds"]))
        if os.path.basename(path).startswith("shape_"):
            result.append(problem_of_uvs(objects))
    return [p for p in result if p]


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        meshes = json.load(file)["meshes"]
    failed = 0
    for mesh in meshes:
        wrong = problems(mesh)
        failed += bool(wrong)
        print(f"{'FAILED' if wrong else 'ok'}: {mesh['file']}: {mesh.get('vertices')} vertices")
        for problem in wrong:
            print(f"    {problem}")
    print(f"{len(meshes) - failed} passed, {failed} failed")
    sys.stdout.flush()
    if failed or not meshes:
        sys.exit(1)


main()
