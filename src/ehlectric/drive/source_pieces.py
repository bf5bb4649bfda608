"""Source voltage as straight pieces between its edges, chunk by chunk. SI units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.drive_inputs import Source
from ehlectric.drive.discharges.films_and_source import Segments
from ehlectric.drive.inverter import Steps
from ehlectric.drive.waveform.waveform import Waveform

# Samples of a measured waveform that are one chunk.
_SAMPLES = 100_000

# Slope below which, relative to the slope of an edge, a piece is level: what sums of slopes are rounded by.
_LEVEL = 1e-9


@dataclass(frozen=True)
class Ringing:
    """Damped oscillation at the end of each edge, A sin(omega t) exp(-t/T)."""

    overshoot: float  # amplitude A as a part of the height of the edge
    frequency: float  # omega/(2 pi) [Hz]
    time: float  # time constant T [s]

    @property
    def rate(self) -> complex:
        """Rate mu of exp(mu t) [1/s]."""
        return complex(-1.0 / self.time, 2.0 * np.pi * self.frequency)


def ringing_of(source: Source) -> Ringing | None:
    """Ringing of a described source; None without it."""
    if source.overshoot is None or source.ringing_frequency is None or source.ringing_time is None:
        return None
    return Ringing(source.overshoot, source.ringing_frequency, source.ringing_time)


def edges(
    start: float, intervals: Iterable[Steps], rise: float, ringing: Ringing | None = None
) -> Iterator[Segments]:
    """Pieces of a voltage whose steps take a rise time each; edges that overlap add up. ``start``, voltage at
    time 0 [V]; ``rise``, rise time of each step, from its begin to its end [s]; 0 for jumps.
    """
    now, level, slope = 0.0, start, 0.0
    later = np.empty((0, 4))
    steep = 0.0
    for interval in intervals:
        knots = np.vstack([later, _knots(interval, rise, ringing)])
        knots = knots[np.argsort(knots[:, 0], kind="stable")]
        here = knots[:, 0] < interval.end
        later, knots = knots[~here], knots[here]
        steep = max(steep, float(np.max(np.abs(knots[:, 1]), initial=0.0)))
        times = np.concatenate([[now], knots[:, 0], [interval.end]])
        duration = np.diff(times)
        slopes = slope + np.concatenate([[0.0], np.cumsum(knots[:, 1])])
        slopes[np.abs(slopes) < _LEVEL * steep] = 0.0
        jumps = np.concatenate([[0.0], np.cumsum(knots[:, 2])])
        risen = np.concatenate([[0.0], np.cumsum(slopes * duration)])
        levels = level + jumps + risen[:-1]
        rings = np.concatenate([[0.0], knots[:, 3]]) * (-1j)
        yield Segments(duration, levels, slopes, rings.astype(complex))
        now, slope, level = interval.end, float(slopes[-1]), level + float(jumps[-1] + risen[-1])


def _knots(interval: Steps, rise: float, ringing: Ringing | None) -> Array:
    """Return times, slope changes, jumps and ringing amplitudes of the steps in an interval, shape (m, 4)."""
    count, none = interval.time.size, np.zeros(interval.time.size)
    excited = none if ringing is None else ringing.overshoot * interval.step
    if rise == 0.0:
        return np.column_stack([interval.time, none, interval.step, excited])
    slope = interval.step / rise
    begin = np.column_stack([interval.time, slope, none, none])
    end = np.column_stack([interval.time + rise, -slope, none, excited])
    return np.vstack([begin, end]) if count else np.empty((0, 4))


def sampled(waveform: Waveform, duration: float, rest: float = 0.0) -> Iterator[Segments]:
    """Pieces of a measured voltage, straight from sample to sample; the record is repeated where it is short.

    The pieces cover the ``duration`` [s], after a ``rest`` [s] at the voltage of the first sample.
    """
    if rest:
        none = np.zeros(1)
        yield Segments(np.array([rest]), waveform.values[:1].astype(float), none, none.astype(complex))
    left = round(duration / waveform.step)
    while left > 0:
        for first in range(0, min(left, waveform.values.size - 1), _SAMPLES):
            count = min(_SAMPLES, waveform.values.size - 1 - first, left - first)
            values = waveform.values[first : first + count + 1]
            yield Segments(
                np.full(count, waveform.step),
                np.ascontiguousarray(values[:-1]),
                np.diff(values) / waveform.step,
                np.zeros(count, dtype=complex),
            )
        left -= waveform.values.size - 1
