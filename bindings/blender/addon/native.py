"""The library, or the reason why there is none."""

# The reason why the library cannot be loaded, else "".
problem = ""

try:
    from . import lissom
except ImportError as error:
    lissom = None
    problem = f"{error}; or install the add-on again from its zip"


def new_context(**services):
    """Returns a context with Blender's axes: z up."""
    return lissom.Context(z_up=True, **services)
