"""Speeds in a rolling bearing, and the inertial forces on its elements. SI units.

The elements roll without sliding on both rings, and the cage turns with them. Both rings may turn; all speeds
are positive in the same sense of rotation. The formulas have one contact angle for both contacts of an
element. For a ball at speed, whose contact angles differ, it is their mean.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array


@dataclass(frozen=True)
class Speeds:
    """Speeds of cage, elements and contacts in pure rolling.

    Attributes
    ----------
    cage : Array or float
        Angular speed of the element's centre about the axis of the bearing [rad/s].
    spin : Array or float
        Angular speed of the element about its own axis, relative to the cage [rad/s]. It is not the spinning
        motion about the normal of a contact, which these formulas leave out.
    inner_entrainment, outer_entrainment : Array or float
        Entrainment speed (u1 + u2)/2, with the speeds of both surfaces relative to the contact [m/s].
    """

    cage: Array | float
    spin: Array | float
    inner_entrainment: Array | float
    outer_entrainment: Array | float


def rolling_speeds(
    element_diameter: float,
    pitch_diameter: float,
    inner_speed: float,
    outer_speed: float = 0.0,
    contact_angle: ArrayLike = 0.0,
) -> Speeds:
    """Speeds of cage, elements and contacts in pure rolling.

    Let g = D cos a/d_m. The cage turns at w_c = (w_i (1 - g) + w_o (1 + g))/2. Relative to the cage, the
    element turns at (w_i - w_o) (1 - g^2) d_m/(2 D). The inner raceway, with the radius d_m (1 - g)/2, turns
    at w_i - w_c relative to the cage. The outer raceway, with the radius d_m (1 + g)/2, turns at w_c - w_o in
    the other sense. The surface speed of both is the entrainment speed, (w_i - w_o) (1 - g^2) d_m/4.

    Parameters
    ----------
    element_diameter, pitch_diameter : float
        Diameter D of the element and pitch diameter d_m [m].
    inner_speed, outer_speed : float
        Angular speeds w_i and w_o of the rings [rad/s].
    contact_angle : array_like, shape (...)
        Contact angle a [rad].

    Returns
    -------
    Speeds
        Speeds, shape (...).

    Notes
    -----
    T. A. Harris and M. N. Kotzalas, Essential Concepts of Bearing Technology, 5th ed., 2006, chapter 10,
    doi:10.1201/9781420006599. The ball's own axis is perpendicular to the line of contact.

    Examples
    --------
    Speed of the cage in rpm and entrainment speed in m/s of a 6208 at 3000 rpm:

    >>> speeds = rolling_speeds(11.906e-3, 60e-3, 3000 * 2 * np.pi / 60)
    >>> round(speeds.cage * 60 / (2 * np.pi)), round(float(speeds.inner_entrainment), 3)
    (1202, 4.527)
    """
    cosine = np.cos(np.asarray(contact_angle, dtype=float))
    gamma = element_diameter * cosine / pitch_diameter
    cage = 0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))
    inner = 0.5 * pitch_diameter * (1.0 - gamma) * (inner_speed - cage)
    outer = 0.5 * pitch_diameter * (1.0 + gamma) * (cage - outer_speed)
    return Speeds(cage, 2.0 * inner / element_diameter, inner, outer)


def centrifugal_force(mass: float, pitch_diameter: float, cage_speed: float) -> float:
    """Centrifugal force of an element, m (d_m/2) w_c^2.

    Parameters
    ----------
    mass : float
        Mass m of the element [kg].
    pitch_diameter : float
        Pitch diameter d_m [m].
    cage_speed : float
        Angular speed w_c of the cage [rad/s].

    Returns
    -------
    float
        Centrifugal force [N].

    Examples
    --------
    >>> centrifugal_force(0.007, 0.06, 100.0)
    2.1
    """
    return mass * 0.5 * pitch_diameter * cage_speed**2


def gyroscopic_moment(mass: float, diameter: float, speeds: Speeds, contact_angle: ArrayLike) -> Array:
    """Gyroscopic moment of a ball, J w_s w_c sin a with J = m D^2/10.

    The ball's own axis is taken perpendicular to the line of contact. An axis closer to the axis of the
    bearing, as with outer raceway control, makes the moment smaller.

    Parameters
    ----------
    mass, diameter : float
        Mass m [kg] and diameter D [m] of the ball.
    speeds : Speeds
        Speeds of the ball: w_s about its own axis, and w_c of the cage.
    contact_angle : array_like, shape (...)
        Contact angle a [rad].

    Returns
    -------
    ndarray, shape (...)
        Gyroscopic moment [N m].

    Notes
    -----
    T. A. Harris and M. N. Kotzalas, Advanced Concepts of Bearing Technology, 5th ed., 2006, chapter 3,
    doi:10.1201/9781420006582.

    Examples
    --------
    >>> speeds = rolling_speeds(11.906e-3, 60e-3, 1000.0, contact_angle=0.5)
    >>> round(float(gyroscopic_moment(0.007, 11.906e-3, speeds, 0.5)), 4)
    0.048
    """
    inertia = mass * diameter**2 / 10.0
    return np.asarray(inertia * speeds.spin * speeds.cage * np.sin(contact_angle))
