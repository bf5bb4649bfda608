"""Reynolds, deflection and load of a point contact together, against a manufactured solution."""

import numpy as np
import pytest

from ehlectric.film.isothermal_film import solve_point_film
from tests.film.exact_point_film import INLET, OUTLET, ManufacturedFilm

pytestmark = pytest.mark.convergence

SPAN = OUTLET - INLET


def errors(exact, nodes, *, wedge_order):
    """Largest error of P and of H, and that of H00, on three quarters as many intervals across."""
    film = solve_point_film(exact.problem(nodes, 3 * (nodes // 4) + 1, wedge_order=wedge_order))
    assert film.converged
    assert not np.any(film.cavitated[1:-1, 1:-1])
    pressure = film.pressure - exact.pressure(film.x, film.y)
    thickness = film.thickness - exact.thickness(film.x, film.y)
    h00 = thickness - (film.deflection - exact.deflection(film.x, film.y))
    np.testing.assert_allclose(h00, h00[0, 0], atol=1e-12)
    return [np.max(np.abs(pressure)), np.max(np.abs(thickness)), abs(h00[0, 0])]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("skew", "nodes"),
    [
        pytest.param(0.0, [49, 97], id="symmetric", marks=pytest.mark.gate),
        pytest.param(0.5, [65, 129], id="whole"),
    ],
)
def test_second_order(slope, skew, nodes):
    """Errors fall with dX^2, to at most five times that of P, twice of H and half of H00."""
    nodes = np.array(nodes)
    found = np.array([errors(ManufacturedFilm(skew), n, wedge_order=2) for n in nodes])
    dx = SPAN / (nodes - 1)
    assert np.all(found[-1] < np.array([5.0, 2.0, 0.6]) * dx[-1] ** 2)
    for quantity, column in zip(("P", "H", "H00"), found.T, strict=True):
        assert slope(dx, column) == pytest.approx(2.0, abs=0.2), quantity


@pytest.mark.slow
@pytest.mark.parametrize(("wedge_order", "order", "off"), [(1, 1.0, 0.13), (2, 2.0, 0.07), (3, 2.0, 0.07)])
def test_orders(slope, wedge_order, order, off):
    """The first-order wedge still feels the second order of everything else."""
    nodes = np.array([65, 129, 257])
    found = np.array([errors(ManufacturedFilm(), n, wedge_order=wedge_order) for n in nodes])
    for quantity, column in zip(("P", "H", "H00"), found.T, strict=True):
        assert slope(SPAN / (nodes - 1), column) == pytest.approx(order, abs=off), quantity


@pytest.mark.slow
def test_half_of_the_contact_is_the_whole_one():
    """The symmetric film solved on the whole domain, to the tolerance of both solutions."""
    half, whole = (
        solve_point_film(ManufacturedFilm().problem(65, 49, wedge_order=2, symmetric=symmetric))
        for symmetric in (True, False)
    )
    np.testing.assert_allclose(whole.pressure, half.pressure, atol=1e-8)
    np.testing.assert_allclose(whole.thickness, half.thickness, atol=1e-8)
