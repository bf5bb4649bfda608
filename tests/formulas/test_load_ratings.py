"""Load ratings by ISO 76 and ISO 281: against the tables of the standards and against printed ratings."""

import pytest

from ehlectric.formulas.load_ratings import (
    ball_dynamic_rating,
    ball_static_rating,
    dynamic_factor,
    roller_dynamic_factor,
    roller_static_rating,
    static_factor,
    thrust_ball_dynamic_rating,
    thrust_ball_static_rating,
    thrust_roller_dynamic_rating,
    thrust_roller_static_rating,
)

# f_0 of ISO 76 and f_c of ISO 281 at 0.01, 0.02 ... 0.4, as read in a public program (code index, file id
# 9277541628). Its f_0 at 0.06 is 15.7 between 15.7 and 16.1, a slip; it is left out.
F0 = """
14.9 15.1 15.3 15.5 15.7 - 16.1 16.3 16.5 16.4 16.1 15.9 15.6 15.4 15.2 14.9 14.7 14.4 14.2 14 13.7 13.5 13.2
13 12.8 12.5 12.3 12.1 11.8 11.6 11.4 11.2 10.9 10.7 10.5 10.3 10 9.8 9.6 9.4
"""
FC = """
29.1 35.8 40.3 43.8 46.7 49.1 51.1 52.8 54.3 55.5 56.6 57.5 58.2 58.8 59.3 59.6 59.8 59.9 60 59.9 59.8 59.6
59.3 59 58.6 58.2 57.7 57.1 56.6 56 55.3 54.6 53.9 53.2 52.4 51.7 50.9 50 49.2 48.4
"""


def test_static_factor_from_hertz_is_the_table_of_iso_76():
    """4200 MPa by Hertz in grooves of 0.52 and 0.53; below 0.09 the outer ring decides, above the inner."""
    assert static_factor(0.0) == pytest.approx(14.7, rel=0.0, abs=0.06)
    for step, value in enumerate(F0.split(), start=1):
        if value != "-":
            assert static_factor(step / 100) == pytest.approx(float(value), rel=0.0, abs=0.06), step


def test_dynamic_factor_is_the_table_of_iso_281():
    """Half of the last digit is 0.17 % of the smallest of them."""
    for step, value in enumerate(FC.split(), start=1):
        assert dynamic_factor(step / 100) == pytest.approx(float(value), rel=2e-3, abs=0.0), step


def test_thrust_ratings_are_the_tables_of_iso_76_and_iso_281():
    """f_0 is 61.6, and f_c of balls and of rollers at a ratio of diameters of 0.1 is 73.3 and 175.7."""
    assert thrust_ball_static_rating(1, 1e-3) == pytest.approx(61.6, abs=0.06)
    assert thrust_ball_dynamic_rating(1, 1e-3, 1e-2) / 1.3 == pytest.approx(73.3, abs=0.06)
    assert thrust_roller_dynamic_rating(1, 1e-3, 1e-2, 1e-3) == pytest.approx(175.7, abs=0.1)
    assert thrust_roller_static_rating(1, 1e-3, 1e-3) == pytest.approx(220.0)


def test_small_ratios_lower_the_capacity_of_rollers_by_their_power():
    """f_c goes with g^(2/9), as the other factors tend to one: 2^(2/9) between two small ratios."""
    ratio = roller_dynamic_factor(2e-6) / roller_dynamic_factor(1e-6)
    assert ratio == pytest.approx(2.0 ** (2.0 / 9.0), rel=1e-5, abs=0.0)


def test_static_rating_of_rollers_by_hand():
    """44 (1 - 0.2) 10 x 8 x 10 = 28 160 N."""
    assert roller_static_rating(10, 0.010, 0.050, 0.008) == pytest.approx(28160.0, rel=1e-12, abs=0.0)


def test_rating_of_balls_passes_an_inch_without_a_jump():
    """ISO 281 changes the power at 25.4 mm: 3.647 D^1.4 in place of D^1.8, with 25.4^0.4 = 3.647."""
    below, above = (ball_dynamic_rating(8, 25.4e-3 * (1.0 + d), 0.1 * (1.0 + d)) for d in (-1e-9, 1e-9))
    assert above == pytest.approx(below, rel=2e-4, abs=0.0)


def test_an_angle_lowers_the_radial_rating():
    """At one ratio D cos a/d_m, C_0r has cos(a): the smaller pitch diameter keeps the ratio."""
    cosine = 0.5
    flat = ball_static_rating(10, 0.010, 0.050)
    steep = ball_static_rating(10, 0.010, 0.050 * cosine, 1.0471975511965976)
    assert steep / flat == pytest.approx(cosine, rel=1e-9, abs=0.0)
