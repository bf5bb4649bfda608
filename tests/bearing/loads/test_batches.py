"""Many bearings in one call against single calls, and points that are refused next to others."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.bearing.loads import ball_loads
from ehlectric.bearing.loads.ball_contacts import contact_stiffness, stiffness_at, stiffness_laws
from ehlectric.bearing.loads.ball_loads import ball_equilibrium, check_ball_loads
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing, gyroscopic_moment, rolling_speeds
from ehlectric.bearing.loads.ring import Operation, balance
from ehlectric.bearing.loads.roller_loads import check_roller_loads, roller_equilibrium
from ehlectric.bearing.loads.totals import check_balance, mechanics_of, mirrored
from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.errors import ConvergenceError
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each
from tests.helpers.operations import operation_in_order

E, DENSITY = 226e9, 7800.0
DEEP = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
ANGULAR = BallBearing(12, 11.906e-3, 60e-3, 0.52, 0.53, contact_angle=math.radians(25.0))
TIGHT = BallBearing(9, 11.906e-3, 60e-3, 0.515, 0.525, radial_clearance=-8e-6)
LOOSE = BallBearing(8, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=200e-6)
ROLLERS = RollerBearing(14, 11e-3, 60e-3, 11e-3, 20e-6)
LONG = RollerBearing(11, 11e-3, 60e-3, 40e-3, -6e-6)

# Loads, speed and cage angle of a point; balls leave the inner ring at light loads and high speeds.
duties = st.tuples(
    st.one_of(st.just(0.0), st.floats(0.1, 1e4)),
    st.floats(0.1, 5e3),
    st.one_of(st.just(0.0), st.floats(1.0, 3000.0)),
    st.floats(0.05, 0.6),
)
radial_duties = st.tuples(
    st.floats(0.1, 3e4), st.just(0.0), st.one_of(st.just(0.0), st.floats(1.0, 3000.0)), st.floats(0.05, 0.4)
)


def operation_of(rows):
    radial, axial, speed, angle = np.array(rows).T
    return Operation(
        radial_load=radial, axial_load=axial, inner_speed=speed, outer_speed=0.0, cage_angle=angle
    )


def assert_same(many, index, single):
    """Loads over the largest force, angles of loaded contacts, and lengths over those of the bearing."""
    size = np.max(single.outer_load)
    for side in ("inner", "outer"):
        load = getattr(single, f"{side}_load")
        np.testing.assert_allclose(getattr(many, f"{side}_load")[index], load, rtol=1e-8, atol=1e-9 * size)
        loaded, ring = load > 1e-3 * size, single.ring(inner=side == "inner")
        own = many.ring(inner=side == "inner")
        np.testing.assert_allclose(own.angle[index][loaded], ring.angle[loaded], rtol=1e-8, atol=1e-9)
        np.testing.assert_allclose(own.approach[index][loaded], ring.approach[loaded], rtol=1e-8)
        np.testing.assert_allclose(own.entrainment_speed[index][loaded], ring.entrainment_speed[loaded])
    for name in ("centrifugal_force", "cage_speed"):
        np.testing.assert_allclose(getattr(many, name)[index], getattr(single, name), rtol=1e-8)
    assert many.radial_displacement[index] == pytest.approx(single.radial_displacement, rel=1e-6, abs=1e-11)


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=25, deadline=None)
@given(bearing=st.sampled_from([DEEP, ANGULAR, TIGHT]), rows=st.lists(duties, min_size=1, max_size=6))
def test_balls(bearing, rows):
    many = ball_equilibrium(bearing, operation_of(rows), E, DENSITY)
    assert np.all(many.balanced)
    for k, (radial, axial, speed, angle) in enumerate(rows):
        operation = Operation(
            radial_load=radial, axial_load=axial, inner_speed=speed, outer_speed=0.0, cage_angle=angle
        )
        assert_same(many, k, ball_equilibrium(bearing, operation, E, DENSITY))


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=25, deadline=None)
@given(bearing=st.sampled_from([DEEP, TIGHT, LOOSE]), rows=st.lists(radial_duties, min_size=1, max_size=6))
def test_balls_under_radial_loads(bearing, rows):
    many = ball_equilibrium(bearing, operation_of(rows), E, DENSITY)
    assert np.all(many.balanced)
    assert not many.inner_angle.any()
    for k, (radial, axial, speed, angle) in enumerate(rows):
        operation = Operation(
            radial_load=radial, axial_load=axial, inner_speed=speed, outer_speed=0.0, cage_angle=angle
        )
        assert_same(many, k, ball_equilibrium(bearing, operation, E, DENSITY))


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=25, deadline=None)
@given(bearing=st.sampled_from([ROLLERS, LONG]), rows=st.lists(radial_duties, min_size=1, max_size=6))
def test_rollers(bearing, rows):
    many = roller_equilibrium(bearing, operation_of(rows), E, DENSITY)
    assert np.all(many.balanced)
    for k, (radial, axial, speed, angle) in enumerate(rows):
        single = roller_equilibrium(
            bearing,
            Operation(
                radial_load=radial, axial_load=axial, inner_speed=speed, outer_speed=0.0, cage_angle=angle
            ),
            E,
            DENSITY,
        )
        assert_same(many, k, single)
        most = np.max(single.outer_line_load)
        np.testing.assert_allclose(
            many.inner_line_load[k], single.inner_line_load, rtol=1e-8, atol=1e-9 * most
        )
        np.testing.assert_array_equal(many.slice_position[k], single.slice_position)


def sample(number=12):
    """Duties of a seeded generator, half of them at rest."""
    random = np.random.default_rng(4)
    return np.stack(
        [
            10.0 ** random.uniform(-1.0, 4.0, number),
            10.0 ** random.uniform(-1.0, 3.5, number),
            random.uniform(0.0, 3000.0, number) * random.integers(0, 2, number),
            random.uniform(0.05, 0.6, number),
        ],
        axis=1,
    )


@each("bearing", [DEEP, ANGULAR, TIGHT, LOOSE])
def test_nested_iterations_have_the_same_equilibrium(bearing):
    """Newton's method for ring and balls together against the nested iterations, and back."""
    operation = operation_of(sample())
    together = ball_equilibrium(bearing, operation, E, DENSITY)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ball_loads, "_MOST_STEPS", 0)
        nested = ball_equilibrium(bearing, operation, E, DENSITY)
    assert np.all(together.balanced & nested.balanced)
    for k in range(len(together.residual)):
        assert_same(together, k, nested.at(k))


