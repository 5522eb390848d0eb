#!/usr/bin/env python3
"""Makes the wheel of the Python package: wheel.py LIBRARY FOLDER. The library goes in with those that it needs and that no
Linux has by itself; the tag names the C library that it needs."""
import base64
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
# Libraries that any Linux with the C library of the tag has, by the rules of manylinux, and those under the MIT licence that go into the wheel.
OF_THE_SYSTEM = re.compile(r"lib(c|m|dl|pthread|rt|gcc_s|stdc\+\+)\.so\.\d+$|ld-linux.*\.so\.\d+$")
TAKEN_IN = re.compile(r"libmeshoptimizer\.so")
TIME = (1980, 1, 1, 0, 0, 0)


def read_elf(option, library):
    return subprocess.run(["readelf", "-W", option, library], check=True, capture_output=True, text=True).stdout


def glibc_of(libraries):
    """The version of the C library that they need, (2, 36)."""
    versions = [tuple(map(int, version.split("."))) for library in libraries
                for version in re.findall(r"GLIBC_([\d.]+)", read_elf("--version-info", library))]
    return max(versions)[:2]


def needed(library):
    """Files of the libraries that it needs and that go into the wheel."""
    names = re.findall(r"\(NEEDED\).*\[(.+)\]", read_elf("--dynamic", library))
    paths = dict(re.findall(r"(\S+) => (\S+)", subprocess.run(["ldd", library], check=True, capture_output=True, text=True).stdout))
    files = []
    for name in names:
        if TAKEN_IN.match(name):
            files += [(name, paths[name])] + needed(paths[name])
        elif not OF_THE_SYSTEM.match(name):
            sys.exit(f"wheel.py: {library} needs {name}, which a wheel cannot have: build the preset 'wheel'")
    return files


def told_by(library, function):
    """A text that the library tells of itself."""
    code = (f"import ctypes, sys; f = ctypes.CDLL(sys.argv[1]).{function}; f.restype = ctypes.c_char_p; "
            "print(f().decode())")
    return subprocess.run([sys.executable, "-c", code, library], check=True, capture_output=True, text=True).stdout.strip()


def make_package(folder):
    """Writes the package without the library."""
    source = os.path.join(HERE, "lissom")
    shutil.copytree(source, folder, ignore=shutil.ignore_patterns("__pycache__"), dirs_exist_ok=True)
    subprocess.run([sys.executable, "-B", os.path.join(HERE, "generate.py"), os.path.join(HERE, "..", "c", "lissom.h"), folder],
                   check=True)


def metadata(version, tag):
    with open(os.path.join(HERE, "README.md"), encoding="utf-8") as file:
        description = file.read()
    about = (f"Metadata-Version: 2.1\nName: lissom\nVersion: {version}\n"
             "Summary: Deforms meshes by handles, merges them, and grooms hair\nLicense: MIT\n"
             "Requires-Python: >=3.8\nProvides-Extra: numpy\nRequires-Dist: numpy; extra == 'numpy'\n"
             f"Description-Content-Type: text/markdown\n\n{description}")
    wheel = f"Wheel-Version: 1.0\nGenerator: lissom\nRoot-Is-Purelib: false\nTag: {tag}\n"
    return {"METADATA": about.encode(), "WHEEL": wheel.encode(), "top_level.txt": b"lissom\n"}


def write_wheel(path, files):
    """Writes files, {name: bytes}, and the record of them: the same bytes each time."""
    record = next(name for name in files if name.endswith("/WHEEL")).replace("WHEEL", "RECORD")
    lines = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in sorted(files.items()):
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            lines.append(f"{name},sha256={digest},{len(content)}\n")
            archive.writestr(entry(name), content)
        archive.writestr(entry(record), "".join(lines) + f"{record},,\n")


def entry(name):
    info = zipfile.ZipInfo(name, TIME)
    info.compress_type = zipfile.ZIP_DEFLATED
    info.external_attr = 0o644 << 16
    return info


def main():
    library, out = os.path.realpath(sys.argv[1]), sys.argv[2]
    licence, version = told_by(library, "lissom_licence"), told_by(library, "lissom_version_text")
    if licence != "MIT":
        sys.exit(f"wheel.py: {library} is under {licence}: build the preset 'wheel'")
    others = needed(library)
    glibc = glibc_of([library] + [path for _, path in others])
    tag = f"py3-none-manylinux_{glibc[0]}_{glibc[1]}_{platform.machine()}"
    files = {}
    with tempfile.TemporaryDirectory() as folder:
        make_package(folder)
        for name, path in [("liblissom.so", library)] + others:
            subprocess.run(["strip", "--strip-unneeded", "-o", os.path.join(folder, name), path], check=True)
        for name in sorted(os.listdir(folder)):
            with open(os.path.join(folder, name), "rb") as file:
                files["lissom/" + name] = file.read()
    information = f"lissom-{version}.dist-info/"
    files.update({information + name: content for name, content in metadata(version, tag).items()})
    for name in ("LICENSE", "NOTICE"):
        with open(os.path.join(ROOT, name), "rb") as file:
            files[information + name] = file.read()
    os.makedirs(out, exist_ok=True)
    path = os.path.join(out, f"lissom-{version}-{tag}.whl")
    write_wheel(path, files)
    print(path)


if __name__ == "__main__":
    main()
