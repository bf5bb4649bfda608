"""Waveform: voltages at equal steps of time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array

# Parts of the height of an edge between which its slope is measured, and part at both ends at which a voltage
# may rest.
_LOW, _HIGH, _REST = 0.1, 0.9, 0.15

# Levels between the ends, largest and smallest part of the time in two of them, and fewest samples for both.
_LEVELS, _MOST, _LEAST, _FEW, _MANY = 10, 0.45, 0.02, 4, 20


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
        """Largest change of the voltage by one edge, and its rise time.

        The largest changes within 1, 2, 4, ... samples are candidates. An edge does not rest between its
        ends: of the time between 15 and 85 % of its height, at most 45 % and at least 2 % lie within any
        fifth of this range. Several edges with rests between them are therefore no edge, however large they
        are together. The rise time follows from the time between 10 and 90 % of the height. Noise adds to
        the height.

        Examples
        --------
        >>> import numpy as np
        >>> steps = np.interp(np.arange(300.0), [100.0, 110.0, 200.0, 205.0], [0.0, 90.0, 90.0, 150.0])
        >>> height, rise = Waveform(0.0, 1e-8, steps).largest_edge
        >>> height, round(rise, 10)
        (90.0, 1e-07)
        """
        samples, edge = 1, Edge(0.0, 0.0)
        while samples < self.values.size:
            changes = np.abs(self.values[samples:] - self.values[:-samples])
            start = int(np.argmax(changes))
            height, within = float(changes[start]), self.values[start : start + samples + 1]
            share = (within - within[0]) / (within[-1] - within[0]) if height else np.zeros(2)
            if height > edge.voltage and _moves_on(share):
                edge = Edge(height, self.step * _rise(share))
            samples *= 2
        return edge


def _moves_on(share: Array) -> bool:
    """Whether a change, from 0 to 1, rests at no voltage between its ends."""
    counts, _ = np.histogram(share, _LEVELS, (_REST, 1.0 - _REST))
    between, pairs = int(np.sum(counts)), counts[1:] + counts[:-1]
    if between < _FEW:
        return True
    return bool(np.max(pairs) < _MOST * between and (between < _MANY or np.min(pairs) >= _LEAST * between))


def _rise(share: Array) -> float:
    """Rise time of a change from 0 to 1 in samples, from its last crossing of 10 % before 90 %."""
    above = int(np.argmax(share >= _HIGH))
    below = int(np.flatnonzero(share[: above + 1] < _LOW)[-1]) if above else 0
    ends = [_between(share, below, _LOW), _between(share, max(above - 1, 0), _HIGH)]
    return (ends[1] - ends[0]) / (_HIGH - _LOW)


def _between(share: Array, before: int, part: float) -> float:
    """Place between a sample and the next one at which a change reaches a part of it."""
    if before + 1 >= share.size or share[before + 1] == share[before]:
        return float(before)
    return before + float((part - share[before]) / (share[before + 1] - share[before]))
