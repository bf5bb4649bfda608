"""Measurements while time goes on: histograms of voltage, time above limits, and a trace; compiled."""

from __future__ import annotations

import math
from typing import NamedTuple

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import inner


class Meters(NamedTuple):
    """Measured values; they are changed in place.

    Attributes
    ----------
    edges : ndarray, shape (2,)
        Lowest and highest voltage of the histograms [V], which are doubled where a voltage is beyond them.
    histogram : ndarray, shape (2, bins)
        Time at the voltages of each bin [s]; the number of bins is a multiple of four, and half of them are
        below zero.
    limits : ndarray, shape (l,)
        Limits of the voltage [V].
    above : ndarray, shape (2, l)
        Time at which the absolute voltage is above each limit [s].
    peak : ndarray, shape (2,)
        Largest absolute voltage [V].
    shaft : ndarray, shape (n,)
        Triangular means of the shaft voltage over the measured time [V], as in ``spectrum``.
    spaced : ndarray, shape (2,)
        Time of the first mean and spacing of the means [s].
    touching : ndarray, shape (2,)
        Largest absolute voltage while asperities touch [V].
    square : ndarray, shape (2,)
        Integral of the squared voltage over time [V^2 s].
    trace : ndarray, shape (m, 4)
        Time [s], voltage of the source without its ringing, and both voltages [V], until the table is full.
    traced : ndarray of int, shape (1,)
        Rows of the trace that are filled.
    until : ndarray, shape (2,)
        Time interval of the trace [s].
    rough : ndarray, shape (2,)
        Tolerances of the voltage: within which it is taken as straight between two times, and below which
        the ringing of the source is over [V].
    """

    edges: Array
    histogram: Array
    limits: Array
    above: Array
    peak: Array
    shaft: Array
    spaced: Array
    touching: Array
    square: Array
    trace: Array
    traced: Array
    until: Array
    rough: Array


@inner
def measure(
    meters: Meters, now: float, duration: float, source: float,
    first: tuple[float, float], last: tuple[float, float], bend: tuple[float, float],
) -> None:  # fmt: skip
    """Measure voltages that go on parabolas from first to last values in a duration [s].

    In its middle a parabola lies by ``bend`` [V] below the straight line between its ends. It is taken as
    straight if it turns back between them.
    """
    largest = max(max(abs(first[0]), abs(last[0])), max(abs(first[1]), abs(last[1])))
    while largest > meters.edges[1]:
        _widen(meters)
    for b in range(2):
        v, w = first[b], last[b]
        e = bend[b] if 4.0 * abs(bend[b]) <= abs(w - v) else 0.0
        highest = max(abs(v), abs(w))
        meters.peak[b] = max(meters.peak[b], highest)
        # Integral of (v + (w - v) s - 4 e s (1 - s))^2 over s from 0 to 1.
        square = (v * v + v * w + w * w - 2.0 * e * (v + w)) / 3.0 + 8.0 * e * e / 15.0
        meters.square[b] += duration * square
        _fill(meters, b, v, w, e, duration)
        for k in range(meters.limits.size):
            if highest > meters.limits[k]:
                meters.above[b, k] += duration * _share_above(v, w, e, meters.limits[k])
    row = meters.traced[0]
    if row < meters.trace.shape[0] and meters.until[0] <= now < meters.until[1]:
        meters.trace[row, 0], meters.trace[row, 1] = now, source
        meters.trace[row, 2], meters.trace[row, 3] = first[0], first[1]
        meters.traced[0] = row + 1


@inner
def _widen(meters: Meters) -> None:
    """Double the width of all bins: each takes the time of two neighbours, from zero outwards."""
    half = meters.histogram.shape[1] // 2
    for b in range(2):
        bins = meters.histogram[b]
        for k in range(half):
            inside = 2 * k + 1 < half
            bins[half + k] = bins[half + 2 * k] + bins[half + 2 * k + 1] if inside else 0.0
            bins[half - 1 - k] = bins[half - 1 - 2 * k] + bins[half - 2 - 2 * k] if inside else 0.0
    meters.edges[0] *= 2.0
    meters.edges[1] *= 2.0


@inner
def _share_before(v: float, w: float, e: float, level: float) -> float:
    """Share of the time on a parabola from v to another value w before it reaches a level, from 0 to 1."""
    if (level - v) * (w - v) <= 0.0:
        return 0.0
    if (level - w) * (w - v) >= 0.0:
        return 1.0
    # Smaller root s of v + (w - v) s - 4 e s (1 - s) = level, without cancellation.
    steep = w - v - 4.0 * e
    root = math.sqrt(max(steep * steep + 16.0 * e * (level - v), 0.0))
    return min(2.0 * (level - v) / (steep + math.copysign(root, w - v)), 1.0)


@inner
def _share_above(v: float, w: float, e: float, limit: float) -> float:
    """Share of the time on a parabola from v to w at which its absolute value is above a limit."""
    if v == w:
        return 1.0 if abs(v) > limit else 0.0
    upper, lower = _share_before(v, w, e, limit), _share_before(v, w, e, -limit)
    return 1.0 - abs(upper - lower)


@inner
def _fill(meters: Meters, b: int, v: float, w: float, e: float, duration: float) -> None:
    """Share a duration on a parabola from v to w among the bins between both."""
    bins = meters.histogram.shape[1]
    width = (meters.edges[1] - meters.edges[0]) / bins
    low, high = (min(v, w) - meters.edges[0]) / width, (max(v, w) - meters.edges[0]) / width
    start, end = min(max(int(low), 0), bins - 1), min(max(int(high), 0), bins - 1)
    if start == end:
        meters.histogram[b, start] += duration
    elif e == 0.0:
        each = duration / (high - low)
        meters.histogram[b, start] += each * (start + 1.0 - low)
        for k in range(start + 1, end):
            meters.histogram[b, k] += each
        meters.histogram[b, end] += each * (high - end)
    else:
        before = 0.0 if w > v else 1.0
        for k in range(start, end):
            share = _share_before(v, w, e, meters.edges[0] + (k + 1) * width)
            meters.histogram[b, k] += duration * abs(share - before)
            before = share
        meters.histogram[b, end] += duration * abs((1.0 if w > v else 0.0) - before)
