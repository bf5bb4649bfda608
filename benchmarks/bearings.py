"""Wall time of a whole bearing, a 6208, and how far contacts that are not solved are off.

python -m benchmarks.bearings
python -m benchmarks.bearings --speeds
"""

from __future__ import annotations

import argparse
import os
import platform
import time
from pathlib import Path

from benchmarks.measure import best, processor
from ehlectric.bearing.bearing_discharges import breakdown_of
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.solution import BearingSolution, capacitance, film_error
from ehlectric.bearing.solving import solution_of
from ehlectric.cases.bearing_case import BearingCase

EXAMPLE = Path(__file__).parents[1] / "examples" / "bearing_6208.toml"

# What this project set itself, on two cores [s], and how often each is run.
LIMITS = {"solved": (60.0, 1), "atlas": (0.5, 5), "formula": (0.5, 5)}

# Speeds at which quick contacts are compared with solved ones [rpm].
SPEEDS = (500, 1000, 3000, 6000, 15000)


def times() -> None:
    """Print the table of docs/performance.md."""
    print("| contacts of `examples/bearing_6208.toml` | seconds | limit |")
    print("| --- | ---: | ---: |")
    for contacts, (limit, repeats) in LIMITS.items():
        case = BearingCase.from_toml(EXAMPLE).replace({"contacts": contacts})
        seconds = best(lambda case=case: solve_bearing(case).summary(), repeats)
        print(f"| {contacts} | {seconds:.2f} | {limit:g} |")


def speeds() -> None:
    """Print the table of docs/guide/bearing.md: differences of quick contacts from solved ones."""
    print("| speed | contacts | capacitance | in air | first breakdown | stated | left the atlas | CPU s |")
    print("| ---: | --- | ---: | ---: | ---: | ---: | --- | ---: |")
    for speed in SPEEDS:
        case = BearingCase.from_toml(EXAMPLE).replace({"bearing.inner_speed": f"{speed} rpm"})
        solved = _numbers(solution_of(case.replace({"contacts": "solved"})))
        for contacts in ("atlas", "formula"):
            quick = case.replace({"contacts": contacts})
            solution_of(quick)
            begun = time.process_time()
            solution = solution_of(quick)
            seconds = time.process_time() - begun
            pairs = zip(_numbers(solution), solved, strict=True)
            cells = [f"{100.0 * (own / other - 1.0):+.2f} %" for own, other in pairs]
            stated = f"{100.0 * film_error(solution):.1f} %"
            print(
                "|",
                " | ".join([f"{speed}", contacts, *cells, stated, _left(solution), f"{seconds:.2f}"]),
                "|",
            )


def _numbers(solution: BearingSolution) -> tuple[float, float, float]:
    """Capacitance in oil and in air [F], and first breakdown voltage [V]; the example has a strength."""
    breakdown = breakdown_of(solution)
    assert breakdown is not None
    return capacitance(solution, "oil"), capacitance(solution, "air"), breakdown.first_break


def _left(solution: BearingSolution) -> str:
    """Numbers of contacts outside the atlas: all, and those with at least 2 % of the largest load."""
    every, loaded = (
        sum(any(warning.code == "atlas-left" for warning in contact.warnings) for contact in contacts)
        for contacts in (
            [contact for curve in solution.curves for contact in curve.solutions],
            [contact for curve in solution.curves for contact in curve.counted.solutions],
        )
    )
    return f"{every}, {loaded} loaded"


def main() -> None:
    """Print the tables that the command asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speeds", action="store_true", help="compare with solved contacts over the speed")
    print(f"{processor()}, {len(os.sched_getaffinity(0))} cores, Python {platform.python_version()}\n")
    if parser.parse_args().speeds:
        speeds()
    else:
        times()


if __name__ == "__main__":
    main()
