"""Runs a script of examples/hosts by the Python package over the C interface, as hosts.lua does: hosts.py FOLDER NAME. Inside
Blender: blender --background --python hosts.py -- FOLDER NAME ADDON, with the folder that has the add-on."""
import os
import sys

arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
folder, name = arguments[:2]
if len(arguments) > 2:
    sys.path.insert(0, arguments[2])
    from lissom_blender import native, scripts
    lissom, context = native.lissom, native.new_context()
    run = scripts.Source(os.path.join(folder, name + ".lua")).load(context).run
else:
    import lissom
    context = lissom.default_context()
    run = lissom.load_script(os.path.join(folder, name + ".lua")).run

results = run()
for value in results if isinstance(results, tuple) else (results,):
    kind = type(value).__name__
    if kind in ("Mesh", "Strands"):
        print("HASH", name, context.call(kind + ".hash", value))
