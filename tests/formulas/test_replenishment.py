"""Supply of oil: SKF's replenishment factor, and the decay of a film without supply."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ehlectric.formulas.inlet_supply import (
    GEOMETRY_CONSTANTS,
    SUPPLY_CONSTANTS,
    decay_rate,
    film_half_time,
    replenishment_factor,
)
from ehlectric.lubricant.density import dowson_higginson
from tests.helpers.each import each

SIZE = {"bore": 0.04, "outer_diameter": 0.08}
BALL = {"kind": "deep-groove ball", **SIZE}
RPM = math.pi / 30.0


@each(
    "viscosity, rpm, bath, grease",
    [
        (46.0, 1000.0, 0.97, 0.94),
        (46.0, 15000.0, 0.61, 0.38),
        (14.85, 1000.0, 0.99, 0.98),
        (14.85, 3000.0, 0.97, 0.94),
        (14.85, 15000.0, 0.85, 0.73),
    ],
)
def test_factors_of_a_6208(viscosity, rpm, bath, grease):
    """Two digits of the same formula by another author, ISO VG 46 at 40 and at 70 degC."""
    for supply, expected in (("oil-bath", bath), ("oil-jet", bath), ("grease", grease), ("oil-air", grease)):
        found = replenishment_factor(rpm * RPM, 1e-6 * viscosity, supply=supply, **BALL)
        assert float(found) == pytest.approx(expected, rel=0.0, abs=0.0051)


def test_factor_by_hand():
    """Angular contact: K_rs nu n (d + D) sqrt(K_Z/(2 (D - d))) = 6e-8 * 100 * 1000 * 120 * sqrt(4.4/80)."""
    exponent = 6e-8 * 100.0 * 1000.0 * 120.0 * math.sqrt(4.4 / 80.0)
    found = replenishment_factor(1000.0 * RPM, 1e-4, supply="grease", kind="angular-contact ball", **SIZE)
    assert float(found) == pytest.approx(math.exp(-exponent), rel=1e-12, abs=0.0)


def test_oil_air_doubles_the_exponent_of_a_bath_and_a_flooded_bearing_has_none():
    at = (1000.0, 5e-5)
    bath, air, flooded = (
        float(replenishment_factor(*at, supply=supply, **BALL))
        for supply in ("oil-bath", "oil-air", "flooded")
    )
    assert air == pytest.approx(bath**2, rel=1e-12, abs=0.0)
    assert flooded == 1.0


@given(
    speed=st.floats(1.0, 1e3),
    viscosity=st.floats(1e-6, 1e-4),
    more=st.floats(1.01, 3.0),
    supply=st.sampled_from([name for name, constant in SUPPLY_CONSTANTS.items() if constant]),
    kind=st.sampled_from(sorted(GEOMETRY_CONSTANTS)),
    bore=st.floats(5e-3, 0.1),
    ratio=st.floats(1.3, 3.0),
)
def test_factor_falls_with_speed_and_viscosity(speed, viscosity, more, supply, kind, bore, ratio):
    given = {"supply": supply, "kind": kind, "bore": bore, "outer_diameter": ratio * bore}
    factor = replenishment_factor(speed, viscosity, **given)
    assert 0.0 < factor < 1.0
    # It depends on the product of both alone.
    faster = replenishment_factor(more * speed, viscosity, **given)
    assert faster < factor
    assert replenishment_factor(speed, more * viscosity, **given) == pytest.approx(float(faster), rel=1e-9)


def density(pressure):
    """Density ratio by Dowson and Higginson with the constants of the paper's lubricant."""
    return float(dowson_higginson(pressure, density_c1=0.59e9, density_c2=1.34)[0])


def grease(pressure, radius, ratio, track):
    """Rate of a ball on a disc with Li/M grease: base oil of 0.38 Pa s and 30 1/GPa."""
    return decay_rate(
        max_pressure=pressure,
        semi_axes=(radius, ratio * radius),
        viscosity=0.38,
        pressure_viscosity_coefficient=30e-9,
        density_ratio=density(pressure),
        track_length=2.0 * math.pi * track,
    )


def decayed_thickness(thickness, time, rate):
    """Solution of dh/dt = -(rate/2) h^3."""
    return thickness / np.sqrt(1.0 + rate * time * thickness**2)


def test_decay_of_grease_between_ball_and_disc():
    """90 nm become 22.8 nm in 1020 s by the same formula of another author; about 20 nm were measured."""
    rate = grease(0.48e9, 141e-6, 1.0, 0.040 + 0.00953)
    assert float(decayed_thickness(90e-9, 1020.0, rate)) == pytest.approx(22.8e-9, rel=3e-3)


@each("ratio, time", [(1, 9.44), (2, 37.7), (10, 944.0), (50, 23591.0)])
def test_decay_over_the_ratio_of_the_semi_axes(ratio, time):
    """From 310 to 125 nm at 0.22 GPa, by the same author; times go with the square of the ratio."""
    rate = grease(0.22e9, 39.2e-6, ratio, 0.045 + 0.00391)
    assert float(decayed_thickness(310e-9, time, rate)) == pytest.approx(125e-9, rel=2e-3)


def test_decay_solves_the_equation_of_the_layer():
    """dh/dt = -(rate/2) h^3, integrated over time."""
    start, rate = 300e-9, 1e13
    time = np.linspace(0.0, 20.0, 9)
    found = solve_ivp(lambda _, h: -0.5 * rate * 1e-18 * h**3, (0.0, 20.0), [300.0], t_eval=time, rtol=1e-10)
    assert decayed_thickness(start, time, rate) == pytest.approx(1e-9 * found.y[0], rel=1e-7)


@given(start=st.floats(1e-9, 1e-5), rate=st.floats(1e8, 1e18))
def test_half_time_leaves_half(start, rate):
    assert float(decayed_thickness(start, film_half_time(start, rate), rate)) == pytest.approx(0.5 * start)
