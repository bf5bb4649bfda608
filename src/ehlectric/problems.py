"""What a case of a line contact asks the film and the field to be solved for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.case import Case
from ehlectric.conditions import Conditions, density_law, permittivity_law, viscosity_law
from ehlectric.film import Film
from ehlectric.film_formulas import Thickness, moes
from ehlectric.inputs import Lubricant
from ehlectric.nested import FilmProblem, Scales
from ehlectric.point_conditions import PointConditions
from ehlectric.poisson import ATOM, FieldProblem
from ehlectric.reynolds import Fluid, FluidLaw
from ehlectric.rough_maps import RoughMap
from ehlectric.surface_domain import Domain
from ehlectric.typing import Array
from ehlectric.walls import RoughSurface

# Gap over the length of the field range above which there is no contact, but a film that was not found.
WIDEST = 100.0

# Parts into which an interval of the film is refined for the field at the most.
_MOST_PARTS = 32

# A film node this near to an end of the field range, in grid spacings, is that end.
_SAME_NODE = 1e-6


def _dimensionless(law: Callable[[Array], tuple[Array, Array]], scale: float) -> FluidLaw:
    """A law of the pressure in Pa as one of P = p/scale."""

    def of_dimensionless(pressure: Array) -> tuple[Array, Array]:
        value, slope = law(scale * pressure)
        return value, scale * slope

    return of_dimensionless


def fluid_of(lubricant: Lubricant, max_pressure: float, velocity_parameter: float) -> Fluid:
    """The lubricant over P = p/``max_pressure``."""
    return Fluid(
        density=_dimensionless(density_law(lubricant), max_pressure),
        log_viscosity=_dimensionless(viscosity_law(lubricant), max_pressure),
        velocity_parameter=velocity_parameter,
        ambient_pressure=lubricant.ambient_pressure / max_pressure,
    )


def line_domain_of(case: Case, conditions: Conditions) -> Domain:
    """Where the film of a line contact is solved."""
    b, grid = conditions.half_width, case.grid
    return Domain(b * grid.inlet, b * grid.outlet)


def spacing(case: Case, conditions: Conditions) -> float:
    """Distance of the film's nodes [m]."""
    return conditions.half_width * (case.grid.outlet - case.grid.inlet) / (case.grid.nodes - 1)


def film_problem(case: Case, conditions: Conditions, rough: Sequence[RoughSurface] = ()) -> FilmProblem:
    """The film equations of a case; of rough surfaces only the sum of their heights enters them."""
    smooth = smooth_problem(case, conditions, moes(conditions.formulas))
    return replace(smooth, added_gap=_added_gap(conditions, rough) if rough else None)


def smooth_problem(case: Case, conditions: Conditions | PointConditions, expected: Thickness) -> FilmProblem:
    """What the film equations of all contacts share, with the central film that a formula expects."""
    grid, guess = case.grid, expected.central_thickness
    assert guess is not None
    return FilmProblem(
        fluid=fluid_of(case.lubricant, conditions.max_pressure, conditions.velocity_parameter),
        nodes=grid.nodes,
        inlet=grid.inlet,
        outlet=grid.outlet,
        thickness_guess=guess / conditions.thickness_scale,
        second_order=grid.wedge == "second-order",
        tolerance=case.solver.tolerance,
        max_iterations=case.solver.max_iterations,
        scales=scales_of(case, conditions),
    )


def _added_gap(conditions: Conditions, rough: Sequence[RoughSurface]) -> Callable[[Array, Array], Array]:
    """The gap that both surfaces' roughness adds, dimensionless: peaks narrow it."""
    b, scale = conditions.half_width, conditions.thickness_scale

    def added_gap(x: Array, _y: Array) -> Array:
        gap: Array = -heights_of(rough, b * x).sum(axis=0)[:, np.newaxis] / scale
        return gap

    return added_gap


def heights_of(rough: Sequence[RoughSurface] | Sequence[RoughMap], *axes: Array) -> Array:
    """Roughness of both surfaces at the nodes of a grid [m], shape (2, nx) or (2, nx, ny)."""
    heights = np.zeros((2, *(axis.size for axis in axes)))
    for surface in rough:
        heights[surface.surface - 1] += surface.height(*axes)
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
    x = _columns(case, conditions, film, refine=bool(np.any(roughness)))
    lower, upper = surfaces(conditions, film, roughness)
    # Middle and gap, not the two walls: between two nodes walls of their own might cross.
    middle = resampled(film.x, 0.5 * (lower + upper), x)
    gap = np.clip(resampled(film.x, film.thickness, x), ATOM, WIDEST * np.ptp(x))
    return FieldProblem(
        x=x,
        lower=middle - 0.5 * gap,
        upper=middle + 0.5 * gap,
        permittivity=resampled(film.x, permittivity_law(case.lubricant)(film.density), x),
        potential_1=case.electric.potential_1,
        potential_2=case.electric.potential_2,
        degree=case.grid.field_degree,
    )


def _columns(case: Case, conditions: Conditions, film: Film, *, refine: bool) -> Array:
    """Columns of the field: the film's own nodes and the two ends of the range, unless a number is given.

    Rough walls turn within the distance of the other wall: there each interval is parted until half of the
    least gap is resolved.
    """
    nodes = columns_within(
        film.x, [conditions.half_width * end for end in case.grid.field_range], case.grid.field_nodes
    )
    dx = film.x[1] - film.x[0]
    parts = int(np.ceil(dx / max(0.5 * film.minimum_thickness, dx / _MOST_PARTS))) if refine else 1
    if parts == 1 or case.grid.field_nodes is not None:
        return nodes
    fractions = np.arange(parts) / parts
    parted = (nodes[:-1, np.newaxis] + np.diff(nodes)[:, np.newaxis] * fractions).ravel()
    return np.append(parted, nodes[-1])


def columns_within(nodes: Array, ends: Sequence[float], number: int | None) -> Array:
    """A film's nodes between two ends, with the ends; or so many columns at equal distances."""
    start, stop = ends
    if number is not None:
        return np.linspace(start, stop, number)
    spacing = nodes[1] - nodes[0]
    inside = nodes[(nodes > start + _SAME_NODE * spacing) & (nodes < stop - _SAME_NODE * spacing)]
    return np.concatenate([[start], inside, [stop]])


def resampled(x: Array, values: Array, at: Array, *, axis: int = 0) -> Array:
    """Monotone cubic interpolation: exact at the nodes, and no film thinner than the solved one."""
    resampled: Array = PchipInterpolator(x, values, axis=axis)(at)
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


def scales_of(case: Case, conditions: Conditions | PointConditions) -> Scales:
    """What turns the dimensionless film of a case into SI units."""
    return Scales(
        length=conditions.half_width,
        pressure=conditions.max_pressure,
        thickness=conditions.thickness_scale,
        ambient_pressure=case.lubricant.ambient_pressure,
    )
