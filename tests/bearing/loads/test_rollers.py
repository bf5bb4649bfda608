"""Roller bearings: Stribeck and Sjovall with the exponent 10/9, the standard's stiffness, least energy."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import minimize

from ehlectric import InputError
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.roller_loads import line_stiffness, roller_equilibrium
from ehlectric.formulas.hertz import body_compliance, reduced_modulus
from tests.helpers.each import each
from tests.helpers.operations import operation_in_order

STEEL = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))
DENSITY = 7800.0
RPM = 2.0 * np.pi / 60.0
NU208 = RollerBearing(14, 11e-3, 60e-3, 11e-3, 20e-6)


def solve(bearing, *duty, **other):
    return roller_equilibrium(bearing, operation_in_order(*duty), STEEL, DENSITY, **other)


def many(elements, clearance=0.0, profile="none"):
    """Rollers that leave a tenth of their pitch circle free."""
    return RollerBearing(elements, 54e-3 * math.sin(math.pi / elements), 60e-3, 11e-3, clearance, profile)


@each("elements", [8, 9, 10, 12, 16, 24])
def test_stribeck(elements):
    """Zero clearance: loads go with cos^(10/9), Q_max = F/sum cos^(19/9) = 4.08 F/Z."""
    state = solve(many(elements), 5000.0)
    cosines = np.maximum(0.0, np.cos(2.0 * np.pi * np.arange(elements) / elements))
    cosines[cosines < 1e-12] = 0.0
    exact = 5000.0 / np.sum(cosines ** (19 / 9))
    np.testing.assert_allclose(state.inner_load, exact * cosines ** (10 / 9), rtol=1e-9, atol=1e-9)
    assert state.inner_load[0] == pytest.approx(4.08 * 5000.0 / elements, rel=0.01, abs=0.0)


@each("clearance", [0.0, 5e-6, 20e-6, -5e-6])
def test_sjovall(clearance):
    """F = Z Q_max J(e), J = 1/(2 pi) int (1 - (1 - cos)/(2 e))^(10/9) cos, e = (1 - P/(2 x))/2."""
    state = solve(many(80, clearance), 5000.0)
    e = 0.5 * (1.0 - clearance / (2.0 * state.radial_displacement))
    reach = np.arccos(max(-1.0, 1.0 - 2.0 * e))
    j = quad(lambda a: (1.0 - (1.0 - np.cos(a)) / (2.0 * e)) ** (10 / 9) * np.cos(a), 0.0, reach)[0] / np.pi
    assert 80 * state.inner_load[0] * j == pytest.approx(5000.0, rel=5e-4, abs=0.0)


def test_stiffness_of_the_standard():
    """35 948 L^(8/9) N/mm^(10/9) of both contacts: 1 um on 10 mm is 129.2 N, by hand."""
    assert line_stiffness(10e-3, STEEL) * 1e-6 ** (10 / 9) == pytest.approx(
        35948 * 10 ** (8 / 9) * 1e-3 ** (10 / 9), rel=1e-12, abs=0.0
    )
    bearing = many(14, 10e-6)
    state = solve(bearing, 5000.0)
    depth = state.radial_displacement - 5e-6
    assert state.inner_load[0] == pytest.approx(
        35948 * 11 ** (8 / 9) * (1e3 * depth) ** (10 / 9), rel=1e-9, abs=0.0
    )
    assert state.inner_approach[0] == pytest.approx(depth / 2.0, rel=1e-9, abs=0.0)


def test_approach_goes_with_modulus_to_the_power_nine_tenths():
    soft = roller_equilibrium(many(14), Operation(radial_load=5000.0), 0.5 * STEEL, DENSITY)
    ratio = soft.radial_displacement / solve(many(14), 5000.0).radial_displacement
    assert ratio == pytest.approx(2.0**0.9, rel=1e-9, abs=0.0)


def check_balance(state, radial):
    q, psi = state.inner_load, state.position
    assert abs(q @ np.cos(psi) - radial) < 1e-9 * radial
    assert abs(q @ np.sin(psi)) < 1e-9 * radial
    touching = state.outer_load > 0.0
    np.testing.assert_allclose((state.outer_load - q)[touching], state.centrifugal_force, atol=1e-9 * radial)
    assert touching.all() or state.centrifugal_force == 0.0
    assert state.residual < 1e-9
    for loads, lines in ((q, state.inner_line_load), (state.outer_load, state.outer_line_load)):
        np.testing.assert_allclose(np.mean(lines, axis=1) * 11e-3, loads, rtol=1e-12, atol=1e-9 * radial)


@settings(max_examples=60, deadline=None)
@given(
    bearing=st.sampled_from([NU208, many(7), many(15, 40e-6, "logarithmic"), many(11, -3e-6)]),
    radial=st.floats(1.0, 5e4),
    speed=st.one_of(st.just(0.0), st.floats(1.0, 30_000.0)),
    offset=st.floats(0.0, 1.0),
)
def test_forces_balance(bearing, radial, speed, offset):
    check_balance(solve(bearing, radial, 0.0, speed * RPM, 0.0, offset), radial)


@pytest.mark.parametrize("speed", [0.0, 10_000.0])
def test_least_total_energy(speed):
    """Places of rollers and ring at once by a general minimiser; a slice stores (9/19) c d^(19/9)."""
    bearing, radial = NU208, 8000.0
    state = solve(bearing, radial, 0.0, speed * RPM, 0.0, 0.1)
    c = 2 ** (10 / 9) * 35948e6 * 11e-3 ** (8 / 9) / 41
    relief = bearing.relief(state.slice_position)
    psi, f = state.position, state.centrifugal_force

    def energy(unknowns):
        outer, (x, y) = unknowns[:14] * 1e-6, unknowns[14:] * 1e-6
        inner = x * np.cos(psi) + y * np.sin(psi) - 10e-6 - outer
        value, slopes = -radial * x - f * np.sum(outer), []
        for depth in (inner, outer):
            pressed = np.maximum(0.0, depth[:, None] - relief)
            value += np.sum(9 / 19 * c * pressed ** (19 / 9))
            slopes.append(c * np.sum(pressed ** (10 / 9), axis=1))
        ring = [slopes[0] @ np.cos(psi) - radial, slopes[0] @ np.sin(psi)]
        return 1e6 * value, np.concatenate([slopes[1] - slopes[0] - f, ring])

    start = np.concatenate([np.full(14, 1.0), [20.0, 0.0]])
    found = minimize(energy, start, jac=True, method="BFGS", options={"gtol": 1e-6, "maxiter": 5000})
    ring = np.array([state.radial_displacement, state.lateral_displacement]) * 1e6
    np.testing.assert_allclose(ring, found.x[14:], atol=1e-5)
    held = state.inner_load > 0.0
    np.testing.assert_allclose(state.outer_approach[held] * 1e6, found.x[:14][held], rtol=1e-5)


def test_profile_takes_the_load_off_the_ends():
    straight, crowned = solve(many(14), 5000.0), solve(many(14, profile="logarithmic"), 5000.0)
    np.testing.assert_allclose(straight.inner_line_load[0], straight.inner_load[0] / 11e-3, rtol=1e-12)
    line = crowned.inner_line_load[0]
    assert np.argmax(line) == 20
    assert np.all(np.diff(line[20:]) <= 0.0)
    np.testing.assert_allclose(line, line[::-1], rtol=1e-9)
    assert crowned.inner_load[0] > straight.inner_load[0]


def test_slices_converge():
    """Load of the roller on the load line with 41 slices against 401."""
    loads = [solve(NU208, 8000.0, slices=n).inner_load[0] for n in (41, 401)]
    assert loads[0] == pytest.approx(loads[1], rel=1e-3, abs=0.0)


def test_unloaded_rollers():
    """At speed at the outer ring, pressed in by F_c; at rest in the middle."""
    fast = solve(NU208, 3000.0, 0.0, 9000 * RPM)
    free = fast.inner_load == 0.0
    np.testing.assert_allclose(fast.outer_load[free], fast.centrifugal_force, rtol=1e-9)
    play = 10e-6 - fast.radial_displacement * np.cos(fast.position)
    np.testing.assert_allclose(fast.inner_gap[free], (play + fast.outer_approach)[free], rtol=1e-9)
    assert not fast.outer_gap.any()
    # Mass rho pi D^2 L/4 on d_m/2 at the cage's speed, half of (1 - D/d_m) of the ring's.
    force = DENSITY * np.pi / 4 * 11e-3**3 * 30e-3 * (0.5 * (1 - 11 / 60) * 9000 * RPM) ** 2
    assert fast.centrifugal_force == pytest.approx(force, rel=1e-12, abs=0.0)
    middle = solve(NU208, 3000.0)
    free = middle.inner_load == 0.0
    np.testing.assert_array_equal(middle.inner_gap[free], middle.outer_gap[free])


@each(
    "duty, other, message",
    [
        ((500.0, 10.0), {}, "^axial_load: .* 10 N.* 0"),
        ((0.0, 10.0), {}, "^axial_load: .* 10 N.* 0"),
        ((500.0,), {"slices": 40}, "^slices: .* 40.* 31"),
        ((500.0,), {"slices": 29}, "^slices: .* 29.* 31"),
    ],
)
def test_what_it_cannot_do(duty, other, message):
    with pytest.raises(InputError, match=message):
        solve(NU208, *duty, **other)
