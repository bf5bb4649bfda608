"""Panels of the voltages of a drive over a short time: common-mode voltage, and both bearings below it."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.discharges.record import ON, VOLTAGE
from ehlectric.drive.result import DriveResult
from ehlectric.figures.data import Along, Curve, Panel
from ehlectric.figures.drive.looks import COLOURS, NAMES, breakdown_of, events_of, voltage_unit
from ehlectric.quantities.palette import BLACK, MIDDLE_GREY
from ehlectric.quantities.units import unit_for

# Breakdown voltage over the largest voltage of a panel up to which it is drawn, and room around the curves.
_NEAR, _ROOM = 1.8, 1.12


def time_axis(result: DriveResult) -> Along:
    """Axis of the time of the trace, from its begin."""
    begin, span = _begin(result), _span(result)
    factor, unit = unit_for(span, "s", least=1.0)
    scale, unit_of_begin = unit_for(begin, "s", least=1.0)
    since = "" if begin < 1e-3 * span else f" after {scale * begin:.4g} {unit_of_begin}"
    return Along(f"time{since}", unit, (0.0, factor * span))


def source_panel(result: DriveResult) -> Panel:
    """Common-mode voltage of the source, without its ringing."""
    volts = result.solution.record.trace[:, 1]
    largest = float(np.max(np.abs(volts), initial=0.0))
    factor, unit = voltage_unit(largest)
    curve = Curve("common mode", _times(result), factor * volts, MIDDLE_GREY, width=0.9)
    return _around_zero("common mode", unit, [curve], factor * largest)


def bearing_panel(result: DriveResult, b: int) -> Panel:
    """Voltage across the films of a bearing with its discharges, and its breakdown voltage where near."""
    volts, (times, peaks) = result.solution.record.trace[:, 2 + b], shown_discharges(result, b)
    largest = max(float(np.max(np.abs(part), initial=0.0)) for part in (volts, peaks))
    factor, unit = voltage_unit(largest)
    curves = [Curve(NAMES[b], _times(result), factor * volts, COLOURS[b], width=0.9)]
    breakdown = breakdown_of(result, b)
    if breakdown <= _NEAR * largest:
        scattered = " (63 %)" if math.isfinite(result.solution.elements[b].shape) else ""
        ends = np.array(time_axis(result).window)
        for sign, name in ((1.0, f"breakdown, weakest position{scattered}"), (-1.0, "")):
            level = np.full(2, sign * factor * breakdown)
            curves.append(Curve(name, ends, level, BLACK, "dash", 0.9))
        largest = max(largest, breakdown)
    if times.size:
        curves.append(Curve("discharge", times, factor * peaks, BLACK, marker="ring"))
    return _around_zero(NAMES[b], unit, curves, factor * largest)


def shown_discharges(result: DriveResult, b: int) -> tuple[Array, Array]:
    """Times of the discharges of a bearing in the trace, in the unit of the axis; voltages [V]."""
    own, begin = events_of(result, b), _begin(result)
    here = own[(own[:, ON] >= begin) & (own[:, ON] <= begin + _span(result))]
    return _times(result, here[:, ON]), here[:, VOLTAGE]


def _begin(result: DriveResult) -> float:
    """Begin of the trace [s]."""
    trace = result.solution.record.trace
    return max(float(trace[0, 0]), 0.0) if len(trace) else 0.0


def _around_zero(title: str, unit: str, curves: list[Curve], largest: float) -> Panel:
    top = _ROOM * largest or 1.0
    return Panel(title, unit, curves, top, -top)


def _span(result: DriveResult) -> float:
    """Time that the trace covers [s]."""
    trace = result.solution.record.trace
    return float(trace[-1, 0]) - _begin(result) if len(trace) > 1 else 1e-12


def _times(result: DriveResult, times: Array | None = None) -> Array:
    """Times [s], or those of the trace, from its begin in the unit of the axis."""
    factor, _ = unit_for(_span(result), "s", least=1.0)
    since: Array = (result.solution.record.trace[:, 0] if times is None else times) - _begin(result)
    return factor * since
