"""Laws of the lubricant against printed values, limits and their own derivatives."""

from inspect import Parameter as Kind
from inspect import signature

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.errors import InputError
from ehlectric.lubricant import density, electrical_laws, viscosity
from tests.helpers.each import each

ROELANDS = {"pressure_viscosity_coefficient": 22e-9, "roelands_z": 0.67, "roelands_pressure": 0.198e9}
DENSITY = {"density_c1": 0.59e9, "density_c2": 1.34}
PRESSURE_LAWS = [
    (viscosity.roelands, ROELANDS),
    (viscosity.barus, {"pressure_viscosity_coefficient": 22e-9}),
    (viscosity.constant_viscosity, {}),
    (density.dowson_higginson, DENSITY),
    (density.incompressible, {}),
]
pressures = st.floats(0.0, 1e10)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "parameters"), PRESSURE_LAWS)
@given(pressure=pressures)
def test_slope_is_the_derivative(law, parameters, pressure):
    step = 1e-4 * (pressure + 1e8)
    central = (law(pressure + step, **parameters)[0] - law(pressure - step, **parameters)[0]) / (2 * step)
    assert law(pressure, **parameters)[1] == pytest.approx(central, rel=1e-5, abs=1e-18)


# Parameters anywhere within the bounds of the inputs.
roelands_parameters = st.fixed_dictionaries(
    {
        "pressure_viscosity_coefficient": st.floats(1e-11, 2e-7),
        "roelands_z": st.floats(0.01, 2.0),
        "roelands_pressure": st.floats(1e7, 1e10),
    }
)
density_parameters = st.fixed_dictionaries(
    {"density_c1": st.floats(1e7, 1e11), "density_c2": st.floats(1.0, 3.0)}
)


@given(pressure=pressures, of_viscosity=roelands_parameters, of_density=density_parameters)
def test_laws_of_any_parameters_have_their_slope(pressure, of_viscosity, of_density):
    for law, parameters in ((viscosity.roelands, of_viscosity), (density.dowson_higginson, of_density)):
        value, slope = law(pressure, **parameters)
        assert np.isfinite(value)
        assert slope >= 0.0
        # Wide enough for rounding, narrow enough for the laws' own scale of some 1e7 Pa.
        step = 1e-4 * (pressure + 1e7)
        low, high = (law(max(pressure + sign * step, 0.0), **parameters)[0] for sign in (-1, 1))
        mean = (high - low) / (pressure + step - max(pressure - step, 0.0))
        assert slope == pytest.approx(mean, rel=1e-3, abs=1e-11 * value / step)


@given(pressure=pressures, parameters=density_parameters)
def test_density_lies_between_its_limits(pressure, parameters):
    ratio, slope = density.dowson_higginson(pressure, **parameters)
    assert 1.0 <= ratio <= parameters["density_c2"] * (1 + 1e-15)
    # The bulk modulus rho/(drho/dp) at p = 0 is C1/(C2 - 1).
    bulk = density.dowson_higginson(0.0, **parameters)[1] * parameters["density_c1"]
    assert bulk == pytest.approx(parameters["density_c2"] - 1.0, abs=1e-12)
    assert slope <= (parameters["density_c2"] - 1.0) / parameters["density_c1"] * (1 + 1e-12)


@given(pressure=pressures, parameters=roelands_parameters)
def test_roelands_lies_below_barus_where_z_is_below_one(pressure, parameters):
    """And above it where z is above one: (1 + x)^z - 1 against z x, Bernoulli's inequality."""
    alpha = parameters["pressure_viscosity_coefficient"]
    difference = viscosity.roelands(pressure, **parameters)[0] - alpha * pressure
    # (1 + x)^z - 1 loses what 1 + x rounds off.
    rounding = 1e-14 * (alpha * pressure + alpha * parameters["roelands_pressure"] / parameters["roelands_z"])
    assert np.sign(parameters["roelands_z"] - 1.0) * difference >= -rounding


@pytest.mark.parametrize(("law", "parameters"), PRESSURE_LAWS)
@given(low=pressures, high=pressures)
def test_laws_rise_with_pressure(law, parameters, low, high):
    low, high = sorted((low, high))
    rounding = 4.0 * np.finfo(float).eps
    assert law(low, **parameters)[0] <= law(high, **parameters)[0] * (1.0 + rounding)


@each("law, parameters", PRESSURE_LAWS)
def test_isothermal_laws_take_no_notice_of_the_temperature(law, parameters):
    pressure = np.array([0.0, 1e8, 1e9])
    cold, hot = (
        law(pressure, temperature, **parameters) for temperature in (None, np.array([300.0, 350, 400]))
    )
    np.testing.assert_array_equal(cold, hot)


def test_permittivity_laws_take_no_notice_of_the_temperature():
    for law in (electrical_laws.clausius_mossotti, electrical_laws.constant_permittivity):
        cold, hot = (law(np.array([1.0, 1.2]), at, relative_permittivity=2.4) for at in (None, 350.0))
        np.testing.assert_array_equal(cold, hot)


TABLES = (viscosity.VISCOSITY_LAWS, density.DENSITY_LAWS, electrical_laws.PERMITTIVITY_LAWS)
LAWS = [law for table in TABLES for law in table.values()]


