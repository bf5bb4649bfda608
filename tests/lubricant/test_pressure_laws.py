"""Laws over pressure and temperature against printed values, other formulations and their derivatives."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import gamma, gammaincc

from ehlectric.cases.case_oil import Lubricant
from ehlectric.errors import InputError
from ehlectric.lubricant import density as state
from ehlectric.lubricant import doolittle as free_volume
from ehlectric.lubricant import electrical_laws, heat_laws, modulus, yasutomi
from ehlectric.lubricant.density import DENSITY_LAWS, dowson_higginson, tait_pressure
from ehlectric.lubricant.law import GLASS_VISCOSITY, LARGEST_EXPONENT
from ehlectric.lubricant.viscosity import (
    VISCOSITY_LAWS,
    barus,
    initial_alpha,
    reciprocal_asymptotic_alpha,
    roelands,
    unfinished_share,
)
from tests.helpers.each import each
from tests.lubricant.oils import (
    DOOLITTLE,
    LARSSON_C,
    LARSSON_K,
    MODULUS,
    MURNAGHAN,
    SCALED_C,
    SCALED_K,
    TAIT,
    YASUTOMI,
    around,
)

LAWS = {
    "modulus": (modulus.modulus, MODULUS),
    "yasutomi": (yasutomi.yasutomi, YASUTOMI),
    "doolittle": (free_volume.doolittle, DOOLITTLE),
    "tait": (state.tait, TAIT),
    "murnaghan": (state.murnaghan, MURNAGHAN),
    "thermal-larsson": (heat_laws.larsson_thermal_conductivity, LARSSON_K),
    "thermal-scaling": (heat_laws.scaled_thermal_conductivity, SCALED_K),
    "heat-larsson": (heat_laws.larsson_heat_capacity, LARSSON_C),
    "heat-scaling": (heat_laws.scaled_heat_capacity, SCALED_C),
}
by_law = pytest.mark.parametrize("name", LAWS)
temperatures = st.floats(290.0, 420.0)
pressures = st.floats(1e6, 3e9)
CELSIUS = 273.15


def difference(function, at, step):
    """Derivative by a five-point formula, whose error is of the fourth order."""
    near, far = (function(at + s * step) - function(at - s * step) for s in (1.0, 2.0))
    return (8.0 * near - far) / (12.0 * step)


@pytest.mark.slow
@by_law
@given(data=st.data(), pressure=pressures, temperature=temperatures)
def test_slope_is_the_derivative(name, data, pressure, temperature):
    law, oil = LAWS[name]
    oil = data.draw(around(oil))
    value, slope = law(pressure, temperature, **oil)
    step = 3e-4 * (pressure + 1e7)
    ends = law(pressure + np.array([-2.0, 2.0]) * step, temperature, **oil)[1]
    # Not across the edge of a cap, where the slope jumps to zero, nor across the largest beta of Larsson.
    assume(np.all(ends > 0.0) or np.all(ends == 0.0))
    if name == "heat-larsson":
        assume(abs(pressure + oil["larsson_b1"] / (2.0 * oil["larsson_b2"])) > 3.0 * step)
    found = difference(lambda p: float(law(p, temperature, **oil)[0]), pressure, step)
    assert slope == pytest.approx(found, rel=1e-6, abs=1e-13 * abs(float(value)) / step)


@pytest.mark.slow
@by_law
@given(data=st.data(), temperature=temperatures)
def test_laws_rise_with_pressure_without_a_jump(name, data, temperature):
    law, oil = LAWS[name]
    p = np.linspace(0.0, 20e9, 2001)
    value, slope = law(p, temperature, **data.draw(around(oil)))
    assert np.all(np.isfinite(value))
    assert np.all(slope >= 0.0)
    assert np.all(np.diff(value) >= -1e-12 * value[1:])
    # A jump would exceed what the steeper end of the interval allows.
    assert np.all(np.diff(value) <= 3.0 * np.maximum(slope[1:], slope[:-1]) * np.diff(p) + 1e-12 * value[1:])


@each("name", LAWS)
def test_temperatures_broadcast_and_are_needed(name):
    law, oil = LAWS[name]
    p, at = np.array([[0.0], [1e9]]), np.array([300.0, 340.0, 380.0])
    table = law(p, at, **oil)[0]
    if name != "thermal-larsson":
        assert table.shape == (2, 3)
        assert table[1, 2] == pytest.approx(float(law(1e9, 380.0, **oil)[0]), rel=1e-14)
        with pytest.raises(InputError, match=r"^temperature: missing.*_law '"):
            law(p, None, **oil)


# ---- Viscosity


@each("celsius, alpha, star", [(40, 22.4, 21.6), (60, 19.7, 18.8), (80, 17.6, 16.6), (100, 16.0, 14.8)])
def test_coefficients_of_fva_3(celsius, alpha, star):
    """Slope at zero pressure 1/(a1 + a2 T) with the printed constants; alpha* of another program."""
    law = partial(modulus.modulus, temperature=celsius + CELSIUS, **MODULUS)
    by_hand = 1e9 / ((327.7918 + 2.9862 * celsius) * 1e5)
    assert initial_alpha(law) * 1e9 == pytest.approx(by_hand, rel=1e-12)
    assert by_hand == pytest.approx(alpha, abs=0.051)
    assert reciprocal_asymptotic_alpha(law) * 1e9 == pytest.approx(star, abs=0.051)


def test_modulus_law_by_hand_in_the_units_of_print():
    """p = 5000 bar at 60 degC: 5000/(327.7918 + 179.172 + (0.004419 + 0.018069) 5000) = 8.0711."""
    exponent, _ = modulus.modulus(5e8, 333.15, **MODULUS)
    assert exponent == pytest.approx(5000.0 / (506.9638 + 0.022488 * 5000.0), rel=1e-9)


# N100 of Arana et al., Proc. IMechE J 233 (2019) 303, table 2: B < 0 at 40 degC, a pole at -A/B = 50 GPa.
N100 = {"modulus_a1": -7.23e7, "modulus_a2": 3.48e5, "modulus_b1": 5.00e-3, "modulus_b2": -1.83e-5}


def test_modulus_law_is_capped_before_its_pole():
    a, b = -7.23e7 + 3.48e5 * 313.15, 5.00e-3 - 1.83e-5 * 313.15
    assert b < 0.0 < a
    cap = LARGEST_EXPONENT * a / (1.0 - LARGEST_EXPONENT * b)
    assert cap < -a / b
    value, slope = modulus.modulus(np.array([0.999, 1.001, 100.0]) * cap, 313.15, **N100)
    assert value[0] == pytest.approx(LARGEST_EXPONENT, rel=2e-3)
    assert value[1:].tolist() == [LARGEST_EXPONENT] * 2
    assert slope[0] > 0.0
    assert slope[1:].tolist() == [0.0, 0.0]


def test_modulus_law_tends_to_its_limit_where_it_has_no_pole():
    """1/B = 1/0.034522 for FVA 3 at 100 degC, below the cap: the law needs none."""
    value, slope = modulus.modulus(1e14, 373.15, **MODULUS)
    assert value == pytest.approx(1.0 / (4.419e-3 + 3.0115e-2), rel=1e-3)
    assert slope > 0.0


def test_yasutomi_at_ambient_pressure():
    """13.7 mPa s at 25 degC, where 13.8 is measured; coefficients by another program."""
    assert yasutomi.yasutomi_viscosity(298.15, **YASUTOMI) * 1e3 == pytest.approx(13.70, abs=5e-3)
    for at, alpha in ((298.15, 24.66), (373.15, 14.86)):
        law = partial(yasutomi.yasutomi, temperature=at, **YASUTOMI)
        assert initial_alpha(law) * 1e9 == pytest.approx(alpha, abs=5e-3)


def test_yasutomi_is_the_law_of_williams_landel_and_ferry_in_powers_of_ten():
    """At 0.5 GPa and 60 degC: Tg = -83.2 + 188.86 ln 1.3595 = -25.20 degC, F = 5.1^-0.5278 = 0.42319."""
    glass = -83.2 + 188.86 * math.log(1.3595)
    reduced = (60.0 - glass) * 5.1**-0.5278
    log10 = 12.0 - 16.09 * reduced / (17.38 + reduced)
    found = yasutomi.yasutomi(0.5e9, 333.15, **YASUTOMI)[0] + np.log(
        yasutomi.yasutomi_viscosity(333.15, **YASUTOMI)
    )
    assert found / math.log(10.0) == pytest.approx(log10, rel=1e-12)


@given(oil=around(YASUTOMI), temperature=temperatures)
def test_yasutomi_ends_at_the_viscosity_of_the_glass(oil, temperature):
    cap = (
        math.expm1((temperature - oil["yasutomi_glass_temperature"]) / oil["yasutomi_a1"])
        / oil["yasutomi_a2"]
    )
    eta = yasutomi.yasutomi_viscosity(temperature, **oil)
    value, slope = yasutomi.yasutomi(np.array([1.0 - 1e-9, 1.0 + 1e-9, 10.0]) * cap, temperature, **oil)
    np.testing.assert_allclose(value + np.log(eta), math.log(oil["yasutomi_glass_viscosity"]), atol=1e-6)
    assert slope[0] > 0.0
    assert slope[1:].tolist() == [0.0, 0.0]


def of_the_free_volume(pressure, temperature, oil):
    """Doolittle's law as printed, without a cap: V_inf/V_inf,R over V/V_R - R0 V_inf/V_inf,R."""
    modulus_0 = oil["tait_k00"] * math.exp(-oil["tait_beta_k"] * temperature)
    k = 1.0 + oil["tait_k0_prime"]
    warmer = temperature - oil["reference_temperature"]
    volume = (1.0 - math.log(1.0 + pressure * k / modulus_0) / k) * (1.0 + oil["tait_expansion"] * warmer)
    occupied, r0 = 1.0 + oil["doolittle_epsilon"] * warmer, oil["doolittle_r0"]
    free = volume - r0 * occupied
    return oil["doolittle_viscosity"] * math.exp(
        oil["doolittle_b"] * r0 * (occupied / free - 1.0 / (1.0 - r0))
    )


