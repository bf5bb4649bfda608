"""Capacitance between a ball and the groove it runs in, outside the loaded film. SI units.

The raceway is a torus: a groove of radius r_g about a circle around the axis of the bearing, convex along
rolling at the inner ring and concave at the outer one. A point Q of it is told by its azimuth phi from the
ball and by its angle psi across the groove, from the bottom, positive towards the contact. With the ball's
centre O at the distance R_o from the axis, a gap h0 at the contact angle alpha, e = r_g - r - h0, u = psi -
alpha and the radius of the race at Q, R = R_o + s (r_g cos psi - e cos alpha), s = 1 at the outer ring and
-1 at the inner one,

    abs(Q - O)^2 = (r + h0)^2 + 4 r_g e sin^2(u/2) + 4 R R_o sin^2(phi/2),

without a difference of large numbers. The gap is measured from Q along the radius of the ball,
abs(Q - O) - r, and the charge on the raceway is that of ``thin_gap.charge_density``. It is summed across the
groove out to the shoulders, and along rolling as far as half of the ball faces the race: to where the race's
own normal only grazes the ball, and the tangent planes part by 90 degrees.

What is beyond is not in it: field lines from the lands beside the groove, from the race before and behind
the ball, which it shares with the next one, and those to cage and shields. Over an endless plane that would
be 30 % of the whole at h0/r = 1e-3; a groove closes around the ball, and leaves less.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.gaps.thin import charge_density, stretched
from ehlectric.errors import InputError, shown
from ehlectric.formulas.hertz_point import DryContact, point_deflection

# Nodes along rolling and across the groove; tests hold the integral they give to 1e-8.
_ALONG, _ACROSS = 40, 64

# In each of the parts around a film, where the gap is less steep and the deflection takes most of the time.
_ALONG_PART, _ACROSS_PART = 24, 32

# A half of the ball faces the race.
_HALF = 0.5 * np.pi

# How far the elastic deflection opens the gap of rigid bodies: (x, y) [m] -> [m].
Opening = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class Raceway:
    """The groove of one ring and the ball in it.

    Attributes
    ----------
    ball_radius, groove_radius : float
        r and r_g [m].
    pitch_radius : float
        R_o, from the axis of the bearing to the centre of the ball [m].
    shoulder_angle : float
        psi at which the groove ends, on both sides of its bottom [rad].
    contact_angle : float
        alpha, psi of the contact [rad].
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
        """The raceway of a bearing as catalogues describe it.

        Parameters
        ----------
        element_diameter, pitch_diameter : float
            D and that of the circle of the balls' centres [m].
        groove : float
            Groove radius over ball diameter, above 0.5.
        shoulder_height : float
            Depth of the groove at its shoulders, from its bottom, over the ball diameter.
        outer : bool
            Whether the ring is the outer one.
        contact_angle : float
            [rad], from the radial direction.

        Raises
        ------
        InputError
            If the groove does not go round the ball, has no such depth, or ends before the contact.

        Examples
        --------
        A groove of 0.52 D that is 0.2 D deep goes 52 degrees up on either side:

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
    """The bodies around a solved film: rigid but for the deflection under the Hertz pressure.

    Attributes
    ----------
    dry : DryContact
        The dry contact of the load.
    modulus : float
        E' [Pa], 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    offset : float
        The gap that the rigid bodies would have at the contact, about the film less the approach, mostly
        negative [m].
    mismatch : float
        Largest difference from the solved film over its edge, relative.
    """

    dry: DryContact
    modulus: float
    offset: float
    mismatch: float

    def opening(self, x: Array, y: Array) -> Array:
        """How far the deflection opens the gap [m]."""
        return point_deflection(x, y, self.dry, self.modulus)


def groove_gap(race: Raceway, gap: float, x: Array, y: Array) -> Array:
    """Distance of the rigid ball from points of its raceway, along the radius of the ball.

    Parameters
    ----------
    race : Raceway
        The groove and the ball.
    gap : float
        h0, of the rigid bodies at the contact [m]; the least where it is below r_g - r.
    x, y : ndarray, shapes that broadcast to (...)
        From the contact, along the race's arcs: with rolling and across the groove [m].

    Returns
    -------
    ndarray, shape (...)
        [m]; near the contact h0 + x^2/(2 Rx) + y^2/(2 Ry).

    Examples
    --------
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
        The groove and the ball.
    gap : float
        h0, at the contact angle [m], positive.
    relative_permittivity : float
        Of what fills the gap.
    obliquity : float
        How far along rolling: to where the race's normal meets the surface of the ball at this angle from
        its normal [rad]; 90 degrees where it grazes it.

    Returns
    -------
    float
        [F].

    Examples
    --------
    A 6208, 5 um, in oil, by how much the part beyond 45 degrees adds to it:

    >>> race = Raceway.of(11.906e-3, 60e-3, 0.52, 0.2, outer=False)
    >>> whole = groove_capacitance(race, 5e-6, 2.4)
    >>> middle = groove_capacitance(race, 5e-6, 2.4, obliquity=np.pi / 4)
    >>> round(whole * 1e12, 1), round(1.0 - middle / whole, 2)
    (15.3, 0.02)
    """
    steepness = abs(_offset_centre(race, gap)) * race.groove_radius / race.ball_radius
    # Where the gap is twice that at the contact.
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

    The gap is that of rigid bodies ``contact.offset`` apart, opened by the deflection under the Hertz
    pressure, exact for half-spaces. The film's pressure differs from Hertz's by a load that adds up to
    nothing, of which little is felt around the ellipse, and ``match_film`` takes what is left at the edge of
    the domain. The whole contact of ``examples/ball_bearing.toml``, inside and outside, changes by 0.1 %
    when the domain is cut from 1.75 to 1.4 semi-axes across, which moves 5 pF of 76 from one to the other.

    Parameters
    ----------
    race : Raceway
        The groove and the ball.
    contact : LoadedContact
        As ``match_film`` gives it.
    domain : tuple of float
        Inlet, outlet and side of the film's domain [m], inlet <= x <= outlet and abs(y) <= side; the inlet
        is negative, and the Hertz ellipse within.
    relative_permittivity : float
        Of what fills the gap.
    obliquity : float
        As in ``groove_capacitance`` [rad].

    Returns
    -------
    float
        [F].
    """
    inlet, outlet, side = domain
    edge = side / race.groove_radius

    def part(first: float, last: float, scale: float, start: float) -> float:
        angles, weights = _across(race, first, last, scale, _ACROSS_PART)
        starts = start / _race_radius(race, contact.offset, angles)
        along = _along(race, contact.offset, angles, starts, obliquity, contact.opening, _ALONG_PART)
        return float(np.vdot(weights, along))

    sides = 2.0 * (part(-np.inf, -edge, 0.5 * edge, 0.0) + part(edge, np.inf, 0.5 * edge, 0.0))
    tails = part(-edge, edge, edge, -inlet) + part(-edge, edge, edge, outlet)
    return epsilon_0 * relative_permittivity * (sides + tails)


