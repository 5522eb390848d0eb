"""Lists of numbers in the memory of Python: read and written in place if their form allows, with numpy or without."""
import array
import ctypes
from typing import Any

from . import _abi

try:
    import numpy
except ImportError:
    numpy = None

#: A list of numbers or of rows of numbers: an array of numpy, any object with a buffer, or lists and tuples.
Array = Any

_Format = _abi.lissom_format
_FORMATS = {"f": _Format.FLOAT32, "d": _Format.FLOAT64, "e": _Format.FLOAT16, "B": _Format.UINT8, "H": _Format.UINT16}


class _View(ctypes.Structure):
    """Py_buffer of CPython."""
    _fields_ = [("buf", ctypes.c_void_p), ("obj", ctypes.py_object), ("len", ctypes.c_ssize_t),
                ("itemsize", ctypes.c_ssize_t), ("readonly", ctypes.c_int), ("ndim", ctypes.c_int),
                ("format", ctypes.c_char_p), ("shape", ctypes.POINTER(ctypes.c_ssize_t)),
                ("strides", ctypes.POINTER(ctypes.c_ssize_t)), ("suboffsets", ctypes.POINTER(ctypes.c_ssize_t)),
                ("internal", ctypes.c_void_p)]


_get = ctypes.pythonapi.PyObject_GetBuffer
_get.argtypes = [ctypes.py_object, ctypes.POINTER(_View), ctypes.c_int]
_release = ctypes.pythonapi.PyBuffer_Release
_release.argtypes = [ctypes.POINTER(_View)]
_STRIDED, _WRITABLE = 0x18 | 0x4, 0x1


class _Buffer:
    """The memory of an object, held while this lives."""

    def __init__(self, owner, writable=False):
        self._view = _View()
        _get(owner, self._view, _STRIDED | (_WRITABLE if writable else 0))
        self.address = self._view.buf
        self.itemsize = self._view.itemsize
        self.shape = self._view.shape[:self._view.ndim]
        self.strides = self._view.strides[:self._view.ndim]
        self.format = _format_of((self._view.format or b"B").decode(), self.itemsize)

    def __del__(self):
        _release(self._view)


def _format_of(text, size):
    """The format of a letter of the struct module; None for those that the library does not know."""
    letter = text.lstrip("@=<")
    if letter in ("i", "l", "I", "L") and size == 4:
        return _Format.INT32 if letter in "il" else _Format.UINT32
    return _FORMATS.get(letter)


def _elements(buffer, width):
    """Number of elements and bytes from one to the next; None if the memory is not so."""
    shape, strides, size = buffer.shape, buffer.strides, buffer.itemsize
    if len(shape) == 2 and shape[1] == width and (width == 1 or strides[1] == size) and strides[0] >= width * size:
        return shape[0], strides[0]
    if len(shape) == 1 and (width == 1 and strides[0] >= size or strides[0] == size) and shape[0] % width == 0:
        return shape[0] // width, strides[0] * width
    return None


def _flat(values, out):
    for value in values:
        if hasattr(value, "__iter__"):
            _flat(value, out)
        else:
            out.append(value)
    return out


def _copied(values, width):
    """The numbers in new memory: integers if there is one in an element, and all are."""
    flat = _flat(values.tolist() if hasattr(values, "tolist") else values, [])
    if len(flat) % width:
        raise ValueError(f"{len(flat)} numbers are no rows of {width}")
    whole = width == 1 and all(isinstance(value, int) for value in flat)
    return array.array("i" if whole else "d", flat)


def given(values, width):
    """Returns the list of an argument, or None for None. Memory is used in place if its format is known."""
    if values is None:
        return None
    if hasattr(values, "shape") and len(values.shape) == 2 and values.shape[1] != width:
        raise ValueError(f"rows of {width} numbers are expected, not of {values.shape[1]}")
    buffer, place = None, None
    try:
        buffer = _Buffer(values)
        place = _elements(buffer, width) if buffer.format is not None else None
    except TypeError:
        pass
    if place is None:
        buffer = _Buffer(_copied(values, width))
        place = _elements(buffer, width)
    result = _abi.lissom_input(buffer.address, place[0], place[1], buffer.format)
    result.held = buffer
    return result


class Written:
    """A list that a call writes: memory of the caller, or a new array."""

    def __init__(self, out, count, width, format_):
        self.array = _new(count, width, format_) if out is None else out
        if count == 0 and out is None:
            self.output = _abi.lissom_output(None, 0, 0, _Format.FLOAT64 if format_ == "d" else _Format.INT32)
            return
        buffer = _Buffer(self.array, writable=True)
        place = _elements(buffer, width)
        if place is None or buffer.format is None:
            raise ValueError(f"`out` needs {count} rows of {width} numbers, in memory row after row")
        self.output = _abi.lissom_output(buffer.address, place[0], place[1], buffer.format)
        self.output.held = buffer


def _new(count, width, format_):
    shape = (count,) if width == 1 else (count, width)
    if numpy:
        return numpy.empty(shape, numpy.float64 if format_ == "d" else numpy.int32)
    numbers = array.array(format_, bytes(array.array(format_).itemsize * count * width))
    return memoryview(numbers).cast("B").cast(format_, shape) if count else memoryview(numbers)
