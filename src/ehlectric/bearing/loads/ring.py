"""Equilibrium of a ring on its rolling elements, by Newton's method on a convex energy.

The elastic energy of the elements is a convex function of the ring's displacement. Its gradient is the force
of the elements against the displacement, and is continuous. The energy is constant where the ring moves in
its clearance. It is also flat across the load where a single element carries the load. Each Newton step is
therefore limited in length. A step is judged by the force along it, not by the energy: near convergence the
energy does not change even in its last digit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.loads.geometry import Speeds
from ehlectric.errors import InputError

# Force of the elements against a displacement of the ring, and its derivative by the displacement.
Reaction: TypeAlias = Callable[[Array], tuple[Array, Array]]

# Relative residual at which the iteration ends, and the one accepted where rounding prevents the first.
AIM, GOOD = 1e-12, 1e-9
_MOST_STEPS = 200
_MOST_TRIALS = 60

# A step that overshoots is shortened until the force against it is at most this part of the force along it
# at its start.
_OVERSHOOT = 0.5

# Stiffness below this part of the largest one counts as zero: only the reach limits the step there.
_FLAT = 1e-13


@dataclass(frozen=True)
class RingLoads:
    """Contacts of all elements with one ring in equilibrium."""

    load: Array  # load of each contact [N], shape (n,)
    angle: Array  # contact angle of each element [rad]; zero for rollers, shape (n,)
    # Elastic approach of element and ring in the contact [m]; 0 where they do not touch, shape (n,).
    approach: Array
    gap: Array  # distance between element and ring [m]; 0 where they touch, shape (n,)
    entrainment_speed: Array  # entrainment speed in pure rolling [m/s], shape (n,)


@dataclass(frozen=True)
class BearingEquilibrium:
    """Bearing in equilibrium. Arrays have one value per element, shape (n,), unless stated."""

    position: Array  # angle of the element from the direction of the radial load [rad]
    # inner_load and outer_load: load of both contacts [N].
    inner_load: Array
    outer_load: Array
    # inner_approach and outer_approach: elastic approach of ring and element, of a roller at its middle [m];
    # 0 where they do not touch.
    inner_approach: Array
    outer_approach: Array
    # inner_gap and outer_gap: smallest distance between the raceway and the element, of a roller at its
    # middle [m]; 0 where they touch.
    inner_gap: Array
    outer_gap: Array
    # Speeds of cage, elements and contacts in pure rolling; of each ball at the mean of its two contact
    # angles.
    speeds: Speeds
    # Centrifugal force on each element at the speed of the cage [N].
    centrifugal_force: float
    # radial_displacement and lateral_displacement: displacement of the inner ring along the radial load, and
    # towards the angle of 90 deg [m].
    radial_displacement: float
    lateral_displacement: float
    # Largest unbalanced force on ring or element over the sum of load and centrifugal force, dimensionless.
    residual: float
    iterations: int  # number of Newton steps for the ring

    def ring(self, *, inner: bool) -> RingLoads:
        """Contacts of all elements with the inner or the outer ring; contact angles of rollers are 0."""
        side, values = "inner" if inner else "outer", vars(self)
        load = values[f"{side}_load"]
        angle = values.get(f"{side}_angle", np.zeros_like(load))
        speed = np.broadcast_to(getattr(values["speeds"], f"{side}_entrainment"), load.shape)
        return RingLoads(load, angle, values[f"{side}_approach"], values[f"{side}_gap"], speed)


@dataclass(frozen=True)
class Operation:
    """Loads on a bearing, speeds of its rings, and the position of its cage. Raises InputError where the
    radial load is negative, or there is no load: then the position of the ring is arbitrary.
    """

    radial_load: float  # radial load on the inner ring, towards the angle 0 [N]
    axial_load: float = 0.0  # axial load on the inner ring, towards positive axial positions [N]
    # inner_speed and outer_speed: angular speeds of the rings [rad/s].
    inner_speed: float = 0.0
    outer_speed: float = 0.0
    cage_angle: float = 0.0  # angle of the first element from the direction of the radial load [rad]

    def __post_init__(self) -> None:
        if self.radial_load < 0.0:
            raise InputError("radial_load", got=f"{self.radial_load:g} N", takes="0 or more")
        if self.radial_load == 0.0 and self.axial_load == 0.0:
            raise InputError(
                "radial_load, axial_load", "both are 0", takes="a load: without one no element bears any"
            )

    def positions(self, elements: int) -> Array:
        """Angle of each element from the direction of the radial load, shape (elements,) [rad]."""
        return self.cage_angle + 2.0 * np.pi * np.arange(elements) / elements


def _direction(missing: Array, tangent: Array, reach: float) -> Array:
    """Newton step whose components along the eigenvectors of the tangent are limited to ``reach``."""
    values, vectors = np.linalg.eigh(tangent)
    part = vectors.T @ missing
    stiffness = np.maximum(values, _FLAT * max(float(values[-1]), 0.0))
    # This stiffness limits the step to the reach, also in directions without stiffness.
    softest = np.maximum(np.abs(part) / reach, np.finfo(float).tiny)
    return np.asarray(vectors @ (part / np.maximum(stiffness, softest)))


def _shortened(
    reaction: Reaction, load: Array, position: Array, step: Array, slope: float
) -> tuple[Array, Array, Array, bool]:
    """Position after a shortened step, force and tangent there, and whether a longer one may be tried."""
    part = 1.0
    for trial in range(_MOST_TRIALS):
        there = position + part * step
        force, tangent = reaction(there)
        now = float((load - force) @ step)
        if now >= -_OVERSHOOT * slope:
            return there, force, tangent, trial == 0 and now > _OVERSHOOT * slope
        # Linear interpolation to zero force along the step; 0.02 keeps the step from becoming too small.
        part *= max(slope / (slope - now), 0.02)
    return there, force, tangent, False


def balance(
    reaction: Reaction, load: Array, start: Array, reach: float, scale: float, aim: float = AIM
) -> tuple[Array, float, int]:
    """Displacement of a ring at which the forces of its elements balance the load.

    ``reaction``, function of the displacement, shape (n,) [m]; ``load`` [N], shape (n,); ``start``, initial
    guess of the displacement [m], shape (n,); ``reach``, largest component of the first step [m]; it grows
    where the ring moves freely; ``scale``, force that the residual is relative to [N]. Returns ``position``,
    displacement [m], shape (n,); ``residual``, largest component of the imbalance over ``scale``; above
    ``GOOD`` the iteration did not converge; ``iterations``, number of Newton steps.

    Examples
    --------
    A ring touches a spring after 1 mm, F = k (x - 1 mm)^(3/2):

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
        # Rounding limits the residual: below GOOD, two steps without improvement end the iteration.
        idle = idle + 1 if residual > 0.5 * least else 0
        if residual < least:
            best, least = position, residual
        if least <= aim or (least <= GOOD and idle >= 2) or iterations == _MOST_STEPS:
            return best, least, iterations
        step = _direction(missing, tangent, reach)
        position, force, tangent, free = _shortened(reaction, load, position, step, float(missing @ step))
        if free:
            reach *= 2.0
        iterations += 1
