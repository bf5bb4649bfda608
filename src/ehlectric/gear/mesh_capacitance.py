"""Capacitance of a gear mesh: all lines of contact, and the flanks behind the working ones. SI units.

Per length of a line of contact, with the central film h, the half-width b of the dry contact and the
permittivity eps_p under the pressure,

    C' = eps0 (integral of eps_p dx/h over the Hertz zone + eps_r integral of dx/gap before and behind it).

The gap outside the zone is the dry gap plus the film; beyond a few half-widths it is the gap of two circles
with the radii of curvature of both flanks. The whole gears have more: the flanks at the normal backlash j_n
behind each pair, cylinders that approach each other to j_n, have per pair

    C_back = eps0 eps_r pi sqrt(2 rho_n/j_n) b/cos beta_b.

All other gaps between the teeth add less than 5 eps0 b (boundary elements of two whole gears).
"""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import RollerRaceway, permittivity_of_mass, roller_tails
from ehlectric.cases.grid_inputs import DEFAULT_ENDS
from ehlectric.constants import EPSILON_0
from ehlectric.formulas.dry_means import STRIP, pressure_mean, wedge_integral
from ehlectric.formulas.hertz import line_gap
from ehlectric.gear.flank_films import FlankFilms, Flanks

# Ends of the domain of the atlas before and behind the contact, over the half-width.
_ENDS = DEFAULT_ENDS[False]


def capacitance_per_length(flanks: Flanks, films: FlankFilms) -> Array:
    """Return the capacitance per length [F/m] at the places of the films; NaN without a film."""
    assert films.atlas is not None
    oil, film = flanks.oil, films.atlas.film
    # The atlas has the mean of 1/(rho h) over that in the middle, where the mass is most alike for all oils.
    mass = films.central * film.mass / film.central
    share = np.minimum(1.0, film.central_pressure)
    permittivity = pressure_mean(STRIP, partial(permittivity_of_mass, oil), share * films.max_pressure)
    zone = film.zone * permittivity * 2.0 * films.half_width / mass
    middle = films.central * films.reduced_radius / films.half_width**2
    unit = films.reduced_radius / films.half_width
    inlet, outlet = (unit * wedge_integral(middle, end) for end in _ENDS)
    near = oil.relative_permittivity * (film.inlet * inlet + film.outlet * outlet)
    total: Array = EPSILON_0 * (zone + near) + oil.relative_permittivity * _tails(flanks, films)
    return total


def _tails(flanks: Flanks, films: FlankFilms) -> Array:
    """Capacitance per length in vacuum beyond the domain of the atlas [F/m]."""
    first, second = flanks.normal_radii(films.places)
    b, ends = films.half_width, _ENDS
    # A raceway of a roller is the flank with the larger radius, which is concave in a ring.
    race = RollerRaceway(
        np.minimum(first, np.abs(second)), np.maximum(first, np.abs(second)), flanks.path.tangent_length < 0.0
    )
    gaps = [films.central + b**2 / films.reduced_radius * line_gap(end) for end in ends]
    inlet, outlet = roller_tails(race, b, (ends[0] * b, ends[1] * b), (gaps[0], gaps[1]))
    return np.asarray(inlet) + outlet


def back_capacitance(
    reduced_radius: float, backlash: float, length: float, relative_permittivity: float
) -> float:
    """Capacitance of one pair of flanks behind the working ones [F]. ``reduced_radius``, rho_n [m];
    ``backlash``, normal backlash [m]; ``length``, length of the line at which they are closest [m].

    The limit of two cylinders at a small distance, which tests compare with the exact capacitance.
    """
    return EPSILON_0 * relative_permittivity * math.pi * math.sqrt(2.0 * reduced_radius / backlash) * length
