"""Scripts in Lua as operators: those of the add-on, those of the user's folder, and the presets of hair."""
import os
import re
import tempfile

import bpy

from . import native
from .curves import drawn_curves
from .hair import give_regions, head_mesh, put_hair
from .layers import Layers
from .meshes import (add_object, is_same_surface, leave_edit_mode, new_mesh, positions_of, rows_of, shown_positions,
                     surface_of)
from .native import lissom, new_context
from .merging import boundaries_of, chosen_boundaries
from .problems import Problem, check_editable, check_mesh
from .schema import PREFIX, SELECTED, draw_parameters, object_below, properties_of
from .work import Work

HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPTS = os.path.join(HERE, "scripts")
MODULES = os.path.join(HERE, "lua")
PRESETS = os.path.join(MODULES, "presets")

# A preset of hair as a script: its parameters and a head; its results are a style and hair.
_PRESET = """local lissom = require "lissom"
local preset = require "presets.NAME"
local schema = {
    head = { type = "head", default = "", group = "hair", help = "the head; empty: a generated one" },
    count = { type = "integer", default = 10000, min = 1, max = 2000000, group = "hair", help = "strands" },
}
for name, parameter in pairs(preset.schema) do schema[name] = schema[name] or parameter end
local p, values = lissom.params(schema), {}
for name in pairs(preset.schema) do values[name] = p[name] end
local head = p.head == "" and lissom.shapes.head{ vertices = 12000 } or lissom.load(p.head)
local growth = { count = p.count }
local style, hair, look = preset.grow(head, values, growth, growth)
return style, hair, type(look) == "table" and type(look.color) == "string" and look.color or ""
"""


class Source:
    """The text of a script, and the name that it has in messages and menus."""

    def __init__(self, path, is_preset=False):
        self.path, self.is_preset = path, is_preset
        self.name = os.path.splitext(os.path.basename(path))[0]
        self.title = self.name.replace("_", " ").title()
        self.key = re.sub(r"\W", "_", self.name.lower())

    def text(self):
        """Returns the text that is run. Modules are found beside it, in the add-on, and among those that ship."""
        folders = [os.path.dirname(self.path), MODULES]
        found = "".join(f"{folder}/?.lua;" for folder in folders)
        # In the first line, so that messages name the lines of the file.
        start = f"package.path = [==[{found}]==] .. package.path "
        if self.is_preset:
            return start + _PRESET.replace("NAME", self.name)
        with open(self.path, encoding="utf-8") as file:
            return start + file.read()

    def load(self, library):
        """Returns the script, loaded up to its parameters."""
        return lissom.Script.load(self.text(), os.path.basename(self.path), context=library)


def sources_in(folder, is_preset=False):
    """Returns the scripts of a folder, by name."""
    if not folder or not os.path.isdir(folder):
        return []
    names = sorted(name for name in os.listdir(folder) if name.endswith(".lua") and not name.startswith("."))
    return [Source(os.path.join(folder, name), is_preset) for name in names]


# ---- What is handed to a script

