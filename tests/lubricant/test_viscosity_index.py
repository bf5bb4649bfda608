"""Viscosity index against the examples and the table of ASTM D2270, and its inverse."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.lubricant.data_sheet import GRADES, _reference, grade_middle, viscosity_at_100, viscosity_index
from tests.helpers.each import each


@pytest.mark.parametrize(
    ("at_40", "at_100", "index"),
    # Examples of ASTM D2270: one of procedure A and two of procedure B.
    [(73.30, 8.86, 92), (22.83, 5.05, 156), (53.47, 7.80, 111)],
)
def test_examples_of_the_standard(at_40, at_100, index):
    assert round(viscosity_index(1e-6 * at_40, 1e-6 * at_100)) == index


# Rows of table 1 of ASTM D2270, which its appendix approximates: Y, L and H in mm^2/s.
TABLE = [
    (2.0, 7.994, 6.394),
    (3.0, 15.49, 12.15),
    (4.0, 25.32, 19.56),
    (4.7, 35.13, 25.63),
    (5.5, 49.09, 33.34),
    (6.7, 71.29, 45.33),
    (7.3, 84.53, 51.78),
    (8.0, 100.0, 59.6),
    (10.0, 147.7, 82.87),
    (13.5, 247.4, 128.4),
    (16.0, 331.9, 164.6),
    (20.0, 493.2, 229.5),
    (25.0, 736.5, 320.9),
    (35.0, 1356.0, 532.5),
    (50.0, 2618.0, 919.6),
    (60.0, 3676.0, 1222.0),
    (70.0, 4905.0, 1558.0),
]


@each("y, low, high", TABLE)
def test_reference_oils(y, low, high):
    assert _reference(y) == pytest.approx((low, high), rel=1.2e-3)
    # The reference oils have the indices 0 and 100 by definition.
    assert viscosity_index(1e-6 * low, 1e-6 * y) == pytest.approx(0.0, abs=0.5)
    assert viscosity_index(1e-6 * high, 1e-6 * y) == pytest.approx(100.0, abs=0.5)
    assert viscosity_at_100(1e-6 * high, 100.0) == pytest.approx(1e-6 * y, rel=1.5e-3)


@given(st.floats(8e-6, 3e-3), st.floats(0.0, 350.0))
def test_inverse(at_40, index):
    try:
        at_100 = viscosity_at_100(at_40, index)
    except ValueError:
        assert viscosity_index(at_40, 2e-6) > index
        return
    assert 2e-6 <= at_100 < at_40
    # The equations of the appendix jump by less than one unit of the index where their rows meet.
    assert viscosity_index(at_40, at_100) == pytest.approx(index, abs=1.0)


def test_more_index_is_less_change():
    assert viscosity_at_100(46e-6, 50.0) < viscosity_at_100(46e-6, 95.0) < viscosity_at_100(46e-6, 150.0)


def test_too_thin():
    with pytest.raises(ValueError, match="2 mm"):
        viscosity_index(4e-6, 1.9e-6)
    with pytest.raises(ValueError, match="2 mm"):
        viscosity_at_100(3.2e-6, 100.0)


def test_grades():
    """Each grade is half as viscous again as the one before it, within the rounding of the standard."""
    middles = [grade_middle(grade) for grade in GRADES]
    assert middles[:5] == [2.2e-6, 3.2e-6, 4.6e-6, 6.8e-6, 10e-6]
    assert all(1.42 < b / a < 1.55 for a, b in itertools.pairwise(middles))
