"""Values of Python as those of C, and back."""
import ctypes as C
from types import SimpleNamespace
from typing import NamedTuple, Sequence, Tuple, Union

from . import _abi

#: An affine map: the twelve numbers of a 3 x 4 matrix, row after row, or its rows; a fourth row is left out.
Transform = Union[Sequence[float], Sequence[Sequence[float]]]
#: Values that a call returns together, by name.
Record = SimpleNamespace


class Join(NamedTuple):
    """Two open boundaries that become one in a merge, and points on them that meet."""
    source_boundary: int = 0
    target: int = 0
    target_boundary: int = 0
    source_keys: Sequence[Sequence[float]] = ()
    target_keys: Sequence[Sequence[float]] = ()


def _numbers(values, count):
    values = [float(value) for value in values]
    if len(values) != count:
        raise ValueError(f"{count} numbers are expected, not {len(values)}")
    return (C.c_double * count)(*values)


def _points(points):
    flat = [float(number) for point in points for number in point]
    return (C.c_double * max(1, len(flat)))(*flat)


def _transform(map_):
    rows = list(map_)
    flat = [float(n) for row in rows[:3] for n in row] if hasattr(rows[0], "__len__") else [float(n) for n in rows[:12]]
    return _abi.lissom_transform(_numbers(flat, 12))


def _transforms(maps):
    return (_abi.lissom_transform * max(1, len(maps)))(*map(_transform, maps)), len(maps)


def _encoded(text):
    return None if text is None else str(text).encode()


def _utf8(text):
    content = text.encode()
    return content, len(content)


def _bytes(content):
    content = bytes(content)
    return C.cast(C.c_char_p(content), C.c_void_p), len(content)


def _texts(texts):
    return (C.c_char_p * max(1, len(texts)))(*[text.encode() for text in texts]), len(texts)


def _joins(joins):
    made = []
    for join in joins:
        join = join if isinstance(join, Join) else Join(**join)
        if len(join.source_keys) != len(join.target_keys):
            raise ValueError("a join needs as many source_keys as target_keys")
        made.append(_abi.lissom_join(join.source_boundary, join.target, join.target_boundary, _points(join.source_keys),
                                     _points(join.target_keys), len(join.source_keys)))
    return ((_abi.lissom_join * len(made))(*made) if made else None), len(made)


def _sliding_pins(pins):
    """Pins as mappings: vertex, on ("plane", "line" or "sphere"), point, direction, radius."""
    made = []
    for pin in pins:
        on = _choice(pin.get("on", "plane"), _abi.lissom_pin_place)
        made.append(_abi.lissom_sliding_pin(pin["vertex"], on, (C.c_double * 3)(*pin["point"]),
                                            (C.c_double * 3)(*pin.get("direction", (0, 0, 0))), pin.get("radius", 0.0)))
    return ((_abi.lissom_sliding_pin * len(made))(*made) if made else None), len(made)


def _handle_of(value, struct):
    if value is None:
        return struct(0)
    handle = getattr(value, "_handle", None)
    if not isinstance(handle, struct):
        raise TypeError(f"a {struct.__name__[len('lissom_'):]} is expected, not {type(value).__name__}")
    return handle


def _handles(values):
    return (_abi.lissom_mesh * max(1, len(values)))(*[_handle_of(v, _abi.lissom_mesh) for v in values]), len(values)


def _named_poses(poses):
    made = []
    for name, shapes in poses.items():
        shapes, count = _handles(shapes if isinstance(shapes, (list, tuple)) else [shapes])
        made.append(_abi.lissom_named_pose(name.encode(), shapes, count))
    return (_abi.lissom_named_pose * max(1, len(made)))(*made), len(made)


def _short_names(kind):
    """Names of a choice without what they have in common: "all" for WELD_ALL."""
    names = [member.name.lower() for member in kind]
    first = names[0].split("_")[0] + "_"
    common = len(names) > 1 and all(name.startswith(first) for name in names)
    return {name[len(first):] if common else name: member for name, member in zip(names, kind)}


def _choice(value, kind):
    if isinstance(value, str):
        names = _short_names(kind)
        if value not in names:
            raise ValueError(f"'{value}' is none of: {', '.join(names)}")
        return int(names[value])
    return int(kind(value))


def _text(value):
    return "" if value is None else value.decode(errors="replace")


def _taken_bytes(taken):
    return C.string_at(taken.data, taken.size) if taken.size else b""


def _python(value):
    if isinstance(value, bytes):
        return _text(value)
    return tuple(value) if isinstance(value, C.Array) else value


def _record(struct):
    return Record(**{name: _python(getattr(struct, name)) for name, *_ in struct._fields_ if name != "struct_size"})


_STRANDS = {"width": (1, "d"), "color": (3, "d"), "transparency": (1, "d"), "root_uv": (2, "d"), "root_face": (1, "i"),
            "root_barycentric": (3, "d"), "group": (1, "i"), "id": (1, "i"), "guide": (1, "i"), "guide_arc": (1, "d"),
            "root_triangle": (3, "i")}


def _strand_value(value):
    return _STRANDS[list(_STRANDS)[_choice(value, _abi.lissom_strand_value)]]


def _strand_width(value):
    return _strand_value(value)[0]


def _strand_format(value):
    return _strand_value(value)[1]


