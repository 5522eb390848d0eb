#!/usr/bin/env python3
"""Counts words that make prose hard to read, in comments, documentation and messages.

    tests/words/words.py [ROOT]                the folders of clean.txt hold the limits; prints a table of all
    tests/words/words.py --show FOLDER [ROOT]  the lines of FOLDER with such words

Counted per 1,000 words: "what", "where", sentences that begin with Of, As, What, Where or Whose; at most LIMITS.
Docstrings (comments with three slashes in C and C++ headers) say "return" at least LEAST_RETURNS times per 1,000 words,
and none begins with a clause ("How a loop is measured"): a verb or the field's noun stands there.
A limit is rounded to the next count that allows more, so that one word in a short folder is none too many.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

LIMITS = {"what": 1.0, "openings": 0.5, "where": 1.5}
LEAST_RETURNS = 2.5
FOLDERS = ("kernel", "bindings", "viewer", "scripts", "examples", "docs")
CODE = {".h", ".hpp", ".cpp", ".c", ".lua"}
PATTERNS = {"what": re.compile(r"\bwhat\b", re.I), "where": re.compile(r"\bwhere\b", re.I),
            "openings": re.compile(r"(?:(?<=\A)|(?<=[.!?] )|(?<=[.!?]\) ))(?:Of|As|What|Where|Whose)\b"),
            "returns": re.compile(r"\breturn(?:s|ed)?\b", re.I),
            "clauses": re.compile(r"\A(?:How|What|When|Where|Which|Who|Whose|Why)\b")}
IN_DOCSTRINGS = ("returns", "clauses")
WORD = re.compile(r"[A-Za-z][A-Za-z']*")
CPP_TOKEN = re.compile(r"""(?P<block>/\*.*?\*/)|(?P<line>//[^\n]*)|R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"|(?P<string>"(?:\\.|[^"\\\n])*")"""
                       r"""|'(?:\\.|[^'\\\n])+'""", re.S)
LUA_TOKEN = re.compile(r"""--\[(?P<level>=*)\[(?P<block>.*?)\](?P=level)\]|(?P<line>--[^\n]*)|\[(?P<mark>=*)\[(?P<raw>.*?)\](?P=mark)\]"""
                       r"""|(?P<string>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')""", re.S)


class Passage:
    """Prose that belongs together: a comment, a message or a paragraph; `lines` are pairs of number and text."""

    def __init__(self, number, text, docstring=False, message=False):
        self.lines = [(number + i, line.strip()) for i, line in enumerate(text.split("\n"))]
        self.docstring = docstring
        self.message = message

    def text(self):
        return " ".join(line for _, line in self.lines).strip()

    def line_at(self, offset):
        for number, line in self.lines:
            if offset <= len(line):
                return number, line
            offset -= len(line) + 1
        return self.lines[-1]


def is_prose(message):
    """A string of code counts as a message if it reads like a sentence: at least three words, two of them apart."""
    return len(WORD.findall(message)) >= 3 and re.search(r"[a-z]+,? [a-z]+", message)


def comment_text(comment):
    return re.sub(r"^(?:///?<?|---?) ?|^/\*+|\*+/$|^\s*\* ?", "", comment.strip(), flags=re.M)


def is_continued(last, number, is_docstring, source, start):
    """Whether a line comment goes on with the one of the line before: it stands alone on its line, as that does."""
    alone = not source[source.rfind("\n", 0, start) + 1:start].strip()
    return alone and last and last[0] == number - 1 and last[1] == is_docstring


def code_passages(source, suffix):
    """Comments and messages; consecutive line comments are one passage, and so are strings that the compiler joins."""
    found, last_comment, last_string = [], None, None
    for match in (LUA_TOKEN if suffix == ".lua" else CPP_TOKEN).finditer(source):
        number = source.count("\n", 0, match.start()) + 1
        groups = match.groupdict()
        if groups["line"] is not None:
            docstring = match.group().startswith("///") and suffix in {".h", ".hpp"}
            text = comment_text(match.group())
            if is_continued(last_comment, number, docstring, source, match.start()) and text:
                found[-1].lines.append((number, text.strip()))
            elif text:
                found.append(Passage(number, text, docstring))
            alone = not source[source.rfind("\n", 0, match.start()) + 1:match.start()].strip()
            last_comment, last_string = ((number, docstring) if alone and text else None), None
        elif groups["block"] is not None:
            docstring = match.group().startswith("/**") and suffix in {".h", ".hpp"}
            for offset, paragraph in paragraphs(comment_text(match.group())):
                found.append(Passage(number + offset, paragraph, docstring))
            last_comment = last_string = None
        elif groups["raw"] is not None or groups["string"]:
            text = groups["raw"] if groups["raw"] is not None else groups["string"][1:-1].replace("\\n", " ")
            joins = last_string is not None and not source[last_string:match.start()].strip()
            if joins and found:
                found[-1].lines.append((number, text.strip()))
            else:
                found.append(Passage(number, text, message=True))
            last_comment, last_string = None, match.end()
    return [p for p in found if not p.message or is_prose(p.text())]


