"""Capacitance between a ball and the groove of its raceway, outside the loaded film. SI units.

The raceway is a torus: a groove of radius r_g about a circle around the bearing axis. Along rolling it is
convex at the inner ring and concave at the outer ring. A point Q on it has the azimuth phi from the ball, and
the angle psi across the groove, from its bottom and positive towards the contact. The ball's centre O is at
the distance R_o from the axis, and the gap at the contact angle alpha is h0. With e = r_g - r - h0,
u = psi - alpha and the radius of the raceway at Q, R = R_o + s (r_g cos psi - e cos alpha), where s is 1 at
the outer ring and -1 at the inner ring,

    abs(Q - O)^2 = (r + h0)^2 + 4 r_g e sin^2(u/2) + 4 R R_o sin^2(phi/2).

This form avoids differences of large numbers. The gap at Q is measured along the radius of the ball,
abs(Q - O) - r. ``ehlectric.formulas.thin_gap.charge_density`` gives the charge on the raceway. It is
integrated across the groove from shoulder to shoulder. Along rolling, it is integrated over the part that
half of the ball faces: to where the normal of the raceway is tangent to the ball.

The model neglects the field lines from the lands beside the groove, from the raceway between two balls, and
from the ball to cage and shields. For a ball over an infinite plane, the neglected part would be 30 % of the
total at h0/r = 1e-3. It is less in a groove, which partly encloses the ball.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown
from ehlectric.formulas.hertz_point import DryContact, point_deflection
from ehlectric.formulas.thin_gap import charge_density, matched_offset, stretched

# Quadrature nodes along rolling and across the groove; tests check that the integral is accurate to 1e-8.
_ALONG, _ACROSS = 40, 64

# Quadrature nodes of each part around a film. There the gap changes less, so fewer nodes suffice, and the
# deflection at the nodes takes most of the computing time.
_ALONG_PART, _ACROSS_PART = 24, 32

# Angle between the normals of ball and raceway where the half of the ball that faces the raceway ends [rad].
_HALF = 0.5 * np.pi

# Elastic deflection that widens the gap between rigid bodies [m], as a function of the position (x, y) [m].
Opening = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class Raceway:
    """Groove of one ring, and the ball in it.

    Attributes
    ----------
    ball_radius, groove_radius : float
        Radius r of the ball and r_g of the groove [m].
    pitch_radius : float
        Distance R_o from the axis of the bearing to the centre of the ball [m].
    shoulder_angle : float
        Angle psi at which the groove ends, on both sides of its bottom [rad].
    contact_angle : float
        Angle psi of the contact, alpha [rad].
    outer : bool
        Whether the ring is the outer one.
    """

    ball_radius: float
    groove_radius: float
    pitch_radius: float
    shoulder_angle: float
    contact_angle: float
    outer: bool

    @classmethod
    def of(
        cls,
        element_diameter: float,
        pitch_diameter: float,
        groove: float,
        shoulder_height: float,
        *,
        outer: bool,
        contact_angle: float = 0.0,
    ) -> Raceway:
        """Raceway of a bearing from the dimensions that catalogues state.

        Parameters
        ----------
        element_diameter, pitch_diameter : float
            Diameter D of the balls, and diameter of the circle of their centres [m].
        groove : float
            Osculation: radius of the groove over the diameter of the ball, above 0.5.
        shoulder_height : float
            Height of the shoulders above the bottom of the groove over the diameter of the ball.
        outer : bool
            Whether the ring is the outer one.
        contact_angle : float
            Contact angle from the radial direction [rad].

        Raises
        ------
        InputError
            Where the groove radius is too small, the shoulder height is out of range, or the groove ends
            before the contact.

        Examples
        --------
        A groove with a radius of 0.52 D and a depth of 0.2 D reaches 52 degrees up on either side:

        >>> race = Raceway.of(11.906e-3, 60e-3, 0.52, 0.2, outer=True)
        >>> round(float(np.degrees(race.shoulder_angle)), 1)
        52.0
        """
        if groove <= 0.5:
            raise InputError("groove radius over ball diameter", f"must be above 0.5; got {shown(groove)}")
        if not 0.0 < shoulder_height <= groove:
            raise InputError(
                "shoulder_height",
                f"must be above 0 and at most the groove radius over the ball diameter, {groove:g}; "
                f"got {shown(shoulder_height)}",
            )
        shoulder = float(np.arccos(1.0 - shoulder_height / groove))
        if abs(contact_angle) >= shoulder:
            raise InputError(
                "contact_angle",
                f"must be below {np.degrees(shoulder):.1f} degrees, where a groove of shoulder_height "
                f"{shoulder_height:g} ends; got {np.degrees(contact_angle):.1f} degrees",
            )
        radius = 0.5 * element_diameter
        return cls(
            radius, groove * element_diameter, 0.5 * pitch_diameter, shoulder, float(contact_angle), outer
        )


@dataclass(frozen=True)
class LoadedContact:
    """Bodies around a solved film, deflected by the Hertz pressure and otherwise rigid.

    Attributes
    ----------
    dry : DryContact
        Dry contact under the same load.
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    offset : float
        Gap that the undeflected bodies would have at the contact [m]. It is about the film thickness less the
        elastic approach, and mostly negative.
    mismatch : float
        Largest relative difference from the solved film thickness along the edge of the film's domain.
    """

    dry: DryContact
    modulus: float
    offset: float
    mismatch: float

    def opening(self, x: Array, y: Array) -> Array:
        """Deflection that widens the gap at positions x and y from the contact [m]."""
        return point_deflection(x, y, self.dry, self.modulus)


def groove_gap(race: Raceway, gap: float, x: Array, y: Array) -> Array:
    """Gap between a rigid ball and points on its raceway, along the radius of the ball.

    Parameters
    ----------
    race : Raceway
        Groove and ball.
    gap : float
        Gap h0 of the rigid bodies at the contact [m]. It is the smallest gap if it is below r_g - r.
    x, y : ndarray, shapes that broadcast to (...)
        Distance from the contact along the arcs of the raceway: along rolling and across the groove [m].

    Returns
    -------
    ndarray, shape (...)
        Gap [m]; close to the contact it is h0 + x^2/(2 Rx) + y^2/(2 Ry).

    Examples
    --------
    Gap at the contact and 0.1 mm along rolling, in micrometres:

    >>> race = Raceway.of(12e-3, 60e-3, 0.52, 0.2, outer=False)
    >>> x = np.array([0.0, 1e-4])
    >>> print(np.round(groove_gap(race, 1e-6, x, np.zeros(2)) * 1e6, 3))
    [1.    2.041]
    """
    psi = race.contact_angle + y / race.groove_radius
    return _distances(race, gap, psi, x / _race_radius(race, gap, psi))[0]


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
    steepness = abs(_offset_centre(race, gap)) * race.groove_radius / race.ball_radius
    # Angle from the contact at which the gap is twice as large.
    scale = np.sqrt(2.0 * gap / max(steepness, 2.0 * gap))
    angles, weights = _across(race, -np.inf, np.inf, scale, _ACROSS)
    along = _along(race, gap, angles, np.zeros(_ACROSS), obliquity, _closed, _ALONG)
    return float(2.0 * epsilon_0 * relative_permittivity * np.vdot(weights, along))


def outside_capacitance(
    race: Raceway,
    contact: LoadedContact,
    domain: tuple[float, float, float],
    relative_permittivity: float = 1.0,
    *,
    obliquity: float = _HALF,
) -> float:
    """Capacitance between a loaded ball and its raceway outside the domain of the solved film.

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
    domain : tuple of float
        Inlet, outlet and side of the film's domain, inlet <= x <= outlet and abs(y) <= side [m]. The inlet
        is negative, and the domain contains the Hertz ellipse.
    relative_permittivity : float
        Relative permittivity of the medium in the gap, dimensionless.
    obliquity : float
        End of the integral along rolling, as in ``groove_capacitance`` [rad].

    Returns
    -------
    float
        Capacitance [F].
    """
    inlet, outlet, side = domain
    edge = side / race.groove_radius

    # First and last angle from the contact, scale, beginning of the integral along rolling [m], and number of
    # equal parts: inlet and outlet are alike on both sides, and each tail is beyond one of them.
    parts = (
        (-np.inf, -edge, 0.5 * edge, 0.0, 2.0),
        (edge, np.inf, 0.5 * edge, 0.0, 2.0),
        (-edge, edge, edge, -inlet, 1.0),
        (-edge, edge, edge, outlet, 1.0),
    )
    nodes = [_across(race, first, last, scale, _ACROSS_PART) for first, last, scale, _, _ in parts]
    angles = np.concatenate([psi for psi, _ in nodes])
    weights = np.concatenate([part[-1] * across for part, (_, across) in zip(parts, nodes, strict=True)])
    starts = np.repeat([part[3] for part in parts], _ACROSS_PART) / _race_radius(race, contact.offset, angles)
    along = _along(race, contact.offset, angles, starts, obliquity, contact.opening, _ALONG_PART)
    return float(epsilon_0 * relative_permittivity * np.vdot(weights, along))


def match_film(
    race: Raceway, dry: DryContact, modulus: float, *, x: Array, y: Array, thickness: Array
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
        Dry contact under the same load.
    modulus : float
        Reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    x, y, thickness : ndarray, shape (n,)
        Points on the edge of the film's domain, with x along entrainment, and the film thickness there [m].

    Returns
    -------
    LoadedContact
        Bodies around the film, with offset and mismatch.
    """
    opened = point_deflection(x, y, dry, modulus)

    def missing(offset: float) -> Array:
        return thickness - opened - groove_gap(race, offset, x, y)

    offset, mismatch = matched_offset(missing, thickness)
    return LoadedContact(dry, modulus, offset, mismatch)


