"""Contexts, and what all objects have."""
import atexit
import collections
import ctypes as C
import json
import logging
import threading
import weakref

from . import _abi
from ._arrays import given
from ._convert import Record, _choice, _handle_of, _text
from ._error import Error
from ._library import library

_log = logging.getLogger("lissom")
_LEVELS = {_abi.lissom_log_level.DEBUG: logging.DEBUG, _abi.lissom_log_level.INFO: logging.INFO,
           _abi.lissom_log_level.WARNING: logging.WARNING}
_WIDTHS = {"positions": 3, "normals": 3, "uvs": 2}
_open_contexts = weakref.WeakSet()


class Context:
    """Holds objects, and the services that Python has for the library: its log, progress and threads of jobs.

    Most programs need none: objects are made in `default_context()`. A context is used by one thread at a time, which a lock
    of its own sees to; different contexts work at once. `progress(label, fraction)` hears of the steps of a call; an
    exception in it, and Ctrl-C, stop the call. `memory_limit` is in bytes, 0 for none. The space is right-handed with y up,
    faces counter-clockwise seen from outside, unless the others are set.
    """

    def __init__(self, *, threads=None, memory_limit=0, progress=None, z_up=False, left_handed=False, clockwise=False):
        self._lock = threading.RLock()
        self._objects = weakref.WeakValueDictionary()
        self._released = collections.deque()
        self._tasks, self._task_count = {}, 0
        self._progress, self._failure = progress, None
        options = library.lissom_default_context_options()
        fields = dict(_abi.lissom_context_options._fields_)
        # The library calls these as long as the context lives.
        self._services = {"log": fields["log"](self._hear), "progress": fields["progress"](self._step),
                          "enqueue": fields["enqueue"](self._enqueue), "wait": fields["wait"](self._wait)}
        for name, service in self._services.items():
            setattr(options, name, service)
        options.memory_limit = memory_limit
        if threads is not None:
            options.threads = threads
        options.space = _abi.lissom_space(z_up, left_handed, clockwise)
        self._pointer = C.c_void_p()
        status = library.lissom_context_create(C.byref(options), C.byref(self._pointer))
        if status:
            raise Error(_text(library.lissom_status_name(status)), "the context cannot be made: "
                        + _text(library.lissom_status_explanation(status)))
        _open_contexts.add(self)

    # ---- Services, on any thread. An exception cannot go through C: it is raised when the call ends.

    def _hear(self, _, level, message):
        _log.log(_LEVELS.get(level, logging.INFO), "%s", _text(message))

    def _step(self, _, label, fraction):
        try:
            if self._progress:
                self._progress(_text(label), fraction)
        except BaseException as error:  # pylint: disable=broad-except
            self._failure = error
            library.lissom_cancel(self._pointer)

    def _enqueue(self, _, task, argument):
        thread = threading.Thread(target=task, args=(argument,), daemon=True)
        self._task_count += 1
        number = self._task_count
        self._tasks[number] = thread
        thread.start()
        return number

    def _wait(self, _, number):
        self._tasks.pop(number).join()

    # ---- Calls

    def _function(self, name, *arguments):
        if not self._pointer:
            raise Error("invalid_handle", "the context was closed")
        self._flush()
        return getattr(library, name)(self._pointer, *arguments)

    def _call(self, name, *arguments):
        """Calls a function: raises its error, or returns what it returns beside a status."""
        with self._lock:
            result = self._function(name, *arguments)
            self._raise_failure()
            returns = _abi.FUNCTIONS[name][1]
            if returns is C.c_int and result or returns is C.c_int32 and result == -1:
                self._raise()
            return result

    def _raise_failure(self):
        """Raises what a service has raised meanwhile."""
        failure, self._failure = self._failure, None
        if failure is not None:
            library.lissom_clear_cancel(self._pointer)
            raise failure

    def _raise(self):
        error = library.lissom_last_error(self._pointer).contents
        if error.status == _abi.lissom_status.OK:
            return
        element = _abi.lissom_element(error.element).name.lower().replace("no_element", "")
        raise Error(_text(error.code), _text(error.message), element, error.ids[:error.id_count], error.element_count)

    def _flush(self):
        """Frees the objects that nothing in Python names any more."""
        for _ in range(len(self._released)):
            kind, handle = self._released.popleft()
            if getattr(library, f"lissom_{kind}_release")(self._pointer, handle) == _abi.lissom_status.BUSY:
                self._released.append((kind, handle))

    def default(self, name):
        """Returns the struct NAME with its defaults."""
        return getattr(library, "lissom_default_" + name)()

    def filled(self, name, **values):
        """Returns the struct NAME with these values, and its defaults for the others."""
        struct = self.default(name)
        types = dict(struct._fields_)
        for field, value in values.items():
            if value is ...:
                continue
            kind = types[field]
            if isinstance(value, str):
                setattr(struct, field, _choice(value, _abi.CHOICES[type(struct).__name__, field]))
            elif kind is _abi.lissom_input:
                made = given(value, _WIDTHS.get(field, 1))
                struct.held = getattr(struct, "held", []) + [made]
                setattr(struct, field, made if made is not None else _abi.lissom_input())
            elif isinstance(value, Handle) or kind is _abi.lissom_region:
                setattr(struct, field, _handle_of(value, kind))
            elif issubclass(kind, C.Array):
                setattr(struct, field, kind(*value))
            else:
                setattr(struct, field, value)
        return struct

    def _object(self, number, kind):
        """Returns the object of a handle: the same as before if Python has it already; None for no object."""
        if not number:
            return None
        found = self._objects.get(number)
        if found is None:
            found = kind._of(self, number)
            self._objects[number] = found
        return found

    # ---- For all

    def call(self, name, *arguments, **options):
        """Calls a function of the Lua reference by name: "shapes.box", or "Mesh.smooth" with the mesh as first argument.
        Names are the table of options. Here ids count from 1 and angles are in degrees, as in scripts. Returns its result, a
        tuple of several, or None."""
        with self._lock:
            text = self.json_of([*arguments, options] if options else list(arguments)).encode()
            result = _abi.lissom_bytes()
            self._call("lissom_call", name.encode(), text, C.byref(result))
            return self.results_of(C.string_at(result.data, result.size))

    def json_of(self, values):
        """Returns values as the JSON of calls."""
        return json.dumps(values, default=_json_value, allow_nan=False)

    def results_of(self, text):
        """Returns the results in the JSON of a call: one as itself, several as a tuple, none as None."""
        results = tuple(self._from_json(value) for value in json.loads(text or b"[]"))
        return results if len(results) > 1 else results[0] if results else None

    def _from_json(self, value):
        if isinstance(value, list):
            return [self._from_json(one) for one in value]
        if isinstance(value, dict):
            if "object" in value and "type" in value:
                name = value["type"].split(".")[-1]
                return self._object(value["object"], Handle.classes.get(name, Handle.classes["Object"]))
            return {name: self._from_json(one) for name, one in value.items()}
        return value

    def cancel(self):
        """Stops calls that run in other threads: they raise the Error "cancelled". Later calls stop too, until `resume`."""
        library.lissom_cancel(self._pointer)

    def resume(self):
        """Lets calls run again after `cancel`."""
        library.lissom_clear_cancel(self._pointer)

    def sandbox(self, **limits):
        """Runs scripts and calls of this context in a sandbox from now on: `seconds`, `instructions`, `memory` and `output`
        limit each. Must come before the first script."""
        with self._lock:
            self._call("lissom_sandbox_scripts", C.byref(self.filled("sandbox_options", **limits)))

    @property
    def memory_used(self):
        """Bytes of objects and operations."""
        return library.lissom_memory_used(self._pointer)

    @property
    def object_count(self):
        """Number of objects."""
        with self._lock:
            self._flush()
            return library.lissom_object_count(self._pointer)

    def close(self):
        """Frees the context with all its objects; jobs are cancelled."""
        with self._lock:
            pointer, self._pointer = self._pointer, C.c_void_p()
            if pointer:
                library.lissom_context_destroy(pointer)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        if getattr(self, "_pointer", None):
            self.close()


