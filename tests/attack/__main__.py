"""The attack by hand: ``python -m tests.attack --seed 7 --hours 2``."""

from __future__ import annotations

import argparse
import tempfile
import time
from itertools import count
from pathlib import Path

from tests.attack.attack import attack
from tests.attack.inputs import KINDS
from tests.attack.runner import Runner
from tests.attack.stock import make


def main() -> int:
    """Attack until the time is up; the exit status is 1 where something was wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.attack", description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="seed; another one draws other inputs")
    parser.add_argument("--hours", type=float, default=1.0, help="time after which no round begins")
    parser.add_argument("--kinds", nargs="+", choices=tuple(KINDS), default=tuple(KINDS))
    parser.add_argument("--number", type=int, help="one input alone, as a fault names it")
    parser.add_argument("--batch", type=int, default=100, help="inputs of a kind in a round")
    given = parser.parse_args()
    home = Path(tempfile.mkdtemp(prefix="attack-"))
    deadline, wrong = time.monotonic() + 3600.0 * given.hours, 0
    with Runner(home / "runner") as runner:
        stock = make(home / "stock", runner)
        for turn in count():
            numbers = range(turn * given.batch, (turn + 1) * given.batch)
            for kind in given.kinds:
                report = attack(
                    kind, numbers if given.number is None else [given.number], given.seed, stock, home, runner
                )
                wrong += len(report.faults)
                print(report, *report.faults, sep="\n  ", flush=True)
            if time.monotonic() > deadline or given.number is not None:
                break
    print(f"{wrong} faults; their inputs are in {home}" if wrong else "no faults")
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main())
