"""Capacitance between a roller and its raceway outside the loaded film, per length of the roller. SI units.

Roller and raceway are circles. The raceway is convex at the inner ring and concave at the outer ring. R is
the radius of the raceway, r that of the roller, and h0 the smallest gap. The roller's centre O is at
R_o = R + r + h0 from the bearing axis at the inner ring, and at R_o = R - r - h0 at the outer ring. For a
point Q on the raceway at the azimuth phi

    abs(Q - O)^2 = (r + h0)^2 + 4 R R_o sin^2(phi/2).

The gap at Q is measured along the radius of the roller, abs(Q - O) - r.
``ehlectric.formulas.thin_gap.charge_density`` gives the charge on the raceway. It is integrated over the part
that half of the roller faces: to where the normal of the raceway is tangent to the roller. The field around
the ends of the roller is neglected.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.formulas.hertz_line import line_opening, reduced_radius
from ehlectric.formulas.thin_gap import charge_density, stretched

# Quadrature nodes on each side of the contact; tests check that the integral is accurate to 1e-8.
_NODES = 48

# Angle between the normals of roller and raceway where the half that faces the raceway ends [rad].
_HALF = 0.5 * np.pi


@dataclass(frozen=True)
class RollerRaceway:
    """Raceway of one ring, and the roller on it.

    Attributes
    ----------
    roller_radius, race_radius : float
        Radius r of the roller and R of the raceway [m].
    outer : bool
        Whether the ring is the outer one.
    """

    roller_radius: float
    race_radius: float
    outer: bool

    @property
    def curvature(self) -> float:
        """Curvature of the raceway, positive where it is concave [1/m]."""
        return (1.0 if self.outer else -1.0) / self.race_radius

    def pitch_radius(self, gap: float) -> float:
        """Distance R_o from the axis of the bearing to the centre of the roller, for a gap [m]."""
        return self.race_radius - (1.0 if self.outer else -1.0) * (self.roller_radius + gap)


def roller_capacitance(
    race: RollerRaceway, gap: float, relative_permittivity: float = 1.0, *, obliquity: float = _HALF
) -> float:
    """Capacitance per length between an unloaded, rigid roller and its raceway.

    Parameters
    ----------
    race : RollerRaceway
        Raceway and roller.
    gap : float
        Smallest gap h0 [m], positive.
    relative_permittivity : float
        Relative permittivity of the medium in the gap, dimensionless.
    obliquity : float
        End of the integral: where the normal of the raceway meets the roller at this angle from the normal of
        the roller [rad]. At 90 degrees it is tangent to the roller.

    Returns
    -------
    float
        Capacitance per length [F/m].

    Examples
    --------
    Ratio to eps0 pi sqrt(2 R/h0), the capacitance of a parabolic gap h0 + x^2/(2 R) without an end:

    >>> race = RollerRaceway(5.5e-3, 27.25e-3, outer=False)
    >>> reduced = 1.0 / (1.0 / 5.5e-3 + 1.0 / 27.25e-3)
    >>> parabolas = epsilon_0 * np.pi * np.sqrt(2.0 * reduced / 1e-6)
    >>> round(float(roller_capacitance(race, 1e-6) / parabolas), 3)
    0.987
    """
    pitch = race.pitch_radius(gap)
    # Azimuth at which the gap is twice the smallest one.
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

    The gap is that of touching circles, widened by the deflection under the Hertz pressure. At each end a
    constant is added, with which the gap continues the film.

    Parameters
    ----------
    race : RollerRaceway
        Raceway and roller.
    half_width : float
        Half-width b of the dry contact [m].
    domain : tuple of float
        Inlet and outlet of the film's domain, along the arc of the raceway from the contact [m]. The inlet is
        negative, and both lie outside the half-width.
    thickness : tuple of float
        Film thickness at inlet and outlet [m].
    relative_permittivity : float
        Relative permittivity of the medium in the gap, dimensionless.
    obliquity : float
        End of the integral, as in ``roller_capacitance`` [rad].

    Returns
    -------
    inlet, outlet : float
        Capacitance per length [F/m], each about 2 eps0 eps R/abs(x) with the reduced radius R. It is zero
        where the domain reaches beyond the end of the integral.

    Examples
    --------
    Ratio to 2 eps0 R/abs(x) for a domain of four half-widths on either side:

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
    """Gap of the dry contact less that of undeflected parabolas, up to a constant [m]."""
    return line_opening(x, half_width, reduced_radius(race.roller_radius, -1.0 / race.curvature))


def _charge(race: RollerRaceway, gap: Array, tilt: Array, weights: Array) -> float:
    """Integral of the charge density over the arc of the raceway, dimensionless."""
    density = charge_density(gap, tilt, 1.0 / race.roller_radius, race.curvature)
    return race.race_radius * float(np.vdot(weights, density))


def _distances(race: RollerRaceway, gap: float, phi: Array) -> tuple[Array, Array]:
    """Gap along the radius of the roller [m], and angle from it to the normal of the raceway [rad]."""
    pitch, near, q = race.pitch_radius(gap), race.roller_radius + gap, np.sin(0.5 * phi) ** 2
    further = 4.0 * race.race_radius * pitch * q
    beyond = further / (np.sqrt(near**2 + further) + near)
    along = near + (2.0 * pitch * q if race.outer else -2.0 * pitch * q)
    return gap + beyond, np.arctan2(pitch * np.sin(phi), along)


def _reach(race: RollerRaceway, gap: float, obliquity: float) -> float:
    """Azimuth at which the raceway's normal meets the roller at an angle to the roller's normal [rad]."""
    return float(np.arcsin(race.roller_radius * np.sin(obliquity) / race.pitch_radius(gap)))
