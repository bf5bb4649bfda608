"""Waveform: voltages at equal steps of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array

# Growth of the largest change in twice the time up to which it is the height of an edge, and the parts of the
# height between which its slope is measured.
_GROWS, _LOW, _HIGH = 1.1, 0.1, 0.9


class Edge(NamedTuple):
    """Edge of a voltage."""

    voltage: float  # height [V]
    rise_time: float  # [s]


@dataclass(frozen=True, eq=False)
class Waveform:
    """Voltage at equal steps of time.

    Examples
    --------
    >>> import numpy as np
    >>> wave = Waveform(0.0, 1e-6, np.zeros(1001))
    >>> round(wave.duration, 9)
    0.001
    """

    start: float  # time of the first sample [s]
    step: float  # sampling interval [s], above 0
    values: Array  # voltages [V], shape (n,)

    @property
    def duration(self) -> float:
        """Time from the first sample to the last one [s]."""
        return self.step * (self.values.size - 1)

    @property
    def largest_edge(self) -> Edge:
        """Largest change of the voltage within the time of an edge, and its rise time.

        The time of an edge is the shortest one, of 1, 2, 4, ... samples, within which the voltage changes by
        at most 10 % more than within half of this time. The rise time follows from the slope between 10 and
        90 % of the height.

        Examples
        --------
        >>> import numpy as np
        >>> steps = np.interp(np.arange(300.0), [100.0, 110.0, 200.0, 205.0], [0.0, 90.0, 90.0, 60.0])
        >>> height, rise = Waveform(0.0, 1e-8, steps).largest_edge
        >>> height, round(rise, 10)
        (90.0, 1e-07)
        """
        samples, before = 1, 0.0
        height, start = self._largest_change(samples)
        while height > _GROWS * before and 2 * samples < self.values.size:
            before, twice = height, self._largest_change(2 * samples)
            if twice[0] > height:
                samples, (height, start) = 2 * samples, twice
        within = self.values[start : start + samples + 1]
        share = (within - within[0]) / (within[-1] - within[0]) if height else np.zeros(2)
        low, high = (self._crossing(share, part) for part in (_LOW, _HIGH))
        return Edge(height, self.step * (high - low) / (_HIGH - _LOW))

    def _largest_change(self, samples: int) -> tuple[float, int]:
        """Largest absolute change of the voltage within a number of samples, and where it begins."""
        changes = np.abs(self.values[samples:] - self.values[:-samples])
        place = int(np.argmax(changes))
        return float(changes[place]), place

    @staticmethod
    def _crossing(share: Array, part: float) -> float:
        """Place at which a rising part of an edge first reaches a value, in samples."""
        above = int(np.argmax(share >= part))
        if above == 0:
            return 0.0
        before, after = share[above - 1], share[above]
        return float(above - 1 + (part - before) / (after - before))
