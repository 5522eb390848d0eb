#!/usr/bin/env python3
"""Writes the parts of the Python package that lissom.h determines: _abi.py, the functions by ctypes, and _objects.py,
its objects as classes. Usage: generate.py LISSOM_H FOLDER"""
import os
import re
import sys
import textwrap

from header import read_header

BASE = {"void": "None", "bool": "C.c_bool", "char": "C.c_char", "double": "C.c_double", "float": "C.c_float",
        "size_t": "C.c_size_t", "int32_t": "C.c_int32", "uint32_t": "C.c_uint32", "uint64_t": "C.c_uint64",
        "int64_t": "C.c_int64"}

# Classes of objects, in the order in which they are written.
KINDS = {"mesh": "Mesh", "region": "Region", "deformer": "Deformer", "pose": "Pose", "pose_space": "PoseSpace",
         "merger": "Merger", "paste": "Paste", "hairstyle": "Hairstyle", "strands": "Strands", "render_map": "RenderMap",
         "script": "Script", "object": "Object"}
# The longest first: "pose_space" begins with "pose".
ANY_KIND = "|".join(sorted(KINDS, key=len, reverse=True))
# Functions whose names begin with other words.
METHODS = {"lissom_curve_": "hairstyle", "lissom_numbers_": "object", "lissom_merge": "mesh", "lissom_begin_merge": "mesh",
           "lissom_cut_": "mesh", "lissom_erase": "mesh", "lissom_begin_erase": "mesh"}
# Functions for which the package has its own by hand, and those of no use in Python.
BY_HAND = re.compile(r"lissom_(context_|default_|job_|\w+_is_valid$|\w+_release$|last_error|status_|version|licence|has_scripts"
                     r"|cancel|clear_cancel|memory_|object_count|set_memory|identity|move|call|begin_call|sandbox_scripts"
                     r"|script_parameters|script_run|script_begin_run|script_set)")
# Elements of lists that are written: their number, the numbers in each, and their format, in terms of `self`, `mesh`
# and the parameters of the method.
OUTPUTS = {
    "mesh_read_positions": ("self.vertex_count", 3, "d"), "mesh_read_normals": ("self.vertex_count", 3, "d"),
    "mesh_read_triangles": ("self.triangle_count", 3, "i"), "mesh_read_boundary": ("_boundary_size(self, number)", 1, "i"),
    "mesh_read_faces.corners": ("self.corner_count", 1, "i"), "mesh_read_faces.sizes": ("self.face_count", 1, "i"),
    "mesh_read_attribute": ("self.attribute_named(name).count", "self.attribute_named(name).width", "d"),
    "mesh_read_labels": ("self.face_count", 1, "i"), "mesh_read_vertex_origins": ("self.vertex_count", 1, "i"),
    "mesh_read_face_origins": ("self.face_count", 1, "i"),
    "render_map_read_vertices": ("self.size", 1, "i"), "render_map_read_triangles": ("self.triangle_count", 3, "i"),
    "render_map_read_positions": ("self.size", 3, "d"), "render_map_read_normals": ("self.size", 3, "d"),
    "render_map_read_tangents": ("self.size", 4, "d"),
    "render_map_read_attribute": ("self.size", "mesh.attribute_named(name).width", "d"),
    "region_read_vertices": ("self.size", 1, "i"), "deformer_read_rows": ("self.row_count", 1, "i"),
    "deformer_read_positions": ("self.row_count", 3, "d"), "deformer_read_normals": ("self.row_count", 3, "d"),
    "deformer_read_joints": ("self.joint_count(bones)", 3, "d"),
    "pose_space_read_positions": ("self.vertex_count", 3, "d"),
    "hairstyle_read_curves": ("self.curve_count", 1, "i"),
    "strands_read_points": ("self.point_count", 3, "d"), "strands_read_offsets": ("self.size + 1", 1, "i"),
    "strands_read": ("self.size", "_strand_width(value)", "_strand_format(value)"),
    "strands_read_at_points": ("self.point_count", "_strand_width(value)", "_strand_format(value)"),
    "numbers_read": ("self.numbers_size", "self.numbers_width", "d"),
}
# Numbers in an element of a list that is read.
INPUTS = {"positions": 3, "points": 3, "spine": 3, "normals": 3, "corners": 1, "sizes": 1, "vertices": 1, "labels": 1,
          "offsets": 1, "uvs": 2, "weights": 1, "correctives": 1, "joints": 3}
