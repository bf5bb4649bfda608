"""solve(case): the only place where film and field meet."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.case import Case
from ehlectric.conditions import (
    Conditions,
    density_law,
    permittivity_law,
    remarks,
    resolve,
    viscosity_law,
)
from ehlectric.errors import ConvergenceError
from ehlectric.field import Field, solve_field
from ehlectric.film import Film, solve_film
from ehlectric.film_formulas import moes
from ehlectric.memory import check_memory
from ehlectric.nested import FilmProblem
from ehlectric.newton import Progress
from ehlectric.poisson import FieldProblem
from ehlectric.result import Result, Smooth, scales_of
from ehlectric.reynolds import Fluid, FluidLaw
from ehlectric.typing import Array
from ehlectric.version import __version__
from ehlectric.walls import RoughSurface, rough_surfaces
from ehlectric.walls import remarks as rough_remarks

# Gap below which walls count as this far apart in the field [m]: the size of an atom.
_ATOM = 1e-10

# Gap over the length of the field range above which there is no contact, but a film that was not found.
_WIDEST = 100.0

# Field above which any insulator breaks down [V/m].
_NO_INSULATOR = 1e9

# Parts into which an interval of the film is refined for the field at the most.
_MOST_PARTS = 32

# A film node this near to an end of the field range, in grid spacings, is that end.
_SAME_NODE = 1e-6


@dataclass(frozen=True)
class Solvers:
    """What solves the film and the field of a case, by the name under which a result says so.

    ``check`` raises an InputError for numbers of nodes they do not take, before anything is solved.
    """

    name: str
    film: Callable[..., Film]
    field: Callable[[FieldProblem], Field]
    check: Callable[[int], object]


OWN = Solvers("ehlectric", solve_film, solve_field, check=lambda _nodes: None)


def solve(
    case: Case,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: Solvers = OWN,
    beside_smooth: bool = True,
) -> Result:
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
    Result
        With ``converged`` false where the film was not solved; its field is then that of the last film.

    Raises
    ------
    InputError
        Where the values of the case contradict each other.
    ConvergenceError
        Where the film was not solved and ``require_convergence`` is set.

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> round(solve(case).film.minimum_thickness * 1e6, 2)
    0.74
    """
    conditions = resolve(case)
    check_memory(case)
    rough = rough_surfaces(case, conditions)
    started = time.perf_counter()
    film = solvers.film(film_problem(case, conditions, rough), progress=progress)
    film_done = time.perf_counter()
    if require_convergence and not film.converged:
        raise ConvergenceError(f"film {film.status} at the residual {film.residual:.1e}")
    roughness = _heights(rough, film.x)
    # The field of a film that was not found is for looking at: the direct solver always has one.
    of_field = solvers if film.converged else OWN
    field = of_field.field(field_problem(case, conditions, film, roughness))
    field_done = time.perf_counter()
    return Result(
        case=case,
        conditions=conditions,
        film=film,
        roughness=roughness,
        rough=tuple(surface.describe() for surface in rough),
        smooth=_smooth(case, field, solvers) if rough and beside_smooth else None,
        field=field,
        warnings=(
            *remarks(case, conditions),
            *rough_remarks(case, conditions, rough),
            *_film_findings(case, conditions, film),
            *_field_findings(case, film, field),
        ),
        film_solver=solvers.name,
        field_solver=of_field.name,
        film_seconds=film_done - started,
        field_seconds=field_done - film_done,
        version=__version__,
        date=datetime.now(UTC).isoformat(timespec="seconds"),
    )


def _dimensionless(law: Callable[[Array], tuple[Array, Array]], scale: float) -> FluidLaw:
    """A law of the pressure in Pa as one of P = p/scale."""

    def of_dimensionless(pressure: Array) -> tuple[Array, Array]:
        value, slope = law(scale * pressure)
        return value, scale * slope

    return of_dimensionless


