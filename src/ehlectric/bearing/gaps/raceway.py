"""Raceway of a ball: a groove about the axis of the bearing, and its gap to a rigid ball. SI units.

The raceway is a torus: a groove of radius r_g about a circle around the bearing axis. Along rolling it is
convex at the inner ring and concave at the outer ring. A point Q on it has the azimuth phi from the ball, and
the angle psi across the groove, from its bottom and positive towards the contact. The ball's centre O is at
the distance R_o from the axis, and the gap at the contact angle alpha is h0. With e = r_g - r - h0,
u = psi - alpha and the radius of the raceway at Q, R = R_o + s (r_g cos psi - e cos alpha), where s is 1 at
the outer ring and -1 at the inner ring,

    abs(Q - O)^2 = (r + h0)^2 + 4 r_g e sin^2(u/2) + 4 R R_o sin^2(phi/2).

This form avoids differences of large numbers. The gap at Q is measured along the radius of the ball,
abs(Q - O) - r.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown


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


def groove_gap(race: Raceway, gap: float | Array, x: Array, y: Array) -> Array:
    """Gap between a rigid ball and points on its raceway, along the radius of the ball.

    Parameters
    ----------
    race : Raceway
        Groove and ball.
    gap : float or ndarray, shape that broadcasts to (...)
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
