"""Modified interpolation of Akima against SciPy."""

import numpy as np
import pytest
from scipy.interpolate import Akima1DInterpolator

from ehlectric.formulas.akima import with_middles


@pytest.mark.parametrize("number", [3, 4, 40])
@pytest.mark.parametrize("axis", [0, 1])
def test_values_half_way_are_as_of_scipy(number, axis):
    random = np.random.default_rng(7)
    nodes = np.cumsum(random.uniform(0.2, 1.0, number))
    values = np.cumsum(random.normal(size=(number, 5)), axis=0)
    values[: number // 2] = np.round(values[: number // 2])  # some chords are level
    values = np.moveaxis(values, 0, axis)
    fine = np.sort(np.concatenate([nodes, 0.5 * (nodes[1:] + nodes[:-1])]))
    expected = Akima1DInterpolator(nodes, values, axis=axis, method="makima")(fine)
    assert with_middles(nodes, values, axis) == pytest.approx(expected, rel=1e-13, abs=1e-13)