# Names of methods that are other than those of C.
NAMES = {"mesh_attribute": "attribute_at", "mesh_find_attribute": "attribute_named", "object_numbers_create": "of_numbers"}
# Help for functions whose comments in C are those of a group.
DOCS = {
    "mesh_save": "Saves by extension, whole or not at all. Data that the format cannot hold is named in the log.",
    "mesh_begin_load": "Starts the load as a job, whose result is a mesh.",
    "mesh_begin_save": "Starts to save as a job. The mesh may be changed meanwhile.",
    "mesh_encode": "Returns the bytes of a file; `extension` is \"obj\", \"glb\", ...",
    "mesh_copy": "Returns a copy.",
    "mesh_read_boundary": "Returns the vertices of open boundary `number`, in order. Errors: out_of_range.",
    "mesh_vertex_count": "The number of vertices.",
    "mesh_face_count": "The number of faces. Polygons are counted as their triangles.",
    "mesh_corner_count": "The number of corners of all faces.",
    "mesh_triangle_count": "The number of triangles.",
    "mesh_boundary_count": "The number of open boundaries.",
    "mesh_read_positions": "Returns the positions, one row a vertex.",
    "mesh_read_normals": "Returns normals of unit length, weighted by the angles of faces, one row a vertex; zero if no face "
                         "of the vertex has area.",
    "mesh_attribute_count": "The number of attributes.",
    "mesh_label_count": "Returns the number of labels of a kind: \"material\", \"group\", \"object\", \"smoothing\".",
    "mesh_find_attribute": "Returns the name, domain, width and count of an attribute. Errors: out_of_range if there is none.",
    "merge": "Merges this mesh with a target; both stay as they are. Returns the merged mesh and a report. Without joins their "
             "nearest boundaries meet. Errors: not_a_boundary for a closed mesh; as `Merger.create` and `Merger.solve`.",
    "begin_erase": "Starts to erase as a job, whose result is a mesh.",
    "region_size": "The number of vertices.",
    "deformer_row_count": "The number of vertices of the region: the rows of `positions` and `normals`.",
    "deformer_read_rows": "Returns the ascending ids of the vertices of the region.",
    "pose_space_pose_count": "The number of poses.",
    "pose_space_vertex_count": "The number of vertices of the rest mesh.",
    "pose_space_pose_name": "Returns the name of a pose. Poses keep the order in which they were given. Errors: out_of_range.",
    "pose_space_targets": "Returns the rest mesh with a morph target for each pose, for engines that blend linearly, and with "
                          "correctives that take back the error of that: at the weights in `correctives`, one for each pose, "
                          "corrective after corrective, and at the meshes of paths. Returns a report too. Errors: "
                          "invalid_argument; not_finite; unsupported for a mesh without faces; memory_limit; cancelled.",
    "merger_create": "Prepares a merge of `source` onto targets, to be solved again with other keys. Without joins each target "
                     "meets the source at their nearest boundaries. The meshes stay as they are. Errors: invalid_argument; "
                     "out_of_range for a boundary; boundary_conflict; unconstrained; zero_area; memory_limit; cancelled.",
    "paste_begin_create": "Starts to prepare as a job, whose result is a paste.",
    "paste_begin_optimize": "Starts to optimize as a job.",
    "paste_begin_merge": "Starts the merge as a job, whose results are a mesh and a report.",
    "hairstyle_curve_count": "The number of curves.",
    "hairstyle_read_curves": "Returns the numbers of all curves in order.",
    "hairstyle_grow": "Grows hair into new strands. Errors: invalid_argument without a curve; cancelled.",
    "strands_size": "The number of strands.",
    "strands_point_count": "The number of points of all strands.",
    "strands_has": "Returns 1 if strands have these values, else 0. Widths, transparency and ids are always there.",
    "strands_read": "Returns one element a strand; `value` is \"width\", \"color\", \"root_uv\", ... Errors: out_of_range if there "
                    "are none.",
    "strands_read_at_points": "Returns one element a point, for \"width\", \"color\" and \"transparency\".",
    "render_map_size": "The number of render vertices.",
    "render_map_triangle_count": "The number of triangles. They may be fewer than were given: those that were dropped are not "
                                 "drawn.",
    "numbers_size": "The number of elements.",
    "numbers_width": "The number of numbers in an element.",
    "mesh_remove_attribute": "Removes an attribute. Errors: out_of_range if there is none.",
    "mesh_label_name": "Returns the name of a label of a kind. Errors: out_of_range.",
    "region_all": "Makes a region of all vertices of a mesh.",
    "region_sphere": "Makes a region of the vertices in a ball.",
    "region_box": "Makes a region of the vertices in a box.",
    "region_plane": "Makes a region of the vertices on the side of a plane that `normal` points to.",
    "region_geodesic": "Makes a region of the vertices within `radius` over the surface from the one nearest to `point`.",
    "region_combine": "Returns the \"union\", \"intersection\" or \"difference\" with another region. Errors: topology_mismatch.",
    "region_invert": "Returns the region of all other vertices.",
    "deformer_remove_handle": "Removes a handle: its vertices are free. The numbers of others stay.",
    "deformer_get_transform": "Returns the transform of a handle from its rest shape.",
    "deformer_begin_prepare": "Starts to prepare as a job.",
    "deformer_begin_solve": "Starts the solve as a job; read the result when it has ended.",
    "hairstyle_encode": "Returns the style as the text of a file (JSON).",
    "hairstyle_add_stream": "Adds a curve through points, along which hair flows; returns its number. Errors: "
                            "invalid_argument if fewer than two points differ; out_of_range outside of the volume; not_finite.",
    "hairstyle_add_dividing": "Adds a curve at which hair parts; returns its number. Errors: as `Hairstyle.add_stream`.",
    "hairstyle_add_ponytail": "Adds a ponytail, in which hair gathers at the beginning of its spine; returns its number. A "
                              "radius of 0 is the default. Errors: as `Hairstyle.add_stream`.",
    "curve_set_points": "Replaces the points of a curve (triples).",
    "curve_enable": "Lets a curve act, or not.",
    "curve_remove": "Removes a curve; the numbers of others stay.",
    "strands_load": "Loads .hair, .data, .usda, .tfx or .ply. Files are in metres.",
    "strands_save": "Saves as .hair, .data, .usda, .tfx, .ply, .rib, .glb or .obj. Files are in metres.",
    "strands_begin_load": "Starts the load as a job, whose result is new strands.",
    "strands_begin_save": "Starts to save as a job. The strands are busy until it is finished.",
    "strands_read_points": "Returns all points, strand after strand.",
    "strands_read_offsets": "Returns the number of the first point of each strand, and at the end the number of all points.",
    "strands_group_count": "The number of groups.",
    "strands_group_name": "Returns the name of a group. Errors: out_of_range.",
}
# Words in capitals that are no names.
KEPT = ("JSON", "ARAP")
OPTIONS = ("_options", "lissom_placement", "lissom_buffer")
ARRAY = "Array"


