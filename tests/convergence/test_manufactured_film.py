"""The coupled film problem, Reynolds, deflection and load together, against a manufactured solution."""

import numpy as np
import pytest

from ehlectric.film import solve_film
from tests.reference import film as exact


def errors(nodes, *, second_order):
    """Largest error of P and of H, and that of H00."""
    film = solve_film(exact.problem(nodes, second_order=second_order))
    assert film.converged
    assert not np.any(film.cavitated[1:-1])
    pressure = film.pressure - exact.pressure(film.x)
    thickness = film.thickness - exact.thickness(film.x)
    h00 = thickness - (film.deflection - exact.deflection(film.x))
    np.testing.assert_allclose(h00, h00[0], atol=1e-12)
    return [np.max(np.abs(e)) for e in (pressure, thickness, h00)]


# Largest errors on the finest grid are some times dX = 1e-3, and dX^2.
@pytest.mark.parametrize(("second_order", "order", "largest"), [(False, 1, 5e-4), (True, 2, 2e-6)])
def test_manufactured_film(slope, second_order, order, largest):
    nodes = np.array([401, 801, 1601, 3201])
    found = np.array([errors(n, second_order=second_order) for n in nodes])
    assert np.all(found[-1] < largest)
    for name, column in zip(("P", "H", "H00"), found.T, strict=True):
        assert slope(1.0 / (nodes - 1), column) == pytest.approx(order, abs=0.06), name
