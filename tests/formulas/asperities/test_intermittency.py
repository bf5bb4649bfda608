"""Duty of contact against drawn numbers of spots and drawn states of elements."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.formulas.asperities import bearing_time_share, contact_time_share, expected_spots

SHARES = st.lists(st.floats(0.0, 1.0), min_size=1, max_size=9)


def test_duty_of_drawn_spots():
    """Spots at random places of a strip that passes a window."""
    rng = np.random.default_rng(5)
    places = rng.uniform(0.0, 10_000.0, 7000)
    windows = rng.uniform(0.0, 9999.0, 100_000)
    touched = np.diff(np.searchsorted(np.sort(places), np.column_stack([windows, windows + 1.0])), axis=1)
    expected = float(expected_spots(0.7, 1.0))
    assert float(contact_time_share(expected)) == pytest.approx(np.mean(touched > 0), abs=0.01)


def test_duty_of_few_spots_keeps_its_digits():
    assert float(contact_time_share(1e-18)) == pytest.approx(1e-18, rel=1e-12)
    assert contact_time_share([0.0, np.inf]).tolist() == [0.0, 1.0]


@pytest.mark.parametrize("number", [-1.0, np.nan])
def test_no_negative_number_of_spots(number):
    with pytest.raises(ValueError, match="spots"):
        contact_time_share(number)


def test_bearing_of_drawn_states():
    rng = np.random.default_rng(2)
    inner, outer = np.array([0.9, 0.5, 0.1]), np.array([0.3, 0.4, 0.8])
    closed = [rng.uniform(size=(200_000, 3)) < p for p in (inner, outer)]
    conducting = np.any(closed[0] & closed[1], axis=1)
    assert float(bearing_time_share(inner, outer)) == pytest.approx(np.mean(conducting), abs=0.005)


@given(SHARES, st.floats(0.0, 1.0))
def test_bounds_of_a_bearing(shares, outer):
    inner = np.array(shares)
    share = float(bearing_time_share(inner, outer))
    each = inner * outer
    assert each.max() - 1e-12 <= share <= min(1.0, each.sum()) + 1e-12
    assert share == pytest.approx(float(bearing_time_share(outer, inner)), abs=1e-15)
    assert share <= float(bearing_time_share(np.append(inner, 0.5), outer)) + 1e-12


def test_elements_along_an_axis():
    shares = np.array([[0.1, 0.2], [0.0, 1.0], [1e-20, 0.0]])
    np.testing.assert_allclose(bearing_time_share(shares, 1.0), [0.28, 1.0, 1e-20], rtol=1e-12)
    np.testing.assert_allclose(
        bearing_time_share(shares, 1.0, axis=0), [1.0 - 0.9 * (1 - 1e-20), 1.0], rtol=1e-12
    )


@pytest.mark.parametrize("share", [-0.1, 1.1, np.nan])
def test_no_share_outside_of_its_bounds(share):
    with pytest.raises(ValueError, match="share of time"):
        bearing_time_share([0.5, share], 0.5)
