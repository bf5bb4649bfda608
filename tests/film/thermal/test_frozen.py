"""Properties of the oil in a film whose temperature follows the pressure."""

import numpy as np
import pytest

from ehlectric.film.across_film import Across
from ehlectric.film.energy_equation import FrozenTemperature, Heat
from ehlectric.film.hot_oil import HotOil
from ehlectric.film.mesh import Mesh
from tests.helpers.hot import hot_oil

HERTZ, INLET = 1e9, 313.15


def frozen(nodes=5):
    """Temperature of 313 to 363 K at pressures of 0.2 to 0.6 p_h, which follows the pressure by 50 K/GPa."""
    across, mesh = Across.of(4), Mesh.over(nodes, 0.0, 1.0)
    pressure = np.linspace(0.2, 0.6, nodes)[:, np.newaxis]
    temperature = INLET + 50.0 * across.zeta[:, np.newaxis, np.newaxis] * np.ones((1, nodes, 1))
    heat = Heat(temperature, np.zeros((2, nodes, 1)), np.full_like(temperature, 5e-8))
    oil = HotOil.through(hot_oil(), INLET - 30.0, INLET + 300.0)
    return FrozenTemperature(across, mesh, heat, pressure, oil, INLET, HERTZ)


def error(change):
    """Largest errors of the viscosity ratio and of the density where the pressure changed."""
    profile = frozen()
    pressure = profile.pressure + change
    found, p = profile(pressure, profile.mesh), HERTZ * pressure
    hot = profile.at(pressure).temperature
    cold = profile.oil.log_viscosity(p, np.full((1, 1, 1), INLET)).value
    ratio = profile.oil.log_viscosity(p, hot).value - cold
    density = profile.oil.density(p, hot).value / hot_oil()(INLET).density
    return np.array([np.max(np.abs(found.log_ratio - ratio)), np.max(np.abs(found.density - density))])


def test_properties_are_exact_at_the_pressure_of_the_temperature():
    assert np.max(error(0.0)) < 1e-9


def test_error_is_the_square_of_the_change_of_pressure():
    assert error(0.02) / error(0.01) == pytest.approx([4.0, 4.0], rel=0.1)


def test_a_coarser_mesh_has_the_properties_of_its_nodes():
    profile = frozen()
    mesh = Mesh.over(3, 0.0, 1.0)
    fine, coarse = profile(profile.pressure, profile.mesh), profile(profile.pressure[::2], mesh)
    np.testing.assert_allclose(coarse.log_ratio, fine.log_ratio[:, ::2], atol=1e-12)
    np.testing.assert_allclose(coarse.density_p, fine.density_p[:, ::2], atol=1e-12)