@pytest.mark.slow
@pytest.mark.gate
@given(oil=around(DOOLITTLE, 0.05), pressure=st.floats(0.0, 0.5e9), temperature=st.floats(310.0, 400.0))
def test_doolittle_is_the_printed_law_below_its_cap(oil, pressure, temperature):
    expected = of_the_free_volume(pressure, temperature, oil)
    assume(expected < 1e11)
    eta = free_volume.doolittle_ambient(temperature, **oil)
    found = eta * np.exp(free_volume.doolittle(pressure, temperature, **oil)[0])
    assert found == pytest.approx(expected, rel=1e-9)


def test_doolittle_ends_at_the_viscosity_of_the_glass():
    cap = brentq(
        lambda p: of_the_free_volume(p, 323.0, DOOLITTLE) / GLASS_VISCOSITY - 1.0, 1e8, 1.5e9, xtol=1.0
    )
    value, slope = free_volume.doolittle(np.array([1.0 - 1e-6, 1.0 + 1e-6, 10.0]) * cap, 323.0, **DOOLITTLE)
    np.testing.assert_allclose(value, math.log(GLASS_VISCOSITY / 0.0348), rtol=1e-4)
    assert slope[0] > 0.0
    assert slope[1:].tolist() == [0.0, 0.0]
    assert free_volume.doolittle_ambient(323.0, **DOOLITTLE) == pytest.approx(0.0348, rel=1e-14)


