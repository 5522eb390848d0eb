"""Lissom in Python: deformation of meshes by handles, merging, pasting, hair, and scripts in Lua.

    import lissom

    mesh = lissom.Mesh.load("arm.obj")
    deformer = lissom.Deformer.create(mesh, lissom.Region.all(mesh))
    deformer.pin(lissom.Region.sphere(mesh, (0, 0, 0), 0.2))
    hand = deformer.add_handle(lissom.Region.sphere(mesh, (0, 1, 0), 0.2))
    deformer.set_transform(hand, [[1, 0, 0, 0.3], [0, 1, 0, 0], [0, 0, 1, 0]])
    deformer.solve()
    deformer.apply(mesh)
    mesh.save("bent.obj")

Ids count from 0 and angles are in radians, as in the C interface; in scripts and in `call`, from 1 and in degrees, as in Lua.
Lists of numbers go in as arrays of numpy, other buffers or lists, in place if their form allows; they come out as arrays of
numpy if it is installed, else as memoryviews with rows, and any buffer given as `out` is written in place.
"""
from ._abi import ABI_VERSION
from ._context import Context, default_context
from ._convert import Join, Record
from ._error import Error
from ._jobs import Job
from ._library import library as _library
from ._objects import (Deformer, Hairstyle, Merger, Mesh, Object, Paste, Pose, PoseSpace, Region, RenderMap,
                       Script, Strands)
from ._scripts import load_script, run

__all__ = ["ABI_VERSION", "Context", "Deformer", "Error", "Hairstyle", "Job", "Join", "Merger", "Mesh", "Object", "Paste",
           "Pose", "PoseSpace", "Record", "Region", "RenderMap", "Script", "Strands", "call", "default_context", "licence",
           "load_script", "run"]
__version__ = _library.lissom_version_text().decode()


def call(name, *arguments, **options):
    """Calls a function of the Lua reference in the default context, see `Context.call`."""
    return default_context().call(name, *arguments, **options)


def licence():
    """Returns the licence that a program with this library may be distributed under."""
    return _library.lissom_licence().decode()
