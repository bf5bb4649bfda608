"""Inclined rows, pairs with preload or play, and thrust bearings, against limits by hand and integrals."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from ehlectric import InputError
from ehlectric.bearing.loads.ball_loads import ball_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing, Rows, ThrustBallBearing
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.roller_loads import roller_equilibrium
from ehlectric.bearing.loads.thrust_balls import thrust_ball_equilibrium
from tests.helpers.each import each
from tests.helpers.operations import operation_in_order

E, DENSITY, ANGLE = 226e9, 7800.0, math.radians(14.0)
SIZES = 17, 11e-3, 60e-3, 15e-3, 0.0
BALLS = 12, 11.906e-3, 60e-3, 0.52, 0.53


def tapered(profile="none", **rows):
    return RollerBearing(*SIZES, profile, ANGLE, Rows(**rows) if rows else Rows())


def solve(bearing, *duty):
    kind = roller_equilibrium if isinstance(bearing, RollerBearing) else ball_equilibrium
    return kind(bearing, operation_in_order(*duty), E, DENSITY)


def test_tapered_rollers_share_an_axial_load():
    state = solve(tapered("logarithmic"), 0.0, 3000.0)
    np.testing.assert_allclose(state.inner_load, 3000.0 / 17 / math.sin(ANGLE), rtol=1e-9)
    assert state.axial_displacement > 0.0
    assert state.radial_displacement == pytest.approx(0.0, abs=1e-15)


@each("reach", [0.3, 0.5, 0.8, 1.5])
def test_integrals_of_the_load_distribution(reach):
    """F_r tan(a)/F_a = J_r/J_a of (1 - (1 - cos)/(2 e))^(10/9), with many straight rollers (Sjovall)."""
    end = math.acos(max(-1.0, 1.0 - 2.0 * reach))

    def part(angle):
        return max(0.0, 1.0 - (1.0 - math.cos(angle)) / (2.0 * reach)) ** (10.0 / 9.0)

    radial = quad(lambda angle: part(angle) * math.cos(angle), 0.0, end)[0] / math.pi
    axial = quad(part, 0.0, end)[0] / math.pi
    elements, force = 120, 4000.0
    bearing = RollerBearing(elements, 1.4e-3, 60e-3, 15e-3, 0.0, "none", ANGLE)
    state = solve(bearing, force, force * math.tan(ANGLE) * axial / radial)
    assert state.inner_load[0] == pytest.approx(force / elements / radial / math.cos(ANGLE), rel=2e-3)


def test_a_row_needs_the_axial_load_that_its_radial_load_leans_on():
    least = 2000.0 * math.tan(ANGLE) / math.cos(math.pi / 17)
    with pytest.raises(InputError, match=rf"^axial_load: got 400 N; .* above {least:.4g} N: "):
        solve(tapered(), 2000.0, 400.0)
    state = solve(tapered(), 2000.0, 1.001 * least)
    assert np.count_nonzero(state.inner_load) <= 5
    many = solve(tapered(), 2000.0, np.array([400.0, 2000.0]))
    np.testing.assert_array_equal(many.balanced, [False, True])


def test_centrifugal_force_of_inclined_rollers():
    """Its part along the normal is on the outer contact; the rest is on the flange."""
    state = solve(tapered(), 0.0, 3000.0, 900.0)
    cage = 0.5 * 900.0 * (1.0 - 11.0 / 60.0 * math.cos(ANGLE))
    force = DENSITY * math.pi / 4.0 * 11e-3**2 * 15e-3 * 0.03 * cage**2
    assert state.centrifugal_force == pytest.approx(force, rel=1e-12)
    np.testing.assert_allclose(state.outer_load - state.inner_load, force * math.cos(ANGLE), rtol=1e-7)


@each("profile", ["none", "logarithmic"])
def test_preload_of_a_pair_of_tapered_rollers(profile):
    pair = tapered(profile, number=2, preload=700.0)
    state = solve(pair, 1e-4, 0.0)
    np.testing.assert_allclose(state.inner_load, 700.0 / 17 / math.sin(ANGLE), rtol=1e-7)
    np.testing.assert_allclose(state.inner_angle[[0, 17]], [ANGLE, -ANGLE])


def test_axial_load_that_frees_the_other_row():
    """Twice the approach of the preload: 2^(10/9) of it for rollers, and 2^(3/2) for balls."""
    free = 2.0 ** (10.0 / 9.0) * 700.0
    pair = tapered(number=2, preload=700.0)
    assert solve(pair, 0.0, 0.999 * free).inner_load[17] > 0.0
    assert solve(pair, 0.0, free).inner_load[17] == pytest.approx(0.0, abs=1e-4)
    assert solve(pair, 0.0, 1.001 * free).inner_load[17] == 0.0
    balls = BallBearing(*BALLS, contact_angle=math.radians(40.0), rows=Rows(2, preload=700.0))
    # The contact angles change by less than a degree, which changes the stiffness by a few per cent.
    assert solve(balls, 0.0, 0.97 * 2.0**1.5 * 700.0).inner_load[12] > 0.0
    assert solve(balls, 0.0, 1.05 * 2.0**1.5 * 700.0).inner_load[12] == 0.0


def test_preload_of_a_pair_of_balls():
    """At rest both rows are as one row under the preload as its axial load."""
    angle = math.radians(25.0)
    pair = BallBearing(*BALLS, contact_angle=angle, rows=Rows(2, preload=900.0))
    one = solve(BallBearing(*BALLS, contact_angle=angle), 0.0, 900.0)
    both = solve(pair, 1e-3, 0.0)
    np.testing.assert_allclose(both.inner_load, np.tile(one.inner_load, 2), rtol=1e-5)
    np.testing.assert_allclose(np.abs(both.inner_angle), np.tile(one.inner_angle, 2), rtol=1e-6)


def test_a_pair_is_symmetric():
    pair = BallBearing(*BALLS, contact_angle=math.radians(40.0), rows=Rows(2, preload=300.0))
    one, other = solve(pair, 2000.0, 500.0, 500.0), solve(pair, 2000.0, -500.0, 500.0)
    np.testing.assert_allclose(one.inner_load, np.roll(other.inner_load, 12), rtol=1e-8)
    assert np.sum(one.inner_load * np.sin(one.inner_angle)) == pytest.approx(500.0, rel=1e-9)
    assert one.axial_displacement == pytest.approx(-other.axial_displacement, rel=1e-9)


@each(
    "pair",
    [tapered(number=2, endplay=40e-6), BallBearing(*BALLS, contact_angle=0.7, rows=Rows(2, endplay=40e-6))],
)
def test_play_of_a_pair(pair):
    """A pair with play under an axial load is one row whose ring has moved by half of the play before."""
    single = tapered() if isinstance(pair, RollerBearing) else BallBearing(*BALLS, contact_angle=0.7)
    elements, both, one = pair.elements, solve(pair, 0.0, 800.0), solve(single, 0.0, 800.0)
    np.testing.assert_allclose(both.inner_load[:elements], one.inner_load, rtol=1e-9)
    assert not both.inner_load[elements:].any()
    touch = 0.0 if isinstance(pair, RollerBearing) else pair.groove_distance * math.sin(0.7)
    assert both.axial_displacement == pytest.approx(one.axial_displacement - touch + 20e-6, rel=1e-9)


def test_balls_between_washers():
    """tan(b) = F_c Z/(2 F_a) with equal grooves, F_c = m (d_m/2) (w/2)^2."""
    bearing = ThrustBallBearing(15, 10.319e-3, 54e-3, 0.54, 0.54)
    state = thrust_ball_equilibrium(
        bearing, Operation(radial_load=0.0, axial_load=1500.0, inner_speed=600.0), E, DENSITY
    )
    force = DENSITY * math.pi / 6.0 * 10.319e-3**3 * 0.027 * 300.0**2
    aside = math.atan(0.5 * force * 15 / 1500.0)
    np.testing.assert_allclose(state.inner_load, math.hypot(100.0, 0.5 * force), rtol=1e-6)
    np.testing.assert_allclose(state.inner_angle, 0.5 * math.pi + aside, rtol=1e-5)
    np.testing.assert_allclose(state.outer_angle, 0.5 * math.pi - aside, rtol=1e-5)
    np.testing.assert_allclose(state.speeds.inner_entrainment, 600.0 * 54e-3 / 4.0, rtol=1e-12)


def test_balls_between_washers_with_other_grooves():
    """The ball is as far from the middle of both grooves, and forces on it balance."""
    bearing = ThrustBallBearing(12, 9e-3, 50e-3, 0.512, 0.534)
    duty = Operation(radial_load=0.0, axial_load=1200.0, inner_speed=np.array([0.0, 900.0, 1500.0]))
    state = thrust_ball_equilibrium(bearing, duty, E, DENSITY)
    inner, outer = state.inner_angle[:, 0] - 0.5 * math.pi, 0.5 * math.pi - state.outer_angle[:, 0]
    spans = [
        offset + depth[:, 0]
        for offset, depth in zip(bearing.offsets, (state.inner_approach, state.outer_approach), strict=True)
    ]
    np.testing.assert_allclose(spans[0] * np.sin(inner), spans[1] * np.sin(outer), rtol=1e-7, atol=1e-12)
    for load, aside in ((state.inner_load, inner), (state.outer_load, outer)):
        np.testing.assert_allclose(load[:, 0] * np.cos(aside), 100.0, rtol=1e-12)
    sideways = state.inner_load[:, 0] * np.sin(inner) + state.outer_load[:, 0] * np.sin(outer)
    np.testing.assert_allclose(sideways, state.centrifugal_force, rtol=1e-9, atol=1e-9)
    assert inner[1] > 2.0 * outer[1] > 0.0


def test_needles_between_washers():
    bearing = RollerBearing(30, 2e-3, 33e-3, 5e-3, 0.0, "logarithmic", 0.5 * math.pi)
    state = solve(bearing, 0.0, 1500.0, 300.0)
    np.testing.assert_allclose(state.inner_load, 50.0, rtol=1e-9)
    np.testing.assert_allclose(state.outer_load, 50.0, rtol=1e-9)
    assert state.cage_speed == pytest.approx(150.0)
    assert state.radial_displacement == 0.0
    assert math.isinf(bearing.radii(inner=True).ring_x)


@each(
    "bearing, duty, text",
    [
        (RollerBearing(*SIZES, "none", 0.5 * math.pi), (10.0, 100.0), "radial_load: got 10 N"),
        (RollerBearing(*SIZES, "none", 0.5 * math.pi), (0.0, -100.0), "axial_load: got -100 N"),
    ],
)
def test_loads_that_needles_between_washers_do_not_carry(bearing, duty, text):
    with pytest.raises(InputError, match=f"^{text}"):
        solve(bearing, *duty)


@each("duty", [(10.0, 100.0), (0.0, -100.0)])
def test_loads_that_balls_between_washers_do_not_carry(duty):
    bearing = ThrustBallBearing(15, 10.319e-3, 54e-3, 0.54, 0.54)
    with pytest.raises(InputError, match=r"^(radial|axial)_load: "):
        thrust_ball_equilibrium(bearing, operation_in_order(*duty), E, DENSITY)
    many = thrust_ball_equilibrium(
        bearing, Operation(radial_load=duty[0], axial_load=np.array([duty[1], 50.0])), E, DENSITY
    )
    assert not many.balanced[0]


@each("speed", [300.0, 3000.0])
@each("load", [1e2, 1e4, 1e6])
def test_the_residual_of_a_fast_thrust_bearing_is_a_share_of_its_load(load, speed):
    """Rounding: the halving of the slopes ends at neighbouring numbers."""
    operation = Operation(radial_load=0.0, axial_load=load, inner_speed=speed)
    state = thrust_ball_equilibrium(ThrustBallBearing(16, 9.525e-3, 54e-3, 0.54, 0.54), operation, E, DENSITY)
    assert state.residual < 1e-13
