#!/usr/bin/env python3
"""Whether the public headers include what they use.

    tests/headers/uses.py [--fix] [HEADER...]

Finds the names of the standard library and of the kernel that a header writes, and the header that declares
each; that must be among its own includes. Prints what is missing, and headers of the kernel that are included
for no name, and names in all sources that the library of emscripten lacks. `--fix` adds what is missing; run clang-format afterwards. Reads text, so that it takes a second:
names that several headers declare, members and macros are not looked at.
"""
import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Includes of a header that are part of what it offers.
EXPORTS = {"kernel/core/geometry.h": {"kernel/core/index.h"}}

STANDARD = {
    "algorithm": "all_of any_of clamp copy fill find lower_bound max min sort",
    "array": "array", "atomic": "atomic", "bit": "bit_cast countr_zero has_single_bit popcount",
    "chrono": "chrono", "cmath": "abs cos exp isfinite pow sin sqrt", "compare": "strong_ordering",
    "complex": "complex", "condition_variable": "condition_variable",
    "cstddef": "byte ptrdiff_t size_t",
    "cstdint": "int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t",
    "cstring": "memcpy", "deque": "deque", "exception": "exception", "filesystem": "filesystem",
    "functional": "function hash less", "initializer_list": "initializer_list",
    "iosfwd": "istream ostream", "iterator": "iterator_traits", "limits": "numeric_limits",
    "list": "list", "map": "map multimap",
    "memory": "enable_shared_from_this make_shared make_unique shared_ptr unique_ptr weak_ptr",
    "mutex": "call_once lock_guard mutex once_flag unique_lock", "numeric": "accumulate iota",
    "optional": "nullopt optional", "queue": "priority_queue queue", "set": "set",
    "span": "as_bytes span", "stdexcept": "runtime_error", "string": "string to_string",
    "string_view": "string_view", "thread": "thread", "tuple": "tie tuple",
    "type_traits": "decay_t enable_if_t invoke_result_t is_same_v remove_cvref_t",
    "unordered_map": "unordered_map", "unordered_set": "unordered_set",
    "utility": "exchange forward make_pair move pair swap",
    "variant": "get_if holds_alternative monostate variant visit", "vector": "vector",
}
# Other headers that bring the same names by the standard.
BRINGS = {"iosfwd": {"fstream", "iostream", "istream", "ostream", "sstream"},
          "utility": {"map", "tuple", "unordered_map"},
          "initializer_list": {"map", "string", "vector"}, "exception": {"stdexcept"}}
HOME = {name: header for header, names in STANDARD.items() for name in names.split()}

DECLARED = [
    r"^(?:template <[^\n]*>\n)?(?:class|struct|enum class|enum) (\w+)(?: final)?(?: :[^{;]*)?\s*\{",
    r"^using (\w+) =",
    r"^inline constexpr [\w:]+ (\w+)",
]
# Names that need no header: declared for later, inside of classes, of templates.
OWN = [r"^(?:class|struct|enum class) (\w+)(?: : \w+)?;", r"friend (?:class|struct) (\w+);",
       r"^ +(?:class|struct|enum class|enum|using) (\w+)", r"typename (\w+)"]


# Names of C++20 that the library of emscripten lacks, and the header that stands in for them.
LACKING = re.compile(r"std::(bit_cast|make_unique_for_overwrite|make_shared_for_overwrite|format|jthread|atomic_ref)\b")
STAND_IN = "kernel/core/numbers/bits.h"


class Header:
    def __init__(self, name):
        self.name = name
        text = (ROOT / name).read_text()
        self.includes = set(re.findall(r'^#include [<"]([^>"]+)[>"]', text, re.M))
        text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
        self.body = re.sub(r'^#.*$|"(?:\\.|[^"\\\n])*"', "", text, flags=re.M)
        self.declared = {name for pattern in DECLARED for name in re.findall(pattern, self.body, re.M)}
        # Also inside of classes and templates, where they are names of its own.
        self.forward = {name for pattern in OWN for name in re.findall(pattern, self.body, re.M)}
        self.standard = set(re.findall(r"\bstd::(\w+)", self.body))
        self.words = set(re.findall(r"(?<![\w.])([A-Za-z_]\w+)", self.body))

    def reached(self):
        """Its includes with what they offer beside their own."""
        return self.includes.union(*(EXPORTS.get(header, ()) for header in self.includes))


