"""Temperature under moving sources against the exact solutions of Jaeger and of Carslaw and Jaeger."""

import numpy as np
import pytest

from ehlectric.film.energy_equation import moving_surface
from ehlectric.film.hot_oil import Body
from tests.helpers.each import each

# Steel with a bulk temperature of zero, so that temperatures are rises.
STEEL = Body(0.0, thermal_conductivity=46.0, heat_capacity=470.0, density=7850.0)


def band(peclet, cells=400):
    """Rise times k/(q b) at the nodes inside a band of uniform flux, for u b/(2 kappa) = ``peclet``."""
    half_width = 1e-4
    spacing = 2.0 * half_width / cells
    surface = moving_surface(
        STEEL,
        2.0 * STEEL.diffusivity * peclet / half_width,
        nodes=cells,
        spacing=spacing,
        half_width=half_width,
    )
    rise = surface.rise(np.ones((cells, 1)))[:, 0]
    return rise * STEEL.thermal_conductivity / half_width


@each(
    "peclet, largest, mean",
    [
        # Quadrature of Jaeger (1942), Proc. R. Soc. N.S.W. 76, 203, for a uniform band.
        (0.1, 2.20033, 2.06178),
        (1.0, 0.99185, 0.79986),
        (5.0, 0.48464, 0.34502),
        (10.0, 0.34850, 0.24132),
        (50.0, 0.15856, 0.10674),
    ],
)
def test_uniform_band(peclet, largest, mean):
    rise = band(peclet)
    assert rise.max() == pytest.approx(largest, rel=2e-3)
    assert rise.mean() == pytest.approx(mean, rel=1e-3)


def test_fast_limit_of_a_band():
    peclet = 2000.0
    rise = band(peclet, cells=200)
    # T(x) = (2 q/k) sqrt(kappa x/(pi u)) at the nodes, the middles of the cells
    x = (np.arange(200) + 0.5) / 100.0
    np.testing.assert_allclose(rise, 2.0 * np.sqrt(x / (2.0 * np.pi * peclet)), rtol=1e-12)


def test_exact_solution_reaches_the_fast_limit():
    np.testing.assert_allclose(band(990.0)[40:], band(1010.0)[40:] * np.sqrt(1010.0 / 990.0), rtol=2e-3)


def test_body_at_rest_is_heated_on_both_sides_alike():
    surface = moving_surface(STEEL, 0.0, nodes=50, spacing=1e-6, half_width=1e-4)
    np.testing.assert_allclose(surface.upstream[1:], surface.downstream[1:], rtol=1e-2)
    assert surface.is_slow
