"""Capacitance of the gaps around the loaded contacts, from the geometry of element and raceway. SI units.

The raceway of a ball is a torus: a groove of radius r_g about a circle around the bearing axis. Along rolling
it is convex at the inner ring and concave at the outer ring. A point Q on it has the azimuth phi from the
ball, and the angle psi across the groove, from its bottom and positive towards the contact. The ball's centre
O is at the distance R_o from the axis, and the gap at the contact angle alpha is h0. With e = r_g - r - h0,
u = psi - alpha and the radius of the raceway at Q, R = R_o + s (r_g cos psi - e cos alpha), where s is 1 at
the outer ring and -1 at the inner ring,

    abs(Q - O)^2 = (r + h0)^2 + 4 r_g e sin^2(u/2) + 4 R R_o sin^2(phi/2).

A roller and its raceway are circles. R is the radius of the raceway, r that of the roller, and h0 the
smallest gap. The roller's centre O is at R_o = R + r + h0 from the bearing axis at the inner ring, and at
R_o = R - r - h0 at the outer ring. For a point Q on the raceway at the azimuth phi

    abs(Q - O)^2 = (r + h0)^2 + 4 R R_o sin^2(phi/2).

Both forms avoid differences of large numbers. The gap at Q is measured along the radius of the element:
abs(Q - O) - r. ``formulas.capacitances.charge_density`` gives the charge on the raceway. It is integrated
along rolling over the part that half of the element faces: to where the normal of the raceway is tangent to
the element; and across a groove from shoulder to shoulder.

The model neglects the field lines from the lands beside the groove, from the raceway between two elements,
around the ends of a roller, and to cage and shields. For a ball over an infinite plane, the neglected part
would be 30 % of the total at h0/r = 1e-3. It is less in a groove, which partly encloses the ball.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple, dataclass
from typing import Any

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown
from ehlectric.formulas.capacitances import charge_density, matched_offset, stretched
from ehlectric.formulas.hertz import DryContact, line_opening, point_deflection, reduced_radius


@dataclass(frozen=True)
class Raceway:
    """Groove of one ring, and the ball in it."""

    # ball_radius and groove_radius: radius r of the ball and r_g of the groove [m].
    ball_radius: float
    groove_radius: float
    pitch_radius: float  # distance R_o from the axis of the bearing to the centre of the ball [m]
    shoulder_angle: float  # angle psi at which the groove ends, on both sides of its bottom [rad]
    contact_angle: float  # angle psi of the contact, alpha [rad]
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

        ``element_diameter`` and ``pitch_diameter``, diameter D of the balls, and diameter of the circle of
        their centres [m]; ``contact_angle``, contact angle from the radial direction [rad]. Raises InputError
        where the groove radius is too small, the shoulder height is out of range, or the groove ends before
        the contact.

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


def groove_gap(race: Raceway, gap: float | Array, x: Array, y: Array) -> Array:
    """Gap between a rigid ball and points on its raceway, along the radius of the ball.

    ``gap``, gap h0 of the rigid bodies at the contact [m]; ``x`` and ``y``, distance from the contact along
    the arcs of the raceway: along rolling and across the groove [m]. Returns gap [m]; close to the contact it
    is h0 + x^2/(2 Rx) + y^2/(2 Ry), shape (...).

    Examples
    --------
    Gap at the contact and 0.1 mm along rolling, in micrometres:

    >>> race = Raceway.of(12e-3, 60e-3, 0.52, 0.2, outer=False)
    >>> x = np.array([0.0, 1e-4])
    >>> print(np.round(groove_gap(race, 1e-6, x, np.zeros(2)) * 1e6, 3))
    [1.    2.041]
    """
    psi = race.contact_angle + y / race.groove_radius
    return distance_at(race, gap, psi, np.sin(0.5 * x / race_radius(race, gap, psi)) ** 2)


def offset_centre(race: Raceway, gap: float | Array) -> Any:
    """Distance e from the centre of the ball to the centre of the groove [m]."""
    return race.groove_radius - race.ball_radius - gap


def race_radius(race: Raceway, gap: float | Array, psi: Array) -> Array:
    """Radius R of the raceway about the axis of the bearing, at the angle psi [m]."""
    inwards = race.groove_radius * np.cos(psi) - offset_centre(race, gap) * np.cos(race.contact_angle)
    radius: Array = race.pitch_radius + (inwards if race.outer else -inwards)
    return radius


def distance_at(race: Raceway, gap: float | Array, psi: Array, q: Array) -> Array:
    """Gap along the radius of the ball [m] at psi [rad] and q = sin^2(phi/2)."""
    near, u = race.ball_radius + gap, psi - race.contact_angle
    across = 4.0 * race.groove_radius * offset_centre(race, gap) * np.sin(0.5 * u) ** 2
    further = across + 4.0 * race_radius(race, gap, psi) * race.pitch_radius * q
    distance: Array = gap + further / (np.sqrt(near**2 + further) + near)
    return distance


def tilt_at(race: Raceway, gap: float | Array, psi: Array, q: Array) -> Array:
    """Angle from the ball's radius to the raceway's normal [rad] at psi [rad] and q = sin^2(phi/2)."""
    e, s = offset_centre(race, gap), 1.0 if race.outer else -1.0
    # Components of Q - O along the normal of the raceway and perpendicular to it.
    flat, linear, square = _sideways(race, gap, psi)
    along = race.groove_radius - e * np.cos(psi - race.contact_angle)
    sideways = np.sqrt(np.maximum(0.0, flat + (linear - square * q) * q))
    tilt: Array = np.arctan2(sideways, along + 2.0 * s * np.cos(psi) * race.pitch_radius * q)
    return tilt


def _sideways(race: Raceway, gap: float | Array, psi: Array) -> tuple[Array, Array, Array]:
    """Coefficients of the squared distance of O from the normal of the raceway at Q.

    It is flat + linear q - square q^2, with q = sin^2(phi/2) [m^2].
    """
    e, pitch, s = offset_centre(race, gap), race.pitch_radius, 1.0 if race.outer else -1.0
    aside = e * np.sin(psi - race.contact_angle)
    return aside**2, 4.0 * pitch * (pitch - s * np.sin(psi) * aside), (2.0 * pitch * np.cos(psi)) ** 2


def reach(race: Raceway, gap: float | Array, psi: Array, obliquity: float) -> Array:
    """Azimuth at which the raceway's normal meets the ball at an angle to the ball's normal [rad]."""
    flat, linear, square = _sideways(race, gap, psi)
    left = np.maximum(0.0, (race.ball_radius * np.sin(obliquity)) ** 2 - flat)
    q = 2.0 * left / (linear + np.sqrt(linear**2 - 4.0 * square * left))
    reach: Array = 2.0 * np.arcsin(np.sqrt(q))
    return reach


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
    """

    dry: DryContact  # dry contact under the same load
    modulus: float  # reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
    # Gap that the undeflected bodies would have at the contact [m]. It is about the film thickness less the
    # elastic approach, and mostly negative.
    offset: float | Array
    # Largest relative difference from the solved film thickness along the edge of the film's domain.
    mismatch: float | Array

    def opening(self, x: Array, y: Array) -> Array:
        """Deflection that widens the gap at positions x and y from the contact [m], shapes (..., m, n)."""
        return point_deflection(x, y, _spread(self.dry, 2), self.modulus)


