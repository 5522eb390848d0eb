#!/usr/bin/env python3
"""What is loaded with a program or a library, and which of its names others see.

    tests/embed/dynamic.py [--gpl] [--own-lua] KIND=FILE...

KIND is `program`, `library` (the C ABI), `module` (of Lua) or `archive`, a static library, which defines nothing of oneTBB. Counts the shared libraries that a process loads with
FILE, those of those included, and holds them against a limit. None is under the GPL, but that with --gpl a program
loads CHOLMOD. A library shows lissom_ functions alone, a module its entry point; with --own-lua a library has
its Lua inside.
"""
import argparse
import re
import subprocess
import sys

# Shared libraries in all, but for the loader.
MOST = {"program": 11, "library": 7, "module": 6}
# With CHOLMOD come those that it needs: its own siblings, BLAS, LAPACK, Fortran, METIS.
CHOLMOD = re.compile(r"lib(cholmod|c?c?amd|c?colamd|suitesparseconfig|metis|GKlib|(open)?blas|lapack|gfortran|"
                     r"quadmath|gomp)[.-]")
UNDER_THE_GPL = re.compile(r"lib(cholmod|umfpack|spqr|klu|readline|history|gmp|fftw3)[.-]")
# Names of oneTBB that a program may have from its own.
OF_TBB = re.compile(r"_ZNK?3tbb|_ZT.N3tbb")
SHOWN = {"library": re.compile(r"lissom_\w+$"), "module": re.compile(r"luaopen_lissom$")}


def loaded(text):
    """The libraries that ldd lists, without the loader and what the system kernel maps."""
    names = [line.split()[0].rsplit("/", 1)[-1] for line in text.splitlines() if line.strip()]
    return [name for name in names if not re.match(r"linux-(vdso|gate)|ld-|statically", name)]


def findings(kind, libraries, symbols, gpl, own_lua=False):
    """What is wrong with a file of `kind` that loads `libraries` and shows `symbols`."""
    if kind == "archive":
        taken = [name for name in symbols if OF_TBB.match(name)]
        return [f"defines {len(taken)} names of oneTBB: {' '.join(taken[:5])}"] if taken else []
    may = gpl and kind == "program"
    counted = [name for name in libraries if not (may and CHOLMOD.match(name))]
    found = []
    if len(counted) > MOST[kind]:
        found.append(f"loads {len(counted)} libraries, at most {MOST[kind]}: {' '.join(counted)}")
    licensed = [name for name in counted if UNDER_THE_GPL.match(name)]
    if licensed:
        found.append(f"loads libraries under the GPL: {' '.join(licensed)}")
    lua = [name for name in libraries if re.match(r"liblua", name)]
    if lua and (kind == "module" or (kind == "library" and own_lua)):
        found.append(f"brings a second Lua: {' '.join(lua)}")
    others = [name for name in symbols if kind in SHOWN and not SHOWN[kind].match(name)]
    if others:
        found.append(f"shows {len(others)} names that are not of its interface: {' '.join(others[:5])}")
    if kind in SHOWN and not symbols:
        found.append("shows nothing")
    return found


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="+", metavar="KIND=FILE")
    parser.add_argument("--gpl", action="store_true", help="the program links CHOLMOD")
    parser.add_argument("--own-lua", action="store_true", help="the library has its Lua inside")
    # CMake passes an empty word for an option that is off.
    options = parser.parse_args([word for word in sys.argv[1:] if word])
    count = 0
    for kind, path in (word.split("=", 1) for word in options.files):
        is_archive = kind == "archive"
        libraries = [] if is_archive else loaded(output_of("ldd", path))
        options_of_nm = ["--extern-only"] if is_archive else ["-D"]
        lines = output_of("nm", *options_of_nm, "--defined-only", path).splitlines()
        symbols = [line.split()[-1].split("@")[0] for line in lines if line.strip()]
        found = findings(kind, libraries, symbols, options.gpl, options.own_lua)
        count += len(found)
        print(f"{path}: {len(libraries)} libraries: {' '.join(libraries)}")
        print("".join(f"  {finding}\n" for finding in found), end="")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
