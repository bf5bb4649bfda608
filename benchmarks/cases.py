"""Film and field problems that the benchmarks solve."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact import problems
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.solver import solve
from ehlectric.field.poisson import FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem
from ehlectric.film.isothermal_film import solve_point_film
from ehlectric.film.problem import FilmProblem
from ehlectric.surfaces.rough_surfaces import rough_surfaces

EXAMPLES = Path(__file__).parents[1] / "examples"
EXAMPLE = EXAMPLES / "line_contact.toml"


def film_problem(nodes: int) -> FilmProblem:
    """Film problem of ``examples/line_contact.toml`` on a grid of ``nodes`` nodes."""
    case = Case.from_toml(EXAMPLE).replace({"grid.nodes": nodes})
    return problems.film_problem(case, resolve(case))


def rough_film_problem(nodes: int) -> FilmProblem:
    """Film problem of ``examples/rough_contact.toml`` on a grid of ``nodes`` nodes."""
    case = Case.from_toml(EXAMPLE.with_name("rough_contact.toml")).replace({"grid.nodes": nodes})
    conditions = resolve(case)
    return problems.film_problem(
        case, conditions, rough_surfaces(case.roughness, problems.domain_of(case, conditions))
    )


def field_problem(columns: int) -> FieldProblem:
    """Field problem of ``examples/line_contact.toml`` with ``columns`` columns."""
    case = Case.from_toml(EXAMPLE).replace({"grid.field_nodes": columns})
    result = solve(case)
    return problems.field_problem(case, result.conditions, result.film, result.roughness)


def point_film_problem(example: str, nodes: int, wedge: str) -> FilmProblem:
    """Film problem of a point contact in ``examples`` on nodes x nodes nodes."""
    case = Case.from_toml(EXAMPLES / f"{example}.toml").replace({"grid.nodes": nodes, "grid.wedge": wedge})
    return problems.point_film_problem(case, resolve_point(case))


def point_field_problem(example: str, columns: int) -> PointFieldProblem:
    """Field problem of a point contact in ``examples`` on columns x columns columns and film nodes."""
    grid = {"grid.nodes": columns, "grid.field_nodes": columns, "grid.field_nodes_y": columns}
    case = Case.from_toml(EXAMPLES / f"{example}.toml").replace(grid)
    conditions = resolve_point(case)
    film = solve_point_film(problems.point_film_problem(case, conditions))
    smooth = np.zeros((2, *film.thickness.shape))
    return problems.point_field_problem(case, conditions, film, smooth)