def groove_capacitance(
    race: Raceway, gap: float, relative_permittivity: float = 1.0, *, obliquity: float = _HALF
) -> float:
    """Capacitance between an unloaded, rigid ball and its raceway.

    ``gap``, gap h0 at the contact angle [m], positive; ``relative_permittivity``, relative permittivity of
    the medium in the gap, dimensionless; ``obliquity``, end of the integral along rolling: where the normal
    of the raceway meets the ball at this angle from the normal of the ball [rad]. Returns capacitance [F].

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

    ``domain``, inlet, outlet and side of the film's domain, inlet <= x <= outlet and abs(y) <= side [m],
    shape (...); ``relative_permittivity``, relative permittivity of the medium in the gap, dimensionless;
    ``obliquity``, end of the integral along rolling, as in ``groove_capacitance`` [rad]. Returns capacitance
    [F], shape (...).
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

    ``dry``, dry contact under the same load; arrays of shape (...) for several loads; ``modulus``, reduced
    modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; ``x``, ``y`` and ``thickness``, points on
    the edge of the film's domain, with x along entrainment, and the film thickness there [m], shape (..., n);
    ``opened``, deflection at the points, where it is known [m], shape (..., n).
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


# Quadrature nodes on each side of the contact; tests check that the integral is accurate to 1e-8.
_NODES = 48


@dataclass(frozen=True)
class RollerRaceway:
    """Raceway of one ring, and the roller on it."""

    # roller_radius and race_radius: radius r of the roller and R of the raceway [m].
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

    ``gap``, smallest gap h0 [m], positive; ``relative_permittivity``, relative permittivity of the medium in
    the gap, dimensionless; ``obliquity``, end of the integral: where the normal of the raceway meets the
    roller at this angle from the normal of the roller [rad]. Returns capacitance per length [F/m].

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

    ``half_width``, half-width b of the dry contact [m]; ``domain``, inlet and outlet of the film's domain,
    along the arc of the raceway from the contact [m]; ``thickness``, film thickness at inlet and outlet [m];
    ``relative_permittivity``, relative permittivity of the medium in the gap, dimensionless; ``obliquity``,
    end of the integral, as in ``roller_capacitance`` [rad]. Returns capacitance per length [F/m], each about
    2 eps0 eps R/abs(x) with the reduced radius R; it is zero where the domain reaches beyond the end of the
    integral.

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
