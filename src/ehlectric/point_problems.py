"""What a case of a point contact asks the film and the field to be solved for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ehlectric.case import Case
from ehlectric.conditions import permittivity_law
from ehlectric.elastic import Geometry, point_geometry
from ehlectric.mesh import Width
from ehlectric.nested import FilmProblem
from ehlectric.point_conditions import PointConditions
from ehlectric.point_film import PointFilm
from ehlectric.point_formulas import nijenbanning_venner_moes
from ehlectric.poisson import ATOM
from ehlectric.poisson_3d import PointFieldProblem
from ehlectric.problems import WIDEST, columns_within, heights_of, resampled, smooth_problem
from ehlectric.rough_maps import RoughMap
from ehlectric.surface_domain import Domain
from ehlectric.typing import Array

# Part of the largest height by which a surface may differ from its mirror image and be symmetric.
_ROUNDING = 1e-9


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
