"""Electrical answer of a contact whose surfaces touch: its spots, and the film around them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from scipy.constants import epsilon_0
from scipy.special import ellipk

from ehlectric.arrays import Array
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.grid import Electric
from ehlectric.contact.spots.mechanics import hertz_weights
from ehlectric.contact.spots.patches import Spots, weighted_percentiles
from ehlectric.discharge.laws import WeakestLink
from ehlectric.discharge.utilisation import dielectric_strength
from ehlectric.field.zones import areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.formulas.asperities.resistance import cluster_resistance, film_resistance, greenwood_cluster
from ehlectric.lubricant.oil import Oil

# Answer of a contact in one word.
Behaviour: TypeAlias = Literal["resistive", "mixed", "capacitive"]

# Frequency at which spots and film are compared [Hz]: the switching frequency of a usual inverter.
PWM_FREQUENCY = 1e4

# Ratio of the impedances of film and spots above which the spots short the film, and the reciprocal of that
# below which they do not matter: one carries ten times the current of the other.
SHORTED = 10.0

# Share of the time with at least one spot from which a contact conducts always. Three small spots at one
# instant give it, by the Poisson law.
ALWAYS = 0.95

# Shares of the area around the spots at which breakdown voltages are given.
BREAKING_SHARES = (0.01, 0.05, 0.5)

# Number of spots above which all have currents in proportion to their radii, an upper bound of the
# resistance.
_MOST_SOLVED = 2000


@dataclass(frozen=True)
class Electrical:
    """Resistance of the spots of a contact, and capacitance and breakdown of the film around them, SI units.

    Attributes
    ----------
    behaviour : str
        "resistive", "mixed" or "capacitive"; see ``behaviour_of``.
    time_share : float
        Share of the time with at least one spot, if spots of moving surfaces come and go independently of
        each other; see ``time_share``.
    resistance : float or None
        Resistance of all spots with their tribofilm [ohm]; of a line contact an upper bound for ridges along
        the whole length. None without spots, or without the resistivity of the case or the length of a line
        contact.
    constriction_resistance, tribofilm_resistance : float or None
        Its two parts, in series [ohm].
    capacitance_outside : float
        Capacitance of the film outside of the spots, over the whole domain, by a thin gap [F]; of a line
        contact per length [F/m].
    impedance_ratio : float or None
        Impedance of this capacitance at 10 kHz over ``resistance``; None if that is unknown.
    corner_frequency : float or None
        Frequency above which more current takes the film than the spots [Hz].
    breakdown_1, breakdown_5, breakdown_50 : float or None
        Voltage at which 1, 5 and 50 % of the Hertz zone outside of the spots reach the dielectric strength
        [V]; None if the case gives no strength.
    breakdown_voltage : float or None
        Voltage at which a film without its spots breaks down with a probability of 63.2 % by the Weibull law
        of the case [V]; None without this law.
    breakdown_probability : float or None
        Probability that the film outside of the spots breaks down at the voltage of the case.
    """

    behaviour: Behaviour
    time_share: float
    resistance: float | None
    constriction_resistance: float | None
    tribofilm_resistance: float | None
    capacitance_outside: float
    impedance_ratio: float | None
    corner_frequency: float | None
    breakdown_1: float | None
    breakdown_5: float | None
    breakdown_50: float | None
    breakdown_voltage: float | None
    breakdown_probability: float | None


def time_share(spots: int, area_share: float) -> float:
    """Share of the time with at least one spot, if spots of moving surfaces come and go independently.

    The Hertz zone has N/f sites of the mean size of N spots that cover its part f. Each is touched with the
    probability f, so that the time share is 1 - (1 - f)^(N/f). For small spots it is Poisson's 1 - exp(-N).

    Parameters
    ----------
    spots : int
        Number N of spots at one instant.
    area_share : float
        Part f of the Hertz zone that they cover, from 0 to 1.

    Examples
    --------
    >>> [round(time_share(spots, share), 2) for spots, share in ((0, 0.0), (1, 1e-6), (3, 0.01), (1, 0.99))]
    [0.0, 0.63, 0.95, 0.99]
    """
    if spots == 0 or area_share == 0.0:
        return 0.0
    if area_share >= 1.0:
        return 1.0
    return float(-np.expm1(spots / area_share * np.log1p(-area_share)))


def behaviour_of(
    spots: int, always: float, impedance_ratio: float | None, area_error: float | None = None
) -> Behaviour:
    """Electrical behaviour of a contact in one word.

    "capacitive": the contact has no spot, or the film takes ten times the current of its spots. "resistive":
    the spots take ten times the current of the film, and at least one is there for 95 % of the time. "mixed":
    all between, as a contact that conducts and insulates in turn, and one whose spots a finer grid may not
    have.

    Parameters
    ----------
    spots : int
        Number of spots.
    always : float
        Share of the time with at least one spot.
    impedance_ratio : float or None
        Impedance of the film over that of the spots at 10 kHz. None if the resistance of the spots is
        unknown: they are taken as metal, which shorts any film at this frequency.
    area_error : float, optional
        Relative error of the real contact area by the grid; from 1 on there may be no spot at all.

    Examples
    --------
    >>> spots = ((0, 0.0, None), (1, 0.63, None), (5, 0.99, 1e5), (5, 0.99, 0.01), (5, 0.99, 1e5, 1.2))
    >>> tuple(behaviour_of(*each) for each in spots)
    ('capacitive', 'mixed', 'resistive', 'capacitive', 'mixed')
    """
    ratio = np.inf if impedance_ratio is None else impedance_ratio
    if spots == 0 or ratio < 1.0 / SHORTED:
        return "capacitive"
    if ratio > SHORTED and always >= ALWAYS and (area_error or 0.0) < 1.0:
        return "resistive"
    return "mixed"


def strip_resistance(width: float, length: float, resistivity: float) -> float:
    """Constriction resistance of a strip between two half-spaces, as that of an ellipse with its axes.

    R = rho K(1 - b^2/a^2)/(pi a) with the semi-axes a and b and the complete elliptic integral K of a
    parameter; a circle gives rho/(2 a).

    Parameters
    ----------
    width, length : float
        Axes of the ellipse [m], > 0.
    resistivity : float
        Resistivity rho of the bodies [ohm m].

    Returns
    -------
    float
        Resistance [ohm].

    Notes
    -----
    R. Holm, Electric Contacts, 4th ed., Springer 1967; it is the capacitance of an elliptical disc.

    Examples
    --------
    >>> round(strip_resistance(2e-6, 2e-6, 2.2e-7), 6)
    0.11
    """
    minor, major = sorted((0.5 * width, 0.5 * length))
    return float(resistivity * ellipk(1.0 - (minor / major) ** 2) / (np.pi * major))


def constriction(spots: Spots, electric: Electric, length: float | None) -> float | None:
    """Constriction resistance of the spots [ohm]; None if there are none, or an input is missing.

    Spots of a point contact are circles of their areas, with their effect on each other. In a line contact
    the widest strip alone counts, which is an upper bound of all of them.
    """
    rho = electric.resistivity
    if rho is None or not spots.number:
        return None
    if spots.positions.shape[1] == 1:
        return None if length is None else strip_resistance(float(np.max(spots.areas)), length, rho)
    if spots.number > _MOST_SOLVED:
        return greenwood_cluster(spots.positions, spots.radii, rho)
    return cluster_resistance(spots.positions, spots.radii, rho, electric.mean_free_path or 0.0)


def electrical(
    film: Film | PointFilm,
    spots: Spots,
    oil: Oil,
    *,
    electric: Electric,
    discharge: Discharge | None,
    semi_axes: tuple[float, ...],
    area_error: float | None = None,
) -> Electrical:
    """Electrical answer of a contact whose surfaces touch in spots.

    Parameters
    ----------
    film : Film or PointFilm
        Solved film.
    spots : Spots
        Spots of the film.
    oil : Oil
        Oil, for its permittivity.
    electric : Electric
        Potentials, and resistivity of the bodies and of their tribofilm.
    discharge : Discharge or None
        Dielectric strength or Weibull law, and length of a line contact.
    semi_axes : tuple of float
        Half-width of a line contact, or semi-axes of a point contact [m].
    area_error : float, optional
        Relative error of the real contact area by the grid.

    Returns
    -------
    Electrical
        Resistance, capacitance, breakdown voltages, and the behaviour in one word.
    """
    length = 1.0 if len(semi_axes) == 2 else None if discharge is None else discharge.length
    metal = constriction(spots, electric, length)
    layer = None
    if metal is not None and length is not None:
        layer = float(film_resistance(spots.area * length, electric.tribofilm_resistance or 0.0))
    resistance = None if metal is None or layer is None else metal + layer
    permittivity = oil.permittivity(film.pressure, film.density)
    outside = np.where(film.contact, 0.0, areas(film.axes))
    capacitance = float(np.sum(outside * epsilon_0 * permittivity / film.thickness))
    ratio = corner = None
    if resistance is not None and length is not None:
        corner = 1.0 / (2.0 * np.pi * resistance * capacitance * length)
        ratio = corner / PWM_FREQUENCY
    zone = hertz_weights(film, semi_axes)
    always = time_share(spots.number, float(np.sum(zone[film.contact]) / np.sum(zone)))
    thin = _thin_breakdown(film, zone, discharge)
    weakest = _weakest(film, outside, electric.voltage, discharge)
    return Electrical(
        behaviour=behaviour_of(spots.number, always, ratio, area_error),
        time_share=always,
        resistance=resistance,
        constriction_resistance=metal,
        tribofilm_resistance=layer,
        capacitance_outside=capacitance,
        impedance_ratio=ratio,
        corner_frequency=corner,
        breakdown_1=thin[0],
        breakdown_5=thin[1],
        breakdown_50=thin[2],
        breakdown_voltage=None if weakest is None else weakest.characteristic_voltage,
        breakdown_probability=None if weakest is None else weakest.probability(electric.voltage),
    )


def _thin_breakdown(
    film: Film | PointFilm, zone: Array, discharge: Discharge | None
) -> tuple[float, ...] | tuple[None, ...]:
    """Voltages at which shares of the Hertz zone outside of the spots reach the dielectric strength [V]."""
    inside = ~film.contact & (zone > 0.0)
    if discharge is None or not discharge.has_strength or not np.any(inside):
        return (None,) * len(BREAKING_SHARES)
    voltage = (film.thickness * dielectric_strength(discharge, film.pressure))[inside]
    return tuple(float(each) for each in weighted_percentiles(voltage, zone[inside], BREAKING_SHARES))


def _weakest(
    film: Film | PointFilm, outside: Array, voltage: float, discharge: Discharge | None
) -> WeakestLink | None:
    """Weibull law of the film outside of the spots; None if the case gives none, or no length."""
    if discharge is None or discharge.weibull is None:
        return None
    law, inside = discharge.weibull, outside > 0.0
    length = 1.0 if film.thickness.ndim == 2 else discharge.length
    assert length is not None
    return WeakestLink.of(
        voltage,
        voltage / film.thickness[inside],
        length * outside[inside],
        law.scale,
        law.shape,
        law.reference_area,
    )