def quoted(text, indent):
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    lines = textwrap.wrap(text, 118 - len(indent))
    if len(lines) == 1:
        return f'{indent}"""{lines[0]}"""'
    return f'{indent}"""' + ("\n" + indent).join(lines) + f'\n{indent}"""'


def plain(doc, returns_list=False):
    """A comment of C in the words of Python: names in small letters, and without what only C has."""
    doc = re.sub(r"\[any thread\]|, or -1 for an(other| invalid) handle", "", doc)
    doc = re.sub(r"[^.;]*\bNULL\b[^.;]*[.;] ?", " ", doc)
    doc = re.sub(r"\bLISSOM_([A-Z_]+)", lambda m: m.group(1).lower(), doc)
    doc = re.sub(r"\b[A-Z][A-Z_]{3,}\b", lambda m: m.group().lower() if m.group() not in KEPT else m.group(), doc)
    doc = re.sub(r"\s*; ?\s+(?=[A-Z])", ". ", doc)
    words = (("Receives", "Returns"),) + ((("Writes", "Returns"), ("Write ", "Return ")) if returns_list else ())
    for c, python in words:
        doc = re.sub(rf"^{c}", python, doc)
    doc = re.sub(r"^(Return|Start|Load|Write|Replace|Add|Find|Make|Save)(?= )", r"\1s", doc)
    doc = re.sub(rf"lissom_({ANY_KIND})_(read_)?(\w+)\b", lambda m: f"`{KINDS[m.group(1)]}.{m.group(3)}`", doc)
    doc = re.sub(r"\blissom_(\w+)\b(?!\.h)", r"`\1`", doc)
    return re.sub(r"\s+", " ", doc).strip()


