"""Temperature of a sheared film against exact solutions of thermoviscous Couette flow."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from ehlectric.film.heated_film import DEGREE
from tests.helpers.hot import couette

pytestmark = pytest.mark.convergence


@pytest.mark.slow
@pytest.mark.parametrize(
    ("nahme", "largest", "stress", "error"),
    [
        # R. Nahme (1940); C. Gavis and R. L. Laurence, Ind. Eng. Chem. Fundam. 7 (1968) 232: closed form
        (0.1, 0.012423, 0.991749, 1e-6),
        (1.0, 0.117783, 0.924196, 1e-6),
        (5.0, 0.485508, 0.719686, 1e-6),
        (20.0, 1.252763, 0.418840, 1e-6),
        (100.0, 2.602690, 0.152069, 2e-5),
    ],
)
def test_newtonian_thermoviscous_couette_flow(nahme, largest, stress, error):
    """With a degree of 20 to 1e-6, and with the degree of films to ``error``."""
    root = np.sqrt(nahme / 8.0)
    exact_stress = np.arcsinh(root) / (root * np.sqrt(1.0 + nahme / 8.0))
    assert exact_stress == pytest.approx(stress, abs=1e-6)
    assert np.log(1.0 + nahme / 8.0) == pytest.approx(largest, abs=1e-6)
    for degree, relative in ((20, 1e-6), (DEGREE, error)):
        zeta, theta, found = couette(nahme, degree=degree)
        exact = np.log((1.0 + nahme / 8.0) / np.cosh((2.0 * zeta - 1.0) * np.arcsinh(root)) ** 2)
        np.testing.assert_allclose(theta, exact, atol=relative * exact.max())
        assert found == pytest.approx(exact_stress, rel=relative)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("nahme", "rate", "stress", "largest", "error"),
    [
        # Closed form with one scalar root, which an independent boundary value solver confirmed to 1e-9
        (1.0, 1.0, 0.832194, 0.105853, 1e-6),
        (8.0, 10.0, 2.801677, 0.293735, 1e-6),
        (20.0, 10.0, 2.522888, 0.702395, 1e-6),
        (1000.0, 100.0, 2.191071, 4.143354, 3e-4),
    ],
)
def test_eyring_thermoviscous_couette_flow(nahme, rate, stress, largest, error):
    """With a degree of 20 to 1e-6, and with the degree of films to ``error``."""

    def excess(s):
        t = np.arcsinh(rate * s / (np.sinh(s) * np.cosh(s)))
        return nahme * t * np.sinh(t) / rate**2 - 8.0 * s**2 / np.cosh(s) ** 2

    root = brentq(excess, 1e-6, 20.0, xtol=1e-14)
    exact = np.arcsinh(rate * root / (np.sinh(root) * np.cosh(root)))
    assert exact == pytest.approx(stress, abs=1e-6)
    assert 2.0 * np.log(np.cosh(root)) == pytest.approx(largest, rel=2e-6, abs=1e-6)
    for degree, relative in ((20, 1e-6), (DEGREE, error)):
        _, theta, found = couette(nahme, rate, degree=degree)
        assert found * rate == pytest.approx(exact, rel=relative)
        assert theta.max() == pytest.approx(2.0 * np.log(np.cosh(root)), rel=relative)


def test_error_across_falls_faster_than_any_power():
    # Gauss and Lobatto nodes: for a smooth temperature the error falls by a factor from degree to degree.
    exact = np.log(1.0 + 50.0 / 8.0)
    errors = [abs(couette(50.0, degree=degree, loops=30)[1].max() - exact) for degree in (4, 8, 12, 16)]
    assert all(fine < 0.2 * coarse for coarse, fine in pairwise(errors))
    assert errors[-1] < 1e-4