def test_every_quantity_may_vary():
    """Each of the dimensions, the modulus and the density, with the loads and speeds of both rings."""
    random, number = np.random.default_rng(7), 6
    dimensions = {
        "ball_diameter": random.uniform(11.5e-3, 12e-3, number),
        "pitch_diameter": random.uniform(59e-3, 61e-3, number),
        "inner_groove": random.uniform(0.51, 0.53, number),
        "outer_groove": random.uniform(0.51, 0.53, number),
        "radial_clearance": random.uniform(-5e-6, 20e-6, number),
    }
    modulus, density = random.uniform(200e9, 260e9, number), random.uniform(3200.0, 7800.0, number)
    duty = (
        random.uniform(100.0, 2000.0, number),
        random.uniform(100.0, 500.0, number),
        random.uniform(0.0, 2000.0, number),
        random.uniform(-100.0, 100.0, number),
        random.uniform(0.0, 0.5, number),
    )
    many = ball_equilibrium(BallBearing(9, **dimensions), operation_in_order(*duty), modulus, density)
    for k in range(number):
        bearing = BallBearing(9, **{name: float(values[k]) for name, values in dimensions.items()})
        operation = operation_in_order(*(float(values[k]) for values in duty))
        assert_same(many, k, ball_equilibrium(bearing, operation, float(modulus[k]), float(density[k])))
    rollers = {
        "roller_diameter": random.uniform(10e-3, 11e-3, number),
        "pitch_diameter": dimensions["pitch_diameter"],
        # On both sides of 2.5 D, where the profile changes.
        "roller_length": np.linspace(10e-3, 40e-3, number),
        "radial_clearance": random.uniform(-5e-6, 20e-6, number),
    }
    load = dataclasses.replace(operation_in_order(*duty), axial_load=0.0)
    many = roller_equilibrium(RollerBearing(12, **rollers), load, modulus, density)
    for k in range(number):
        bearing = RollerBearing(12, **{name: float(values[k]) for name, values in rollers.items()})
        operation = operation_in_order(
            *(0.0 if j == 1 else float(values[k]) for j, values in enumerate(duty))
        )
        assert_same(many, k, roller_equilibrium(bearing, operation, float(modulus[k]), float(density[k])))


