"""Solver of a drive: its bearings, its circuit, and what happens over time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ehlectric.bearing import BearingResult, life_summary, solve_bearing
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.discharges.event_loop import Films, Segments
from ehlectric.drive.discharges.simulation import Measuring, films_of, simulate
from ehlectric.drive.drive_bearings import BearingElement, bearing_element
from ehlectric.drive.drive_cycle import check_drive_cycle
from ehlectric.drive.drive_record import DriveSolution
from ehlectric.drive.inverter import steps_of
from ehlectric.drive.measured_source import measured_source
from ehlectric.drive.motor_circuit import Modes, capacitive_divider, modes_of, states_of, voltage_nodes
from ehlectric.drive.source_pieces import Ringing, edges, ringing_of, sampled
from ehlectric.drive.warnings import bearing_warnings
from ehlectric.drive.waveform_file import Waveform
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import LIMITS
from ehlectric.readable import readable
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress, silent

# Fundamental periods that are simulated where the case gives no duration, and periods before them in which
# the circuit settles.
_PERIODS, _SETTLING = 50.0, 1.0

# Text of the progress while time is simulated.
SIMULATING = "simulating"

# Part of a period by which a whole number of periods may be rounded.
_WHOLE = 1e-6

# Least time for which a measured source stays at its first voltage before measuring begins [s], and that time
# in times of recovery. A discharge by the step from rest to that voltage is none of the record's.
_REST, _RECOVERIES = 1e-3, 10.0

# Periods of the carrier that a trace covers, and samples of a measured source.
_TRACED, _SAMPLES = 2.0, 4000.0


@dataclass(frozen=True, eq=False)
class PreparedDrive:
    """Drive before its simulation: solved bearings, and the circuit in each of its states."""

    case: DriveCase
    bearings: tuple[BearingResult, BearingResult]
    elements: tuple[BearingElement, BearingElement]
    films: Films
    modes: Modes
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


def prepare(case: DriveCase, *, workers: int | None = None) -> PreparedDrive:
    """Solve the bearings of a drive, and set up its circuit.

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
    systems = states_of(case.running_circuit, elements, case.breakdown, touches=bool(films.states[0] == 3))
    modes = modes_of(systems, voltage_nodes(elements), None if ringing is None else ringing.rate)
    waveform, prior_warnings = measured_source(case.source, case.drive.duration)
    return PreparedDrive(
        case, results, elements, films, modes, ringing, waveform, *_times(case, waveform), prior_warnings
    )


def solve(case: DriveCase, progress: Progress = silent, *, workers: int | None = None) -> DriveSolution:
    """Solve the bearings of a drive, and simulate it over time; raises the errors of ``prepare``."""
    ready = prepare(case, workers=workers)
    whole = ready.settling + ready.duration
    reach = _highest(ready)
    record = simulate(
        ready.modes,
        ready.films,
        _chunks(ready),
        Measuring(ready.settling, ready.duration, reach, LIMITS, _trace(ready), at_event=True),
        case.drive.seed,
        lambda time: progress(round(100.0 * min(time / whole, 1.0)), 100, SIMULATING),
        lambda text: progress(0, 100, text),
    )
    return DriveSolution(
        case=case,
        elements=ready.elements,
        record=record,
        divider=ready.divider,
        highest_source=ready.highest_source,
        converged=all(bearing.converged for bearing in ready.bearings),
        prior_warnings=(*ready.prior_warnings, *bearing_warnings(ready.bearings)),
        lives=tuple(plain(life_summary(bearing.solution)) for bearing in ready.bearings),
        bearings=ready.bearings,
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


def _trace(ready: PreparedDrive) -> float:
    """Time that the trace covers [s]."""
    if ready.waveform is not None:
        return _SAMPLES * ready.waveform.step
    source = ready.case.running_source
    carrier = source.switching_frequency or source.fundamental_frequency
    assert carrier is not None
    return _TRACED / carrier


def _highest(ready: PreparedDrive) -> float:
    """About the highest voltage across a film [V]: twice the divider's, as discharges shift it by itself."""
    over = 1.0 if ready.ringing is None else 1.0 + ready.ringing.overshoot
    return 2.0 * over * max(ready.divider) * ready.highest_source


def _chunks(ready: PreparedDrive) -> Iterator[Segments]:
    """Pieces of the source."""
    source = ready.case.running_source
    if ready.waveform is not None:
        return sampled(ready.waveform, ready.duration, ready.settling)
    assert source.rise_time is not None
    start, intervals = steps_of(source, ready.settling + ready.duration, ready.settling)
    return edges(start, intervals, source.rise_time, ready.ringing)
