"""Where figures of a sweep say that the film breaks down, between points that are far apart."""

import numpy as np
import pytest

from ehlectric import Case, solve
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from tests.figures.sweep.test_save import VALUE, curves, line_of_breakdown
from tests.helpers.sweep_models import LOAD, POTENTIAL, SPEED, grid


@pytest.mark.slow
def test_line_is_exact_over_the_voltage_itself():
    """10 V at any voltage V = V_2 + 1 V, so that the line lies at V_2 = 9 V between any two voltages."""
    for speeds, volts in (((4.0, 8.0), (3.0, 19.0)), ((4.0, 8.0, 16.0), (1.0, 3.0, 29.0))):
        for value in (VALUE, "discharge.margin"):
            ax = value_map(grid({SPEED: speeds, POTENTIAL: volts}), SPEED, POTENTIAL, value)
            x, y = line_of_breakdown(ax).T
            # The model has 10 V at 4 m/s; linear within the small triangles of the figure.
            assert y[np.argmin(x)] == pytest.approx(9.0, rel=1e-3)
    lines = value_lines(grid({POTENTIAL: (1.0, 3.0, 29.0)}), POTENTIAL, None, "discharge.margin")
    (line,) = curves(lines)
    np.testing.assert_allclose(line.get_ydata(), 10.0 / (line.get_xdata() + 1.0), rtol=1e-12)


def test_lines_between_points_are_those_of_the_map():
    """Powers of the speed between points a factor of four apart, on a logarithmic axis."""
    (line,) = curves(value_lines(grid({SPEED: (0.5, 2.0, 8.0)}), SPEED, None, VALUE))
    np.testing.assert_allclose(line.get_ydata(), 10.0 * (line.get_xdata() / 4.0) ** 0.7, rtol=1e-12)


def test_crossing_is_not_on_the_unsafe_side():
    """V_b = a u^0.72 of the README's grid: 5.624 V at 2 m/s is 8 V at 2 (8/5.624)^(1/0.72) = 3.262 m/s.

    Straight lines over the logarithm of the speed had 8 V at a lower one.
    """

    def model(inputs):
        strength = 5.624 * (inputs[SPEED] / 2.0) ** 0.72
        return {
            "field": {"voltage": 8.0},
            "discharge": {"breakdown_voltage": strength, "margin": strength / 8.0},
        }

    ax = value_map(grid({SPEED: (1.0, 2.0, 4.0), LOAD: (1e6, 2e6)}, model), SPEED, LOAD, VALUE)
    x, _ = line_of_breakdown(ax).T
    np.testing.assert_allclose(x, 2.0 * (8.0 / 5.624) ** (1.0 / 0.72), rtol=1e-4)


@pytest.mark.slow
def test_a_contact_on_the_line_breaks_down_at_the_applied_voltage():
    """Solved where a line between 2 and 4 m/s says 8 V, at 2 MN/m: V_b is nearly a power of u."""
    contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "load_per_length": "2 MN/m"}
    table = {
        "contact": contact | {"entrainment_speed": "2 m/s"},
        "lubricant": {"base": "paper"},
        "electric": {"potential_1": 0.0, "potential_2": 8.0},
        "discharge": {"dielectric_strength": "15 V/um"},
        "grid": {"nodes": 3201},
    }
    case = Case.from_dict(table)

    def model(inputs):
        return solve(case.replace({SPEED: inputs[SPEED]})).summary()

    (line,) = curves(value_lines(grid({SPEED: (1.0, 2.0, 4.0)}, model), SPEED, None, VALUE))
    crossing = float(np.interp(8.0, line.get_ydata(), line.get_xdata()))
    assert 2.0 < crossing < 4.0
    solved = model({SPEED: crossing})
    assert solved["discharge"]["breakdown_voltage"] == pytest.approx(8.0, rel=1e-3)
