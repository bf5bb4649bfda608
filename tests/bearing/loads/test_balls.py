"""Ball bearings: Stribeck and Sjovall, Harris' equations, a direct search for the least energy, and laws."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq, minimize
from scipy.special import ellipe, ellipk

from ehlectric import InputError
from ehlectric.bearing.loads.ball_contacts import contact_stiffness
from ehlectric.bearing.loads.ball_loads import ball_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, rolling_speeds
from ehlectric.bearing.loads.ring import Operation
from ehlectric.formulas.film_point import PointContact
from tests.helpers.each import each
from tests.helpers.operations import operation_in_order

E, DENSITY = 226e9, 7800.0
RPM = 2.0 * np.pi / 60.0
speeds = st.one_of(st.just(0.0), st.floats(1.0, 30_000.0))
B6208 = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
ANGULAR = BallBearing(12, 11.906e-3, 60e-3, 0.52, 0.53, contact_angle=math.radians(25.0))


def solve(bearing, *duty):
    return ball_equilibrium(bearing, operation_in_order(*duty), E, DENSITY)


def many(elements, clearance=0.0):
    """Balls that leave a tenth of their pitch circle free."""
    return BallBearing(elements, 54e-3 * math.sin(math.pi / elements), 60e-3, 0.52, 0.52, clearance)


@each("elements", [8, 9, 10, 12, 16, 24])
def test_stribeck(elements):
    """Zero clearance, a ball on the load line: loads go with cos^(3/2), F/sum cos^(5/2) is 4.37 F/Z."""
    state = solve(many(elements), 1000.0)
    cosines = np.maximum(0.0, np.cos(2.0 * np.pi * np.arange(elements) / elements))
    # A quarter turn from the load nothing but the last digit presses.
    cosines[cosines < 1e-12] = 0.0
    exact = 1000.0 / np.sum(cosines**2.5)
    assert state.inner_load[0] == pytest.approx(exact, rel=1e-9, abs=0.0)
    np.testing.assert_allclose(state.inner_load, exact * cosines**1.5, rtol=1e-8, atol=1e-9)
    assert state.inner_load[0] == pytest.approx(4.37 * 1000.0 / elements, rel=0.01, abs=0.0)
    if elements == 9:
        assert state.inner_load[0] == pytest.approx(4.385 * 1000.0 / 9, rel=2e-4, abs=0.0)


@each("clearance", [0.0, 5e-6, 20e-6, -5e-6])
def test_sjovall(clearance):
    """F = Z Q_max J(e), J = 1/(2 pi) int (1 - (1 - cos)/(2 e))^(3/2) cos, e = (1 - P/(2 x))/2, many balls."""
    state = solve(many(80, clearance), 500.0)
    e = 0.5 * (1.0 - clearance / (2.0 * state.radial_displacement))
    reach = np.arccos(max(-1.0, 1.0 - 2.0 * e))
    j = quad(lambda a: (1.0 - (1.0 - np.cos(a)) / (2.0 * e)) ** 1.5 * np.cos(a), 0.0, reach)[0] / np.pi
    assert 80 * state.inner_load[0] * j == pytest.approx(500.0, rel=2e-4, abs=0.0)
    assert np.sum(state.inner_load > 0.0) == pytest.approx(80 * reach / np.pi, abs=1.0)


def test_clearance_loads_fewer_balls_more():
    largest = [solve(many(12, p), 500.0).inner_load[0] for p in (-5e-6, 0.0, 5e-6, 20e-6, 200e-6)]
    assert np.all(np.diff(largest) > 0.0)
    assert largest[-1] == pytest.approx(500.0, rel=1e-9, abs=0.0)


@each("bearing", [B6208, ANGULAR])
@each("load", [1.0, 100.0, 5000.0])
def test_pure_axial_load_is_shared_equally(bearing, load):
    """F_a/Z = sin a K A^(3/2) (cos a0/cos a - 1)^(3/2) at rest, solved for a; K of that very angle."""
    state = solve(bearing, 0.0, load)
    a, a0 = bearing.groove_distance, bearing.free_angle

    def missing(angle):
        k = [contact_stiffness(bearing, E, angle, inner=inner) for inner in (True, False)]
        both = (k[0] ** (-2 / 3) + k[1] ** (-2 / 3)) ** -1.5
        depth = a * (math.cos(a0) / math.cos(angle) - 1.0)
        return math.sin(angle) * both * depth**1.5 - load / bearing.elements

    angle = brentq(missing, a0, 1.3, xtol=1e-14)
    np.testing.assert_allclose(state.inner_angle, angle, rtol=1e-9)
    np.testing.assert_allclose(state.outer_angle, angle, rtol=1e-9)
    np.testing.assert_allclose(state.inner_load, load / bearing.elements / math.sin(angle), rtol=1e-9)
    assert abs(state.moment) < 1e-9 * load * 30e-3


def check_balance(state, radial, axial):
    """Sums over the balls, in space, and at every ball."""
    along, across = np.sin(state.inner_angle), np.cos(state.inner_angle)
    q, psi = state.inner_load, state.position
    size = math.hypot(radial, axial)
    assert abs(q @ along - axial) < 1e-9 * size
    assert abs(q @ (across * np.cos(psi)) - radial) < 1e-9 * size
    assert abs(q @ (across * np.sin(psi))) < 1e-9 * size
    outward = state.outer_load * np.cos(state.outer_angle) - q * across
    sideways = state.outer_load * np.sin(state.outer_angle) - q * along
    touching = state.outer_load > 0.0
    np.testing.assert_allclose(outward[touching], state.centrifugal_force, atol=1e-9 * size)
    assert np.max(np.abs(sideways)) < 1e-9 * size
    assert touching.all() or state.centrifugal_force == 0.0
    assert state.residual < 1e-9


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(
    bearing=st.sampled_from([B6208, many(7), many(15, 40e-6), many(11, -3e-6), ANGULAR]),
    radial=st.one_of(st.just(0.0), st.floats(1.0, 2e4)),
    axial=st.floats(1.0, 5e3),
    speed=speeds,
    offset=st.floats(0.0, 1.0),
)
def test_forces_balance(bearing, radial, axial, speed, offset):
    check_balance(solve(bearing, radial, axial, speed * RPM, 0.0, offset), radial, axial)


@settings(max_examples=20, deadline=None)
@given(radial=st.floats(0.1, 3e4), speed=speeds, offset=st.floats(0.0, 1.0))
def test_forces_balance_under_a_radial_load(radial, speed, offset):
    state = solve(B6208, radial, 0.0, speed * RPM, 0.0, offset)
    check_balance(state, radial, 0.0)
    np.testing.assert_allclose(state.inner_angle[state.inner_load > 0.0], 0.0, atol=1e-9)


def test_stiffness_is_the_exact_one_at_every_angle():
    """Q/delta^(3/2) of the result against the ellipse at the contact's own angle."""
    state = solve(ANGULAR, 2000.0, 1500.0, 12_000 * RPM, 0.0, 0.1)
    for inner, load, depth, angle in (
        (True, state.inner_load, state.inner_approach, state.inner_angle),
        (False, state.outer_load, state.outer_approach, state.outer_angle),
    ):
        assert np.ptp(angle) > 0.1
        for q, d, a in zip(load, depth, angle, strict=True):
            k = contact_stiffness(ANGULAR, E, float(a), inner=inner)
            assert q == pytest.approx(k * d**1.5, rel=1e-10, abs=1e-6)