def film_problem(case: Case, conditions: Conditions, rough: Sequence[RoughSurface] = ()) -> FilmProblem:
    """The film equations of a case; of rough surfaces only the sum of their heights enters them."""
    lubricant, grid = case.lubricant, case.grid
    p_h = conditions.max_pressure
    guess = moes(conditions.formulas).central_thickness
    assert guess is not None
    return FilmProblem(
        fluid=Fluid(
            density=_dimensionless(density_law(lubricant), p_h),
            log_viscosity=_dimensionless(viscosity_law(lubricant), p_h),
            velocity_parameter=conditions.velocity_parameter,
            ambient_pressure=lubricant.ambient_pressure / p_h,
        ),
        nodes=grid.nodes,
        inlet=grid.inlet,
        outlet=grid.outlet,
        thickness_guess=guess / conditions.thickness_scale,
        second_order=grid.wedge == "second-order",
        tolerance=case.solver.tolerance,
        max_iterations=case.solver.max_iterations,
        scales=scales_of(case, conditions),
        added_gap=_added_gap(conditions, rough) if rough else None,
    )


def _smooth(case: Case, field: Field, solvers: Solvers) -> Smooth | None:
    """The case without its roughness, on the same grids; None where that is not solved."""
    result = solve(case.replace(roughness=()), solvers=solvers)
    if not result.converged:
        return None
    middle = np.interp(field.x, result.field.x, result.field.middle_strength)
    return Smooth(result.film.pressure, result.film.thickness, middle)


def _added_gap(conditions: Conditions, rough: Sequence[RoughSurface]) -> Callable[[Array, Array], Array]:
    """The gap that both surfaces' roughness adds, dimensionless: peaks narrow it."""
    b, scale = conditions.half_width, conditions.thickness_scale

    def added_gap(x: Array, _y: Array) -> Array:
        gap: Array = -_heights(rough, b * x).sum(axis=0)[:, np.newaxis] / scale
        return gap

    return added_gap


def _heights(rough: Sequence[RoughSurface], x: Array) -> Array:
    """Roughness of both surfaces at given positions [m], shape (2, n)."""
    heights = np.zeros((2, x.size))
    for surface in rough:
        heights[surface.surface - 1] += surface.height(x)
    return heights


def field_problem(case: Case, conditions: Conditions, film: Film, roughness: Array) -> FieldProblem:
    """The Poisson problem in a solved film; a cavitated gap counts as filled with oil.

    Parameters
    ----------
    case, conditions : Case, Conditions
        What was solved.
    film : Film
        Its film.
    roughness : ndarray, shape (2, nx)
        Heights of both surfaces at the film's nodes [m].

    Returns
    -------
    FieldProblem
        On the columns that ``grid`` asks for.
    """
    x = _field_nodes(case, conditions, film, refine=bool(np.any(roughness)))
    lower, upper = surfaces(conditions, film, roughness)
    # Middle and gap, not the two walls: between two nodes walls of their own might cross.
    middle = _resampled(film.x, 0.5 * (lower + upper), x)
    gap = np.clip(_resampled(film.x, film.thickness, x), _ATOM, _WIDEST * np.ptp(x))
    return FieldProblem(
        x=x,
        lower=middle - 0.5 * gap,
        upper=middle + 0.5 * gap,
        permittivity=_resampled(film.x, permittivity_law(case.lubricant)(film.density), x),
        potential_1=case.electric.potential_1,
        potential_2=case.electric.potential_2,
        degree=case.grid.field_degree,
    )


def _field_nodes(case: Case, conditions: Conditions, film: Film, *, refine: bool) -> Array:
    """Columns of the field: the film's own nodes and the two ends of the range, unless a number is given.

    Rough walls turn within the distance of the other wall: there each interval is parted until half of the
    least gap is resolved.
    """
    start, stop = (conditions.half_width * end for end in case.grid.field_range)
    if case.grid.field_nodes is not None:
        return np.linspace(start, stop, case.grid.field_nodes)
    dx = film.x[1] - film.x[0]
    inside = film.x[(film.x > start + _SAME_NODE * dx) & (film.x < stop - _SAME_NODE * dx)]
    nodes = np.concatenate([[start], inside, [stop]])
    parts = int(np.ceil(dx / max(0.5 * film.minimum_thickness, dx / _MOST_PARTS))) if refine else 1
    if parts == 1:
        return nodes
    fractions = np.arange(parts) / parts
    return np.append((nodes[:-1, np.newaxis] + np.diff(nodes)[:, np.newaxis] * fractions).ravel(), stop)