def yasutomi_coefficient(temperature, oil):
    distance = temperature - oil["yasutomi_glass_temperature"] + oil["yasutomi_c2"]
    return math.log(10.0) * oil["yasutomi_c1"] * oil["yasutomi_c2"] / distance**2


def doolittle_coefficient(temperature, oil):
    warmer, r0 = temperature - oil["reference_temperature"], oil["doolittle_r0"]
    expansion, epsilon = oil["tait_expansion"], oil["doolittle_epsilon"]
    free = 1.0 + expansion * warmer - r0 * (1.0 + epsilon * warmer)
    return oil["doolittle_b"] * r0 * (expansion - epsilon) / free**2


AMBIENT = [
    ("yasutomi", YASUTOMI, yasutomi_coefficient),
    ("doolittle", DOOLITTLE, doolittle_coefficient),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "oil", "coefficient"), AMBIENT, ids=["yasutomi", "doolittle"])
@given(temperature=st.floats(280.0, 430.0))
def test_slope_at_ambient_pressure_by_hand(name, oil, coefficient, temperature):
    """-d ln(eta0)/dT, differentiated on paper."""
    law = VISCOSITY_LAWS[name]
    found = difference(lambda at: -float(np.log(law.atmospheric(at, **oil))), temperature, 0.02)
    assert coefficient(temperature, oil) == pytest.approx(found, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "oil", "cold", "least"),
    [
        ("modulus", MODULUS, 160.0, "above 163.38 K"),
        ("yasutomi", YASUTOMI, 189.0, "above 189.95 K"),
        ("doolittle", DOOLITTLE, 150.0, "above "),
    ],
)
def test_a_temperature_below_the_range_is_one_line_with_law_and_range(name, oil, cold, least):
    with pytest.raises(InputError, match=rf"^temperature: .* {cold:g} K; .*{least}.*viscosity_law '{name}'"):
        VISCOSITY_LAWS[name].function(1e8, cold, **oil)


