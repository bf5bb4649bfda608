"""The flow through a face: another law of the lubricant enters the film by one function."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film import face_flow as flows
from ehlectric.film import reynolds
from ehlectric.film.face_flow import FaceFlow, Flow, Fluid, Sides, evaluate, flow
from ehlectric.film.isothermal_film import solve_film
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.problem import FilmProblem
from ehlectric.lubricant.density import incompressible
from ehlectric.lubricant.viscosity import barus

# Limit of the shear stress at the walls over p_h: where H dP/dX exceeds it, the flux grows faster.
STRESS = 0.05


def sheared(fluid, pressure, thickness, mesh):
    """Flux eps g (1 + (h g/s)^2) of the gradient g between the nodes, as of a shear-thinning fluid."""
    k = evaluate(fluid, pressure, thickness)
    eps, h = (0.5 * (values[1:] + values[:-1]) for values in (k.eps, thickness))
    gradient = np.diff(pressure, axis=0) / mesh.dx
    squared = (h * gradient / STRESS) ** 2
    of_eps = 0.5 * gradient * (1.0 + squared) / mesh.dx
    of_gap = eps * gradient * squared / h / mesh.dx
    along = FaceFlow(
        flux=eps * gradient * (1.0 + squared) / mesh.dx,
        conductance=eps * (1.0 + 3.0 * squared) / mesh.dx**2,
        by_properties=Sides(of_eps * k.eps_p[:-1], of_eps * k.eps_p[1:]),
        by_gap=Sides(of_eps * k.eps_h[:-1] + of_gap, of_eps * k.eps_h[1:] + of_gap),
    )
    return Flow(k, along, None)


@pytest.fixture
def shear_thinning(monkeypatch):
    """A fluid by a law that the table gains for this test."""
    monkeypatch.setitem(flows.FLOWS, "sheared", sheared)
    return Fluid(
        incompressible,
        lambda p: barus(p, pressure_viscosity_coefficient=2.0),
        velocity_parameter=0.05,
        ambient_pressure=0.0,
        flow="sheared",
    )


def test_derivatives_of_another_law_reach_the_jacobian(shear_thinning):
    """Two nodal quantities, eps and H: the stencils are the derivative of the residual by both."""
    mesh = Mesh.over(30, -2.0, 1.0)
    random = np.random.default_rng(2)
    pressure, thickness, change = (
        0.2 + random.random((30, 1)),
        0.5 + random.random((30, 1)),
        random.random(30),
    )
    change = change[:, np.newaxis]
    wedge = reynolds.wedge_stencil(mesh.shape, mesh.dx, order=2)

    def residual(p, h):
        return reynolds.residual(flow(shear_thinning, p, h, mesh), wedge, h, mesh)

    by_p, by_h = reynolds.linearise(flow(shear_thinning, pressure, thickness, mesh), wedge, thickness, mesh)
    step = 1e-6 * change
    for stencil, p, h in ((by_p, step, 0.0), (by_h, 0.0, step)):
        forward, back = residual(pressure + p, thickness + h), residual(pressure - p, thickness - h)
        expected = (forward - back) / 2e-6
        np.testing.assert_allclose(stencil(change), expected, rtol=1e-6, atol=1e-6 * np.max(np.abs(expected)))


def test_film_of_another_law_converges_and_is_thinner(shear_thinning):
    """Newton's method, its preconditioner and the nested grids know nothing of the law.

    A fluid that flows back from the inlet more easily leaves a thinner film.
    """
    problem = FilmProblem(shear_thinning, 401, inlet=-4.0, outlet=2.0, thickness_guess=0.2)
    thinned = solve_film(problem)
    newtonian = solve_film(replace(problem, fluid=replace(shear_thinning, flow="newtonian")))
    assert thinned.converged
    assert newtonian.converged
    assert len(thinned.steps) <= 2 * len(newtonian.steps)
    assert 0.3 < thinned.central_thickness / newtonian.central_thickness < 0.99


def test_a_law_that_the_table_does_not_have_is_an_error(shear_thinning):
    unknown = replace(shear_thinning, flow="bingham")
    with pytest.raises(KeyError, match="bingham"):
        flow(unknown, np.ones((5, 1)), np.ones((5, 1)), Mesh.over(5, -2.0, 1.0))


def test_faces_include_the_line_of_symmetry(shear_thinning):
    """On the half y >= 0 nothing flows through the middle: the faces beside it are mirror images."""
    fluid = replace(shear_thinning, flow="newtonian")
    mesh = Mesh.over(9, -2.0, 1.0, Width(9, 2.0))
    random = np.random.default_rng(3)
    across = flow(fluid, random.random(mesh.shape), 0.5 + random.random(mesh.shape), mesh).across
    assert across.flux.shape == (mesh.y.size, mesh.x.size)
    np.testing.assert_array_equal(across.flux[0], -across.flux[1])
    np.testing.assert_array_equal(across.conductance[0], across.conductance[1])
