"""Contacts of a bearing from the atlas of films, and by formula where the atlas has no film."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial
from typing import TypeAlias, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.quick.by_formula import ball_by_formula, roller_by_formula
from ehlectric.bearing.quick.dry import (
    LINE,
    POINT,
    QuickContact,
    hertz_area,
    hertz_mean,
    permittivity,
    quick_contact,
)
from ehlectric.bearing.quick.errors import FORMULA_OF_BALLS, FORMULA_OF_ROLLERS
from ehlectric.bearing.ring_contacts import BallContact, Contact, RollerContact, check_contact
from ehlectric.contact.conditions import default_side
from ehlectric.errors import InputError, ResultWarning
from ehlectric.film.atlas.contact import ContactFilm, contact_film
from ehlectric.formulas.hertz_line import line_gap
from ehlectric.formulas.hertz_point import dry_contact, point_deflection
from ehlectric.lubricant.oil import Oil

# Keys of the errors with which the atlas says that it has no film of a contact.
_LEFT = ("moes_m", "moes_n", "moes_y", "ratio", "atlas")

# Loads at which the atlas is asked for the nearest film that it has: their ratio, how many there are either
# way, and how often the last ratio is halved.
_STEP, _STEPS, _HALVINGS = 1.3, 15, 6

# Nodes and weights on 0 to 1 with which the gap outside the Hertz area is integrated. The integrals are
# within 1e-4 of those with three times as many nodes.
_NODES, _WEIGHTS = (0.5 * values for values in np.polynomial.legendre.leggauss(32))
_NODES = _NODES + 0.5

# Kind of a contact, and functions that compute one: from the atlas, and by formula with further options.
C = TypeVar("C", BallContact, RollerContact)
Way: TypeAlias = Callable[[C], QuickContact]
FormulaWay: TypeAlias = Callable[..., QuickContact]

# Integral over a part of the dry gap outside the Hertz area: weights and gaps, both dimensionless.
_Part = tuple[Array, Array]


def ball_by_atlas(contact: BallContact) -> QuickContact:
    """Film, capacitances and voltages of a ball's contact from the atlas of films.

    Parameters
    ----------
    contact : BallContact
        Contact and load.

    Returns
    -------
    QuickContact
        Numbers with the error that the atlas states for the films. Outside the atlas the films at the nearest
        load that it has change with the load as in the formula of Nijenbanning, Venner and Moes (rollers: of
        Moes). Without such a load they are those of ``ball_by_formula``. Both have the error of a formula,
        and a warning.

    Raises
    ------
    InputError
        As ``check_contact`` does.

    Notes
    -----
    Over the Hertz area the capacitance is that of the film of the atlas with the permittivity under the Hertz
    pressure, which is lowered to the central pressure of the atlas in light contacts. Around it, inside the
    domain of the atlas, it is that of the dry gap plus the central film, times the ratio that the atlas has
    for inlet or outlet, with the permittivity at ambient pressure. The largest field strength is the voltage
    over the minimum film thickness.
    """
    check_contact(contact)
    film = _film(contact)
    if film is None:
        return _left(contact, (ball_by_atlas, ball_by_formula), FORMULA_OF_BALLS - 1.0)
    conditions = contact.conditions
    radius = conditions.radius_x
    # The gap over b^2/Rx depends on the ratio of the radii alone, and dA/h has the unit Rx.
    middle = film.central_thickness * radius / conditions.semi_axis_x**2
    parts = _around_ball(conditions.radius_y / radius)
    return _solution(contact, film, [radius * _integral(part, middle) for part in parts])


def roller_by_atlas(contact: RollerContact) -> QuickContact:
    """Film, capacitances and voltages of a roller's contact from the atlas of films.

    Parameters, returned values, errors and notes are those of ``ball_by_atlas``, with the formula of
    ``roller_by_formula`` outside the atlas.
    """
    check_contact(contact)
    film = _film(contact)
    if film is None:
        return _left(contact, (roller_by_atlas, roller_by_formula), FORMULA_OF_ROLLERS - 1.0)
    conditions = contact.conditions
    radius, b = conditions.reduced_radius, conditions.half_width
    middle = film.central_thickness * radius / b**2
    unit = contact.length * radius / b
    return _solution(contact, film, [unit * _integral(part, middle) for part in _around_roller()])


def _film(contact: Contact) -> ContactFilm | None:
    """Film of a contact; None outside the atlas."""
    try:
        return contact_film(contact.conditions.contact, contact.ring.oil)
    except InputError as error:
        if error.key not in _LEFT:
            raise
        return None


def _left(contact: C, ways: tuple[Way[C], FormulaWay], error: float) -> QuickContact:
    """Contact outside the atlas: by formula, joined to the atlas at the nearest load that it has.

    Parameters
    ----------
    contact : BallContact or RollerContact
        Contact that the atlas does not have.
    ways : tuple of callable
        Contact from the atlas, and by formula or with the gap of given films.
    error : float
        Relative error of the formula.
    """
    by_atlas, by_formula = ways[0], partial(ways[1], wide=True)
    text = f"outside the atlas of films: the film is by formula, and may be {100.0 * error:.0f} % off"
    edge = _edge(contact)
    if edge is None:
        solution: QuickContact = by_formula(contact)
    else:
        # Without a step at the edge of the atlas, all quantities can be interpolated over the load. From
        # there the films change as those of a formula that holds for light contacts, too.
        own, trend = by_atlas(edge), contact.film / edge.film
        least, central = own.films
        joined = by_formula(edge, own.films)
        solution = by_formula(contact, (trend * least, trend * central))
        inside, hertz = own.inside / joined.inside, own.hertz / joined.hertz
        solution = replace(solution, inside=inside * solution.inside, hertz=hertz * solution.hertz)
    return replace(solution, error=error, warnings=(ResultWarning("atlas-left", text),))


def _edge(contact: C) -> C | None:
    """Same contact under the load nearest to its own that the atlas has; None where it has none near."""
    for number in range(1, _STEPS + 1):
        for step in (_STEP, 1.0 / _STEP):
            inside = replace(contact, load=contact.load * step**number)
            if _film(inside) is None:
                continue
            outside, ratio = contact.load * step ** (number - 1), step
            for _ in range(_HALVINGS):
                ratio = math.sqrt(ratio)
                between = replace(contact, load=outside * ratio)
                if _film(between) is None:
                    outside = between.load
                else:
                    inside = between
            return inside
    return None


def _solution(contact: Contact, film: ContactFilm, around: list[float]) -> QuickContact:
    """Numbers of a contact; ``around`` are the integrals of dA/h of the dry gap before and behind [m]."""
    oil, numbers = contact.ring.oil, film.film
    # The atlas has the mean of 1/(rho h) over that in the middle, where the mass is most alike for all oils.
    mass = film.central_thickness * numbers.mass / numbers.central
    # In a light contact the pressure reaches far ahead of the zone, and is lower in it. Where a spike passes
    # the middle, its pressure is not that of the zone.
    share = min(1.0, numbers.central_pressure)
    law = _permittivity_of_mass(oil)
    mean = hertz_mean(contact, lambda pressure: law(share * pressure))
    hertz = numbers.zone * mean * hertz_area(contact) / mass
    outside = oil.relative_permittivity * (numbers.inlet * around[0] + numbers.outlet * around[1])
    return quick_contact(
        contact,
        (film.minimum_thickness, film.central_thickness),
        inside=hertz + outside,
        hertz=hertz,
        error=max(film.errors["central"], film.errors["minimum"]),
        wide=True,
    )


def _permittivity_of_mass(oil: Oil) -> Callable[[Array], Array]:
    """Relative permittivity times density ratio of an oil over the pressure [Pa]."""
    return lambda pressure: permittivity(oil, pressure) * oil.density_ratio(pressure)[0]


def _integral(part: _Part, middle: float) -> float:
    """Integral of dA/h over a part of the gap, widened by the film in the middle; dimensionless."""
    weights, gap = part
    return float(np.sum(weights / (middle + gap)))


@lru_cache(maxsize=1)
def _around_roller() -> tuple[_Part, _Part]:
    """Gap before and behind the Hertz zone of a roller, with lengths in b and gaps in b^2/R.

    Nodes are dense at the edge of the zone, where the gap begins with a power of 1.5.
    """
    parts = []
    for end in LINE:
        length = abs(end) - 1.0
        x = 1.0 + length * _NODES**3
        parts.append((length * 3.0 * _NODES**2 * _WEIGHTS, line_gap(x)))
    return parts[0], parts[1]


@lru_cache(maxsize=32)
def _around_ball(radius_ratio: float) -> tuple[_Part, _Part]:
    """Gap before and behind the middle of a ball's contact, outside the Hertz ellipse.

    Lengths are in b and gaps in b^2/Rx. Beside the ellipse, x is the cosine of an angle, so that its edge is
    smooth in this angle; away from it nodes are dense at the edge.
    """
    dry = dry_contact(1.0, 1.0, radius_ratio, 1.0)
    b, a = dry.semi_axis_x, dry.semi_axis_y
    side = default_side(a / b)
    # Beside the ellipse: angle and distance from its edge.
    angle, far = 0.5 * np.pi * _NODES[:, np.newaxis], _NODES**3
    edge = np.sin(angle)
    beside = np.cos(angle), edge + (side - edge) * far
    weights = 0.5 * np.pi * edge * _WEIGHTS[:, np.newaxis] * (side - edge) * 3.0 * _NODES**2 * _WEIGHTS
    parts = []
    for end in POINT:
        length = abs(end) - 1.0
        ahead = 1.0 + length * _NODES[:, np.newaxis] ** 3, side * _NODES
        more = length * 3.0 * (_NODES**2 * _WEIGHTS)[:, np.newaxis] * side * _WEIGHTS
        # Both halves across entrainment.
        both = 2.0 * a / b * np.stack([weights, more])
        x, y = (np.stack(np.broadcast_arrays(*pair)) for pair in zip(beside, ahead, strict=True))
        x, y = b * x, a * y
        rigid = 0.5 * (x**2 + y**2 / radius_ratio)
        gap = np.maximum(0.0, rigid + point_deflection(x, y, dry, 1.0) - dry.approach) / b**2
        parts.append((both, gap))
    return parts[0], parts[1]