@each("angle", [0.0, 0.6, 1.2])
@each("inner, groove, sign", [(True, 0.52, 1.0), (False, 0.53, -1.0)])
def test_stiffness_by_complete_integrals(inner, groove, sign, angle):
    """Hertz as Harris has it: F(rho) = ((k^2 + 1) E - 2 K)/((k^2 - 1) E) gives k, the ratio of the axes.

    With the sum of curvatures s, a^3 = 6 k^2 E Q/(pi s E'), and the approach is (3 Q/(2 pi a)) K/(E'/2),
    K and E complete integrals of m = 1 - 1/k^2.
    """
    d, c = 11.906e-3, math.cos(angle)
    across = (2.0 - 1.0 / groove) / d
    along = (2.0 + sign * 2.0 * (11.906 / 60.0) * c / (1.0 - sign * (11.906 / 60.0) * c)) / d
    difference = (along - across) / (along + across)

    def excess(k):
        m = 1.0 - k**-2
        return ((k**2 + 1.0) * ellipe(m) - 2.0 * ellipk(m)) / ((k**2 - 1.0) * ellipe(m)) - difference

    k = brentq(excess, 1.0 + 1e-6, 1e3, xtol=1e-13)
    m, load = 1.0 - k**-2, 700.0
    a = (6.0 * k**2 * ellipe(m) * load / (math.pi * (along + across) * E)) ** (1.0 / 3.0)
    approach = 1.5 * load / (math.pi * a) * ellipk(m) / (0.5 * E)
    stiffness = contact_stiffness(ANGULAR, E, angle, inner=inner)
    assert (load / stiffness) ** (2 / 3) == pytest.approx(approach, rel=1e-9, abs=0.0)


