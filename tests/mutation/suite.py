"""The unit tests of a module: which of them come to which mutant, and what they make of it."""
import os
import resource
import signal
import subprocess
import sys
import xml.etree.ElementTree
from dataclasses import dataclass
from pathlib import Path

# What a test case has shown of a mutant, as choice.h says it.
NOT_REACHED, SAME_VALUE, NO_TIE, OTHER_VALUE = 0, 1, 2, 3
NOT_SHOWN = {NOT_REACHED: "unreached", SAME_VALUE: "same", NO_TIE: "tie"}
# A mutant is given so many times the processor time that the tests take without it, at least LEAST_SECONDS.
PATIENCE = 4
LEAST_SECONDS = 10
# Beyond so much time on the clock beside it, a test waits for something.
WALL_PATIENCE, WALL_SECONDS = 10, 120
# Test cases are run together with those that take as long, the short ones first; slower ones alone.
INSTANT_SECONDS, SLOW_SECONDS = 0.3, 4
# Of a test program with a mutant that only takes memory.
MEMORY_BYTES = 8 << 30


@dataclass
class Case:
    name: str
    file: str
    seconds: float = 0.0
    reached: bytes = b""

    def shows(self, number):
        """Of a mutant behind a choice; one that is compiled alone may be anywhere."""
        return OTHER_VALUE if number == 0 else self.reached[number]


def limit(seconds):
    def set_limits():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        if seconds:
            resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5))
    return set_limits


def run(command, folder, seconds=None, log=subprocess.DEVNULL, **environment):
    """Exit status of a command, or None where it took more processor time."""
    process = subprocess.Popen(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                               start_new_session=True, preexec_fn=limit(seconds), env={**os.environ, **environment})
    try:
        status = process.wait(seconds and WALL_PATIENCE * seconds + WALL_SECONDS)
        return None if status in (-signal.SIGXCPU, -signal.SIGKILL) else status
    except subprocess.TimeoutExpired:
        return None
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Suite:
    """Runs every test case by itself once, so that no shared scene hides what it comes to."""

    def __init__(self, module, tree, work):
        self.module, self.tree, self.work = module, tree, work
        self.binary = tree / "build/release/tests/unit" / module / f"test_{module}"
        self.cases = self.listed()
        for case in self.cases:
            self.record(case)
        print(f"{module}: {len(self.cases)} test cases, {sum(c.seconds for c in self.cases):.0f} s of processor time",
              flush=True)

    def listed(self):
        """Every test case once, by its name."""
        text = subprocess.run([self.binary, "-ltc", "-r=xml"], cwd=self.tree, check=True, capture_output=True).stdout
        found = {}
        for case in xml.etree.ElementTree.fromstring(text).iter("TestCase"):
            found.setdefault(case.get("name"), Case(case.get("name"), case.get("filename")))
        return list(found.values())

    def record(self, case):
        before = processor_seconds()
        told = self.work / "reached"
        if self.run([case], None, LISSOM_MUTANTS_REACHED=told.as_posix()) != 0:
            sys.exit(f"mutants: the test '{case.name}' of test_{self.module} fails without any change")
        case.seconds = processor_seconds() - before
        case.reached = told.read_bytes()

    def run(self, cases, seconds, **environment):
        # A comma separates names, and a wildcard stands for any letter.
        names = ",".join(case.name.replace(",", "?").replace("\\", "?") for case in cases)
        return run([self.binary, "--abort-after=1", f"-tc={names}"], self.tree, seconds, **environment)

    def stages(self, cases, name):
        """Those of the mutant's own file, then the others, the slow ones one by one."""
        own_path = f"{self.module}/{Path(name).relative_to(f'kernel/{self.module}').with_suffix('').as_posix()}"
        quick = [c for c in cases if c.seconds <= SLOW_SECONDS]
        own = [c for c in quick if own_path in c.file]
        others = [c for c in quick if own_path not in c.file]
        yield own
        yield [c for c in others if c.seconds <= INSTANT_SECONDS]
        yield [c for c in others if c.seconds > INSTANT_SECONDS]
        for case in sorted((c for c in cases if c.seconds > SLOW_SECONDS), key=lambda c: c.seconds):
            yield [case]

    def outcome(self, number, name):
        """Of a mutant behind the choice `number`, or of one that is compiled, for 0."""
        shown = max(case.shows(number) for case in self.cases)
        if shown != OTHER_VALUE:
            return NOT_SHOWN[shown]
        for stage in self.stages([case for case in self.cases if case.shows(number) == OTHER_VALUE], name):
            if not stage:
                continue
            seconds = max(LEAST_SECONDS, PATIENCE * sum(case.seconds for case in stage))
            status = self.run(stage, seconds, LISSOM_MUTANT=str(number))
            if status != 0:
                return "time" if status is None else "crash" if status < 0 else "test"
        return "survived"
