"""Finds the shared library and declares its functions."""
import ctypes
import ctypes.util
import glob
import os

from . import _abi


def _candidates():
    """Files that may be the library, the best first."""
    given = os.environ.get("LISSOM_LIBRARY")
    if given:
        return [given]
    here = os.path.dirname(os.path.abspath(__file__))
    beside = [name for pattern in ("liblissom.so", "liblissom.dylib", "lissom.dll")
              for name in glob.glob(os.path.join(here, pattern))]
    if beside:
        # Those that it needs come first: it then finds them by their names.
        for name in glob.glob(os.path.join(here, "lib*.so.*")):
            ctypes.CDLL(name)
    found = ctypes.util.find_library("lissom")
    return beside or ([found] if found else [])


def _open():
    for name in _candidates():
        try:
            return ctypes.CDLL(name), name
        except OSError as error:
            raise ImportError(f"the library of lissom cannot be loaded ({error}); if another library is missing, install "
                              "it, or name another build of lissom in LISSOM_LIBRARY") from error
    raise ImportError("the library of lissom is not found; install the wheel, or name liblissom.so in LISSOM_LIBRARY")


def _declare(library, name):
    """Sets the types of all functions."""
    for function, (symbol, result, parameters) in _abi.FUNCTIONS.items():
        try:
            declared = getattr(library, symbol)
        except AttributeError:
            raise ImportError(f"{name} is a library of another version than this package: it has no {symbol}") from None
        declared.restype = result
        declared.argtypes = parameters
        setattr(library, function, declared)
    return library


library = _declare(*_open())
