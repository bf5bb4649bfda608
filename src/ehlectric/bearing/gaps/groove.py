"""Capacitance between a ball and the groove of its raceway, outside the loaded film. SI units.

The gap between rigid bodies is that of ``ehlectric.bearing.gaps.raceway``.
``ehlectric.formulas.thin_gap.charge_density`` gives the charge on the raceway. It is integrated across the
groove from shoulder to shoulder. Along rolling, it is integrated over the part that half of the ball faces:
to where the normal of the raceway is tangent to the ball.

The model neglects the field lines from the lands beside the groove, from the raceway between two balls, and
from the ball to cage and shields. For a ball over an infinite plane, the neglected part would be 30 % of the
total at h0/r = 1e-3. It is less in a groove, which partly encloses the ball.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple, dataclass
from typing import Any

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.gaps.raceway import (
    Raceway,
    distance_at,
    groove_gap,
    offset_centre,
    race_radius,
    reach,
    tilt_at,
)
from ehlectric.formulas.hertz_point import DryContact, point_deflection
from ehlectric.formulas.thin_gap import charge_density, matched_offset, stretched

# Quadrature nodes along rolling and across the groove; tests check that the integral is accurate to 1e-8.
_ALONG, _ACROSS = 40, 64

# Quadrature nodes along rolling and across the groove of each part around a film: beside it, ahead of it, and
# behind it. The deflection at the nodes takes most of the computing time; the gap changes fastest behind a
# film, which ends close to the Hertz ellipse. The error of each part is below 1e-8 of the whole.
_BESIDE, _AHEAD, _BEHIND = (12, 20), (12, 14), (20, 32)

# Angle between the normals of ball and raceway where the half of the ball that faces the raceway ends [rad].
_HALF = 0.5 * np.pi

# Elastic deflection that widens the gap between rigid bodies [m], as a function of the position (x, y) [m].
Opening = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class LoadedContact:
    """Bodies around a solved film, deflected by the Hertz pressure and otherwise rigid.

    Contacts of several loads are held together: all values but the modulus are arrays of shape (...) then.

    Attributes
    ----------
    dry : DryContact
        Dry contact under the same load.
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    offset : float or ndarray
        Gap that the undeflected bodies would have at the contact [m]. It is about the film thickness less the
        elastic approach, and mostly negative.
    mismatch : float or ndarray
        Largest relative difference from the solved film thickness along the edge of the film's domain.
    """

    dry: DryContact
    modulus: float
    offset: float | Array
    mismatch: float | Array

    def opening(self, x: Array, y: Array) -> Array:
        """Deflection that widens the gap at positions x and y from the contact [m], shapes (..., m, n)."""
        return point_deflection(x, y, _spread(self.dry, 2), self.modulus)


def groove_capacitance(
    race: Raceway, gap: float, relative_permittivity: float = 1.0, *, obliquity: float = _HALF
) -> float:
    """Capacitance between an unloaded, rigid ball and its raceway.

    Parameters
    ----------
    race : Raceway
        Groove and ball.
    gap : float
        Gap h0 at the contact angle [m], positive.
    relative_permittivity : float
        Relative permittivity of the medium in the gap, dimensionless.
    obliquity : float
        End of the integral along rolling: where the normal of the raceway meets the ball at this angle from
        the normal of the ball [rad]. At 90 degrees it is tangent to the ball.

    Returns
    -------
    float
        Capacitance [F].

    Examples
    --------
    Capacitance of a 6208 with a gap of 5 um in oil, in pF, and the share of the part beyond 45 degrees:

    >>> race = Raceway.of(11.906e-3, 60e-3, 0.52, 0.2, outer=False)
    >>> whole = groove_capacitance(race, 5e-6, 2.4)
    >>> middle = groove_capacitance(race, 5e-6, 2.4, obliquity=np.pi / 4)
    >>> round(whole * 1e12, 1), round(1.0 - middle / whole, 2)
    (15.3, 0.02)
    """
    steepness = abs(offset_centre(race, gap)) * race.groove_radius / race.ball_radius
    # Angle from the contact at which the gap is twice as large.
    scale = np.sqrt(2.0 * gap / max(steepness, 2.0 * gap))
    angles, weights = _across(race, -np.inf, np.inf, scale, _ACROSS)
    along = _along(race, gap, angles, np.zeros(_ACROSS), obliquity, _closed, _ALONG)
    return float(2.0 * epsilon_0 * relative_permittivity * np.vdot(weights, along))


def outside_capacitance(
    race: Raceway,
    contact: LoadedContact,
    domain: tuple[float | Array, float | Array, float | Array],
    relative_permittivity: float = 1.0,
    *,
    obliquity: float = _HALF,
) -> Array:
    """Capacitance between a loaded ball and its raceway outside the domain of the solved film.

    Contacts of several loads are integrated together.

    The gap is that of rigid bodies with the gap ``contact.offset``, widened by the deflection under the Hertz
    pressure. This deflection is exact for half-spaces. Film pressure and Hertz pressure carry the same load,
    so their difference deflects the bodies little around the ellipse; ``match_film`` compensates for it at
    the edge of the domain. In ``examples/ball_bearing.toml`` the capacitance of the whole contact changes by
    0.1 % when the domain is cut from 1.75 to 1.4 semi-axes across. This moves 5 pF of 76 pF to the outside.

    Parameters
    ----------
    race : Raceway
        Groove and ball.
    contact : LoadedContact
        Bodies around the film, from ``match_film``.
    domain : tuple of float or ndarray, shape (...)
        Inlet, outlet and side of the film's domain, inlet <= x <= outlet and abs(y) <= side [m]. The inlet
        is negative, and the domain contains the Hertz ellipse.
    relative_permittivity : float
        Relative permittivity of the medium in the gap, dimensionless.
    obliquity : float
        End of the integral along rolling, as in ``groove_capacitance`` [rad].

    Returns
    -------
    ndarray, shape (...)
        Capacitance [F].
    """
    inlet, outlet, side = domain
    edge = side / race.groove_radius

    # First and last angle from the contact, scale, beginning of the integral along rolling [m], number of
    # equal parts, and nodes: inlet and outlet are alike on both sides, and each tail is beyond one of them.
    parts = (
        (-np.inf, -edge, 0.5 * edge, 0.0, 2.0, _BESIDE),
        (edge, np.inf, 0.5 * edge, 0.0, 2.0, _BESIDE),
        (-edge, edge, edge, -inlet, 1.0, _AHEAD),
        (-edge, edge, edge, outlet, 1.0, _BEHIND),
    )
    total, offset = np.zeros(np.shape(contact.offset)), _beside(contact.offset)
    for first, last, scale, begins, number, (along, across) in parts:
        angles, weights = _across(race, first, last, scale, across)
        starts = _beside(begins) / race_radius(race, offset, angles)
        charges = _along(race, contact.offset, angles, starts, obliquity, contact.opening, along)
        total = total + number * np.sum(weights * charges, axis=-1)
    return epsilon_0 * relative_permittivity * total


def match_film(
    race: Raceway,
    dry: DryContact,
    modulus: float,
    *,
    x: Array,
    y: Array,
    thickness: Array,
    opened: Array | None = None,
) -> LoadedContact:
    """Bodies around a film, with the offset at which their gap continues the film.

    With this offset the error of 1/h adds up to zero over the edge of the film's domain. The gap does not fit
    at every point, because the film has parabolas instead of circles, and another pressure than Hertz's. The
    largest difference is ``mismatch``.

    Parameters
    ----------
    race : Raceway
        Groove and ball.
    dry : DryContact
        Dry contact under the same load; arrays of shape (...) for several loads.
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    x, y, thickness : ndarray, shape (..., n)
        Points on the edge of the film's domain, with x along entrainment, and the film thickness there [m].
    opened : ndarray, shape (..., n), optional
        Deflection at the points, where it is known [m].

    Returns
    -------
    LoadedContact
        Bodies around the film, with offset and mismatch.
    """
    if opened is None:
        opened = point_deflection(x, y, _spread(dry, 1), modulus)
    undeflected = thickness - opened

    def missing(offset: Array) -> Array:
        return undeflected - groove_gap(race, offset, x, y)

    offset, mismatch = matched_offset(missing, thickness)
    return LoadedContact(dry, modulus, offset, mismatch)


def _closed(x: Array, y: Array) -> Array:
    return np.zeros(np.broadcast(x, y).shape)


def _spread(dry: DryContact, axes: int) -> DryContact:
    """Dry contacts with further axes for their nodes."""
    values: list[Any] = [_beside(values, axes) for values in astuple(dry)]
    return DryContact(*values)


def _beside(values: float | Array, axes: int = 1) -> Array:
    """Values of contacts with further axes for their nodes."""
    found: Array = np.asarray(values)[(..., *[np.newaxis] * axes)]
    return found


def _across(
    race: Raceway, first: float | Array, last: float | Array, scale: float | Array, nodes: int
) -> tuple[Array, Array]:
    """Nodes psi [rad] and weights between two angles from the contact, as far as both are in the groove."""
    low, high = (sign * race.shoulder_angle - race.contact_angle for sign in (-1.0, 1.0))
    ends = (np.clip(np.asarray(end, dtype=float), low, high) for end in (first, last))
    u, weights = stretched(next(ends), next(ends), scale, nodes)
    return race.contact_angle + u, weights


def _along(
    race: Raceway,
    gap: float | Array,
    psi: Array,
    start: Array,
    obliquity: float,
    opening: Opening,
    nodes: int,
) -> Array:
    """Integral of the charge density along one side of the raceway, from an azimuth on, for each psi [m]."""
    gap, psi, start = _beside(gap, 2), psi[..., np.newaxis], start[..., np.newaxis]
    radius, y = race_radius(race, gap, psi), race.groove_radius * (psi - race.contact_angle)
    middle = distance_at(race, gap, psi, np.zeros_like(psi)) + opening(np.zeros_like(y), y)
    # Azimuth at which the gap is twice that in the middle; for a tail, the azimuth at which it starts.
    scale = np.sqrt(2.0 * race.ball_radius * np.abs(middle) / (radius * race.pitch_radius))
    scale = np.where(start > 0.0, start, scale)
    last = reach(race, gap, psi, obliquity)
    phi, weights = (values[..., 0, :] for values in stretched(np.minimum(start, last), last, scale, nodes))
    q = np.sin(0.5 * phi) ** 2
    distance, tilt = distance_at(race, gap, psi, q), tilt_at(race, gap, psi, q)
    curvature = np.cos(psi) / radius * (1.0 if race.outer else -1.0) + 1.0 / race.groove_radius
    density = charge_density(distance + opening(radius * phi, y), tilt, 2.0 / race.ball_radius, curvature)
    charge: Array = race.groove_radius * radius[..., 0] * np.sum(density * weights, axis=-1)
    return charge