# ---- ctypes

class Abi:
    """Writes the types and functions by ctypes."""

    def __init__(self, header):
        self.header = header
        self.enums = {enum.name for enum in header.enums}
        self.callbacks = {name for name, _ in header.callbacks}
        self.opaque = {struct.name for struct in header.structs if not struct.fields}

    def type(self, type_, is_parameter=False):
        if type_.callback:
            result, parameters = type_.callback
            return "C.CFUNCTYPE(" + ", ".join([self.type(result, True)] + [self.type(p.type, True) for p in parameters]) + ")"
        if type_.base in self.callbacks:
            return type_.base
        base = "C.c_int" if type_.base in self.enums else BASE.get(type_.base, type_.base)
        if type_.array:
            return f"C.POINTER({base})" if is_parameter else f"{base} * {type_.array}"
        stars = type_.stars
        if stars and (type_.base == "void" or type_.base in self.opaque):
            base, stars = "C.c_void_p", stars - 1
        elif stars and type_.base == "char":
            # A text; memory that is written is passed by its address.
            base, stars = ("C.c_char_p" if type_.const else "C.c_void_p"), stars - 1
        return "C.POINTER(" * stars + base + ")" * stars

    def write(self):
        lines = ['"""The C interface by ctypes. Generated from lissom.h."""', "import ctypes as C", "import enum", "",
                 f"ABI_VERSION = {self.header.abi}", ""]
        for enum in self.header.enums:
            lines += ["", f"class {enum.name}(enum.IntEnum):"] + ([quoted(plain(enum.doc), "    ")] if enum.doc else [])
            lines += [f"    {name[len('LISSOM_'):]} = {value}" + (f"  # {doc}" if doc else "")
                      for name, value, doc in enum.values] + [""]
        lines += [""] + [f"{name} = {self.type(type_)}" for name, type_ in self.header.callbacks]
        for struct in self.header.structs:
            lines += [""] + self.struct(struct)
        lines += ["", "", "# The choices of fields, which ctypes knows as numbers.", "CHOICES = {"]
        lines += [f'    ("{struct.name}", "{f.name}"): {f.type.base},' for struct in self.header.structs
                  for f in struct.fields if f.type.base in self.enums]
        lines += ["}", "", "# Name: symbol, result, parameters.", "FUNCTIONS = {"]
        for function in self.header.functions:
            types = "".join(self.type(p.type, True) + ", " for p in function.parameters)
            lines.append(f'    "{function.name}": ("{function.symbol}", {self.type(function.result, True)}, ({types})),')
        return "\n".join(lines + ["}", ""])

    def struct(self, struct):
        if not struct.fields:
            return [f"{struct.name} = C.c_void_p"]
        lines = ["", f"class {struct.name}(C.Structure):"] + ([quoted(plain(struct.doc), "    ")] if struct.doc else [])
        pointers = any(f.type.stars and f.type.base == "lissom_merge_report" for f in struct.fields)
        fields = [f'("{f.name}", {"C.c_void_p" if pointers and f.type.base == "lissom_merge_report" else self.type(f.type)})'
                  for f in struct.fields]
        return lines + ["    _fields_ = [" + ",\n                ".join(fields) + "]", ""]


