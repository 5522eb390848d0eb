#!/usr/bin/env python3
"""Makes the add-on for Blender: make.py LIBRARY FOLDER writes a zip with the library and those that it needs; make.py
--unpacked FOLDER writes the add-on without a library, for tests (LISSOM_LIBRARY names one)."""
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path.insert(0, os.path.join(HERE, "..", "python"))

import wheel  # noqa: E402

NAME = "lissom_blender"
IGNORED = shutil.ignore_patterns("__pycache__", "tools")


def write_addon(folder):
    """Writes the add-on without the library: its own modules, the Python package, the Lua modules that ship, and scripts to
    start from."""
    shutil.copytree(os.path.join(HERE, "addon"), folder, ignore=IGNORED)
    wheel.make_package(os.path.join(folder, "lissom"))
    shutil.copytree(os.path.join(ROOT, "scripts"), os.path.join(folder, "lua"), ignore=IGNORED)
    shutil.copytree(os.path.join(ROOT, "examples", "hosts"), os.path.join(folder, "scripts"))
    for name in ("LICENSE", "NOTICE"):
        shutil.copy(os.path.join(ROOT, name), folder)


def add_library(library, folder):
    """Puts the library and those that it needs into the package, without symbols."""
    for name, path in [("liblissom.so", library)] + wheel.needed(library):
        subprocess.run(["strip", "--strip-unneeded", "-o", os.path.join(folder, "lissom", name), path], check=True)


def write_zip(folder, path):
    """Writes the files below a folder: the same bytes each time."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for place, folders, names in os.walk(folder):
            folders.sort()
            for name in sorted(names):
                file = os.path.join(place, name)
                with open(file, "rb") as content:
                    archive.writestr(wheel.entry(os.path.relpath(file, os.path.dirname(folder))), content.read())


def main():
    if sys.argv[1] == "--unpacked":
        write_addon(os.path.join(sys.argv[2], NAME))
        return
    library, out = os.path.realpath(sys.argv[1]), sys.argv[2]
    version = wheel.told_by(library, "lissom_version_text")
    path = os.path.join(out, f"lissom-blender-{version}.zip")
    with tempfile.TemporaryDirectory() as work:
        folder = os.path.join(work, NAME)
        write_addon(folder)
        add_library(library, folder)
        os.makedirs(out, exist_ok=True)
        write_zip(folder, path)
    print(path)


if __name__ == "__main__":
    main()
