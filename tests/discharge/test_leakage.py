"""Leakage of charge in a film that is hotter than the oil in its inlet."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric import Case, InputError, solve
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.discharge_laws import leakage, mean_conductivity
from tests.helpers.hot_cases import HOT_LINE, OIL

ARRHENIUS = {
    "conductivity_law": "arrhenius",
    "conductivity": 1e-10,
    "conductivity_activation": 5e4,
    "conductivity_temperature": 313.15,
}
TABLE = {"conductivity_table": {"temperature": [313.15, 353.15], "conductivity": [1e-10, 4e-10]}}


def film(thickness, temperature):
    """Film on five nodes, of which three lie in a Hertz zone of a half-width of 1 mm."""
    x = np.array([-2e-3, -1e-3, 0.0, 1e-3, 2e-3])
    return SimpleNamespace(axes=(x,), thickness=np.array(thickness), temperature=np.array(temperature))


def test_columns_of_the_zone_lie_side_by_side():
    # Conductances 2/1 + 3/2 + 4/4 over 1/1 + 1/2 + 1/4: by hand.
    found = film([9.0, 1.0, 2.0, 4.0, 9.0], [0.0] * 5)
    assert mean_conductivity(found, np.array([50.0, 2.0, 3.0, 4.0, 50.0]), (1e-3,)) == pytest.approx(
        4.5 / 1.75
    )


def test_an_evenly_hot_film_leaks_as_oil_of_its_temperature():
    lubricant = Lubricant.from_dict(OIL | ARRHENIUS)
    inlet, hot = lubricant.at(313.15), lubricant.at(343.15)
    found = leakage(Discharge(), inlet, film([1e-7] * 5, [343.15] * 5), (1e-3,))
    expected = epsilon_0 * inlet.relative_permittivity / hot.conductivity
    assert found.relaxation_time == pytest.approx(expected, rel=1e-12)
    assert found.corner_frequency == pytest.approx(0.5 / np.pi / found.relaxation_time, rel=1e-12)


def test_ends_of_a_table_hold_in_a_hot_film_alone():
    lubricant = Lubricant.from_dict(OIL | TABLE)
    oil = lubricant.at(313.15)
    found = leakage(Discharge(), oil, film([1e-7] * 5, [400.0] * 5), (1e-3,))
    assert found.relaxation_time == pytest.approx(epsilon_0 * oil.relative_permittivity / 4e-10, rel=1e-9)
    with pytest.raises(InputError, match=r"lubricant\.conductivity_table"):
        lubricant.at(400.0)


def test_a_conductivity_of_the_discharge_is_a_constant():
    oil = Lubricant.from_dict(OIL | ARRHENIUS).at(313.15)
    given = Discharge.from_dict({"conductivity": "1 nS/m"})
    assert leakage(given, oil, film([1e-7] * 5, [343.15] * 5), (1e-3,)) == leakage(given, oil)


def test_a_hot_contact_leaks_faster_than_its_inlet():
    case = Case.from_dict(HOT_LINE | {"lubricant": OIL | ARRHENIUS, "discharge": {}})
    result = solve(case)
    cold = leakage(case.discharge, case.oil).relaxation_time
    rise = result.film.heated.max_temperature_rise
    hottest = case.lubricant.at(313.15 + rise)
    hot = leakage(case.discharge, hottest).relaxation_time
    assert hot < result.summary()["discharge"]["relaxation_time"] < cold
