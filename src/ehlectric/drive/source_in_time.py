"""Common-mode voltage over the simulated time, as pieces between its edges."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ehlectric.cases.drive_case import NetworkCase
from ehlectric.cases.drive_inputs import Breakdown, Source
from ehlectric.drive.discharges.films_and_source import Measuring, Segments
from ehlectric.drive.inverter import steps_of
from ehlectric.drive.measured_source import measured_waveform
from ehlectric.drive.source_pieces import Ringing, edges, ringing_of, sampled
from ehlectric.drive.waveform.waveform import Waveform
from ehlectric.errors import within
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import LIMITS

# Fundamental periods that are simulated where the case gives no duration, and periods before them in which
# the circuit settles.
_PERIODS, _SETTLING = 50.0, 1.0

# Part of a period by which a whole number of periods may be rounded.
_WHOLE = 1e-6

# Least time for which a measured source stays at its first voltage before measuring begins [s], and that time
# in times of recovery. A discharge by the step from rest to that voltage is none of the record's.
_REST, _RECOVERIES = 1e-3, 10.0

# Periods of the carrier that a trace covers, and samples of a measured source.
_TRACED, _SAMPLES = 2.0, 4000.0


@dataclass(frozen=True, eq=False)
class SourceInTime:
    """Source at the speed of its rotor: first the circuit settles, and then it is measured."""

    source: Source
    ringing: Ringing | None  # what the edges of a described source excite
    waveform: Waveform | None  # voltage of a measured source
    highest: float  # largest absolute voltage [V]
    # settling and duration: times that are simulated before and after measuring begins [s].
    settling: float
    duration: float
    prior_warnings: tuple[ResultWarning, ...] = ()  # warnings about the file of a measured source

    @classmethod
    def of(cls, case: NetworkCase, breakdown: Breakdown) -> SourceInTime:
        """Source of a drive or an axle at the speed of its rotor, for the simulated time of the case."""
        duration = case.drive.duration
        with within("source"):
            source = case.running_source
        waveform, prior_warnings = measured_waveform(case.source, duration)
        if waveform is not None:
            settling = max(_REST, _RECOVERIES * breakdown.recovery_time)
            peak, measured = float(np.max(np.abs(waveform.values))), duration or waveform.duration
            return cls(source, None, waveform, peak, settling, measured, prior_warnings)
        assert source.dc_link is not None and source.fundamental_frequency is not None
        # Whole periods of the carrier, so that a chunk of the source ends there.
        carrier = source.switching_frequency or 6.0 * source.fundamental_frequency
        settling = math.ceil(_SETTLING * carrier / source.fundamental_frequency - _WHOLE) / carrier
        peak = source.dc_link * (1.0 / 6.0 if source.modulation == "six-step" else 0.5)
        measured = duration or _PERIODS / source.fundamental_frequency
        return cls(source, ringing_of(source), None, peak, settling, measured, prior_warnings)

    @property
    def ring_rate(self) -> complex | None:
        """Rate at which the source rings [1/s]; None without ringing."""
        return None if self.ringing is None else self.ringing.rate

    @property
    def trace(self) -> float:
        """Time that a trace covers [s]."""
        if self.waveform is not None:
            return _SAMPLES * self.waveform.step
        carrier = self.source.switching_frequency or self.source.fundamental_frequency
        assert carrier is not None
        return _TRACED / carrier

    def chunks(self) -> Iterator[Segments]:
        """Pieces of the source."""
        if self.waveform is not None:
            return sampled(self.waveform, self.duration, self.settling)
        assert self.source.rise_time is not None
        start, intervals = steps_of(self.source, self.settling + self.duration, self.settling)
        return edges(start, intervals, self.source.rise_time, self.ringing)

    def measuring(self, divider: float) -> Measuring:
        """Settings of a measurement; ``divider``, largest voltage across a film per volt of the source.

        The highest voltage is about twice as large, as discharges shift it.
        """
        over = 1.0 if self.ringing is None else 1.0 + self.ringing.overshoot
        reach = 2.0 * over * divider * self.highest
        return Measuring(self.settling, self.duration, reach, LIMITS, self.trace, at_event=True)