def missing(header, homes):
    reached = header.reached()
    found = set()
    for name in header.standard & HOME.keys():
        home = HOME[name]
        if home not in reached and not BRINGS.get(home, set()) & reached:
            found.add(f"<{home}>")
    for name in header.words & homes.keys():
        # Capitals: words in small letters are names of members and arguments as well.
        if name[0].isupper() and name not in header.declared | header.forward and len(homes[name]) == 1:
            home = next(iter(homes[name]))
            if home not in reached:
                found.add(f'"{home}"')
    return found


def unused(header, headers):
    found = set()
    for name in header.includes & headers.keys():
        offered = headers[name].declared.union(*(headers[e].declared for e in EXPORTS.get(name, ())))
        functions = set(re.findall(r"\b(\w+)\(", headers[name].body))
        # A header that declares nothing passes on that of a library.
        if (offered | functions) and not (offered | functions) & header.words:
            found.add(name)
    return found - EXPORTS.get(header.name, set())


def lacking():
    """Lines of sources for pages with a name that their library lacks."""
    for room in ("kernel", "bindings/c", "bindings/lua", "bindings/wasm"):
        for path in sorted((ROOT / room).rglob("*.[hc]*")):
            name = path.relative_to(ROOT).as_posix()
            if path.suffix not in (".h", ".cpp") or name == STAND_IN:
                continue
            for number, line in enumerate(path.read_text().split("\n"), 1):
                for found in LACKING.findall(line.split("//")[0]):
                    yield f"{name}:{number}: std::{found} is not in the library of emscripten ({STAND_IN})"


def add(header, includes):
    path = ROOT / header.name
    lines = path.read_text().split("\n")
    places = [i for i, line in enumerate(lines) if line.startswith("#include")]
    if not places:
        places = [lines.index("#pragma once") + 1]
        lines.insert(places[0], "")
    for include in sorted(includes):
        kind = include[0]
        same = [i for i in places if lines[i].startswith(f"#include {kind}") and "Eigen" not in lines[i]]
        if same:
            lines.insert(same[0], f"#include {include}")
        elif kind == "<":
            lines[places[0]:places[0]] = [f"#include {include}", ""]
        else:
            lines[places[-1] + 1:places[-1] + 1] = ["", f"#include {include}"]
        places = [i for i, line in enumerate(lines) if line.startswith("#include")]
    path.write_text("\n".join(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("headers", nargs="*", help="paths from the root (default: all of the kernel)")
    parser.add_argument("--fix", action="store_true", help="add what is missing")
    options = parser.parse_args()
    headers = {path.relative_to(ROOT).as_posix(): None for path in sorted((ROOT / "kernel").rglob("*.h"))}
    headers = {name: Header(name) for name in headers}
    homes = {}
    for header in headers.values():
        for name in header.declared:
            homes.setdefault(name, set()).add(header.name)
    findings = 0
    for name in options.headers or headers:
        lacks, idle = missing(headers[name], homes), unused(headers[name], headers)
        findings += len(lacks) + len(idle)
        for include in sorted(lacks):
            print(f"{name}: uses names of {include}")
        for include in sorted(idle):
            print(f"{name}: uses no name of \"{include}\"")
        if options.fix and lacks:
            add(headers[name], lacks)
    for finding in [] if options.headers else lacking():
        findings += 1
        print(finding)
    print(f"{findings} findings in {len(options.headers or headers)} headers", file=sys.stderr)
    return 1 if findings and not options.fix else 0


if __name__ == "__main__":
    sys.exit(main())
