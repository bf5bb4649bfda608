"""Table of where the time of a test run goes: ``python -m tests.durations build/tests.xml``."""

from __future__ import annotations

import sys
from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree

SLOWEST = 25


def durations(path: Path) -> dict[str, float]:
    """Seconds of every test of a junit file by its name; subtests belong to their test."""
    seconds: dict[str, float] = defaultdict(float)
    for case in ElementTree.parse(path).iter("testcase"):
        seconds[f"{case.get('classname')}::{case.get('name')}"] += float(case.get("time", 0.0))
    return dict(seconds)


def folder(name: str) -> str:
    """Folder of a test, directly below ``tests``; all examples in docstrings of the source are one."""
    parts = name.partition("::")[0].split(".")
    if parts[0] != "tests":
        return "src, docstrings"
    folders = [part for part in parts[1:] if not part.startswith(("test_", "Test"))]
    return "/".join(["tests", *folders[:1]])


def tables(seconds: dict[str, float]) -> str:
    """Text of both tables: seconds by folder, and the slowest tests."""
    folders: dict[str, list[float]] = defaultdict(list)
    for name, time in seconds.items():
        folders[folder(name)].append(time)
    lines = [f"{'seconds':>9}  {'tests':>6}  folder"]
    rows = sorted(((sum(times), len(times), name) for name, times in folders.items()), reverse=True)
    total = (sum(seconds.values()), len(seconds), "all")
    lines += [f"{time:9.1f}  {count:6d}  {name}" for time, count, name in (*rows, total)]
    lines += ["", f"{'seconds':>9}  slowest tests"]
    slowest = sorted(seconds.items(), key=lambda row: -row[1])[:SLOWEST]
    return "\n".join([*lines, *(f"{time:9.1f}  {name}" for name, time in slowest)])


if __name__ == "__main__":
    sys.stdout.write(tables(durations(Path(sys.argv[1]))) + "\n")