def _closed(x: Array, y: Array) -> Array:
    return np.zeros(np.broadcast(x, y).shape)


def _offset_centre(race: Raceway, gap: float) -> float:
    """Distance e from the centre of the ball to the centre of the groove [m]."""
    return race.groove_radius - race.ball_radius - gap


def _race_radius(race: Raceway, gap: float, psi: Array) -> Array:
    """Radius R of the raceway about the axis of the bearing, at the angle psi [m]."""
    inwards = race.groove_radius * np.cos(psi) - _offset_centre(race, gap) * np.cos(race.contact_angle)
    radius: Array = race.pitch_radius + (inwards if race.outer else -inwards)
    return radius


def _distances(race: Raceway, gap: float, psi: Array, phi: Array) -> tuple[Array, Array]:
    """Gap along the radius of the ball [m], and angle from this radius to the normal of the raceway [rad]."""
    e, pitch, s = _offset_centre(race, gap), race.pitch_radius, 1.0 if race.outer else -1.0
    u, q = psi - race.contact_angle, np.sin(0.5 * phi) ** 2
    near = race.ball_radius + gap
    across = 4.0 * race.groove_radius * e * np.sin(0.5 * u) ** 2
    further = across + 4.0 * _race_radius(race, gap, psi) * pitch * q
    beyond = further / (np.sqrt(near**2 + further) + near)
    # Components of Q - O along the normal of the raceway and perpendicular to it.
    along = race.groove_radius - e * np.cos(u) + 2.0 * s * np.cos(psi) * pitch * q
    flat, linear, square = _sideways(race, gap, psi)
    sideways = np.sqrt(np.maximum(0.0, flat + (linear - square * q) * q))
    return gap + beyond, np.arctan2(sideways, along)


