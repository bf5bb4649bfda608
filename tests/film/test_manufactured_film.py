"""The coupled film problem, Reynolds, deflection and load together, against a manufactured solution."""

import numpy as np
import pytest

from ehlectric.film.face_flow import MEAN_MOBILITY
from ehlectric.film.isothermal_film import solve_film
from ehlectric.paper import fas
from tests.film import exact_film as exact

pytestmark = pytest.mark.convergence


def errors(solve, nodes, *, wedge_order, law=MEAN_MOBILITY):
    """Largest error of P and of H, and that of H00."""
    film = solve(exact.problem(nodes, wedge_order=wedge_order, law=law))
    assert film.converged
    assert not np.any(film.cavitated[1:-1])
    pressure = film.pressure - exact.pressure(film.x)
    thickness = film.thickness - exact.thickness(film.x)
    h00 = thickness - (film.deflection - exact.deflection(film.x))
    np.testing.assert_allclose(h00, h00[0], atol=1e-12)
    return [np.max(np.abs(e)) for e in (pressure, thickness, h00)]


OURS = solve_film, (401, 801, 1601, 3201)
# On 3201 nodes of this film its cycles stay in a limit cycle at the pressure's steepest place.
THE_PAPERS = fas.solve_film, (401, 801, 1601)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("solver", "wedge_order", "order", "largest"),
    [
        (OURS, 1, 1, 0.5),
        (OURS, 2, 2, 2.0),
        (OURS, 3, 2, 2.0),
        (THE_PAPERS, 1, 1, 0.5),
        (THE_PAPERS, 2, 2, 2.0),
    ],
    ids=["ours-1", "ours-2", "ours-3", "the paper's-1", "the paper's-2"],
)
def test_manufactured_film(slope, solver, wedge_order, order, largest):
    """Errors fall with dX or dX^2, and are at most half of dX, or twice dX^2."""
    solve, nodes = solver
    dx = (exact.OUTLET - exact.INLET) / (np.array(nodes) - 1)
    found = np.array([errors(solve, n, wedge_order=wedge_order) for n in nodes])
    assert np.all(found[-1] < largest * dx[-1] ** order)
    for quantity, column in zip(("P", "H", "H00"), found.T, strict=True):
        assert slope(dx, column) == pytest.approx(order, abs=0.06), quantity


@pytest.mark.parametrize("wedge_order", [2, 3])
def test_mean_fluidity(slope, wedge_order):
    """The pressure's error falls with dX^2; those of H and H00, which are smaller, at least as fast."""
    nodes = np.array([401, 801, 1601, 3201])
    dx = (exact.OUTLET - exact.INLET) / (nodes - 1)
    found = np.array([errors(solve_film, n, wedge_order=wedge_order, law="newtonian") for n in nodes])
    assert slope(dx, found[:, 0]) == pytest.approx(2.0, abs=0.06)
    for column, largest in zip(found.T, (1.0, 0.2, 0.05), strict=True):
        assert np.all(column < largest * dx**2)
