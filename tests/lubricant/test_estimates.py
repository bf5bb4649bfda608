"""Estimated pressure-viscosity coefficients against measured ones that others print."""

import math

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.lubricant.data_sheet import BASE_OILS, MOST, THINNEST, Gold, alpha_estimate, so_klaus
from tests.helpers.each import each

# ESDU 85027 (1985, reissued 2007), table 10.2: viscosity [mPa s] and pressure exponent [1/GPa] at 30, 60 and
# 100 degC. The table has no densities: those of the same kinds of oil are put in, as in its class at 15 degC.
ESDU_CELSIUS = (30.0, 60.0, 100.0)
ESDU = {
    "high index, ISO VG 100": (882.0, (153, 34, 9.1), (23.7, 20.5, 15.8)),
    "high index, ISO VG 150": (882.0, (250, 50.5, 12.6), (25.0, 21.3, 17.6)),
    "high index, ISO VG 460": (882.0, (810, 135, 26.8), (34, 28, 22)),
    "medium index, ISO VG 15": (890.0, (18.6, 6.3, 2.4), (20, 16, 13)),
    "medium index, ISO VG 32": (890.0, (45, 12, 3.9), (28, 20, 16)),
    "medium index, ISO VG 68": (890.0, (107, 23.3, 6.4), (29.6, 22.8, 17.8)),
    "medium index, ISO VG 75": (890.0, (122, 26.3, 7.3), (27.0, 21.6, 17.5)),
    "medium index, ISO VG 100": (890.0, (171, 31, 7.5), (28, 23, 18)),
    "low index, ISO VG 22": (920.0, (30.7, 8.6, 3.1), (25.7, 20.3, 15.4)),
    "low index, ISO VG 100": (920.0, (165, 30, 6.8), (33, 23.8, 16)),
    "low index, ISO VG 150": (920.0, (310, 44.2, 9.4), (34.6, 26.3, 19.5)),
    "low index, ISO VG 1000": (920.0, (2000, 180, 24), (41.5, 29.4, 25)),
}
# Kinematic viscosity [mm^2/s] and coefficient [1/GPa]. From the table of ESDU, with densities of 960, 910 and
# 1050 kg/m^3: castor oil at 30, 60 and 100 degC, di(2-ethylhexyl) sebacate at 30 degC; a copolymer of
# ethylene and propylene oxide at these temperatures, polypropylene glycols 750 and 1500 at 30 degC.
OTHERS = {
    "ester": ((375, 15.9), (83.3, 14.4), (18.8, 12.3), (16.2, 9.3)),
    "polyglycol": ((194, 17.6), (59.5, 14.3), (21.4, 12.2), (82.3, 17.8), (177, 17.4)),
    # PAO100 of Mann by the law of Arana et al. (2019), 1/(a1 + a2 T), at 40 and 100 degC; PAO 4, 10, 40 and
    # 100 at 40 degC as the program Thermoelastohydrodynamics_time_transient (DausdasKreuz) has them.
    "pao": ((94.1, 15.4), (14.0, 11.3), (16.7, 14.8), (62.9, 17.1), (410, 23.9), (1250, 23.1)),
}


def _mineral():
    """Ratios of measured to estimated coefficient of the mineral oils of ESDU, at three temperatures."""
    kelvin = np.array(ESDU_CELSIUS) + 273.15
    for at_15, viscosities, measured in ESDU.values():
        density = at_15 * (1.0 - 7e-4 * (kelvin - 288.15))
        nu = 1e-3 * np.array(viscosities) / density
        slope = -np.polyfit(np.log10(kelvin), np.log10(np.log10(1e6 * nu + 0.7)), 1)[0]
        for one, rho, alpha in zip(nu, density, measured, strict=True):
            found = alpha_estimate("mineral-paraffinic", one, slope=slope, density=rho)
            yield alpha / (1e9 * found.value)


def test_mineral_oils_of_esdu():
    """36 printed coefficients: none of the constants is fitted to them."""
    ratios = np.array(list(_mineral()))
    assert len(ratios) == 36
    assert np.mean(1.0 / ratios) == pytest.approx(1.09, abs=0.01)
    assert np.std(1.0 / ratios) < 0.12
    assert np.min(ratios) > 0.72
    assert np.max(ratios) < 1.07


@each("base_oil", BASE_OILS)
def test_scatter_covers_nine_of_ten_measured_coefficients(base_oil):
    if base_oil.startswith("mineral"):
        off = [abs(ratio - 1.0) for ratio in _mineral()]
    else:
        pairs = OTHERS[base_oil]
        found = [alpha_estimate(base_oil, 1e-6 * nu, slope=3.0, density=900.0).value for nu, _ in pairs]
        off = [abs(1e-9 * alpha / value - 1.0) for (_, alpha), value in zip(pairs, found, strict=True)]
    scatter = BASE_OILS[base_oil].scatter
    assert np.quantile(off, 0.9) <= scatter
    # A scatter far above that of the measured values would say nothing.
    assert np.max(off) > 0.5 * scatter


def test_so_and_klaus_by_hand():
    """nu = 100 mm^2/s, L = 2: powers of two; b = 3.5 and 1 g/cm^3, where the density has no effect."""
    slope_term = 2.848e-4 * math.exp(5.1903 * math.log(3.5)) * 2.0**1.5976
    alpha = 1.216 + 4.143 * 2.0**3.0627 + slope_term - 3.999 * 2.0**3.0975
    assert so_klaus(1e-4, 3.5, 1000.0) == pytest.approx(1e-8 * alpha, rel=1e-12, abs=0.0)
    # One mm^2/s leaves the constant.
    assert so_klaus(1e-6, 3.5, 870.0) == pytest.approx(1.216e-8, rel=1e-12, abs=0.0)


def test_heavier_naphthenic_oils_have_more():
    """A steeper oil of the same viscosity and a lighter one have a larger coefficient."""
    assert so_klaus(1e-4, 4.2, 900.0) > so_klaus(1e-4, 3.5, 900.0)
    assert so_klaus(1e-4, 3.5, 850.0) > so_klaus(1e-4, 3.5, 900.0)


def test_gold_by_hand():
    """ln(10) 0.1335 = 0.30740, and its exponential 1.3599 times 7.382 is 10.039."""
    assert 1e9 * Gold(7.382, 0.1335)(1e-5, 3.0, 830.0) == pytest.approx(10.039, abs=1e-3)


@pytest.mark.parametrize("nu", [0.99 * THINNEST, 1.01 * MOST])
def test_viscosities_without_comparison_are_refused(nu):
    with pytest.raises(InputError, match="pressure_viscosity_coefficient") as caught:
        alpha_estimate("pao", nu, slope=3.0, density=830.0)
    assert caught.value.key == "temperature.base_oil"


def test_unknown_base_oil():
    with pytest.raises(InputError, match=r"'tar'.*'mineral-paraffinic', 'mineral-naphthenic', 'pao'"):
        alpha_estimate("tar", 5e-5, slope=3.0, density=830.0)


def test_the_warning_names_value_scatter_and_key():
    (warning,) = alpha_estimate("ester", 5e-5, slope=3.0, density=900.0)(2e9)
    assert warning.code == "estimated-alpha"
    assert all(
        text in str(warning) for text in ("11.2 1/GPa", "'ester'", "30 %", "pressure_viscosity_coefficient")
    )
