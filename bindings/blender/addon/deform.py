"""Deformation by handles: live while empties are moved, into a shape key or the mesh."""
import array
import re
import time

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from . import native
from .handles import empties_of, group_vertices, pinned_groups, set_rest, transform_of
from .meshes import floats, leave_edit_mode, read, surface_of
from .native import lissom, new_context
from .problems import Problem, check_editable, notes_of, select_elements, text_of

KEY = "Lissom"
# Seconds without a move after which a frame is solved in full.
_PAUSE = 0.15


class Drag:
    """The deformer of an object, its handles, and the place in the object that its result goes to."""

    def __init__(self, obj, options):
        self.name = obj.name
        self.context = new_context()
        self.buffer = floats(3 * len(obj.data.vertices))
        self.transforms = None
        try:
            self._prepare(obj, options)
            self.target = _Target(obj, options.into)
        except BaseException:
            self.context.close()
            raise

    def _prepare(self, obj, options):
        self.mesh = surface_of(obj, self.context)
        self.is_whole = not options.region
        region = None if self.is_whole else self._region(group_vertices(obj, options.region))
        self.deformer = lissom.Deformer.create(self.mesh, region, refine=options.refine, scale_details=options.scale_details,
                                               loose=options.loose.lower(), free_rings=options.free_rings)
        self._groups = []
        for name in pinned_groups(obj):
            self._add(obj, name, self.deformer.pin)
        self.handles = [(self._add(obj, empty.lissom_handle.group, self.deformer.add_handle), empty.name)
                        for empty in empties_of(obj)]
        if not self.handles:
            raise Problem(f"'{obj.name}' has no handle: select vertices in edit mode, and Add Handle")

    def _region(self, vertices):
        return lissom.Region.of_vertices(self.mesh, array.array("i", vertices))

    def _add(self, obj, group, add):
        """Adds a handle or a pin; an error names the vertex groups, where the library has numbers of handles."""
        self._groups.append(group)
        region = self._region(group_vertices(obj, group))
        try:
            return add(region)
        except lissom.Error as error:
            text = re.sub(r"handle (\d+)\b", lambda match: f"'{self._groups[int(match[1]) - 1]}'", error.message)
            raise lissom.Error(error.code, text, error.element, error.ids, error.count) from None

    def moved(self):
        """Reads the empties; returns whether one has moved since the last call."""
        obj = bpy.data.objects[self.name]
        now = [transform_of(bpy.data.objects[name], obj) for _, name in self.handles]
        if now == self.transforms:
            return False
        self.transforms = now
        for (handle, _), transform in zip(self.handles, now):
            self.deformer.set_transform(handle, transform)
        return True

    def show(self, quality):
        """Solves for the handles as `moved` has read them, and writes the result into the object."""
        self.deformer.solve(quality)
        if self.is_whole:
            self.deformer.positions(out=self.buffer)
        else:
            self.deformer.apply(self.mesh)
            self.mesh.positions(out=self.buffer)
        self.target.write(bpy.data.objects[self.name], self.buffer)

    def restore(self):
        """Puts the object and its handles back as they were."""
        obj = bpy.data.objects.get(self.name)
        if obj:
            self.target.restore(obj)

    def keep(self):
        """Ends with the result in place. In a mesh without a shape key it is the new rest shape."""
        obj = bpy.data.objects[self.name]
        if self.target.into == "MESH":
            for _, name in self.handles:
                set_rest(bpy.data.objects[name], obj)

    def warnings(self):
        """Returns the faults of the last result, a line each with a remedy."""
        return self.deformer.report(self.mesh, False).warnings.splitlines()

    def close(self):
        """Frees the deformer."""
        self.context.close()


class _Target:
    """Where positions go: a shape key, which is added if it is missing, or the mesh."""

    def __init__(self, obj, into):
        self.into = into
        keys = obj.data.shape_keys
        if into == "MESH" and keys:
            raise Problem(f"'{obj.name}' has shape keys: deform into a shape key, which keeps the others and the Basis")
        self.had_basis = keys is not None
        self.had_key = self.had_basis and KEY in keys.key_blocks
        if into == "KEY" and not self.had_key:
            if not self.had_basis:
                obj.shape_key_add(name="Basis", from_mix=False)
            key = obj.shape_key_add(name=KEY, from_mix=False)
            obj.active_shape_key_index = len(obj.data.shape_keys.key_blocks) - 1
            key.value = 1.0
        self.before = read(self._elements(obj), "co", floats(3 * len(obj.data.vertices)))
        self.value = obj.data.shape_keys.key_blocks[KEY].value if into == "KEY" else 0.0

    def _elements(self, obj):
        return obj.data.shape_keys.key_blocks[KEY].data if self.into == "KEY" else obj.data.vertices

    def write(self, obj, positions):
        self._elements(obj).foreach_set("co", positions)
        if self.into == "KEY":
            obj.data.shape_keys.key_blocks[KEY].value = 1.0
        obj.data.update()

    def restore(self, obj):
        if self.into == "KEY" and not (obj.data.shape_keys and KEY in obj.data.shape_keys.key_blocks):
            return
        self.write(obj, self.before)
        if self.into == "KEY":
            self._restore_keys(obj)

    def _restore_keys(self, obj):
        keys = obj.data.shape_keys.key_blocks
        keys[KEY].value = self.value
        if not self.had_key:
            obj.shape_key_remove(keys[KEY])
        if not self.had_basis:
            obj.shape_key_clear()


