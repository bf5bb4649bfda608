"""Limits and symmetries of the field of point contacts, and parts of its map."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.constants import epsilon_0

from ehlectric.errors import ConvergenceError, InputError
from ehlectric.field import poisson_3d
from ehlectric.field.point_field import solve_point_field
from ehlectric.field.poisson_3d import PointFieldProblem
from ehlectric.field.zones import area_above, node_areas, zone_areas
from ehlectric.formulas.polynomials import lobatto_nodes
from tests.field.exact_fields import near
from tests.helpers.each import each

# Uneven columns, 30 um by 20 um.
X = 1e-5 * np.linspace(-1.5, 1.5, 31) + 1e-6 * np.sin(np.linspace(-3, 3, 31))
Y = 2e-5 * np.linspace(0, 1, 24) ** 1.2
AREA = (X[-1] - X[0]) * Y[-1]
FLAT = np.zeros((X.size, Y.size))


def plates(**changes):
    values = {"x": X, "y": Y, "lower": FLAT, "upper": FLAT + 1e-6, "permittivity": 2.5 + FLAT}
    values |= {"potential_1": 1.0, "potential_2": -2.0} | changes
    return PointFieldProblem(**values)


def wavy(**changes):
    x, y = X[:, np.newaxis], Y
    lower = -2e-7 + 5e-8 * np.sin(8e5 * x + 3e5 * y)
    upper = 4e-7 + 1e-7 * np.cos(5e5 * x) * np.cos(2e5 * y) + 3e-8 * np.sin(6e5 * y)
    values = {"lower": lower, "upper": upper, "permittivity": 2.4 + 2e4 * x - 1e4 * y}
    return plates(**(values | {"potential_1": -1.0, "potential_2": 1.0} | changes))


@each("degree", [2, 3, 5, 6, 8, 12])
def test_parallel_plates(degree):
    field = solve_point_field(plates(degree=degree))
    np.testing.assert_allclose(field.strength, 3e6, rtol=1e-9)
    np.testing.assert_allclose(field.field_z, 3e6, rtol=1e-9)
    np.testing.assert_allclose(field.middle_strength, 3e6, rtol=1e-9)
    np.testing.assert_allclose(field.thin_gap_strength, 3e6, rtol=1e-12)
    exact = epsilon_0 * 2.5 * AREA / 1e-6
    assert field.capacitance == near(exact, 1e-10)
    assert field.capacitance_by_charge == near(exact, 1e-10)
    assert field.thin_gap_capacitance == near(exact, 1e-10)
    np.testing.assert_allclose(field.capacitance_density, epsilon_0 * 2.5 / 1e-6, rtol=1e-9)
    assert field.high_field_area == near(AREA, 1e-12)


def test_plates_with_uniform_charge():
    """V = z(V12/h) + rho z (h - z)/(2 eps0 eps), the parabola of a uniform charge."""
    h, density = 1e-6, 50.0
    charge = np.full((X.size, Y.size, 7), density)
    field = solve_point_field(plates(potential_1=0.0, potential_2=1.0, charge_density=charge))
    exact = field.z / h + density * field.z * (h - field.z) / (2 * epsilon_0 * 2.5)
    np.testing.assert_allclose(field.potential, exact, atol=1e-9)
    assert field.capacitance == near(epsilon_0 * 2.5 * AREA / h, 1e-10)


def test_layers_in_series():
    """A permittivity 1/(1 + s) across the gap: C = eps0 A/(h times the integral of 1 + s)."""
    layers = np.broadcast_to(1 / (1 + lobatto_nodes(12)), (X.size, Y.size, 13))
    field = solve_point_field(plates(permittivity=layers, degree=12))
    exact = epsilon_0 / 1.5 * AREA / 1e-6
    assert field.capacitance == near(exact, 1e-7)
    assert field.thin_gap_capacitance == near(exact, 1e-7)


def test_permittivity_by_column_is_that_by_node():
    by_column = wavy()
    by_node = wavy(permittivity=np.repeat(by_column.permittivity[:, :, np.newaxis], 7, axis=2))
    one, other = solve_point_field(by_column), solve_point_field(by_node)
    np.testing.assert_allclose(one.strength, other.strength, rtol=1e-9)
    assert one.permittivity.shape == other.permittivity.shape == one.potential.shape


@pytest.mark.slow
@pytest.mark.gate
@settings(max_examples=10, deadline=None)
@given(scale=st.floats(1e-3, 1e4), offset=st.floats(-1e3, 1e3))
def test_voltage_scales_and_shifts_the_field(scale, offset):
    base = solve_point_field(wavy())
    field = solve_point_field(wavy(potential_1=offset - scale, potential_2=offset + scale))
    np.testing.assert_allclose(field.strength, scale * base.strength, rtol=1e-7)
    assert field.capacitance == near(base.capacitance, 1e-9)
    assert field.high_field_area == near(base.high_field_area, 1e-6)


def test_exchange_of_the_surfaces_turns_the_field():
    base = wavy()
    field = solve_point_field(base)
    turned = solve_point_field(wavy(lower=-base.upper, upper=-base.lower))
    np.testing.assert_allclose(turned.strength, field.strength[:, :, ::-1], rtol=1e-9)
    np.testing.assert_allclose(turned.surface_1_strength, field.surface_2_strength, rtol=1e-9)
    assert {turned.max_strength_wall, field.max_strength_wall} == {"surface 1", "surface 2"}
    assert turned.max_strength_position == field.max_strength_position


def test_exchange_of_x_and_y_turns_the_field():
    base = wavy()
    turned = {name: getattr(base, name).T for name in ("lower", "upper", "permittivity")}
    field, other = solve_point_field(base), solve_point_field(wavy(x=Y, y=X, **turned))
    scale = 1e-9 * field.max_strength
    np.testing.assert_allclose(np.swapaxes(other.field_y, 0, 1), field.field_x, atol=scale)
    np.testing.assert_allclose(np.swapaxes(other.field_x, 0, 1), field.field_y, atol=scale)
    np.testing.assert_allclose(other.capacitance_density.T, field.capacitance_density, rtol=1e-9)
    assert other.max_strength_position == field.max_strength_position[::-1]


def half_and_whole():
    """A half domain and the whole, symmetric in y, with charge and layers."""
    y = np.concatenate([-Y[:0:-1], Y])
    half, whole = (
        plates(
            y=at,
            lower=-1e-7 * np.cos(4e5 * at) + 5e-8 * np.sin(4e5 * X[:, np.newaxis]),
            upper=1e-6 + 2e-7 * np.cos(3e5 * at) * np.cos(5e5 * X[:, np.newaxis]),
            permittivity=2 + np.cos(2e5 * at)[:, np.newaxis] * lobatto_nodes(6) + FLAT[:, :1, np.newaxis],
            charge_density=30 * np.cos(5e5 * at)[:, np.newaxis] * lobatto_nodes(6) + FLAT[:, :1, np.newaxis],
        )
        for at in (Y, y)
    )
    return solve_point_field(half), solve_point_field(whole)


def test_half_a_symmetric_field_mirrored_is_the_whole():
    half, whole = half_and_whole()
    mirrored = half.mirrored()
    for attribute in dataclasses.fields(whole):
        if attribute.name == "iterations":
            continue
        value, exact = (getattr(field, attribute.name) for field in (mirrored, whole))
        if exact is None:
            assert value is None, attribute.name
            continue
        if attribute.name.startswith("field_"):
            exact, atol = np.asarray(exact), 1e-9 * whole.max_strength
        else:
            atol = 1e-9
        np.testing.assert_allclose(value, exact, rtol=1e-8, atol=atol, err_msg=attribute.name)
    assert mirrored.max_strength == near(whole.max_strength, 1e-9)
    assert mirrored.high_field_area == near(whole.high_field_area, 1e-6)
    assert np.vdot(mirrored.capacitance_density, node_areas(mirrored.x, mirrored.y)) == near(
        mirrored.capacitance_by_charge, 1e-12
    )


def test_only_a_field_from_the_plane_of_symmetry_is_mirrored():
    with pytest.raises(InputError, match="expected one that starts at y = 0"):
        solve_point_field(plates(y=Y + 1e-6)).mirrored()


def test_two_columns_are_too_few():
    two = np.zeros((2, Y.size))
    with pytest.raises(InputError, match="at least 3"):
        solve_point_field(
            plates(x=X[:2], lower=two, upper=two + 1e-6, permittivity=two + 1, charge_density=None)
        )


def test_a_field_that_does_not_converge_is_no_field(monkeypatch):
    monkeypatch.setattr(poisson_3d, "MAX_ITERATIONS", 2)
    with pytest.raises(ConvergenceError, match="did not converge in 2"):
        solve_point_field(wavy())


def test_inner_columns_are_three_gaps_from_every_face():
    field = solve_point_field(plates())
    x, y = X[:, np.newaxis], Y
    far = (x > X[0] + 3e-6) & (x < X[-1] - 3e-6) & (y > 3e-6) & (y < Y[-1] - 3e-6)
    np.testing.assert_array_equal(field.inner, far)


waves = st.lists(st.floats(-0.3, 0.3), min_size=9, max_size=9)


def random_gap(lower, gap, permittivity):
    """Walls and permittivity of random waves that level off at the faces; the gap is a tenth of the range."""
    phases = [np.pi * np.arange(3)[:, np.newaxis] * (v - v[0]) / (v[-1] - v[0]) for v in (X, Y)]
    mean, height, eps = (
        np.cos(phases[0]).T @ np.reshape(c, (3, 3)) @ np.cos(phases[1]) for c in (lower, gap, permittivity)
    )
    return plates(
        lower=2e-6 * mean, upper=2e-6 * mean + 2e-6 * np.exp(height), permittivity=2.4 * np.exp(eps)
    )


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(lower=waves, gap=waves, permittivity=waves)
def test_energy_and_charge_give_one_capacitance_between_its_bounds(lower, gap, permittivity):
    """Thomson's bound with flux straight across, eps/h, and Dirichlet's with V = s."""
    problem = random_gap(lower, gap, permittivity)
    field = solve_point_field(problem)
    assert field.capacitance_by_charge == near(field.capacitance, 1e-9)
    h = problem.upper - problem.lower
    areas = node_areas(X, Y)
    straight = np.vdot(areas, epsilon_0 * problem.permittivity / h)
    square = np.ones_like(h)
    for axis, at in ((0, X), (1, Y)):
        slope, opening = (np.gradient(v, at, axis=axis, edge_order=2) for v in (problem.lower, h))
        square += slope**2 + slope * opening + opening**2 / 3
    linear = np.vdot(areas, epsilon_0 * problem.permittivity / h * square)
    # The columns are coarse here: trapezia and gradients differ from the elements by some parts in 1e-3.
    assert (1 - 1e-2) * straight <= field.capacitance <= (1 + 1e-2) * linear


def test_zones_add_up_to_the_capacitance():
    field = solve_point_field(wavy())
    assert field.capacitance_of(lambda x, _: np.ones_like(x)) == near(field.capacitance_by_charge, 1e-13)
    zones = [
        lambda x, y: np.hypot(x, y - 1e-5) < 5e-6,
        lambda x, y: (np.hypot(x, y - 1e-5) >= 5e-6) & (x < 1e-6),
        lambda x, y: (np.hypot(x, y - 1e-5) >= 5e-6) & (x >= 1e-6),
    ]
    parts = [field.capacitance_of(zone) for zone in zones]
    assert min(parts) > 0
    assert sum(parts) == near(field.capacitance_by_charge, 1e-13)
    assert field.capacitance_of(lambda x, _: x > 1.0) == 0.0


def test_zone_of_a_known_integral():
    """The integral of 1 + x + x y over the disc x^2 + (y - 1)^2 < 1/4 is its area, by symmetry; the columns
    are a fifth of its radius, and without division of the cells the error would be that of some cells.
    """
    x, y = np.linspace(-1, 1, 21), np.linspace(0, 2, 20)
    values = 1 + x[:, np.newaxis] + x[:, np.newaxis] * y
    disc = np.vdot(zone_areas(x, y, lambda x, y: np.hypot(x, y - 1) < 0.5), values)
    assert disc == near(np.pi / 4, 2e-3)
    # A straight boundary between samples is exact: half a cell's width of 0.1 in x, all of y.
    strip = zone_areas(x, y, lambda x, _: np.abs(x) < 0.25)
    assert np.vdot(strip, values) == near(0.5 * 2, 1e-12)


def two_peaks(columns):
    """A cosine's peak of 1 at the origin, a lower one, still above the level of 0.8, at x = 2."""
    x, y = np.linspace(-1.0, 3.0, 2 * columns - 1), np.linspace(-1.0, 1.0, columns + 1)
    radius = np.hypot(x[:, np.newaxis], 1.3 * y)
    other = np.hypot(x[:, np.newaxis] - 2.0, y)
    return x, y, np.maximum(np.cos(radius), 0.9 * np.cos(other))


