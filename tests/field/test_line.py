"""Limits and symmetries of the field."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.constants import epsilon_0

from ehlectric.field.line_field import solve_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.formulas.polynomials import lobatto_nodes
from tests.helpers.each import each

X = np.linspace(-1e-4, 1e-4, 201)


def wavy(**changes):
    lower = -2e-7 + 5e-8 * np.sin(8e4 * X)
    upper = 4e-7 + 1e-7 * np.cos(5e4 * X)
    values = {"x": X, "lower": lower, "upper": upper, "permittivity": 2.4 + 2e3 * X}
    values |= {"potential_1": -1.0, "potential_2": 1.0} | changes
    return FieldProblem(**values)


@each("degree", [2, 3, 5, 6, 8, 12])
def test_parallel_plates(degree):
    field = solve_field(FieldProblem(X, 0 * X, 0 * X + 1e-6, 2.5 + 0 * X, 1.0, -2.0, degree=degree))
    np.testing.assert_allclose(field.strength, 3e6, rtol=1e-9)
    np.testing.assert_allclose(field.field_y, 3e6, rtol=1e-9)
    np.testing.assert_allclose(field.middle_strength, 3e6, rtol=1e-9)
    exact = epsilon_0 * 2.5 * 2e-4 / 1e-6
    assert field.capacitance == pytest.approx(exact, rel=1e-10, abs=0.0)
    assert field.capacitance_by_charge == pytest.approx(exact, rel=1e-10, abs=0.0)
    assert field.thin_gap_capacitance == pytest.approx(exact, rel=1e-10, abs=0.0)
    np.testing.assert_allclose(field.thin_gap_strength, 3e6, rtol=1e-12)


def test_plates_with_uniform_charge():
    """V = y(V12/h) + rho y (h - y)/(2 eps0 eps), the parabola of a uniform charge."""
    h, density = 1e-6, 50.0
    charge = np.full((X.size, 7), density)
    problem = FieldProblem(X, 0 * X, 0 * X + h, 2.0 + 0 * X, 0.0, 1.0, charge_density=charge)
    field = solve_field(problem)
    exact = field.y / h + density * field.y * (h - field.y) / (2 * epsilon_0 * 2.0)
    np.testing.assert_allclose(field.potential, exact, atol=1e-9)
    assert field.capacitance == pytest.approx(epsilon_0 * 2.0 * 2e-4 / h, rel=1e-10, abs=0.0)


def test_layers_in_series():
    """A permittivity 1/(1 + s) across the gap: C = eps0/(h times the integral of 1 + s)."""
    degree, h = 12, 1e-6
    s = lobatto_nodes(degree)
    layers = np.tile(1 / (1 + s), (X.size, 1))
    field = solve_field(FieldProblem(X, 0 * X, 0 * X + h, layers, 0.0, 1.0, degree=degree))
    exact = epsilon_0 / 1.5 * 2e-4 / h
    assert field.capacitance == pytest.approx(exact, rel=1e-7, abs=0.0)
    assert field.thin_gap_capacitance == pytest.approx(exact, rel=1e-7, abs=0.0)


@pytest.mark.slow
@given(scale=st.floats(1e-3, 1e4), offset=st.floats(-1e3, 1e3))
def test_voltage_scales_and_shifts_the_field(scale, offset):
    base = solve_field(wavy())
    field = solve_field(wavy(potential_1=offset - scale, potential_2=offset + scale))
    np.testing.assert_allclose(field.strength, scale * base.strength, rtol=1e-7)
    assert field.capacitance == pytest.approx(base.capacitance, rel=1e-9, abs=0.0)
    assert field.high_field_width == pytest.approx(base.high_field_width, rel=1e-6, abs=0.0)


def test_exchange_of_the_surfaces_mirrors_the_field():
    base = wavy()
    mirrored = solve_field(wavy(lower=-base.upper, upper=-base.lower))
    field = solve_field(base)
    np.testing.assert_allclose(mirrored.strength, field.strength[:, ::-1], rtol=1e-9)
    assert mirrored.max_strength == pytest.approx(field.max_strength, rel=1e-10, abs=0.0)


def test_mirror_along_x():
    base = wavy()
    flipped = {name: getattr(base, name)[::-1] for name in ("lower", "upper", "permittivity")}
    field, mirrored = solve_field(base), solve_field(wavy(**flipped))
    np.testing.assert_allclose(mirrored.strength[::-1], field.strength, rtol=1e-9)


def test_common_shift_of_the_walls_changes_nothing():
    base = wavy()
    # A common curvature does change it, at the order of the slope squared; a shift must not.
    shifted = solve_field(wavy(lower=base.lower + 3e-6, upper=base.upper + 3e-6))
    np.testing.assert_allclose(shifted.strength, solve_field(base).strength, rtol=1e-8)


def test_high_field_zone_of_a_known_shape():
    """E = V/h with h = h0 (1 + (x/a)^2): above 95 % where x/a < sqrt(1/0.95 - 1)."""
    a = 5e-5
    upper = 1e-8 * (1 + (X / a) ** 2)
    field = solve_field(FieldProblem(X, 0 * X, upper, 1 + 0 * X, 0.0, 1.0))
    assert field.high_field_width == pytest.approx(2 * a * np.sqrt(1 / 0.95 - 1), rel=1e-3, abs=0.0)
    assert field.max_strength_position == pytest.approx(0.0, abs=1e-6)


def test_high_field_zone_reaches_the_ends_of_a_uniform_field():
    field = solve_field(FieldProblem(X, 0 * X, 0 * X + 1e-6, 1 + 0 * X, 0.0, 1.0))
    assert field.high_field_zone == (X[0], X[-1])


waves = st.lists(st.floats(-0.4, 0.4), min_size=4, max_size=4)


def random_gap(lower, gap, permittivity, **changes):
    """Walls and permittivity of random waves that level off at the ends; the gap is the distance of both."""
    phase = np.pi * np.arange(1, 5)[:, np.newaxis] * (X - X[0]) / (X[-1] - X[0])
    mean, height = (coefficients @ np.cos(phase) for coefficients in (np.array(lower), np.array(gap)))
    values = {"x": X, "lower": 5e-6 * mean, "upper": 5e-6 * mean + 5e-6 * np.exp(height)}
    values |= {"permittivity": 2.4 * np.exp(np.array(permittivity) @ np.cos(phase))}
    return FieldProblem(**(values | {"potential_1": 3.0, "potential_2": -2.0} | changes))


@pytest.mark.slow
@pytest.mark.gate
@settings(deadline=None)
@given(lower=waves, gap=waves, permittivity=waves)
def test_energy_and_charge_give_one_capacitance(lower, gap, permittivity):
    field = solve_field(random_gap(lower, gap, permittivity))
    assert field.capacitance_by_charge == pytest.approx(field.capacitance, rel=1e-9, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@settings(deadline=None)
@given(lower=waves, gap=waves, permittivity=waves)
def test_capacitance_lies_between_its_variational_bounds(lower, gap, permittivity):
    """Thomson's with flux straight across, eps/h, and Dirichlet's with V = s."""
    problem = random_gap(lower, gap, permittivity)
    field = solve_field(problem)
    h = problem.upper - problem.lower
    slope, opening = np.gradient(problem.lower, X), np.gradient(h, X)
    straight = np.trapezoid(epsilon_0 * problem.permittivity / h, X)
    square = 1 + slope**2 + slope * opening + opening**2 / 3
    linear = np.trapezoid(epsilon_0 * problem.permittivity / h * square, X)
    # Walls between the columns are straight here, and trapezia and gradients smooth them: some parts in 1e-5.
    assert (1 - 3e-5) * straight <= field.capacitance <= (1 + 3e-5) * linear


@pytest.mark.slow
@pytest.mark.gate
@settings(deadline=None, max_examples=20)
@given(lower=waves, gap=waves, density=st.floats(-100.0, 100.0), voltage=st.floats(0.1, 100.0))
def test_voltage_and_charge_superpose(lower, gap, density, voltage):
    """V of both is that of the voltage and that of the charge; the capacitance knows of no charge."""
    charge = density * np.cos(3e4 * X)[:, np.newaxis] * np.linspace(0.5, 1.5, 7)

    def potential(volts, part):
        potentials = {"potential_1": 0.0, "potential_2": volts}
        field = solve_field(random_gap(lower, gap, waveless, charge_density=part * charge, **potentials))
        return field.potential, field.capacitance

    waveless = [0.0] * 4
    (both, with_charge), (double, _), (alone, without) = (
        potential(voltage, part) for part in (1.0, 2.0, 0.0)
    )
    np.testing.assert_allclose(double - both, both - alone, atol=1e-9 * (voltage + abs(density)))
    assert with_charge == pytest.approx(without, rel=1e-12, abs=0.0)
