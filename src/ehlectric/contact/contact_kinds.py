"""Functions of line and of point contacts, one table each, for the steps in which the two kinds differ."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.contact import problems
from ehlectric.contact.conditions import Conditions, PointConditions, resolve, resolve_point
from ehlectric.contact.contact_solution import (
    ConditionsT,
    FieldT,
    FilmT,
    RoughnessStatistics,
    Solution,
    line_roughness,
    point_roughness,
)
from ehlectric.contact.film_warnings import line_result_warnings, point_result_warnings
from ehlectric.contact.setup import Setup
from ehlectric.field import Field, FieldProblem, PointField, PointFieldProblem, solve_field, solve_point_field
from ehlectric.film import Film, FilmProblem, PointFilm, solve_film, solve_point_film
from ehlectric.formulas import film_line, film_point
from ehlectric.formulas.film_line import Formula, LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.quantities.alternatives import CONTACT_ALTERNATIVES
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface, rough_maps, rough_surfaces

RoughT = TypeVar("RoughT", RoughSurface, RoughMap)
ContactT = TypeVar("ContactT", LineContact, PointContact)
ProblemT = TypeVar("ProblemT", FieldProblem, PointFieldProblem)


@dataclass(frozen=True)
class Kind(Generic[ConditionsT, ContactT, RoughT, FilmT, ProblemT, FieldT]):
    """Functions of one kind of contact, line or point, for each step in which the kinds differ."""

    resolve: Callable[[Case], ConditionsT]  # case -> operating conditions
    # Tables of the rough surfaces, domain -> rough surfaces, read from files or generated.
    rough: Callable[[Sequence[Roughness], Domain], Sequence[RoughT]]
    # film_problem and solve_film: setup, conditions, rough surfaces -> film problem; film problem -> film.
    film_problem: Callable[[Case | Setup, ConditionsT, Sequence[RoughT]], FilmProblem]
    solve_film: Callable[..., FilmT]
    # field_problem and solve_field: setup, conditions, film, roughness -> field problem; field problem ->
    # field over the whole range.
    field_problem: Callable[[Case | Setup, ConditionsT, FilmT, Array], ProblemT]
    solve_field: Callable[[ProblemT], FieldT]
    # Function that yields warnings about the operating conditions, before the solution.
    # Setup, film, field -> warnings about the solution.
    result_warnings: Callable[[Case | Setup, FilmT, FieldT], Iterator[ResultWarning]]
    # formulas and regime: published film-thickness formulas by name, and the function that names the
    # lubrication regime.
    formulas: Mapping[str, Formula[Any]]
    regime: Callable[[ContactT], str]
    # contact_keys, grid_keys and hertz_keys: attributes of the operating conditions that a summary lists
    # under ``inputs.contact``, ``inputs.grid`` and ``hertz``
    contact_keys: tuple[str, ...]
    grid_keys: tuple[str, ...]
    hertz_keys: tuple[str, ...]
    # film_summary and field_summary: solution -> key figures of the film and of the field that are specific
    # to this kind of contact.
    film_summary: Callable[[Solution[ConditionsT, FilmT, FieldT]], dict[str, Any]]
    field_summary: Callable[[Solution[ConditionsT, FilmT, FieldT]], dict[str, Any]]
    # Solution -> statistics of the roughness over the Hertz zone.
    roughness: Callable[[Solution[ConditionsT, FilmT, FieldT]], RoughnessStatistics]


def _line_film(solution: Solution[Conditions, Film, Field]) -> dict[str, Any]:
    return {"nodes": solution.film.x.size}


def _point_film(solution: Solution[PointConditions, PointFilm, PointField]) -> dict[str, Any]:
    film = solution.film
    return {
        "nodes": list(film.thickness.shape),
        "inlet_deficit": film.inlet_deficit,
        "side_deficit": film.side_deficit,
    }


def _line_field(solution: Solution[Conditions, Film, Field]) -> dict[str, Any]:
    field, central = solution.field, None
    if solution.in_field_range(0.0):
        central = float(np.interp(0.0, field.x, field.middle_strength)) * solution.strength_scale
    return {
        "central_dimensionless": central,
        "high_field_width": field.high_field_width,
        "capacitance_per_length": field.capacitance,
        "columns": field.x.size,
    }


def _point_field(solution: Solution[PointConditions, PointFilm, PointField]) -> dict[str, Any]:
    field, central = solution.field, None
    if solution.in_field_range((0.0, 0.0)):
        along = [np.interp(0.0, field.y, row) for row in field.middle_strength]
        central = float(np.interp(0.0, field.x, along)) * solution.strength_scale
    return {
        "central_dimensionless": central,
        "high_field_area": field.high_field_area,
        "capacitance": field.capacitance,
        "capacitance_by_charge": field.capacitance_by_charge,
        "capacitance_by_zone": solution.capacitance_by_zone,
        "columns": list(field.middle_strength.shape),
    }


def _whole_field(problem: PointFieldProblem) -> PointField:
    """Field on both sides of the plane y = 0, also if the problem covers only the half y >= 0."""
    field = solve_point_field(problem)
    return field.mirrored() if field.y[0] == 0.0 else field


def _resolved(geometry: str) -> tuple[str, ...]:
    """First keys of each group of alternatives, and the slide-to-roll ratio."""
    return (*(key for rows in CONTACT_ALTERNATIVES[geometry] for key in rows[0]), "slide_to_roll_ratio")


LINE: Kind[Conditions, LineContact, RoughSurface, Film, FieldProblem, Field] = Kind(
    resolve=resolve,
    rough=rough_surfaces,
    film_problem=problems.film_problem,
    solve_film=solve_film,
    field_problem=problems.field_problem,
    solve_field=solve_field,
    result_warnings=line_result_warnings,
    formulas=film_line.FORMULAS,
    regime=film_line.regime,
    contact_keys=_resolved("line"),
    grid_keys=(),
    hertz_keys=("half_width", "max_pressure"),
    film_summary=_line_film,
    field_summary=_line_field,
    roughness=line_roughness,
)

POINT: Kind[PointConditions, PointContact, RoughMap, PointFilm, PointFieldProblem, PointField] = Kind(
    resolve=resolve_point,
    rough=rough_maps,
    film_problem=problems.point_film_problem,
    solve_film=solve_point_film,
    field_problem=problems.point_field_problem,
    solve_field=_whole_field,
    result_warnings=point_result_warnings,
    formulas=film_point.FORMULAS,
    regime=film_point.regime,
    contact_keys=_resolved("point"),
    grid_keys=("side",),
    hertz_keys=("semi_axis_x", "semi_axis_y", "max_pressure"),
    film_summary=_point_film,
    field_summary=_point_field,
    roughness=point_roughness,
)

# Kind of contact whose types are not known before run time, for example the kind of a case read from a file.
AnyKind = Kind[Any, Any, Any, Any, Any, Any]

# Kinds of contact by the ``geometry`` of a case or of operating conditions.
KINDS: Mapping[str, AnyKind] = {"line": LINE, "point": POINT}
