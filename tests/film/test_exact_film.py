"""The manufactured film itself: its closed forms by quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad

from tests.film import exact_film as film
from tests.helpers.each import each

pytestmark = pytest.mark.reference


def test_pressure_carries_the_load():
    load, _ = quad(film.pressure, film.INLET, film.OUTLET, epsabs=1e-13)
    assert load == pytest.approx(0.5 * np.pi, rel=1e-10, abs=0.0)


@each("x", [film.INLET, -1.1, 0.0, 0.8, film.OUTLET])
def test_deflection_is_the_logarithmic_potential(x):
    total = 0.0
    for low, high in ((film.INLET, x), (x, film.OUTLET)):
        if high > low:
            weight = "alg-logb" if high == x else "alg-loga"
            total += quad(film.pressure, low, high, weight=weight, wvar=(0, 0), epsabs=1e-13)[0]
    assert film.deflection(x) == pytest.approx(-total / np.pi, rel=1e-9, abs=0.0)


def test_film_is_full_everywhere():
    x = np.linspace(film.INLET, film.OUTLET, 1001)
    assert np.all(film.pressure(x[1:-1]) > 0.0)
    assert np.min(film.thickness(x)) > 0.1
