"""Speeds in a rolling bearing, and the inertia forces of its elements. SI units.

Pure rolling at both contacts, no sliding of element or cage. Both rings may turn; speeds are positive in one
sense of rotation. One contact angle serves for both contacts: between those of a ball at speed, their mean.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array


@dataclass(frozen=True)
class Speeds:
    """Speeds of cage, elements and contacts.

    Attributes
    ----------
    cage : Array or float
        Angular speed of the element's centre about the bearing's axis [rad/s].
    spin : Array or float
        Angular speed of the element about its own axis, seen from the cage [rad/s].
    inner_entrainment, outer_entrainment : Array or float
        Mean of both surfaces' speeds relative to the contact, (u1 + u2)/2 [m/s].
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
    """Speeds of pure rolling.

    With g = D cos a/d_m the cage turns at (w_i (1 - g) + w_o (1 + g))/2, and the element against it at
    (w_i - w_o) (1 - g^2) d_m/(2 D). A ring passes the cage with w_i - w_c at the radius d_m (1 - g)/2, or
    w_c - w_o at d_m (1 + g)/2; in pure rolling that is the entrainment speed, (w_i - w_o) (1 - g^2) d_m/4 at
    both.

    Parameters
    ----------
    element_diameter, pitch_diameter : float
        D and d_m [m].
    inner_speed, outer_speed : float
        w_i and w_o of the rings [rad/s].
    contact_angle : array_like
        a [rad].

    Returns
    -------
    Speeds
        Of the shape of ``contact_angle``.

    Notes
    -----
    T. A. Harris and M. N. Kotzalas, Essential Concepts of Bearing Technology, 5th ed., 2006, chapter 10,
    doi:10.1201/9781420006599. The spin is taken at right angles to the line of contact.

    Examples
    --------
    A 6208 at 3000 rpm:

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
        m of the element [kg].
    pitch_diameter : float
        d_m [m].
    cage_speed : float
        w_c [rad/s].

    Returns
    -------
    float
        [N].

    Examples
    --------
    >>> centrifugal_force(0.007, 0.06, 100.0)
    2.1
    """
    return mass * 0.5 * pitch_diameter * cage_speed**2


def gyroscopic_moment(mass: float, diameter: float, speeds: Speeds, contact_angle: ArrayLike) -> Array:
    """Gyroscopic moment of a ball, J w_s w_c sin a with J = m D^2/10.

    That of a ball whose axis of spin is at right angles to the line of contact; an axis closer to the
    bearing's, as with outer raceway control, makes it smaller.

    Parameters
    ----------
    mass, diameter : float
        m [kg] and D [m] of the ball.
    speeds : Speeds
        Of the ball.
    contact_angle : array_like
        a [rad].

    Returns
    -------
    ndarray
        [N m], of the shape of ``contact_angle``.

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
