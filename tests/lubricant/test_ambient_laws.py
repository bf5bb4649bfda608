"""Laws at ambient pressure: viscosity and electrical conductivity over temperature, and measured tables."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.errors import InputError
from ehlectric.lubricant.electrical_laws import arrhenius, constant_conductivity
from ehlectric.lubricant.properties_over_temperature import interpolated
from ehlectric.lubricant.viscosity_over_temperature import (
    ATMOSPHERIC_LAWS,
    roelands_over_temperature,
    vogel,
)
from tests.helpers.each import each
from tests.lubricant.oils import VOGEL

ROELANDS = {"viscosity": 0.04, "reference_temperature": 313.15, "roelands_s0": 1.1}
ARRHENIUS = {"conductivity": 1e-10, "conductivity_activation": 5e4, "conductivity_temperature": 313.15}


@each("celsius, expected", [(40, 84.5), (60, 34.6), (80, 17.2), (100, 9.86)])
def test_viscosity_of_fva_3(celsius, expected):
    """0.062 mPa s exp(1021.7/(T + 101.5517)) with T in degrees Celsius, as printed."""
    found = 1e3 * vogel(celsius + 273.15, **VOGEL)
    assert found == pytest.approx(0.062 * math.exp(1021.7 / (celsius + 101.5517)), rel=1e-9)
    assert found == pytest.approx(expected, rel=3e-3)


vogels = st.fixed_dictionaries(
    {
        "vogel_viscosity": st.floats(1e-6, 1e-3),
        "vogel_b": st.floats(300.0, 3000.0),
        "vogel_c": st.floats(0.0, 220.0),
    }
)
roelands = st.fixed_dictionaries(
    {
        "viscosity": st.floats(1e-3, 10.0),
        "reference_temperature": st.floats(280.0, 380.0),
        "roelands_s0": st.floats(0.5, 2.0),
    }
)
temperatures = st.floats(270.0, 420.0)


def vogel_coefficient(temperature, _, oil):
    return oil["vogel_b"] / (temperature - oil["vogel_c"]) ** 2


def roelands_coefficient(temperature, viscosity, oil):
    return oil["roelands_s0"] * (math.log(viscosity) + 9.67) / (temperature - 138.0)


@pytest.mark.parametrize(
    ("name", "oils", "coefficient"),
    [("vogel", vogels, vogel_coefficient), ("roelands", roelands, roelands_coefficient)],
)
@given(data=st.data(), temperature=temperatures)
def test_the_slope_is_that_of_the_documentation(name, oils, coefficient, data, temperature):
    law, oil = ATMOSPHERIC_LAWS[name], data.draw(oils)
    h = 0.02
    logs = np.log(law.function(temperature + h * np.array([-2.0, -1.0, 1.0, 2.0]), **oil))
    difference = (logs[0] - 8.0 * logs[1] + 8.0 * logs[2] - logs[3]) / (12.0 * h)
    found = coefficient(temperature, float(law.function(temperature, **oil)), oil)
    assert found == pytest.approx(-difference, rel=1e-6, abs=1e-9)


def test_roelands_by_hand_and_its_limits():
    """At 80 degC: (ln 0.04 + 9.67)(215.15/175.15)^-1.1 - 9.67 = 6.45112 * 0.797509 - 9.67 = -4.52517."""
    assert np.log(roelands_over_temperature(353.15, **ROELANDS)) == pytest.approx(-4.52517, abs=1e-5)
    assert roelands_over_temperature(313.15, **ROELANDS) == pytest.approx(0.04, rel=1e-14)
    # Every oil tends to e^-9.67 Pa s where it is hot.
    assert roelands_over_temperature(1e9, **ROELANDS) == pytest.approx(math.exp(-9.67), rel=1e-4)


@each(
    "name, oil, temperature, text",
    [
        ("vogel", VOGEL, 171.0, r"171 K.* 171\.6 K"),
        ("vogel", VOGEL, None, "missing"),
        ("roelands", ROELANDS, 138.0, "138 K.* 138 K"),
        ("roelands", ROELANDS, None, "missing"),
    ],
)
def test_temperatures_outside_the_range(name, oil, temperature, text):
    with pytest.raises(InputError, match=rf"^temperature: .*{text}.*atmospheric_law '{name}'"):
        ATMOSPHERIC_LAWS[name].function(temperature, **oil)


def test_one_of_many_temperatures_is_named():
    with pytest.raises(InputError, match=r"^temperature: .* 150 K"):
        vogel(np.array([300.0, 150.0, 140.0]), **VOGEL)


def test_parameters_that_no_oil_has():
    with pytest.raises(InputError, match=r"^viscosity: .* 5e-05 Pa s.*'roelands'"):
        roelands_over_temperature(300.0, **(ROELANDS | {"viscosity": 5e-5}))
    with pytest.raises(InputError, match=r"^reference_temperature: .* 130 K.* 138 K"):
        roelands_over_temperature(300.0, **(ROELANDS | {"reference_temperature": 130.0}))


@given(temperature=temperatures, activation=st.floats(1e4, 1e5))
def test_arrhenius(temperature, activation):
    """The logarithm is a straight line over 1/T, with the slope -E/R of CODATA's gas constant."""
    oil = ARRHENIUS | {"conductivity_activation": activation}
    found = arrhenius(temperature, **oil)
    expected = math.log(1e-10) - activation / 8.314462618 * (1.0 / temperature - 1.0 / 313.15)
    assert np.log(found) == pytest.approx(expected, rel=1e-9)


def test_a_constant_conductivity_has_the_shape_of_the_temperature():
    assert constant_conductivity(conductivity=1e-12) == 1e-12
    np.testing.assert_array_equal(constant_conductivity(np.full(3, 300.0), conductivity=1e-12), 1e-12)


# Relative permittivity of FVA 3 at 40, 60 and 80 degC as measured (Dao, table permittivitaet_fva3).
TABLE = ([313.15, 333.15, 353.15], [2.070, 2.056, 2.027])


def test_table_of_permittivity():
    found = interpolated(np.array([313.15, 323.15, 343.15, 353.15]), *TABLE, table="permittivity_table")
    np.testing.assert_allclose(found, [2.070, 2.063, 2.0415, 2.027], rtol=1e-12)


def test_table_of_conductivity_is_that_of_arrhenius():
    """Two points of the law give it in between, unlike a line over T."""
    ends = [303.15, 373.15]
    values = arrhenius(np.array(ends), **ARRHENIUS)
    found = interpolated(340.0, ends, values, table="conductivity_table", arrhenius=True)
    assert found == pytest.approx(float(arrhenius(340.0, **ARRHENIUS)), rel=1e-9)
    assert interpolated(340.0, ends, values, table="conductivity_table") > 1.2 * found


@pytest.mark.parametrize("temperature", [293.15, 353.2])
def test_tables_are_not_extrapolated(temperature):
    text = rf"^temperature: .* {temperature:g} K.* 313\.15 to 353\.15 K.*permittivity_table"
    with pytest.raises(InputError, match=text):
        interpolated(np.array([320.0, temperature]), *TABLE, table="permittivity_table")
