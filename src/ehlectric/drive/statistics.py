"""Rates and distributions of events, with their uncertainty."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import stats

from ehlectric.arrays import Array

# Probability that a rate lies within its bounds.
CONFIDENCE = 0.95

# Events below which a rate is called uncertain.
FEW = 20


@dataclass(frozen=True)
class Rate:
    """Rate of events and its bounds [1/s]."""

    mean: float
    low: float
    high: float


def event_rate(counts: Array, duration: float) -> Rate:
    """Rate of events with bounds of 95 % probability, from their numbers in equal blocks of time.

    Parameters
    ----------
    counts : ndarray of int, shape (blocks,)
        Numbers of events in the blocks.
    duration : float
        Length of all blocks together [s].

    Returns
    -------
    Rate
        Mean and bounds.

    Notes
    -----
    The bounds are the wider ones of two: those of a Poisson process with this number of events (F. Garwood,
    Biometrika 28 (1936) 437, doi:10.1093/biomet/28.3-4.437), which hold for no event too, and those of
    Student's distribution of the blocks, which hold for events that follow from each other.

    Examples
    --------
    No event in 2 s: the rate is less than 1.84/s, as -ln(0.025) = 3.69.

    >>> rate = event_rate(np.zeros(10), 2.0)
    >>> rate.mean, rate.low, round(rate.high, 2)
    (0.0, 0.0, 1.84)
    """
    total, blocks, outside = float(np.sum(counts)), counts.size, 0.5 * (1.0 - CONFIDENCE)
    low = float(stats.chi2.ppf(outside, 2.0 * total)) / 2.0 if total else 0.0
    high = float(stats.chi2.ppf(1.0 - outside, 2.0 * total + 2.0)) / 2.0
    error = float(np.std(counts, ddof=1)) / math.sqrt(blocks) if blocks > 1 else 0.0
    student = float(stats.t.ppf(1.0 - outside, max(blocks - 1, 1))) * error * blocks
    return Rate(
        mean=total / duration,
        low=max(min(low, total - student), 0.0) / duration,
        high=max(high, total + student) / duration,
    )


@dataclass(frozen=True)
class Spread:
    """Mean, median, 95th percentile and largest value; None without an event that tells it."""

    mean: float | None
    median: float | None
    high: float | None
    largest: float | None


def spread(values: Array, mean: float | None, largest: float | None) -> Spread:
    """Spread of the values of events.

    Parameters
    ----------
    values : ndarray, shape (m,)
        Values of events, or of a part of them, from which the percentiles follow.
    mean, largest : float or None
        Mean and largest value of all events; None without an event.

    Examples
    --------
    >>> spread(np.array([1.0, 2.0, 3.0]), 2.0, 3.0)
    Spread(mean=2.0, median=2.0, high=2.9, largest=3.0)
    """
    if values.size == 0:
        return Spread(mean, None, None, largest)
    median, high = (float(value) for value in np.percentile(values, [50.0, 95.0]))
    return Spread(mean, median, high, largest)
