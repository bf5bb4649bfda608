"""Waveform: voltages at equal steps of time."""

from __future__ import annotations

from dataclasses import dataclass

from ehlectric.arrays import Array


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
