"""Discretisation errors that the solver states on successive grids of random smooth point contacts.

python -m benchmarks.reachable_errors    (half an hour)
python -m benchmarks.reachable_errors --seed 4 --contacts 6 --most 513    (contacts from 100 on of the table)

``benchmarks/data/reachable_errors.csv`` has both tables, and ``ehlectric.film.film_errors`` is a fit to
that of seed 3. The contacts have M log-uniform in [10, 3e5], a Hertz pressure log-uniform in [0.4, 3.5] GPa
and an ellipse ratio log-uniform in [0.6, 6]; those whose L is outside [1, 25] are left out.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

import numpy as np
from tests.formulas.hertz_point import radii_ratio

from ehlectric import Case
from ehlectric.contact.conditions import PointConditions, resolve_point
from ehlectric.contact.problems import point_film_problem
from ehlectric.film.isothermal_film import solve_point_film
from ehlectric.film.mesh import Mesh
from ehlectric.film.problem import FilmProblem

MODULUS, RADIUS, VISCOSITY, ALPHA = 226e9, 10e-3, 0.04, 22e-9
# Error at which the refinement of a contact ends: below it the film is thick, and finer grids take minutes.
LEAST = 2e-3

COLUMNS = (
    "contact,moes_m,moes_l,ellipse_ratio,hertz_pressure,formula_film,intervals,"
    "spacing_x,spacing_y,nodes,error,seconds"
)


def drawn(seed: int) -> Iterator[tuple[Case, PointConditions]]:
    """Random smooth point contacts with their conditions."""
    random = np.random.default_rng(seed)
    while True:
        moes_m, pressure, ratio = (
            float(np.exp(random.uniform(*np.log(ends)))) for ends in ((10.0, 3e5), (0.4e9, 3.5e9), (0.6, 6.0))
        )
        contact = {
            "geometry": "point",
            "radius_x": RADIUS,
            "radius_y": RADIUS * radii_ratio(ratio) if ratio > 1.0 else RADIUS / radii_ratio(1.0 / ratio),
            "reduced_modulus": MODULUS,
            "max_hertz_pressure": pressure,
            "boundary_film": 0.0,
        }
        # The speed at which the contact has the load group M.
        base = {"lubricant": {"base": "paper"}, "grid": {"nodes": 129}}
        first = resolve_point(Case.from_dict({"contact": contact | {"entrainment_speed": 1.0}} | base))
        speed = (first.contact.moes_m / moes_m) ** (4.0 / 3.0)
        try:
            case = Case.from_dict({"contact": contact | {"entrainment_speed": speed}} | base)
            conditions = resolve_point(case)
        except ValueError:
            continue
        if 1.0 <= conditions.contact.moes_l <= 25.0:
            yield case, conditions


def rows(
    case: Case, conditions: PointConditions, most: int
) -> Iterator[tuple[FilmProblem, Mesh, float | None, float]]:
    """Problem, successive grids of a contact, their errors, and the time up to the end of each [s]."""
    found: list[tuple[Mesh, float | None, float]] = []
    started = time.perf_counter()
    problem = replace(
        point_film_problem(case, conditions),
        target_error=LEAST,
        most_nodes=most,
        on_grid=lambda mesh, error: found.append((mesh, error, time.perf_counter() - started)),
    )
    solve_point_film(problem)
    for mesh, error, seconds in found:
        yield problem, mesh, error, seconds


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    options.add_argument("--seed", type=int, default=3)
    options.add_argument("--contacts", type=int, default=18)
    options.add_argument("--most", type=int, default=1025)
    chosen = options.parse_args()
    print(COLUMNS)
    for number, (case, conditions) in enumerate(islice(drawn(chosen.seed), chosen.contacts)):
        group = conditions.contact
        for problem, mesh, error, seconds in rows(case, conditions, chosen.most):
            intervals = round((problem.outlet - problem.inlet) / mesh.dx)
            print(
                f"{number},{group.moes_m:.5g},{group.moes_l:.4g},{conditions.ratio:.4g},"
                f"{conditions.max_pressure:.4g},{problem.thickness_guess:.5g},"
                f"{intervals},{mesh.dx:.5g},{mesh.dy:.5g},{mesh.x.size * mesh.y.size},"
                f"{'' if error is None else format(error, '.4g')},{seconds:.3g}",
                flush=True,
            )


if __name__ == "__main__":
    main()
