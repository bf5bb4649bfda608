"""Wall time of a whole bearing, a 6208, and how far contacts that are not solved are off.

python -m benchmarks.bearings
python -m benchmarks.bearings --speeds
python -m benchmarks.bearings --many
"""

from __future__ import annotations

import argparse
import os
import platform
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.measure import best, processor
from ehlectric.bearing.bearing_discharges import breakdown_of
from ehlectric.bearing.many_points import columns_of
from ehlectric.bearing.margin import QuickMargins
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.solution import BearingSolution, capacitance, film_error
from ehlectric.bearing.solving import solution_of
from ehlectric.bearing.uncertainty import uncertainty_of
from ehlectric.cases.bearing_case import BearingCase

EXAMPLE = Path(__file__).parents[1] / "examples" / "bearing_6208.toml"

# What this project set itself, on two cores [s], and how often each is run.
LIMITS = {"solved": (60.0, 1), "atlas": (0.5, 5), "formula": (0.5, 5)}

# Speeds at which quick contacts are compared with solved ones [rpm].
SPEEDS = (500, 1000, 3000, 6000, 15000)


def times() -> None:
    """Print the wall time of the example with contacts of each kind, for docs/validation/performance.md."""
    print("| contacts of `examples/bearing_6208.toml` | seconds | limit |")
    print("| --- | ---: | ---: |")
    for contacts, (limit, repeats) in LIMITS.items():
        case = BearingCase.from_toml(EXAMPLE).replace({"contacts": contacts})
        seconds = best(lambda case=case: solve_bearing(case).summary(), repeats)
        print(f"| {contacts} | {seconds:.2f} | {limit:g} |")


def speeds() -> None:
    """Print the differences of quick contacts from solved ones, for docs/howto/film_sources.md."""
    print("| speed | contacts | capacitance | in air | first breakdown | stated | left the atlas | CPU s |")
    print("| ---: | --- | ---: | ---: | ---: | ---: | --- | ---: |")
    for speed in SPEEDS:
        # Summits would widen the differences of the films, which are compared.
        changes = {"bearing.inner_speed": f"{speed} rpm", "bearing.summit_height": 0.0}
        case = BearingCase.from_toml(EXAMPLE).replace(changes)
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


# Points that are evaluated together, and how often; the first time makes tables that the others find.
MANY, REPEATS = 2000, 5


def many() -> None:
    """Print the processor time of many bearings at once, and of the probability of breakdown of one."""
    case = BearingCase.from_toml(EXAMPLE).replace({"contacts": "atlas"})
    bearing, rng, seconds = case.bearing, np.random.default_rng(1), []
    for _ in range(REPEATS):
        points = case.with_arrays(
            {
                "bearing.inner_speed": bearing.inner_speed * rng.uniform(0.5, 2.0, MANY),
                "bearing.radial_load": bearing.radial_load * rng.uniform(0.5, 2.0, MANY),
                "bearing.temperature": bearing.oil_temperature + rng.uniform(-10.0, 10.0, MANY),
            }
        )
        seconds.append(_processor_time(lambda points=points: columns_of(points)))
    print(f"{MANY} bearings at random points: {MANY / seconds[0]:.0f} a second the first time, then", end=" ")
    print(", ".join(f"{MANY / one:.0f}" for one in seconds[1:]))
    alone = min(_processor_time(lambda: solution_of(case)) for _ in range(REPEATS))
    print(f"one bearing: {1e3 * alone:.0f} ms")
    solution = solution_of(case)
    margins = QuickMargins.of(solution)
    probable = [_processor_time(lambda: uncertainty_of(solution, margins)) for _ in range(2)]
    print(f"probability of breakdown: {probable[0]:.2f} s the first time, then {probable[1]:.2f} s")


def _processor_time(run: Callable[[], object]) -> float:
    """Processor time of a call [s]."""
    begun = time.process_time()
    run()
    return time.process_time() - begun


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
    parser.add_argument("--many", action="store_true", help="evaluate many bearings at once, on one core")
    print(f"{processor()}, {len(os.sched_getaffinity(0))} cores, Python {platform.python_version()}\n")
    arguments = parser.parse_args()
    if arguments.speeds:
        speeds()
    elif arguments.many:
        many()
    else:
        times()


if __name__ == "__main__":
    main()
