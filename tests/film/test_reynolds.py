"""Derivatives of the discretised Reynolds equation, and its conservation of mass."""

import numpy as np
import pytest

from ehlectric.film import reynolds
from ehlectric.film.face_flow import MEAN_MOBILITY, Fluid, evaluate, flow
from ehlectric.film.mesh import Mesh
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.viscosity import roelands
from tests.helpers.each import each

SHAPE = (40, 3)
DX = 0.1
MESH = Mesh(DX * np.arange(SHAPE[0]), np.zeros(1))  # three lines that do not feel each other


def fluid(ambient=0.0, law="newtonian"):
    roelands_of = {"pressure_viscosity_coefficient": 8.0, "roelands_z": 0.67, "roelands_pressure": 0.3}
    return Fluid(
        density=lambda p: dowson_higginson(p, density_c1=0.6, density_c2=1.34),
        log_viscosity=lambda p: roelands(p, **roelands_of),
        velocity_parameter=0.05,
        ambient_pressure=ambient,
        flow=law,
    )


def through_faces(pressure, thickness, spacing, law):
    """Flux eps dP/dX through the faces along the first axis, by the two means of a Newtonian fluid."""
    k = evaluate(fluid(), pressure, thickness)
    gradient = np.diff(pressure, axis=0) / spacing
    if law == MEAN_MOBILITY:
        return 0.5 * (k.eps[1:] + k.eps[:-1]) * gradient
    density, gap = (0.5 * (values[1:] + values[:-1]) for values in (k.density, thickness))
    slope = np.diff(k.log_viscosity, axis=0)
    # The mean over the pressure between the nodes, where ln eta is linear.
    fluidity = np.exp(-k.log_viscosity[:-1]) * -np.expm1(-slope) / slope
    return density * gap**3 * fluidity * gradient / fluid().velocity_parameter


def entering_and_leaving(mass, wedge_order):
    """Mass that the wedge term carries through the first and the last inner face."""
    return {
        1: (mass[0], mass[-2]),
        2: (0.5 * (mass[0] + mass[1]), 1.5 * mass[-2] - 0.5 * mass[-3]),
        3: (0.5 * (mass[0] + mass[1]), (3.0 * mass[-1] + 6.0 * mass[-2] - mass[-3]) / 8.0),
    }[wedge_order]


LAWS = each("law", ["newtonian", MEAN_MOBILITY])


@pytest.fixture
def state():
    random = np.random.default_rng(1)
    return 0.2 + random.random(SHAPE), 0.5 + random.random(SHAPE), random.standard_normal(SHAPE)


def residual(pressure, thickness, *, wedge_order, law="newtonian"):
    wedge = reynolds.wedge_stencil(SHAPE, DX, order=wedge_order)
    return reynolds.residual(flow(fluid(law=law), pressure, thickness, MESH), wedge, thickness, MESH)


@LAWS
@each("wedge_order", [1, 2, 3])
def test_linearisation_is_the_derivative(state, wedge_order, law):
    pressure, thickness, change = state
    wedge = reynolds.wedge_stencil(SHAPE, DX, order=wedge_order)
    at_faces = flow(fluid(law=law), pressure, thickness, MESH)
    by_p, by_h = reynolds.linearise(at_faces, wedge, thickness, MESH)
    step = 1e-6
    for stencil, along_p, along_h in ((by_p, change, 0.0), (by_h, 0.0, change)):
        forward, back = (
            residual(pressure + s * along_p, thickness + s * along_h, wedge_order=wedge_order, law=law)
            for s in (step, -step)
        )
        difference = (forward - back) / (2 * step)
        np.testing.assert_allclose(stencil(change), difference, rtol=1e-6, atol=1e-6 * np.max(difference))


def test_stencil_matrix_is_the_operator(state):
    stencil = reynolds.wedge_stencil((SHAPE[0], 1), DX, order=2)
    values = state[0][:, :1]
    np.testing.assert_allclose((stencil.matrix() @ values), stencil(values), atol=1e-12)


@LAWS
@each("wedge_order", [1, 2, 3])
def test_residual_sums_to_the_flow_through_the_ends(state, wedge_order, law):
    """Conservation: the rows are differences of one flux, so their sum is that of the two ends."""
    pressure, thickness, _ = state
    mass = evaluate(fluid(), pressure, thickness).density * thickness
    face = through_faces(pressure, thickness, DX, law)
    entering, leaving = entering_and_leaving(mass, wedge_order)
    total = DX * residual(pressure, thickness, wedge_order=wedge_order, law=law).sum(axis=0)
    np.testing.assert_allclose(total, leaving - face[-1] - entering + face[0], rtol=1e-9)


def test_coefficients_below_ambient_are_those_at_ambient():
    thickness = np.ones((5, 1))
    below, lower, at = (evaluate(fluid(0.1), np.full((5, 1), p), thickness) for p in (-0.5, 0.05, 0.1))
    for name in ("eps", "density"):
        np.testing.assert_array_equal(getattr(below, name), getattr(at, name))
        np.testing.assert_array_equal(getattr(lower, name), getattr(at, name))