def test_leading_axes_broadcast():
    """Cage positions along the first axis, loads along the second one."""
    angles, loads = np.array([0.1, 0.2, 0.3]), np.array([500.0, 2000.0])
    many = ball_equilibrium(
        DEEP,
        Operation(
            radial_load=loads,
            axial_load=100.0,
            inner_speed=300.0,
            outer_speed=0.0,
            cage_angle=angles[:, None],
        ),
        E,
        DENSITY,
    )
    assert many.inner_load.shape == many.speeds.spin.shape == (3, 2, 9)
    assert many.residual.shape == many.iterations.shape == many.moment.shape == (3, 2)
    for j, angle in enumerate(angles):
        for k, load in enumerate(loads):
            single = ball_equilibrium(
                DEEP,
                Operation(
                    radial_load=load, axial_load=100.0, inner_speed=300.0, outer_speed=0.0, cage_angle=angle
                ),
                E,
                DENSITY,
            )
            assert_same(many, (j, k), single)


def test_a_single_bearing_has_plain_numbers():
    for state in (
        ball_equilibrium(
            DEEP, Operation(radial_load=1000.0, axial_load=100.0, inner_speed=300.0), E, DENSITY
        ),
        roller_equilibrium(
            ROLLERS, Operation(radial_load=1000.0, axial_load=0.0, inner_speed=300.0), E, DENSITY
        ),
    ):
        assert type(state.iterations) is int
        for name in ("residual", "radial_displacement", "centrifugal_force", "cage_speed"):
            assert type(getattr(state, name)) is float, name
        assert state.balanced
        assert state.inner_load.shape == state.position.shape


def test_refused_balls_do_not_disturb_their_neighbours():
    """Without axial load, without a load, with a negative radial one, and with a number that is none."""
    radial = np.array([500.0, 500.0, 500.0, 500.0, -1.0])
    axial = np.array([300.0, 0.0, np.nan, 100.0, 10.0])
    many = ball_equilibrium(
        ANGULAR, Operation(radial_load=radial, axial_load=axial, inner_speed=300.0), E, DENSITY
    )
    assert many.balanced.tolist() == [True, False, False, True, False]
    for name in ("inner_load", "outer_angle", "residual", "moment", "cage_speed"):
        values = getattr(many, name)
        assert np.isnan(values[[1, 2, 4]]).all(), name
        assert np.isfinite(values[[0, 3]]).all(), name
    alone = ball_equilibrium(
        ANGULAR,
        Operation(radial_load=radial[[0, 3]], axial_load=axial[[0, 3]], inner_speed=300.0),
        E,
        DENSITY,
    )
    np.testing.assert_array_equal(many.inner_load[[0, 3]], alone.inner_load)
    none = ball_equilibrium(
        ANGULAR, Operation(radial_load=500.0, axial_load=np.zeros(2), inner_speed=300.0), E, DENSITY
    )
    assert none.inner_load.shape == (2, 12)
    assert not none.balanced.any()


def test_refused_rollers_do_not_disturb_their_neighbours():
    axial = np.array([0.0, 10.0, 0.0])
    many = roller_equilibrium(
        ROLLERS,
        Operation(radial_load=np.array([500.0, 500.0, 0.0]), axial_load=axial, inner_speed=300.0),
        E,
        DENSITY,
    )
    assert many.balanced.tolist() == [True, False, False]
    assert np.isnan(many.inner_line_load[1:]).all()
    alone = roller_equilibrium(
        ROLLERS, Operation(radial_load=500.0, axial_load=0.0, inner_speed=300.0), E, DENSITY
    )
    np.testing.assert_allclose(many.inner_load[0], alone.inner_load, rtol=1e-12)
    none = roller_equilibrium(ROLLERS, Operation(radial_load=500.0, axial_load=np.ones(2)), E, DENSITY)
    assert none.inner_line_load.shape == (2, 14, 41)


