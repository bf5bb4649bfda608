"""Shear-thinning laws: printed forms, limits and derivatives."""

import numpy as np
import pytest

from ehlectric.film.shear_laws import RHEOLOGY, Rheology
from tests.helpers.each import each

CONSTANTS = {
    "newtonian": {},
    "eyring": {"eyring_stress": 5e6},
    "carreau": {"carreau_stress": 6e6, "carreau_exponent": 0.45},
    "limiting": {"limiting_coefficient": 0.05},
}


LAWS = each("rheology", [Rheology(name, CONSTANTS[name]) for name in RHEOLOGY], ids=lambda law: law.name)


def reduced_rate(rheology, r):
    """Reduced shear rate r f(r^2)."""
    factor, _ = rheology.law.factor(r**2, rheology.constants)
    return r * factor


@LAWS
def test_small_stresses_are_newtonian(rheology):
    r = np.array([0.0, 1e-5])
    np.testing.assert_allclose(reduced_rate(rheology, r), r, rtol=1e-9)


@LAWS
def test_derivative_of_the_factor_by_the_square(rheology):
    """Central differences, on both sides of the change of formula at r = 0.1."""
    squared = np.array([1e-3, 0.009, 0.011, 0.3, 0.8, 4.0, 30.0])
    squared = squared[: 5 if rheology.name == "limiting" else None]
    step = 1e-4 * squared
    upper, _ = rheology.law.factor(squared + step, rheology.constants)
    lower, _ = rheology.law.factor(squared - step, rheology.constants)
    _, slope = rheology.law.factor(squared, rheology.constants)
    np.testing.assert_allclose(slope, (upper - lower) / (2.0 * step), rtol=1e-6, atol=1e-8)


@LAWS
def test_rate_rises_with_stress(rheology):
    r = np.linspace(0.0, 0.99 if rheology.name == "limiting" else 3.0, 2001)
    assert np.all(np.diff(reduced_rate(rheology, r)) > 0.0)


@LAWS
def test_stress_of_a_rate_is_the_inverse_or_above_it(rheology):
    """The bracket of the mid-film stress relies on the bound; Carreau's law in rate is no exact inverse."""
    rate = np.geomspace(1e-6, 1e6, 200)
    stress, slope = rheology.law.stress(rate, rheology.constants)
    upper, lower = (rheology.law.stress(rate * (1.0 + e), rheology.constants)[0] for e in (1e-5, -1e-5))
    np.testing.assert_allclose(slope, (upper - lower) / (2e-5 * rate), rtol=1e-6, atol=1e-10)
    if rheology.name == "limiting":
        rate, stress = rate[rate < 5.0], stress[rate < 5.0]
    back = reduced_rate(rheology, stress)
    assert np.all(back >= rate * (1.0 - 1e-9))
    if rheology.name != "carreau":
        np.testing.assert_allclose(back, rate, rtol=1e-8)


def test_limiting_law_has_a_limit():
    """At rates far above tau_L/mu the stress is the limiting one, and never above it."""
    stress, _ = RHEOLOGY["limiting"].stress(np.geomspace(1e2, 1e12, 30), CONSTANTS["limiting"])
    np.testing.assert_allclose(stress, 1.0, rtol=1e-9)
    assert np.all(stress <= 1.0)


def test_carreau_is_the_power_law_of_bair():
    """eta/mu = [1 + (tau/G)^2]^((1 - 1/n)/2): n = 1/2 and tau = G give eta = mu/sqrt(2)."""
    factor, _ = RHEOLOGY["carreau"].factor(np.array([1.0]), {"carreau_exponent": 0.5})
    assert factor[0] == pytest.approx(np.sqrt(2.0), rel=1e-14)


def test_stress_scales():
    """Constants in pascals; the limiting stress is Lambda p, within 0.2 % at 1 GPa."""
    pressure = np.array([1e5, 1e9])
    for name, key in (("eyring", "eyring_stress"), ("carreau", "carreau_stress")):
        scale, slope = RHEOLOGY[name].scale(pressure, CONSTANTS[name])
        assert scale.tolist() == [CONSTANTS[name][key]] * 2
        assert slope.tolist() == [0.0, 0.0]
    scale, slope = RHEOLOGY["limiting"].scale(pressure, CONSTANTS["limiting"])
    assert scale[1] == pytest.approx(0.05 * 1e9, rel=2e-3)
    assert scale[0] > 1e6
    assert slope[1] == pytest.approx(0.05, rel=2e-3)


def test_eyring_series_meets_the_closed_form():
    """At r = 0.1 the formula changes; both sides agree with sinh(r)/r."""
    r = 0.1 * (1.0 + np.array([-1e-9, 1e-9]))
    factor, _ = RHEOLOGY["eyring"].factor(r**2, {})
    np.testing.assert_allclose(factor, np.sinh(r) / r, rtol=1e-15)


@pytest.mark.parametrize(
    ("name", "constants", "words"),
    [("bingham", {}, "expected one of"), ("eyring", {}, "eyring_stress"), ("newtonian", {"n": 1.0}, "none")],
)
def test_unknown_laws_and_constants_are_refused(name, constants, words):
    with pytest.raises(ValueError, match=words):
        Rheology(name, constants)
