"""The attack with mutated inputs: seeded, counted, and with every fault kept for a look."""

from __future__ import annotations

import random
import shutil
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from tests.attack.inputs import KINDS
from tests.attack.judge import faults
from tests.attack.runner import Runner
from tests.attack.stock import Stock


@dataclass
class Report:
    """Counts of an attack.

    Attributes
    ----------
    seed : int
        Its seed.
    name : str
        What was attacked.
    inputs : int
        Number of inputs, or of kills.
    statuses : Counter of str
        Number of commands by their end.
    faults : list of str
        What went wrong, with the folder in which the input is kept.
    slowest : float
        Longest time of a command [s].
    largest : int
        Largest memory of a command [bytes].
    seconds : float
        Time of all [s].
    """

    seed: int
    name: str
    inputs: int = 0
    statuses: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)
    slowest: float = 0.0
    largest: int = 0
    seconds: float = 0.0

    def __str__(self) -> str:
        ends = ", ".join(f"{end} {count}" for end, count in sorted(self.statuses.items()))
        return (
            f"{self.name}, seed {self.seed}: {self.inputs} in {self.seconds:.0f} s; ended with {ends}; "
            f"slowest {self.slowest:.1f} s, largest {self.largest / 2**20:.0f} MB; {len(self.faults)} faults"
        )


def attack(kind: str, numbers: Iterable[int], seed: int, stock: Stock, home: Path, runner: Runner) -> Report:
    """Run commands with mutated inputs of a kind.

    Parameters
    ----------
    kind : str
        Kind of the inputs, a key of ``KINDS``.
    numbers : iterable of int
        Numbers of the inputs: an input follows from the seed, the kind and its number alone.
    seed : int
        Seed.
    stock : Stock
        Files to mutate.
    home : Path
        Folder of the attack. Inputs with faults stay in it.
    runner : Runner
        Where commands are run.

    Returns
    -------
    Report
        Counts and faults.
    """
    report, started = Report(seed, kind), time.monotonic()
    for number in numbers:
        folder = home / f"{kind}-{seed}-{number}"
        folder.mkdir(parents=True)
        draw = random.Random(f"{seed} {kind} {number}")
        wrong = list(_one(kind, stock, folder, draw, runner, report))
        report.inputs += 1
        report.faults += [f"{folder}: {fault}" for fault in wrong]
        if not wrong:
            shutil.rmtree(folder)
    report.seconds = time.monotonic() - started
    return report


def _one(
    kind: str, stock: Stock, folder: Path, draw: random.Random, runner: Runner, report: Report
) -> Iterable[str]:
    for words in KINDS[kind].draw(stock, folder, draw):
        before = _files(folder)
        outcome = runner.run(*words, folder=folder)
        report.statuses[str(outcome.status)] += 1
        report.slowest = max(report.slowest, outcome.seconds)
        report.largest = max(report.largest, outcome.peak)
        said = f"ehlectric {' '.join(map(ascii, words))[:300]}"
        wrong = [*faults(outcome, folder, runner.temporary)]
        wrong += [f"changed {name}" for name in sorted(before ^ _files(folder)) if not name.startswith("out")]
        wrong += [f"left {path}" for path in runner.left_behind()]
        yield from (f"{said}: {fault}" for fault in wrong)
        if outcome.status != 0 or wrong:
            return


def _files(folder: Path) -> set[str]:
    """Files of a folder, with their sizes."""
    paths = (path for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
    return {f"{path.relative_to(folder)} {path.stat().st_size}" for path in paths}
