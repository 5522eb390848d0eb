#!/usr/bin/env python3
"""Whether each type that several sources can see is defined once.

    tests/headers/definitions.py

Two types of one name in one namespace are one type to the linker: it keeps one of the functions that templates
make for them, with the size of one of them, and the other's memory is overrun. No compiler tells. Prints such
names and their files. Types of anonymous namespaces, of functions and of classes are not looked at, nor are
those of tests.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("kernel", "bindings", "viewer")

LITERALS = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|//[^\n]*|/\*(?:.|\n)*?\*/')
# A definition of a type; of a member, as in `struct Context::State {`, it is none.
TOKENS = re.compile(r"namespace\s*(?P<space>[\w:]*)\s*\{"
                    r"|(?<!enum )\b(?:struct|class|union|enum(?:\s+class|\s+struct)?)\s+(?P<type>\w+)"
                    r"(?:\s+final)?\s*(?::(?!:)[^;{(]*)?\{"
                    r"|[{}]")


def types_of(text):
    """Yields the qualified names of the types that a source defines in named namespaces."""
    spaces, depth = [], 0
    for token in TOKENS.finditer(LITERALS.sub("", text)):
        if token.group() == "}":
            depth -= 1
            if len(spaces) > depth:
                spaces.pop()
            continue
        if token.group("space") is not None and depth == len(spaces):
            spaces.append(token.group("space"))
        elif token.group("type") and depth == len(spaces) and "" not in spaces:
            yield "::".join([*spaces, token.group("type")])
        depth += 1


def repeated(sources):
    """Returns the names that several of the sources, pairs of a name and a text, define, with their names."""
    found = defaultdict(set)
    for name, text in sources:
        for one in types_of(text):
            found[one].add(name)
    return {one: sorted(names) for one, names in found.items() if len(names) > 1}


def main():
    files = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*")) if path.suffix in (".h", ".cpp")]
    again = repeated((str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")) for path in files)
    for name, names in sorted(again.items()):
        print(f"{name} is defined in {' and '.join(names)}: rename one")
    print(f"{len(again)} findings in {len(files)} files")
    return 1 if again or not files else 0


if __name__ == "__main__":
    sys.exit(main())
