"""Greenwood's integrals against the parabolic cylinder functions and quadrature, and the mean gap."""

import mpmath
import numpy as np
import pytest
from benchmarks.load_sharing import mean_gap
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate, special

from ehlectric.formulas.asperities import greenwood_integral, separation_of_gap
from tests.helpers.each import each

# Separations and values to the digits printed by an independent program.
LEVELS = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5]
PRINTED = {
    2.5: [0.61663, 0.24040, 0.080562, 0.022863, 0.0054237, 0.0010637, 1.7087e-4, 2.2312e-5],
    2.0: [0.5, 0.20964, 0.07534, 0.022847, 0.0057687, 0.0011993, 2.0344e-4, 2.7946e-5],
}


@pytest.mark.parametrize("order", PRINTED)
def test_printed_digits(order):
    found = [float(f"{value:.5g}") for value in greenwood_integral(order, LEVELS)]
    # The printed values of F_2 have four digits near 1.
    assert found == pytest.approx(PRINTED[order], rel=1e-4, abs=0)
    assert sum(a == b for a, b in zip(found, PRINTED[order], strict=True)) >= 7


@each("order", [0.0, 0.01, 0.3, 1.0, 1.5, 2.0, 2.5, 4.0, 7.0])
@each("level", [-12.0, -3.0, 0.0, 0.5, 3.5, 8.0, 25.0])
def test_parabolic_cylinder_function(order, level):
    factor = mpmath.gamma(order + 1) / mpmath.sqrt(2 * mpmath.pi) * mpmath.exp(-(mpmath.mpf(level) ** 2) / 4)
    exact = float(factor * mpmath.pcfd(-order - 1, level))
    assert float(greenwood_integral(order, level)) == pytest.approx(exact, rel=1e-11, abs=0)


@given(st.floats(0.0, 6.0), st.floats(-4.0, 6.0))
def test_quadrature(order, level):
    def integrand(t):
        return t**order * np.exp(-0.5 * (t + level) ** 2) / np.sqrt(2 * np.pi)

    exact, _ = integrate.quad(integrand, 0.0, 30.0, epsabs=0, epsrel=1e-11, limit=400, points=[0.5, 2.0, 8.0])
    assert float(greenwood_integral(order, level)) == pytest.approx(exact, rel=1e-9, abs=0)


@given(st.floats(0.5, 6.0), st.floats(-5.0, 8.0))
def test_recurrence(order, level):
    """Integration by parts: F_(n+2) = (n+1) F_n - l F_(n+1)."""
    zero, one, two = (greenwood_integral(order + k, level) for k in range(3))
    assert two + level * one == pytest.approx((order + 1) * zero, rel=1e-10)


def test_shape_and_large_arrays():
    levels = np.linspace(-1.0, 4.0, 3 * 5000).reshape(3, 5000)
    values = greenwood_integral(1.0, levels)
    assert values.shape == levels.shape
    exact = np.exp(-0.5 * levels**2) / np.sqrt(2 * np.pi) - levels * special.ndtr(-levels)
    np.testing.assert_allclose(values, exact, rtol=1e-9)
    assert greenwood_integral(2.5, 1.0).shape == ()
    assert greenwood_integral(2.5, []).shape == (0,)


@each("order, level", [(-0.1, 0.0), (1.0, -12.1), (1.0, np.nan), (np.nan, 0.0)])
def test_refused(order, level):
    with pytest.raises(ValueError, match="at least"):
        greenwood_integral(order, level)


def test_mean_gap_of_random_heights():
    """Flattened peaks leave no negative gap: the mean of max(d - z, 0) over Gaussian heights."""
    quantiles = special.ndtri((np.arange(1_000_000) + 0.5) / 1_000_000)
    for level in (-1.0, 0.0, 1.0, 4.0):
        sampled = float(np.mean(np.maximum(level - quantiles, 0.0)))
        assert float(mean_gap(level * 1e-7, 1e-7)) == pytest.approx(sampled * 1e-7, rel=1e-5)


@given(st.lists(st.floats(2e-3, 30.0), min_size=1, max_size=5))
def test_separation_gives_the_gap_back(gaps):
    separation = separation_of_gap(np.array(gaps) * 1e-7, 1e-7)
    np.testing.assert_allclose(mean_gap(separation, 1e-7), np.array(gaps) * 1e-7, rtol=1e-10)
    assert np.all(separation <= np.array(gaps) * 1e-7)


def test_no_gap_is_a_thousandth_of_the_roughness():
    assert float(separation_of_gap(0.0, 1.0)) == float(separation_of_gap(1e-3, 1.0))


@pytest.fixture(scope="module")
def quantiles():
    """Heights at equal steps of their probability."""
    return special.ndtri((np.arange(2_000_000) + 0.5) / 2_000_000)


@pytest.mark.slow
@pytest.mark.parametrize("highest", [-1.0, 0.5, 3.0])
@pytest.mark.parametrize("order", [0.0, 0.5, 1.0, 2.5])
@pytest.mark.parametrize("below", [0.01, 1.0, 5.0])
def test_worn_summits(quantiles, order, highest, below):
    """Heights that are cut to the highest one."""
    level = highest - below
    heights = np.minimum(quantiles, highest)
    sampled = np.mean(np.where(heights > level, np.maximum(heights - level, 1e-300) ** order, 0.0))
    assert float(greenwood_integral(order, level, highest)) == pytest.approx(sampled, rel=2e-4)


@pytest.mark.parametrize("order", [0.0, 1.5, 2.5])
def test_limits_of_wear(order):
    levels = np.array([-5.0, 0.0, 3.0, 4.0, 10.0])
    np.testing.assert_allclose(
        greenwood_integral(order, levels, 30.0), greenwood_integral(order, levels), rtol=1e-9
    )
    worn = greenwood_integral(order, levels, 4.0)
    assert np.all(worn[:3] > 0.0)
    assert worn[3:].tolist() == [0.0, 0.0]
    assert np.all(worn <= greenwood_integral(order, levels))
    with pytest.raises(ValueError, match="highest"):
        greenwood_integral(order, 0.0, np.nan)
