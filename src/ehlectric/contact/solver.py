"""solve(case): the only place where film and field meet."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, Generic, TypeVar

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.memory import check_memory
from ehlectric.contact.problems import (
    domain_of,
    field_problem,
    film_problem,
    heights_of,
    line_domain_of,
    point_field_problem,
    point_film_problem,
    spacing,
    spacings,
)
from ehlectric.contact.result_warnings import (
    field_warnings,
    film_warnings,
    line_result_warnings,
    point_result_warnings,
)
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solution import Smooth
from ehlectric.discharge.assessment import discharge_warnings
from ehlectric.errors import ConvergenceError, InputError, ResultWarning
from ehlectric.field.line import Field, solve_field
from ehlectric.field.point import solve_point_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.film.line import Film, solve_film
from ehlectric.film.point import PointFilm, solve_point_film
from ehlectric.film.state import Progress
from ehlectric.surfaces.rough_maps import rough_maps
from ehlectric.surfaces.rough_profiles import rough_surfaces
from ehlectric.surfaces.warnings import map_surface_warnings, profile_surface_warnings
from ehlectric.version import __version__

_Film = TypeVar("_Film", Film, PointFilm)

# Grids in succession on which nothing becomes known of the error, after which refining is given up: each
# takes several times as long as the one before.
_UNKNOWN = 3


@dataclass(frozen=True)
class Solvers:
    """What solves the film and the field of a case, by the name under which a result says so.

    ``check`` raises an InputError for cases they do not take, before anything is solved.
    """

    name: str
    film: Callable[..., Film]
    field: Callable[[FieldProblem], Field]
    check: Callable[[Case], object]


OWN = Solvers("ehlectric", solve_film, solve_field, check=lambda _case: None)


def solve(
    case: Case,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: Solvers = OWN,
    beside_smooth: bool = True,
) -> Result | PointResult:
    """Film and electric field of a case.

    Parameters
    ----------
    case : Case
        What to solve.
    progress : callable, optional
        Called with (nodes, Newton step, residual) before every Newton step of the film.
    require_convergence : bool
        Raise where the film was not solved, instead of giving back its status.
    solvers : Solvers
        The package's own, or those of ``ehlectric.paper.solvers``.
    beside_smooth : bool
        Solve a rough contact with smooth surfaces too, for ``Result.smooth``.

    Returns
    -------
    Result or PointResult
        By the geometry of the contact, with ``converged`` false where the film was not solved; its field is
        then that of the last film.

    Raises
    ------
    InputError
        Where the values of the case contradict each other, or its roughness moves.
    ConvergenceError
        Where the film was not solved and ``require_convergence`` is set, or its field was not.

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> round(solve(case).film.minimum_thickness * 1e6, 2)
    0.74
    """
    solvers.check(case)
    if case.motion is not None:
        raise InputError(
            "motion", got="it where a film at rest is solved;", takes="run_motion, or a case without it"
        )
    if case.contact.geometry == "point":
        return _solve_point(case, progress, demand=require_convergence, beside_smooth=beside_smooth)
    return solve_line(
        case,
        progress=progress,
        require_convergence=require_convergence,
        solvers=solvers,
        beside_smooth=beside_smooth,
    )


def solve_line(
    case: Case,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: Solvers = OWN,
    beside_smooth: bool = True,
) -> Result:
    """``solve`` for a line contact alone; an InputError for others."""
    conditions = resolve(case)
    check_memory(case)
    domain = line_domain_of(case, conditions)
    rough = rough_surfaces(case.roughness, domain)
    refined = _refined(
        case,
        lambda grid: solvers.film(film_problem(grid, conditions, rough), progress=progress),
        demand=require_convergence,
    )
    film, on_grid = refined.film, refined.case
    roughness = heights_of(rough, film.x)
    # The field of a film that was not found is for looking at: the direct solver always has one.
    of_field = solvers if film.converged else OWN
    started = time.perf_counter()
    field = of_field.field(field_problem(case, conditions, film, roughness))
    return Result(
        case=case,
        conditions=conditions,
        film=film,
        roughness=roughness,
        rough=tuple(surface.describe() for surface in rough),
        smooth=_smooth(on_grid, (field.x,), solvers) if rough and beside_smooth else None,
        field=field,
        warnings=(
            *line_case_warnings(case, conditions),
            *profile_surface_warnings(case.roughness, rough, domain, spacing(on_grid, conditions)),
            *refined.warnings,
            *film_warnings(case, film),
            *line_result_warnings(case, film, field),
            *discharge_warnings(case.discharge, film),
            *field_warnings(field.max_strength),
        ),
        film_solver=solvers.name,
        field_solver=of_field.name,
        **_provenance(refined.seconds, started),
    )


def _solve_point(case: Case, progress: Progress | None, *, demand: bool, beside_smooth: bool) -> PointResult:
    conditions = resolve_point(case)
    check_memory(case)
    domain = domain_of(case, conditions)
    rough = rough_maps(case.roughness, domain)
    refined = _refined(
        case,
        lambda grid: solve_point_film(point_film_problem(grid, conditions, rough), progress=progress),
        demand=demand,
    )
    film, on_grid = refined.film, refined.case
    roughness = heights_of(rough, film.x, film.y)
    started = time.perf_counter()
    field = solve_point_field(point_field_problem(case, conditions, film, roughness))
    if field.y[0] == 0.0:
        field = field.mirrored()
    return PointResult(
        case=case,
        conditions=conditions,
        film=film,
        roughness=roughness,
        rough=tuple(surface.describe() for surface in rough),
        smooth=_smooth(on_grid, (field.x, field.y), OWN) if rough and beside_smooth else None,
        field=field,
        warnings=(
            *point_case_warnings(case, conditions),
            *map_surface_warnings(case.roughness, rough, domain, *spacings(on_grid, conditions)),
            *refined.warnings,
            *film_warnings(case, film),
            *point_result_warnings(case, film, field),
            *discharge_warnings(case.discharge, film),
            *field_warnings(field.max_strength),
        ),
        film_solver=OWN.name,
        field_solver=OWN.name,
        **_provenance(refined.seconds, started),
    )


def _provenance(film_seconds: float, field_started: float) -> dict[str, Any]:
    """How long it took, when and by what."""
    return {
        "film_seconds": film_seconds,
        "field_seconds": time.perf_counter() - field_started,
        "version": __version__,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
    }


@dataclass(frozen=True)
class _Refined(Generic[_Film]):
    """A film, the case with the grid it was solved on, the time it took [s], and its warnings."""

    film: _Film
    case: Case
    seconds: float
    warnings: tuple[ResultWarning, ...]


def _refined(case: Case, solved: Callable[[Case], _Film], *, demand: bool) -> _Refined[_Film]:
    """The film on the grid of the case, or on the first of twice as many intervals that is fine enough."""
    started, target = time.perf_counter(), case.grid.refine
    warnings: tuple[ResultWarning, ...] = ()
    grid = case if target is None else case.replace({"grid.refine": None})
    errors: list[float | None] = []
    film = solved(grid)
    while target is not None and not _within(film, target):
        errors.append(film.discretisation_error)
        if len(errors) >= _UNKNOWN and not any(errors[-_UNKNOWN:]):
            unknown = f"nothing is known of its error on {_UNKNOWN} grids in succession"
            warnings = (_not_reached(target, grid, unknown),)
            break
        try:
            finer = _doubled(grid)
            check_memory(finer)
        except InputError as error:
            warnings = (_not_reached(target, grid, str(error)),)
            break
        grid = finer
        film = solved(grid)
    if demand and not film.converged:
        raise ConvergenceError(f"film {film.status} at the residual {film.residual:.1e}")
    return _Refined(film, grid, time.perf_counter() - started, warnings)


def _not_reached(target: float, case: Case, reason: str) -> ResultWarning:
    text = f"grid.refine: {100 * target:g} % was not reached with {case.grid.nodes} nodes; {reason}"
    return ResultWarning("refine-not-reached", text)


def _doubled(case: Case) -> Case:
    """The case with twice as many intervals."""
    changes = {"grid.nodes": 2 * case.grid.nodes - 1}
    if case.grid.nodes_y is not None:
        changes["grid.nodes_y"] = 2 * case.grid.nodes_y - 1
    return case.replace(changes)


def _within(film: Film, target: float) -> bool:
    """Whether a film's discretisation error is known to be below a target."""
    return film.discretisation_error is not None and film.discretisation_error <= target


def _smooth(case: Case, columns: tuple[Array, ...], solvers: Solvers) -> Smooth | None:
    """The case without its roughness, on the same grids; None where that is not solved."""
    result = solve(case.replace(roughness=()), solvers=solvers)
    if not result.converged:
        return None
    axes = (result.field.x,) if isinstance(result, Result) else (result.field.x, result.field.y)
    middle = RegularGridInterpolator(axes, result.field.middle_strength)
    at = np.stack(np.meshgrid(*columns, indexing="ij"), axis=-1)
    return Smooth(result.film.pressure, result.film.thickness, middle(at))
