"""The dry contact against hand calculation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.formulas import hertz

positive = st.floats(1e-3, 1e3)


@given(r1=positive, r2=positive)
def test_reduced_radius_is_half_of_the_harmonic_mean(r1, r2):
    assert hertz.reduced_radius(r1, r2) == pytest.approx(r1 * r2 / (r1 + r2))


def test_concave_body_widens_the_contact():
    assert hertz.reduced_radius(0.01, -0.02) == pytest.approx(0.02)


def test_steel_on_steel():
    # E = 206 GPa, nu = 0.3: E' = E/(1 - nu^2) for equal bodies with the factor two.
    steel = hertz.body_compliance(206e9, 0.3)
    assert hertz.reduced_modulus(steel, steel) == pytest.approx(206e9 / 0.91)


# b = sqrt(8*1.57e6*14.1e-3/(pi*226e9)) = 499.4 um, p_h = 2 w/(pi b) = 2.001 GPa, by hand.
def test_paper_contact():
    assert hertz.line_half_width(load_per_length=1.57e6, radius=14.1e-3, modulus=226e9) == pytest.approx(
        499.4e-6, rel=1e-4, abs=0.0
    )
    assert hertz.line_max_pressure(load_per_length=1.57e6, radius=14.1e-3, modulus=226e9) == pytest.approx(
        2.001e9, rel=5e-4, abs=0.0
    )


@given(pressure=st.floats(1e6, 1e10), radius=positive, modulus=st.floats(1e6, 1e12))
def test_load_and_pressure_are_inverse(pressure, radius, modulus):
    load = hertz.line_load(pressure, radius, modulus)
    assert hertz.line_max_pressure(load_per_length=load, radius=radius, modulus=modulus) == pytest.approx(
        pressure, rel=1e-12, abs=0.0
    )


def test_pressure_carries_the_load():
    x = np.linspace(-1, 1, 20_001)
    assert np.trapezoid(hertz.line_pressure(x), x) == pytest.approx(np.pi / 2, rel=1e-5, abs=0.0)


def test_gap_is_zero_inside_and_a_parabola_far_away():
    np.testing.assert_array_equal(hertz.line_gap([-1.0, 0.0, 0.5]), 0.0)
    x = 1e4
    parabola = x**2 / 2 - 0.5 * np.log(2 * x) - 0.25
    assert hertz.line_gap(x) == pytest.approx(parabola, rel=1e-12, abs=0.0)