def paragraphs(text):
    """Paragraphs and items of lists, each with the number of lines before it."""
    found, current = [], None
    for number, line in enumerate(text.split("\n")):
        if not line.strip():
            current = None
        elif current is None or re.match(r"\s*(?:[-*|#>]|\d+\.) ?", line):
            current = [number, [re.sub(r"^\s*(?:[-*>#]+|\d+\.) ", "", line)]]
            found.append(current)
        else:
            current[1].append(line)
    return [(number, "\n".join(lines)) for number, lines in found]


def document_passages(text):
    """Paragraphs of Markdown without its code and the targets of its links."""
    text = re.sub(r"^( *)```.*?^ *```", lambda m: "\n" * m.group().count("\n"), text, flags=re.M | re.S)
    text = re.sub(r"`[^`\n]*`", "`code`", text)
    text = re.sub(r"\]\([^)\s]*\)", "]", text)
    return [Passage(number + 1, paragraph) for number, paragraph in paragraphs(text)]


def passages(path):
    text = path.read_text(errors="replace")
    return code_passages(text, path.suffix) if path.suffix in CODE else document_passages(text)


class Count:
    def __init__(self):
        self.words = self.docstring_words = 0
        self.hits = dict.fromkeys(PATTERNS, 0)

    def add(self, passage):
        text = passage.text()
        words = len(WORD.findall(text))
        self.words += words
        for name in LIMITS:
            self.hits[name] += len(PATTERNS[name].findall(text))
        if passage.docstring:
            self.docstring_words += words
            for name in IN_DOCSTRINGS:
                self.hits[name] += len(PATTERNS[name].findall(text))

    def merge(self, other):
        self.words += other.words
        self.docstring_words += other.docstring_words
        for name, hits in other.hits.items():
            self.hits[name] += hits

    def rate(self, name):
        words = self.docstring_words if name in IN_DOCSTRINGS else self.words
        return 1000 * self.hits[name] / words if words else 0.0

    def excess(self):
        """The names of the limits that do not hold."""
        found = [name for name, limit in LIMITS.items() if self.hits[name] > -(-limit * self.words // 1000)]
        if self.hits["returns"] < LEAST_RETURNS * self.docstring_words // 1000:
            found.append("returns")
        if self.hits["clauses"]:
            found.append("clauses")
        return found


def sources(root):
    """The files whose prose people read, but for tests and generated pages."""
    generated = re.compile(r"docs/reference/|docs/lua/|bindings/lua/meta/|viewer/meta/")
    files = [path for folder in FOLDERS for path in (root / folder).rglob("*")] + list(root.glob("*.md"))
    names = [path.relative_to(root).as_posix() for path in files
             if path.suffix in CODE | {".md"} and path.is_file()]
    return sorted(name for name in names if not generated.match(name))


def count_files(root):
    counts = {}
    for name in sources(root):
        counts[name] = Count()
        for passage in passages(root / name):
            counts[name].add(passage)
    return counts


def is_in(name, folder):
    return name == folder or name.startswith(folder + "/")


def count_of(counts, folder):
    total = Count()
    for name, count in counts.items():
        if folder == "." or is_in(name, folder):
            total.merge(count)
    return total


def read_clean(root):
    lines = (root / "tests/words/clean.txt").read_text().split("\n")
    return [line for line in lines if line and not line.startswith("#")]


def findings(root, counts=None):
    """A line for each limit that a clean folder exceeds, or that has no file."""
    counts = counts or count_files(root)
    found = []
    for folder in read_clean(root):
        count = count_of(counts, folder)
        if count.words == 0:
            found.append(f"{folder}: no prose is there")
        for name in count.excess():
            bound = f"at least {LEAST_RETURNS}" if name == "returns" else f"at most {LIMITS.get(name, 0)}"
            found.append(f"{folder}: {name} {count.rate(name):.1f} per 1,000 words, {bound} (--show {folder})")
    return found


def table(root, counts):
    clean = read_clean(root)
    rows = defaultdict(Count)
    for name, count in counts.items():
        parts = name.split("/")
        rows["/".join(parts[:2]) if len(parts) > 2 else parts[0]].merge(count)
    rows["all"] = count_of(counts, ".")
    lines = [f"{'per 1,000 words':24} {'words':>7} {'what':>6} {'Of As.':>6} {'where':>6} {'return':>6}"]
    for name, count in rows.items():
        rates = [f"{count.rate(key):6.1f}" for key in ("what", "openings", "where", "returns")]
        mark = "  clean" if name in clean else ""
        lines.append(f"{name:24} {count.words:7} {' '.join(rates)}{mark}")
    return "\n".join(lines)


def show(root, folder):
    """Each line with a counted word, once."""
    lines = []
    for name in sources(root):
        if not is_in(name, folder):
            continue
        hits = set()
        for passage in passages(root / name):
            for key in [*LIMITS, *(["clauses"] if passage.docstring else [])]:
                hits |= {passage.line_at(match.start()) for match in PATTERNS[key].finditer(passage.text())}
        lines += [f"{name}:{number}: {line}" for number, line in sorted(hits)]
    return "\n".join(lines)


def main():
    arguments = sys.argv[1:]
    folder = None
    if arguments[:1] == ["--show"]:
        folder = arguments[1].rstrip("/")
        arguments = arguments[2:]
    root = Path(arguments[0]) if arguments else Path(__file__).resolve().parents[2]
    if folder:
        print(show(root, folder))
        return 0
    counts = count_files(root)
    print(table(root, counts))
    found = findings(root, counts)
    print("\n".join(found) or "clean folders hold the limits")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
