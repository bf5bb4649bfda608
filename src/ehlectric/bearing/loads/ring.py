"""Where a ring comes to rest on its rolling elements: Newton's method for a convex energy.

The elements' energy is a convex function of the ring's displacement, with a continuous gradient, the force
that they oppose to it. It is flat where the ring floats in its clearance, and flat across the load where one
element carries all of it, so that a step is limited, and only the force along it judges it: near the end the
energy itself no longer changes in its last digit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError

# What is done with elements at rest that no load holds.
UNLOADED = ("centred", "outer")

# Force that the elements oppose to a displacement of the ring, and its derivative.
Reaction: TypeAlias = Callable[[Array], tuple[Array, Array]]

# Aimed at; good enough where rounding does not let it get there. Both relative to the load.
_AIM, GOOD = 1e-12, 1e-9
_MOST_STEPS = 200
_MOST_TRIALS = 60

# A step that overshoots is taken back until the force along it is at most this part of the one at its start.
_OVERSHOOT = 0.5

# Stiffness below this part of the largest one is none: its direction is travelled by the longest step.
_FLAT = 1e-13


@dataclass(frozen=True)
class RingLoads:
    """Contacts of all elements with one ring, as the equilibrium leaves them.

    Attributes
    ----------
    load : ndarray, shape (n,)
        Load of each contact [N].
    angle : ndarray
        Contact angle of each element [rad]; zero of rollers.
    approach : ndarray
        By how much element and ring come closer in the contact [m].
    gap : ndarray
        Distance of element and ring where they do not touch [m], else 0.
    entrainment_speed : ndarray
        Entrainment speed of pure rolling [m/s].
    """

    load: Array
    angle: Array
    approach: Array
    gap: Array
    entrainment_speed: Array


@dataclass(frozen=True)
class Operation:
    """Loads on a bearing, speeds of its rings, and the position of its cage.

    Attributes
    ----------
    radial_load : float
        On the inner ring, towards the angle 0 [N].
    axial_load : float
        On the inner ring, towards positive axial positions [N].
    inner_speed, outer_speed : float
        Of the rings [rad/s].
    cage_angle : float
        Angle of the first element from the direction of the radial load [rad].

    Raises
    ------
    InputError
        Where there is no load: the ring then has no place of its own.
    """

    radial_load: float
    axial_load: float = 0.0
    inner_speed: float = 0.0
    outer_speed: float = 0.0
    cage_angle: float = 0.0

    def __post_init__(self) -> None:
        if self.radial_load < 0.0:
            raise InputError("radial_load", got=f"{self.radial_load:g} N", takes="0 or more")
        if self.radial_load == 0.0 and self.axial_load == 0.0:
            raise InputError(
                "radial_load, axial_load", "both are 0", takes="a load: without one no element bears any"
            )

    def positions(self, elements: int) -> Array:
        """Angle of each element from the direction of the radial load [rad]."""
        return self.cage_angle + 2.0 * np.pi * np.arange(elements) / elements


def _direction(missing: Array, tangent: Array, reach: float) -> Array:
    """Newton's step with each of its principal parts limited to ``reach``."""
    values, vectors = np.linalg.eigh(tangent)
    part = vectors.T @ missing
    stiffness = np.maximum(values, _FLAT * max(float(values[-1]), 0.0))
    # No longer than the reach, also where there is no stiffness at all.
    softest = np.maximum(np.abs(part) / reach, np.finfo(float).tiny)
    return np.asarray(vectors @ (part / np.maximum(stiffness, softest)))


def _shortened(
    reaction: Reaction, load: Array, position: Array, step: Array, slope: float
) -> tuple[Array, Array, Array, bool]:
    """Position at the end of the step or before, force and tangent there, and whether it could go further."""
    part = 1.0
    for trial in range(_MOST_TRIALS):
        there = position + part * step
        force, tangent = reaction(there)
        now = float((load - force) @ step)
        if now >= -_OVERSHOOT * slope:
            return there, force, tangent, trial == 0 and now > _OVERSHOOT * slope
        # Where a straight line between both forces vanishes, but never a mere nudge.
        part *= max(slope / (slope - now), 0.02)
    return there, force, tangent, False


def balance(
    reaction: Reaction, load: Array, start: Array, reach: float, scale: float
) -> tuple[Array, float, int]:
    """Displacement of the ring at which its elements oppose the load.

    Parameters
    ----------
    reaction : callable
        Force of the elements, in components [N], over the displacement [m], and its derivative [N/m],
        symmetric and positive semidefinite.
    load : ndarray, shape (n,)
        Load on the ring [N].
    start : ndarray, shape (n,)
        Displacement to start from [m].
    reach : float
        Longest part of a first step [m]; it grows where the ring travels freely.
    scale : float
        Force that the imbalance is compared with [N].

    Returns
    -------
    position : ndarray, shape (n,)
        Displacement [m].
    residual : float
        Largest component of the imbalance over the scale; above ``GOOD`` no balance was found.
    iterations : int
        Newton steps.

    Examples
    --------
    A spring that the ring meets after 1 mm, F = k (x - 1 mm)^(3/2):

    >>> def spring(x):
    ...     depth = max(0.0, x[0] - 1e-3)
    ...     return np.array([1e10 * depth**1.5]), np.array([[1.5e10 * depth**0.5]])
    >>> position, residual, _ = balance(spring, np.array([1e4]), np.zeros(1), 1e-4, 1e4)
    >>> round(float(position[0]) * 1e3, 6), residual < 1e-12
    (1.1, True)
    """
    position = best = start
    force, tangent = reaction(start)
    least, idle, iterations = np.inf, 0, 0
    while True:
        missing = load - force
        residual = float(np.max(np.abs(missing))) / scale
        # Rounding ends the descent: below the good residual two steps without gain are the last.
        idle = idle + 1 if residual > 0.5 * least else 0
        if residual < least:
            best, least = position, residual
        if least <= _AIM or (least <= GOOD and idle >= 2) or iterations == _MOST_STEPS:
            return best, least, iterations
        step = _direction(missing, tangent, reach)
        position, force, tangent, free = _shortened(reaction, load, position, step, float(missing @ step))
        if free:
            reach *= 2.0
        iterations += 1
