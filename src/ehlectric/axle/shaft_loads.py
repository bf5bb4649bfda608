"""Forces of a gear mesh on its two shafts. SI units.

Shafts lie along z. A mesh connects gear 1 on one shaft and gear 2 on another one; the unit vector e points
from the axis of gear 1 to the axis of gear 2, and t = z x e. With the torque T about z with which the shaft
turns gear 1, the working diameter d_w1, the reference diameter d_1, and h = +1 for a right-handed and -1 for
a left-handed gear 1, the force on gear 1 at the pitch point is

    F = -(2 T/d_w1) t - (2 abs(T)/d_w1) tan alpha_wt e + h (2 T/d_1) tan beta z.

Gear 2 has the opposite force at this point. The loads of the bearings follow from all forces on a shaft
(``formulas.shaft_statics``). Of two inclined rows that are adjusted against each other, the forces act at
the pressure centres, and each carries its share of the axial force (``adjusted_rows``).
"""

from __future__ import annotations

import math

import numpy as np

from ehlectric.formulas.shaft_statics import ForceAt
from ehlectric.gear import GearPair, Hand, mesh_forces


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
