"""Forces of gear meshes: values of a separate program, equilibrium of power, and directions by hand."""

import math

import numpy as np
import pytest

import ehlectric
from ehlectric.gear.forces_on_shafts import mesh_forces
from ehlectric.gear.geometry import gear_pair
from tests.gear.pairs import FIRST_STAGE, SECOND_STAGE, case_of


@pytest.mark.parametrize(
    ("drawing", "torque", "expected"),
    [
        (FIRST_STAGE, 150.0, (6746.627, 2733.799, 3149.950)),
        (SECOND_STAGE, 436.957, (17413.905, 6911.364, 5685.347)),
    ],
)
def test_forces_of_two_stages(drawing, torque, expected):
    """Forces [N] at the pitch point, which a separate program computed."""
    forces = mesh_forces(gear_pair(drawing), torque)
    assert (forces.tangential, forces.radial, forces.axial) == pytest.approx(expected, rel=2e-6)


@pytest.mark.parametrize("drawing", [FIRST_STAGE, SECOND_STAGE])
def test_the_forces_are_the_components_of_the_normal_force(drawing):
    """The normal force lies along the line of action: F_bt^2 + F_a^2 = F_bn^2, and F_t^2 + F_r^2 = F_bt^2."""
    pair, torque = gear_pair(drawing), 100.0
    forces = mesh_forces(pair, torque)
    base = 2.0 * torque / pair.base_diameter[0]
    assert math.hypot(forces.tangential, forces.radial) == pytest.approx(base, rel=1e-12)
    normal = base / math.cos(pair.base_helix_angle)
    assert math.hypot(base, forces.axial) == pytest.approx(normal, rel=1e-12)


def normal_of_flank(pair, hand, side):
    """Unit normal of a tooth flank of gear 1 at the pitch point, out of the material, from the surface.

    The gear turns about z; the pitch point is at x = r_w1, where the tooth that touches moves along y. The
    flank is drawn as involutes that are turned along z by the helix.
    """
    radius, twist = 0.5 * pair.base_diameter[0], {"right": 1.0, "left": -1.0}[hand]
    lead = twist * math.tan(pair.base_helix_angle) / radius

    def point(roll, z):
        angle = side * (math.atan(roll) - roll) + lead * z
        distance = radius * math.hypot(1.0, roll)
        return np.array([distance * math.cos(angle), distance * math.sin(angle), z])

    roll, step = math.tan(pair.working_pressure_angle), 1e-6
    shift = point(roll, 0.0)
    turn = math.atan2(shift[1], shift[0])
    along = (point(roll + step, 0.0) - point(roll - step, 0.0)) / (2.0 * step)
    across = (point(roll, step * radius) - point(roll, -step * radius)) / (2.0 * step * radius)
    normal = np.cross(along, across)
    rotated = np.array(
        [
            math.cos(turn) * normal[0] + math.sin(turn) * normal[1],
            math.cos(turn) * normal[1] - math.sin(turn) * normal[0],
            normal[2],
        ]
    )
    rotated *= side * np.sign(rotated[1]) / np.linalg.norm(rotated)
    return rotated


@pytest.mark.parametrize("hand", ["left", "right"])
@pytest.mark.parametrize("torque", [100.0, -100.0])
def test_the_axial_force_has_the_direction_of_the_flank(hand, torque):
    """A gear that drives about +z presses with its flank ahead, along +y, on gear 2, which presses back along
    the normal of that flank.
    """
    pair = gear_pair(FIRST_STAGE)
    side = math.copysign(1.0, torque)
    normal = normal_of_flank(pair, hand, side)
    force = -normal / abs(normal[1])
    forces = mesh_forces(pair, torque, hand)
    assert force[1] == pytest.approx(-side)
    assert forces.axial / forces.tangential == pytest.approx(force[2], rel=1e-4)


def test_the_summary_has_the_forces_of_the_pair():
    gear = ehlectric.solve_gear(case_of()).summary()["gear"]
    assert gear["axial_force"] == 0.0
    # Spur gears: working circle of 73.2 mm, working pressure angle of 22.43879 degrees.
    assert gear["tangential_force"] == pytest.approx(2.0 * 215.6 / 0.0732, rel=1e-5)
    tangent = math.tan(math.radians(22.43879))
    assert gear["radial_force"] == pytest.approx(tangent * gear["tangential_force"], rel=1e-5)