def _resampled(x: Array, values: Array, at: Array) -> Array:
    """Monotone cubic interpolation: exact at the nodes, and no film thinner than the solved one."""
    resampled: Array = PchipInterpolator(x, values)(at)
    return resampled


def surfaces(conditions: Conditions, film: Film, roughness: Array) -> tuple[Array, Array]:
    """Heights of the two surfaces over the film's nodes [m].

    Each body keeps its own part of the curvature and of the deflection, and its own roughness; smooth equal
    bodies, and those of which only the reduced values are known, lie at -h/2 and h/2.
    """
    parabola = 0.5 * film.x**2 / conditions.reduced_radius
    rigid = film.thickness - parabola - film.deflection + roughness.sum(axis=0)
    lower = roughness[0] - (
        conditions.curvature_share * parabola + conditions.compliance_share * film.deflection + 0.5 * rigid
    )
    return lower, lower + film.thickness


def _film_findings(case: Case, conditions: Conditions, film: Film) -> Iterator[str]:
    """What the film shows that a user should know, one text each."""
    if not film.converged:
        yield (
            f"do not use this film, it is no solution: {film.status} at the residual {film.residual:.1e}; "
            "try more grid.nodes, a lower grid.inlet, or more solver.max_iterations"
        )
    places = film.collapsed_positions / conditions.half_width
    if places.size:
        yield (
            "the surfaces would touch at x/b = "
            + ", ".join(f"{place:.3f}" for place in places[:8])
            + (f" and {places.size - 8} more nodes" if places.size > 8 else "")
        )
    if film.minimum_thickness < _ATOM:
        yield "the film is thinner than an atom in places; the field is that of a gap of 0.1 nm there"
    error = film.discretisation_error
    if film.converged and error is None and case.roughness:
        yield (
            "nothing is known of the discretisation error, as the roughness had to be raised in steps; "
            "compare with more grid.nodes"
        )
    elif film.converged and error is None:
        yield (
            "do not use this film: the next coarser grid was not solved, so that nothing is known of its "
            "discretisation error, which is large; take more grid.nodes"
        )
    elif error is not None and error > 0.01:
        advice = "do not use it" if error > 0.1 else "take more grid.nodes"
        yield f"the film may be {100 * error:.2g} % off or more on this grid; {advice}"
    if film.inlet_deficit > 0.01:
        effect = "do not use this film" if film.inlet_deficit > 0.2 else "the film is about that much off"
        yield (
            f"the inlet is too short: {100 * film.inlet_deficit:.2g} % of the pressure is built up before "
            f"it, {effect}; lower grid.inlet"
        )
    if not film.cavitates:
        yield "the film does not cavitate before the domain ends; raise grid.outlet"


def _field_findings(case: Case, film: Film, field: Field) -> Iterator[str]:
    """What the field shows that a user should know, one text each."""
    inside = int(np.count_nonzero((film.x >= field.x[0]) & (film.x <= field.x[-1])))
    if case.grid.field_nodes is not None and case.grid.field_nodes < inside:
        yield (
            f"grid.field_nodes is coarser than the film, which has {inside} nodes in the field range: the "
            "width of the high-field zone and the capacitance suffer"
        )
    if field.max_strength > _NO_INSULATOR:
        yield (
            f"the largest field is {field.max_strength / 1e6:.3g} V/µm: no insulator withstands more than "
            f"some {_NO_INSULATOR / 1e6:g} V/µm, and the film breaks down long before"
        )
    if not np.any(field.inner & (field.x == field.max_strength_position)):
        yield "the largest field is at an end of grid.field_range; widen it"
