#!/usr/bin/env python3
"""Changes one token of the kernel at a time and asks whether the unit tests notice.

    tests/mutation/mutants.py [--count 200] [--seconds N] [--seed N] [--modules deform,merge,hair,solve]

Mutants are chosen at random, the same for a seed, as many of each module: comparisons, arithmetic, logic,
signs and constants of the .cpp files that the release build compiles. All are compiled at once into a copy
of the tree in build/mutation, each behind a choice that the variable LISSOM_MUTANT makes when the tests start
(choice.h). What does not compile so, a constant that the compiler must know for one, is compiled alone.
Every test case of a module runs once without a change and tells which mutants it comes to, and at which of
them the other token gives another value; a mutant then meets those tests only, first those of its own file,
then the others, short ones first. What ends with a failed test, a crash or a time-out is killed. What does
not compile, gives the same machine code, would differ only where two computed numbers are equal that never were
in any test, or stands in harmless.tsv with the reason why no test can tell it, does not count, and another takes
its place.

Outcomes are written to build/mutation/results.tsv one by one, so that a run that was ended goes on where it
stopped, as long as the kernel, its tests and the seed are the same; after tests were added or other lines changed,
--again runs the survivors alone. The working tree is only read, at the beginning. Prints a line a mutant, a table
and the survivors, each with its number, so that
    LISSOM_MUTANT=17 build/mutation/tree/build/release/tests/unit/deform/test_deform
shows what a test makes of it; the exit status is 0 where at least 85 % are killed, 1 where fewer are, and 2
where --seconds ended the run before.
"""
import argparse
import hashlib
import itertools
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path
from typing import NamedTuple

import suite
from choices import with_choices
from tokens import candidates

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "mutation"
TREE = WORK / "tree"
RESULTS = WORK / "results.tsv"
HARMLESS = "tests/mutation/harmless.tsv"
REQUIRED = 0.85
# Of so many mutants more than asked for, those take the place of what does not compile.
SPARE = 1.35
KILLED = ("test", "crash", "time")
# No test comes to the token; none comes to a place where the other gives another value; none fails.
SURVIVED = ("unreached", "same", "survived")


class Mutant(NamedTuple):
    module: str
    name: str
    offset: int
    length: int
    replacement: str

    def key(self):
        """Names it by its line, and the place there: the same after other lines changed."""
        text = source(self.name)
        begin = text.rfind("\n", 0, self.offset) + 1
        line = text[begin:text.find("\n", self.offset)]
        shown, indent = line.strip(), len(line) - len(line.lstrip())
        before = sum(other.strip() == shown for other in text[:begin].split("\n"))
        return f"{self.name}:{shown}:{before}@{self.offset - begin - indent}={self.replacement}"

    def line(self):
        return source(self.name).count("\n", 0, self.offset) + 1

    def is_harmless(self):
        place = self.place()
        return (self.name, place[2], place[1]) in harmless()

    def changed(self):
        text = source(self.name)
        return text[:self.offset] + self.replacement + text[self.offset + self.length:]

    def place(self):
        text = source(self.name)
        before = text[self.offset:self.offset + self.length]
        shown = text.split("\n")[self.line() - 1].strip()
        return f"{self.name}:{self.line()}", f"'{before}' -> '{self.replacement}'", shown


@cache
def source(name):
    """As it was when the run began."""
    return (ROOT / name).read_text()


@cache
def harmless():
    """(source, line, change) of the mutants that no test can tell."""
    lines = (ROOT / HARMLESS).read_text().splitlines()
    return {tuple(line.split("\t")[:3]) for line in lines if line and not line.startswith("#")}


def names_of(module):
    return sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "kernel" / module).rglob("*.cpp"))


# --- the copy --------------------------------------------------------------------------------------------

def tracked():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            capture_output=True).stdout.decode()
    return sorted(name for name in listed.split("\0") if name and (ROOT / name).is_file())


def more_checks(name, modules):
    """The standard library's and Eigen's own checks, as the debug preset has them: else a place beyond an array's end may
    pass for nothing. What is only a warning compiles."""
    module = Path(name).parent.name
    if name != f"kernel/{module}/CMakeLists.txt" or module not in modules:
        return b""
    return (f"target_compile_definitions(lissom_{module} PRIVATE _GLIBCXX_ASSERTIONS)\n"
            f"target_compile_options(lissom_{module} PRIVATE -w -UNDEBUG)\n").encode()


def copy_tree(modules):
    """Makes TREE equal to the working tree; what is equal already keeps its time. Returns the hashes of what
    mutants are made of and of their tests."""
    names = tracked()
    digests = {"kernel": hashlib.sha256(), "tests": hashlib.sha256()}
    for name in names:
        content = (ROOT / name).read_bytes()
        if name.startswith(("kernel/", "tests/mutation/")) and name != HARMLESS:
            digests["kernel"].update(name.encode() + b"\0" + content)
        if name.startswith("tests/unit/"):
            digests["tests"].update(name.encode() + b"\0" + content)
        content += more_checks(name, modules)
        to = TREE / name
        if not to.exists() or to.read_bytes() != content:
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_bytes(content)
            shutil.copymode(ROOT / name, to)
    remove_others(set(names))
    return [digest.hexdigest()[:16] for digest in digests.values()]


