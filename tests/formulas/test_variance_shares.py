"""Shares of the inputs in the variance of a function, against exact ones."""

import numpy as np
import pytest
from scipy.stats import qmc, sobol_indices, uniform

from ehlectric.formulas.variance_shares import variance_shares


def test_shares_of_an_additive_function_are_those_of_its_terms():
    """ln of a product of powers of inputs between 1 and 3: each has the variance of its power of ln(x)."""
    exponents = np.array([1.0, -0.5, 0.1])
    at = qmc.Sobol(3, seed=2).random(512)
    values = np.log(1.0 + 2.0 * at) @ exponents
    # Variance of ln(x) for x even from 1 to 3, by quadrature.
    nodes, weights = np.polynomial.legendre.leggauss(60)
    logs = np.log(2.0 + nodes)
    variance = 0.5 * weights @ logs**2 - (0.5 * weights @ logs) ** 2
    found = variance_shares(2.0 * at - 1.0, values)
    assert found.variance == pytest.approx(variance * np.sum(exponents**2), rel=2e-3)
    np.testing.assert_allclose(found.first, exponents**2 / np.sum(exponents**2), atol=1e-3)
    np.testing.assert_allclose(found.total, found.first, atol=1e-3)
    assert found.predicted > 0.999


def test_shares_are_those_of_an_independent_method():
    """SciPy's estimate from 3 x 2^16 points, by Saltelli's formulas."""

    def function(x):
        return np.exp(0.6 * x[0] + 0.3 * x[1]) * (1.0 + 0.4 * x[2] * x[0])

    at = qmc.Sobol(3, seed=3).random(2048)
    found = variance_shares(2.0 * at - 1.0, function(2.0 * at.T - 1.0))
    expected = sobol_indices(
        func=lambda x: function(x), n=2**14, dists=[uniform(loc=-1.0, scale=2.0)] * 3, rng=1
    )
    np.testing.assert_allclose(found.first, expected.first_order, atol=5e-3)
    np.testing.assert_allclose(found.total, expected.total_order, atol=5e-3)


def test_a_rough_function_is_hardly_predicted():
    at = qmc.Sobol(2, seed=4).random(512)
    found = variance_shares(2.0 * at - 1.0, np.sign(np.sin(40.0 * at[:, 0] + 31.0 * at[:, 1])))
    assert found.predicted < 0.2


def test_few_points_have_a_polynomial_of_lower_degree():
    at = qmc.Sobol(6, seed=5).random(32)
    found = variance_shares(2.0 * at - 1.0, at @ np.arange(1.0, 7.0))
    np.testing.assert_allclose(found.first, np.arange(1.0, 7.0) ** 2 / 91.0, rtol=1e-9)