def test_the_range_of_doolittle_begins_at_the_viscosity_of_the_glass():
    with pytest.raises(InputError) as error:
        free_volume.doolittle_ambient(150.0, **DOOLITTLE)
    least = float(str(error.value.takes).split()[1])
    assert free_volume.doolittle_ambient(least + 0.02, **DOOLITTLE) == pytest.approx(GLASS_VISCOSITY, rel=0.1)


def test_parameters_of_no_liquid():
    with pytest.raises(InputError, match=r"^modulus_a1: .* -1e\+07 Pa.* 0 Pa"):
        modulus.modulus(1e8, 300.0, **(MODULUS | {"modulus_a1": -1e7, "modulus_a2": 0.0}))
    with pytest.raises(InputError, match=r"^doolittle_epsilon: .* 0\.001 1/K.*tait_expansion"):
        free_volume.doolittle_ambient(330.0, **(DOOLITTLE | {"doolittle_epsilon": 1e-3}))


@pytest.mark.parametrize(
    ("name", "oil", "temperature", "cap"),
    [
        ("yasutomi", YASUTOMI, 298.15, 1.0757e9),
        ("modulus", N100, 313.15, 1.2511e9),
        ("doolittle", DOOLITTLE, 323.0, None),
    ],
)
def test_warning_where_the_cap_begins(name, oil, temperature, cap):
    law = VISCOSITY_LAWS[name]
    if cap is None:
        cap = brentq(lambda p: of_the_free_volume(p, temperature, oil) / 1e12 - 1.0, 1e8, 1.5e9)
    assert not list(law.warnings(0.999 * cap, 0.05, temperature, **oil))
    (warning,) = law.warnings(1.001 * cap, 0.05, temperature, **oil)
    assert warning.code == "law-range"
    assert f" {cap / 1e9:.3g} GPa" in warning.text
    assert repr(name) in warning.text


def test_hot_oil_has_no_cap():
    assert not list(VISCOSITY_LAWS["modulus"].warnings(5e9, 0.01, 373.15, **MODULUS))
    assert not list(VISCOSITY_LAWS["yasutomi"].warnings(2e9, 0.002, 373.15, **YASUTOMI))


# ---- Density and permittivity