def test_cage_and_gyroscopic_moment_by_hand():
    """w_c = w (1 - g)/2 of each ball's mean angle, weighted with its load; M_g = m D^2/10 w_s w_c sin a."""
    speed = 15_000 * RPM
    state = solve(ANGULAR, 900.0, 700.0, speed, 0.0, 0.1)
    angle = 0.5 * (state.inner_angle + state.outer_angle)
    gamma = 11.906 / 60.0 * np.cos(angle)
    cages = 0.5 * speed * (1.0 - gamma)
    mean = cages @ state.inner_load / np.sum(state.inner_load)
    # The plain mean is another one.
    assert abs(np.mean(cages) / mean - 1.0) > 1e-4
    assert state.cage_speed == pytest.approx(mean, rel=1e-9, abs=0.0)
    mass = DENSITY * math.pi / 6.0 * 11.906e-3**3
    assert state.centrifugal_force == pytest.approx(mass * 30e-3 * mean**2, rel=1e-9, abs=0.0)
    spin = speed * (1.0 - gamma**2) / (2.0 * 11.906 / 60.0)
    moments = mass * 11.906e-3**2 / 10.0 * spin * cages * np.sin(angle)
    np.testing.assert_allclose(state.gyroscopic_moment, moments, rtol=1e-9)


@pytest.mark.parametrize(
    ("bearing", "duty"),
    [
        (B6208, (1800.0, 300.0, 3000 * RPM)),
        (B6208, (1800.0, 0.0, 20_000 * RPM, 0.0, 0.2)),
        (ANGULAR, (500.0, 900.0, 15_000 * RPM, 0.0, 0.1)),
    ],
)
def test_least_total_energy(bearing, duty):
    """All places of balls and ring at once by a general minimiser, K of each contact as it ended."""
    state = solve(bearing, *duty)
    z, psi = bearing.elements, state.position
    k = {
        inner: np.array([contact_stiffness(bearing, E, float(a), inner=inner) for a in angles])
        for inner, angles in ((True, state.inner_angle), (False, state.outer_angle))
    }
    inner_offset, outer_offset = bearing.offsets

    def energy(unknowns):
        """In micrometres and microjoules, with its derivative."""
        p, (axial, x, y) = unknowns[: 2 * z].reshape(z, 2) * 1e-6, unknowns[2 * z :] * 1e-6
        g = np.stack([np.full(z, axial), bearing.radial_distance + x * np.cos(psi) + y * np.sin(psi)], axis=1)
        value = -duty[0] * x - duty[1] * axial - state.centrifugal_force * np.sum(p[:, 1])
        slope_p = np.tile([0.0, -state.centrifugal_force], (z, 1))
        slope_g = np.zeros((z, 2))
        for span, offset, stiffness, signs in (
            (g - p, inner_offset, k[True], (-1.0, 1.0)),
            (p, outer_offset, k[False], (1.0, 0.0)),
        ):
            length = np.linalg.norm(span, axis=1)
            depth = np.maximum(0.0, length - offset)
            value += np.sum(0.4 * stiffness * depth**2.5)
            force = (stiffness * depth**1.5 / length)[:, None] * span
            slope_p, slope_g = slope_p + signs[0] * force, slope_g + signs[1] * force
        of_ring = [
            np.sum(slope_g[:, 0]) - duty[1],
            slope_g[:, 1] @ np.cos(psi) - duty[0],
            slope_g[:, 1] @ np.sin(psi),
        ]
        return 1e6 * value, np.concatenate([slope_p.ravel(), of_ring])

    # From the rings concentric and just touching, the balls midway and pressed a little.
    a0 = bearing.free_angle
    start = np.concatenate(
        [
            np.tile([outer_offset * math.sin(a0), outer_offset * math.cos(a0)], z),
            [bearing.groove_distance * math.sin(a0), 10e-6, 0.0],
        ]
    )
    found = minimize(energy, start * 1e6, jac=True, method="BFGS", options={"gtol": 1e-6, "maxiter": 5000})
    ring = [state.axial_displacement, state.radial_displacement, state.lateral_displacement]
    np.testing.assert_allclose(np.array(ring) * 1e6, found.x[2 * z :], atol=2e-4)
    p = found.x[: 2 * z].reshape(z, 2) * 1e-6
    depth = np.maximum(0.0, np.linalg.norm(p, axis=1) - outer_offset)
    np.testing.assert_allclose(state.outer_load, k[False] * depth**1.5, rtol=1e-4, atol=0.01)


