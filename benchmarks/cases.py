"""Problems the benchmarks run on."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact import problems as point_problems
from ehlectric.contact import solver
from ehlectric.contact.problems import line_domain_of
from ehlectric.contact.resolve import resolve, resolve_point
from ehlectric.field.poisson import FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem
from ehlectric.film.point import solve_point_film
from ehlectric.film.problem import FilmProblem
from ehlectric.surfaces.rough_profiles import rough_surfaces

EXAMPLES = Path(__file__).parents[1] / "examples"
EXAMPLE = EXAMPLES / "line_contact.toml"


def film_problem(nodes: int) -> FilmProblem:
    """The example's film on a grid of so many nodes."""
    case = Case.from_toml(EXAMPLE).replace({"grid.nodes": nodes})
    return solver.film_problem(case, resolve(case))


def rough_film_problem(nodes: int) -> FilmProblem:
    """The film of the rough example on a grid of so many nodes."""
    case = Case.from_toml(EXAMPLE.with_name("rough_contact.toml")).replace({"grid.nodes": nodes})
    conditions = resolve(case)
    return solver.film_problem(
        case, conditions, rough_surfaces(case.roughness, line_domain_of(case, conditions))
    )


def field_problem(columns: int) -> FieldProblem:
    """The example's field on so many columns."""
    case = Case.from_toml(EXAMPLE).replace({"grid.field_nodes": columns})
    result = solver.solve(case)
    return solver.field_problem(case, result.conditions, result.film, result.roughness)


def point_film_problem(example: str, nodes: int, wedge: str) -> FilmProblem:
    """The film of an example of a point contact on so many nodes along and across entrainment."""
    case = Case.from_toml(EXAMPLES / f"{example}.toml").replace({"grid.nodes": nodes, "grid.wedge": wedge})
    return point_problems.point_film_problem(case, resolve_point(case))


def point_field_problem(example: str, columns: int) -> PointFieldProblem:
    """The field of such an example on so many columns along and across, in the film on as many nodes."""
    grid = {"grid.nodes": columns, "grid.field_nodes": columns, "grid.field_nodes_y": columns}
    case = Case.from_toml(EXAMPLES / f"{example}.toml").replace(grid)
    conditions = resolve_point(case)
    film = solve_point_film(point_problems.point_film_problem(case, conditions))
    smooth = np.zeros((2, *film.thickness.shape))
    return point_problems.point_field_problem(case, conditions, film, smooth)
