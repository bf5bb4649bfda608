"""The next order of a thin gap against exact solutions, and the nodes it is summed over."""

import numpy as np
import pytest

from ehlectric.formulas.capacitances import charge_density, stretched
from tests.helpers.each import each


def observed_orders(errors, factor):
    return np.log(np.abs(errors[:-1]) / np.abs(errors[1:])) / np.log(factor)


@each("outer", [True, False])
@each("dimensions", [2, 3])
def test_concentric_circles_and_spheres(outer, dimensions):
    """The charge is (r/R)/(R - r) on spheres and 1/(R ln(R/r)) on cylinders: what is left is of second order.

    Of both surfaces either may be the near one; on the inner one the curvatures' signs are the others.
    """
    gaps = np.array([4e-2, 2e-2, 1e-2, 5e-3])
    near = 1.0 + gaps if outer else np.ones(4)
    exact = 1.0 / gaps if dimensions == 3 else 1.0 / np.log1p(gaps)
    exact *= (1.0 + gaps if dimensions == 3 else 1.0) / near ** (dimensions - 1)
    sign, sums = (1.0 if outer else -1.0), dimensions - 1
    far = 1.0 if outer else 1.0 + gaps
    found = charge_density(gaps, 0.0, sign * sums / far, sign * sums / near)
    assert observed_orders(found / exact - 1.0, 2.0) == pytest.approx(np.full(3, 2.0), abs=0.1)


@each("angle", [1e-3, 0.3, 1.0, 1.5])
def test_wedge(angle):
    """Between two planes field lines are arcs: the charge a distance 1 from the apex is 1/angle, exactly."""
    assert charge_density(np.sin(angle), angle, 0.0, 0.0) == pytest.approx(1.0 / angle, rel=1e-14, abs=0.0)


@each("scale", [1e-4, 1e-2, 1.0])
@each("ends", [(0.0, 1.0), (-0.4, 1.3), (0.2, 0.9)])
def test_stretched_nodes(scale, ends):
    """The integrals of 1/(s^2 + x^2) and of its root are atan(x/s)/s and asinh(x/s)."""
    x, weights = stretched(*ends, scale, 100)
    assert np.sum(weights) == pytest.approx(ends[1] - ends[0], rel=1e-12, abs=0.0)
    for power, exact in (
        (1.0, np.arctan(np.divide(ends, scale)) / scale),
        (0.5, np.arcsinh(np.divide(ends, scale))),
    ):
        found = np.sum(weights / (scale**2 + x**2) ** power)
        # Of the difference of two angles some digits are lost.
        lost = 1e-15 * np.max(np.abs(exact)) / abs(exact[1] - exact[0])
        assert found == pytest.approx(exact[1] - exact[0], rel=1e-12 + 10.0 * lost, abs=0.0)


def test_stretched_rows():
    """Ends and scales of several integrals at once give each its own row."""
    starts, scales = np.array([0.0, 0.5]), np.array([1e-3, 2.0])
    x, weights = stretched(starts, 1.0, scales, 20)
    assert x.shape == weights.shape == (2, 20)
    for k in range(2):
        alone = stretched(starts[k], 1.0, scales[k], 20)
        assert np.array_equal(x[k], alone[0])
        assert np.array_equal(weights[k], alone[1])