def test_a_ring_without_balance_does_not_disturb_others():
    """A spring along x, F = k x^(3/2): the second of three rings has its load along y."""

    def reaction(x, points):
        depth = np.maximum(0.0, x[:, 0])
        force, tangent = np.zeros((len(points), 2)), np.zeros((len(points), 2, 2))
        force[:, 0], tangent[:, 0, 0] = 1e10 * depth**1.5, 1.5e10 * np.sqrt(depth)
        return force, tangent

    load = np.array([[1e4, 0.0], [0.0, 1.0], [8e4, 0.0]])
    position, residual, steps = balance(reaction, load, np.zeros((3, 2)), 1e-4, load.sum(axis=1))
    np.testing.assert_allclose(position[[0, 2], 0], [1e-4, 4e-4], rtol=1e-9)
    assert residual[1] == 1.0
    assert np.all(residual[[0, 2]] < 1e-12)
    assert np.all(steps[[0, 2]] < 30)


def test_single_bearings_are_refused():
    """The checks raise for floats, and leave arrays to the mask ``balanced``."""
    with pytest.raises(InputError, match=r"^axial_load: .* 0 N.* above 0"):
        check_ball_loads(ANGULAR, Operation(radial_load=500.0))
    with pytest.raises(InputError, match=r"^axial_load: .* 10 N.* 0"):
        check_roller_loads(ROLLERS, Operation(radial_load=500.0, axial_load=10.0))
    check_ball_loads(ANGULAR, Operation(radial_load=500.0, axial_load=np.zeros(2)))
    check_roller_loads(ROLLERS, Operation(radial_load=500.0, axial_load=np.ones(2)))
    state = ball_equilibrium(DEEP, Operation(radial_load=500.0), E, DENSITY)
    check_balance(state)
    with pytest.raises(ConvergenceError, match=r"^forces on ring and balls, balanced only to 1\.0e-08"):
        check_balance(dataclasses.replace(state, residual=1e-8))
    check_balance(dataclasses.replace(state, residual=np.array([1e-8])))


@each(
    "other, message",
    [
        ({"ball_diameter": np.array([11e-3, 70e-3, 80e-3])}, r"pitch_diameter: .* three of 0\.07 m"),
        ({"pitch_diameter": np.array([60e-3, 30e-3])}, r"elements: .* 9;.* 3 to 7"),
        ({"inner_groove": np.array([0.52, 0.5, 0.4])}, r"inner_groove: .* 0\.5;"),
        ({"radial_clearance": np.array([1e-5, 1.2e-3])}, r"radial_clearance: .* 0\.0012 m"),
        ({"radial_clearance": None, "contact_angle": np.array([0.3, 1.6])}, r"contact_angle: .* 1\.6 rad"),
    ],
)
def test_the_first_wrong_bearing_is_named(other, message):
    values = {
        "elements": 9,
        "ball_diameter": 11.906e-3,
        "pitch_diameter": 60e-3,
        "inner_groove": 0.52,
        "outer_groove": 0.52,
        "radial_clearance": 10e-6,
    }
    with pytest.raises(InputError, match=f"^{message}"):
        BallBearing(**(values | other))


def test_geometry_of_many():
    """Lengths and radii of arrays are those of each bearing."""
    clearance, groove = np.array([-4e-6, 10e-6, 30e-6]), np.array([0.515, 0.52, 0.53])
    many = BallBearing(9, 11.906e-3, 60e-3, groove, 0.53, clearance)
    for k in range(3):
        one = BallBearing(9, 11.906e-3, 60e-3, float(groove[k]), 0.53, float(clearance[k]))
        for name in ("groove_distance", "free_angle", "endplay", "radial_distance", "inner_centre_radius"):
            assert getattr(many, name)[k] == pytest.approx(getattr(one, name), rel=1e-14, abs=0.0)
        for inner in (True, False):
            radii, own = many.radii(0.3, inner=inner), one.radii(0.3, inner=inner)
            assert radii.radius_x == pytest.approx(own.radius_x, rel=1e-14)
            assert np.broadcast_to(radii.radius_y, 3)[k] == pytest.approx(own.radius_y, rel=1e-14)


@each("length", [11e-3, 27e-3, 40e-3])
def test_relief_of_many(length):
    one = RollerBearing(14, 11e-3, 60e-3, length, 0.0)
    many = RollerBearing(14, 11e-3, 60e-3, np.array([11e-3, length]), 0.0)
    x = np.linspace(-0.49, 0.49, 9)
    np.testing.assert_allclose(
        many.relief(x * many.roller_length[:, None])[1], one.relief(x * length), rtol=1e-13
    )


