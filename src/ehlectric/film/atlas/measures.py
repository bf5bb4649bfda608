"""Numbers of a solved film that the atlas stores, dimensionless."""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import RectBivariateSpline, make_interp_spline

from ehlectric.arrays import Array
from ehlectric.film.accuracy.patch import Patch
from ehlectric.film.atlas.groups import Groups
from ehlectric.film.problem import FilmProblem
from ehlectric.film.state import GridSolution
from ehlectric.formulas.hertz_line import line_gap
from ehlectric.formulas.hertz_point import DryContact, point_deflection

# Numbers of each film, in this order.
#   central: rho(0) h(0)/rho0 in Moes' unit.           minimum: h_min in Moes' unit.
#   mean: mean of h over the Hertz zone in Moes' unit. pressure: p(0)/p_h.
#   zone: mean of rho(0) h(0)/(rho h) over the Hertz zone.
#   inlet, outlet: integral of dA/h before and behind the middle of the contact, outside the Hertz zone and
#   inside x from -4.5 b to 1.5 b (lines: -4 b to 2 b) and 1.6 a + 1.4 b (at most 4.5 a) at the sides, over
#   the same integral of the dry gap plus h(0).
#   minimum_x, minimum_y: place of the minimum in semi-axes b and a.
NAMES = ("central", "minimum", "mean", "pressure", "zone", "inlet", "outlet", "minimum_x", "minimum_y")

_MIDDLE = np.zeros(())

# Points of the quadrature over the Hertz ellipse, and over the area outside.
_RADII, _ANGLES = 48, 96
_OUTSIDE = 241, 161


def measured(
    groups: Groups, problem: FilmProblem, solution: GridSolution, patch: Patch | None = None
) -> Array:
    """Numbers of a film on one grid, in the order of ``NAMES``.

    Parameters
    ----------
    groups : Groups
        Groups of the contact.
    problem : FilmProblem
        Problem of the film, for its fluid.
    solution : GridSolution
        Film over the whole domain, or inside a patch.
    patch : Patch, optional
        Patch that the film covers; its coarse film is outside.
    """
    mesh, maps = solution.level.mesh, _maps(problem, solution)
    if groups.ratio is None:
        return _of_line(groups, mesh.x, *(values[:, 0] for values in maps))
    if patch is None:
        return _of_point(groups, mesh.x, mesh.whole_y, [mesh.mirrored(values) for values in maps])
    joined, coarse = patch.join(mesh), _maps(problem, patch.coarse)
    whole = [joined(outer, inner) for outer, inner in zip(coarse, maps, strict=True)]
    return _of_point(groups, joined.x, joined.y, whole)


def _maps(problem: FilmProblem, solution: GridSolution) -> list[Array]:
    """Pressure, film thickness and density of a film, shape (nx, ny)."""
    pressure = solution.state.pressure
    density = np.asarray(problem.fluid.density(np.maximum(pressure, 0.0))[0])
    return [pressure, solution.state.thickness, density]


def _of_line(groups: Groups, x: Array, pressure: Array, thickness: Array, density: Array) -> Array:
    """Numbers of a line contact."""
    film, mass, p = (make_interp_spline(x, v, 3) for v in (thickness, density * thickness, pressure))
    at = np.linspace(-1.0, 1.0, 4001)
    i = int(np.argmin(thickness))
    fine = np.linspace(x[max(i - 2, 0)], x[min(i + 2, x.size - 1)], 401)
    least = fine[np.argmin(film(fine))]
    centre = float(film(0.0))
    before, behind = np.linspace(-4.0, -1.0, 3001), np.linspace(1.0, 2.0, 1001)
    outside = [
        float(np.trapezoid(1.0 / film(part), part) / np.trapezoid(1.0 / (centre + line_gap(part)), part))
        for part in (before, behind)
    ]
    unit = groups.thickness_unit
    mean = float(np.trapezoid(film(at), at)) / 2.0
    zone = float(mass(0.0)) * float(np.trapezoid(1.0 / mass(at), at)) / 2.0
    films = [unit * float(mass(0.0)), unit * float(film(least)), unit * mean]
    return np.array([*films, float(p(0.0)), zone, *outside, least, 0.0])