def remove_others(wanted):
    for folder, folders, files in os.walk(TREE):
        folders[:] = [f for f in folders if Path(folder, f) != TREE / "build"]
        for file in files:
            if Path(folder, file).relative_to(TREE).as_posix() not in wanted:
                Path(folder, file).unlink()


def units():
    """By the name of every source that the release build compiles, alone or together, the command that does."""
    found = {}
    for command in json.loads((TREE / "build/release/compile_commands.json").read_text()):
        together = Path(command["file"])
        found[together.as_posix()] = command
        if "/Unity/" in command["file"] and "lissom_" in command["file"]:
            for name in re.findall(r'#include "([^"]*)"', together.read_text()):
                found[name] = command
    return {Path(name).relative_to(TREE).as_posix(): command for name, command in found.items()
            if Path(name).is_relative_to(TREE)}


def choose(modules, seed):
    """Mutants in the order in which they are tried, the modules in turn; other lines of a source leave it as it is."""
    queues, used = [], units()
    for module in modules:
        all_of = [Mutant(module, name, *change) for name in names_of(module) for change in candidates(source(name))
                  if name in used]
        all_of.sort(key=lambda mutant: hashlib.sha256(f"{seed} {mutant.key()}".encode()).digest())
        queues.append(all_of)
    return [mutant for turn in itertools.zip_longest(*queues) for mutant in turn if mutant]


# --- compiling -------------------------------------------------------------------------------------------

def run(command, log=subprocess.DEVNULL):
    return suite.run(command, TREE, log=log, CCACHE_BASEDIR=str(TREE), CCACHE_NOHASHDIR="1")


def build(modules, log=subprocess.DEVNULL):
    """Compiles as ./dev does, one source at a time: whoever works beside it has the other processors."""
    targets = [f"test_{module}" for module in modules]
    return run(["ninja", "-C", "build/release", "-j1", "-k0", *targets], log=log) == 0


def write_source(name, text):
    if (TREE / name).read_text() != text:
        (TREE / name).write_text(text)


def write_choices(name, numbered):
    """Puts mutants of a source into the copy, as a header that gives no warnings; returns who fits."""
    text, fitting = with_choices(source(name), numbered)
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
        by_name.setdefault(mutant.name, []).append((number, mutant))
    inside = set()
    for name in by_name:
        inside.update(write_choices(name, by_name[name]))
    while True:
        with (WORK / "build.log").open("w") as log:
            if build(modules, log):
                return inside
        wrong = wrong_ones([(n, m) for n, m in numbered if n in inside], (WORK / "build.log").read_text())
        if not wrong:
            sys.exit(f"mutants: the copy does not build, see {WORK / 'build.log'}")
        inside -= wrong
        for name in {mutant.name for number, mutant in numbered if number in wrong}:
            write_choices(name, [(n, m) for n, m in by_name[name] if n in inside])


def wrong_ones(numbered, errors):
    """Numbers of the mutants on lines that a compiler names; else those of sources with errors."""
    wrong = {n for n, mutant in numbered if re.search(f"{re.escape(mutant.name)}:{mutant.line()}:", errors)}
    return wrong or {n for n, mutant in numbered if re.search(re.escape(mutant.name) + r":\d+:\d+: error", errors)}


def outcome_alone(mutant, tests):
    """Of a mutant that has to be compiled by itself; afterwards the test program is what it was."""
    before = (TREE / mutant.name).read_text()
    write_source(mutant.name, mutant.changed())
    try:
        return tests.outcome(0, mutant.name) if build([mutant.module]) else "invalid"
    finally:
        write_source(mutant.name, before)
        build([mutant.module])