@pytest.mark.parametrize(("law", "oil"), [(state.tait, TAIT), (state.murnaghan, MURNAGHAN)])
def test_bulk_modulus_at_zero_pressure_and_its_derivative(law, oil):
    """K = rho/(drho/dp) is K00 exp(-beta T) at p = 0, and dK/dp is K0' there."""
    p = np.array([0.0, 1e5, 2e5])
    ratio, slope = law(p, 313.15, **oil)
    bulk = ratio / slope
    assert bulk[0] == pytest.approx(9.234e9 * math.exp(-6.09e-3 * 313.15), rel=1e-12)
    assert (bulk[2] - bulk[0]) / 2e5 == pytest.approx(10.545, rel=1e-3)
    assert ratio[0] == 1.0


def test_murnaghan_by_integration():
    """d rho/rho = dp/(K0 + K0' p) from zero pressure, by a solver of differential equations."""
    k0 = 9.234e9 * math.exp(-6.09e-3 * 353.15)
    found = solve_ivp(lambda p, r: r / (k0 + 10.545 * p), (0.0, 2e9), [1.0], rtol=1e-10, atol=1e-12)
    assert state.murnaghan(2e9, 353.15, **MURNAGHAN)[0] == pytest.approx(found.y[0, -1], rel=1e-8)


@given(pressure=st.floats(1e5, 5e9), temperature=temperatures)
def test_pressure_of_a_density(pressure, temperature):
    ratio = DENSITY_LAWS["tait"].function(pressure, temperature, **TAIT)[0]
    assert tait_pressure(ratio, temperature, **TAIT) == pytest.approx(pressure, rel=1e-8, abs=1e-3)


def test_tait_holds_half_the_volume():
    """The volume of the equation vanishes at K0 (e^11.545 - 1)/11.545; its half is far above contacts."""
    k0 = 9.234e9 * math.exp(-6.09e-3 * 313.15)
    half = k0 * math.expm1(0.5 * 11.545) / 11.545
    value, slope = state.tait(np.array([0.999, 1.001, 1e6]) * half, 313.15, **TAIT)
    assert value[0] == pytest.approx(2.0, rel=1e-3)
    assert value[1:].tolist() == [2.0, 2.0]
    assert slope[1:].tolist() == [0.0, 0.0]
    (warning,) = DENSITY_LAWS["tait"].warnings(1.001 * half, 0.01, 313.15, **TAIT)
    assert warning.code == "law-range"
    assert not list(DENSITY_LAWS["tait"].warnings(0.999 * half, 0.01, 313.15, **TAIT))


def test_tait_against_dowson_and_higginson_at_2_gpa():
    """Density ratio 1.36 and 1.26, permittivity 3.29 and 3.01: a mineral oil at 70 degC with eps_r = 2.4."""
    of_tait = state.tait(2e9, 343.15, **TAIT)[0]
    of_dowson = dowson_higginson(2e9, density_c1=0.59e9, density_c2=1.34)[0]
    assert of_tait == pytest.approx(1.36, abs=0.005)
    assert of_dowson == pytest.approx(1.2625, abs=5e-5)
    for ratio, expected in ((of_tait, 3.29), (of_dowson, 3.01)):
        eps = electrical_laws.clausius_mossotti(ratio, relative_permittivity=2.4)
        assert eps == pytest.approx(expected, abs=0.006)


# ---- Thermal conductivity and heat capacity


def test_thermal_conductivity_of_larsson():
    """PAO B: 0.154, 0.246, 0.315, 0.411 W/(m K) at 0, 0.5, 1, 2 GPa; a paraffinic oil 0.137 to 0.364."""
    p = np.array([0.0, 0.5e9, 1e9, 2e9])
    found = heat_laws.larsson_thermal_conductivity(p, **LARSSON_K)[0]
    np.testing.assert_allclose(found, [0.154, 0.246, 0.315, 0.411], atol=6e-4)
    paraffinic = {"thermal_conductivity": 0.137, "larsson_c1": 1.72e-9, "larsson_c2": 0.54e-9}
    found = heat_laws.larsson_thermal_conductivity(p, **paraffinic)[0]
    np.testing.assert_allclose(found, [0.137, 0.230, 0.290, 0.364], atol=6e-4)


