"""Capacitance between a roller and its race, outside the loaded film. SI units, per length of the roller.

Both are circles: the race convex at the inner ring and concave at the outer one. With the radii R of the race
and r of the roller, and its centre O at R_o = R +- (r + h0) from the axis, a point Q of the race at the
azimuth phi has

    abs(Q - O)^2 = (r + h0)^2 + 4 R R_o sin^2(phi/2).

The gap is measured from Q along the radius of the roller, abs(Q - O) - r, and the charge on the race is that
of ``thin_gap.charge_density``. It is summed as far as half of the roller faces the race: to where the race's
own normal only grazes the roller. The field around the ends of the roller is not in it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.gaps.thin import charge_density, stretched
from ehlectric.formulas.hertz_line import line_gap, reduced_radius

# Nodes to a side; tests hold the integral they give to 1e-8.
_NODES = 48

# A half of the roller faces the race.
_HALF = 0.5 * np.pi


@dataclass(frozen=True)
class RollerRaceway:
    """The race of one ring and the roller on it.

    Attributes
    ----------
    roller_radius, race_radius : float
        r and R [m].
    outer : bool
        Whether the ring is the outer one.
    """

    roller_radius: float
    race_radius: float
    outer: bool

    @property
    def curvature(self) -> float:
        """Of the race [1/m], positive where it is concave."""
        return (1.0 if self.outer else -1.0) / self.race_radius

    def pitch_radius(self, gap: float) -> float:
        """R_o, from the axis of the bearing to the centre of the roller, at a gap [m]."""
        return self.race_radius - (1.0 if self.outer else -1.0) * (self.roller_radius + gap)


def roller_capacitance(
    race: RollerRaceway, gap: float, relative_permittivity: float = 1.0, *, obliquity: float = _HALF
) -> float:
    """Capacitance per length between an unloaded, rigid roller and its race.

    Parameters
    ----------
    race : RollerRaceway
        The race and the roller.
    gap : float
        h0, the least [m], positive.
    relative_permittivity : float
        Of what fills the gap.
    obliquity : float
        How far: to where the race's normal meets the surface of the roller at this angle from its normal
        [rad]; 90 degrees where it grazes it.

    Returns
    -------
    float
        [F/m].

    Examples
    --------
    Of parabolas, h0 + x^2/(2 R), without an end it would be eps0 pi sqrt(2 R/h0):

    >>> race = RollerRaceway(5.5e-3, 27.25e-3, outer=False)
    >>> reduced = 1.0 / (1.0 / 5.5e-3 + 1.0 / 27.25e-3)
    >>> parabolas = epsilon_0 * np.pi * np.sqrt(2.0 * reduced / 1e-6)
    >>> round(float(roller_capacitance(race, 1e-6) / parabolas), 3)
    0.987
    """
    pitch = race.pitch_radius(gap)
    # Where the gap is twice the least.
    scale = np.sqrt(2.0 * race.roller_radius * gap / (race.race_radius * pitch))
    phi, weights = stretched(0.0, _reach(race, gap, obliquity), scale, _NODES)
    distance, tilt = _distances(race, gap, phi)
    return 2.0 * epsilon_0 * relative_permittivity * _charge(race, distance, tilt, weights)


def roller_tails(
    race: RollerRaceway,
    half_width: float,
    domain: tuple[float, float],
    thickness: tuple[float, float],
    relative_permittivity: float = 1.0,
    *,
    obliquity: float = _HALF,
) -> tuple[float, float]:
    """Capacitance per length outside the domain of a solved line contact, at its inlet and at its outlet.

    The gap is that of the touching circles, opened by the deflection under the Hertz pressure and moved by
    what makes it continue the film at each end.

    Parameters
    ----------
    race : RollerRaceway
        The race and the roller.
    half_width : float
        b of the dry contact [m].
    domain : tuple of float
        Inlet and outlet of the film's domain [m], along the arc of the race from the contact; the inlet is
        negative, and both are beyond the half-width.
    thickness : tuple of float
        Film thickness there [m].
    relative_permittivity : float
        Of what fills the gap.
    obliquity : float
        As in ``roller_capacitance`` [rad].

    Returns
    -------
    inlet, outlet : float
        [F/m], each about 2 eps0 eps R/abs(x) with the reduced radius R; zero where the domain reaches
        further.

    Examples
    --------
    >>> race = RollerRaceway(5.5e-3, 27.25e-3, outer=False)
    >>> reduced = 1.0 / (1.0 / 5.5e-3 + 1.0 / 27.25e-3)
    >>> film = 5e-7 + 4e-4**2 / (2.0 * reduced)
    >>> inlet, outlet = roller_tails(race, 1e-4, (-4e-4, 4e-4), (film, film))
    >>> inlet == outlet, round(inlet / (2.0 * epsilon_0 * reduced / 4e-4), 2)
    (True, 0.91)
    """

    def tail(start: float, film: float) -> float:
        first, last = start / race.race_radius, _reach(race, 0.0, obliquity)
        if first >= last:
            return 0.0
        phi, weights = stretched(first, last, first, _NODES)
        distance, tilt = _distances(race, 0.0, np.append(phi, first))
        gap = distance + _opening(race, half_width, np.append(phi, first) * race.race_radius)
        return _charge(race, gap[:-1] + film - gap[-1], tilt[:-1], weights)

    scale = epsilon_0 * relative_permittivity
    return scale * tail(-domain[0], thickness[0]), scale * tail(domain[1], thickness[1])


def _opening(race: RollerRaceway, half_width: float, x: Array) -> Array:
    # What the dry contact's gap has beyond that of the parabolas; of a line its zero is free.
    radius = reduced_radius(race.roller_radius, -1.0 / race.curvature)
    return half_width**2 / radius * line_gap(x / half_width) - 0.5 * x**2 / radius


def _charge(race: RollerRaceway, gap: Array, tilt: Array, weights: Array) -> float:
    """Integral of the charge density over the arc of the race, dimensionless."""
    density = charge_density(gap, tilt, 1.0 / race.roller_radius, race.curvature)
    return race.race_radius * float(np.vdot(weights, density))


def _distances(race: RollerRaceway, gap: float, phi: Array) -> tuple[Array, Array]:
    """The gap along the radius of the roller [m], and the angle of that radius to the normal of the race."""
    pitch, near, q = race.pitch_radius(gap), race.roller_radius + gap, np.sin(0.5 * phi) ** 2
    further = 4.0 * race.race_radius * pitch * q
    beyond = further / (np.sqrt(near**2 + further) + near)
    along = near + (2.0 * pitch * q if race.outer else -2.0 * pitch * q)
    return gap + beyond, np.arctan2(pitch * np.sin(phi), along)


def _reach(race: RollerRaceway, gap: float, obliquity: float) -> float:
    """Azimuth at which the normal of the race meets the roller at this angle from its normal [rad]."""
    return float(np.arcsin(race.roller_radius * np.sin(obliquity) / race.pitch_radius(gap)))
