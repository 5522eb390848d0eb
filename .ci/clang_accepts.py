#!/usr/bin/env python3
"""Whether clang compiles, without a warning, what a build folder of its own has no objects of. Nothing is written.

    .ci/clang_accepts.py BUILD JOBS
"""
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def unbuilt(build: Path) -> list[tuple[str, list[str]]]:
    """Folders and commands of units without an object."""
    commands = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        place = words.index("-o")
        if (Path(entry["directory"]) / words[place + 1]).exists():
            continue
        del words[place : place + 2]
        # Sanitizers change what is compiled, not what is accepted.
        words = [word for word in words if not re.match("-fsanitize|.*ccache$", word)]
        commands.append((entry["directory"], [*words, "-fsyntax-only"]))
    return commands


def accepts(command: tuple[str, list[str]]) -> bool:
    done = subprocess.run(command[1], cwd=command[0], capture_output=True, text=True, check=False)
    if done.returncode != 0 or done.stderr:
        print(done.stderr, flush=True)
    return done.returncode == 0


def main() -> int:
    commands = unbuilt(Path(sys.argv[1]))
    with ThreadPoolExecutor(int(sys.argv[2])) as pool:
        results = list(pool.map(accepts, commands))
    print(f"{sum(results)} passed, {len(results) - sum(results)} failed")
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
