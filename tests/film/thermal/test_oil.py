"""Oil over temperature beyond the range in which its properties were taken."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.hot_oil import HotOil
from tests.helpers.hot import hot_oil

OIL = HotOil.through(hot_oil(), 293.15, 563.15)


@pytest.mark.parametrize("beyond", [5.0, 20.0, 80.0])
def test_viscosity_beyond_the_range_lies_between_line_and_parabola(beyond):
    """The law itself is Roelands', which has values there."""
    pressure, temperature = np.array([2e9]), np.array([563.15 + beyond])
    line, parabola = (oil.log_viscosity(pressure, temperature) for oil in (OIL, replace(OIL, curved=True)))
    law = hot_oil()(temperature[0])
    value = law.log_viscosity(pressure)[0] + np.log(law.viscosity)
    assert line.value < value < parabola.value
    assert line.by_temperature < parabola.by_temperature <= 0.0


def test_parabola_is_level_from_its_vertex_on_and_has_its_slope():
    oil, pressure = replace(OIL, curved=True), np.full(2, 2e9)
    far = oil.log_viscosity(pressure, np.array([900.0, 1000.0]))
    assert far.value[0] == pytest.approx(far.value[1], abs=1e-12)
    assert far.by_temperature == pytest.approx(0.0, abs=1e-12)
    near = oil.log_viscosity(pressure, np.array([600.0, 600.1]))
    assert np.diff(near.value)[0] / 0.1 == pytest.approx(near.by_temperature[0], rel=1e-2)


def test_within_the_range_both_are_the_same():
    pressure, temperature = np.full(4, 1e9), np.linspace(OIL.lowest, OIL.highest, 4)
    line, parabola = (oil.log_viscosity(pressure, temperature) for oil in (OIL, replace(OIL, curved=True)))
    assert np.array_equal(line.value, parabola.value)
    assert np.array_equal(line.by_temperature, parabola.by_temperature)