def match_film(
    race: Raceway, dry: DryContact, modulus: float, *, x: Array, y: Array, thickness: Array
) -> LoadedContact:
    """The bodies outside a film, so that their gap continues it.

    The offset is that which takes the error of 1/h out of the sum over the edge. Where the film's parabolas
    and the true circles part, or its pressure and that of Hertz, not every point can be met: ``mismatch``
    says by how much.

    Parameters
    ----------
    race : Raceway
        The groove and the ball.
    dry : DryContact
        The dry contact of the load.
    modulus : float
        E' [Pa], 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    x, y, thickness : ndarray, shape (n,)
        Points of the edge of the film's domain, with x along entrainment, and the film there [m].

    Returns
    -------
    LoadedContact
        With the offset and the mismatch.
    """
    opened = point_deflection(x, y, dry, modulus)
    weights = thickness**-2.0 / np.sum(thickness**-2.0)
    offset = 0.0
    # The gap rises with the offset as the cosine of an angle that is small over the film's domain.
    for _ in range(12):
        missing = thickness - opened - groove_gap(race, offset, x, y)
        offset += float(weights @ missing)
    missing = thickness - opened - groove_gap(race, offset, x, y)
    return LoadedContact(dry, modulus, offset, float(np.max(np.abs(missing) / thickness)))


