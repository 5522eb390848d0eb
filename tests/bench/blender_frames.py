"""Times frames of a deformation inside Blender, and those of the library alone, in turns. Prints a line for each row: what is
measured, then the median and the quartiles of the ratio, and the median of either in milliseconds.

blender --background --factory-startup --python blender_frames.py -- FOLDER
"""
import math
import statistics
import sys
import time

import bpy
from mathutils import Matrix

sys.path.insert(0, sys.argv[-1])

import lissom_blender  # noqa: E402
from lissom_blender import deform, handles, meshes, native  # noqa: E402

REPEATS = 15


def cactus(count):
    """A cactus of about so many vertices with a pin below and a handle on top."""
    with native.new_context() as library:
        data = meshes.new_mesh("Cactus", library.call("shapes.cactus", vertices=count))
    obj = meshes.add_object(bpy.context, "Cactus", data)
    heights = [vertex.co.z for vertex in data.vertices]
    low, high = min(heights), max(heights)
    ends = {"PIN": lambda z: z < low + 0.05 * (high - low), "MOVE": lambda z: z > high - 0.05 * (high - low)}
    for kind, is_chosen in ends.items():
        data.polygons.foreach_set("select", [False] * len(data.polygons))
        data.edges.foreach_set("select", [False] * len(data.edges))
        data.vertices.foreach_set("select", [is_chosen(z) for z in heights])
        bpy.context.view_layer.objects.active = obj
        bpy.ops.lissom.add_handle(kind=kind)
    return obj


def turn(empty, start, step):
    empty.matrix_world = start @ Matrix.Rotation(0.5 + 0.3 * math.sin(step), 4, "X")
    bpy.context.view_layer.update()


def show(drag, obj, quality):
    """A whole frame: the empties are read, the surface is solved and written, and Blender makes its normals."""
    drag.moved()
    drag.show(quality)
    bpy.context.view_layer.update()
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return evaluated.vertex_normals[0].vector[0]


def milliseconds(action, *arguments):
    start = time.perf_counter()
    action(*arguments)
    return 1e3 * (time.perf_counter() - start)


def frames(drag, obj, quality):
    """Times of whole frames and of the library's own, in turns."""
    empty = bpy.data.objects[drag.handles[0][1]]
    start, whole, own = empty.matrix_world.copy(), [], []
    for step in range(REPEATS):
        turn(empty, start, 2 * step)
        whole.append(milliseconds(show, drag, obj, quality))
        turn(empty, start, 2 * step + 1)
        drag.moved()
        own.append(milliseconds(drag.deformer.solve, quality))
    empty.matrix_world = start
    return whole, own


class Options:
    """Those of the operator."""
    into, region, refine, scale_details, free_rings, loose = "KEY", "", 0, False, 0, "FOLLOW"


def main():
    lissom_blender.register()
    for count in (14000, 43000):
        obj = cactus(count)
        drag = deform.Drag(obj, Options)
        drag.deformer.prepare()
        for quality in ("preview", "draft", "full"):
            frames(drag, obj, quality)
            whole, own = frames(drag, obj, quality)
            low, middle, high = statistics.quantiles([a / b for a, b in zip(whole, own)], n=4)
            print(f"ROW {len(obj.data.vertices)} {quality} {middle} {low} {high} "
                  f"{statistics.median(whole)} {statistics.median(own)}")
        drag.close()


main()
