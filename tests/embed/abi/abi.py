#!/usr/bin/env python3
"""Compares lissom.h and liblissom with the list of the last release: bindings/c/abi.txt.

A program that was compiled with the header of the last release must go on working: every function is still
exported, with the types of its parameters and result, every callback has its types, every constant its value,
every field its place and size. Structs that begin with `struct_size` may have grown at the end, and functions,
structs and constants may have come in. What is LISSOM_EXPERIMENTAL is listed and may change.

    abi.py HEADER LIST LIBRARY COMPILER           compares; also: the library exports the header's functions alone
    abi.py HEADER LIST LIBRARY COMPILER --update  writes the list, at a release
"""

import pathlib
import re
import subprocess
import sys
import tempfile


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)


def functions(text):
    """The names of all functions that stay, as the linker knows them."""
    text = re.sub(r"LISSOM_EXPERIMENTAL LISSOM_API[^;]*;", "", text)
    return every_function(text)


def every_function(text):
    renamed = dict(re.findall(r"#define (lissom_\w+) (lissom_\w+)", text))
    names = re.findall(r"LISSOM_API[^;(]*?\b(lissom_\w+)\s*\(", text)
    return sorted(renamed.get(name, name) for name in names)


def without_name(parameter):
    """The type of `const double point[3]`: `const double[3]`."""
    bare = re.sub(r"\s+", " ", parameter.strip())
    if bare == "void":
        return ""
    bare = re.sub(r"(?<=[\s*])\w+(\[\d*\])?$", r"\1", bare) if re.search(r"[\s*]", bare) else bare
    return re.sub(r"\s*([*\[,])\s*", r"\1", bare).strip().replace(" ", "_")


def signature(result, parameters):
    depth, parts, start = 0, [], 0
    for i, letter in enumerate(parameters):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append(parameters[start:i])
            start = i + 1
    parts.append(parameters[start:])
    kept = re.sub(r"\s*([*])\s*", r"\1", re.sub(r"\s+", " ", result.strip())).replace(" ", "_")
    return kept + "(" + ",".join(without_name(part) for part in parts) + ")"


def signatures(text):
    """Lines of all functions and callbacks with their types."""
    renamed = dict(re.findall(r"#define (lissom_\w+) (lissom_\w+)", text))
    declared = r"(LISSOM_EXPERIMENTAL )?LISSOM_API\s+([^;(]*?)\b(lissom_\w+)\s*\(([^;]*)\);"
    for experimental, result, name, parameters in re.findall(declared, text):
        kind = "experimental" if experimental else "function"
        yield f"{kind} {renamed.get(name, name)} {signature(result, parameters)}"
    for result, name, parameters in re.findall(r"typedef (\w+) (lissom_\w+)\(([^;]*)\);", text):
        yield f"callback {name} {signature(result, parameters)}"
    for struct, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", text, re.S):
        for field in body.split(";"):
            found = re.fullmatch(r"\s*([^(]*)\(\*(\w+)\)\((.*)\)\s*", field, re.S)
            if found:
                yield f"callback {struct}.{found[2]} {signature(found[1], found[3])}"


def constants(text):
    names = ["LISSOM_ABI_VERSION"]
    for body in re.findall(r"typedef enum \w+ \{(.*?)\}", text, re.S):
        names += re.findall(r"(LISSOM_\w+)\s*=", body)
    return names


def field_name(declaration):
    callback = re.search(r"\(\*(\w+)\)", declaration)
    return callback.group(1) if callback else re.search(r"(\w+)\s*(\[\d+\])?$", declaration).group(1)


def structs(text):
    """Pairs of a struct's name and the names of its fields."""
    found = re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", text, re.S)
    return [(name, [field_name(line.strip()) for line in body.split(";") if line.strip()])
            for name, body in found]


def program(text):
    """A C program that prints what a compiler makes of the header."""
    lines = ["#include <stdio.h>", '#include "lissom.h"', "int main(void) {"]
    for name in constants(text):
        lines.append(f'    printf("constant {name} %d\\n", (int){name});')
    for name, fields in structs(text):
        lines.append(f'    printf("struct {name} %zu\\n", sizeof({name}));')
        for field in fields:
            lines.append(f'    printf("field {name}.{field} %zu %zu\\n", offsetof({name}, {field}),'
                         f" sizeof((({name}*)0)->{field}));")
    return "\n".join(lines + ["    return 0;", "}", ""])


def compiled(text, header, compiler):
    with tempfile.TemporaryDirectory() as folder:
        source, binary = pathlib.Path(folder, "abi.c"), pathlib.Path(folder, "abi")
        source.write_text(program(text))
        subprocess.run([*compiler.split(), "-xc", str(source), "-I", str(header.parent), "-o", str(binary)],
                       check=True)
        return subprocess.run([str(binary)], check=True, capture_output=True, text=True).stdout.splitlines()


def exported(library):
    """The names that programs can link with."""
    listing = subprocess.run(["nm", "--dynamic", "--defined-only", "--format=posix", library], check=True,
                             capture_output=True, text=True).stdout
    return sorted(line.split()[0].split("@")[0] for line in listing.splitlines())


def entries(lines):
    """{("field", "lissom_mesh.id"): "0 8", ...}"""
    table = {}
    for line in lines:
        kind, name, *values = line.split()
        table[kind, name] = " ".join(values)
    return table


def differences(before, now):
    """What a program of the last release would trip over, a line each."""
    extensible = {name.split(".")[0] for kind, name in before if name.endswith(".struct_size")}
    for (kind, name), value in before.items():
        found = now.get((kind, name))
        if kind == "experimental":
            continue
        if kind == "function" and value == "":  # Lists of old hold names alone.
            value = found or ""
        if found is None:
            yield f"{kind} {name} is gone"
        elif kind == "struct" and name in extensible:
            if int(found) < int(value):
                yield f"struct {name} has shrunk from {value} to {found} bytes"
        elif found != value:
            yield f"{kind} {name} was {value}, and is {found}"


def main(header, listed, library, compiler, *flags):
    text = without_comments(header.read_text())
    declared = every_function(text)
    lines = sorted(signatures(text)) + compiled(text, header, compiler)
    if flags == ("--update",):
        listed.write_text("\n".join(lines) + "\n")
        return 0
    found = list(differences(entries(listed.read_text().splitlines()), entries(lines)))
    names = exported(library)
    found += [f"function {name} is declared, but not exported" for name in declared if name not in names]
    found += [f"{name} is exported, but not declared" for name in names if name not in declared and
              name.startswith("lissom_")]
    found += [f"{name} is exported: hide it" for name in names if not name.startswith("lissom_")]
    for line in found:
        print(line)
    print(f"{len(declared)} functions, {len(names)} exported names, {len(found)} breaks")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), *sys.argv[3:]))
