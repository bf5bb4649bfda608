"""The reference solution itself, by a second method and against its printed constant."""

import pytest

from tests.film.martin import film_coefficient, film_coefficient_by_quadrature

pytestmark = pytest.mark.reference


def test_unlimited_inlet_gives_martins_constant():
    # h_min w/(eta u R) = 4.9, printed in the textbooks to two digits, e.g. Hamrock (1994).
    assert film_coefficient() == pytest.approx(4.9, abs=0.05)


@pytest.mark.parametrize("inlet", [-100.0, -10.0, -3.0])
def test_closed_form_agrees_with_quadrature(inlet):
    assert film_coefficient(inlet) == pytest.approx(film_coefficient_by_quadrature(inlet), rel=1e-9, abs=0.0)
