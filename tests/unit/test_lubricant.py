"""Laws of the lubricant against printed values, limits and their own derivatives."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import lubricant
from ehlectric.errors import InputError

ROELANDS = {"pressure_viscosity_coefficient": 22e-9, "roelands_z": 0.67, "roelands_pressure": 0.198e9}
DENSITY = {"density_c1": 0.59e9, "density_c2": 1.34}
PRESSURE_LAWS = [
    (lubricant.roelands, ROELANDS),
    (lubricant.barus, {"pressure_viscosity_coefficient": 22e-9}),
    (lubricant.constant_viscosity, {}),
    (lubricant.dowson_higginson, DENSITY),
    (lubricant.incompressible, {}),
]
pressures = st.floats(0.0, 1e10)


@pytest.mark.parametrize(("law", "parameters"), PRESSURE_LAWS)
@given(pressure=pressures)
def test_slope_is_the_derivative(law, parameters, pressure):
    step = 1e-4 * (pressure + 1e8)
    central = (law(pressure + step, **parameters)[0] - law(pressure - step, **parameters)[0]) / (2 * step)
    assert law(pressure, **parameters)[1] == pytest.approx(central, rel=1e-5, abs=1e-18)


@pytest.mark.parametrize(("law", "parameters"), PRESSURE_LAWS)
@given(low=pressures, high=pressures)
def test_laws_rise_with_pressure(law, parameters, low, high):
    low, high = sorted((low, high))
    assert law(low, **parameters)[0] <= law(high, **parameters)[0]


def test_roelands_is_barus_at_low_pressure_and_for_z_one():
    exponent, slope = lubricant.roelands(np.array([0.0, 1e3]), **ROELANDS)
    assert exponent[0] == 0.0
    assert slope[0] == ROELANDS["pressure_viscosity_coefficient"]
    assert exponent[1] == pytest.approx(22e-9 * 1e3, rel=1e-5)
    linear, _ = lubricant.roelands(2e9, **(ROELANDS | {"roelands_z": 1.0}))
    assert linear == pytest.approx(lubricant.barus(2e9, pressure_viscosity_coefficient=22e-9)[0])


def test_density_limits():
    ratio, _ = lubricant.dowson_higginson(np.array([0.0, 1e20]), **DENSITY)
    np.testing.assert_allclose(ratio, [1.0, 1.34], rtol=1e-9)


# eps(1 GPa) = 2.888 and eps(2 GPa) = 3.014 for eps_r = 2.4, by hand from eqs. (12) and (14).
@pytest.mark.parametrize(("pressure", "expected"), [(0.0, 2.4), (1e9, 2.888), (2e9, 3.014)])
def test_permittivity_of_compressed_oil(pressure, expected):
    ratio, _ = lubricant.dowson_higginson(pressure, **DENSITY)
    permittivity = lubricant.clausius_mossotti(ratio, relative_permittivity=2.4)
    assert permittivity == pytest.approx(expected, abs=5e-4)


@given(ratio=st.floats(0.5, 1.4), reference=st.floats(1.0, 6.0))
def test_clausius_mossotti_keeps_the_molar_polarisation(ratio, reference):
    """(eps - 1)/(eps + 2) is proportional to the density: the law before it is solved for eps."""
    eps = lubricant.clausius_mossotti(ratio, relative_permittivity=reference)
    left = (eps - 1) / (eps + 2)
    assert left == pytest.approx(ratio * (reference - 1) / (reference + 2), rel=1e-9, abs=1e-12)


def test_clausius_mossotti_refuses_its_pole():
    with pytest.raises(InputError, match=r"clausius-mossotti.*pole.*1\.038"):
        lubricant.clausius_mossotti(np.array([1.0, 1.1]), relative_permittivity=80.0)


def test_constant_permittivity():
    np.testing.assert_array_equal(
        lubricant.constant_permittivity(np.array([1.0, 1.3]), relative_permittivity=80.0), 80.0
    )
