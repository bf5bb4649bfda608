"""Loads of the two bearings of a shaft from the forces of its gear meshes. SI units.

Shafts lie along z. A mesh connects gear 1 on one shaft and gear 2 on another one; the unit vector e points
from the axis of gear 1 to the axis of gear 2, and t = z x e. With the torque T about z with which the shaft
turns gear 1, the working diameter d_w1, the reference diameter d_1, and h = +1 for a right-handed and -1 for
a left-handed gear 1, the force on gear 1 at the pitch point is

    F = -(2 T/d_w1) t - (2 abs(T)/d_w1) tan alpha_wt e + h (2 T/d_1) tan beta z.

Gear 2 has the opposite force at this point. With all forces F at points p, and bearings at z_A and z_B on a
straight shaft, the moments M = sum (p - z_A z) x F about A give the loads that the bearings carry:

    F_B,x = M_y/(z_B - z_A)        F_B,y = -M_x/(z_B - z_A)        F_A = sum F - F_B (x and y)

The locating bearing carries the sum of the axial forces. Of two inclined rows that are adjusted against each
other, z_A and z_B are the pressure centres, and each carries its share (``adjusted_rows``).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.gear import GearPair, Hand, mesh_forces

# Least distance of the bearings of a shaft [m].
_LEAST_DISTANCE = 1e-4


@dataclass(frozen=True)
class ForceAt:
    """Force on a shaft at a point, vectors in x, y and z with the origin on its axis, shape (3,)."""

    force: Array  # [N]
    point: Array  # [m]


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


def forces_of_mesh(
    pair: GearPair, torque: float, hand: Hand, direction: float, places: tuple[float, float]
) -> tuple[ForceAt, ForceAt]:
    """Forces of a mesh on the shafts of gear 1 and of gear 2, each with the origin on its own axis.

    ``torque`` of the shaft on gear 1 about z [N m]; ``hand`` of gear 1; ``direction``, angle of e from x
    [rad]; ``places`` of the middle of the face along both shafts [m].
    """
    forces, z = mesh_forces(pair, torque, hand), np.array([0.0, 0.0, 1.0])
    # From the axis of gear 1 to the pitch point, which lies beyond the axis of a pinion in a ring.
    to_pitch_point = np.array([math.cos(direction), math.sin(direction), 0.0])
    to_pitch_point *= -1.0 if pair.internal else 1.0
    tangential = math.copysign(forces.tangential, torque)
    force = -tangential * np.cross(z, to_pitch_point) - forces.radial * to_pitch_point + forces.axial * z
    first, second = (0.5 * diameter for diameter in pair.working_diameter)
    return (
        ForceAt(force, first * to_pitch_point + places[0] * z),
        ForceAt(-force, -second * to_pitch_point + places[1] * z),
    )


def bearing_loads(forces: Sequence[ForceAt], places: tuple[float, float]) -> BearingLoads:
    """Loads on the bearings A and B at places along z [m]. Raises InputError if they are at one place.

    Examples
    --------
    A force of 100 N in the middle of two bearings:

    >>> middle = ForceAt(np.array([100.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.05]))
    >>> bearing_loads([middle], (0.0, 0.1)).radial
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
