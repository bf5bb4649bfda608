"""Largest field strength of a transient run over time, and the time for which it is near its maximum."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ehlectric.arrays import Array, Mask

# The field counts as near its maximum if it is above this fraction of its largest value over time.
NEAR_MAXIMUM = 0.9


@dataclass(frozen=True)
class FieldHistory:
    """Largest field strength at every time step.

    Attributes
    ----------
    time : ndarray, shape (steps,)
        Times of the steps [s].
    strength : ndarray, shape (steps,)
        Largest field strength at the steps [V/m].
    settled_from : float
        Time at which the statistics begin [s].
    """

    time: Array
    strength: Array
    settled_from: float

    @cached_property
    def _settled(self) -> Mask:
        """Mask of the steps that count for statistics, shape (steps,)."""
        return np.asarray(self.time >= self.settled_from)

    @property
    def settled_time(self) -> float:
        """Duration of the steps that count for statistics [s]."""
        return float(np.ptp(self.time[self._settled]))

    @property
    def near_maximum(self) -> float:
        """Field strength above which the field counts as near its maximum [V/m]."""
        return NEAR_MAXIMUM * float(np.max(self.strength[self._settled]))

    @property
    def share_near_maximum(self) -> float:
        """Share of the settled time in which the field is near its maximum, dimensionless.

        It is computed from all time steps, because an asperity may pass between two recorded instants.
        """
        return time_above(self.time[self._settled], self.strength[self._settled], self.near_maximum)


def strength_between(time: Array, estimate: Array, frame_time: Array, strength: Array) -> Array:
    """Largest field strength at every time step, interpolated between the recorded instants.

    The largest field strength is the voltage divided by the minimum film thickness, times a ratio that
    changes little with time. The ratio is interpolated between the recorded instants.

    Parameters
    ----------
    time : ndarray, shape (steps,)
        Times of the steps [s].
    estimate : ndarray, shape (steps,)
        Voltage divided by the minimum film thickness [V/m].
    frame_time : ndarray, shape (frames,)
        Times of the recorded instants [s].
    strength : ndarray, shape (frames,)
        Largest field strength at the recorded instants [V/m].

    Returns
    -------
    ndarray, shape (steps,)
        Largest field strength [V/m].

    Examples
    --------
    >>> time, estimate = np.array([0.0, 1.0, 2.0]), np.array([1.0, 2.0, 1.0])
    >>> strength_between(time, estimate, time[::2], np.array([1.1, 1.3]))
    array([1.1, 2.4, 1.3])
    """
    ratio = strength / np.interp(frame_time, time, estimate)
    return np.asarray(estimate * np.interp(time, frame_time, ratio))


def intervals_above(time: Array, values: Array, level: float) -> Array:
    """Intervals of time in which values are above a level.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Times, ascending.
    values : ndarray, shape (n,)
        Values at these times, linear in between.
    level : float
        Level, in the unit of the values.

    Returns
    -------
    ndarray, shape (m, 2)
        Start and end of each interval.

    Examples
    --------
    >>> intervals_above(np.arange(5.0), np.array([2.0, 0.0, 2.0, 0.0, 0.0]), 1.0)
    array([[0. , 0.5],
           [1.5, 2.5]])
    """
    above = values > level
    before = np.flatnonzero(above[1:] != above[:-1])
    share = (level - values[before]) / (values[before + 1] - values[before])
    crossings = time[before] + share * (time[before + 1] - time[before])
    ends = [time[:1]] if above[0] else []
    ends.append(crossings)
    ends += [time[-1:]] if above[-1] else []
    intervals: Array = np.concatenate(ends).reshape(-1, 2)
    return intervals


def time_above(time: Array, values: Array, level: float) -> float:
    """Share of the time in which values are above a level.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Times, ascending.
    values : ndarray, shape (n,)
        Values at these times, linear in between.
    level : float
        Level, in the unit of the values.

    Returns
    -------
    float
        Share between 0 and 1; for a single instant 0 or 1.

    Examples
    --------
    >>> round(time_above(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 0.0]), 0.75), 9)
    0.25
    """
    if time.size < 2:
        return float(values[0] > level)
    return float(np.sum(np.diff(intervals_above(time, values, level))) / np.ptp(time))
