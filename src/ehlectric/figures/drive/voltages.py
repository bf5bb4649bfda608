"""Figure of the voltages of a drive over a short time: common-mode voltage, and both bearings below it."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ehlectric.drive.discharges.record import ON, VOLTAGE
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive.looks import COLOURS, NAMES, THRESHOLD, breakdown_of, events_of, voltage_unit
from ehlectric.figures.style import GREY, axes_or_new, legend_above
from ehlectric.quantities.units import unit_for

# Breakdown voltage over the largest voltage of a panel up to which it is drawn.
_NEAR = 1.8

# Room above and below the curves, for what marks them.
_ROOM = 1.12


def source_voltage(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the common-mode voltage of the source over a short time, without its ringing.

    Parameters
    ----------
    result : DriveResult
        Result of the drive to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes of this time, which is around a typical discharge if there is one.
    """
    ax = axes_or_new(ax)
    trace = result.solution.record.trace
    factor, unit = voltage_unit(float(np.max(np.abs(trace[:, 1]), initial=0.0)))
    ax.plot(_times(result, ax), factor * trace[:, 1], color=GREY, lw=0.9)
    ax.set_ylabel(f"common mode [{unit}]")
    return ax


def bearing_voltage(result: DriveResult, ax: Axes | None = None, *, b: int) -> Axes:
    """Draw the voltage across the films of one bearing over a short time, and mark its discharges.

    Parameters
    ----------
    result : DriveResult
        Result of the drive to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    b : int
        Number of the bearing: 0 at the drive end, 1 at the other one.

    Returns
    -------
    Axes
        Axes with the breakdown voltage as dashed lines, where it is near the voltages.
    """
    ax = axes_or_new(ax)
    record = result.solution.record
    trace, volts = record.trace, record.trace[:, 2 + b]
    own = events_of(result, b)
    here = own[(own[:, ON] >= _begin(result)) & (own[:, ON] <= _begin(result) + _span(result))]
    largest = max(float(np.max(np.abs(values), initial=0.0)) for values in (volts, here[:, VOLTAGE]))
    factor, unit = voltage_unit(largest)
    ax.plot(_times(result, ax), factor * volts, color=COLOURS[b], lw=0.9, label="across the films")
    breakdown, top = breakdown_of(result, b), largest
    if breakdown <= _NEAR * largest:
        shape = result.solution.elements[b].shape
        label = "breakdown, weakest position" + (" (63 %)" if math.isfinite(shape) else "")
        for k, sign in enumerate((1.0, -1.0)):
            ax.axhline(sign * factor * breakdown, label="_" if k else label, **THRESHOLD)
        top = max(largest, breakdown)
    if len(here):
        scale, _ = unit_for(_span(result), "s", least=1.0)
        at = scale * (here[:, ON] - _begin(result))
        look: dict[str, Any] = {
            "ls": "none",
            "marker": "o",
            "ms": 4.5,
            "mfc": "white",
            "mec": "black",
            "mew": 0.9,
        }
        ax.plot(at, factor * here[:, VOLTAGE], label="discharge", zorder=4.0, clip_on=False, **look)
    if len(trace):
        ax.set_ylim(-_ROOM * factor * top - 1e-12, _ROOM * factor * top + 1e-12)
    ax.set_ylabel(f"{NAMES[b]} [{unit}]")
    return ax


# Panels of the figure, from top to bottom.
VOLTAGE_PANELS: tuple[Callable[[DriveResult, Axes], Axes], ...] = (
    source_voltage,
    *(partial(bearing_voltage, b=b) for b in range(2)),
)


def legend_of(axes: list[Axes]) -> None:
    """Legend above the first panel, with what any of the panels shows."""
    found: dict[str, Artist] = {}
    for ax in axes[1:]:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            if label != "across the films":
                found.setdefault(label, handle)
    if found:
        legend_above(axes[0], list(found.values()))


def _begin(result: DriveResult) -> float:
    """Begin of the trace [s]."""
    trace = result.solution.record.trace
    return max(float(trace[0, 0]), 0.0) if len(trace) else 0.0


def _span(result: DriveResult) -> float:
    """Time that the trace covers [s]."""
    trace = result.solution.record.trace
    return float(trace[-1, 0]) - _begin(result) if len(trace) > 1 else 1e-12


def _times(result: DriveResult, ax: Axes) -> np.ndarray:
    """Times of the trace from its begin, in the unit of the axis, which is labelled."""
    begin, span = _begin(result), _span(result)
    factor, unit = unit_for(span, "s", least=1.0)
    since = "" if begin < 1e-3 * span else f" after {_text(begin)}"
    ax.set_xlabel(f"time{since} [{unit}]")
    ax.set_xlim(0.0, factor * span)
    times: np.ndarray = factor * (result.solution.record.trace[:, 0] - begin)
    return times


def _text(seconds: float) -> str:
    factor, unit = unit_for(seconds, "s", least=1.0)
    return f"{factor * seconds:.4g} {unit}"
