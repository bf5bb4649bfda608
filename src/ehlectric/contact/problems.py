"""What a case asks the film and the field to be solved for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.lubricant import Lubricant, density_law, permittivity_law, viscosity_law
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.field.poisson import ATOM, FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem
from ehlectric.film.deflection import Geometry, point_geometry
from ehlectric.film.flow import Fluid, FluidLaw
from ehlectric.film.line import Film
from ehlectric.film.mesh import Width
from ehlectric.film.point import PointFilm
from ehlectric.film.problem import FilmProblem, Scales
from ehlectric.formulas.film_line import CentralThickness, moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.lubricant.law import PressureLaw
from ehlectric.surfaces.domain import Domain
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface

# Part of the largest height by which a surface may differ from its mirror image and be symmetric.
_ROUNDING = 1e-9

# Gap over the length of the field range above which there is no contact, but a film that was not found.
WIDEST = 100.0

# Parts into which an interval of the film is refined for the field at the most.
_MOST_PARTS = 32

# A film node this near to an end of the field range, in grid spacings, is that end.
_SAME_NODE = 1e-6


def domain_of(case: Case, conditions: PointConditions) -> Domain:
    """Where the film of a case is solved."""
    b, grid = conditions.semi_axis_x, case.grid
    return Domain(b * grid.inlet, b * grid.outlet, conditions.side * conditions.semi_axis_y)


def spacings(case: Case, conditions: PointConditions) -> tuple[float, float]:
    """Distances of the film's nodes along and across entrainment [m]."""
    domain, grid = domain_of(case, conditions), case.grid
    along, across = domain.outlet - domain.inlet, 2.0 * domain.side
    return along / (grid.nodes - 1), across / (grid.nodes_across - 1)


def geometry_of(conditions: PointConditions) -> Geometry:
    """Kernel, dry gap and load of a contact."""
    deflection = 2.0 * conditions.max_pressure * conditions.radius_x
    return point_geometry(
        radius_ratio=conditions.radius_x / conditions.radius_y,
        ellipse_ratio=conditions.ratio,
        compliance=deflection / (np.pi * conditions.reduced_modulus * conditions.semi_axis_x),
    )


def point_film_problem(
    case: Case, conditions: PointConditions, rough: Sequence[RoughMap] = ()
) -> FilmProblem:
    """The film equations of a case; of rough surfaces only the sum of their heights enters them.

    Half of the contact is solved where both halves are alike.
    """
    b, scale = conditions.semi_axis_x, conditions.thickness_scale

    def added_gap(x: Array, y: Array) -> Array:
        gap: Array = -heights_of(rough, b * x, b * y).sum(axis=0) / scale
        return gap

    return replace(
        smooth_problem(case, conditions, nijenbanning_venner_moes(conditions.formulas)),
        geometry=geometry_of(conditions),
        width=Width(
            nodes=case.grid.nodes_across,
            side=conditions.side * conditions.ratio,
            symmetric=_symmetric(case, conditions, rough),
        ),
        added_gap=added_gap if rough else None,
    )


def _symmetric(case: Case, conditions: PointConditions, rough: Sequence[RoughMap]) -> bool:
    """Whether the surfaces are their own mirror image, at the nodes of the film."""
    if not rough:
        return True
    domain, grid = domain_of(case, conditions), case.grid
    x = np.linspace(domain.inlet, domain.outlet, grid.nodes)
    y = np.linspace(-domain.side, domain.side, grid.nodes_across)
    heights = heights_of(rough, x, y)
    difference = np.max(np.abs(heights - heights[:, :, ::-1]))
    return bool(difference <= _ROUNDING * np.max(np.abs(heights)))


def point_field_problem(
    case: Case, conditions: PointConditions, film: PointFilm, roughness: Array
) -> PointFieldProblem:
    """The Poisson problem in a solved film; a cavitated gap counts as filled with oil.

    Parameters
    ----------
    case, conditions : Case, PointConditions
        What was solved.
    film : PointFilm
        Its film.
    roughness : ndarray, shape (2, nx, ny)
        Heights of both surfaces at the film's nodes [m].

    Returns
    -------
    PointFieldProblem
        On the columns that ``grid`` asks for, of the half y >= 0 alone where both halves are alike.
    """
    grid = case.grid
    assert grid.field_side is not None
    x = columns_within(film.x, [conditions.semi_axis_x * end for end in grid.field_range], grid.field_nodes)
    reach = conditions.semi_axis_y * min(grid.field_side, conditions.side)
    y = columns_within(film.y, [-reach, reach], grid.field_nodes_y)
    if halves_alike(film, roughness) and y.size % 2 == 1:
        y = y[y.size // 2 :]
        y[0] = 0.0
    lower, upper = point_surfaces(conditions, film, roughness)
    # Middle and gap, not the two walls: between two nodes walls of their own might cross.
    middle = _resampled(film, 0.5 * (lower + upper), x, y)
    gap = np.clip(_resampled(film, film.thickness, x, y), ATOM, WIDEST * np.ptp(x))
    return PointFieldProblem(
        x=x,
        y=y,
        lower=middle - 0.5 * gap,
        upper=middle + 0.5 * gap,
        permittivity=_resampled(film, permittivity_law(case.lubricant)(film.density), x, y),
        potential_1=case.electric.potential_1,
        potential_2=case.electric.potential_2,
        degree=grid.field_degree,
    )


def halves_alike(film: PointFilm, roughness: Array) -> bool:
    """Whether film and walls are their own mirror image."""
    return bool(
        np.array_equal(film.thickness, film.thickness[:, ::-1])
        and np.allclose(roughness, roughness[:, :, ::-1], rtol=0.0, atol=_ROUNDING * film.scales.thickness)
    )


def _resampled(film: PointFilm, values: Array, x: Array, y: Array) -> Array:
    """Values at the film's nodes between them, along one axis after the other."""
    return resampled(film.y, resampled(film.x, values, x), y, axis=1)


def point_surfaces(conditions: PointConditions, film: PointFilm, roughness: Array) -> tuple[Array, Array]:
    """Heights of the two surfaces over the film's nodes [m], shape (nx, ny).

    The gap as the film knows it, measured across: a groove and its ball bend it as a whole, by more than ten
    degrees at the ends of the ellipse, which the field in a gap a ten-thousandth as thick as their radii does
    not feel. Each body keeps its own part of the deflection and its own roughness; smooth equal bodies lie at
    -h/2 and h/2.
    """
    dry = 0.5 * (film.x[:, np.newaxis] ** 2 / conditions.radius_x + film.y**2 / conditions.radius_y)
    rigid = film.thickness - dry - film.deflection + roughness.sum(axis=0)
    lower = roughness[0] - 0.5 * (dry + rigid) - conditions.compliance_share * film.deflection
    return lower, lower + film.thickness


def _dimensionless(law: PressureLaw, scale: float) -> FluidLaw:
    """A law of the pressure in Pa, at the temperature of the case, as one of P = p/scale."""

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


def smooth_problem(
    case: Case, conditions: Conditions | PointConditions, expected: CentralThickness
) -> FilmProblem:
    """What the film equations of all contacts share, with the central film that a formula expects."""
    grid, guess = case.grid, expected.central_thickness
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