# ---- Objects

SCALARS = {"int32_t": "int", "uint32_t": "int", "int64_t": "int", "uint64_t": "int", "size_t": "int", "double": "float",
           "bool": "bool"}


class Method:
    """A function of C as a method: its parameters in Python, the arguments of C, and its results."""

    def __init__(self, objects, function, kind):
        self.objects, self.function, self.kind = objects, function, kind
        self.parameters, self.keywords, self.before, self.arguments, self.results = [], [], [], [], []
        self.self_given = False
        given = [p for p in function.parameters if p.type.base != "lissom_context"]
        while given:
            given = given[self.take(given):]

    def take(self, given):
        """Takes the first parameter, and those that belong to it; returns their number."""
        parameter, type_ = given[0], given[0].type
        counts = len(given) > 1 and given[1].type.base in ("int32_t", "size_t") and re.search("count$|^size$", given[1].name)
        if type_.base.startswith("lissom_") and type_.base[7:] in KINDS and not type_.stars:
            return self.take_object(parameter)
        if type_.base in ("lissom_input", "lissom_output"):
            return self.take_list(parameter)
        if type_.const and type_.base == "double" and (type_.stars or type_.array):
            return self.take_keys(given)
        if counts and type_.stars and type_.const:
            return self.take_many(parameter)
        if (type_.stars or type_.array) and not type_.const or type_.base == "char" and type_.stars == 2:
            return self.take_result(parameter)
        return self.take_value(parameter)

    def take_object(self, parameter):
        class_ = KINDS[parameter.type.base[7:]]
        if not self.self_given and parameter.type.base[7:] == self.kind:
            self.self_given = True
            self.arguments.append("self._handle")
            return 1
        optional = parameter.name in ("feature", "onto") or self.function.name.startswith("lissom_deformer_create") \
            and parameter.name == "region"
        self.parameters.append((parameter.name, f"Optional[{class_}]" if optional else class_, "None" if optional else None))
        self.arguments.append(f"_handle_of({parameter.name}, _abi.{parameter.type.base})")
        return 1

    def take_list(self, parameter):
        if parameter.type.base == "lissom_input":
            width = INPUTS.get(parameter.name)
            if parameter.name == "values":
                width = "width" if any(p.name == "width" for p in self.function.parameters) else "_strand_width(value)"
            optional = self.function.name == "lissom_mesh_create" and parameter.name == "sizes" \
                or parameter.name == "correctives"
            self.parameters.append((parameter.name, f"Optional[{ARRAY}]" if optional else ARRAY, "None" if optional else None))
            self.arguments.append(f"_arrays.given({parameter.name}, {width})")
            return 1
        key = self.function.name[len("lissom_"):]
        count, width, format_ = OUTPUTS.get(key + "." + parameter.name) or OUTPUTS[key]
        several = [p.name for p in self.function.parameters if p.type.base == "lissom_output"]
        out = "out" if len(several) == 1 else f"out_{parameter.name}"
        self.keywords.append((out, f"Optional[{ARRAY}]", "None"))
        format_ = repr(format_) if len(format_) == 1 else format_
        self.before.append(f"{parameter.name} = _arrays.Written({out}, {count}, {width}, {format_})")
        self.arguments.append(f"{parameter.name}.output")
        self.results.append((f"{parameter.name}.array", ARRAY))
        return 1

    def take_keys(self, given):
        """A point, or two lists of points and their number."""
        if given[0].type.array:
            self.parameters.append((given[0].name, "Sequence[float]", None))
            self.arguments.append(f"_numbers({given[0].name}, {given[0].type.array})")
            return 1
        for key in given[:2]:
            self.parameters.append((key.name, "Sequence[Sequence[float]]", None))
            self.arguments.append(f"_points({key.name})")
        self.arguments.append(f"len({given[0].name})")
        return 3

    def take_many(self, parameter):
        hints = {"lissom_join": "Sequence[Join]", "char": "Sequence[str]", "void": "bytes", "lissom_mesh": "Sequence[Mesh]",
                 "lissom_transform": "Sequence[Transform]", "lissom_sliding_pin": "Sequence[Mapping[str, Any]]",
                 "lissom_named_pose": "Mapping[str, Union[Mesh, Sequence[Mesh]]]"}
        optional = parameter.type.base == "lissom_join"
        self.parameters.append((parameter.name, hints[parameter.type.base], "()" if optional else None))
        helper = {"lissom_join": "_joins", "char": "_texts", "void": "_bytes", "lissom_mesh": "_handles",
                  "lissom_transform": "_transforms", "lissom_sliding_pin": "_sliding_pins", "lissom_named_pose": "_named_poses"}[parameter.type.base]
        if parameter.type.base == "char" and parameter.type.stars == 1:
            self.parameters[-1] = (parameter.name, "str", None)
            helper = "_utf8"
        names = [f"c_{parameter.name}", f"c_{parameter.name}_count"]
        self.before.append(f"{', '.join(names)} = {helper}({parameter.name})")
        self.arguments += names
        return 2

    def take_result(self, parameter):
        base, name = parameter.type.base, "c_" + parameter.name
        self.arguments.append(f"C.byref({name})" if not parameter.type.array else name)
        if parameter.type.array:
            self.before.append(f"{name} = (C.c_double * {parameter.type.array})()")
            self.results.append((f"tuple({name})", "Tuple[float, ...]"))
        elif base[7:] in KINDS:
            self.before.append(f"{name} = _abi.{base}()")
            self.results.append((f"context._object({name}.id, {KINDS[base[7:]]})", KINDS[base[7:]]))
        elif base == "lissom_job":
            self.before.append(f"{name} = _abi.lissom_job()")
            self.results.append((f"Job(context, {name}, {self.job_results()})", "Job"))
        elif base == "lissom_bytes":
            self.before.append(f"{name} = _abi.lissom_bytes()")
            self.results.append((f"_taken_bytes({name})", "bytes"))
        elif base == "char":
            self.before.append(f"{name} = C.c_char_p()")
            self.results.append((f"_text({name}.value)", "str"))
        elif base in SCALARS:
            self.before.append(f"{name} = {BASE[base]}()")
            # The length of the list says it.
            if self.function.name != "lissom_mesh_read_boundary":
                self.results.append((f"{name}.value", SCALARS[base]))
        elif base == "lissom_transform":
            self.before.append(f"{name} = _abi.lissom_transform()")
            self.results.append((f"tuple({name}.m)", "Transform"))
        else:
            short = base[len("lissom_"):]
            self.before.append(f"{name} = context.default('{short}')")
            self.results.append((f"_record({name})", "Record"))
        return 1

    def job_results(self):
        """Classes of the objects that a job makes, and whether it leaves a report: as the function without `begin`."""
        name = self.function.name.replace("begin_", "")
        name = {"lissom_mesh_create": "lissom_mesh_create_welded", "lissom_merger_create": ""}.get(name, name)
        other = next((f for f in self.objects.header.functions if f.name == name), None)
        outs = [p for p in other.parameters if p.type.stars and not p.type.const] if other else []
        kinds = [KINDS[p.type.base[7:]] for p in outs if p.type.base[7:] in KINDS]
        report = any(p.type.base == "lissom_merge_report" for p in outs)
        return f"[{', '.join(kinds)}], {report}"

    def take_value(self, parameter):
        type_, name = parameter.type, parameter.name
        if type_.stars and any(type_.base.endswith(end) for end in OPTIONS):
            struct = next(s for s in self.objects.header.structs if s.name == type_.base)
            fields = [f for f in struct.fields if f.name != "struct_size"]
            self.keywords += [(f.name, self.objects.hint(f.type), "...") for f in fields]
            short = type_.base[len("lissom_"):]
            values = ", ".join(f"{f.name}={f.name}" for f in fields)
            self.before.append(f"c_{name} = context.filled('{short}', {values})")
            self.arguments.append(f"C.byref(c_{name})")
        elif type_.base == "lissom_transform" and type_.stars:
            self.parameters.append((name, "Transform", None))
            self.arguments.append(f"C.byref(_transform({name}))")
        elif type_.base == "char":
            optional = name in ("uv",)
            self.parameters.append((name, "Optional[str]" if optional else "str", "None" if optional else None))
            self.arguments.append(f"_encoded({name})")
        elif type_.base in SCALARS and not type_.stars:
            default = "0.0" if name in ("radius", "weight", "lift") else None
            self.parameters.append((name, SCALARS[type_.base], default))
            self.arguments.append(name)
        elif type_.base in self.objects.enums:
            self.parameters.append((name, self.objects.hint(type_), "'full'" if name == "quality" else None))
            self.arguments.append(f"_choice({name}, _abi.{type_.base})")
        else:
            raise SystemExit(f"generate.py: no rule for {name} of {self.function.name}")
        return 1

    def name(self):
        name = self.function.name[len("lissom_"):]
        key = f"{self.kind}_{name}" if not name.startswith(self.kind) else name
        if key in NAMES:
            return NAMES[key]
        if name.startswith(self.kind + "_"):
            name = name[len(self.kind) + 1:]
        return re.sub(r"^read_(?!at_points)", "", name) if name != "read" else name

    def is_property(self):
        returns = self.function.result
        return self.self_given and not self.parameters and returns.base in ("int32_t", "bool") and not self.keywords

    def write(self):
        is_static = not self.self_given
        required = [f"{n}: {t}" for n, t, default in self.parameters if default is None]
        optional = [f"{n}: {t} = {default}" for n, t, default in self.parameters if default is not None]
        words = ([] if is_static else ["self"]) + required + optional
        owner = next((n for n, t, _ in self.parameters if t in KINDS.values()), None)
        keywords = [f"{n}: {t} = {default}" for n, t, default in self.keywords]
        if is_static and not owner:
            keywords.append("context: Optional[Context] = None")
        words += ["*"] + keywords if keywords else []
        hints = [t for _, t in self.results]
        hint = "None" if not hints else hints[0] if len(hints) == 1 else f"Tuple[{', '.join(hints)}]"
        if self.function.result.base != "lissom_status":
            hint = SCALARS[self.function.result.base]
        decorator = ["    @property"] if self.is_property() else ["    @staticmethod"] if is_static else []
        lines = decorator + ["    " + line for line in wrapped(f"def {self.name()}({', '.join(words)}) -> {hint}:")]
        lines.append(quoted(self.doc(), "        "))
        context = "self._context" if not is_static else f"{owner}._context" if owner else "context or default_context()"
        body = list(self.before)
        call = f"context._call('{self.function.name}'" + "".join(", " + a for a in self.arguments) + ")"
        if self.function.result.base == "lissom_status":
            returned = ", ".join(r for r, _ in self.results)
            body += [call] + ([f"return {returned}"] if returned else [])
        else:
            body.append(f"return {call}")
        body = ["            " + line for part in body for line in wrapped(part)]
        return lines + [f"        context = {context}", "        with context._lock:"] + body

    def doc(self):
        name = self.function.name[len("lissom_"):]
        returns_list = any(p.type.base == "lissom_output" for p in self.function.parameters)
        doc = DOCS.get(name) or plain(self.function.doc, returns_list)
        if not doc:
            raise SystemExit(f"generate.py: {self.function.name} has no comment")
        if self.function.experimental:
            doc += " Experimental: the next minor version may change it."
        fields = [f for s in self.objects.header.structs for f in s.fields
                  if any(p.type.base == s.name and p.type.const for p in self.function.parameters)]
        told = [f"`{f.name}`: {plain(f.doc)}" for f in fields if f.doc and any(f.name == n for n, _, _ in self.keywords)]
        return " ".join([doc] + told)


