"""Uses the add-on in Blender's window as a hand does: simulated events move the mouse and press keys.

blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 --python window_test.py -- FOLDER PICTURES

FOLDER has the add-on unpacked. PICTURES is a folder for screenshots, or "".
"""
import math
import os
import sys
import time
import traceback

import bpy

FOLDER, PICTURES = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, FOLDER)

bpy.context.preferences.view.show_splash = False

import lissom_blender  # noqa: E402
from lissom_blender import handles, meshes, native  # noqa: E402


def view():
    """The 3D view, its window, area and main region."""
    window = bpy.context.window_manager.windows[0]
    area = max((area for area in window.screen.areas if area.type == "VIEW_3D"), key=lambda one: one.width)
    region = next(region for region in area.regions if region.type == "WINDOW")
    return {"window": window, "screen": window.screen, "area": area, "region": region}


def middle():
    """A place of the window that lies on the 3D view."""
    region = view()["region"]
    return region.x + region.width // 3, region.y + region.height // 3


def press(kind, place=None, **options):
    """Presses and lets go of a key or button over a place, that of `middle` by default."""
    x, y = place or middle()
    view()["window"].event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    for value in ("PRESS", "RELEASE"):
        view()["window"].event_simulate(type=kind, value=value, x=x, y=y, **(options if value == "PRESS" else {}))


def start(operator, **options):
    """Starts an operator as its button does."""
    with bpy.context.temp_override(**view()):
        return operator("INVOKE_DEFAULT", **options)


def picture(name):
    """Keeps a screenshot."""
    if PICTURES:
        bpy.ops.screen.screenshot(filepath=os.path.join(PICTURES, name + ".png"))


def activate(*objects):
    for one in bpy.context.view_layer.objects:
        one.select_set(False)
    for one in objects:
        one.select_set(True)
    bpy.context.view_layer.objects.active = objects[-1]


def fresh():
    """Removes all objects."""
    for one in list(bpy.data.objects):
        bpy.data.objects.remove(one)


def cactus(count):
    """A cactus with a pin below and a handle on top; returns it and its empty."""
    fresh()
    with native.new_context() as library:
        data = meshes.new_mesh("Cactus", library.call("shapes.cactus", vertices=count))
    obj = meshes.add_object(bpy.context, "Cactus", data)
    obj.data.polygons.foreach_set("use_smooth", [True] * len(data.polygons))
    high = max(vertex.co.z for vertex in data.vertices)
    for kind, is_chosen in (("PIN", lambda z: z < 0.08 * high), ("MOVE", lambda z: z > 0.92 * high)):
        data.polygons.foreach_set("select", [False] * len(data.polygons))
        data.edges.foreach_set("select", [False] * len(data.edges))
        data.vertices.foreach_set("select", [is_chosen(vertex.co.z) for vertex in data.vertices])
        activate(obj)
        bpy.ops.lissom.add_handle(kind=kind)
    return obj, handles.empties_of(obj)[0]


def frame_all():
    with bpy.context.temp_override(**view()):
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_orbit(angle=0.5, type="ORBITLEFT")
        bpy.ops.view3d.view_all()



# ---- What the hand does: each step yields the seconds until the next.

def prepare():
    """Opens the sidebar and clicks on the tab of the add-on, the fourth: scripts cannot choose one in Blender 3.4."""
    lissom_blender.register()
    press("ESC")
    view()["area"].spaces.active.show_region_ui = True
    yield 1.0
    bar = next(region for region in view()["area"].regions if region.type == "UI")
    press("LEFTMOUSE", (bar.x + bar.width - 15, bar.y + bar.height - 165))
    yield 1.0


def drag_and_keep():
    """Return keeps what the empty has done."""
    obj, empty = cactus(6000)
    frame_all()
    before = list(meshes.base_positions(obj))
    activate(obj)
    yield 0.5
    picture("panel")
    assert start(bpy.ops.lissom.deform) == {"RUNNING_MODAL"}
    yield 1.5
    activate(empty)
    yield 0.2
    for key in ("R", "Y"):
        press(key)
        yield 0.1
    for key, text in (("FIVE", "5"), ("ZERO", "0")):
        press(key, unicode=text)
        yield 0.1
    press("RET")
    yield 1.0
    assert abs(empty.matrix_world.to_euler().y - math.radians(50)) < 0.2, empty.matrix_world.to_euler()
    picture("bent")
    moved = [key.co for key in obj.data.shape_keys.key_blocks["Lissom"].data]
    assert max((co - vertex.co).length for co, vertex in zip(moved, obj.data.vertices)) > 0.1
    press("RET")
    yield 0.5
    empty.location.x += 1
    yield 0.5
    after = [key.co for key in obj.data.shape_keys.key_blocks["Lissom"].data]
    assert after == moved, "Return has not ended the deformation"
    assert list(meshes.base_positions(obj)) == before, "the Basis has moved"


def drag_and_take_back():
    """Esc leaves the mesh as it was."""
    obj, empty = cactus(3000)
    activate(obj)
    yield 0.3
    start(bpy.ops.lissom.deform)
    yield 1.0
    empty.location.x += 0.5
    yield 0.5
    assert obj.data.shape_keys is not None
    press("ESC")
    yield 0.5
    assert obj.data.shape_keys is None, "Esc has left a shape key"


def stop_a_long_job():
    """Esc stops hair that would take long; nothing is added."""
    fresh()
    with native.new_context() as library:
        data = meshes.new_mesh("Head", library.call("shapes.head", vertices=20000))
    obj = meshes.add_object(bpy.context, "Head", data)
    activate(obj)
    yield 0.3
    assert start(bpy.ops.lissom.hair_waves, p_count=2000000) == {"RUNNING_MODAL"}
    yield 1.0
    picture("progress")
    begin = time.perf_counter()
    press("ESC")
    yield 2.0
    assert [one.name for one in bpy.data.objects] == ["Head"], list(bpy.data.objects)
    assert time.perf_counter() - begin < 10


def groom_and_redo():
    """A preset of hair grows beside the window, and the redo panel has its sliders."""
    obj = bpy.data.objects["Head"]
    activate(obj)
    assert start(bpy.ops.lissom.hair_bob, p_count=2000) == {"RUNNING_MODAL"}
    for _ in range(40):
        yield 0.5
        if bpy.context.view_layer.objects.active.type == "CURVES":
            break
    curves = bpy.context.view_layer.objects.active
    assert curves.type == "CURVES" and curves.data.surface == obj
    frame_all()
    yield 1.0
    picture("hair")


STEPS = (prepare, drag_and_keep, drag_and_take_back, stop_a_long_job, groom_and_redo)


def all_steps():
    for step in STEPS:
        yield from step()
        print(f"{step.__name__}: passed", flush=True)


def follow(steps):
    """Runs the steps by a timer, and ends Blender."""
    def again():
        try:
            return next(steps)
        except StopIteration:
            status = 0
        except BaseException:  # pylint: disable=broad-except
            traceback.print_exc()
            picture("failed")
            status = 1
        sys.stdout.flush()
        os._exit(status)
    return again


bpy.app.timers.register(follow(all_steps()), first_interval=1.0)
