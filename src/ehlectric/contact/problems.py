"""Film and field problems of a contact, with its supply of oil, made from its setup and operating
conditions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.cases.case import Case
from ehlectric.cases.film_inputs import Inlet
from ehlectric.cases.grid_inputs import MOST_DEGREE, Solver
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.contact_memory import FIELD_BYTES, POINT_FIELD_BYTES
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError
from ehlectric.field import ATOM, FieldProblem, PointFieldProblem, columns_within, thinned
from ehlectric.film import (
    MEAN_MOBILITY,
    Film,
    FilmProblem,
    Fluid,
    FluidLaw,
    Geometry,
    OilSupply,
    PointFilm,
    Scales,
    Width,
    point_geometry,
)
from ehlectric.formulas.film_line import CentralThickness, moes
from ehlectric.formulas.film_point import load_exponent, nijenbanning_venner_moes
from ehlectric.formulas.monotone_cubic import along_axis
from ehlectric.formulas.polynomials import interval
from ehlectric.lubricant.law import PressureLaw
from ehlectric.lubricant.oil import Oil
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface


def oil_supply(inlet: Inlet | None, conditions: Conditions | PointConditions) -> OilSupply | None:
    """Supply of oil of a film problem; None where the inlet is flooded.

    The supply is the layer over Y = y/b in units of b^2/R, by the scales of the operating conditions, or the
    ratio of films. Beyond the ends of a table its first and last thickness hold.

    Examples
    --------
    >>> oil_supply(None, None) is None
    True
    """
    if inlet is None:
        return None
    if inlet.film_ratio is not None:
        return OilSupply(film_ratio=inlet.film_ratio)
    length, scale = conditions.half_width, conditions.thickness_scale
    given, table = inlet.oil_layer, inlet.layer_table

    def layer(y: Array) -> Array:
        if table is None:
            return np.asarray(np.full(y.shape, given) / scale)
        return np.asarray(np.interp(length * y, table.y, table.thickness) / scale)

    return OilSupply(layer=layer)


def is_even(inlet: Inlet | None, y: Array) -> bool:
    """Whether the layer of oil is symmetric about y = 0 at positions y [m] that are so."""
    if inlet is None or inlet.layer_table is None:
        return True
    layer = np.interp(y, inlet.layer_table.y, inlet.layer_table.thickness)
    return bool(np.allclose(layer, layer[::-1], rtol=1e-9, atol=0.0))


# Largest difference between a surface and its mirror image, relative to the largest height, at which the
# surface counts as symmetric.
_ROUNDING = 1e-9

# Largest gap over the length of the field range. Only an unconverged film has a larger gap.
WIDEST = 100.0

# Largest number of parts into which an interval between film nodes is divided for the field.
_MOST_PARTS = 32

# Memory up to which the degree of a field may be raised beyond ``grid.field_degree`` [bytes].
_FIELD_MEMORY = 1e9

# Order of the wedge term and flow through the faces of the film, by ``grid.wedge``. The first two have the
# flow of the paper.
SCHEMES = {
    "first-order": (1, MEAN_MOBILITY),
    "second-order": (2, MEAN_MOBILITY),
    "third-order": (3, "newtonian"),
}

# Largest tolerance at which a film is solved. Up to here its error was at most 3e-5 in 123 random contacts;
# larger residuals may belong to films that are wrong by per cents.
LARGEST_TOLERANCE = 1e-6


def domain_of(setup: Case | Setup, conditions: Conditions | PointConditions) -> Domain:
    """Domain in which the film of a contact is solved [m]."""
    b, (inlet, outlet) = conditions.half_width, setup.grid.ends
    if isinstance(conditions, PointConditions):
        return Domain(b * inlet, b * outlet, conditions.side * conditions.semi_axis_y)
    return Domain(b * inlet, b * outlet)


def spacings_of(setup: Case | Setup, conditions: Conditions | PointConditions) -> tuple[float, ...]:
    """Node spacings of the film along each axis of a contact [m]."""
    domain, grid = domain_of(setup, conditions), setup.first_grid
    if isinstance(conditions, PointConditions):
        along, across = domain.length, 2.0 * domain.side
        return along / (grid.nodes_along - 1), across / (grid.nodes_across - 1)
    return (conditions.half_width * setup.grid.length / (grid.nodes_along - 1),)


def geometry_of(conditions: PointConditions) -> Geometry:
    """Geometry of a point contact for the film equations: deflection kernel, dry gap and load."""
    deflection = 2.0 * conditions.max_pressure * conditions.radius_x
    return point_geometry(
        radius_ratio=conditions.radius_x / conditions.radius_y,
        ellipse_ratio=conditions.ratio,
        compliance=deflection / (np.pi * conditions.reduced_modulus * conditions.semi_axis_x),
    )


def point_film_problem(
    setup: Case | Setup, conditions: PointConditions, rough: Sequence[RoughMap] = ()
) -> FilmProblem:
    """Film problem of a point contact with smooth or rough surfaces.

    The film equations depend on the sum of both surfaces' heights only. If film and surfaces are symmetric
    about y = 0, only half of the contact is solved.
    """
    return replace(
        smooth_problem(setup, conditions, nijenbanning_venner_moes(conditions.contact)),
        geometry=geometry_of(conditions),
        width=Width(
            nodes=setup.first_grid.nodes_across,
            side=conditions.side * conditions.ratio,
            symmetric=_symmetric(setup, conditions, rough),
        ),
        added_gap=_added_gap(conditions, rough),
        load_exponent=float(load_exponent(conditions.contact)),
    )


def _symmetric(setup: Case | Setup, conditions: PointConditions, rough: Sequence[RoughMap]) -> bool:
    """Whether surfaces and supply of oil are symmetric about y = 0 at the nodes of the film."""
    domain, grid = domain_of(setup, conditions), setup.first_grid
    y = np.linspace(-domain.side, domain.side, grid.nodes_across)
    if not rough or not is_even(setup.inlet, y):
        return is_even(setup.inlet, y)
    x = np.linspace(domain.inlet, domain.outlet, grid.nodes_along)
    heights = heights_of(rough, x, y)
    difference = np.max(np.abs(heights - heights[:, :, ::-1]))
    return bool(difference <= _ROUNDING * np.max(np.abs(heights)))


def point_field_problem(
    setup: Case | Setup, conditions: PointConditions, film: PointFilm, roughness: Array
) -> PointFieldProblem:
    """Field problem of a point contact with a known film; cavitated regions count as full of oil.

    The ``roughness`` has the heights of both surfaces at the film's nodes [m], shape (2, nx, ny). The Poisson
    problem is posed on the columns that the grid defines. It covers only the half y >= 0 if film and surfaces
    are symmetric about y = 0.
    """
    grid = setup.grid
    assert grid.field_side is not None
    x = columns_within(film.x, [conditions.semi_axis_x * end for end in grid.field_range], grid.field_nodes)
    reach = conditions.semi_axis_y * min(grid.field_side, conditions.side)
    y = columns_within(film.y, [-reach, reach], grid.field_nodes_y)
    if not np.any(roughness):
        thinnest = film.minimum_position
        x = x if grid.field_nodes is not None else thinned(x, [thinnest[0]])
        y = y if grid.field_nodes_y is not None else thinned(y, [-thinnest[1], thinnest[1]])
    if halves_alike(film, roughness) and y.size % 2 == 1:
        y = y[y.size // 2 :]
        y[0] = 0.0
    walls = point_surfaces(conditions, film, roughness)
    return PointFieldProblem(
        x=x,
        y=y,
        **_on_columns(setup, film, walls, x, y),
        most_degree=max(grid.field_degree, _most_degree(POINT_FIELD_BYTES * x.size * y.size, 1)),
    )


def _on_columns(
    setup: Case | Setup, film: Film | PointFilm, walls: tuple[Array, Array], *axes: Array
) -> dict[str, Any]:
    """Part of a field problem that lines and points share: walls [m] and permittivity at the columns."""

    def resampled(values: Array) -> Array:
        # Monotone cubic interpolation is exact at the nodes, and makes the film nowhere thinner.
        for k, (nodes, columns) in enumerate(zip(film.axes, axes, strict=True)):
            used = _nodes_of(nodes, columns)
            values = along_axis(nodes[used], np.take(values, used, axis=k), columns, axis=k)
        return values

    # Middle and gap are interpolated, because separately interpolated walls could cross between nodes.
    middle = resampled(0.5 * (walls[0] + walls[1]))
    gap = np.clip(resampled(film.thickness), ATOM, WIDEST * np.ptp(axes[0]))
    return {
        "lower": middle - 0.5 * gap,
        "upper": middle + 0.5 * gap,
        "permittivity": resampled(setup.oil.permittivity(film.pressure, film.density)),
        "potential_1": setup.electric.potential_1,
        "potential_2": setup.electric.potential_2,
        "degree": setup.grid.field_degree,
    }


def _nodes_of(nodes: Array, columns: Array) -> IntArray:
    """Numbers of the nodes that the monotone cubic needs at columns: two on each side, or the node itself."""
    before, part = interval(nodes, columns)
    near = before[:, np.newaxis] + np.where(part[:, np.newaxis] == 0.0, 0, np.arange(-1, 3))
    return np.unique(np.clip(near, 0, nodes.size - 1))


def halves_alike(film: PointFilm, roughness: Array) -> bool:
    """Whether film and roughness are symmetric about y = 0."""
    return bool(
        np.array_equal(film.thickness, film.thickness[:, ::-1])
        and np.allclose(roughness, roughness[:, :, ::-1], rtol=0.0, atol=_ROUNDING * film.scales.thickness)
    )


def point_surfaces(conditions: PointConditions, film: PointFilm, roughness: Array) -> tuple[Array, Array]:
    """Heights of the two surfaces at the film's nodes [m], shape (nx, ny).

    Half of the dry gap belongs to each surface. In a groove the whole film is curved, by more than ten
    degrees at the ends of the ellipse; this curvature is neglected. Its effect on the field is negligible,
    because the gap is ten thousand times smaller than the radii. Each body keeps its own share of the
    deflection and its own roughness. Smooth bodies of equal elasticity lie at -h/2 and h/2.
    """
    dry = 0.5 * (film.x[:, np.newaxis] ** 2 / conditions.radius_x + film.y**2 / conditions.radius_y)
    rigid = film.thickness - dry - film.deflection + roughness.sum(axis=0)
    lower = roughness[0] - 0.5 * (dry + rigid) - conditions.compliance_share * film.deflection
    return lower, lower + film.thickness


def _dimensionless(law: PressureLaw, scale: float) -> FluidLaw:
    """Convert a law of pressure [Pa], at the temperature of the case, to a law of P = p/scale."""

    def of_dimensionless(pressure: Array) -> tuple[Array, Array]:
        value, slope = law(scale * pressure)
        return value, scale * slope

    return of_dimensionless


def fluid_of(oil: Oil, max_pressure: float, velocity_parameter: float) -> Fluid:
    """Density and viscosity of the oil as functions of the pressure P = p/``max_pressure``."""
    return Fluid(
        density=_dimensionless(oil.density_ratio, max_pressure),
        log_viscosity=_dimensionless(oil.log_viscosity, max_pressure),
        velocity_parameter=velocity_parameter,
        ambient_pressure=oil.ambient_pressure / max_pressure,
    )


def check_tolerance(solver: Solver) -> None:
    """Raise an InputError if the tolerance of the film solver is too large for a film to be right.

    The bound applies to solving, and not to a case, so that stored results with a larger one can be read.
    """
    if solver.tolerance > LARGEST_TOLERANCE:
        raise InputError(
            "solver.tolerance",
            got=f"{solver.tolerance:g}",
            takes=f"at most {LARGEST_TOLERANCE:g}: with a larger residual a film may be wrong by per cents",
        )


def film_problem(
    setup: Case | Setup, conditions: Conditions, rough: Sequence[RoughSurface] = ()
) -> FilmProblem:
    """Film problem of a line contact with smooth or rough surfaces.

    The film equations depend on the sum of both surfaces' heights only.
    """
    smooth = smooth_problem(setup, conditions, moes(conditions.contact))
    return replace(smooth, added_gap=_added_gap(conditions, rough))


def smooth_problem(
    setup: Case | Setup, conditions: Conditions | PointConditions, expected: CentralThickness
) -> FilmProblem:
    """Film problem of a smooth line contact, and the basis of the film problem of all other contacts.

    ``expected`` is the film thickness from a formula; its central value [m] scales the initial guess. An
    InputError is raised for a tolerance that is too large.
    """
    check_tolerance(setup.solver)
    grid, guess = setup.first_grid, expected.central_thickness
    (inlet, outlet), (wedge_order, flow) = grid.ends, SCHEMES[grid.wedge]
    fluid = fluid_of(setup.oil, conditions.max_pressure, conditions.velocity_parameter)
    return FilmProblem(
        fluid=replace(fluid, flow=flow),
        nodes=grid.nodes_along,
        inlet=inlet,
        outlet=outlet,
        thickness_guess=float(guess / conditions.thickness_scale),
        wedge_order=wedge_order,
        tolerance=setup.solver.tolerance,
        max_iterations=setup.solver.max_iterations,
        scales=scales_of(setup, conditions),
        boundary_film=conditions.boundary_film / conditions.thickness_scale,
        hardness=np.inf if conditions.hardness is None else conditions.hardness / conditions.max_pressure,
        supply=oil_supply(setup.inlet, conditions),
    )


def _added_gap(
    conditions: Conditions | PointConditions, rough: Sequence[RoughSurface] | Sequence[RoughMap]
) -> Callable[[Array, Array], Array] | None:
    """Dimensionless gap that the roughness of both surfaces adds at X and Y, negative at asperities.

    None for smooth surfaces.
    """
    if not rough:
        return None
    b, scale, dims = conditions.half_width, conditions.thickness_scale, len(conditions.semi_axes)

    def added_gap(x: Array, y: Array) -> Array:
        heights = heights_of(rough, *(b * axis for axis in (x, y)[:dims])).sum(axis=0)
        gap: Array = -heights.reshape(x.size, -1) / scale
        return gap

    return added_gap


def heights_of(rough: Sequence[RoughSurface] | Sequence[RoughMap], *axes: Array) -> Array:
    """Roughness heights of both surfaces at the nodes of a grid [m], shape (2, nx) or (2, nx, ny)."""
    heights = np.zeros((2, *(axis.size for axis in axes)))
    for surface in rough:
        heights[surface.surface - 1] += surface.height(*axes)
    return heights


def field_problem(setup: Case | Setup, conditions: Conditions, film: Film, roughness: Array) -> FieldProblem:
    """Field problem of a line contact with a known film; cavitated regions count as full of oil.

    The ``roughness`` has the heights of both surfaces at the film's nodes [m], shape (2, nx). The Poisson
    problem is posed on the columns that the grid defines.
    """
    x = _columns(setup, conditions, film, refine=bool(np.any(roughness)))
    return FieldProblem(
        x=x,
        **_on_columns(setup, film, surfaces(conditions, film, roughness), x),
        most_degree=max(setup.grid.field_degree, _most_degree(FIELD_BYTES * x.size, 2)),
    )


def _most_degree(memory: float, power: int) -> int:
    """Largest degree to which the degree of a field may be raised.

    The field needs ``memory`` [bytes] times (degree + 1) to a power, and may take ``_FIELD_MEMORY``.
    """
    return min(MOST_DEGREE, int((_FIELD_MEMORY / memory) ** (1.0 / power)) - 1)


def _columns(setup: Case | Setup, conditions: Conditions, film: Film, *, refine: bool) -> Array:
    """Positions of the columns of the field [m].

    They are the film's nodes in the field range and its two ends, or ``grid.field_nodes`` equidistant
    columns. The slope of a rough wall changes within a distance as short as the gap. With ``refine`` the
    intervals between nodes are therefore divided down to half the minimum film thickness, but into at most
    ``_MOST_PARTS`` parts.
    """
    nodes = columns_within(
        film.x, [conditions.half_width * end for end in setup.grid.field_range], setup.grid.field_nodes
    )
    dx = film.x[1] - film.x[0]
    parts = int(np.ceil(dx / max(0.5 * film.minimum_thickness, dx / _MOST_PARTS))) if refine else 1
    if parts == 1 or setup.grid.field_nodes is not None:
        return nodes
    fractions = np.arange(parts) / parts
    parted = (nodes[:-1, np.newaxis] + np.diff(nodes)[:, np.newaxis] * fractions).ravel()
    return np.append(parted, nodes[-1])


def surfaces(conditions: Conditions, film: Film, roughness: Array) -> tuple[Array, Array]:
    """Heights of the two surfaces at the film's nodes [m], shape (nx,).

    Each body keeps its own share of the curvature and of the deflection, and its own roughness. Smooth equal
    bodies lie at -h/2 and h/2, and so do smooth bodies of which only the reduced values are known.
    """
    parabola = 0.5 * film.x**2 / conditions.reduced_radius
    rigid = film.thickness - parabola - film.deflection + roughness.sum(axis=0)
    lower = roughness[0] - (
        conditions.curvature_share * parabola + conditions.compliance_share * film.deflection + 0.5 * rigid
    )
    return lower, lower + film.thickness


def scales_of(setup: Case | Setup, conditions: Conditions | PointConditions) -> Scales:
    """Scales that convert the dimensionless film of a contact to SI units."""
    return Scales(
        length=conditions.half_width,
        pressure=conditions.max_pressure,
        thickness=conditions.thickness_scale,
        ambient_pressure=setup.oil.ambient_pressure,
    )