class Inputs:
    """Objects of Blender as values of a script's parameters: files of a folder that lives as long as the run."""

    def __init__(self, context, library, folder):
        self.context, self.library, self.folder = context, library, folder
        self.first = None
        self.meshes = {}

    def mesh(self, obj, name, is_head):
        """Returns the file of a mesh in the space of the first one."""
        check_mesh(obj, f"'{name}'")
        mesh = head_mesh(obj, self.context, self.library) if is_head else self._whole(obj)
        if self.first is None:
            self.first = obj
        elif obj != self.first:
            mesh.transform(rows_of(self.first.matrix_world.inverted() @ obj.matrix_world))
        self.meshes[name] = mesh
        return self._saved(mesh, name + ".glb")

    def _whole(self, obj):
        mesh = surface_of(obj, self.library, shown_positions(obj, self.context))
        Layers((obj,)).give(obj, mesh)
        give_regions(obj, mesh)
        return mesh

    def curve(self, obj, name):
        """Returns the file of a curve in the space of the first mesh: strands, which lissom.load_strands reads."""
        if obj.type not in {"CURVE", "CURVES"}:
            raise Problem(f"'{obj.name}' is no curve: choose another for '{name}'")
        into = self.first.matrix_world.inverted() if self.first else obj.matrix_world.inverted()
        lines = drawn_curves(obj, self.context, into)
        if not lines:
            raise Problem(f"'{obj.name}' has no line of two points")
        points = [number for line in lines for number in line]
        offsets = [0]
        for line in lines:
            offsets.append(offsets[-1] + len(line) // 3)
        strands = lissom.Strands.create(points, offsets, context=self.library)
        return self._saved(strands, name + ".hair")

    def _saved(self, thing, name):
        path = os.path.join(self.folder, name)
        thing.save(path)
        return path


def _object(context, name, parameter):
    obj = context.scene.objects.get(name)
    if obj is None:
        raise Problem(f"there is no object '{name}': choose another for '{parameter['name']}'")
    return obj


def _boundary_number(obj, library):
    """The number of the boundary that is selected, as scripts count; "" without one."""
    chosen = chosen_boundaries(obj, boundaries_of(surface_of(obj, library)))
    return str(1 + min(chosen)) if chosen else ""


def values_of(operator, parameters, inputs):
    """Returns the values of parameters that differ from the script's own, by name. Meshes go first: all that lies on them is
    taken in their space."""
    values = {}
    for parameter in sorted(parameters, key=lambda one: one["type"] not in ("mesh", "head")):
        value = exact(getattr(operator, PREFIX + parameter["name"]))
        value = _handed(operator, parameter, value, inputs)
        if value is not None and value != exact(parameter.get("default")):
            values[parameter["name"]] = value
    return values


def exact(value):
    """Returns a number as it was typed: properties of Blender hold it in 32 bits, of which seven digits are certain."""
    return float(f"{value:.7g}") if isinstance(value, float) else value


def _handed(operator, parameter, value, inputs):
    """The value that the script gets; None for its own."""
    kind, name = parameter["type"], parameter["name"]
    if kind == "boundary":
        obj = object_below(operator, parameter, inputs.context)
        return _boundary_number(obj, inputs.library) or None if value == SELECTED and obj else None
    if kind in ("mesh", "head", "curve", "region") and not value:
        return None
    if kind in ("mesh", "head"):
        return inputs.mesh(_object(inputs.context, value, parameter), name, kind == "head")
    if kind == "curve":
        return inputs.curve(_object(inputs.context, value, parameter), name)
    if kind in ("file", "folder"):
        return bpy.path.abspath(value)
    return value


# ---- What a script leaves

def flat(results):
    """Returns the results of a script as one list."""
    if isinstance(results, (list, tuple)):
        return [one for result in results for one in flat(result)]
    return [] if results is None else [results]


def put_results(operator, context, results, inputs, record):
    """Shows the results of a script: meshes as objects, or in the mesh that came in if it has the same faces, hair as Curves,
    and texts and numbers as reports."""
    first, unit = inputs.first, unit_of(results, inputs)
    color = next((one for one in results if isinstance(one, str) and re.fullmatch("#[0-9a-f]{6}", one)), None)
    for one in results:
        if isinstance(one, lissom.Mesh):
            put_mesh(context, one, first, operator.bl_label)
        elif isinstance(one, lissom.Strands):
            _put_strands(context, one, unit, first, record, operator.bl_label, color)
        elif isinstance(one, (str, int, float)) and one not in ("", color):
            operator.report({"INFO"}, str(one))


def unit_of(results, inputs):
    """Returns the metres in one unit of the head, by which strands are larger than it: that of the style that came with them,
    else of the first mesh as a head."""
    style = next((one for one in results if isinstance(one, lissom.Hairstyle)), None)
    if style is None and inputs.meshes and any(isinstance(one, lissom.Strands) for one in results):
        style = lissom.Hairstyle.create(next(iter(inputs.meshes.values())))
    return style.unit()[0] if style else 1.0


def put_mesh(context, mesh, first, name):
    """Writes a mesh into the object that came in, if its faces are the same; else adds an object."""
    if first is None or not is_same_surface(first.data, mesh):
        add_object(context, name, new_mesh(name, mesh), first.matrix_world if first else None)
        return
    check_editable(first)
    if first.data.shape_keys:
        key = first.shape_key_add(name=name, from_mix=False)
        key.data.foreach_set("co", positions_of(mesh))
        key.value = 1.0
    else:
        first.data.vertices.foreach_set("co", positions_of(mesh))
    first.data.update()


def _put_strands(context, strands, unit, head, record, name, color):
    if head is None:
        raise Problem("choose a head for the hair: select a mesh, or name it in the parameters")
    linear = [_linear(int(color[i:i + 2], 16) / 255) for i in (1, 3, 5)] if color else None
    put_hair(context, head, strands, unit, record, name, **({"color": linear} if linear else {}))


def _linear(value):
    """A number of sRGB as a linear one."""
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def groom_by_script(context, library, head, record):
    """Runs the script of a record on its head again, as steps; returns the strands and the unit of the head."""
    source = Source(record["script"], record["is_preset"])
    if not source.is_preset and not os.path.exists(source.path):
        raise Problem(f"the script of this hair is gone: put it back to {source.path}")
    with tempfile.TemporaryDirectory(prefix="lissom-") as folder:
        script = source.load(library)
        inputs = Inputs(context, library, folder)
        script.set(**{**record["values"], record["head"]: inputs.mesh(head, record["head"], True)})
        results = flat((yield script.begin_run()))
    strands = [one for one in results if isinstance(one, lissom.Strands)]
    if not strands:
        raise Problem(f"the script '{source.name}' returns no hair any more")
    return strands[0], unit_of(results, inputs)


# ---- Operators

class ScriptOperator(Work):
    """Part of the operator of a script; its class has `source` and `parameters`."""

    def invoke(self, context, event):
        """Takes the active mesh for the first mesh or head that is not named, and runs."""
        for parameter in self.parameters:
            name = PREFIX + parameter["name"]
            if parameter["type"] in ("mesh", "head"):
                if not getattr(self, name) and context.object and context.object.type == "MESH":
                    setattr(self, name, context.object.name)
                break
        return Work.invoke(self, context, event)

    def draw(self, context):
        """Draws the parameters in the redo panel."""
        self.layout.use_property_split = True
        draw_parameters(self.layout, self, self.parameters, context)

    def steps(self, context):
        """Runs the script as a job, and shows its results."""
        leave_edit_mode(context)
        if self.source.is_preset and not getattr(self, PREFIX + "head"):
            raise Problem("select the head as the active object, or name it in the parameters")
        with new_context() as library, tempfile.TemporaryDirectory(prefix="lissom-") as folder:
            script, inputs = self.source.load(library), Inputs(context, library, folder)
            values = values_of(self, self.parameters, inputs)
            script.set(**values)
            results = flat((yield script.begin_run()))
            put_results(self, context, results, inputs, self.record(values))

    def record(self, values):
        """Returns how hair of the script is groomed again."""
        head = next((one["name"] for one in self.parameters if one["type"] in ("head", "mesh")), "head")
        kept = {name: value for name, value in values.items() if name != head}
        return {"script": self.source.path, "is_preset": self.source.is_preset, "head": head, "values": kept}


def operator_of(source, library):
    """Returns the operator of a script. Errors: those of the script up to its parameters."""
    parameters = source.load(library).parameters()
    group = "hair" if source.is_preset else "script"
    about = f"Grooms the preset '{source.name}' on the active head" if source.is_preset else f"Runs {source.name}.lua"
    return type(f"LISSOM_OT_{group}_{source.key}", (ScriptOperator, bpy.types.Operator), {
        "bl_idname": f"lissom.{group}_{source.key}", "bl_label": source.title, "bl_options": {"REGISTER", "UNDO"},
        "__doc__": about, "__annotations__": properties_of(parameters), "source": source, "parameters": parameters})


class Registry:
    """The operators of scripts that are registered now, and the scripts that are none: their names and errors."""

    def __init__(self):
        self.operators, self.failures = [], {}

    def load(self, folder):
        """Registers the operators of the add-on's scripts, of those in `folder`, and of the presets."""
        self.unload()
        sources = sources_in(SCRIPTS) + sources_in(folder) + sources_in(PRESETS, True)
        with new_context() as library:
            for source in {(one.is_preset, one.key): one for one in sources}.values():
                try:
                    operator = operator_of(source, library)
                    bpy.utils.register_class(operator)
                    self.operators.append(operator)
                except (lissom.Error, OSError, UnicodeDecodeError, ValueError) as error:
                    self.failures[source.name] = str(error)

    def unload(self):
        """Removes all of them."""
        for operator in self.operators:
            bpy.utils.unregister_class(operator)
        self.operators, self.failures = [], {}


registry = Registry()


class LISSOM_OT_reload_scripts(bpy.types.Operator):
    """Reads all scripts again, after one was changed or added"""
    bl_idname, bl_label = "lissom.reload_scripts", "Reload Scripts"

    def execute(self, context):
        registry.load(scripts_folder(context))
        for name, error in registry.failures.items():
            self.report({"ERROR"}, f"{name}.lua: {error}")
        return {"FINISHED"}


def scripts_folder(context):
    """Returns the user's folder of scripts, as the preferences name it; "" for none."""
    addon = context.preferences.addons.get(__package__)
    return bpy.path.abspath(addon.preferences.folder) if addon and addon.preferences else ""


def register():
    """Registers the operators of all scripts."""
    if not native.problem:
        registry.load(scripts_folder(bpy.context))


def unregister():
    """Removes them."""
    registry.unload()


CLASSES = (LISSOM_OT_reload_scripts,)