def test_area_above_a_level_converges_with_the_square_of_the_spacing():
    """An ellipse, cos r >= 0.8 with r^2 = x^2 + (1.3 y)^2, and a circle, 0.9 cos r >= 0.8."""
    exact = np.pi * (np.arccos(0.8) ** 2 / 1.3 + np.arccos(0.8 / 0.9) ** 2)
    columns = np.array([20, 40, 80, 160, 320])
    errors = [abs(area_above(*two_peaks(n), 0.8) / exact - 1) for n in columns]
    assert errors[-1] < 1e-4
    # The place of the boundary in its cells scatters the errors about the second order.
    assert np.polyfit(np.log(1 / columns), np.log(errors), 1)[0] == pytest.approx(2.0, abs=0.3)


def test_area_above_a_level_of_a_plane_is_exact():
    """A linear map over uneven cells: the part of a rectangle beyond a straight line."""
    x, y = np.array([0.0, 0.3, 1.0]), np.array([0.0, 0.1, 0.7, 1.0])
    plane = x[:, np.newaxis] + y
    assert area_above(x, y, plane, 1.5) == near(0.125, 1e-12)
    assert area_above(x, y, plane, 0.5) == near(0.875, 1e-12)
    assert area_above(x, y, plane, 0.0) == near(1.0, 1e-12)


def test_high_field_area_of_a_known_shape():
    """E = V/h in a thin gap with h = h0 (1 + r^2/a^2): above 95 % where r^2 < a^2 (1/0.95 - 1)."""
    x, a = np.linspace(-1e-4, 1e-4, 121), 1.5e-4
    flat = np.zeros((x.size, x.size))
    upper = 1e-8 * (1 + (x[:, np.newaxis] ** 2 + x**2) / a**2)
    field = solve_point_field(PointFieldProblem(x, x, flat, upper, flat + 1, 0.0, 1.0))
    assert field.high_field_area == near(np.pi * a**2 * (1 / 0.95 - 1), 2e-3)
    assert field.max_strength_position == pytest.approx((0.0, 0.0), abs=1e-12)
