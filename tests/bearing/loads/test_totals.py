"""Mirrored equilibria against equilibria that are solved at the opposite angle of the cage."""

import dataclasses
import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric.bearing.loads.ball_loads import ball_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing
from ehlectric.bearing.loads.roller_loads import roller_equilibrium
from ehlectric.bearing.loads.totals import mirrored
from tests.helpers.each import each
from tests.helpers.operations import operation_in_order

SOLID = 226e9, 7800.0
BALLS = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
# As many rollers as a contact has slices: their arrays have the same length, and only one of them is turned.
ROLLERS = RollerBearing(31, 5e-3, 60e-3, 5e-3, 8e-6, "none")


def assert_mirrored(solve, bearing, angle, load):
    pitch = 2.0 * math.pi / bearing.elements
    there = operation_in_order(*load, cage_angle=pitch - angle)
    solved = solve(there)
    found = mirrored(solve(operation_in_order(*load, cage_angle=angle)), there.positions(bearing.elements))
    for field in dataclasses.fields(solved):
        mine, own = getattr(found, field.name), getattr(solved, field.name)
        if field.name == "speeds":
            mine, own = dataclasses.astuple(mine), dataclasses.astuple(own)
        if field.name not in ("residual", "iterations"):
            # Loads and lengths near 0 have rounding errors of the largest ones.
            scale = float(np.max(np.abs(own))) or 1.0
            if field.name.startswith("lateral"):
                scale = max(
                    scale, abs(solved.radial_displacement), abs(getattr(solved, "moment", 0.0) or 0.0)
                )
            # Without axial load, angles and axial displacement are 0 but for their last digits.
            near = 1e-8 * scale + 1e-18
            np.testing.assert_allclose(mine, own, rtol=1e-8, atol=near, err_msg=field.name)


@settings(max_examples=20)
@given(part=st.floats(0.05, 0.95), radial=st.floats(10.0, 5000.0), axial=st.sampled_from([0.0, 50.0, 800.0]))
def test_balls(part, radial, axial):
    angle = part * 2.0 * math.pi / BALLS.elements
    assert_mirrored(lambda at: ball_equilibrium(BALLS, at, *SOLID), BALLS, angle, (radial, axial, 300.0))


@each("speed", [0.0, 300.0])
@each("part", [0.2, 0.5, 0.7])
def test_rollers(speed, part):
    angle = part * 2.0 * math.pi / ROLLERS.elements
    assert_mirrored(
        lambda at: roller_equilibrium(ROLLERS, at, *SOLID, slices=31), ROLLERS, angle, (4000.0, 0.0, speed)
    )
