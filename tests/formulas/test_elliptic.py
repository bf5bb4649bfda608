"""Elliptic integrals of many arguments at once, against those of scipy one by one."""

import numpy as np
import pytest
from scipy.special import elliprd

from ehlectric.formulas.carlson import both_rd


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("size", [20, 700, 5000])
@pytest.mark.parametrize("spread", [0.0, 0.03, 0.5, 2.0, 6.0, 30.0])
def test_both_are_those_of_scipy(spread, size):
    draw = np.random.default_rng(1)
    x, y, z = np.exp(spread * draw.normal(size=(3, size)))
    x[::5] = 0.0
    first, second = both_rd(x, y, z)
    assert first == pytest.approx(elliprd(x, y, z), rel=2e-14)
    assert second == pytest.approx(elliprd(x, z, y), rel=2e-14)


def test_shapes_are_broadcast():
    first, second = both_rd(np.linspace(0.0, 3.0, 40)[:, None], np.linspace(1.0, 2.0, 30), np.ones(()))
    assert first.shape == second.shape == (40, 30)
    assert first[7, 3] == pytest.approx(elliprd(21.0 / 39.0, 1.0 + 3.0 / 29.0, 1.0), rel=1e-13)
    assert both_rd(np.zeros(0), np.ones(0), np.ones(0))[0].shape == (0,)
    assert np.shape(both_rd(np.float64(0.0), np.float64(1.0), np.float64(1.0))[0]) == ()
