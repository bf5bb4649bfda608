"""Forces of a gear mesh on the shafts, at the pitch point and without load factors. SI units.

With the working pitch diameter d_w1, the reference diameter d_1 and the torque T_1 of gear 1

    F_t = 2 T_1/d_w1        F_r = F_t tan alpha_wt        F_a = 2 T_1 tan beta/d_1

F_t is tangential to the working circles. F_r pushes external gears apart, and a pinion and a ring together.
F_a on gear 1 has the direction of the vector of its driving torque if gear 1 is right-handed, and the
opposite direction if it is left-handed; gear 2 has the opposite force.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from ehlectric.gear.geometry import GearPair

Hand = Literal["left", "right"]

# Sign of the axial force of a gear by its hand, with respect to the vector of its driving torque.
_SIGN: dict[Hand, float] = {"right": 1.0, "left": -1.0}


@dataclass(frozen=True)
class MeshForces:
    """Forces of a mesh on gear 1 [N]."""

    tangential: float  # F_t at the working circles, positive
    radial: float  # F_r, positive
    axial: float  # F_a; with a hand its sign, positive along the vector of the rotation of gear 1


def mesh_forces(pair: GearPair, torque: float, hand: Hand | None = None) -> MeshForces:
    """Forces of a mesh on gear 1. ``torque`` on gear 1 [N m], positive if it drives; ``hand`` of its helix.

    Examples
    --------
    A spur pair with working circles of 100 mm and 200 mm, and a working pressure angle of 20 degrees:

    >>> from ehlectric.gear.geometry import Drawing, gear_pair
    >>> pair = gear_pair(Drawing(2e-3, (50, 100), math.radians(20.0), 0.0, 20e-3, 150e-3, (0.0, 0.0)))
    >>> forces = mesh_forces(pair, 50.0)
    >>> round(forces.tangential, 6), round(forces.radial, 3), forces.axial
    (1000.0, 363.97, 0.0)
    """
    tangential = 2.0 * abs(torque) / pair.working_diameter[0]
    axial = 2.0 * abs(torque) / pair.reference_diameter[0] * math.tan(pair.helix_angle)
    direction = 1.0 if hand is None else math.copysign(_SIGN[hand], _SIGN[hand] * torque)
    return MeshForces(tangential, tangential * math.tan(pair.working_pressure_angle), direction * axial)
