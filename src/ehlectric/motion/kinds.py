"""Functions of transient solutions that differ between line and point contacts, in one table."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, Literal, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.cases.grid import Grid
from ehlectric.contact import kinds as contact_kinds
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.problems import film_problem, point_film_problem
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.mesh import Mesh
from ehlectric.film.point import PointFilm, semi_axis_across
from ehlectric.film.problem import FilmProblem
from ehlectric.film.solution import FilmSolution
from ehlectric.motion.roughness import MovingRoughness
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface

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
        Names of the axes of a map: x along entrainment and, for a point contact, y across it.
    capacitance_unit : str
        Unit of the capacitance in the field range.
    contact : Kind
        Functions of the stationary contact of the same kind.
    nodes_across : callable
        Changes to a grid that keep its nodes across entrainment when nodes along entrainment are added.
    film_problem : callable
        Film equations with the rough surfaces at rest only. Its arguments are the case, the case with the
        extended domain (see ``TransientContact``), the conditions and the moving roughness.
    shaped : callable
        Values on the solver's mesh, shape (nx, ny), in the shape of the arrays of a film.
    film : callable
        Film from its solution, the film equations and the mesh.
    column_strength : callable
        Largest field strength across the film at its nodes [V/m]; NaN outside the field range.
    in_hertz_zone : callable
        Mask of the nodes in the Hertz zone, from the conditions and the positions along each axis [m].
    """

    name: str
    axes: tuple[str, ...]
    capacitance_unit: str
    contact: contact_kinds.AnyKind
    nodes_across: Callable[[Grid], dict[str, int]]
    film_problem: Callable[[Case, Case, C, MovingRoughness], FilmProblem]
    shaped: Callable[[Mesh, NDArray[Any]], NDArray[Any]]
    film: Callable[[FilmSolution, FilmProblem, Mesh], F]
    column_strength: Callable[[F, E], Array]
    in_hertz_zone: Callable[..., Mask]


AnyKind: TypeAlias = Kind[Any, Any, Any, Any]


def _line_film_problem(
    case: Case, _travelled: Case, conditions: Conditions, roughness: MovingRoughness
) -> FilmProblem:
    return film_problem(case, conditions, cast("list[RoughSurface]", roughness.resting))


def _point_film_problem(
    case: Case, travelled: Case, conditions: PointConditions, roughness: MovingRoughness
) -> FilmProblem:
    problem = point_film_problem(case, conditions, cast("list[RoughMap]", roughness.resting))
    # Half of the contact suffices only if all roughness that passes is symmetric about y = 0.
    whole = point_film_problem(travelled, conditions, cast("list[RoughMap]", roughness.surfaces))
    return replace(problem, width=whole.width)


def _point_film(solution: FilmSolution, problem: FilmProblem, mesh: Mesh) -> PointFilm:
    y = problem.scales.length * mesh.whole_y
    return PointFilm.of(solution, y=y, semi_axis_y=semi_axis_across(problem))


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


LINE = Kind[Conditions, RoughSurface, Film, Field](
    name="line",
    axes=("x",),
    capacitance_unit="F/m",
    contact=contact_kinds.LINE,
    nodes_across=lambda _grid: {},
    film_problem=_line_film_problem,
    shaped=lambda _mesh, values: values[:, 0],
    film=lambda solution, _problem, _mesh: Film.of(solution),
    column_strength=_line_column_strength,
    in_hertz_zone=_in_line_zone,
)
POINT = Kind[PointConditions, RoughMap, PointFilm, PointField](
    name="point",
    axes=("x", "y"),
    capacitance_unit="F",
    contact=contact_kinds.POINT,
    nodes_across=lambda grid: {"nodes_y": grid.nodes_across},
    film_problem=_point_film_problem,
    shaped=lambda mesh, values: mesh.mirrored(values),
    film=_point_film,
    column_strength=_point_column_strength,
    in_hertz_zone=_in_point_zone,
)
KINDS: dict[Literal["line", "point"], AnyKind] = {"line": LINE, "point": POINT}
