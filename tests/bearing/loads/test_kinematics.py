"""Speeds in a bearing against rigid-body velocities and Harris' closed formulas."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.bearing.loads.geometry import centrifugal_force, gyroscopic_moment, rolling_speeds

D, PITCH = 11.906e-3, 60e-3
RPM = 2.0 * np.pi / 60.0
angles = st.floats(-1.4, 1.4)
ring_speeds = st.floats(-3000.0, 3000.0)


@given(angle=angles, inner=ring_speeds)
def test_closed_formulas(angle, inner):
    """Harris: cage n_i (1 - g)/2, ball n_i (1 - g^2) d_m/(2 D), entrainment w_i d_m (1 - g^2)/4 at both."""
    speeds = rolling_speeds(element_diameter=D, pitch_diameter=PITCH, inner_speed=inner, contact_angle=angle)
    gamma = D / PITCH * np.cos(angle)
    assert speeds.cage == pytest.approx(inner * (1 - gamma) / 2, rel=1e-12, abs=1e-12)
    assert speeds.spin == pytest.approx(inner * (1 - gamma**2) * PITCH / (2 * D), rel=1e-12, abs=1e-12)
    for entrainment in (speeds.inner_entrainment, speeds.outer_entrainment):
        assert entrainment == pytest.approx(inner * PITCH / 4 * (1 - gamma**2), rel=1e-12, abs=1e-12)


@given(angle=angles, inner=ring_speeds, outer=ring_speeds)
def test_ball_and_rings_move_alike_at_both_contacts(angle, inner, outer):
    """Rigid bodies: w x r of ring and ball in space, ball centre on the x axis, bearing axis z."""
    speeds = rolling_speeds(
        element_diameter=D, pitch_diameter=PITCH, inner_speed=inner, outer_speed=outer, contact_angle=angle
    )
    centre, axis = np.array([PITCH / 2, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    line = np.array([np.cos(angle), 0.0, -np.sin(angle)])
    # Across the line of contact, towards the bearing's axis; a ball turns against the inner ring.
    spin = speeds.cage * axis - speeds.spin * np.array([np.sin(angle), 0.0, np.cos(angle)])
    for ring, side, entrainment in (
        (inner, -1.0, speeds.inner_entrainment),
        (outer, 1.0, speeds.outer_entrainment),
    ):
        point = centre + side * D / 2 * line
        of_ring = np.cross(ring * axis, point)
        of_ball = np.cross(speeds.cage * axis, centre) + np.cross(spin, point - centre)
        np.testing.assert_allclose(of_ball, of_ring, atol=1e-9)
        # Relative to the contact, which goes round with the cage.
        moving = of_ring - np.cross(speeds.cage * axis, point)
        assert abs(entrainment) == pytest.approx(np.linalg.norm(moving), rel=1e-9, abs=1e-9)


def test_rings_turning_together_carry_all_along():
    speeds = rolling_speeds(
        element_diameter=D, pitch_diameter=PITCH, inner_speed=100.0, outer_speed=100.0, contact_angle=0.2
    )
    assert speeds.cage == pytest.approx(100.0, rel=1e-14, abs=0.0)
    for zero in (speeds.spin, speeds.inner_entrainment, speeds.outer_entrainment):
        assert zero == pytest.approx(0.0, abs=1e-12)


def test_one_number_an_angle():
    speeds = rolling_speeds(
        element_diameter=D, pitch_diameter=PITCH, inner_speed=100.0, contact_angle=[0.0, 0.3]
    )
    assert speeds.cage.shape == speeds.outer_entrainment.shape == (2,)


def test_harris_constants_for_steel():
    """F_c = 2.26e-11 D^3 n_m^2 d_m N and M_g = 4.47e-12 D^5 n_R n_m sin b N mm, in mm and 1/min."""
    mass = 7800.0 * np.pi / 6 * D**3
    force = centrifugal_force(mass=mass, pitch_diameter=PITCH, cage_speed=5000.0 * RPM)
    # Their steel is a little heavier.
    assert force == pytest.approx(2.26e-11 * 11.906**3 * 5000.0**2 * 60.0, rel=0.015, abs=0.0)
    speeds = rolling_speeds(
        element_diameter=D, pitch_diameter=PITCH, inner_speed=10_000 * RPM, contact_angle=0.5
    )
    moment = gyroscopic_moment(mass, D, speeds, 0.5)
    harris = 4.47e-12 * 11.906**5 * (speeds.spin / RPM) * (speeds.cage / RPM) * np.sin(0.5)
    assert 1e3 * moment == pytest.approx(harris, rel=0.005, abs=0.0)
