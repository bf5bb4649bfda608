"""Polynomials of several variables against their functions."""

import numpy as np
import pytest

from ehlectric.formulas.smooth_tables import leja_points, smooth_table


def coupled(at):
    return 1.0 / (1.2 + at[0] * at[1] + 0.3 * at[2] ** 2)


BOX = np.array([0.0, -0.5, 0.1]), np.array([0.4, 0.8, 1.1])


@pytest.mark.parametrize("tolerance", [1e-5, 1e-10])
def test_error_is_below_the_tolerance(tolerance):
    """At points that are not among the two dozen with which a table checks itself, with a margin."""
    table = smooth_table(coupled, *BOX, tolerance)
    points = np.random.default_rng(8).uniform(*BOX, (2000, 3)).T
    assert table.error <= tolerance
    assert np.max(np.abs(table(*points) - coupled(points))) < 5.0 * tolerance


@pytest.mark.parametrize("expected", [(1, 1, 1), (3, 4, 5), (20, 20, 20)])
def test_expected_numbers_of_polynomials(expected):
    """Too few polynomials are followed by more, and many have the same values."""
    table = smooth_table(coupled, *BOX, 1e-7, expected)
    points = np.random.default_rng(8).uniform(*BOX, (2000, 3)).T
    assert np.max(np.abs(table(*points) - coupled(points))) < 5e-7


def test_points_of_a_group_share_the_first_variable():
    table = smooth_table(coupled, *BOX, 1e-8)
    draw = np.random.default_rng(9)
    first, group = draw.uniform(0.0, 0.4, 7), draw.integers(0, 7, 1500)
    others = draw.uniform(BOX[0][1:], BOX[1][1:], (1500, 2)).T
    together = table(first, *others, group=group)
    assert together == pytest.approx(table(first[group], *others), rel=1e-13)


def test_a_variable_may_have_one_value():
    low, high = BOX
    high = np.array([low[0], *high[1:]])
    table = smooth_table(coupled, low, high, 1e-9)
    points = np.random.default_rng(10).uniform(low, high, (300, 3)).T
    assert table.numbers[:, 0].max() == 0
    assert table(np.zeros(1), *points[1:]) == pytest.approx(coupled(points), abs=5e-9)


def test_a_polynomial_is_exact():
    table = smooth_table(lambda at: at[0] ** 2 * at[1] + at[1] ** 3, np.zeros(2), np.full(2, 2.0), 1e-9)
    points = np.random.default_rng(11).uniform(0.0, 2.0, (50, 2)).T
    assert table(*points) == pytest.approx(points[0] ** 2 * points[1] + points[1] ** 3, abs=1e-12)


def test_no_table_of_a_function_with_a_kink():
    kink = smooth_table(lambda at: np.abs(at[0] - 0.3) + np.abs(at[1] - 0.6), np.zeros(2), np.ones(2), 1e-9)
    assert kink is None


def test_no_table_of_a_kink_along_the_only_variable_that_varies():
    kink = smooth_table(lambda at: np.abs(at[1] - 0.6), np.zeros(2), np.array([0.0, 1.0]), 1e-9)
    assert kink is None


def test_leja_points_are_apart():
    points = np.sort(leja_points())
    assert points[0] == -1.0
    assert points[-1] == 1.0
    assert np.min(np.diff(points)) > 1e-3


@pytest.mark.parametrize("least", [-1.0, 0.97])
def test_a_function_without_a_value_has_no_table(least):
    """Films that are thicker than a ball have no gap around them."""
    low, high = np.zeros(2), np.ones(2)
    assert smooth_table(lambda at: np.where(at[0] > least, np.nan, at[0] + at[1]), low, high, 1e-9) is None
