"""Capacitance of a gear mesh: all lines of contact, and the flanks behind the working ones. SI units.

Per length of a line of contact, with the central film h, the half-width b of the dry contact and the
permittivity eps_p under the pressure,

    C' = eps0 (integral of eps_p dx/h over the Hertz zone + eps_r integral of dx/gap before and behind it).

The gap outside the zone is the dry gap plus the film; beyond a few half-widths it is the gap of two circles
with the radii of curvature of both flanks. If relief or crowning keeps the flanks of a line apart, by the
gap f - delta, C' is the one of cylinders at this gap, to which the film under the lightest load is added,
eps0 eps_r pi sqrt(2 rho_n/gap). The whole gears have more: the flanks at the normal backlash j_n behind each
pair, cylinders that approach each other to j_n, have per pair

    C_back = eps0 eps_r pi sqrt(2 rho_n/j_n) b/cos beta_b.

All other gaps between the teeth add less than 5 eps0 b (boundary elements of two whole gears).
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import RollerRaceway, roller_tails
from ehlectric.cases.grid_inputs import DEFAULT_ENDS
from ehlectric.constants import EPSILON_0
from ehlectric.formulas.dry_means import wedge_beyond, wedge_integral
from ehlectric.formulas.hertz import line_gap
from ehlectric.gear.film_table import FilmShape
from ehlectric.gear.flank_films import FlankFilms, Flanks
from ehlectric.gear.load_sharing import OpenPieces

# Ends of the domain of the atlas before and behind the contact, over the half-width.
_ENDS = DEFAULT_ENDS[False]

# Logarithms of the constant part of the gap over b^2/R at which its integrals are computed.
_MIDDLES = np.linspace(math.log(1e-9), math.log(1e6), 2048)

# Ratios of the radii of two cylinders at which their tails are computed; half-width and film of these tails
# over the reduced radius.
_RATIOS, _HALF_WIDTH, _FILM = np.linspace(0.0, 1.0, 65)[1:], 0.02, 1e-5


def capacitance_per_length(flanks: Flanks, films: FlankFilms, shape: FilmShape) -> Array:
    """Capacitance per length [F/m] at the places of the films, shape (n,); NaN without a film."""
    epsilon, width = flanks.oil.relative_permittivity, films.half_width
    share = np.minimum(1.0, shape.central_pressure)
    # The atlas has the mean of 1/(rho h) over that in the middle, where the mass is most alike for all oils.
    zone = shape.zone * flanks.oil.zone_permittivity(share * films.max_pressure) * 2.0 * width / films.central
    unit = films.reduced_radius / width
    inlet, outlet, beyond = _gap_integrals(films.central * unit / width)
    near = unit * (shape.inlet * inlet + shape.outlet * outlet + beyond) + _of_circles(flanks, films.places)
    return np.asarray(EPSILON_0 * (zone + epsilon * near))


@lru_cache(maxsize=1)
def _tabulated_integrals() -> Array:
    """Logarithms of the integrals of dx/gap before and behind the zone, and beyond both ends, in R/b."""
    middle = np.exp(_MIDDLES)
    inlet, outlet = (wedge_integral(middle, end) for end in _ENDS)
    first, second = (wedge_beyond(middle, end) for end in _ENDS)
    return np.log(np.stack([inlet, outlet, first + second]))


def _gap_integrals(middle: Array) -> list[Array]:
    """Integrals of dx/gap before and behind the zone, and beyond both ends [R/b], each of shape (n,).
    ``middle``, constant part of the gap [b^2/R], shape (n,).
    """
    at = np.log(middle)
    return [np.exp(np.interp(at, _MIDDLES, logs)) for logs in _tabulated_integrals()]


@lru_cache(maxsize=2)
def _tabulated_circles(*, concave: bool) -> Array:
    """Integrals of dx/gap beyond both ends for cylinders less those for parabolas, at ``_RATIOS``.

    The width of the contact and its film have almost no influence on these differences.
    """
    # The flank of a ring has the value at half of its radius also for larger gears in it.
    second = -1.0 / _RATIOS[_RATIOS < 0.5] if concave else 1.0 / _RATIOS
    radius = 1.0 / (1.0 + 1.0 / second)
    width = _HALF_WIDTH * radius
    race = RollerRaceway(np.ones_like(second), np.abs(second), concave)
    gaps = [_FILM * radius + width**2 / radius * line_gap(end) for end in _ENDS]
    before, behind = roller_tails(race, width, (_ENDS[0] * width, _ENDS[1] * width), (gaps[0], gaps[1]))
    middle = np.full_like(radius, _FILM / _HALF_WIDTH**2)
    parabolas = [wedge_beyond(middle, end) / _HALF_WIDTH for end in _ENDS]
    tails: Array = np.asarray(before) + np.asarray(behind)
    beyond: Array = parabolas[0] + parabolas[1]
    return tails / EPSILON_0 - beyond


def _of_circles(flanks: Flanks, places: Array) -> Array:
    """Integral of dx/gap beyond both ends for the cylinders at places g, less the integral for parabolas."""
    first, second = flanks.path.transverse_radii(places)
    concave = flanks.path.tangent_length < 0.0
    ratio = np.asarray(first / np.abs(second) if concave else np.minimum(first / second, second / first))
    known = _tabulated_circles(concave=concave)
    return np.asarray(np.interp(ratio, _RATIOS[: known.size], known))


def open_capacitance(flanks: Flanks, pieces: OpenPieces, film: float, phases: int) -> Array:
    """Capacitance of lines at which the flanks do not touch at each phase [F], shape (phases,).

    Over a length L between the gaps g_1 and g_2, including the ``film`` [m] under the lightest load, the
    mean of 1/sqrt(gap) of a linear gap is 2/(sqrt(g_1) + sqrt(g_2)).
    """
    roots = np.sqrt(pieces.first_gap + film) + np.sqrt(pieces.last_gap + film)
    radius = np.asarray(flanks.path.reduced_radius(pieces.places))
    mean = 2.0 * np.sqrt(2.0 * radius) / roots
    each = EPSILON_0 * flanks.oil.relative_permittivity * math.pi * mean * pieces.length
    return np.asarray(np.bincount(pieces.phase, each, phases), dtype=float)


def back_capacitance(
    reduced_radius: float, backlash: float, length: float, relative_permittivity: float
) -> float:
    """Capacitance of one pair of flanks behind the working ones [F]. ``reduced_radius``, rho_n [m];
    ``backlash``, normal backlash [m]; ``length``, length of the line at which they are closest [m].

    The limit of two cylinders at a small distance, which tests compare with the exact capacitance.
    """
    return EPSILON_0 * relative_permittivity * math.pi * math.sqrt(2.0 * reduced_radius / backlash) * length
