"""Scripts in Lua with objects of Python."""
import ctypes as C
import json
import os
import tempfile

from . import _abi
from ._context import Handle, default_context
from ._jobs import Job

# Files that objects become for parameters that take files: exact, and with all that the object has.
_EXTENSIONS = {"mesh": "glb", "strands": "hair"}


class ScriptMethods:
    """What a script can do."""

    def parameters(self):
        """Returns the parameters that the script declares: dictionaries with name, type, default, value, min, max, ..."""
        with self._context._lock:
            text = _abi.lissom_bytes()
            self._context._call("lissom_script_parameters", self._handle, C.byref(text))
            return json.loads(C.string_at(text.data, text.size))

    def set(self, **values):
        """Sets parameters by name. Errors: invalid_argument for a name that the script has not, or a value that it refuses.
        """
        for name, value in values.items():
            text = str(value).lower() if isinstance(value, bool) else str(value)
            self._context._call("lissom_script_set", self._handle, name.encode(), text.encode())

    def run(self, *arguments):
        """Runs the script with these arguments `...`. Returns its result, a tuple of several, or None."""
        context = self._context
        with context._lock:
            text, result = context.json_of(list(arguments)).encode(), _abi.lissom_bytes()
            context._call("lissom_script_run", self._handle, text, C.byref(result))
            return context.results_of(C.string_at(result.data, result.size))

    def begin_run(self, *arguments):
        """Starts the run as a job."""
        context = self._context
        with context._lock:
            job = _abi.lissom_job()
            context._call("lissom_script_begin_run", self._handle, context.json_of(list(arguments)).encode(), C.byref(job))
            return Job(context, job, None, False)


def load_script(path, *, context=None):
    """Loads a script from a file, up to its parameters."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return Handle.classes["Script"].load(text, os.path.basename(path), context=context)


def run(path, /, *arguments, context=None, **parameters):
    """Runs a script: `lissom.run("bend.lua", angle=30, mesh=mesh)`.

    Names are the script's own parameters (lissom.params); a Mesh or Strands for a parameter of a file, mesh or head is
    handed over as a file. Other arguments are those of the script, `...`, the
    objects themselves. Returns the script's result, a tuple of several, or None; meshes and hair are objects again.
    """
    given = [value for value in (*arguments, *parameters.values()) if isinstance(value, Handle)]
    context = context or (given[0].context if given else default_context())
    script = load_script(path, context=context)
    types = {one["name"]: one["type"] for one in script.parameters()}
    with tempfile.TemporaryDirectory(prefix="lissom-") as folder:
        for name, value in parameters.items():
            if isinstance(value, Handle):
                value = _as_text(value, name, types.get(name), folder)
            script.set(**{name: value})
        return script.run(*arguments)


def _as_text(value, name, type_, folder):
    """The text that stands for an object as the value of a parameter."""
    if value._kind in _EXTENSIONS and type_ in ("file", "mesh", "head", "string", None):
        path = os.path.join(folder, f"{name}.{_EXTENSIONS[value._kind]}")
        value.save(path)
        return path
    raise TypeError(f"parameter '{name}' takes no {type(value).__name__}: give it to the script as an argument, `...`")


