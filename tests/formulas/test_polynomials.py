"""Interpolation, derivatives and quadrature on nodes, which are exact for some polynomials."""

import numpy as np
import pytest

from ehlectric.formulas.polynomials import (
    derivative_matrix,
    interpolation,
    lobatto_nodes,
    lobatto_weights,
    on_nodes,
)


def test_values_on_another_grid_are_exact_for_products_of_lines():
    """(1 + 2x)(3 - y) times a number of each layer; along both axes, and along one of them."""
    old, new = (
        (np.array([0.0, 1.0, 3.0]), np.linspace(-1.0, 1.0, 5)),
        (np.linspace(0.2, 2.9, 7), np.array([-0.3, 0.9])),
    )
    layers = np.array([1.0, -2.0])[:, np.newaxis, np.newaxis]

    def values(x, y):
        return layers * (1.0 + 2.0 * x[:, np.newaxis]) * (3.0 - y)

    for axes in (new, (new[0], old[1]), (old[0], new[1])):
        assert on_nodes(values(*old), old, axes) == pytest.approx(values(*axes), rel=1e-12)


@pytest.mark.parametrize("degree", [2, 3, 7])
def test_nodes_are_exact_for_polynomials_of_their_degree(degree):
    """Values and derivatives up to the degree, integrals from 0 to 1 up to twice the degree less one."""
    nodes, at = lobatto_nodes(degree), np.array([0.07, 0.5, 0.81])
    for power in range(degree + 1):
        assert interpolation(nodes, at) @ nodes**power == pytest.approx(at**power, rel=1e-10)
        slope = power * nodes ** max(power - 1, 0)
        assert derivative_matrix(nodes) @ nodes**power == pytest.approx(slope, rel=1e-10, abs=1e-10)
    for power in range(2 * degree):
        assert lobatto_weights(nodes) @ nodes**power == pytest.approx(1.0 / (power + 1), rel=1e-12)