def wrapped(line):
    """A line of code, broken behind commas."""
    if len(line) < 108:
        return [line]
    for joined in (" = ", " -> ", ": "):
        line = line.replace(joined, joined.replace(" ", "\0"))
    lines = textwrap.wrap(line, 108, subsequent_indent="        ", break_long_words=False, break_on_hyphens=False)
    return [part.replace("\0", " ") for part in lines]


class Objects:
    """Writes the classes of objects."""

    def __init__(self, header):
        self.header = header
        self.enums = {enum.name: enum for enum in header.enums}

    def hint(self, type_):
        if type_.base in self.enums:
            return "Union[str, int]"
        if type_.base in SCALARS and not type_.stars:
            return "Sequence[float]" if type_.array else SCALARS[type_.base]
        if type_.base == "lissom_input":
            return ARRAY
        return KINDS.get(type_.base[len("lissom_"):], "Any")

    def kind_of(self, function):
        name = function.name
        for begin, kind in METHODS.items():
            if name.startswith(begin) and not re.match(r"lissom_merger_", name):
                return kind
        return max((k for k in KINDS if name.startswith(f"lissom_{k}_")), key=len, default=None)

    def write(self):
        methods = {kind: [] for kind in KINDS}
        for function in self.header.functions:
            if BY_HAND.match(function.name):
                continue
            methods[self.kind_of(function)].append(Method(self, function, self.kind_of(function)))
        lines = ['"""The objects of the C interface. Generated from lissom.h."""', "from __future__ import annotations", "",
                 "import ctypes as C", "from typing import Any, Mapping, Optional, Sequence, Tuple, Union", "",
                 "from . import _abi, _arrays", "from ._arrays import Array",
                 "from ._convert import (Join, Record, Transform, _bytes, _choice, _encoded, _handle_of, _handles, _joins,"
                 " _named_poses,", "                       _numbers, _points, _record, _strand_format, _strand_width, "
                 "_sliding_pins, _taken_bytes, _text, _texts,", "                       _transform, _transforms, _utf8)",
                 "from ._context import Context, Handle, _boundary_size, default_context", "from ._jobs import Job",
                 "from ._scripts import ScriptMethods", ""]
        structs = {s.name: s for s in self.header.structs}
        for kind, class_ in KINDS.items():
            base = "ScriptMethods, Handle" if kind == "script" else "Handle"
            lines += ["", f"class {class_}({base}):", quoted(self.class_doc(kind, structs), "    "),
                      f"    _kind = '{kind}'", f"    _struct = _abi.lissom_{kind}", ""]
            for method in methods[kind]:
                lines += method.write() + [""]
        return "\n".join(lines)

    @staticmethod
    def class_doc(kind, structs):
        docs = {"mesh": "A mesh: positions, polygons, attributes.", "region": "A set of vertices of a mesh.",
                "deformer": "A deformation of a mesh by handles.",
                "pose": "The transforms of a deformer's handles, as a value.",
                "pose_space": "Posed meshes of one topology, and their blends.",
                "merger": "A merge that is solved again with other keys.",
                "paste": "A feature on its way onto a mesh.", "hairstyle": "Curves that hair of a head follows.",
                "strands": "Hair: lines of points.", "render_map": "The vertices that an engine draws of a mesh.",
                "script": "A script with parameters; `lissom.run` runs one in a line."}
        return docs.get(kind) or plain(structs["lissom_" + kind].doc)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        header = read_header(file.read())
    os.makedirs(sys.argv[2], exist_ok=True)
    for name, text in (("_abi.py", Abi(header).write()), ("_objects.py", Objects(header).write())):
        with open(os.path.join(sys.argv[2], name), "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main()
