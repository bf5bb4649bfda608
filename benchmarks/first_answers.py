"""Processor time of the first answers of commands and of Python, in this tree and in another one.

``python -m benchmarks.first_answers`` gives each answer ``RUNS`` times; with the folder of another tree as
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

from benchmarks.measure import ROOT

# Runs of each answer in each tree; a first one, which writes compiled modules, is not counted.
RUNS = 5

# Arguments of Python by the name of the answer; {out} is a new folder.
ANSWERS = {
    "check, bearing": ["-m", "ehlectric", "check", "examples/bearing_6208.toml"],
    "check, drive": ["-m", "ehlectric", "check", "examples/drive.toml"],
    "check, line contact": ["-m", "ehlectric", "check", "examples/line_contact.toml"],
    "bearing, atlas": [
        *["-m", "ehlectric", "bearing", "examples/bearing_6208.toml", "--contacts", "atlas"],
        *["--no-plots", "--output", "{out}"],
    ],
    "run, line contact": [
        *["-m", "ehlectric", "run", "examples/line_contact.toml", "--no-plots", "--output", "{out}"]
    ],
    "oil": ["-m", "ehlectric", "oil", "iso-vg-32"],
    "init": ["-m", "ehlectric", "init", "{out}/bearing.toml"],
    "import and solve": ["-c", "import ehlectric; ehlectric.solve('examples/line_contact.toml')"],
}

_IMPORT = re.compile(r"import time:\s+(\d+) \|\s+\d+ \|\s+(\w+)")


def answered(tree: Path, name: str, *options: str) -> subprocess.CompletedProcess[str]:
    """Process of Python in a tree, with further options, that has given an answer."""
    with tempfile.TemporaryDirectory() as out:
        arguments = [argument.format(out=out) for argument in ANSWERS[name]]
        program = [str(tree / ".venv" / "bin" / "python"), *options, *arguments]
        return subprocess.run(program, cwd=tree, capture_output=True, text=True, check=True)


def seconds_of(tree: Path, name: str) -> tuple[float, float]:
    """Processor time and wall time of an answer in a tree [s]."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    answered(tree, name)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def seconds_to_verdict(tree: Path) -> float:
    """Wall time from a bearing's command that draws all figures to the last line of its verdict [s]."""
    with tempfile.TemporaryDirectory() as out:
        arguments = [word for word in ANSWERS["bearing, atlas"] if word != "--no-plots"]
        program = [str(tree / ".venv" / "bin" / "python"), *(word.format(out=out) for word in arguments)]
        start = time.perf_counter()
        with subprocess.Popen(
            program, cwd=tree, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        ) as process:
            assert process.stdout is not None
            for line in process.stdout:
                if line.startswith("  model  "):
                    wall = time.perf_counter() - start
    return wall


def imports_of(tree: Path, name: str) -> tuple[int, list[tuple[str, int]]]:
    """Number of modules of an answer, and the packages with the longest imports and their times [ms]."""
    rows = _IMPORT.findall(answered(tree, name, "-X", "importtime").stderr)
    times: Counter[str] = Counter()
    for microseconds, package in rows:
        times[package] += int(microseconds)
    return len(rows), [(package, round(total / 1000)) for package, total in times.most_common(4)]


def main() -> None:
    """Print a table of all answers."""
    if os.environ.get("PYTHONDONTWRITEBYTECODE"):
        sys.exit("unset PYTHONDONTWRITEBYTECODE: without it each run would compile the modules again")
    trees = [ROOT, *map(Path, sys.argv[1:])]
    for name in ANSWERS:
        rows = [[seconds_of(tree, name) for tree in trees] for _ in range(RUNS + 1)][1:]
        for number, tree in enumerate(trees):
            processor, wall = (median(row[number][k] for row in rows) for k in range(2))
            modules, packages = imports_of(tree, name)
            said = ", ".join(f"{package} {total} ms" for package, total in packages)
            print(f"{name:20} {tree.name:10} {processor:5.2f} s  {wall:5.2f} s  {modules:5} modules: {said}")
    walls = [[seconds_to_verdict(tree) for tree in trees] for _ in range(RUNS)]
    for number, tree in enumerate(trees):
        wall = median(row[number] for row in walls)
        print(f"{'bearing with figures':20} {tree.name:10} {wall:5.2f} s of wall time to its verdict")


if __name__ == "__main__":
    main()
