"""Wall time of calls and commands, and peak memory of processes."""

from __future__ import annotations

import platform
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
EHLECTRIC = Path(sys.executable).with_name("ehlectric")


def best(call: Callable[[], Any], repeats: int = 7) -> float:
    """Shortest wall time of repeated calls [s].

    The shortest one counts, since the machines are shared. A warm-up call comes first.
    """
    times = []
    for _ in range(repeats + (repeats > 1)):
        started = time.perf_counter()
        call()
        times.append(time.perf_counter() - started)
    return min(times)


def command(*arguments: str, repeats: int = 5) -> float:
    """Wall time of an ``ehlectric`` command [s]."""
    return best(lambda: subprocess.run([EHLECTRIC, *arguments], capture_output=True, check=True), repeats)


def peak_memory(
    solver: Callable[[Any], Any], problem_of: Callable[..., Any], *arguments: object
) -> tuple[float, float]:
    """Peak resident memory of a fresh process that solves a problem, and the part that solving it adds [GB].

    ``problem_of(*arguments)`` is the problem. The process imports both functions by their names.
    """
    # ru_maxrss is no measure here: a child process starts with the value of its parent.
    code = f"""
from {problem_of.__module__} import {problem_of.__name__} as problem_of
from {solver.__module__} import {solver.__name__} as solve
def resident(key):
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith(key))
problem = problem_of(*{arguments!r})
before = resident("VmRSS")
solve(problem)
print(resident("VmHWM"), resident("VmHWM") - before)
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    whole, added = done.stdout.split()
    return int(whole) * 1024 / 1e9, int(added) * 1024 / 1e9


def processor() -> str:
    """Name of the processor of this machine."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.machine()
