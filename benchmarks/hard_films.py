"""Processor time of films that are hard to solve: very thin, hot and touching, rough on a measured map.

Run by hand: ``python -m benchmarks.hard_films``, or with names of parts: ``thin``, ``hot``, ``starved``,
``maps``, ``apart`` and ``touching``. Times depend on the machine: compare two versions of the package by runs
at the same time, each from its own checkout.
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time
from typing import Any

from tests.film import test_every_effect as every_combination
from tests.helpers.mixed_films import BALL, mixed_film

import ehlectric
from benchmarks import every_effect
from benchmarks.mixed import surfaces
from benchmarks.mixed_store import Contact
from benchmarks.time_limit import GivenUpError, processor_limit
from ehlectric.contact.preparation import prepare
from ehlectric.contact.setup import Setup

EXAMPLES = Path(__file__).parents[1] / "examples"

# The film is 9.2 nm thick.
THIN = {
    "contact": BALL | {"entrainment_speed": "8 mm/s"},
    "lubricant": {"base": "paper"},
    "grid": {"error": 0.03},
}

# Contacts of the random design in which many nodes touch, and their nodes along each axis.
STARVED, HOT_NODES = (57, 30), 129
MAPS, MAP_NODES, MAP_LAMBDA = ("al3d map", "x3p map"), 257, 0.3
SEEDS, SEED_NODES = 40, 193


def thin() -> Iterator[tuple[str, Callable[[], str]]]:
    """Film of a few nanometres, refined to 3 %."""

    def solve() -> str:
        film = ehlectric.solve(ehlectric.Case.from_dict(THIN)).summary()["film"]
        return f"central {1e9 * film['central_thickness']:.4g} nm, error {film['discretisation_error']:.2g}"

    yield "film of 9.2 nm to 3 %", solve


def _with_heat(case: ehlectric.Case) -> Callable[[], str]:
    def solve() -> str:
        film = every_combination.film_of(prepare(case).film_problem(Setup.of(case)))
        touching = int(film.contact.sum())
        central, rise = 1e9 * film.central_thickness, film.heated.max_temperature_rise
        return f"{film.status}, central {central:.4g} nm, {touching} nodes touch, {rise:.4g} K"

    return solve


def hot() -> Iterator[tuple[str, Callable[[], str]]]:
    """Rough, hot, flooded ball whose surfaces touch, of the combinations of all effects."""
    table = every_combination.table("point", hot=True, touching=True)
    case = ehlectric.Case.from_dict(table | {"grid": {"nodes": HOT_NODES, "nodes_y": HOT_NODES}})
    yield f"hot ball, {HOT_NODES}²", _with_heat(case)


def starved() -> Iterator[tuple[str, Callable[[], str]]]:
    """Rough, hot, starved balls whose surfaces touch."""
    every_effect.NODES["points"] = HOT_NODES
    rows = every_effect.design("points")
    for number in STARVED:
        case = every_effect.case_of("points", rows[number])
        yield f"hot starved ball {number}, {HOT_NODES}²", _with_heat(case)


def maps() -> Iterator[tuple[str, Callable[[], str]]]:
    """Measured maps whose surfaces touch."""
    tables = surfaces(point=True)
    for name in MAPS:
        case = Contact(name, point=True, table=tables[name], nodes=MAP_NODES, ratio=MAP_LAMBDA).case()[0]

        def solve(case: ehlectric.Case = case) -> str:
            film = mixed_film(case)
            return f"{film.last.status}, load share {film.share:.4g}, {film.steps} steps on the finest grid"

        yield f"{name}, {MAP_NODES}²", solve


def _of_seeds(example: str, change: dict[str, Any], surface: dict[str, Any]) -> Callable[[], str]:
    table = tomllib.loads((EXAMPLES / example).read_text("utf-8"))
    table.pop("discharge", None)
    table["contact"] |= change
    table |= {"grid": {"nodes": SEED_NODES}}
    cases = [
        ehlectric.Case.from_dict(table | {"roughness": [surface | {"seed": seed}]})
        for seed in range(1, SEEDS + 1)
    ]

    def solve() -> str:
        # One worker, whose processor time is the time of this process.
        films = []
        for one in ehlectric.solve_many(cases, workers=1):
            assert one.result is not None
            films.append(one.result.summary()["film"]["central_thickness"])
        return f"{len(films)} films, central from {1e9 * min(films):.4g} to {1e9 * max(films):.4g} nm"

    return solve


def apart() -> Iterator[tuple[str, Callable[[], str]]]:
    """Balls that differ in their roughness, whose surfaces do not touch."""
    surface = {"surface": 1, "generator": "gaussian", "rq": 20e-9, "correlation_length": 30e-6}
    yield f"{SEEDS} rough balls apart, {SEED_NODES}²", _of_seeds("ball_contact.toml", {}, surface)


def touching() -> Iterator[tuple[str, Callable[[], str]]]:
    """Balls that differ in their roughness, whose surfaces touch."""
    surface = {"surface": 1, "generator": "gaussian", "rq": 100e-9, "correlation_length": 30e-6}
    change = {"entrainment_speed": 0.02, "boundary_film": 1e-9}
    yield f"{SEEDS} rough balls in contact, {SEED_NODES}²", _of_seeds("mixed_contact.toml", change, surface)


PARTS = {each.__name__: each for each in (thin, hot, starved, maps, apart, touching)}


def main() -> None:
    """Solve the films of the parts and print a row for each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("parts", nargs="*", choices=[[], *PARTS], metavar="part", help=", ".join(PARTS))
    parser.add_argument("--limit", type=float, default=1800.0, help="processor time of a row [s]")
    asked = parser.parse_args()
    print("| film | processor time | result |\n| --- | ---: | --- |", flush=True)
    for part in asked.parts or PARTS:
        for name, solve in PARTS[part]():
            start = process_time()
            try:
                with processor_limit(asked.limit):
                    result = solve()
            except GivenUpError:
                result = "given up"
            print(f"| {name} | {process_time() - start:.1f} s | {result} |", flush=True)


if __name__ == "__main__":
    main()
