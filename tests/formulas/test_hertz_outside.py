"""Deflection by polynomials against that of elliptic integrals."""

import numpy as np
import pytest

from ehlectric.formulas.hertz import DryContact, point_deflection
from ehlectric.formulas.hertz_outside import unit_deflection


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("ratio", [0.02, 0.5, 1.0, 1.0 + 1e-9, 3.0, 9.3, 50.0])
@pytest.mark.parametrize("number", [40, 5000])
def test_deflection_is_that_of_elliptic_integrals(ratio, number):
    """Points inside the ellipse, on both axes and up to a thousand semi-axes away."""
    draw = np.random.default_rng(5)
    x, y = np.exp(draw.uniform(-4.0, 7.0, (2, number)))
    x[::7], y[::5] = 0.0, 0.0
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=ratio, max_pressure=1.0, approach=0.0)
    expected = point_deflection(x, y, unit, 1.0) / ratio
    assert unit_deflection(x**2, y**2, ratio) == pytest.approx(expected, rel=3e-13, abs=0.0)


def test_contacts_of_several_ratios():
    draw = np.random.default_rng(6)
    x2, y2 = np.exp(draw.uniform(0.0, 8.0, (2, 3, 1000)))
    ratios = np.array([[2.0], [5.0], [9.0]])
    found = unit_deflection(x2, y2, ratios)
    for k, ratio in enumerate((2.0, 5.0, 9.0)):
        assert found[k] == pytest.approx(unit_deflection(x2[k], y2[k], ratio), rel=1e-12)
    assert unit_deflection(np.empty(0), np.empty(0), ratios[:0, 0]).shape == (0,)