def _of_point(groups: Groups, x: Array, y: Array, maps: list[Array]) -> Array:
    """Numbers of a point contact from its pressure, film thickness and density (nx, ny)."""
    k, unit = groups.ratio, groups.thickness_unit
    assert k is not None
    pressure, thickness, density = maps
    film = RectBivariateSpline(x, y, np.log(thickness), s=0)
    mass = RectBivariateSpline(x, y, np.log(thickness * density), s=0)
    points, weights = np.polynomial.legendre.leggauss(_RADII)
    radius = np.sqrt(0.5 * (points[:, np.newaxis] + 1.0))
    angle = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
    disc = (radius * np.cos(angle), k * radius * np.sin(angle))
    centre, mass_0 = math.exp(float(film.ev(_MIDDLE, _MIDDLE))), float(mass.ev(_MIDDLE, _MIDDLE))
    mean = 0.5 * float(weights @ np.exp(film.ev(*disc)).mean(axis=1))
    zone = 0.5 * float(weights @ np.exp(mass_0 - mass.ev(*disc)).mean(axis=1))
    least = _least(film, x, y, thickness)
    p_0 = float(RectBivariateSpline(x, y, pressure, s=0).ev(_MIDDLE, _MIDDLE))
    films = [unit * math.exp(mass_0), unit * least[0], unit * mean]
    outside = _outside(groups, film, centre)
    return np.array([*films, p_0, zone, *outside, least[1], abs(least[2]) / k])


def _least(film: RectBivariateSpline, x: Array, y: Array, thickness: Array) -> tuple[float, float, float]:
    """Smallest film thickness between the nodes and its place, by a spline of ln H."""
    i, j = map(int, np.unravel_index(np.argmin(thickness), thickness.shape))
    at_x = np.linspace(x[max(i - 1, 0)], x[min(i + 1, x.size - 1)], 41)
    at_y = np.linspace(y[max(j - 1, 0)], y[min(j + 1, y.size - 1)], 41)
    values = film(at_x, at_y)
    m, n = np.unravel_index(np.argmin(values), values.shape)
    return math.exp(float(values[m, n])), float(at_x[m]), float(at_y[n])


def _outside(groups: Groups, film: RectBivariateSpline, centre: float) -> list[float]:
    """Integrals of dA/h outside the Hertz ellipse over those of the dry gap, before and behind."""
    k = groups.ratio
    assert k is not None
    side = min(4.5, 1.6 + 1.4 / k) * k
    x, y = np.linspace(-4.5, 1.5, _OUTSIDE[0]), np.linspace(0.0, side, _OUTSIDE[1])
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=k, max_pressure=1.0, approach=0.0)
    # H = h Rx/b^2; the deflection under p_h is p_h b/E' times a unit deflection, and p_h Rx/(b E') = ph_unit.
    load = (groups._q * groups.moes_m) ** (1.0 / 3.0)
    scale = 1.5 / math.pi / k * groups.moes_m ** (1.0 / 3.0) * groups._q ** (-2.0 / 3.0) / load
    opened = scale * point_deflection(x[:, np.newaxis], y, unit, 1.0)
    middle = scale * float(point_deflection(0.0, 0.0, unit, 1.0))
    rigid = 0.5 * (x[:, np.newaxis] ** 2 + y**2 / groups.radius_ratio)
    dry = centre + np.maximum(0.0, rigid + opened - middle)
    free = x[:, np.newaxis] ** 2 + (y / k) ** 2 > 1.0
    weights = np.ones_like(y)
    weights[[0, -1]] = 0.5
    ratios = []
    for part in (x < 0.0, x > 0.0):
        where = free & part[:, np.newaxis]
        inside = np.where(where, weights, 0.0)
        ratios.append(float(np.sum(inside * np.exp(-film(x, y))) / np.sum(inside / dry)))
    return ratios
