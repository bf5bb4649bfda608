"""Solver of a drive: its bearings, its circuit, and what happens over time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ehlectric.bearing import life_summary
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.discharges.films_and_source import Segments
from ehlectric.drive.discharges.simulation import Measuring, simulate
from ehlectric.drive.drive_record import DriveSolution
from ehlectric.drive.inverter import steps_of
from ehlectric.drive.preparation import PreparedDrive, prepare
from ehlectric.drive.source_pieces import edges, sampled
from ehlectric.drive.warnings import bearing_warnings
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import LIMITS
from ehlectric.runtime.files import plain
from ehlectric.runtime.progress import Progress, silent

# Text of the progress while time is simulated.
SIMULATING = "simulating"

# Periods of the carrier that a trace covers, and samples of a measured source.
_TRACED, _SAMPLES = 2.0, 4000.0


def solve(case: DriveCase, progress: Progress = silent, *, workers: int | None = None) -> DriveSolution:
    """Solve the bearings of a drive, and simulate it over time; raises the errors of ``prepare``."""
    ready = prepare(case, workers=workers)
    whole = ready.settling + ready.duration
    reach = _highest(ready)
    record = simulate(
        ready.circuits,
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
        record=replace(record, trace=record.trace[:, : 2 + len(ENDS)]),
        divider=ready.divider,
        highest_source=ready.highest_source,
        converged=all(bearing.converged for bearing in ready.bearings),
        prior_warnings=(*ready.prior_warnings, *bearing_warnings(ready.bearings)),
        lives=tuple(plain(life_summary(bearing.solution)) for bearing in ready.bearings),
        bearings=ready.bearings,
    )


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
