"""Steps of a transient solution that line and point contacts take differently, in one table."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, Literal, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.cases.grid import Grid
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.conditions import Conditions, PointConditions, resolve, resolve_point
from ehlectric.contact.problems import (
    domain_of,
    field_problem,
    film_problem,
    line_domain_of,
    point_field_problem,
    point_film_problem,
    spacing,
    spacings,
)
from ehlectric.errors import ResultWarning
from ehlectric.field.line import Field, solve_field
from ehlectric.field.point import PointField, solve_point_field
from ehlectric.film.line import Film
from ehlectric.film.mesh import Mesh
from ehlectric.film.point import PointFilm, semi_axis_across
from ehlectric.film.problem import FilmProblem
from ehlectric.motion.roughness import MovingRoughness
from ehlectric.surfaces.rough_maps import RoughMap, rough_maps
from ehlectric.surfaces.rough_profiles import RoughSurface, rough_surfaces
from ehlectric.surfaces.warnings import map_surface_warnings, profile_surface_warnings

C = TypeVar("C")  # conditions
R = TypeVar("R")  # rough surface
F = TypeVar("F")  # film
E = TypeVar("E")  # field


@dataclass(frozen=True)
class Kind(Generic[C, R, F, E]):
    """Functions of one kind of transient contact.

    Attributes
    ----------
    name : str
        Geometry of the case, "line" or "point".
    axes : tuple of str
        Names of the axes of a map: x along entrainment, and of a point contact y across it.
    capacitance_unit : str
        Unit of the capacitance in the field range.
    resolve : callable
        Conditions of a case.
    nodes_across : callable
        Changes to a grid that keep its nodes across entrainment when nodes along it are added.
    rough : callable
        Rough surfaces of a case on its domain, made or read.
    film_problem : callable
        Film equations of a case with the roughness at rest, from the case, the case with the domain as long
        as its surfaces travel, the conditions and the moving roughness.
    shaped : callable
        Values of the solver's mesh, shape (nx, ny), as a film keeps them.
    film : callable
        Film from its values, the problem and the mesh.
    positions : callable
        Positions of the film's nodes along each axis [m].
    solve_field : callable
        Electric field in a film with its roughness.
    column_strength : callable
        Largest field strength across the film at its nodes [V/m]; not a number outside the field range.
    in_hertz_zone : callable
        Mask of the nodes in the Hertz zone, from the conditions and the positions along each axis [m].
    warnings : callable
        Warnings about a case and its rough surfaces, from the same as ``film_problem`` takes.
    """

    name: str
    axes: tuple[str, ...]
    capacitance_unit: str
    resolve: Callable[[Case], C]
    nodes_across: Callable[[Grid], dict[str, int]]
    rough: Callable[[Case, C], Sequence[R]]
    film_problem: Callable[[Case, Case, C, MovingRoughness], FilmProblem]
    shaped: Callable[[Mesh, NDArray[Any]], NDArray[Any]]
    film: Callable[[dict[str, Any], FilmProblem, Mesh], F]
    positions: Callable[[F], tuple[Array, ...]]
    solve_field: Callable[[Case, C, F, Array], E]
    column_strength: Callable[[F, E], Array]
    in_hertz_zone: Callable[..., Mask]
    warnings: Callable[[Case, Case, C, MovingRoughness], Iterator[ResultWarning]]


AnyKind: TypeAlias = Kind[Any, Any, Any, Any]


def _line_film_problem(
    case: Case, _travelled: Case, conditions: Conditions, roughness: MovingRoughness
) -> FilmProblem:
    return film_problem(case, conditions, cast("list[RoughSurface]", roughness.resting))


def _point_film_problem(
    case: Case, travelled: Case, conditions: PointConditions, roughness: MovingRoughness
) -> FilmProblem:
    problem = point_film_problem(case, conditions, cast("list[RoughMap]", roughness.resting))
    # One half of the contact suffices only where all roughness that comes is its own mirror image.
    whole = point_film_problem(travelled, conditions, cast("list[RoughMap]", roughness.surfaces))
    return replace(problem, width=whole.width)


def _point_film(values: dict[str, Any], problem: FilmProblem, mesh: Mesh) -> PointFilm:
    return PointFilm(
        **values,
        y=problem.scales.length * mesh.whole_y,
        semi_axis_y=semi_axis_across(problem),
        side_deficit=0.0,
    )


def _line_field(case: Case, conditions: Conditions, film: Film, roughness: Array) -> Field:
    return solve_field(field_problem(case, conditions, film, roughness))


def _point_field(case: Case, conditions: PointConditions, film: PointFilm, roughness: Array) -> PointField:
    field = solve_point_field(point_field_problem(case, conditions, film, roughness))
    return field.mirrored() if field.y[0] == 0.0 else field


def _line_column_strength(film: Film, field: Field) -> Array:
    return np.interp(film.x, field.x, field.column_strength, left=math.nan, right=math.nan)


def _point_column_strength(film: PointFilm, field: PointField) -> Array:
    between = RegularGridInterpolator((field.x, field.y), field.column_strength, bounds_error=False)
    strength: Array = between(np.stack(np.meshgrid(film.x, film.y, indexing="ij"), axis=-1))
    return strength


def _in_line_zone(conditions: Conditions, x: Array) -> Mask:
    return np.asarray(np.abs(x) < conditions.half_width)


def _in_point_zone(conditions: PointConditions, x: Array, y: Array) -> Mask:
    along, across = x[:, np.newaxis] / conditions.semi_axis_x, y / conditions.semi_axis_y
    return np.asarray(np.hypot(along, across) < 1.0)


def _line_warnings(
    case: Case, travelled: Case, conditions: Conditions, roughness: MovingRoughness
) -> Iterator[ResultWarning]:
    yield from line_case_warnings(case, conditions)
    surfaces = cast("list[RoughSurface]", roughness.surfaces)
    domain, distance = line_domain_of(travelled, conditions), spacing(travelled, conditions)
    yield from profile_surface_warnings(travelled.roughness, surfaces, domain, distance)


def _point_warnings(
    case: Case, travelled: Case, conditions: PointConditions, roughness: MovingRoughness
) -> Iterator[ResultWarning]:
    yield from point_case_warnings(case, conditions)
    surfaces = cast("list[RoughMap]", roughness.surfaces)
    domain, distances = domain_of(travelled, conditions), spacings(case, conditions)
    yield from map_surface_warnings(travelled.roughness, surfaces, domain, *distances)


LINE = Kind[Conditions, RoughSurface, Film, Field](
    name="line",
    axes=("x",),
    capacitance_unit="F/m",
    resolve=resolve,
    nodes_across=lambda _grid: {},
    rough=lambda case, conditions: rough_surfaces(case.roughness, line_domain_of(case, conditions)),
    film_problem=_line_film_problem,
    shaped=lambda _mesh, values: values[:, 0],
    film=lambda values, _problem, _mesh: Film(**values),
    positions=lambda film: (film.x,),
    solve_field=_line_field,
    column_strength=_line_column_strength,
    in_hertz_zone=_in_line_zone,
    warnings=_line_warnings,
)
POINT = Kind[PointConditions, RoughMap, PointFilm, PointField](
    name="point",
    axes=("x", "y"),
    capacitance_unit="F",
    resolve=resolve_point,
    nodes_across=lambda grid: {"nodes_y": grid.nodes_across},
    rough=lambda case, conditions: rough_maps(case.roughness, domain_of(case, conditions)),
    film_problem=_point_film_problem,
    shaped=lambda mesh, values: mesh.mirrored(values),
    film=_point_film,
    positions=lambda film: (film.x, film.y),
    solve_field=_point_field,
    column_strength=_point_column_strength,
    in_hertz_zone=_in_point_zone,
    warnings=_point_warnings,
)
KINDS: dict[Literal["line", "point"], AnyKind] = {"line": LINE, "point": POINT}
