#!/usr/bin/env python3
"""Writes the C++ reference: a page of Markdown for each public header, with all that has a docstring.

    cmake/cpp_reference.py ROOT FOLDER

ROOT is the project; its public_headers.txt name the headers. FOLDER gets README.md, which lists the pages.
"""
import re
import sys
from pathlib import Path

FOLDERS = ("kernel", "kernel/thesis", "bindings", "viewer")


def installed_name(header):
    """The path below include/, as cmake/LissomHeaders.cmake makes it."""
    short = re.sub(r"^(kernel|bindings/c|bindings/engine|bindings)/", "", header)
    return "lissom/" + short.replace("viewer/render/", "viewer/")


def public_headers(root):
    for folder in FOLDERS:
        path = root / folder / "public_headers.txt"
        for line in path.read_text().split("\n") if path.exists() else []:
            if line and not line.startswith("#"):
                yield f"{folder}/{line.removeprefix('via ')}"


def declaration(lines, start):
    """The declaration that begins at a line, without the body of a function, a class or a list."""
    text = []
    for line in lines[start:start + 40]:
        text.append(line.split(" {")[0] if line.rstrip().endswith("{") else line)
        if re.search(r"[;{}]\s*(///.*)?$", line):
            break
    indent = min((len(line) - len(line.lstrip()) for line in text if line.strip()), default=0)
    return "\n".join(line[indent:] for line in text).strip()


def parts(text):
    """The introduction of a header, and pairs of a declaration and its docstring."""
    lines = text.split("\n")
    introduction, found, comment, begun = [], [], [], False
    for number, line in enumerate(lines):
        stripped = line.strip()
        if stripped.startswith("///") and not stripped.startswith("///<"):
            comment.append(stripped[3:].removeprefix(" "))
            continue
        if comment and not begun and (not stripped or stripped.startswith("#")):
            introduction = comment
        elif comment and stripped and not stripped.startswith(("//", "#if", "#endif")):
            found.append((declaration(lines, number), "\n".join(comment)))
        begun = begun or bool(stripped)
        comment = []
    return "\n".join(introduction), found


def page(header, text):
    introduction, found = parts(text)
    lines = [f"# <{installed_name(header)}>", "", introduction, ""]
    for code, comment in found:
        lines += ["```cpp", code, "```", "", comment, ""]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).rstrip() + "\n"


def summary(text):
    sentence = re.split(r"(?<=\.)\s", parts(text)[0].replace("\n", " "), maxsplit=1)
    return sentence[0].rstrip(":")


def main():
    root, folder = Path(sys.argv[1]), Path(sys.argv[2])
    rows = []
    for header in sorted(set(public_headers(root)), key=installed_name):
        text = (root / header).read_text()
        name = installed_name(header).removeprefix("lissom/").replace("/", "_").replace(".", "_") + ".md"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(page(header, text))
        rows.append(f"| [<{installed_name(header)}>]({name}) | {summary(text)} |")
    title = "# Lissom for C++ and C\n\nOne page a header; angles are radians, and ids count from 0.\n\n"
    (folder / "README.md").write_text(title + "| Header | Content |\n|---|---|\n" + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
