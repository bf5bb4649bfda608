"""Processor time of the first answers of commands and of Python, in this tree and in another one.

``python -m benchmarks.first_answers`` runs each command ``RUNS`` times; with the folder of another tree as
argument, whose environment is in its ``.venv``, alternately in both. It prints medians of the processor time
and of the wall time [s], the number of modules, and the time of their imports by package. Run it on idle
cores, without ``PYTHONDONTWRITEBYTECODE``.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from statistics import median

HERE = Path(__file__).parents[1]

# Runs of each command in each tree; the first one, which writes compiled modules, is not counted.
RUNS = 5

# Arguments of the commands by their name; {out} is a new folder.
COMMANDS = {
    "check, bearing": "-m ehlectric check examples/bearing_6208.toml",
    "check, drive": "-m ehlectric check examples/drive.toml",
    "check, line contact": "-m ehlectric check examples/line_contact.toml",
    "bearing, atlas": "-m ehlectric bearing examples/bearing_6208.toml --contacts atlas --no-plots -o {out}",
    "run, line contact": "-m ehlectric run examples/line_contact.toml --no-plots -o {out}",
    "oil": "-m ehlectric oil iso-vg-32",
    "init": "-m ehlectric init {out}/bearing.toml",
    "import and solve": "-c import/ehlectric;ehlectric.solve('examples/line_contact.toml')",
}

_IMPORT = re.compile(r"import time:\s+(\d+) \|\s+\d+ \|\s+(\w+)")


def arguments_of(command: str, out: str) -> list[str]:
    """Arguments of Python for a command; a slash stands for a blank within Python code."""
    arguments = command.format(out=out).split()
    return [arguments[0], arguments[1].replace("/", " ", 1), *arguments[2:]]


def seconds_of(tree: Path, command: str) -> tuple[float, float]:
    """Processor time and wall time of a command in a tree [s]."""
    with tempfile.TemporaryDirectory() as out:
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        program = [str(tree / ".venv" / "bin" / "python"), *arguments_of(command, out)]
        done = subprocess.run(program, cwd=tree, capture_output=True, text=True)
        wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{command}: {done.stderr.strip()[-400:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def imports_of(tree: Path, command: str) -> tuple[int, list[tuple[str, int]]]:
    """Number of modules that a command loads, and packages with the longest imports and their times [ms]."""
    with tempfile.TemporaryDirectory() as out:
        program = [str(tree / ".venv" / "bin" / "python"), "-X", "importtime", *arguments_of(command, out)]
        said = subprocess.run(program, cwd=tree, capture_output=True, text=True).stderr
    rows = _IMPORT.findall(said)
    times: Counter[str] = Counter()
    for microseconds, package in rows:
        times[package] += int(microseconds)
    return len(rows), [(package, round(total / 1000)) for package, total in times.most_common(4)]


def main() -> None:
    """Print a table of all commands."""
    if os.environ.get("PYTHONDONTWRITEBYTECODE"):
        sys.exit("unset PYTHONDONTWRITEBYTECODE: without it each run would compile the modules again")
    trees = [HERE, *map(Path, sys.argv[1:])]
    for name, command in COMMANDS.items():
        rows = [[seconds_of(tree, command) for tree in trees] for _ in range(RUNS + 1)][1:]
        for number, tree in enumerate(trees):
            processor, wall = (median(row[number][k] for row in rows) for k in range(2))
            modules, packages = imports_of(tree, command)
            said = ", ".join(f"{package} {total} ms" for package, total in packages)
            print(f"{name:20} {tree.name:10} {processor:5.2f} s  {wall:5.2f} s  {modules:5} modules: {said}")


if __name__ == "__main__":
    main()
