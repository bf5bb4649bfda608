"""Films in mixed lubrication of forty random contacts, each solved in several equivalent ways.

Run by hand: ``python -m benchmarks.one_solution balls`` and ``... lines``. The equivalent ways are a start
from the dry contact on the finest grid instead of from the coarser grid, the mirror image of the surface,
the whole contact instead of half of it, and heights that differ by rounding, as other routines of the
processor would make them. The table contains the largest differences of load share, mean film and median
film of each contact.

The design is a Sobol sequence over ln lambda from 0.03 to 1, ln Rq from 50 to 400 nm, the correlation length
from 20 to 35 um, and ln of the boundary film from 1 to 5 nm. All balls are symmetric about y = 0.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import process_time

import numpy as np
from scipy.stats import qmc
from tests.helpers.mixed_films import MixedFilm, gaussian, posed

from benchmarks.mixed_store import Contact
from benchmarks.time_limit import GivenUpError, processor_limit
from ehlectric.arrays import Array
from ehlectric.film.nested import levels_of, mixed_from_dry, nested_iteration
from ehlectric.film.problem import FilmProblem
from ehlectric.runtime.threads import quiet_solution

NUMBERS, NODES, SEED = {"balls": 30, "lines": 10}, {"balls": 65, "lines": 801}, 11
ROUNDING = 1e-13


def contacts(kind: str) -> Iterator[tuple[Contact, FilmProblem]]:
    """Contacts of the design, and their film problems."""
    number = NUMBERS[kind]
    values = qmc.Sobol(4, seed=SEED).random(1 << (number - 1).bit_length())[:number]
    low = np.array([np.log(0.03), np.log(50e-9), 20e-6, np.log(1e-9)])
    high = np.array([0.0, np.log(400e-9), 35e-6, np.log(5e-9)])
    for seed, row in enumerate(low + values * (high - low)):
        ratio, rq, film = (float(np.exp(row[i])) for i in (0, 1, 3))
        table = gaussian(rq, float(row[2]), seed=seed)
        contact = Contact("gaussian", kind == "balls", table, NODES[kind], ratio, film)
        problem = posed(contact.case()[0])
        yield contact, problem if kind == "lines" else symmetric(problem)


def symmetric(problem: FilmProblem) -> FilmProblem:
    """Problem of a ball whose surface is the mean of the surface and its mirror image, solved on half."""
    added, width = problem.added_gap, problem.width
    assert added is not None
    assert width is not None

    def mean(x: Array, y: Array) -> Array:
        return 0.5 * (added(x, y) + added(x, -y))

    return replace(problem, added_gap=mean, width=replace(width, symmetric=True))


def whole(problem: FilmProblem) -> FilmProblem:
    """Same contact on the whole domain."""
    assert problem.width is not None
    return replace(problem, width=replace(problem.width, symmetric=False))


def rounded(problem: FilmProblem, number: int) -> FilmProblem:
    """Same contact with heights that differ by rounding."""
    added = problem.added_gap
    assert added is not None
    rng = np.random.default_rng(number)
    a, b, c = rng.uniform(10.0, 1000.0, 3)

    def changed(x: Array, y: Array) -> Array:
        # Even in y, so that half of the contact remains half of it.
        wave = np.sin(a * x[:, np.newaxis] + c) * np.cos(b * y)
        return added(x, y) * (1.0 + ROUNDING * wave)

    return replace(problem, added_gap=changed)


def from_dry(problem: FilmProblem) -> MixedFilm:
    """Film that starts from the dry contact on the finest grid."""
    with quiet_solution():
        return MixedFilm(problem, mixed_from_dry(problem, levels_of(problem)))


def nested(problem: FilmProblem) -> MixedFilm:
    """Film that starts from the coarser grids."""
    with quiet_solution():
        return MixedFilm(problem, nested_iteration(problem, None))


def ways(problem: FilmProblem) -> dict[str, Callable[[], MixedFilm]]:
    """Equivalent ways to solve a contact, the usual way first."""
    found = {
        "nested": lambda: nested(problem),
        "half the nodes": lambda: nested(problem.halved()),
        "rounding 1": lambda: nested(rounded(problem, 1)),
        "rounding 2": lambda: nested(rounded(problem, 2)),
        "dry": lambda: from_dry(problem),
    }
    if problem.width is not None:
        found["whole"] = lambda: nested(whole(problem))
    return found


@dataclass(frozen=True)
class Outcome:
    """Key figures of a film."""

    status: str
    share: float = np.nan
    mean: float = np.nan  # outside the spots [m]
    conserves: bool = False
    seconds: float = np.nan

    @classmethod
    def of(cls, solve: Callable[[], MixedFilm], limit: float) -> Outcome:
        """Key figures of a film, within a limit of processor time [s]."""
        start = process_time()
        try:
            with processor_limit(limit):
                film = solve()
        except GivenUpError:
            return cls("given up", seconds=limit)
        if not film.converged:
            return cls(film.last.status, seconds=process_time() - start)
        conserves = film.last.content is not None
        return cls("converged", film.share, mean_film(film), conserves, process_time() - start)


def mean_film(film: MixedFilm) -> float:
    """Mean gap over the Hertz zone outside the spots [m]."""
    weights = np.where(film.zone & ~film.touching, film.last.level.weights, 0.0)
    if not weights.any():
        return np.nan
    return float(np.vdot(weights, film.gap) / np.sum(weights)) * film.problem.scales.thickness


def row(name: str, outcomes: dict[str, Outcome], *, verbose: bool) -> str:
    """Row of the table: largest differences from the usual way, and the change from half the nodes."""
    usual, coarse = outcomes["nested"], outcomes["half the nodes"]
    others = [o for way, o in outcomes.items() if way not in ("nested", "half the nodes")]
    failed = [way for way, o in outcomes.items() if o.status != "converged"]
    making = [way for way, o in outcomes.items() if o.status == "converged" and not o.conserves]
    share = max(abs(o.share - usual.share) for o in others)
    mean = max(abs(o.mean / usual.mean - 1.0) for o in others)
    entries = [name, f"{usual.share:.4g}", f"{share:.1e}", f"{abs(coarse.share - usual.share):.1e}"]
    entries += [f"{1e9 * usual.mean:.5g}", f"{mean:.1e}", f"{abs(coarse.mean / usual.mean - 1.0):.1e}"]
    entries += [f"{sum(o.seconds for o in outcomes.values()):.1f}", " ".join(failed), " ".join(making)]
    if verbose:
        entries += [f"{way}: {o.share:.6g}, {1e9 * o.mean:.6g} nm" for way, o in outcomes.items()]
    return "| " + " | ".join(entries) + " |"


def main() -> None:
    """Solve the contacts and print a row for each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=NUMBERS)
    parser.add_argument("--limit", type=float, default=60.0, help="processor time of a film [s]")
    parser.add_argument("--only", type=int, nargs="*", help="numbers of contacts")
    parser.add_argument("--verbose", action="store_true", help="print all ways")
    asked = parser.parse_args()
    print(
        "| contact | share | other ways | half the nodes | mean film [nm] | other ways | half the nodes "
        "| time of all [s] | not converged | not conserving |",
        flush=True,
    )
    for number, (contact, problem) in enumerate(contacts(asked.kind)):
        if asked.only is None or number in asked.only:
            outcomes = {way: Outcome.of(solve, asked.limit) for way, solve in ways(problem).items()}
            name = f"{number}: lambda {contact.ratio:.2g}, {1e9 * contact.boundary_film:.2g} nm"
            print(row(name, outcomes, verbose=asked.verbose), flush=True)


if __name__ == "__main__":
    main()
