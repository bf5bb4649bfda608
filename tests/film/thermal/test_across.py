"""Derivative and conduction across the film against polynomials."""

import numpy as np

from ehlectric.film.across_film import Across
from ehlectric.film.energy_equation import conduction
from tests.helpers.each import each


@each("degree", [2, 7, 12, 23])
def test_derivative_of_polynomials(degree):
    across = Across.of(degree)
    zeta = across.zeta
    np.testing.assert_allclose(across.derivative @ zeta**degree, degree * zeta ** (degree - 1), atol=1e-9)


def test_conduction_conserves_heat():
    nodes = Across.of(8)
    matrix = conduction(nodes, 1.0 + nodes.zeta**2)
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-11)
    np.testing.assert_allclose(matrix.sum(axis=0), 0.0, atol=1e-10)


def test_conduction_of_a_parabola():
    # -(k T')' = 2 between surfaces at T = 0 with k = 1 has T = zeta (1 - zeta); the weak form is exact.
    nodes = Across.of(6)
    inner = slice(1, -1)
    matrix = conduction(nodes, np.ones(7))[inner, inner]
    found = np.linalg.solve(matrix, 2.0 * nodes.weights[inner])
    np.testing.assert_allclose(found, (nodes.zeta * (1.0 - nodes.zeta))[inner], rtol=1e-12)
