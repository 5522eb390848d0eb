#!/usr/bin/env python3
"""Whether the lists of public headers are complete: public_headers.txt of kernel, bindings and viewer.

    tests/headers/public.py [ROOT]

What is installed must be usable by itself: a public header includes only public ones and Eigen, the standard
library, Lua's or C's headers. `via` marks what is there for that alone: each of those is included by another
public header, so that none is installed for nothing, and there are few. Names are unique where they are installed.
"""
import re
import sys
from pathlib import Path

# Private headers of a folder that may come along.
MOST_DRAGGED = 15
FOLDERS = ("kernel", "kernel/thesis", "bindings", "viewer")
LIBRARIES = re.compile(r"Eigen/|lua\.h$|lauxlib\.h$|lualib\.h$|std\w+\.h$|math\.h$|string\.h$|[a-z_]+$")


def installed_name(header):
    """The path below include/, as cmake/LissomHeaders.cmake makes it."""
    short = re.sub(r"^(kernel|bindings/c|bindings/engine|bindings)/", "", header)
    return "lissom/" + short.replace("viewer/render/", "viewer/")


def read_list(root, folder):
    """Headers by their path from the root; True for those marked `via`."""
    path = root / folder / "public_headers.txt"
    lines = path.read_text().split("\n") if path.exists() else []
    names = [line for line in lines if line and not line.startswith("#")]
    return [(f"{folder}/{name.removeprefix('via ')}", name.startswith("via ")) for name in names]


def includes(root, header):
    text = (root / header).read_text()
    quoted = re.findall(r'^#include "([^"]+)"', text, re.M)
    beside = [Path(header).parent.joinpath(name).as_posix() for name in quoted]
    quoted = [near if "/" not in name else name for name, near in zip(quoted, beside)]
    return quoted, re.findall(r"^#include <([^>]+)>", text, re.M)


def findings(root):
    listed = [entry for folder in FOLDERS for entry in read_list(root, folder)]
    public = {header for header, _ in listed}
    found, included = [], set()
    for header in sorted({h for h in public if [name for name, _ in listed].count(h) > 1}):
        found.append(f"{header}: listed twice")
    names = [installed_name(header) for header in sorted(public)]
    found += [f"{name}: two headers of this name" for name in sorted({n for n in names if names.count(n) > 1})]
    for header in sorted(public):
        if not (root / header).exists():
            found.append(f"{header}: is not there")
            continue
        quoted, angled = includes(root, header)
        included |= set(quoted) - {header}
        found += [f"{header}: includes {name}, which is private" for name in quoted if name not in public]
        found += [f"{header}: shows <{name}>" for name in angled if not LIBRARIES.match(name)]
    found += [f"{header}: marked via, and nothing public includes it"
              for header, via in listed if via and header not in included]
    for folder in FOLDERS:
        dragged = sum(via for _, via in read_list(root, folder))
        if dragged > MOST_DRAGGED:
            found.append(f"{folder}: {dragged} private headers come along: at most {MOST_DRAGGED} may")
    return found


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    found = findings(root)
    print("\n".join(found + [f"{len(found)} findings"]))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
