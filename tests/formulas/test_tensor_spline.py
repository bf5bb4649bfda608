"""Splines and monotone cubics against polynomials, which splines contain, and against SciPy."""

import numpy as np
import pytest
from scipy.interpolate import NdBSpline, PchipInterpolator, RectBivariateSpline, make_interp_spline

from ehlectric.formulas.monotone_cubic import along_axis
from ehlectric.formulas.tensor_spline import TensorSpline


def grid(random, *sizes):
    return [np.sort(random.uniform(-2.0, 3.0, size)) for size in sizes]


def inside(random, axes, number=200):
    return np.stack([random.uniform(axis[0], axis[-1], number) for axis in axes], axis=-1)


@pytest.mark.parametrize("sizes", [(6,), (9, 5), (7, 4, 8)])
def test_cubics_are_met_exactly(sizes):
    random = np.random.default_rng(3)
    axes = grid(random, *sizes)
    powers = random.integers(0, 4, (2, len(sizes)))

    def cubics(points):
        return np.stack([np.prod(points**power, axis=-1) for power in powers], axis=-1)

    values = cubics(np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1))
    points = inside(random, axes)
    np.testing.assert_allclose(
        TensorSpline.through(axes, values)(points), cubics(points), rtol=1e-8, atol=1e-8
    )


@pytest.mark.parametrize(("sizes", "degree"), [((12, 3, 2), 3), ((5, 6), 1), ((8, 4, 7), 3)])
def test_splines_are_those_of_scipy(sizes, degree):
    random = np.random.default_rng(5)
    axes = grid(random, *sizes)
    values = random.normal(size=(*sizes, 2))
    knots, degrees, coefficients = [], [], values
    for number, axis in enumerate(axes):
        k = min(degree, axis.size - 1)
        along = make_interp_spline(axis, np.moveaxis(coefficients, number, 0), k)
        coefficients = np.moveaxis(along.c, 0, number)
        knots.append(along.t)
        degrees.append(k)
    expected = NdBSpline(tuple(knots), np.ascontiguousarray(coefficients), tuple(degrees))
    corners = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    points = np.concatenate([inside(random, axes, 3000), corners.reshape(-1, len(sizes))])
    np.testing.assert_allclose(
        TensorSpline.through(axes, values, degree)(points), expected(points), rtol=1e-9, atol=1e-9
    )


def test_values_on_a_grid_are_those_of_scipy():
    random = np.random.default_rng(7)
    axes = grid(random, 15, 12)
    values = random.normal(size=(15, 12))
    fine = [np.linspace(axis[0], axis[-1], 40) for axis in axes]
    spline = TensorSpline.through(axes, values[..., np.newaxis])
    expected = RectBivariateSpline(*axes, values)(*fine)
    np.testing.assert_allclose(spline.on_grid(fine)[..., 0], expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("axis", [0, 1])
def test_monotone_cubics_along_an_axis_are_those_of_scipy(axis):
    random = np.random.default_rng(9)
    (nodes,) = grid(random, 12)
    values = random.normal(size=(12, 5) if axis == 0 else (5, 12))
    fine = np.linspace(nodes[0], nodes[-1], 40)
    expected = PchipInterpolator(nodes, values, axis=axis)(fine)
    np.testing.assert_allclose(along_axis(nodes, values, fine, axis), expected, rtol=1e-12, atol=1e-12)
