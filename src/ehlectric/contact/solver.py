"""Solution of a contact, first the film, then its electric field: ``solve`` and ``solve_contact``."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import Electric, Grid, Solver
from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.contact.capacitance_meter import meter_warnings
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.contact_heat import heat_warnings, physics_of
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.contact_memory import check_grid
from ehlectric.contact.contact_refinement import Refined, Refinement
from ehlectric.contact.contact_solution import Smooth
from ehlectric.contact.film_warnings import accuracy_warnings, film_warnings
from ehlectric.contact.preparation import MOST_STEPS, PreparedContact, prepare, widened
from ehlectric.contact.problems import domain_of, heights_of
from ehlectric.contact.result import RESULTS, PointResult, Result
from ehlectric.contact.setup import Setup
from ehlectric.contact.starvation import starvation_warnings
from ehlectric.contact.touching import Coarser, makes_oil, spot_warnings
from ehlectric.contact.warnings import case_warnings
from ehlectric.discharge.assessment import discharge_warnings, margin_warnings
from ehlectric.discharge.film_breakdown import field_warning_conditions
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.field import Field, PointField
from ehlectric.film import FilmProblem, OnGrid, Progress, with_far_field
from ehlectric.formulas.polynomials import on_nodes
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.result_warnings import ResultWarning, active
from ehlectric.runtime.files import now
from ehlectric.runtime.progress import LOGGER
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface
from ehlectric.version import __version__

# Smallest number of nodes along an axis on which a contact is solved once more for the error of its spots.
_LEAST_NODES = 33


@dataclass(frozen=True, repr=False, eq=False)
class Solvers:
    """Solvers of the film and of the field of a contact."""

    name: str
    # film and field: function that solves a film problem or a field problem, by the geometry of the contact.
    film: Mapping[str, Callable[..., Any]]
    field: Mapping[str, Callable[..., Any]]
    # Function that returns a case as these solvers solve it, or raises an InputError if they cannot.
    accept: Callable[[Case], Case]

    def __repr__(self) -> str:
        return f"<Solvers {self.name!r}>"


DEFAULT_SOLVERS = Solvers(
    "ehlectric",
    film={geometry: kind.solve_film for geometry, kind in KINDS.items()},
    field={geometry: kind.solve_field for geometry, kind in KINDS.items()},
    accept=lambda case: case,
)


def solve(
    contact: Case | PreparedContact,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: Solvers = DEFAULT_SOLVERS,
    beside_smooth: bool = True,
    on_grid: OnGrid | None = None,
) -> Result | PointResult:
    """Solve the film and then the electric field of a case or of a prepared contact, and collect the
    warnings.

    ``require_convergence``, whether to raise a ConvergenceError if the film does not converge, instead of
    returning its status; ``on_grid``, called with the grid and its discretisation error, or None, after each
    grid of a refinement. Returns result of a line contact or of a point contact. Raises InputError if the
    values of the case contradict each other, or the case has a table ``motion``; ConvergenceError if the film
    did not converge and ``require_convergence`` is True, or if the field did not converge.

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> round(solve(case).film.minimum_thickness * 1e6, 2)
    0.75
    """
    contact = _accepted(contact, solvers)
    case, conditions, rough = contact.case, contact.conditions, contact.rough
    kind, geometry = contact.kind, conditions.geometry
    contact, films, film_seconds = _on_large_domain(contact, solvers, progress, on_grid)
    film = films.film
    if makes_oil(case, conditions, film):
        film = replace(film, status="stalled")
    LOGGER.info(
        "%s contact: film %s on %s nodes in %.2g s, residual %.1e",
        geometry,
        film.status,
        " x ".join(str(axis.size) for axis in film.axes),
        film_seconds,
        film.residual,
    )
    if require_convergence and not film.converged:
        raise ConvergenceError(f"film, {film.status} at a residual of {film.residual:.1e}")
    roughness = heights_of(rough, *film.axes)
    # The field of an unconverged film is for inspection only. Other solvers may not converge for it.
    field_solvers = solvers if film.converged else DEFAULT_SOLVERS
    started = time.perf_counter()
    field = field_solvers.field[geometry](kind.field_problem(contact.case, conditions, film, roughness))
    smooth = _smooth(contact, films, field.axes, solvers) if rough and beside_smooth else None
    coarser = _coarser(contact, films, solvers) if film.converged and np.any(film.contact) else None
    return RESULTS[geometry](
        case=case,
        conditions=conditions,  # type: ignore[arg-type]  # their type follows from the geometry
        film=film,
        roughness=roughness,
        rough=tuple(surface.describe() for surface in rough),
        smooth=smooth,
        coarser=coarser,
        field=field,
        warnings=(
            *case_warnings(case, conditions),
            *contact.surface_warnings(films.setup),
            *films.warnings,
            *film_warnings(contact.case, film),
            *starvation_warnings(films.setup, film),
            *heat_warnings(contact.case, contact.conditions, film, contact.physics),
            *spot_warnings(case, conditions, film, coarser),
            *kind.result_warnings(contact.case, film, field),
            *meter_warnings(case, film),
            *_field_warnings(contact, films, field, estimated=field_solvers.name == DEFAULT_SOLVERS.name),
        ),
        film_solver=solvers.name,
        field_solver=field_solvers.name,
        film_seconds=film_seconds,
        field_seconds=time.perf_counter() - started,
        version=__version__,
        date=now(),
    )


def _accepted(contact: Case | PreparedContact, solvers: Solvers) -> PreparedContact:
    """Prepared contact as some solvers solve it. Raises InputError if they cannot, or the case is wrong."""
    if isinstance(contact, PreparedContact):
        case = contact.case
        taken = solvers.accept(case) if isinstance(case, Case) else case
        return contact if taken is case else replace(contact, case=taken)
    case = solvers.accept(contact)
    if case.motion is not None:
        raise InputError(
            "motion",
            got="[motion] where a stationary film is solved",
            takes="run_motion, or a case without it",
        )
    return prepare(case)


def solve_contact(
    conditions: Conditions | PointConditions,
    oil: Oil,
    *,
    grid: Grid,
    electric: Electric | None = None,
    solver: Solver | None = None,
    discharge: Discharge | None = None,
    roughness: Sequence[Roughness] = (),
    rough: Sequence[RoughSurface] | Sequence[RoughMap] | None = None,
    title: str = "",
    progress: Progress | None = None,
    require_convergence: bool = False,
    beside_smooth: bool = True,
) -> Result | PointResult:
    """Solve the film and the electric field of a contact from its operating conditions, without a case.

    Returns result of a line contact or of a point contact; its ``case`` is a ``Setup``; ``load`` cannot read
    a file of this result. Raises InputError if a surface cannot be used, or film and field need more than the
    available memory; ConvergenceError if the film did not converge and ``require_convergence`` is True, or if
    the field did not converge.

    Examples
    --------
    >>> from ehlectric.contact.conditions import line_conditions
    >>> from ehlectric.cases.case_oil import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> inputs = {"reduced_radius": 0.0141, "reduced_modulus": 226e9, "load_per_length": 3.92e5}
    >>> contacts = [
    ...     line_conditions(oil, **inputs, entrainment_speed=4.0, film_factor=factor) for factor in (1.0, 0.8)
    ... ]
    >>> films = [solve_contact(conditions, oil, grid=Grid(nodes=801)).film for conditions in contacts]
    >>> round(films[1].central_thickness / films[0].central_thickness, 2)
    0.8
    """
    kind = KINDS[conditions.geometry]
    setup = Setup(
        oil=oil,
        grid=grid,
        electric=electric or Electric(),
        solver=solver or Solver(),
        discharge=discharge,
        roughness=tuple(roughness),
        title=title,
    )
    check_grid(conditions.geometry, setup.first_grid, rough=bool(setup.roughness))
    domain = domain_of(setup, conditions)
    surfaces = kind.rough(setup.roughness, domain) if rough is None else rough
    return solve(
        PreparedContact(setup, conditions, domain, surfaces),
        progress=progress,
        require_convergence=require_convergence,
        beside_smooth=beside_smooth,
    )


def _on_large_domain(
    contact: PreparedContact, solvers: Solvers, progress: Progress | None, on_grid: OnGrid | None
) -> tuple[PreparedContact, Refined, float]:
    """Contact on the domain that its film needs, its films on all grids, and the time they took [s]."""
    started, geometry = time.perf_counter(), contact.conditions.geometry
    solve_film, progress = solvers.film[geometry], _logged(progress)
    refinement, default = contact.refinement, contact
    film = solve_film(replace(refinement.problem, on_grid=on_grid), progress=progress)
    films = refinement.refined(film)
    enlarged = solvers.name == DEFAULT_SOLVERS.name and contact.case.grid.default_domain
    for _ in range(MOST_STEPS if enlarged else 0):
        wider = widened(contact, films.film)
        if wider is None:
            break
        refinement = Refinement.of(Setup.of(wider.case), geometry, partial(_posed, wider, default))
        film = solve_film(replace(refinement.problem, on_grid=on_grid), progress=progress)
        if films.film.converged and not film.converged:
            break
        contact, films = wider, refinement.refined(film)
    return contact, films, time.perf_counter() - started


def _posed(contact: PreparedContact, default: PreparedContact, setup: Setup) -> FilmProblem:
    """Film problem of a contact on a domain that is larger than the ``default`` one.

    What the ambient pressure carries on the default domain is part of the load, as in the paper. The oil
    outside of the domain of a point contact carries its part of the load.
    """
    area = default.film_problem(Setup.of(default.case)).area
    problem = contact.film_problem(setup).bearing_ambient_pressure_on(area)
    return problem if problem.width is None else with_far_field(problem)


def _field_warnings(
    contact: PreparedContact, films: Refined, field: Field | PointField, *, estimated: bool
) -> Iterator[ResultWarning]:
    """Warnings about the largest field of a film, its breakdown, and its error, if it was ``estimated``.

    There are none where surfaces touch: the largest field occurs in the boundary film.
    """
    discharge, film = contact.case.discharge, films.film
    if film.contact_pressure is not None:
        return
    yield from discharge_warnings(discharge, film)
    yield from margin_warnings(discharge, contact.conditions.semi_axes, film, field)
    yield from active(field_warning_conditions(field.max_strength, "the potentials"))
    if film.converged:
        yield from accuracy_warnings(films.setup.grid, field, estimated=estimated)


def _logged(progress: Progress | None) -> Progress:
    """Progress of a film that is also logged, at the level DEBUG."""

    def step(nodes: int, number: int, residual: float) -> None:
        LOGGER.debug("film on %d nodes along x: step %d, residual %.1e", nodes, number + 1, residual)
        if progress is not None:
            progress(nodes, number, residual)

    return step


def _smooth(
    contact: PreparedContact, films: Refined, columns: tuple[Array, ...], solvers: Solvers
) -> Smooth | None:
    """Contact with smooth surfaces on the same grids; None if its film does not converge.

    ``films`` are the films of the rough contact, and ``columns`` the axes of its field [m].
    """
    case, grids = contact.case, (films.first.grid, films.setup.grid)
    if isinstance(case, Case):
        smooth = case.model_copy(update={"roughness": ()})
        solution = _solution_of_smooth(smooth, contact.conditions, contact.domain, *grids, solvers)
    else:
        solution = _smooth_solution(contact, *grids, solvers)
    if solution is None:
        return None
    film, field = solution
    nodes = films.film.axes
    return Smooth(
        on_nodes(film.pressure, film.axes, nodes),
        on_nodes(film.thickness, film.axes, nodes),
        on_nodes(field.middle_strength, field.axes, columns),
    )


@lru_cache(maxsize=1)
def _solution_of_smooth(
    case: Case,
    conditions: Conditions | PointConditions,
    domain: Domain,
    first: Grid,
    last: Grid,
    solvers: Solvers,
) -> tuple[Any, Any] | None:
    """Film and field of a smooth case, kept for the next case that differs only in its roughness."""
    contact = PreparedContact(case, conditions, domain, physics=physics_of(case, conditions))
    return _smooth_solution(contact, first, last, solvers)


def _smooth_solution(
    contact: PreparedContact, first: Grid, last: Grid, solvers: Solvers
) -> tuple[Any, Any] | None:
    """Film and field of a contact with smooth surfaces, refined from the ``first`` to the ``last`` grid.

    None if the film does not converge.
    """
    kind, conditions = contact.kind, contact.conditions
    setup = replace(Setup.of(contact.case), roughness=())
    problem = contact.film_problem(replace(setup, grid=first), rough=False)
    if last.nodes_along > first.nodes_along:
        # Refined as often as the rough film, whatever its error.
        problem = replace(problem, target_error=0.0, most_nodes=last.nodes_along)
    film = solvers.film[conditions.geometry](problem)
    if not film.converged:
        return None
    heights = heights_of((), *film.axes)
    field_problem = kind.field_problem(replace(setup, grid=last), conditions, film, heights)
    return film, solvers.field[conditions.geometry](field_problem)


def _coarser(contact: PreparedContact, films: Refined, solvers: Solvers) -> Coarser | None:
    """Solve a contact whose surfaces touch on a grid with half the nodes along each axis.

    A point contact that was refined on a patch is so again. None if this grid has fewer nodes than a case may
    have, or if its film does not converge.
    """
    conditions, problem = contact.conditions, contact.film_problem(films.setup)
    nodes, width = problem.nodes // 2 + 1, problem.width
    if nodes < _LEAST_NODES:
        return None
    first = contact.film_problem(films.first)
    if width is not None and nodes > first.nodes:
        coarser = replace(first, target_error=0.0, most_nodes=nodes)
    else:
        width = None if width is None else replace(width, nodes=width.nodes // 2 + 1)
        coarser = replace(problem, nodes=nodes, width=width)
    film = solvers.film[conditions.geometry](coarser)
    if not film.converged:
        return None
    return Coarser.of(conditions, film)
