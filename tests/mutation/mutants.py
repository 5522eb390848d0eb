#!/usr/bin/env python3
"""Changes one token of the kernel at a time and asks whether the unit tests notice.

    tests/mutation/mutants.py [--count 200] [--seconds N] [--seed N] [--modules deform,merge,hair,solve]

Mutants are chosen at random, the same for a seed, as many of each module: comparisons, arithmetic, logic,
signs and constants of the .cpp files that the release build compiles. All are compiled at once into a copy
of the tree in build/mutation, each behind a choice that the variable LISSOM_MUTANT makes when the tests start
(choice.h). What does not compile so, a constant that the compiler must know for one, is compiled alone.
The unit tests of a mutant's module run: first those of its own file, then the others, the slow ones last.
What ends with a failed test, a crash or a time-out is killed; what does not compile does not count, and
another takes its place.

Outcomes are written to build/mutation/results.tsv one by one, so that a run that was ended goes on where it
stopped, as long as the tree, the seed and the count are the same. The working tree is only read. Prints a
table and the survivors, each with its number, so that
    LISSOM_MUTANT=17 build/mutation/tree/build/release/tests/unit/deform/test_deform
shows what a test makes of it; the exit status is 0 where at least 85 % are killed, 1 where fewer are, and 2
where --seconds ended the run before.
"""
import argparse
import hashlib
import itertools
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "mutation"
TREE = WORK / "tree"
RESULTS = WORK / "results.tsv"
REQUIRED = 0.85
# A mutant is given so many times as long as the tests take without it, at least LEAST_SECONDS.
PATIENCE = 4
LEAST_SECONDS = 20
# Test cases that take longer run last.
SLOW_SECONDS = 4
# Of so many mutants more than asked for, those take the place of what does not compile.
SPARE = 1.15

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
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?|\d+)(f?)(?![\w.'])")
SIGN = re.compile(r"(?:(?<=[(,{\[] )|(?<=[(,{\[])|(?<=return )|(?<== )|(?<=[?:] ))-(?=[\w(])")
NOT = re.compile(r"(?<=[( ])!(?=[\w(])")
# Lines whose numbers and order no result depends on: how work is divided, progress, memory, costs, messages,
# how often a cancel is asked for.
NO_RESULT = re.compile(
    r"[Gg]rain|parallel_for|progress|reserve\(|charge\(|memory|scratch|costs\.|stats\.|_bytes|_seconds|"
    r"Checkpoint|\.log\(|require\(|static_assert|^\s*(#|using |template)")
# Numbers between 0 and this stand for zero: half as much again is the same.
LEAST_NUMBER = 1e-5


def sources(module):
    return sorted((ROOT / "kernel" / module).rglob("*.cpp"))


def blanked(text):
    """The text with comments and the content of strings and characters blanked, all places kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\\n])\'', blank, text,
                  flags=re.S)


def other_number(text, suffix):
    if "." not in text:
        return str(int(text) + 1)
    value = float(text)
    other = "1.0" if value == 0.0 else f"{1.5 * value:.15g}"
    return other + ("" if re.search(r"[.e]", other) else ".0") + suffix


def candidates(path):
    """(offset, length, replacement) of every mutant of a file."""
    text = path.read_text()
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


def compiled():
    """The sources that the release build compiles, alone or together."""
    names = set()
    for command in json.loads((TREE / "build/release/compile_commands.json").read_text()):
        together = Path(command["file"])
        names.add(together.as_posix())
        if "/Unity/" in command["file"] and "lissom_" in command["file"]:
            names.update(re.findall(r'#include "([^"]*)"', together.read_text()))
    return {Path(name).relative_to(TREE).as_posix() for name in names if Path(name).is_relative_to(TREE)}


def choose(modules, seed):
    """Mutants in the order in which they are tried, the modules in turn."""
    queues, used = [], compiled()
    for module in modules:
        all_of = [(module, path.relative_to(ROOT).as_posix(), *mutant)
                  for path in sources(module) for mutant in candidates(path)
                  if path.relative_to(ROOT).as_posix() in used]
        random.Random(f"{seed} {module}").shuffle(all_of)
        queues.append(all_of)
    return [mutant for turn in itertools.zip_longest(*queues) for mutant in turn if mutant]


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
    _, _, offset, length, replacement = mutant
    before, choice = plain[offset:offset + length], f"mutants::Choice<{number}>"
    if before in ("&&", "||"):
        # By De Morgan's law: c != ((c != L) && (c != R)) is L && R, or L || R where c.
        begin, end = operand_ends(plain, offset, before)
        on = f"{choice}::on()"
        return [(begin, 0, f" ({on} != (({on} != bool("), (offset, length, f")) {before} ({on} != bool("),
                (end, 0, "))))")]
    if before in OPERATORS and replacement:
        operator = mutant_names[before]
        return [(offset, length, f"{before} mutants::{operator}<{number}>{{}} {before}")]
    if before in ("-", "!"):
        return [(offset, length, f"mutants::{'Sign' if before == '-' else 'Not'}<{number}>{{}} * ")]
    if before in ("std::min", "std::max"):
        return [(offset, length, f"mutants::{before[5:]}_of<{number}>")]
    edits = [(offset, length, f"({choice}::on() ? {replacement} : {before})")]
    line_begin = plain.rfind("\n", 0, offset) + 1
    known = re.compile(r"\bconstexpr\b").search(plain, line_begin, offset)
    return edits + ([(known.start(), 9, "const")] if known else [])


mutant_names = {"<": "Compare", "<=": "Compare", ">": "Compare", ">=": "Compare", "==": "Compare",
                "!=": "Compare", "+": "Arithmetic", "-": "Arithmetic", "*": "Arithmetic", "/": "Arithmetic",
                "+=": "Assign", "-=": "Assign", "*=": "Assign", "/=": "Assign"}


def with_choices(name, numbered):
    """The text of a source with mutants behind choices, and those that fit beside the others."""
    text = (ROOT / name).read_text()
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


def tracked():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            capture_output=True).stdout.decode()
    return [name for name in listed.split("\0") if name and (ROOT / name).is_file()]


def copy_tree():
    """Makes TREE equal to the working tree; what is equal already keeps its time. Returns its hash."""
    names = tracked()
    digest = hashlib.sha256()
    for name in sorted(names):
        content = (ROOT / name).read_bytes()
        if name.startswith(("kernel/", "tests/unit/", "tests/mutation/")):
            digest.update(name.encode() + b"\0" + content)
        to = TREE / name
        if not to.exists() or to.read_bytes() != content:
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, to)
            shutil.copymode(ROOT / name, to)
    wanted = set(names)
    for folder, folders, files in os.walk(TREE):
        folders[:] = [f for f in folders if Path(folder, f) != TREE / "build"]
        for file in files:
            if Path(folder, file).relative_to(TREE).as_posix() not in wanted:
                Path(folder, file).unlink()
    return digest.hexdigest()[:16]


def run(command, seconds=None, number=0, log=subprocess.DEVNULL):
    """Exit status of a command with a mutant chosen, or None where it took too long."""
    process = subprocess.Popen(command, cwd=TREE, stdout=log, stderr=subprocess.STDOUT,
                               stdin=subprocess.DEVNULL, start_new_session=True,
                               env={**os.environ, "LISSOM_MUTANT": str(number), "CCACHE_BASEDIR": str(TREE),
                                    "CCACHE_NOHASHDIR": "1"})
    try:
        return process.wait(seconds)
    except subprocess.TimeoutExpired:
        return None
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()

def build(modules, log=subprocess.DEVNULL):
    """Compiles as ./dev does, one source at a time: whoever works beside it has the other processors."""
    targets = [f"test_{module}" for module in modules]
    return run(["ninja", "-C", "build/release", "-j1", "-k0", *targets], log=log) == 0


def write_source(name, text):
    if (TREE / name).read_text() != text:
        (TREE / name).write_text(text)


def write_choices(name, numbered):
    """Puts mutants of a source into the copy, as a header that gives no warnings; returns who fits."""
    text, fitting = with_choices(name, numbered)
    held = (TREE / name).with_suffix(".choices.h")
    content = f'#pragma GCC system_header\n#include "tests/mutation/choice.h"\n#line 1 "{name}"\n{text}'
    if not held.exists() or held.read_text() != content:
        held.write_text(content)
    write_source(name, f'#include "{held.relative_to(TREE).as_posix()}"\n')
    return fitting


def compile_all(numbered, modules):
    """Compiles mutants into the copy, as many as compile so. Returns their numbers."""
    by_name = {}
    for number, mutant in numbered:
        by_name.setdefault(mutant[1], []).append((number, mutant))
    inside = set()
    for name in by_name:
        inside.update(write_choices(name, by_name[name]))
    while True:
        with (WORK / "build.log").open("w") as log:
            if build(modules, log):
                return inside
        errors = (WORK / "build.log").read_text()
        wrong = {number for number, mutant in numbered if number in inside and
                 re.search(f"{re.escape(mutant[1])}:{line_of(mutant)}:", errors)}
        wrong = wrong or {number for number, mutant in numbered if number in inside and
                          re.search(re.escape(mutant[1]) + r":\d+:\d+: error", errors)}
        if not wrong:
            sys.exit(f"mutants: the copy does not build, see {WORK / 'build.log'}")
        inside -= wrong
        for name in {mutant[1] for number, mutant in numbered if number in wrong}:
            write_choices(name, [(n, m) for n, m in by_name[name] if n in inside])


def test(module, seconds, number, *filters):
    binary = TREE / "build/release/tests/unit" / module / f"test_{module}"
    return run([binary, "--abort-after=1", *filters], seconds, number)


class Suite:
    """The tests of a module: how long they take, and which are slow."""

    def __init__(self, module):
        self.module, self.slow = module, []
        started = time.monotonic()
        with (WORK / "times.log").open("w") as log:
            binary = TREE / "build/release/tests/unit" / module / f"test_{module}"
            if run([binary, "-d"], log=log) != 0:
                sys.exit(f"mutants: test_{module} fails without any change")
        self.seconds = time.monotonic() - started
        for taken, name in re.findall(r"^([\d.]+) s: (.*)$", (WORK / "times.log").read_text(), re.M):
            if float(taken) > SLOW_SECONDS:
                self.slow.append(re.sub(r"[,\\]", "?", name))
        print(f"{module}: tests take {self.seconds:.0f} s", flush=True)

    def stages(self, name):
        own = f"*{self.module}/{Path(name).relative_to(f'kernel/{self.module}').with_suffix('').as_posix()}*_test.cpp"
        slow = ",".join(self.slow)
        yield [f"-sf={own}"] + ([f"-tce={slow}"] if slow else [])
        yield [f"-sfe={own}"] + ([f"-tce={slow}"] if slow else [])
        if slow:
            yield [f"-tc={slow}"]

    def outcome(self, number, name):
        for filters in self.stages(name):
            status = test(self.module, max(LEAST_SECONDS, PATIENCE * self.seconds), number, *filters)
            if status != 0:
                return "time" if status is None else "crash" if status < 0 else "test"
        return "survived"


def outcome_alone(mutant, suite):
    """Of a mutant that has to be compiled by itself."""
    module, name, offset, length, replacement = mutant
    original = (ROOT / name).read_text()
    before = (TREE / name).read_text()
    try:
        write_source(name, original[:offset] + replacement + original[offset + length:])
        return suite.outcome(0, name) if build([module]) else "invalid"
    finally:
        write_source(name, before)


def line_of(mutant):
    return (ROOT / mutant[1]).read_text().count("\n", 0, mutant[2]) + 1


def place(mutant):
    module, name, offset, length, replacement = mutant
    text = (ROOT / name).read_text()
    line = line_of(mutant)
    before = text[offset:offset + length]
    shown = text.split("\n")[line - 1].strip()
    return f"{name}:{line}", f"'{before}' -> '{replacement}'", shown


def key(mutant):
    return f"{mutant[1]}@{mutant[2]}={mutant[4]}"


def check_indices(module):
    """The standard library's own checks, as the debug preset has them: else a place beyond an array's end may
    pass for nothing. What is only a warning compiles."""
    lists = TREE / "kernel" / module / "CMakeLists.txt"
    lists.write_text(lists.read_text() + f"target_compile_definitions(lissom_{module} PRIVATE _GLIBCXX_ASSERTIONS)\n"
                     f"target_compile_options(lissom_{module} PRIVATE -w)\n")


def known_results(state):
    """Outcomes of an earlier run of the same tree and seed."""
    if not RESULTS.exists():
        return {}
    lines = RESULTS.read_text().splitlines()
    if not lines or lines[0] != state:
        return {}
    return dict(line.split("\t")[:2] for line in lines[1:])


def report(done, modules):
    columns = ["killed", "by a test", "by a crash", "by time", "survived", "invalid", "rate"]
    print(f"\n{'module':8}" + "".join(f"{column:>12}" for column in columns))
    killed_in_all = counted_in_all = 0
    for module in [*modules, "all"]:
        outcomes = [outcome for _, mutant, outcome in done if module in ("all", mutant[0])]
        count = outcomes.count
        killed = count("test") + count("crash") + count("time")
        counted = killed + count("survived")
        rate = f"{100 * killed / counted:.0f} %" if counted else "-"
        row = [killed, count("test"), count("crash"), count("time"), count("survived"), count("invalid"), rate]
        print(f"{module:8}" + "".join(f"{value:>12}" for value in row))
        killed_in_all, counted_in_all = killed, counted
    print("\nsurvivors:")
    for number, mutant, outcome in done:
        if outcome == "survived":
            print(f"  {number:3}  %s  %s\n       %s" % place(mutant))
    return killed_in_all / counted_in_all if counted_in_all else 1.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=200, help="mutants that compile (default: 200)")
    parser.add_argument("--seconds", type=float, help="stop after so many, to go on another time")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=1, help="number of the first mutant that counts: those "
                        "before it may have led to tests, and say nothing more about the others (default: 1)")
    parser.add_argument("--modules", default="deform,merge,hair,solve")
    options = parser.parse_args()
    modules = options.modules.split(",")
    # As an exception, so that what runs is ended and the copy restored.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mutants: ended from outside"))
    started = time.monotonic()
    WORK.mkdir(parents=True, exist_ok=True)
    state = f"{copy_tree()} {options.seed} {options.modules} {options.count}"
    known = known_results(state)
    if not known:
        RESULTS.write_text(state + "\n")
    for module in modules:
        check_indices(module)
    # Configures, and lists the targets.
    if run(["./dev", "build", "release", "help"]) != 0:
        sys.exit(f"mutants: {TREE} cannot be configured")
    chosen = choose(modules, options.seed)[:round(SPARE * options.count)]
    numbered = list(enumerate(chosen, 1))
    inside = compile_all(numbered, modules)
    print(f"{len(inside)} of {len(chosen)} compiled at once in {time.monotonic() - started:.0f} s", flush=True)
    suites = {module: Suite(module) for module in modules}
    done, counted, ended = [], 0, False
    for number, mutant in numbered[options.first - 1:]:
        if counted >= options.count - options.first + 1:
            break
        outcome = known.get(key(mutant))
        if outcome is None:
            if options.seconds and time.monotonic() - started > options.seconds:
                ended = True
                break
            suite = suites[mutant[0]]
            outcome = suite.outcome(number, mutant[1]) if number in inside else outcome_alone(mutant, suite)
            with RESULTS.open("a") as results:
                results.write(f"{key(mutant)}\t{outcome}\n")
            print(f"{outcome:9} {number:3} %s  %s" % place(mutant)[:2], flush=True)
        done.append((number, mutant, outcome))
        counted += outcome != "invalid"
    rate = report(done, modules)
    if ended:
        print(f"\n{counted} mutants of {options.count - options.first + 1}; run it again to go on")
        return 2
    print(f"\n{100 * rate:.1f} % killed; required are {100 * REQUIRED:.0f} %")
    return 0 if rate >= REQUIRED else 1


if __name__ == "__main__":
    sys.exit(main())
