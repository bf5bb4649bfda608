"""The attack by hand: ``python -m tests.attack --seed 7 --hours 2``."""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from tests.attack.attack import Report, attack
from tests.attack.inputs import KINDS
from tests.attack.kills import SCENARIOS, kill
from tests.attack.runner import Runner
from tests.attack.stock import Stock, make


def main() -> int:
    """Attack until the time is up; the exit status is 1 where something was wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.attack", description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="seed; another one draws other inputs")
    parser.add_argument("--hours", type=float, default=1.0, help="time after which no round begins")
    parser.add_argument(
        "--kinds", nargs="*", choices=tuple(KINDS), default=tuple(KINDS), help="kinds of inputs"
    )
    parser.add_argument(
        "--kills", nargs="*", choices=tuple(SCENARIOS), default=tuple(SCENARIOS), help="commands to kill"
    )
    parser.add_argument("--number", type=int, help="one input alone, as a fault names it")
    parser.add_argument(
        "--batch", type=int, default=100, help="inputs of a kind, and kills of a command, in a round"
    )
    given = parser.parse_args()
    home = Path(tempfile.mkdtemp(prefix="attack-"))
    deadline, wrong = time.monotonic() + 3600.0 * given.hours, 0
    with Runner(home / "runner") as runner:
        stock = make(home / "stock", runner)
        for turn in count():
            for report in _round(given, turn, stock, home, runner):
                wrong += len(report.faults)
                sys.stdout.write("\n  ".join((str(report), *report.faults)) + "\n")
                sys.stdout.flush()
            if time.monotonic() > deadline or given.number is not None:
                break
    sys.stdout.write(f"{wrong} faults; their inputs are in {home}\n" if wrong else "no faults\n")
    return int(wrong > 0)


def _round(
    given: argparse.Namespace, turn: int, stock: Stock, home: Path, runner: Runner
) -> Iterator[Report]:
    """One round of all kinds of inputs, and of all kills."""
    if given.number is not None:
        for kind in given.kinds:
            yield attack(kind, [given.number], given.seed, stock, home, runner)
        return
    for kind in given.kinds:
        numbers = range(turn * given.batch, (turn + 1) * given.batch)
        yield attack(kind, numbers, given.seed, stock, home, runner)
    for name in given.kills:
        yield kill(name, given.batch, given.seed + 1000 * turn, stock, home / f"round-{turn}", runner)


if __name__ == "__main__":
    raise SystemExit(main())
