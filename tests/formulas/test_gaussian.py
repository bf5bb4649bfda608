"""Integrals of exp(-x^2) against SciPy's, which are an independent program, and against limits by hand."""

import numpy as np
from scipy import special

from ehlectric.formulas.gaussian import dawson, erfc, normal_share


def test_values_are_those_of_scipy():
    x = np.concatenate([np.linspace(-6.0, 6.0, 241), [8.0, 20.0]])
    np.testing.assert_allclose(erfc(x), special.erfc(x), rtol=1e-13)
    np.testing.assert_allclose(normal_share(x), special.ndtr(x), rtol=1e-13)
    positive = np.geomspace(0.1, 1e8, 400)
    np.testing.assert_allclose(dawson(positive), special.dawsn(positive), rtol=2e-14)


def test_dawson_of_large_arguments_is_one_over_twice_the_argument():
    np.testing.assert_allclose(2.0 * np.array([1e5, 1e8]) * dawson([1e5, 1e8]), 1.0, rtol=1e-10)
