"""Processor time and memory of drives over time.

python -m benchmarks.drive
"""

from __future__ import annotations

import resource
import time
from pathlib import Path

from benchmarks.measure import processor
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.result import DriveResult, solve_drive

EXAMPLE = Path(__file__).parents[1] / "examples" / "drive.toml"

# Simulated times [s], and what each drive is: with discharges in half of the edges, in few, and in none.
TIMES = (1.0, 10.0)
DRIVES = {
    "as it is": {},
    "half the DC link": {"source.dc_link": "280 V"},
    "grounding ring": {"circuit.grounding_ring_resistance": "1 ohm"},
}


def main() -> None:
    """Print discharges, processor time and memory of each drive, for docs/validation/performance.md."""
    print(processor())
    example = DriveCase.from_toml(EXAMPLE).replace({"remedies": ()})
    solve_drive(example.replace({"drive.duration": "1 ms"}))
    print("| drive | simulated | edges | discharges | CPU s | largest memory so far |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for name, changes in DRIVES.items():
        for duration in TIMES:
            result, seconds = _timed(example.replace({**changes, "drive.duration": duration}))
            found = result.summary()
            edges = found["source"]["edges_per_second"] * duration
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
            print(
                f"| {name} | {duration:g} s | {edges:,.0f} | {found['drive']['events']:,} | {seconds:.1f} | "
                f"{memory:.0f} MB |"
            )


def _timed(case: DriveCase) -> tuple[DriveResult, float]:
    begun = time.process_time()
    result = solve_drive(case, workers=1)
    return result, time.process_time() - begun


if __name__ == "__main__":
    main()
