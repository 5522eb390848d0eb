#!/usr/bin/env python3
"""Changes one token of the kernel at a time and asks whether the unit tests notice.

    tests/mutation/mutants.py [--count 200] [--seconds N] [--seed N] [--modules deform,merge,hair,solve]

Mutants are chosen at random, the same for a seed, as many of each module: comparisons, arithmetic, logic,
signs and constants of the .cpp files. Each is built in a copy of the tree in build/mutation, and the unit
tests of its module run: first those of its own file, then the others. What ends with a failed test, a crash
or a time-out is killed; what does not compile does not count, and another takes its place.

Outcomes are written to build/mutation/results.tsv one by one, so that a run that was ended goes on where it
stopped, as long as the tree and the seed are the same. The working tree is only read. Prints a table and the
survivors; the exit status is 0 where at least 85 % are killed, 1 where fewer are, and 2 where --seconds ended
the run before.
"""
import argparse
import hashlib
import itertools
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
LEAST_SECONDS = 60

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
# Lines whose numbers and order no result depends on: how work is divided, progress, memory, costs, messages.
NO_RESULT = re.compile(
    r"[Gg]rain|parallel_for|progress|reserve\(|charge\(|memory|scratch|costs\.|stats\.|_bytes|_seconds|"
    r"\.log\(|require\(|static_assert|^\s*(#|using |template)")
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


def choose(modules, seed):
    """Mutants in the order in which they are tried, the modules in turn."""
    queues = []
    for module in modules:
        all_of = [(module, path.relative_to(ROOT).as_posix(), *mutant)
                  for path in sources(module) for mutant in candidates(path)]
        random.Random(f"{seed} {module}").shuffle(all_of)
        queues.append(all_of)
    return [mutant for turn in itertools.zip_longest(*queues) for mutant in turn if mutant]


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


def run(command, seconds=None):
    """Exit status of a command, or None where it took too long."""
    process = subprocess.Popen(command, cwd=TREE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               stdin=subprocess.DEVNULL, start_new_session=True)
    try:
        return process.wait(seconds)
    except subprocess.TimeoutExpired:
        return None
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def build(module):
    return run(["./dev", "build", "release", f"test_{module}"]) == 0


def test(module, seconds, *filters):
    binary = TREE / "build/release/tests/unit" / module / f"test_{module}"
    return run([binary, "--abort-after=1", *filters], seconds)


def outcome_of(mutant, seconds):
    module, name, offset, length, replacement = mutant
    path = TREE / name
    original = path.read_text()
    try:
        path.write_text(original[:offset] + replacement + original[offset + length:])
        if not build(module):
            return "invalid"
        own = Path(name).relative_to(f"kernel/{module}").with_suffix("").as_posix()
        for filters in ([f"-sf=*{module}/{own}*_test.cpp"], []):
            status = test(module, seconds, *filters)
            if status != 0:
                return "time" if status is None else "crash" if status < 0 else "test"
        return "survived"
    finally:
        path.write_text(original)


def place(mutant):
    module, name, offset, length, replacement = mutant
    text = (ROOT / name).read_text()
    line = text.count("\n", 0, offset) + 1
    before = text[offset:offset + length]
    shown = text.split("\n")[line - 1].strip()
    return f"{name}:{line}", f"'{before}' -> '{replacement}'", shown


def key(mutant):
    return f"{mutant[1]}@{mutant[2]}={mutant[4]}"


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
        outcomes = [outcome for mutant, outcome in done if module in ("all", mutant[0])]
        count = outcomes.count
        killed = count("test") + count("crash") + count("time")
        counted = killed + count("survived")
        rate = f"{100 * killed / counted:.0f} %" if counted else "-"
        row = [killed, count("test"), count("crash"), count("time"), count("survived"), count("invalid"), rate]
        print(f"{module:8}" + "".join(f"{value:>12}" for value in row))
        killed_in_all, counted_in_all = killed, counted
    print("\nsurvivors:")
    for mutant, outcome in done:
        if outcome == "survived":
            print("  %s  %s\n      %s" % place(mutant))
    return killed_in_all / counted_in_all if counted_in_all else 1.0


def baseline(modules):
    """Seconds that the tests of each module take as they are."""
    seconds = {}
    for module in modules:
        started = time.monotonic()
        if not build(module):
            sys.exit(f"mutants: test_{module} does not build in {TREE}")
        built = time.monotonic()
        if test(module, None) != 0:
            sys.exit(f"mutants: test_{module} fails without any change")
        seconds[module] = time.monotonic() - built
        print(f"{module}: built in {built - started:.0f} s, tests take {seconds[module]:.0f} s", flush=True)
    return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=200, help="mutants that compile (default: 200)")
    parser.add_argument("--seconds", type=float, help="stop after so many, to go on another time")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--modules", default="deform,merge,hair,solve")
    options = parser.parse_args()
    modules = options.modules.split(",")
    os.nice(19)
    # As an exception, so that what runs is ended and the copy restored.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mutants: ended from outside"))
    WORK.mkdir(parents=True, exist_ok=True)
    state = f"{copy_tree()} {options.seed} {options.modules}"
    known = known_results(state)
    if not known:
        RESULTS.write_text(state + "\n")
    usual = baseline(modules)
    started = time.monotonic()
    done, counted, ended = [], 0, False
    for mutant in choose(modules, options.seed):
        if counted >= options.count:
            break
        outcome = known.get(key(mutant))
        if outcome is None:
            if options.seconds and time.monotonic() - started > options.seconds:
                ended = True
                break
            outcome = outcome_of(mutant, max(LEAST_SECONDS, PATIENCE * usual[mutant[0]]))
            with RESULTS.open("a") as results:
                results.write(f"{key(mutant)}\t{outcome}\n")
            print(f"{outcome:9} %s  %s" % place(mutant)[:2], flush=True)
        done.append((mutant, outcome))
        counted += outcome != "invalid"
    rate = report(done, modules)
    if ended:
        print(f"\n{counted} of {options.count} mutants; run it again to go on")
        return 2
    print(f"\n{100 * rate:.1f} % killed; required are {100 * REQUIRED:.0f} %")
    return 0 if rate >= REQUIRED else 1


if __name__ == "__main__":
    sys.exit(main())