class LISSOM_OT_deform(bpy.types.Operator):
    """Bends the mesh by its handles, live: move, turn and scale the empties; Return keeps the result, Esc takes it back"""
    bl_idname, bl_label, bl_options = "lissom.deform", "Deform", {"REGISTER", "UNDO"}

    into: EnumProperty(name="Into", items=[("KEY", "Shape Key", "The shape key 'Lissom'; the Basis stays as it is"),
                                           ("MESH", "Mesh", "The mesh itself, which becomes the new rest shape")])
    region: StringProperty(name="Region", description="Vertex group outside which nothing moves; empty: the whole mesh")
    refine: IntProperty(name="Refine", default=0, min=0, max=2, description="ARAP iterations, over-relaxed")
    scale_details: BoolProperty(name="Scale Details", default=False,
                                description="Scale details with the surface around them instead of keeping their size")
    free_rings: IntProperty(name="Free Rings", default=0, min=0, max=10,
                            description="Rings of vertices that handles release if they nearly touch another")
    loose: EnumProperty(name="Loose Parts", default="FOLLOW",
                        items=[("FOLLOW", "Follow", "Parts without a handle follow the surface nearest to them"),
                               ("STAY", "Stay", "Parts without a handle stay where they are"),
                               ("ERROR", "Refuse", "Parts without a handle are an error")])

    @classmethod
    def poll(cls, context):
        return context.object is not None and subject_of(context) is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        obj = subject_of(context)
        layout.prop(self, "into")
        if obj:
            layout.prop_search(self, "region", obj, "vertex_groups")
        for name in ("refine", "scale_details", "free_rings", "loose"):
            layout.prop(self, name)

    # ---- Once, for scripts and the redo panel

    def execute(self, context):
        """Solves once, for the empties as they are."""
        if not self._begin(context):
            return {"CANCELLED"}
        try:
            self.drag.moved()
            self.drag.show("full")
            self._keep()
        except (lissom.Error, Problem) as error:
            self.drag.restore()
            return self._failed(error)
        finally:
            self.drag.close()
        return {"FINISHED"}

    # ---- Live

    def invoke(self, context, _event):
        """Prepares in another thread, then follows the empties."""
        if not self._begin(context):
            return {"CANCELLED"}
        self._job = self.drag.deformer.begin_prepare()
        self._last_move, self._is_draft = 0.0, False
        self._timer = context.window_manager.event_timer_add(1 / 60, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Follows the empties; other events go to Blender, so that they can be moved."""
        if bpy.data.objects.get(self.drag.name) is None:
            self._leave(context)
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            return self._stop(context)
        if event.type in {"RET", "NUMPAD_ENTER"} and event.value == "PRESS" and not self._job:
            return self._finish(context)
        if event.type == "TIMER":
            try:
                self._prepare_further(context) if self._job else self._frame()
            except (lissom.Error, Problem) as error:
                self.drag.restore()
                self._leave(context)
                return self._failed(error)
            except KeyError:
                self.report({"WARNING"}, "A handle or the shape key was deleted or undone: the deformation ends")
                self._leave(context)
                return {"CANCELLED"}
        return {"PASS_THROUGH"}

    def cancel(self, context):
        """Takes the result back when Blender closes the window."""
        self._stop(context)

    def _begin(self, context):
        if native.problem:
            self.report({"ERROR"}, native.problem)
            return False
        leave_edit_mode(context)
        obj = subject_of(context)
        try:
            check_editable(obj)
            self.drag = Drag(obj, self)
        except (lissom.Error, Problem) as error:
            self._failed(error, obj)
            return False
        for note in notes_of(obj):
            self.report({"INFO"}, note)
        return True

    def _failed(self, error, obj=None):
        obj = obj or bpy.data.objects.get(self.drag.name)
        if isinstance(error, lissom.Error) and obj:
            select_elements(obj, error)
        self.report({"ERROR"}, text_of(error) if isinstance(error, lissom.Error) else str(error))
        return {"CANCELLED"}

    def _prepare_further(self, context):
        if not self._job.is_done():
            label, fraction = self._job.progress()
            context.workspace.status_text_set(f"Deform: {label or 'prepares'}, {100 * fraction:.0f} %    Esc stops it")
            return
        job, self._job = self._job, None
        job.finish()
        context.workspace.status_text_set("Deform: move, turn and scale the empties    Return keeps it    Esc takes it back")

    def _frame(self):
        now = time.perf_counter()
        if self.drag.moved():
            self.drag.show("draft")
            self._last_move, self._is_draft = now, True
        elif self._is_draft and now - self._last_move > _PAUSE:
            self.drag.show("full")
            self._is_draft = False

    def _stop(self, context):
        if self._job:
            self._job.cancel()
            try:
                self._job.finish()
            except lissom.Error:
                pass
        self.drag.restore()
        self._leave(context)
        return {"CANCELLED"}

    def _finish(self, context):
        if self._is_draft:
            self.drag.show("full")
        self._keep()
        self._leave(context)
        return {"FINISHED"}

    def _keep(self):
        for line in self.drag.warnings():
            self.report({"WARNING"}, line)
        self.drag.keep()

    def _leave(self, context):
        context.workspace.status_text_set(None)
        context.window_manager.event_timer_remove(self._timer)
        self.drag.close()


def subject_of(context):
    """Returns the mesh that is deformed: the active object, or that of the active empty; None if it is neither."""
    obj = context.object
    if obj is not None and obj.type == "EMPTY":
        return obj.lissom_handle.subject
    return obj if obj is not None and obj.type == "MESH" else None


CLASSES = (LISSOM_OT_deform,)
