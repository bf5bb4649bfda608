"""Elastic deflection of the Hertz pressure against its exact value."""

import numpy as np
import pytest

from ehlectric.film.deflection import Deflection, line_influence
from ehlectric.formulas.hertz import line_gap, line_pressure

pytestmark = pytest.mark.convergence

# Dry H00 of the Hertz contact: -(1/2)(ln 2 + 1/2).
DRY_H00 = -0.5 * (np.log(2.0) + 0.5)


def deflection_of_hertz(nodes):
    x = np.linspace(-4.0, 2.0, nodes)
    operator = Deflection.from_influence(line_influence(nodes, x[1] - x[0]))
    return x, operator(line_pressure(x)[:, np.newaxis])[:, 0]


def test_dry_contact():
    x, opened = deflection_of_hertz(25_601)
    gap = DRY_H00 + 0.5 * x**2 + opened
    assert pytest.approx(-0.59657, abs=5e-6) == DRY_H00
    np.testing.assert_allclose(opened[np.abs(x) < 1], (-DRY_H00 - 0.5 * x**2)[np.abs(x) < 1], atol=5e-6)
    np.testing.assert_allclose(gap, line_gap(x), atol=5e-6)


def test_order_for_the_hertz_pressure(slope):
    """1.5: the pressure has a square-root edge, and its cells an error of dX^(3/2) there."""
    nodes = np.array([401, 801, 1601, 3201, 6401, 12801])
    errors = []
    for n in nodes:
        x, opened = deflection_of_hertz(n)
        inside = np.abs(x) < 0.9
        errors.append(np.sqrt(np.mean((opened + DRY_H00 + 0.5 * x**2)[inside] ** 2)))
    assert 1.3 < slope(6.0 / (nodes - 1), errors) < 2.1


def test_order_for_a_smooth_pressure(slope):
    """2, for P = (1 - X^2)^2, whose deflection follows by quadrature of the logarithm."""
    points, weights = np.polynomial.legendre.leggauss(400)
    at = np.linspace(-0.75, 0.75, 7)

    def exact(x):
        total = 0.0
        for low, high in ((-1.0, x), (x, 1.0)):
            # Distances from x that go as u^4 cluster the points at the singularity.
            u = 0.5 * (points + 1.0)
            length = high - low
            t = x + (length if low == x else -length) * u**4
            jacobian = 0.5 * weights * 4 * u**3 * length
            total += np.sum(jacobian * np.log(length * u**4) * (1 - t**2) ** 2)
        return -total / np.pi

    reference = np.array([exact(x) for x in at])
    nodes = np.array([129, 257, 513, 1025])
    errors = []
    for n in nodes:
        x = np.linspace(-2.0, 2.0, n)
        pressure = np.maximum(0.0, 1.0 - x**2) ** 2
        opened = Deflection.from_influence(line_influence(n, x[1] - x[0]))(pressure[:, np.newaxis])
        errors.append(np.max(np.abs(np.interp(at, x, opened[:, 0]) - reference)))
    assert slope(4.0 / (nodes - 1), errors) == pytest.approx(2.0, abs=0.15)
