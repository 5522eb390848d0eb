"""Reads lissom.h: its enums, structs, functions and their comments."""
import re
from dataclasses import dataclass, field
from typing import List, Optional, Tuple


@dataclass
class Type:
    """A C type. `array` is the length of an array, `callback` the parameters and result of a function pointer."""
    base: str
    stars: int = 0
    const: bool = False
    array: Optional[int] = None
    callback: Optional[Tuple["Type", List["Parameter"]]] = None


@dataclass
class Parameter:
    name: str
    type: Type
    doc: str = ""


@dataclass
class Enum:
    name: str
    values: List[Tuple[str, int, str]]
    doc: str = ""


@dataclass
class Struct:
    """A struct without fields is known by pointers only."""
    name: str
    fields: List[Parameter]
    doc: str = ""


@dataclass
class Function:
    name: str
    symbol: str
    result: Type
    parameters: List[Parameter]
    doc: str = ""
    experimental: bool = False


@dataclass
class Header:
    abi: int = 0
    enums: List[Enum] = field(default_factory=list)
    structs: List[Struct] = field(default_factory=list)
    callbacks: List[Tuple[str, Type]] = field(default_factory=list)
    functions: List[Function] = field(default_factory=list)


def declarations(lines, separator, inherits=False):
    """Yields (comment, text) of each declaration that ends with `separator` outside of brackets. If it `inherits`, a
    declaration that follows another without a gap and a comment has the comment of that one, if it is in the plural."""
    comment, before, text, depth = [], "", "", 0
    for line in lines:
        code, _, trailing = line.partition("///")
        if trailing.startswith("<"):
            comment = [trailing[1:].strip()]
        elif trailing:
            comment.append(trailing.strip())
        code = code.split("//")[0].strip()
        if not code and not trailing and not text:
            comment, before = [], ""
        if re.match(r'#|extern "C" \{|\}$', code) and not text:
            continue
        text += " " + code if code else ""
        depth += sum(code.count(c) for c in "({") - sum(code.count(c) for c in ")}")
        if text and depth == 0 and code.endswith(separator):
            # "Return the numbers of ..." speaks of several.
            is_of_several = inherits and before and not before[0].split()[0].endswith("s")
            before = comment or (before if is_of_several else "")
            yield " ".join(before), re.sub(r"\s+", " ", text).strip().rstrip(separator)
            comment, text = [], ""
    if text.strip():
        yield " ".join(comment or before), re.sub(r"\s+", " ", text).strip()


def split(arguments):
    """Splits the text of parameters at the commas that separate them."""
    depth, parts = 0, [""]
    for c in arguments:
        depth += (c == "(") - (c == ")")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip() not in ("", "void")]


def declared(text, comment=""):
    """Returns the parameter or field that a text declares."""
    function = re.match(r"(.+?)\(\*\s*(\w+)\)\s*\((.*)\)$", text)
    if function:
        returns, name, arguments = function.groups()
        return Parameter(name, Type("", callback=(declared(returns + " x").type, [declared(a) for a in split(arguments)])),
                         comment)
    match = re.match(r"((?:const |struct |enum )*)(\w+)((?:\s|\*|\bconst\b)*?)(\w+)?(?:\[(\d+)\])?$", text)
    if not match:
        raise SyntaxError("lissom.h: cannot read: " + text)
    words, base, stars, name, array = match.groups()
    return Parameter(name or "", Type(base, stars.count("*"), "const" in words, int(array) if array else None), comment)


def read_enum(name, body, comment):
    values = []
    for doc, text in declarations(body, ","):
        key, value = (part.strip() for part in text.split("="))
        values.append((key, int(value), doc))
    return Enum(name, values, comment)


def read_struct(name, body, comment):
    fields = []
    for doc, text in declarations(body, ";"):
        first, *others = text.split(", ") if "(" not in text else [text]
        fields.append(declared(first, doc))
        fields += [Parameter(other, fields[-1].type, doc) for other in others]
    return Struct(name, fields, comment)


def bodies(lines):
    """Returns the lines without the bodies of structs and enums, and these bodies by name."""
    left, found, at = [], {}, 0
    while at < len(lines):
        match = re.match(r"typedef (struct|enum) (\w+) \{(.*)", lines[at])
        if not match:
            left.append(lines[at])
        elif "}" in match.group(3):
            found[match.group(2)] = [value + "," for value in match.group(3).split("}")[0].split(",")]
            left.append(f"typedef {match.group(1)} {match.group(2)} body;")
        else:
            end = next(i for i in range(at, len(lines)) if lines[i].startswith("}"))
            found[match.group(2)] = lines[at + 1:end]
            left.append(f"typedef {match.group(1)} {match.group(2)} body;")
            at = end
        at += 1
    return left, found


def read_function(text, comment, renamed):
    experimental = "LISSOM_EXPERIMENTAL" in text
    text = re.sub(r"\bLISSOM_(API|EXPERIMENTAL)\b", "", text).strip()
    match = re.match(r"(.+?)\b(lissom_\w+)\s*\((.*)\)$", text)
    if not match:
        raise SyntaxError("lissom.h: cannot read: " + text)
    returns, name, arguments = match.groups()
    return Function(name, renamed.get(name, name), declared(returns.strip() + " x").type,
                    [declared(a) for a in split(arguments)], comment, experimental)


def read_header(text):
    """Returns all that the text of lissom.h declares."""
    header = Header(int(re.search(r"#define LISSOM_ABI_VERSION (\d+)", text).group(1)))
    renamed = dict(re.findall(r"#define (lissom_\w+) (lissom_\w+)", text))
    lines, found = bodies(text.splitlines())
    for comment, declaration in declarations(lines, ";", inherits=True):
        match = re.match(r"typedef (struct|enum) (\w+) (\w+)$", declaration)
        callback = re.match(r"typedef (\w+) (\w+)\((.*)\)$", declaration)
        if match and match.group(1) == "enum":
            header.enums.append(read_enum(match.group(2), found[match.group(2)], comment))
        elif match:
            header.structs.append(read_struct(match.group(2), found.get(match.group(2), []), comment))
        elif callback:
            type_ = declared(f"{callback.group(1)} (*x)({callback.group(3)})").type
            header.callbacks.append((callback.group(2), type_))
        else:
            header.functions.append(read_function(declaration, comment, renamed))
    return header
