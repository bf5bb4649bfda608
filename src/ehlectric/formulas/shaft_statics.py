"""Loads of the two bearings of a straight shaft along z, by statics. SI units.

With all forces F at points p, and bearings at z_A and z_B, the moments M = sum (p - z_A z) x F about A give
the loads that the bearings carry:

    F_B,x = M_y/(z_B - z_A)        F_B,y = -M_x/(z_B - z_A)        F_A = sum F - F_B (x and y)

The locating bearing carries the sum of the axial forces.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.constants import GRAVITY
from ehlectric.errors import InputError

# Least distance of the bearings of a shaft [m].
_LEAST_DISTANCE = 1e-4


@dataclass(frozen=True)
class ForceAt:
    """Force on a shaft at a point, vectors in x, y and z with the origin on its axis, shape (3,)."""

    force: Array  # [N]
    point: Array  # [m]


def on_axis(place: float, x: float, y: float, z: float) -> ForceAt:
    """Force with components [N] at a place on the axis of a shaft [m]."""
    return ForceAt(np.array([x, y, z]), np.array([0.0, 0.0, place]))


def weight_at(mass: float, place: float, direction: float) -> ForceAt:
    """Weight of a mass [kg] at a place on the axis [m], in a direction from x about z [rad].

    Examples
    --------
    >>> [round(float(part), 6) for part in weight_at(2.0, 0.1, math.pi).force]
    [-19.6133, 0.0, 0.0]
    """
    force = mass * GRAVITY
    return on_axis(place, force * math.cos(direction), force * math.sin(direction), 0.0)


@dataclass(frozen=True)
class BearingLoads:
    """Loads that the shaft puts on its bearings A and B."""

    # Radial loads in x and y [N], shape (2,).
    first: Array
    second: Array
    axial: float  # sum of the axial forces along z [N]
    # Axial forces along z on A and B that are adjusted against each other [N], and whether each of them
    # carries only the axial load that keeps it together.
    shares: tuple[float, float] | None = None
    unloaded: tuple[bool, bool] = (False, False)

    @property
    def radial(self) -> tuple[float, float]:
        """Magnitudes of the radial loads of A and B [N]."""
        return float(np.hypot(*self.first)), float(np.hypot(*self.second))


def bearing_loads(forces: Sequence[ForceAt], places: tuple[float, float]) -> BearingLoads:
    """Loads on the bearings A and B at places along z [m]. Raises InputError if they are at one place.

    Examples
    --------
    A force of 100 N in the middle of two bearings:

    >>> bearing_loads([on_axis(0.05, 100.0, 0.0, 0.0)], (0.0, 0.1)).radial
    (50.0, 50.0)
    """
    start, end = places
    if abs(end - start) < _LEAST_DISTANCE:
        raise InputError.worded("bearing.at", "both bearings of the shaft are at one place; give two places")
    total = np.sum([each.force for each in forces], axis=0) if forces else np.zeros(3)
    moment = np.zeros(3)
    for each in forces:
        moment += np.cross(each.point - np.array([0.0, 0.0, start]), each.force)
    second = np.array([moment[1], -moment[0]]) / (end - start)
    return BearingLoads(total[:2] - second, second, float(total[2]))
