"""Derivatives of the discretised Reynolds equation, and its conservation of mass."""

import numpy as np
import pytest

from ehlectric.film import reynolds
from ehlectric.film.flow import Fluid, evaluate, flow
from ehlectric.film.mesh import Mesh
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.viscosity import roelands

SHAPE = (40, 3)
DX = 0.1
MESH = Mesh(DX * np.arange(SHAPE[0]), np.zeros(1))  # three lines that do not feel each other


def fluid(ambient=0.0):
    law = {"pressure_viscosity_coefficient": 8.0, "roelands_z": 0.67, "roelands_pressure": 0.3}
    return Fluid(
        density=lambda p: dowson_higginson(p, density_c1=0.6, density_c2=1.34),
        log_viscosity=lambda p: roelands(p, **law),
        velocity_parameter=0.05,
        ambient_pressure=ambient,
    )


@pytest.fixture
def state():
    random = np.random.default_rng(1)
    return 0.2 + random.random(SHAPE), 0.5 + random.random(SHAPE), random.standard_normal(SHAPE)


def residual(pressure, thickness, *, second_order):
    wedge = reynolds.wedge_stencil(SHAPE, DX, second_order=second_order)
    return reynolds.residual(flow(fluid(), pressure, thickness, MESH), wedge, thickness, MESH)


@pytest.mark.parametrize("second_order", [False, True])
def test_linearisation_is_the_derivative(state, second_order):
    pressure, thickness, change = state
    wedge = reynolds.wedge_stencil(SHAPE, DX, second_order=second_order)
    by_p, by_h = reynolds.linearise(flow(fluid(), pressure, thickness, MESH), wedge, thickness, MESH)
    step = 1e-6
    for stencil, along_p, along_h in ((by_p, change, 0.0), (by_h, 0.0, change)):
        forward = residual(pressure + step * along_p, thickness + step * along_h, second_order=second_order)
        back = residual(pressure - step * along_p, thickness - step * along_h, second_order=second_order)
        difference = (forward - back) / (2 * step)
        np.testing.assert_allclose(stencil(change), difference, rtol=1e-6, atol=1e-6 * np.max(difference))


def test_stencil_matrix_is_the_operator(state):
    stencil = reynolds.wedge_stencil((SHAPE[0], 1), DX, second_order=True)
    values = state[0][:, :1]
    np.testing.assert_allclose((stencil.matrix() @ values), stencil(values), atol=1e-12)


@pytest.mark.parametrize("second_order", [False, True])
def test_residual_sums_to_the_flow_through_the_ends(state, second_order):
    """Conservation: the rows are differences of one flux, so their sum is that of the two ends."""
    pressure, thickness, _ = state
    coefficients = evaluate(fluid(), pressure, thickness)
    mass = coefficients.density * thickness
    face = 0.5 * (coefficients.eps[1:] + coefficients.eps[:-1]) * np.diff(pressure, axis=0) / DX
    if second_order:
        entering = 0.5 * (mass[0] + mass[1]) - face[0]
        leaving = 1.5 * mass[-2] - 0.5 * mass[-3] - face[-1]
    else:
        entering, leaving = mass[0] - face[0], mass[-2] - face[-1]
    total = DX * residual(pressure, thickness, second_order=second_order).sum(axis=0)
    np.testing.assert_allclose(total, leaving - entering, rtol=1e-9)


def test_coefficients_below_ambient_are_those_at_ambient():
    thickness = np.ones((5, 1))
    below, lower, at = (evaluate(fluid(0.1), np.full((5, 1), p), thickness) for p in (-0.5, 0.05, 0.1))
    for name in ("eps", "density"):
        np.testing.assert_array_equal(getattr(below, name), getattr(at, name))
        np.testing.assert_array_equal(getattr(lower, name), getattr(at, name))