def _sideways(race: Raceway, gap: float, psi: Array) -> tuple[Array, Array, Array]:
    """Coefficients of the squared distance of O from the normal of the raceway at Q.

    It is flat + linear q - square q^2, with q = sin^2(phi/2) [m^2].
    """
    e, pitch, s = _offset_centre(race, gap), race.pitch_radius, 1.0 if race.outer else -1.0
    aside = e * np.sin(psi - race.contact_angle)
    return aside**2, 4.0 * pitch * (pitch - s * np.sin(psi) * aside), (2.0 * pitch * np.cos(psi)) ** 2


def _reach(race: Raceway, gap: float, psi: Array, obliquity: float) -> Array:
    """Azimuth at which the raceway's normal meets the ball at an angle to the ball's normal [rad]."""
    flat, linear, square = _sideways(race, gap, psi)
    left = np.maximum(0.0, (race.ball_radius * np.sin(obliquity)) ** 2 - flat)
    q = 2.0 * left / (linear + np.sqrt(linear**2 - 4.0 * square * left))
    reach: Array = 2.0 * np.arcsin(np.sqrt(q))
    return reach


def _across(race: Raceway, first: float, last: float, scale: float, nodes: int) -> tuple[Array, Array]:
    """Nodes psi [rad] and weights between two angles from the contact, as far as both are in the groove."""
    ends = np.clip([first, last], *(np.array([-1.0, 1.0]) * race.shoulder_angle - race.contact_angle))
    u, weights = stretched(ends[0], ends[1], scale, nodes)
    return race.contact_angle + u, weights


def _along(
    race: Raceway,
    gap: float,
    psi: Array,
    start: Array,
    obliquity: float,
    opening: Opening,
    nodes: int,
) -> Array:
    """Integral of the charge density along one side of the raceway, from an azimuth on, for each psi [m]."""
    radius, y = _race_radius(race, gap, psi), race.groove_radius * (psi - race.contact_angle)
    middle = _distances(race, gap, psi, np.zeros_like(psi))[0] + opening(np.zeros_like(y), y)
    # Azimuth at which the gap is twice that in the middle; for a tail, the azimuth at which it starts.
    scale = np.sqrt(2.0 * race.ball_radius * np.abs(middle) / (radius * race.pitch_radius))
    scale = np.where(start > 0.0, start, scale)
    end = _reach(race, gap, psi, obliquity)
    phi, weights = stretched(np.minimum(start, end), end, scale, nodes)
    psi, radius, y = psi[:, np.newaxis], radius[:, np.newaxis], y[:, np.newaxis]
    distance, tilt = _distances(race, gap, psi, phi)
    curvature = np.cos(psi) / radius * (1.0 if race.outer else -1.0) + 1.0 / race.groove_radius
    density = charge_density(distance + opening(radius * phi, y), tilt, 2.0 / race.ball_radius, curvature)
    return np.asarray(race.groove_radius * radius[:, 0] * np.sum(density * weights, axis=1), dtype=float)