def test_symmetric_about_the_load():
    state = solve(B6208, 1800.0, 300.0, 9000 * RPM)
    np.testing.assert_allclose(state.inner_load[1:], state.inner_load[:0:-1], rtol=1e-9)
    assert state.lateral_displacement == pytest.approx(0.0, abs=1e-15)
    # The mirror image of a cage a little ahead is one a little behind.
    ahead, behind = (solve(B6208, 1800.0, 300.0, 9000 * RPM, 0.0, a) for a in (0.1, -0.1))
    np.testing.assert_allclose(ahead.inner_load[1:], behind.inner_load[:0:-1], rtol=1e-8)
    assert ahead.lateral_displacement == pytest.approx(-behind.lateral_displacement, rel=1e-6, abs=0.0)
    assert ahead.lateral_moment == pytest.approx(-behind.lateral_moment, rel=1e-6, abs=0.0)


def test_one_pitch_further_is_the_same():
    one, next_one = (solve(B6208, 1800.0, 300.0, 9000 * RPM, 0.0, 0.1 + k * 2 * np.pi / 9) for k in (0, 1))
    np.testing.assert_allclose(next_one.inner_load, np.roll(one.inner_load, -1), rtol=1e-8)
    assert next_one.radial_displacement == pytest.approx(one.radial_displacement, rel=1e-9, abs=0.0)


def test_an_axial_load_the_other_way_is_its_mirror_image():
    one, other = solve(B6208, 1800.0, 300.0, 9000 * RPM), solve(B6208, 1800.0, -300.0, 9000 * RPM)
    np.testing.assert_allclose(other.inner_load, one.inner_load, rtol=1e-9)
    np.testing.assert_allclose(other.outer_angle, -one.outer_angle, rtol=1e-8, atol=1e-15)
    assert other.axial_displacement == pytest.approx(-one.axial_displacement, rel=1e-9, abs=0.0)


def test_moment_is_that_of_the_contact_forces_in_space():
    """Force of each ball on the ring at its groove centre; x along the load, z the axis."""
    state = solve(B6208, 1800.0, 300.0, 9000 * RPM, 0.0, 0.1)
    psi, angle = state.position, state.inner_angle
    outward = np.stack([np.cos(psi), np.sin(psi), np.zeros(9)], axis=1)
    axis = np.array([0.0, 0.0, 1.0])
    force = -state.inner_load[:, None] * (np.cos(angle)[:, None] * outward + np.sin(angle)[:, None] * axis)
    moment = np.sum(
        np.cross((30e-3 + 0.02 * 11.906e-3 * math.cos(B6208.free_angle)) * outward, force), axis=0
    )
    assert [state.lateral_moment, state.moment] == pytest.approx([-moment[0], moment[1]], rel=1e-9, abs=1e-12)
    assert state.moment > 0.0


