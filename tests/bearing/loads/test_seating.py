"""Balls between two grooves against a direct search for the least energy, and against geometry by hand."""

import numpy as np
import pytest
from scipy.optimize import minimize

from ehlectric.bearing.loads.ball_seats import Grooves, seat
from tests.helpers.each import each

INNER, OUTER = 0.24e-3, 0.30e-3  # distance of ball and groove centres where they touch
K = np.array([1.2e10]), np.array([0.9e10])


def grooves(outward):
    return Grooves(INNER, OUTER, *K, outward)


def energy(p, g, outward):
    """Of one ball [J], over its place in micrometres; a groove goes on as a plane wall beyond 90 deg."""
    p = p * 1e-6
    across = g - p
    inner = max(0.0, np.hypot(across[0], max(0.0, across[1])) - INNER)
    outer = max(0.0, np.hypot(p[0], max(0.0, p[1])) - OUTER)
    return 0.4 * K[0][0] * inner**2.5 + 0.4 * K[1][0] * outer**2.5 - outward * p[1]


@each("outward", [0.5, 20.0, 500.0])
@each(
    "g",
    [
        (0.0, 550e-6),
        (100e-6, 545e-6),
        (300e-6, 460e-6),
        (400e-6, 300e-6),
        (250e-6, 200e-6),
        (-100e-6, 545e-6),
    ],
)
def test_least_energy(g, outward):
    g = np.array(g)
    found = minimize(
        lambda p: 1e6 * energy(p, g, outward),
        g * 1e6 * OUTER / (INNER + OUTER),
        method="Nelder-Mead",
        options={"xatol": 1e-8, "fatol": 1e-15, "maxiter": 4000, "maxfev": 4000},
    )
    seats = seat(grooves(outward), g[:, None])
    np.testing.assert_allclose(seats.place[:, 0] * 1e6, found.x, atol=3e-4)
    assert energy(seats.place[:, 0] * 1e6, g, outward) <= found.fun * 1e-6 + 1e-15
    force = seats.outer.force - seats.inner.force - [0.0, outward]
    assert np.max(np.abs(force)) < 1e-9 * np.max(seats.outer.load)


def test_tangent_is_the_derivative_of_the_force():
    g, step = np.array([[150e-6], [525e-6]]), 1e-11
    first, mixed, second = np.ravel(seat(grooves(20.0), g).tangent)
    tangent = np.array([[first, mixed], [mixed, second]])
    for k in range(2):
        move = step * np.eye(2)[:, k : k + 1]
        change = [seat(grooves(20.0), g + sign * move).inner.force[0] for sign in (1.0, -1.0)]
        np.testing.assert_allclose(tangent[:, k], (change[0] - change[1]) / (2.0 * step), rtol=1e-5)
    assert np.linalg.eigvalsh(tangent).min() > 0.0


def test_at_rest_two_springs_in_series():
    """Both carry K (1/K_i^(2/3) + 1/K_o^(2/3))^(-3/2) of the depth together, on the line of the centres."""
    g = np.array([[60e-6], [545e-6]])
    seats = seat(grooves(0.0), g)
    depth = np.hypot(*g)[0] - INNER - OUTER
    load = (depth / (K[0] ** (-2 / 3) + K[1] ** (-2 / 3))) ** 1.5
    np.testing.assert_allclose(seats.inner.load, load, rtol=1e-9)
    np.testing.assert_allclose(seats.outer.load, load, rtol=1e-9)
    np.testing.assert_allclose(seats.inner.normal, g.T / np.hypot(*g)[0], rtol=1e-12)


def test_speed_seats_a_free_ball_at_the_outer_groove():
    """Depth (F_c/K_o)^(2/3) there; the rest of the play is at the inner groove."""
    g = np.array([[0.0], [520e-6]])
    seats = seat(grooves(20.0), g)
    depth = (20.0 / K[1][0]) ** (2.0 / 3.0)
    assert not seats.held[0]
    assert seats.outer.load[0] == pytest.approx(20.0, rel=1e-10, abs=0.0)
    assert -seats.inner.depth[0] == pytest.approx(20e-6 + depth, rel=1e-10, abs=0.0)


def test_free_ball_at_rest_has_equal_gaps():
    g = np.array([[80e-6], [500e-6]])
    seats = seat(grooves(0.0), g)
    play = INNER + OUTER - np.hypot(*g)[0]
    assert not seats.held[0]
    assert -seats.inner.depth[0] == pytest.approx(play / 2.0, rel=1e-9, abs=0.0)
    assert -seats.outer.depth[0] == pytest.approx(play / 2.0, rel=1e-9, abs=0.0)
