"""Bounds of the rate of events, against Poisson processes of a known rate."""

import numpy as np
import pytest

from ehlectric.drive.drive_record import event_rate, spread


def test_bounds_hold_the_rate_in_95_percent_of_the_cases():
    random = np.random.default_rng(1)
    rates = [event_rate(random.poisson(2.5, 40), 10.0) for _ in range(400)]
    inside = np.mean([rate.low <= 10.0 <= rate.high for rate in rates])
    assert inside > 0.93
    assert np.mean([rate.mean for rate in rates]) == pytest.approx(10.0, rel=0.02)


def test_bounds_of_a_hundred_events():
    """Garwood's table: 100 events lie between 81.36 and 121.63."""
    rate = event_rate(np.full(40, 2.5), 1.0)
    assert (rate.low, rate.high) == (pytest.approx(81.36, abs=0.01), pytest.approx(121.63, abs=0.01))


def test_events_that_follow_from_each_other_have_wider_bounds():
    poisson = event_rate(np.full(40, 10), 1.0)
    bursts = event_rate(np.where(np.arange(40) % 8 == 0, 80, 0), 1.0)
    assert bursts.mean == poisson.mean
    assert bursts.high - bursts.low > 3.0 * (poisson.high - poisson.low)


def test_no_event_has_no_spread():
    assert spread(np.zeros(0), None, None) == dict.fromkeys(("mean", "median", "high", "largest"))


def test_events_that_are_not_kept_have_a_mean_and_a_largest_value():
    assert spread(np.zeros(0), 2.0, 3.0) == {"mean": 2.0, "median": None, "high": None, "largest": 3.0}