def test_unloaded_balls_at_speed_sit_at_the_outer_ring():
    """Pressed in by F_c alone; opposite the load the play P/2 + x and that depth are at the inner ring."""
    bearing = many(12, 30e-6)
    state = solve(bearing, 500.0, 0.0, 9000 * RPM)
    free = state.inner_load == 0.0
    assert free.sum() > 5
    np.testing.assert_allclose(state.outer_load[free], state.centrifugal_force, rtol=1e-9)
    assert not state.outer_gap.any()
    play = 15e-6 + state.radial_displacement + state.outer_approach[6]
    assert state.inner_gap[6] == pytest.approx(play, rel=1e-9, abs=0.0)
    assert not state.inner_gap[~free].any()
    cage = rolling_speeds(
        element_diameter=bearing.ball_diameter, pitch_diameter=60e-3, inner_speed=9000 * RPM
    ).cage
    force = bearing.element_mass(DENSITY) * 30e-3 * cage**2
    assert state.centrifugal_force == pytest.approx(force, rel=1e-9, abs=0.0)


def test_unloaded_balls_at_rest_are_in_the_middle_of_their_clearance():
    state = solve(B6208, 1800.0)
    free = state.inner_load == 0.0
    np.testing.assert_allclose(state.inner_gap[free], state.outer_gap[free], rtol=1e-9)
    play = 5e-6 - state.radial_displacement * np.cos(state.position)
    np.testing.assert_allclose(2.0 * state.inner_gap[free], play[free], rtol=1e-9)


def test_speed_spreads_the_contact_angles():
    """Harris: at speed the outer angle falls below the free one, and the inner one rises."""
    at_rest, fast = solve(ANGULAR, 0.0, 500.0), solve(ANGULAR, 0.0, 500.0, 20_000 * RPM)
    assert fast.outer_angle[0] < ANGULAR.free_angle < at_rest.inner_angle[0] < fast.inner_angle[0]
    assert np.all(fast.gyroscopic_moment > 0.0)
    assert not at_rest.gyroscopic_moment.any()


def test_turning_rings_the_same_way_is_the_cage_that_counts():
    """Only the cage's speed matters to the balls: w_o at rest or turning."""
    one = solve(B6208, 0.0, 500.0, 9000 * RPM)
    gamma = 11.906 / 60.0 * float(np.cos(np.mean([one.inner_angle[0], one.outer_angle[0]])))
    share = (1.0 - gamma) / (1.0 + gamma)
    other = solve(B6208, 0.0, 500.0, 0.0, 9000 * RPM * share)
    assert other.cage_speed == pytest.approx(one.cage_speed, rel=1e-9, abs=0.0)
    np.testing.assert_allclose(other.inner_load, one.inner_load, rtol=1e-8)


def test_ceramic_balls_are_lighter_and_stiffer():
    steel = solve(B6208, 1800.0, 0.0, 20_000 * RPM)
    ceramic = ball_equilibrium(
        B6208, Operation(radial_load=1800.0, axial_load=0.0, inner_speed=20_000 * RPM), 267e9, 3200.0
    )
    assert ceramic.centrifugal_force / steel.centrifugal_force == pytest.approx(3200 / 7800, rel=1e-9)
    assert ceramic.radial_displacement < steel.radial_displacement


@pytest.mark.parametrize("viscosity", [5.5e-3, 75e-3])
def test_contacts_of_a_6208_are_hard_ones(viscosity):
    """M of 1300 to 10 000 and L of 11 to 23 at the inner ring: ISO VG 46 at 100 degC, VG 150 at 55 degC."""
    state = solve(B6208, 1800.0, 300.0, 3000 * RPM)
    load = state.inner_load[0]
    assert load == pytest.approx(870.0, rel=0.05, abs=0.0)
    radii = B6208.radii(float(state.inner_angle[0]), inner=True)
    speed = float(state.speeds.inner_entrainment[0])
    contact = PointContact(
        radius_x=radii.radius_x,
        radius_y=radii.radius_y,
        reduced_modulus=E,
        load=load,
        entrainment_speed=speed,
        viscosity=viscosity,
        pressure_viscosity_coefficient=20e-9,
    )
    assert 1300.0 < contact.moes_m < 10_000.0
    assert 11.0 < contact.moes_l < 23.0


@pytest.mark.parametrize(
    ("bearing", "duty", "message"),
    [
        (ANGULAR, (500.0,), "^axial_load: .* 0 N.* above 0"),
        (ANGULAR, (500.0, -10.0), "^axial_load: .* -10 N.* above 0"),
    ],
)
def test_what_it_cannot_do(bearing, duty, message):
    with pytest.raises(InputError, match=message) as caught:
        solve(bearing, *duty)
    assert "\n" not in str(caught.value)