class Handle:
    """An object of the library. It is freed once nothing names it, or by `release`."""
    classes = {}
    _kind = ""
    _struct = None

    def __init_subclass__(cls):
        if cls._kind:
            Handle.classes[cls.__name__] = cls

    def __init__(self):
        raise TypeError(f"{type(self).__name__} is made by its functions, as {type(self).__name__}.create")

    @classmethod
    def _of(cls, context, number):
        made = object.__new__(cls)
        made._context = context
        made._handle = cls._struct(number)
        made._finalizer = weakref.finalize(made, context._released.append, (cls._kind, cls._struct(number)))
        made._finalizer.atexit = False
        return made

    @property
    def context(self):
        """The context of the object."""
        return self._context

    def release(self):
        """Frees the object now. Errors: busy while a job works with it."""
        with self._context._lock:
            self._context._call(f"lissom_{self._kind}_release", self._handle)
            self._finalizer.detach()
            self._context._objects.pop(self._handle.id, None)

    def __repr__(self):
        return f"<lissom.{type(self).__name__} {self._handle.id}>"


def _boundary_size(mesh, number):
    count = C.c_int32()
    mesh._context._call("lissom_mesh_read_boundary", mesh._handle, number, None, C.byref(count))
    return count.value


def _json_value(value):
    if isinstance(value, Handle):
        return {"object": value._handle.id}
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Record):
        return vars(value)
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise TypeError(f"{type(value).__name__} is no argument of a script")


_default = None
_default_lock = threading.Lock()


def default_context():
    """Returns the context of objects that are made without one."""
    global _default  # pylint: disable=global-statement
    with _default_lock:
        if _default is None or not _default._pointer:
            _default = Context()
        return _default


@atexit.register
def _close_all():
    for context in list(_open_contexts):
        context.close()