def _closed(x: Array, y: Array) -> Array:
    return np.zeros(np.broadcast(x, y).shape)


def _offset_centre(race: Raceway, gap: float) -> float:
    # e, from the centre of the ball to that of the groove.
    return race.groove_radius - race.ball_radius - gap


def _race_radius(race: Raceway, gap: float, psi: Array) -> Array:
    # R, from the axis of the bearing to the race.
    inwards = race.groove_radius * np.cos(psi) - _offset_centre(race, gap) * np.cos(race.contact_angle)
    radius: Array = race.pitch_radius + (inwards if race.outer else -inwards)
    return radius


def _distances(race: Raceway, gap: float, psi: Array, phi: Array) -> tuple[Array, Array]:
    """The gap along the radius of the ball [m], and the angle of that radius to the normal of the race."""
    e, pitch, s = _offset_centre(race, gap), race.pitch_radius, 1.0 if race.outer else -1.0
    u, q = psi - race.contact_angle, np.sin(0.5 * phi) ** 2
    near = race.ball_radius + gap
    across = 4.0 * race.groove_radius * e * np.sin(0.5 * u) ** 2
    further = across + 4.0 * _race_radius(race, gap, psi) * pitch * q
    beyond = further / (np.sqrt(near**2 + further) + near)
    # Of Q - O the part along the normal and that across it.
    along = race.groove_radius - e * np.cos(u) + 2.0 * s * np.cos(psi) * pitch * q
    flat, linear, square = _sideways(race, gap, psi)
    sideways = np.sqrt(np.maximum(0.0, flat + (linear - square * q) * q))
    return gap + beyond, np.arctan2(sideways, along)


def _sideways(race: Raceway, gap: float, psi: Array) -> tuple[Array, Array, Array]:
    # The square of the distance of O from the normal of the race at Q is flat + linear q - square q^2,
    # q = sin^2(phi/2).
    e, pitch, s = _offset_centre(race, gap), race.pitch_radius, 1.0 if race.outer else -1.0
    aside = e * np.sin(psi - race.contact_angle)
    return aside**2, 4.0 * pitch * (pitch - s * np.sin(psi) * aside), (2.0 * pitch * np.cos(psi)) ** 2


def _reach(race: Raceway, gap: float, psi: Array, obliquity: float) -> Array:
    """Azimuth at which the normal of the race meets the ball at this angle from its normal [rad]."""
    flat, linear, square = _sideways(race, gap, psi)
    left = np.maximum(0.0, (race.ball_radius * np.sin(obliquity)) ** 2 - flat)
    q = 2.0 * left / (linear + np.sqrt(linear**2 - 4.0 * square * left))
    reach: Array = 2.0 * np.arcsin(np.sqrt(q))
    return reach


def _across(race: Raceway, first: float, last: float, scale: float, nodes: int) -> tuple[Array, Array]:
    """Angles psi and weights between two angles from the contact, as far as the groove goes."""
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
    """Integral of the charge density over one side of the race, from an azimuth on, by angle psi [m]."""
    radius, y = _race_radius(race, gap, psi), race.groove_radius * (psi - race.contact_angle)
    middle = _distances(race, gap, psi, np.zeros_like(psi))[0] + opening(np.zeros_like(y), y)
    # Where the gap is twice that at the middle, or of a tail where it starts.
    scale = np.sqrt(2.0 * race.ball_radius * np.abs(middle) / (radius * race.pitch_radius))
    scale = np.where(start > 0.0, start, scale)
    end = _reach(race, gap, psi, obliquity)
    phi, weights = stretched(np.minimum(start, end), end, scale, nodes)
    psi, radius, y = psi[:, np.newaxis], radius[:, np.newaxis], y[:, np.newaxis]
    distance, tilt = _distances(race, gap, psi, phi)
    curvature = np.cos(psi) / radius * (1.0 if race.outer else -1.0) + 1.0 / race.groove_radius
    density = charge_density(distance + opening(radius * phi, y), tilt, 2.0 / race.ball_radius, curvature)
    return np.asarray(race.groove_radius * radius[:, 0] * np.sum(density * weights, axis=1), dtype=float)
