"""Parameters of scripts as properties of operators: sliders, choices, and pickers of objects, groups and loops."""
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

_INTEGERS = (-2**31, 2**31 - 1)
_NUMBERS = (-3.4e38, 3.4e38)
# Before the names of parameters, which may be those of an operator, as `name` and `keys` are.
PREFIX = "p_"
# Types of parameters that stand for something in Blender.
PICKED = ("mesh", "head", "region", "boundary", "curve")
SELECTED = "SELECTED"


def property_of(parameter):
    """Returns the property for a parameter of a script, as lissom.Script.parameters describes it."""
    return _MAKERS.get(parameter["type"], _text)(parameter, _about(parameter))


def properties_of(parameters):
    """Returns the properties of all parameters by their names in an operator."""
    return {PREFIX + one["name"]: property_of(one) for one in parameters}


def _about(parameter):
    """Name and help of the property."""
    name = parameter["name"].replace("_", " ").capitalize()
    unit = parameter.get("unit")
    text = parameter.get("help", "")
    return {"name": f"{name} ({unit})" if unit else name, "description": text[:1].upper() + text[1:]}


def _limits(parameter, type_, least, greatest):
    """Least and greatest value; those of the script are also where a slider ends."""
    return {"min": type_(max(parameter.get("min", least), least)),
            "max": type_(min(parameter.get("max", greatest), greatest))}


def _integer(parameter, about):
    return IntProperty(**about, default=int(parameter.get("default", 0)), **_limits(parameter, int, *_INTEGERS))


def _number(parameter, about):
    size = max(abs(parameter.get("min", 0)), abs(parameter.get("max", 0))) or abs(parameter.get("default", 1))
    step = {"step": max(1, round(100 * parameter["step"]))} if "step" in parameter else {}
    return FloatProperty(**about, default=parameter.get("default", 0.0), precision=2 if size >= 10 else 4, **step,
                         **_limits(parameter, float, *_NUMBERS))


def _boolean(parameter, about):
    return BoolProperty(**about, default=bool(parameter.get("default", False)))


def _choice(parameter, about):
    items = [(choice, choice.replace("_", " ").capitalize(), "") for choice in parameter["choices"]]
    return EnumProperty(**about, items=items, default=parameter.get("default", items[0][0]))


def _text(parameter, about):
    kind = {"file": "FILE_PATH", "folder": "DIR_PATH"}.get(parameter["type"], "NONE")
    return StringProperty(**about, default=str(parameter.get("default", "")), subtype=kind)


def _picked(_parameter, about):
    return StringProperty(**about)


def _boundary(parameter, about):
    items = [(SELECTED, "Selected Loop", "The open boundary that the selected vertices lie on"),
             ("SCRIPT", "As the Script Says", f"The script's own: {parameter.get('default', '')}")]
    return EnumProperty(**about, items=items)


_MAKERS = {"integer": _integer, "number": _number, "boolean": _boolean, "choice": _choice, "mesh": _picked, "head": _picked,
           "region": _picked, "curve": _picked, "boundary": _boundary}


def draw_parameter(layout, operator, parameter, context):
    """Draws a parameter: a slider if it has limits, a picker if it stands for something in Blender."""
    name, kind = PREFIX + parameter["name"], parameter["type"]
    if kind in ("mesh", "head", "curve"):
        layout.prop_search(operator, name, context.scene, "objects")
    elif kind == "region":
        obj = object_below(operator, parameter, context)
        if obj:
            layout.prop_search(operator, name, obj, "vertex_groups")
        else:
            layout.prop(operator, name)
    else:
        layout.prop(operator, name, slider="min" in parameter and "max" in parameter)


def object_below(operator, parameter, context):
    """Returns the object that a region, boundary or curve lies on: that of its parameter `of`, else the active one."""
    name = getattr(operator, PREFIX + parameter["of"], "") if parameter.get("of") else ""
    obj = context.scene.objects.get(name) if name else context.object
    return obj if obj is not None and obj.type == "MESH" else None


def draw_parameters(layout, operator, parameters, context):
    """Draws all parameters, in groups if they have some."""
    group = None
    for parameter in parameters:
        if parameter.get("group") and parameter["group"] != group:
            layout.label(text=parameter["group"].capitalize())
        group = parameter.get("group")
        draw_parameter(layout, operator, parameter, context)
