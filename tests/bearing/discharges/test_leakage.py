"""Leakage of the shaft voltage through the oil, by hand and by a step-by-step solution."""

import math

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric.bearing.circuit import leakage_conductance, leaking_admittance
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS, bearing_case

LEAKY = {"discharge__conductivity": "1 mS/m"}


def solved(**changes):
    return solve_bearing(bearing_case(BALLS, contacts="formula", **changes), workers=1)


def totals(result):
    return summary_of(result.solution)["bearing"]


def codes(result):
    return {one.code for one in result.warnings}


@pytest.mark.slow
def test_a_leaky_oil_makes_the_shaft_voltage_an_upper_bound():
    """1 mS/m at a permittivity of 2.4: 21 ns; both bearings have about a third of the capacitance."""
    result = solved(**LEAKY)
    found = totals(result)
    tau = epsilon_0 * 2.4 / 1e-3
    assert found["relaxation_time"] == pytest.approx(tau, rel=1e-12)
    both = 2.0 * found["capacitance"]
    assert found["shaft_time_constant"] == pytest.approx((1.02e-9 + both) * tau / both, rel=1e-9)
    (warning,) = (one for one in result.warnings if one.code == "shaft-leaks")
    assert "21.25 ns" in warning.text
    assert "50 µs to 250 µs" in warning.text
    assert f"{result.shaft_voltage:.3g} V" in warning.text


@pytest.mark.slow
def test_a_tight_oil_says_nothing():
    """1 pS/m: 21 s, and a shaft that keeps its voltage over any period."""
    result = solved(motor__switching_frequency="8 kHz")
    assert "shaft-leaks" not in codes(result)
    found = totals(result)
    assert found["shaft_voltage_after_period"] == pytest.approx(found["shaft_voltage"], rel=1e-5)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("over", [0.9, 1.1])
def test_the_period_decides(over):
    time = totals(solved(**LEAKY))["shaft_time_constant"]
    result = solved(**LEAKY, motor__switching_frequency=1.0 / (over * time))
    assert ("shaft-leaks" in codes(result)) == (over > 1.0)
    found = totals(result)
    assert found["shaft_voltage_after_period"] == pytest.approx(
        found["shaft_voltage"] * math.exp(-over), rel=1e-9
    )


def test_the_voltage_after_an_edge_is_that_of_small_steps():
    """dV/dt = V_shaft/t_r - V/T, in a hundred thousand steps of the midpoint rule."""
    result = solved(**LEAKY, motor__rise_time="0.2 us", motor__switching_frequency="10 kHz")
    found = totals(result)
    slope, time = found["shaft_voltage"] / 0.2e-6, found["shaft_time_constant"]
    voltage, step = 0.0, 0.2e-6 / 100_000
    for _ in range(100_000):
        voltage = (voltage * (1.0 - 0.5 * step / time) + step * slope) / (1.0 + 0.5 * step / time)
    assert found["shaft_voltage_after_rise"] == pytest.approx(voltage, rel=1e-8)
    (warning,) = (one for one in result.warnings if one.code == "shaft-leaks")
    assert "200 ns" in warning.text
    assert f"{voltage:.3g} V" in warning.text


def test_air_around_the_films_leaks_less():
    oil, air = (totals(solved(**LEAKY, bearing__fill=fill)) for fill in ("oil", "air"))
    assert air["shaft_time_constant"] > oil["shaft_time_constant"]


def test_the_conductance_is_that_of_high_frequencies():
    """The real part of the admittance of unlike contacts, far above the corner frequency."""
    inner, outer = (np.array([2e-10]), np.array([1e-10])), (np.array([0.5e-10]), np.array([0.2e-10]))
    high = leaking_admittance(inner, outer, 1.0, np.array([1e5]))[0]
    assert leakage_conductance(inner, outer, 1.0) == pytest.approx(high.real, rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    "changes",
    [
        {"motor": None},
        {"discharge__conductivity": None},
        {"bearing__composite_rq": "0.3 um"},
        {"bearing__element_material": "silicon-nitride"},
    ],
)
def test_without_a_shaft_voltage_nothing_leaks(changes):
    result = solved(**(LEAKY | changes))
    assert totals(result)["shaft_time_constant"] is None
    assert "shaft-leaks" not in codes(result)


def test_an_edge_is_shorter_than_a_period():
    with pytest.raises(InputError, match=r"^motor\.rise_time: .*0\.001 s.*0\.0001 s"):
        bearing_case(BALLS, motor__rise_time="1 ms", motor__switching_frequency="10 kHz")
