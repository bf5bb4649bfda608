"""The manufactured film of a point contact itself: its integrals by other quadratures."""

import itertools

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from tests.film import exact_point_film as point_film
from tests.film.exact_point_film import INLET, OUTLET, SIDE, ManufacturedFilm

pytestmark = pytest.mark.reference

FILMS = [ManufacturedFilm(), ManufacturedFilm(skew=0.5)]


def pressure(film, x, y):
    return film.pressure(np.atleast_1d(x), np.atleast_1d(y))[0, 0]


@pytest.mark.parametrize("film", FILMS)
def test_pressure_carries_the_load(film):
    load, _ = dblquad(lambda y, x: pressure(film, x, y), INLET, OUTLET, -SIDE, SIDE, epsabs=1e-10)
    assert load == pytest.approx(point_film.LOAD, rel=1e-10, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("film", FILMS)
@pytest.mark.parametrize("at", [(-0.3, 0.01), (0.7, 1.0), (INLET, 0.4), (1.0, SIDE), (-1.89, -1.79)])
def test_deflection_is_the_potential(film, at):
    """In polar coordinates about the point 1/r drops out: P along rays, then over the angle."""
    x, y = at
    points, weights = np.polynomial.legendre.leggauss(12)

    def ray(angle):
        c, s = np.cos(angle), np.sin(angle)
        ends = (((OUTLET if c > 0 else INLET) - x) / c, ((SIDE if s > 0 else -SIDE) - y) / s)
        length = max(0.0, min(ends))
        r = 0.5 * length * (points + 1.0)
        values = [pressure(film, x + ri * c, y + ri * s) for ri in r]
        return 0.5 * length * float(weights @ values)

    corners = sorted(np.arctan2(j - y, i - x) for i in (INLET, OUTLET) for j in (-SIDE, SIDE))
    breaks = [-np.pi, *corners, np.pi]
    total = sum(
        quad(ray, low, high, epsabs=1e-12, epsrel=1e-11, limit=200)[0]
        for low, high in itertools.pairwise(breaks)
        if high - low > 1e-12
    )
    found = film.deflection(np.array([x]), np.array([y]))[0, 0]
    assert found == pytest.approx(point_film.COMPLIANCE * total, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("film", FILMS)
def test_film_is_full_everywhere(film):
    x, y = np.linspace(INLET, OUTLET, 201), np.linspace(-SIDE, SIDE, 201)
    assert np.all(film.pressure(x[1:-1], y[1:-1]) > 0.0)
    assert np.min(film.thickness(x, y)) > 0.1
    alike = np.allclose(film.thickness(x, y), film.thickness(x, -y), rtol=1e-12, atol=0.0)
    assert alike == (film.skew == 0.0)
