"""Rating life by ISO 281 and ISO/TS 16281, against printed numbers and integrals of the load distribution."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.bearing.loads.life import (
    MODIFICATIONS,
    ball_ratings,
    basic_life,
    fatigue_load_limit,
    life_factor,
    rated_viscosity,
    reference_life,
    roller_ratings,
    viscosity_ratio_of_film,
)
from tests.helpers.each import each


@pytest.mark.parametrize(
    ("ratio", "expected"), [(0.4, 0.3119), (0.8, 1.5076), (1.0, 2.4305), (2.0, 4.2016), (4.0, 7.2018)]
)
def test_factor_of_radial_ball_bearings(ratio, expected):
    """Computed apart from this program, at e_C C_u/P = 0.1."""
    assert life_factor("radial ball", ratio, 0.1) == pytest.approx(expected, abs=1e-4)


@each("kind", list(MODIFICATIONS))
def test_factor_has_a_kink_but_no_step_where_its_formula_changes(kind):
    """At a viscosity ratio of 0.4 the formulas differ by the rounding of their constants, at 1 by nothing."""
    for change, step in ((0.4, 2e-3), (1.0, 1e-9)):
        below, above = (life_factor(kind, change * (1.0 + side), 0.1) for side in (-1e-12, 1e-12))
        assert below == pytest.approx(above, rel=step)


@given(
    kind=st.sampled_from(sorted(MODIFICATIONS)),
    ratio=st.floats(0.1, 10.0),
    part=st.floats(1e-6, 20.0),
    more=st.floats(1.0, 3.0),
)
def test_factor_grows_with_viscosity_and_cleanness(kind, ratio, part, more):
    factor = life_factor(kind, ratio, part)
    assert 0.0999 < factor <= 50.0
    # The formulas of both sides of a ratio of 0.4 differ by the rounding of their constants.
    assert life_factor(kind, more * ratio, part) >= factor * (1.0 - 3e-3)
    assert life_factor(kind, ratio, more * part) >= factor * (1.0 - 1e-12)


def test_too_low_a_viscosity_ratio_has_no_factor():
    assert np.isnan(life_factor("radial ball", 0.099, 0.1))


@pytest.mark.parametrize(("speed", "viscosity"), [(100.0, 127.1), (1000.0, 18.4), (10_000.0, 5.81)])
def test_rated_viscosity(speed, viscosity):
    """By hand for a pitch diameter of 60 mm: 45000 n^-0.83/sqrt(60) and 4500 n^-0.5/sqrt(60) mm^2/s."""
    assert 1e6 * rated_viscosity(speed, 60e-3) == pytest.approx(viscosity, rel=2e-3)


def test_viscosity_ratio_of_a_film():
    assert viscosity_ratio_of_film(2.0) == pytest.approx(2.4623, abs=1e-4)


def test_fatigue_limit_of_a_large_bearing():
    """By hand: 100 kN/22 (0.1/0.4)^0.5 and 100 kN/8.2 (0.1/0.4)^0.3."""
    assert fatigue_load_limit(100e3, 0.4, rollers=False) == pytest.approx(2272.7, rel=1e-4)
    assert fatigue_load_limit(100e3, 0.4, rollers=True) == pytest.approx(8045.8, rel=1e-4)


def half_loaded(number, power):
    """Loads of many elements under 1 N of radial load, of which half carry: Q = Q_max cos(angle)^power."""
    angle = 2.0 * np.pi * (np.arange(number) + 0.5) / number
    share = np.maximum(np.cos(angle), 0.0) ** power
    return share / np.sum(share * np.cos(angle))


@each("ratio", [0.05, 0.2, 0.35])
@each("grooves", [(0.52, 0.52), (0.52, 0.53), (0.515, 0.53)])
def test_reference_life_of_a_ball_bearing_is_its_basic_life(ratio, grooves):
    """The ratings of the elements are made so that half of the elements loaded give (C/F)^3, to 2 %.

    The constants 0.407 and 0.389 are ratios of integrals over this distribution, with three digits.
    """
    number = 720
    loads = half_loaded(number, 1.5)
    rating, force = 30e3, 3e3
    found = reference_life((force * loads, force * loads), ball_ratings(rating, number, ratio, grooves))
    assert found == pytest.approx(basic_life(rating, force), rel=0.02)


@each("ratio", [0.05, 0.2, 0.35])
def test_reference_life_of_a_roller_bearing(ratio):
    """As for balls, with the power 4 of line contacts: ISO 281 has 10/3 in its place.

    The rating of the bearing is smaller by the stress at the ends of rollers, λν = 0.83.
    """
    number = 720
    loads = half_loaded(number, 10.0 / 9.0)
    rating, force = 50e3, 5e3
    found = reference_life(
        (force * loads, force * loads), roller_ratings(rating, number, ratio), rollers=True
    )
    assert found == pytest.approx(basic_life(rating / 0.83, force, 4.0), rel=0.02)


def test_slices_of_an_even_load_have_the_life_of_the_roller():
    """ISO/TS 16281 by hand: slices rated at Q_c n^(-7/9), means of power 4 and 4.5, power -8/9 of the sum."""
    loads, slices, ratings = 1e3 * np.arange(1.0, 15.0), 30, roller_ratings(50e3, 14, 0.2)
    spent = 0.0
    for rating, power in ((ratings.inner, 4.0), (ratings.outer, 4.5)):
        each = np.mean((loads / slices) ** power) ** (1.0 / power)
        spent += slices * (each / (rating * slices ** (-7.0 / 9.0))) ** 4.5
    found = reference_life((loads, loads), ratings, rollers=True)
    assert found == pytest.approx(1e6 * spent ** (-8.0 / 9.0), rel=1e-12)


def test_life_without_load():
    assert reference_life((np.zeros(9), np.zeros(9)), ball_ratings(30e3, 9, 0.2, (0.52, 0.53))) == np.inf
