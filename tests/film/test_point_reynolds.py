"""The Reynolds equation over both axes: an exact solution, derivatives, symmetry, conservation of mass."""

import numpy as np
import pytest

from ehlectric.film import reynolds
from ehlectric.film.face_flow import Fluid, evaluate, flow
from ehlectric.film.mesh import Mesh, Width
from ehlectric.lubricant.density import incompressible
from ehlectric.lubricant.viscosity import constant_viscosity
from tests.film.test_reynolds import LAWS, entering_and_leaving, fluid, through_faces
from tests.helpers.each import each

NODES, NODES_Y = 24, 17
HALF, WHOLE = (Mesh.over(NODES, -2.0, 1.5, Width(NODES_Y, 2.4, symmetric=s)) for s in (True, False))
MESHES = each("mesh", [HALF, WHOLE])
ORDERS = each("wedge_order", [1, 2, 3])


def state(mesh, seed=1):
    random = np.random.default_rng(seed)
    return 0.2 + random.random(mesh.shape), 0.5 + random.random(mesh.shape)


def change_of(mesh):
    return np.random.default_rng(9).standard_normal(mesh.shape)


def residual(mesh, pressure, thickness, *, wedge_order, of=None):
    wedge = reynolds.wedge_stencil(mesh.shape, mesh.dx, order=wedge_order)
    at_faces = flow(of or fluid(), pressure, thickness, mesh)
    return reynolds.residual(at_faces, wedge, thickness, mesh)


def derivatives(mesh, pressure, thickness, *, wedge_order, law="newtonian"):
    wedge = reynolds.wedge_stencil(mesh.shape, mesh.dx, order=wedge_order)
    return reynolds.linearise(flow(fluid(law=law), pressure, thickness, mesh), wedge, thickness, mesh)


@pytest.mark.parametrize(("wedge_order", "order"), [(1, 1.0), (2, 2.0), (3, 2.0)])
def test_kapitzas_solution(wedge_order, order):
    """P = -lambda X/((3 + 2 D) H^2) between H = H0 + X^2/2 + D Y^2/2, of constant viscosity and density."""
    d, velocity = 0.7, 0.3
    rigid = Fluid(incompressible, constant_viscosity, velocity, ambient_pressure=-1e9)
    errors = []
    for nodes in (65, 129, 257):
        mesh = Mesh.over(nodes, -2.0, 1.5, Width(nodes, 2.4))
        x, y = mesh.x[:, np.newaxis], mesh.y
        thickness = 0.4 + 0.5 * x**2 + 0.5 * d * y**2
        pressure = -velocity * x / ((3.0 + 2.0 * d) * thickness**2)
        r = residual(mesh, pressure, thickness, wedge_order=wedge_order, of=rigid)
        # The first rows have no second upstream node: their flux is second-order, its difference is not.
        errors.append(np.max(np.abs(r[3:])))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(order, abs=0.1)


@MESHES
@ORDERS
@LAWS
def test_linearisation_is_the_derivative(mesh, wedge_order, law):
    pressure, thickness = state(mesh)
    change, step = change_of(mesh), 1e-6
    of = fluid(law=law)
    by_p, by_h = derivatives(mesh, pressure, thickness, wedge_order=wedge_order, law=law)
    for stencil, along_p, along_h in ((by_p, change, 0.0), (by_h, 0.0, change)):
        forward, back = (
            residual(mesh, pressure + s * along_p, thickness + s * along_h, wedge_order=wedge_order, of=of)
            for s in (step, -step)
        )
        difference = (forward - back) / (2.0 * step)
        np.testing.assert_allclose(stencil(change), difference, rtol=1e-6, atol=1e-7 * np.max(difference))


@ORDERS
def test_half_of_the_contact_is_the_whole_one(wedge_order):
    """Residual, derivatives and diagonal, on mirror images."""
    pressure, thickness = state(HALF)
    both = HALF.mirrored(pressure), HALF.mirrored(thickness)
    half = residual(HALF, pressure, thickness, wedge_order=wedge_order)
    whole = residual(WHOLE, *both, wedge_order=wedge_order)
    np.testing.assert_allclose(HALF.mirrored(half), whole, rtol=1e-12, atol=1e-12)
    change = change_of(HALF)
    for ours, theirs in zip(
        derivatives(HALF, pressure, thickness, wedge_order=wedge_order),
        derivatives(WHOLE, *both, wedge_order=wedge_order),
        strict=True,
    ):
        expected = theirs(HALF.mirrored(change))
        np.testing.assert_allclose(HALF.mirrored(ours(change)), expected, rtol=1e-11, atol=1e-10)
    weights = [
        reynolds.poiseuille_weight(flow(fluid(), *values, mesh), mesh)
        for mesh, values in ((HALF, (pressure, thickness)), (WHOLE, both))
    ]
    np.testing.assert_allclose(HALF.mirrored(weights[0]), weights[1], rtol=1e-12)


@MESHES
@ORDERS
@LAWS
def test_rows_sum_to_the_flow_through_the_edges(mesh, wedge_order, law):
    """Conservation: what the inner cells lose leaves through the faces next to the edges of the domain.

    Nothing passes the line of symmetry, whose own cells are half as wide on each side.
    """
    pressure, thickness = state(mesh)
    mass = evaluate(fluid(), pressure, thickness).density * thickness
    widths = mesh.weights_across.copy()
    lines = slice(0 if mesh.symmetric else 1, -1)
    along = through_faces(pressure, thickness, mesh.dx, law)
    across = through_faces(pressure.T, thickness.T, mesh.dy, law).T
    entering, leaving = entering_and_leaving(mass, wedge_order)
    out = np.sum((widths * (leaving - along[-1] - entering + along[0]))[lines])
    if mesh.symmetric:
        out += 2.0 * mesh.dx * np.sum(-across[1:-1, -1])
    else:
        out += mesh.dx * np.sum((across[:, 0] - across[:, -1])[1:-1])
    lost = residual(mesh, pressure, thickness, wedge_order=wedge_order, of=fluid(law=law))
    total = mesh.dx * np.sum(widths * lost)
    assert total == pytest.approx(out, rel=1e-10, abs=0.0)


@MESHES
def test_edges_have_no_rows(mesh):
    pressure, thickness = state(mesh)
    r = residual(mesh, pressure, thickness, wedge_order=2)
    assert np.all(r[~mesh.inner] == 0.0)
    assert np.all(r[mesh.inner] != 0.0)
    for stencil in derivatives(mesh, pressure, thickness, wedge_order=2):
        assert np.all(stencil.coefficients[:, ~mesh.inner] == 0.0)


@MESHES
def test_stencil_matrix_is_the_operator(mesh):
    values = change_of(mesh)
    for stencil in derivatives(mesh, *state(mesh), wedge_order=2):
        assert len(stencil.coefficients) == reynolds.ACROSS
        np.testing.assert_allclose(stencil.matrix() @ values.ravel(), stencil(values).ravel(), atol=1e-10)


def test_no_flow_across_is_a_line_contact():
    """States that do not change across have the residual of a line contact, on every inner line."""
    line = Mesh.over(NODES, -2.0, 1.5)
    pressure, thickness = state(line)
    expected = residual(line, pressure, thickness, wedge_order=2)
    for mesh in (HALF, WHOLE):
        wide = (np.repeat(values, mesh.y.size, axis=1) for values in (pressure, thickness))
        r = residual(mesh, *wide, wedge_order=2)
        lines = slice(0 if mesh.symmetric else 1, -1)
        np.testing.assert_allclose(r[:, lines] - expected, 0.0, atol=1e-11)