def test_heat_capacity_of_larsson_by_hand():
    """1 GPa, 50 K above T0: beta = 9.3e-4 (1 + 1.4 - 0.51) = 1.7577e-3, and 1 + 0.47/1.81 = 1.25967."""
    found = heat_laws.larsson_heat_capacity(1e9, 345.0, **LARSSON_C)[0]
    assert found == pytest.approx(1.71e6 * (1.0 + 1.7577e-3 * 50.0) * (1.0 + 0.47 / 1.81), rel=1e-12)
    assert heat_laws.larsson_heat_capacity(0.0, 295.0, **LARSSON_C)[0] == 1.71e6


def test_heat_capacity_of_larsson_does_not_fall_with_temperature_at_high_pressure():
    """Without the hold, beta of the PAO would be negative above 2.1 GPa."""
    pao = LARSSON_C | {"larsson_beta": 6.5e-4, "larsson_b1": 2.7e-9, "larsson_b2": -1.5e-18}
    assert 1.0 + 2.7 * 3.0 - 1.5 * 9.0 < 0.0
    cold, hot = (heat_laws.larsson_heat_capacity(3e9, at, **pao)[0] for at in (320.0, 380.0))
    held = 6.5e-4 * (1.0 + 2.7**2 / 6.0)
    assert hot / cold == pytest.approx((1.0 + held * 85.0) / (1.0 + held * 25.0), rel=1e-12)


@pytest.mark.parametrize("pressure", [0.0, 1e9])
def test_scaled_laws_of_shell_t9_by_hand(pressure):
    """k = 0.112 and 0.25 W/(m K) at 25 degC; kappa and chi of the volume by Tait's equation."""
    volume = (1.0 + 7.734e-4 * 0.15) / float(state.tait(pressure, 298.15, **TAIT)[0])
    ratio = 298.15 / 298.0
    kappa = volume * (1.0 - 0.101 * ratio * volume**3)
    k = heat_laws.scaled_thermal_conductivity(pressure, 298.15, **SCALED_K)[0]
    assert k == pytest.approx(0.053 + 0.026 * kappa**-7.66, rel=1e-12)
    assert k == pytest.approx(0.112 if pressure == 0.0 else 0.25, abs=3e-3)
    c = heat_laws.scaled_heat_capacity(pressure, 298.15, **SCALED_C)[0]
    assert c == pytest.approx(1.17e6 + 0.39e6 * ratio / volume**4, rel=1e-12)


def test_scaled_conductivity_refuses_a_negative_kappa():
    with pytest.raises(InputError, match=r"^scaling_a: .* -0\.9, .*'scaling'"):
        heat_laws.scaled_thermal_conductivity(0.0, 400.0, **(SCALED_K | {"scaling_a": -0.9}))


def test_constant_laws():
    k = heat_laws.constant_thermal_conductivity(np.array([0.0, 1e9]), thermal_conductivity=0.134)
    np.testing.assert_array_equal(k, [[0.134, 0.134], [0.0, 0.0]])
    c = heat_laws.constant_heat_capacity(np.array([0.0, 1e9]), heat_capacity=2000.0, density=850.0)
    np.testing.assert_array_equal(c, [[1.7e6, 1.7e6], [0.0, 0.0]])


@pytest.mark.parametrize(
    ("pressure", "temperature", "count"), [(1e9, 350.0, 0), (1.2e9, 350.0, 1), (1e9, 390.0, 1)]
)
def test_laws_of_larsson_warn_outside_their_measurements(pressure, temperature, count):
    of_k = heat_laws.THERMAL_CONDUCTIVITY_LAWS["larsson"].warnings
    of_c = heat_laws.HEAT_CAPACITY_LAWS["larsson"].warnings
    found = [*of_k(pressure, 0.01, temperature, **LARSSON_K), *of_c(pressure, 0.01, temperature, **LARSSON_C)]
    assert [warning.code for warning in found] == ["law-range"] * 2 * count


