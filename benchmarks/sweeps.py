"""Cost of a sweep beyond solving: overhead of the engine, two workers against one, a map, a commit.

python -m benchmarks.sweeps
"""

from __future__ import annotations

import os
import platform
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from benchmarks.cases import EXAMPLE
from benchmarks.measure import processor
from ehlectric import run_sweep
from ehlectric.contact.solver import solve
from ehlectric.sweep.engine import plan, solve_point
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.store import Store
from ehlectric.sweep.sweep_inputs import Sweep

# 500 points: the paper's contact at 25 speeds and 20 loads.
POINTS = (25, 20)
MAP = (20, 20)
COMMITS = 500


def contact(shape: tuple[int, int]) -> Sweep:
    """Sweep of the paper's contact over speeds and loads, evenly spaced in their logarithms."""
    speeds, loads = shape
    vary = {
        "contact.entrainment_speed": {"from": 0.5, "to": 8.0, "count": speeds, "spacing": "log"},
        "contact.load_per_length": {"from": 0.2e6, "to": 2e6, "count": loads, "spacing": "log"},
    }
    return Sweep.from_dict({"case": EXAMPLE, "vary": vary})


def timed(sweep: Sweep, workers: int) -> tuple[float, SweepResults]:
    """Wall time of a whole sweep in a new folder [s], and its results."""
    with tempfile.TemporaryDirectory() as folder:
        started = time.perf_counter()
        results = run_sweep(sweep, folder, workers=workers)
        return time.perf_counter() - started, results


def solving(sweep: Sweep) -> float:
    """Time to solve the points of a sweep one after another in this process, nothing saved [s]."""
    cases = [sweep.case.replace(inputs) for inputs in sweep.points()]
    solve(cases[0])
    started = time.perf_counter()
    for case in cases:
        solve(case).summary()
    return time.perf_counter() - started


def commit(folder: Path) -> float:
    """Time to commit one point to the database [s]."""
    sweep = contact(POINTS)
    planned: list[Any] = list(plan(sweep))
    outcome = solve_point(sweep.case.to_dict())
    with Store(folder) as store:
        store.begin(sweep, planned)
        started = time.perf_counter()
        for point in planned[:COMMITS]:
            store.write([(point.key, replace(outcome, seconds=float(point.number)))])
        return (time.perf_counter() - started) / COMMITS


def main() -> None:
    """Print the times of a loop, sweeps, a map and a commit, for docs/validation/performance.md."""
    sweep = contact(POINTS)
    timed(contact((2, 2)), 2)  # imports what writes tables, which else the first of them would pay for
    loop = solving(sweep)
    one, results = timed(sweep, 1)
    inside = sum(point.seconds for point in results.points)
    two, doubled = timed(sweep, 2)
    mapped, _ = timed(contact(MAP), 2)
    beside = sum(point.seconds for point in doubled.points)
    with tempfile.TemporaryDirectory(dir=Path.cwd()) as folder:
        seconds = commit(Path(folder))
    solved = sum(point.solved for point in results.points)
    rows = [
        (f"{sweep.size} points in a loop, nothing saved", f"{loop:.1f} s", ""),
        (
            f"`run_sweep`, one worker ({solved} solved)",
            f"{one:.1f} s",
            f"{100 * (one / inside - 1):.1f} % over its solving",
        ),
        (f"`run_sweep`, two workers ({solved} solved)", f"{two:.1f} s", f"{one / two:.2f} times one"),
        (
            "solving time of all points, two workers",
            f"{beside:.1f} s",
            f"{beside / inside:.2f} times one worker",
        ),
        (f"{MAP[0]} x {MAP[1]} points, two workers", f"{mapped:.1f} s", "asked: below 120 s"),
        ("commit of one point", f"{1e3 * seconds:.2f} ms", ""),
    ]
    print(f"{processor()}, {len(os.sched_getaffinity(0))} cores, Python {platform.python_version()}\n")
    print("| what | took | |")
    print("| --- | ---: | --- |")
    for row in rows:
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