@each("law", [law for table in TABLES for law in table.values()], ids=lambda law: law.function.__name__)
def test_parameters_of_an_entry_are_the_keywords_of_its_functions(law):
    """So that a law is called with what its case gives, and a warning of it too."""
    names = {parameter.name for parameter in law.parameters}
    _, _, *keywords = signature(law.function).parameters.values()
    own = {keyword.name for keyword in keywords if keyword.kind is Kind.KEYWORD_ONLY}
    passed_on = {one.name for one in density.TAIT.parameters} if len(own) < len(keywords) else set()
    assert own | passed_on == names
    assert len(own) + len(passed_on) == len(names)
    given = dict.fromkeys(names, 1.0)
    if law.atmospheric is not None:
        signature(law.atmospheric).bind(300.0, **given)
    if law.warnings is not None:
        signature(law.warnings).bind(1e9, 0.01, 300.0, **given)
        keywords = signature(law.warnings).parameters.values()
        assert {keyword.name for keyword in keywords if keyword.kind is Kind.KEYWORD_ONLY} <= names


def test_the_state_that_laws_pass_on_is_that_of_tait():
    assert set(density.TaitState.__annotations__) == {one.name for one in density.TAIT.parameters}


def test_a_name_means_one_parameter():
    known = {}
    for law in LAWS:
        for parameter in law.parameters:
            assert known.setdefault(parameter.name, parameter) == parameter


def test_roelands_is_barus_at_low_pressure_and_for_z_one():
    exponent, slope = viscosity.roelands(np.array([0.0, 1e3]), **ROELANDS)
    assert exponent[0] == 0.0
    assert slope[0] == ROELANDS["pressure_viscosity_coefficient"]
    assert exponent[1] == pytest.approx(22e-9 * 1e3, rel=1e-5, abs=0.0)
    linear, _ = viscosity.roelands(2e9, **(ROELANDS | {"roelands_z": 1.0}))
    assert linear == pytest.approx(viscosity.barus(2e9, pressure_viscosity_coefficient=22e-9)[0])


def test_density_limits():
    ratio, _ = density.dowson_higginson(np.array([0.0, 1e20]), **DENSITY)
    np.testing.assert_allclose(ratio, [1.0, 1.34], rtol=1e-9)


# eps(1 GPa) = 2.888 and eps(2 GPa) = 3.014 for eps_r = 2.4, by hand from eqs. (12) and (14).
@pytest.mark.parametrize(("pressure", "expected"), [(0.0, 2.4), (1e9, 2.888), (2e9, 3.014)])
def test_permittivity_of_compressed_oil(pressure, expected):
    ratio, _ = density.dowson_higginson(pressure, **DENSITY)
    relative = electrical_laws.clausius_mossotti(ratio, relative_permittivity=2.4)
    assert relative == pytest.approx(expected, abs=5e-4)


@pytest.mark.slow
@pytest.mark.gate
@given(ratio=st.floats(0.5, 1.4), reference=st.floats(1.0, 6.0))
def test_clausius_mossotti_keeps_the_molar_polarisation(ratio, reference):
    """(eps - 1)/(eps + 2) is proportional to the density: the law before it is solved for eps."""
    eps = electrical_laws.clausius_mossotti(ratio, relative_permittivity=reference)
    left = (eps - 1) / (eps + 2)
    assert left == pytest.approx(ratio * (reference - 1) / (reference + 2), rel=1e-9, abs=1e-12)


@given(ratio=st.floats(0.0, 1.4), more=st.floats(0.0, 0.1), reference=st.floats(1.0, 3.9))
def test_clausius_mossotti_limits(ratio, more, reference):
    """Vacuum where there is no liquid, the given value at its own density, and rising between."""
    eps = electrical_laws.clausius_mossotti(
        np.array([0.0, ratio, ratio + more, 1.0]), relative_permittivity=reference
    )
    assert eps[0] == 1.0
    assert 1.0 <= eps[1] <= eps[2] * (1 + 1e-15)
    assert eps[3] == pytest.approx(reference, rel=1e-14, abs=0.0)


def test_clausius_mossotti_refuses_its_pole():
    with pytest.raises(InputError, match=r"clausius-mossotti.*pole.*1\.038"):
        electrical_laws.clausius_mossotti(np.array([1.0, 1.1]), relative_permittivity=80.0)


def test_constant_permittivity():
    np.testing.assert_array_equal(
        electrical_laws.constant_permittivity(np.array([1.0, 1.3]), relative_permittivity=80.0), 80.0
    )


@each("law, parameters", PRESSURE_LAWS)
def test_slope_is_the_quotient_of_differences(law, parameters):
    pressure = np.array([1e7, 3e8, 1e9])
    (low, high), step = (law(pressure + sign * 1e4, **parameters)[0] for sign in (-1.0, 1.0)), 2e4
    assert law(pressure, **parameters)[1] == pytest.approx((high - low) / step, rel=1e-5, abs=1e-16)


def test_clausius_mossotti_is_large_just_below_its_pole():
    """By hand: (5 + 2 + 2 4 1.6)/(5 + 2 - 4 1.6) = 33; the pole is at a density ratio of 7/4."""
    assert electrical_laws.clausius_mossotti(1.6, relative_permittivity=5.0) == pytest.approx(33.0)
