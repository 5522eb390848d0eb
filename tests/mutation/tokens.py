"""Which tokens of a source are changed, and into what: comparisons, arithmetic, logic, signs and constants."""
import itertools
import re

# Operators stand between blanks, which tells them from templates, pointers and references.
OPERATORS = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==",
    "+": "-", "-": "+", "*": "/", "/": "*",
    "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=",
    "&&": "||", "||": "&&",
}
OPERATOR = re.compile(r"(?<= )(<=|>=|==|!=|\+=|-=|\*=|/=|&&|\|\||[<>+*/-])(?= |$)")
WORDS = {"true": "false", "false": "true", "std::min": "std::max", "std::max": "std::min"}
WORD = re.compile(r"\b(true|false|std::min|std::max)\b(?!<)(?!_)")
NUMBER = re.compile(r"(?<![\w.])(?<!\de[+-])(\d+(?:\.\d+)?(?:e[+-]?\d+)?)(f?)(?![\w.'])")
SIGN = re.compile(r"(?:(?<=[(,{\[] )|(?<=[(,{\[])|(?<=return )|(?<== )|(?<=[?:] ))-(?=[\w(])")
NOT = re.compile(r"(?<=[( ])!(?=[\w(])")
# Lines whose numbers and order no result depends on: how work is divided, progress, memory, costs, messages,
# how often a cancel is asked for.
NO_RESULT = re.compile(
    r"[Gg]rain|parallel_for|progress|reserve\(|charge\(|memory|scratch|costs\.|stats\.|_bytes|\bbytes\b|sizeof\(|_seconds|"
    r"Checkpoint|\.log\(|require\(|static_assert|^\s*(#|using |template)")
# Numbers between 0 and this stand for zero: half as much again is the same.
LEAST_NUMBER = 1e-5


def blanked(text):
    """The text with comments and the content of strings and characters blanked, all places kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\\n])\'', blank, text,
                  flags=re.S)


def other_number(text, suffix):
    if not re.search(r"[.e]", text):
        return str(int(text) + 1)
    value = float(text)
    other = "1.0" if value == 0.0 else f"{1.5 * value:.15g}"
    return other + ("" if re.search(r"[.e]", other) else ".0") + suffix


def candidates(text):
    """(offset, length, replacement) of every change of one token of a source."""
    offset = 0
    for line, written in zip(blanked(text).split("\n"), text.split("\n")):
        if not NO_RESULT.search(line) and '"' not in written:
            for match in OPERATOR.finditer(line):
                yield offset + match.start(), len(match.group()), OPERATORS[match.group()]
            for match in WORD.finditer(line):
                yield offset + match.start(), len(match.group()), WORDS[match.group()]
            for match in NUMBER.finditer(line):
                if 0.0 < float(match.group(1)) < LEAST_NUMBER:
                    continue
                yield offset + match.start(), len(match.group()), other_number(*match.groups())
            for match in itertools.chain(SIGN.finditer(line), NOT.finditer(line)):
                yield offset + match.start(), 1, ""
        offset += len(line) + 1