# ---- Coefficients over all pressures


@given(alpha=st.floats(1e-11, 2e-7))
def test_all_coefficients_of_barus_are_alpha(alpha):
    def barus(p):
        return alpha * p, np.full_like(p, alpha)

    for coefficient in (initial_alpha, reciprocal_asymptotic_alpha):
        assert coefficient(barus) == pytest.approx(alpha, rel=1e-9)


@given(alpha=st.floats(8e-9, 4e-8), z=st.floats(0.3, 1.0))
def test_coefficient_of_roelands_by_the_incomplete_gamma_function(alpha, z):
    """With A = alpha p0/z, the integral of exp(-A ((1 + x)^z - 1)) is e^A A^(-1/z)/z Gamma(1/z, A)."""
    p0 = 0.196e9
    a = alpha * p0 / z
    integral = p0 * math.exp(a) * a ** (-1.0 / z) / z * gamma(1.0 / z) * gammaincc(1.0 / z, a)
    law = partial(roelands, pressure_viscosity_coefficient=alpha, roelands_z=z, roelands_pressure=p0)
    found = reciprocal_asymptotic_alpha(law)
    # Slow laws are not at the end of their integral at 200 times their scale.
    assert found == pytest.approx(1.0 / integral, rel=1e-6)
    assert found <= alpha * (1.0 + 1e-9)


def test_viscosities_that_do_not_rise_have_no_coefficient():
    def constant(p):
        return np.zeros_like(p), np.zeros_like(p)

    def thinning(p):
        return -1e-9 * p, np.full_like(p, -1e-9)

    for law in (constant, thinning):
        assert reciprocal_asymptotic_alpha(law) == 0.0


@pytest.mark.parametrize(("b1", "codes"), [(-0.0778401225, []), (0.3, ["law-range"])])
def test_a_viscosity_that_saturates_early_has_no_alpha_star(b1, codes):
    """1/B is 61 for FVA 3 at 40 degC, a factor of 1e26; with b1 = 0.3 it is 2.5, a factor of 13."""
    oil = Lubricant.from_dict({"base": "fva-3", "modulus_b1": b1}).at(313.15)
    assert [warning.code for warning in oil.warnings(0.5e9)] == codes


def test_coefficients_of_many_oils_are_those_of_each():
    """Points are the last axis of a law; each oil is integrated as if it were alone."""
    random = np.random.default_rng(7)
    alpha, z = random.uniform(8e-9, 4e-8, (3, 40)), random.uniform(0.3, 0.9, (3, 40))
    alpha[1, 5] = np.nan

    def oil(a, b):
        return partial(roelands, pressure_viscosity_coefficient=a, roelands_z=b, roelands_pressure=0.196e9)

    for coefficient in (initial_alpha, reciprocal_asymptotic_alpha, unfinished_share):
        found = coefficient(oil(alpha, z))
        alone = [coefficient(oil(a, b)) for a, b in zip(alpha.flat, z.flat, strict=True)]
        np.testing.assert_allclose(found, np.reshape(alone, alpha.shape), rtol=1e-12)
        assert np.flatnonzero(np.isnan(found)).tolist() == [45]


def test_of_many_oils_one_does_not_rise_with_pressure():
    alpha = np.array([2e-8, 0.0, -1e-9])
    law = partial(barus, pressure_viscosity_coefficient=alpha)
    assert reciprocal_asymptotic_alpha(law) == pytest.approx([2e-8, 0.0, 0.0], rel=1e-9)


def test_a_note_states_the_largest_pressure_of_the_measurements():
    """Larsson and Andersson (2000) measured up to 1.1 GPa."""
    (note,) = heat_laws._beyond_larsson("larsson", 1.2e9, 0.1)
    assert "1.1 GPa" in str(note)
    assert [*heat_laws._beyond_larsson("larsson", 1.0e9, 0.1)] == []
