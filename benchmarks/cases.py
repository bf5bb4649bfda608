"""Problems the benchmarks run on."""

from __future__ import annotations

from pathlib import Path

from ehlectric import solver
from ehlectric.case import Case
from ehlectric.conditions import resolve
from ehlectric.nested import FilmProblem
from ehlectric.poisson import FieldProblem
from ehlectric.walls import rough_surfaces

EXAMPLE = Path(__file__).parents[1] / "examples" / "line_contact.toml"


def film_problem(nodes: int) -> FilmProblem:
    """The example's film on a grid of so many nodes."""
    case = Case.from_toml(EXAMPLE).replace({"grid.nodes": nodes})
    return solver.film_problem(case, resolve(case))


def rough_film_problem(nodes: int) -> FilmProblem:
    """The film of the rough example on a grid of so many nodes."""
    case = Case.from_toml(EXAMPLE.with_name("rough_contact.toml")).replace({"grid.nodes": nodes})
    conditions = resolve(case)
    return solver.film_problem(case, conditions, rough_surfaces(case, conditions))


def field_problem(columns: int) -> FieldProblem:
    """The example's field on so many columns."""
    case = Case.from_toml(EXAMPLE).replace({"grid.field_nodes": columns})
    result = solver.solve(case)
    return solver.field_problem(case, result.conditions, result.film, result.roughness)