class Code:
    """The machine code of sources, compiled as the release build does."""

    def __init__(self):
        self.units, self.originals = units(), {}

    def of(self, name, text):
        words = [w for w in shlex.split(self.units[name]["command"]) if not w.endswith("ccache")]
        to = WORK / "code.o"
        to.unlink(missing_ok=True)
        words = words[:words.index("-o")] + ["-g0", "-x", "c++", "-c", "-", "-o", to.as_posix()]
        subprocess.run(words, cwd=self.units[name]["directory"], input=text.encode(), stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
        return to.read_bytes() if to.exists() else None

    def is_same(self, mutant):
        if mutant.name not in self.originals:
            self.originals[mutant.name] = self.of(mutant.name, source(mutant.name))
        original = self.originals[mutant.name]
        return original is not None and original == self.of(mutant.name, mutant.changed())


# --- results ---------------------------------------------------------------------------------------------

def known_results(state, again):
    """Outcomes of an earlier run of the same kernel, seed and tests, or with `again` what any run killed."""
    lines = (RESULTS.read_text() if RESULTS.exists() else "\n").splitlines() or [""]
    known = dict(line.split("\t")[:2] for line in lines[1:])
    if lines[0] == " ".join(state):
        return known
    known = {key: outcome for key, outcome in known.items() if again and outcome not in SURVIVED}
    RESULTS.write_text("\n".join([" ".join(state), *("\t".join(item) for item in known.items())]) + "\n")
    return known


def report(done, modules):
    columns = ["killed", "by a test", "by a crash", "by time", "survived", "no count", "rate"]
    print(f"\n{'module':8}" + "".join(f"{column:>12}" for column in columns))
    killed = counted = 0
    for module in [*modules, "all"]:
        outcomes = [outcome for _, mutant, outcome in done if module in ("all", mutant.module)]
        killed = sum(outcome in KILLED for outcome in outcomes)
        survived = sum(outcome in SURVIVED for outcome in outcomes)
        counted = killed + survived
        rate = f"{100 * killed / counted:.0f} %" if counted else "-"
        row = [killed, *(outcomes.count(by) for by in KILLED), survived, len(outcomes) - counted, rate]
        print(f"{module:8}" + "".join(f"{value:>12}" for value in row))
    print("\nsurvivors:")
    for number, mutant, outcome in done:
        if outcome in SURVIVED:
            print(f"  {number:3}  {outcome:9} %s  %s\n       %s" % mutant.place())
    return killed / counted if counted else 1.0


class Run:
    """Tries mutants one after the other; the tests of a module are recorded where the first is tried."""

    def __init__(self, numbered, modules):
        self.inside = compile_all(numbered, modules)
        print(f"{len(self.inside)} of {len(numbered)} compiled at once", flush=True)
        self.suites, self.code = {}, Code()

    def outcome(self, number, mutant):
        if mutant.module not in self.suites:
            self.suites[mutant.module] = suite.Suite(mutant.module, TREE, WORK)
        tests = self.suites[mutant.module]
        outcome = (tests.outcome(number, mutant.name) if number in self.inside else outcome_alone(mutant, tests))
        return "equal" if outcome in SURVIVED and self.code.is_same(mutant) else outcome


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=200, help="mutants that compile (default: 200)")
    parser.add_argument("--seconds", type=float, help="stop after so many, to go on another time")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--again", action="store_true", help="take what an earlier run killed as killed though tests "
                        "or other lines differ: for after tests were added")
    parser.add_argument("--first", type=int, default=1, help="number of the first mutant that counts: those "
                        "before it may have led to tests, and say nothing more about the others (default: 1)")
    parser.add_argument("--modules", default="deform,merge,hair,solve")
    return parser.parse_args()


def try_all(numbered, modules, options, known, started):
    """(number, mutant, outcome) of as many as count, and whether time ended it before."""
    done, counted, tried = [], 0, None
    for number, mutant in numbered[options.first - 1:]:
        if counted >= options.count - options.first + 1:
            break
        outcome = "harmless" if mutant.is_harmless() else known.get(mutant.key())
        if outcome is None:
            if options.seconds and time.monotonic() - started > options.seconds:
                return done, True
            tried = tried or Run(numbered, modules)
            began = time.monotonic()
            outcome = tried.outcome(number, mutant)
            with RESULTS.open("a") as results:
                results.write(f"{mutant.key()}\t{outcome}\n")
            print(f"{outcome:9} {number:3} %s  %s" % mutant.place()[:2] + f"  ({time.monotonic() - began:.0f} s)",
                  flush=True)
        done.append((number, mutant, outcome))
        counted += outcome in KILLED or outcome in SURVIVED
    return done, False


def main():
    options = arguments()
    modules = options.modules.split(",")
    # As an exception, so that what runs is ended and the copy restored.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mutants: ended from outside"))
    started = time.monotonic()
    WORK.mkdir(parents=True, exist_ok=True)
    state = [*copy_tree(modules), str(options.seed), options.modules]
    known = known_results(state, options.again)
    # Configures, and lists the targets.
    if run(["./dev", "build", "release", "help"]) != 0:
        sys.exit(f"mutants: {TREE} cannot be configured")
    numbered = list(enumerate(choose(modules, options.seed)[:round(SPARE * options.count)], 1))
    done, ended = try_all(numbered, modules, options, known, started)
    rate = report(done, modules)
    if ended:
        print(f"\n{len(done)} mutants of {options.count - options.first + 1}; run it again to go on")
        return 2
    print(f"\n{100 * rate:.1f} % killed; required are {100 * REQUIRED:.0f} %")
    return 0 if rate >= REQUIRED else 1


if __name__ == "__main__":
    sys.exit(main())