def test_speeds_of_many():
    angles, speeds = np.array([0.1, 0.5]), np.array([100.0, 900.0])
    many = rolling_speeds(
        element_diameter=11.906e-3,
        pitch_diameter=60e-3,
        inner_speed=speeds,
        outer_speed=10.0,
        contact_angle=angles,
    )
    moments = gyroscopic_moment(0.007, 11.906e-3, many, angles)
    for k in range(2):
        one = rolling_speeds(
            element_diameter=11.906e-3,
            pitch_diameter=60e-3,
            inner_speed=float(speeds[k]),
            outer_speed=10.0,
            contact_angle=float(angles[k]),
        )
        assert [values[k] for values in vars(many).values()] == pytest.approx(
            list(vars(one).values()), rel=1e-14
        )
        assert moments[k] == pytest.approx(
            gyroscopic_moment(0.007, 11.906e-3, one, float(angles[k])), rel=1e-14
        )


def test_stiffness_laws_of_distinct_geometries():
    """ln K at each angle against the ellipse itself; equal bearings have one law."""
    diameters, moduli = np.array([11e-3, 12e-3, 11e-3]), np.array([200e9, 226e9, 260e9])
    bearing = BallBearing(9, diameters, 60e-3, 0.52, 0.53, np.array([0.0, 1e-5, 2e-5]))
    laws, angle = stiffness_laws(bearing, moduli), 0.4
    for inner, law in zip((True, False), laws, strict=True):
        assert law.shape == (3, 25)
        exact = contact_stiffness(bearing, moduli, angle, inner=inner)
        np.testing.assert_allclose(stiffness_at(law.T, np.full(3, math.cos(angle))), exact, rtol=1e-12)
    one = dataclasses.replace(bearing, ball_diameter=11e-3)
    assert stiffness_laws(one, E)[0].shape == (25,)
    np.testing.assert_array_equal(laws[0][0, 1:], laws[0][2, 1:])


@each("solve, bearing, axial", [(ball_equilibrium, DEEP, 100.0), (roller_equilibrium, ROLLERS, 0.0)])
def test_mirrors_and_mechanics_of_many(solve, bearing, axial):
    loads = np.array([500.0, 2000.0])
    many = solve(
        bearing,
        Operation(radial_load=loads, axial_load=axial, inner_speed=300.0, outer_speed=0.0, cage_angle=0.1),
        E,
        DENSITY,
    )
    position = Operation(radial_load=1.0, cage_angle=2.0 * np.pi / bearing.elements - 0.1).positions(
        bearing.elements
    )
    turned, mechanics = mirrored(many, position), mechanics_of(many)
    for k, load in enumerate(loads):
        single = solve(
            bearing,
            Operation(radial_load=load, axial_load=axial, inner_speed=300.0, outer_speed=0.0, cage_angle=0.1),
            E,
            DENSITY,
        )
        other, own = mirrored(single, position), turned.at(k)
        for name in ("position", "inner_load", "outer_gap", "lateral_displacement"):
            np.testing.assert_allclose(getattr(own, name), getattr(other, name), rtol=1e-8, atol=1e-15)
        for key, value in mechanics_of(single).items():
            if key != "residual" and value is not None:
                np.testing.assert_allclose(mechanics[key][k], value, rtol=1e-8, err_msg=key)
        if solve is roller_equilibrium:
            np.testing.assert_allclose(own.inner_line_load, other.inner_line_load, rtol=1e-8)


def test_cage_positions_of_many_bearings():
    """Three moduli: each equilibrium at each position is that of the bearing alone."""
    conditions = resolve_bearing(bearing_case(BALLS))
    moduli = np.array([200e9, 226e9, 260e9])
    many = equilibria_of(dataclasses.replace(conditions, modulus=moduli), 4)
    for k, modulus in enumerate(moduli):
        alone = equilibria_of(dataclasses.replace(conditions, modulus=float(modulus)), 4)
        for at, single in zip(many, alone, strict=True):
            assert at.inner_load.shape == (3, conditions.bearing.elements)
            np.testing.assert_allclose(at.position[k], single.position)
            assert_same(at, k, single)
