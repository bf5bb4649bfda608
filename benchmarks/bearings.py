"""Wall time of a whole bearing: a 6208 at one operating point, with contacts solved and by formula.

python -m benchmarks.bearings
"""

from __future__ import annotations

import os
import platform
from pathlib import Path

from benchmarks.measure import best, processor
from ehlectric.bearing.solver import solve_bearing
from ehlectric.cases.bearings.case import BearingCase

EXAMPLE = Path(__file__).parents[1] / "examples" / "bearing_6208.toml"

# What this project set itself, on two cores [s], and how often each is run.
LIMITS = {"solved": (60.0, 1), "formula": (0.5, 5)}


def main() -> None:
    """Print the table of docs/performance.md."""
    print(f"{processor()}, {len(os.sched_getaffinity(0))} cores, Python {platform.python_version()}\n")
    print("| contacts of `examples/bearing_6208.toml` | seconds | limit |")
    print("| --- | ---: | ---: |")
    for contacts, (limit, repeats) in LIMITS.items():
        case = BearingCase.from_toml(EXAMPLE).replace({"contacts": contacts})
        seconds = best(lambda case=case: solve_bearing(case).summary(), repeats)
        print(f"| {contacts} | {seconds:.2f} | {limit:g} |")


if __name__ == "__main__":
    main()
