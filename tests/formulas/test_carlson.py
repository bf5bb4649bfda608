"""Complete elliptic integrals against SciPy's, which are an independent program, and the circle by hand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import elliprd, elliprf

from ehlectric.formulas.carlson import complete_rd, complete_rd_pair, complete_rf

POSITIVE = st.floats(1e-6, 1e6)


@given(POSITIVE, POSITIVE)
def test_values_are_those_of_scipy(y, z):
    first, second = complete_rd_pair(y, z)
    assert first == pytest.approx(elliprd(0.0, y, z), rel=2e-14)
    assert second == pytest.approx(elliprd(0.0, z, y), rel=2e-14)
    assert complete_rf(y, z) == pytest.approx(elliprf(0.0, y, z), rel=1e-14)


def test_nearly_equal_arguments_lose_no_digits():
    y = 1.0 + np.linspace(-1e-7, 1e-7, 41)
    np.testing.assert_allclose(complete_rd_pair(y, 1.0)[0], elliprd(0.0, y, 1.0), rtol=1e-14)


def test_circle():
    """R_D(0, 1, 1) = 3 pi/4 and R_F(0, 1, 1) = pi/2."""
    assert complete_rd(1.0, 1.0) == pytest.approx(0.75 * math.pi, rel=1e-15)
    assert complete_rf(1.0, 1.0) == pytest.approx(0.5 * math.pi, rel=1e-15)
