"""A source with mutants behind choices that are made when a program starts: choice.h."""
import re

from tokens import OPERATORS, blanked

KINDS = {"<": "Compare", "<=": "Compare", ">": "Compare", ">=": "Compare", "==": "Compare", "!=": "Compare",
         "+": "Arithmetic", "-": "Arithmetic", "*": "Arithmetic", "/": "Arithmetic",
         "+=": "Assign", "-=": "Assign", "*=": "Assign", "/=": "Assign"}


def operand_ends(text, offset, operator):
    """Begin of the left and end of the right operand of an && or || in a blanked text."""
    lower = r"[;,?]|(?<!:):(?!:)|(?<![=!<>+*/|&-])=(?!=)|\breturn\b"
    left = re.compile(lower + (r"|\|\|" if operator == "&&" else ""))
    right = re.compile(lower + (r"|\|\||&&" if operator == "&&" else r"|\|\|"))
    depth, begin = 0, offset
    while begin > 0:
        character = text[begin - 1]
        depth += (character in ")]}") - (character in "([{")
        ended = any(m.end() == begin for m in left.finditer(text, max(0, begin - 6), begin + 2))
        if depth < 0 or depth == 0 and ended:
            break
        begin -= 1
    depth, end = 0, offset + len(operator)
    while end < len(text):
        depth += (text[end] in "([{") - (text[end] in ")]}")
        if depth < 0 or depth == 0 and right.match(text, end):
            break
        end += 1
    return begin, end


def edits_of(number, mutant, plain):
    """(offset, length, replacement) that put a mutant behind its choice."""
    offset, length, replacement = mutant.offset, mutant.length, mutant.replacement
    before, choice = plain[offset:offset + length], f"mutants::Choice<{number}>"
    if before in ("&&", "||"):
        # By De Morgan's law: c != ((c != L) && (c != R)) is L && R, or L || R where c.
        begin, end = operand_ends(plain, offset, before)
        on = f"{choice}::on()"
        return [(begin, 0, f" ({on} != (({on} != bool("), (offset, length, f")) {before} ({on} != bool("),
                (end, 0, "))))")]
    if before in OPERATORS and replacement:
        return [(offset, length, f"{before} mutants::{KINDS[before]}<{number}>{{}} {before}")]
    if before in ("-", "!"):
        return [(offset, length, f"mutants::{'Sign' if before == '-' else 'Not'}<{number}>{{}} * ")]
    if before in ("std::min", "std::max"):
        return [(offset, length, f"mutants::{before[5:]}_of<{number}>")]
    edits = [(offset, length, f"({choice}::on() ? {replacement} : {before})")]
    line_begin = plain.rfind("\n", 0, offset) + 1
    known = re.compile(r"\bconstexpr\b").search(plain, line_begin, offset)
    return edits + ([(known.start(), 9, "const")] if known else [])


def with_choices(text, numbered):
    """A source with mutants behind choices, and the numbers of those that fit beside the others."""
    plain = blanked(text)
    edits, spans, fitting = [], [], []
    for number, mutant in numbered:
        added = [e for e in edits_of(number, mutant, plain) if e not in edits]
        span = added[0][0], added[-1][0]
        free = all(a + n <= b or b + m <= a for a, n, _ in added for b, m, _ in edits)
        # Operands of two logical operators may not overlap; any other token may stand within them.
        if free and (len(added) < 3 or all(span[1] < b or e < span[0] for b, e in spans)):
            edits += added
            spans += [span] if len(added) == 3 else []
            fitting.append(number)
    for offset, length, replacement in sorted(edits, reverse=True):
        text = text[:offset] + replacement + text[offset + length:]
    return text, fitting
