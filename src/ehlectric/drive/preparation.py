"""Drive before its simulation: its bearings, its circuit, and its source."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ehlectric.bearing import BearingResult, solve_bearing
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.circuit_states import CircuitStates, drive_states
from ehlectric.drive.discharges.films_and_source import Films, films_of
from ehlectric.drive.drive_bearings import BearingElement, bearing_element
from ehlectric.drive.drive_cycle import check_drive_cycle
from ehlectric.drive.measured_source import measured_source
from ehlectric.drive.motor_circuit import capacitive_divider
from ehlectric.drive.source_pieces import Ringing, ringing_of
from ehlectric.drive.waveform_file import Waveform
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

# Fundamental periods that are simulated where the case gives no duration, and periods before them in which
# the circuit settles.
_PERIODS, _SETTLING = 50.0, 1.0

# Part of a period by which a whole number of periods may be rounded.
_WHOLE = 1e-6

# Least time for which a measured source stays at its first voltage before measuring begins [s], and that time
# in times of recovery. A discharge by the step from rest to that voltage is none of the record's.
_REST, _RECOVERIES = 1e-3, 10.0


@dataclass(frozen=True, eq=False)
class PreparedDrive:
    """Drive before its simulation, with solved bearings."""

    case: DriveCase
    bearings: tuple[BearingResult, BearingResult]
    elements: tuple[BearingElement, BearingElement]
    films: Films
    ringing: Ringing | None  # what the edges of a described source excite
    waveform: Waveform | None  # voltage of a measured source
    highest_source: float  # largest absolute voltage of the source [V]
    # settling and duration: times that are simulated before and after measuring begins [s].
    settling: float
    duration: float
    prior_warnings: tuple[ResultWarning, ...]  # warnings about the file of a measured source

    @property
    def divider(self) -> tuple[float, float]:
        """Voltage across the films of each bearing per volt of the source, by the capacitances."""
        return capacitive_divider(self.case.running_circuit, self.elements)

    @property
    def circuits(self) -> CircuitStates:
        """States of the circuit, which only the simulation needs."""
        rate = None if self.ringing is None else self.ringing.rate
        return drive_states(self.case.running_circuit, self.elements, self.case.breakdown, rate)


def prepare(case: DriveCase, *, workers: int | None = None) -> PreparedDrive:
    """Solve the bearings of a drive, and read its source.

    Raises InputError where a bearing cannot be solved, or lacks a value that discharges need, and where the
    file of a duty cycle cannot be used.
    """
    check_drive_cycle(case)
    first, second = case.bearings
    drive_end = solve_bearing(first, workers=workers)
    results = drive_end, drive_end if second == first else solve_bearing(second, workers=workers)
    elements = (
        bearing_element(results[0], case.breakdown, ENDS[0]),
        bearing_element(results[1], case.breakdown, ENDS[1]),
    )
    _check_extinction(case, elements)
    films, ringing = films_of(elements, case.breakdown), ringing_of(case.running_source)
    waveform, prior_warnings = measured_source(case.source, case.drive.duration)
    return PreparedDrive(
        case, results, elements, films, ringing, waveform, *_times(case, waveform), prior_warnings
    )


def _check_extinction(case: DriveCase, elements: tuple[BearingElement, ...]) -> None:
    """Refuse arcs that go out at a voltage at which films break down."""
    lowest = case.breakdown.lowest_voltage
    for end, bearing in zip(ENDS, elements, strict=True):
        least = float(np.min(bearing.breakdown))
        if lowest >= least:
            takes = f"less than {readable(least)} V, at which the films of {end} break down"
            if case.breakdown.extinction_voltage is not None:
                raise InputError("breakdown.extinction_voltage", got=f"{readable(lowest)} V", takes=takes)
            current, through = case.breakdown.extinction_current, case.breakdown.arc_resistance
            raise InputError(
                "breakdown.extinction_current",
                got=f"{readable(current or 0.0)} A through arc_resistance of {readable(through)} ohm, which "
                f"is {readable(lowest)} V",
                takes=takes,
            )


def _times(case: DriveCase, waveform: Waveform | None) -> tuple[float, float, float]:
    """Largest voltage of the source [V], time in which the circuit settles, and duration [s]."""
    source = case.running_source
    if waveform is not None:
        settling = max(_REST, _RECOVERIES * case.breakdown.recovery_time)
        return float(np.max(np.abs(waveform.values))), settling, case.drive.duration or waveform.duration
    assert source.dc_link is not None and source.fundamental_frequency is not None
    # Whole periods of the carrier, so that a chunk of the source ends there.
    carrier = source.switching_frequency or 6.0 * source.fundamental_frequency
    settling = math.ceil(_SETTLING * carrier / source.fundamental_frequency - _WHOLE) / carrier
    peak = source.dc_link * (1.0 / 6.0 if source.modulation == "six-step" else 0.5)
    return peak, settling, case.drive.duration or _PERIODS / source.fundamental_frequency
