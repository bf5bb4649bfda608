"""Figure of the bearing voltages of a drive: how long which voltages last."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

from ehlectric.arrays import Array
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive.looks import COLOURS, NAMES, THRESHOLD, breakdown_of, voltage_unit
from ehlectric.figures.style import axes_or_new, legend_above

# Decades of the share of time that are drawn at most.
_DECADES = 1e-6

# Share of time at the lower end of the axis over the largest one, at most.
_LOW = 1e-2

# Breakdown voltage over the largest voltage up to which it is drawn.
_NEAR = 1.5

# Least number of bins on each side of zero that are drawn.
_BINS = 3


def time_at_voltage(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the share of time at the voltages across the films of both bearings.

    Parameters
    ----------
    result : DriveResult
        Result of the drive to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a logarithmic share, and with the breakdown voltages where they are near.
    """
    ax = axes_or_new(ax)
    record = result.solution.record
    most = _most(result)
    factor, unit = voltage_unit(most)
    width = float(record.edges[1] - record.edges[0])
    shares = 100.0 * record.histogram / record.duration
    for b, values in enumerate(shares):
        look: dict[str, Any] = {"fill": True, "alpha": 0.35, "lw": 0.0} if b == 0 else {"lw": 1.1}
        ax.stairs(values, factor * record.edges, color=COLOURS[b], label=NAMES[b], **look)
        if b == 0:
            ax.stairs(values, factor * record.edges, color=COLOURS[b], lw=0.7)
    _log_share(ax, shares)
    for k, volts in enumerate(_breakdowns(result)):
        for sign in (1.0, -1.0):
            label = "_" if k or sign < 0.0 else "breakdown, weakest position"
            ax.axvline(sign * factor * volts, label=label, **THRESHOLD)
    ax.set_xlim(-factor * most, factor * most)
    ax.set_xlabel(f"voltage across the films [{unit}]")
    ax.set_ylabel(f"share of time\nper {factor * width:.3g} {unit} [%]")
    legend_above(ax, columns=3)
    return ax


def time_above(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the share of time above a voltage, whatever its sign, with the limits of the summary as dots.

    Parameters
    ----------
    result : DriveResult
        Result of the drive to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a logarithmic share.
    """
    ax = axes_or_new(ax)
    record = result.solution.record
    most = _most(result)
    factor, unit = voltage_unit(most)
    edges, shares = shares_above(result)
    for b, values in enumerate(shares):
        known = values > 0.0
        ax.plot(factor * edges[known], values[known], color=COLOURS[b], lw=1.1, ls=("-", (0, (5, 2)))[b])
        above = 100.0 * record.above[b] / record.duration
        seen = above > 0.0
        look: dict[str, Any] = {
            "ls": "none",
            "marker": "os"[b],
            "ms": (8.0, 4.0)[b],
            "mfc": ("white", COLOURS[b])[b],
        }
        ax.plot(factor * record.limits[seen], above[seen], color=COLOURS[b], **look)
    _log_share(ax, shares)
    for volts in _breakdowns(result):
        ax.axvline(factor * volts, **THRESHOLD)
    ax.set_xlim(0.0, factor * most)
    ax.set_xlabel(f"voltage across the films, without its sign [{unit}]")
    ax.set_ylabel("share of time\nabove it [%]")
    return ax


def shares_above(result: DriveResult) -> tuple[Array, Array]:
    """Voltages from 0 on [V], and the share of time in which each film has a larger one [%].

    Returns
    -------
    edges : ndarray, shape (m,)
        Edges of the bins that are not negative.
    shares : ndarray, shape (2, m)
        Share of time above each edge, in either direction.
    """
    record = result.solution.record
    half = record.histogram.shape[1] // 2
    both = record.histogram[:, half:] + record.histogram[:, half - 1 :: -1]
    beyond = np.cumsum(both[:, ::-1], axis=1)[:, ::-1]
    shares: Array = 100.0 * np.column_stack([beyond, np.zeros(2)]) / record.duration
    return record.edges[half:], shares


def _most(result: DriveResult) -> float:
    """Largest voltage on the axis [V]."""
    record = result.solution.record
    width = float(record.edges[1] - record.edges[0])
    return max(1.05 * float(np.max(record.peak)), _BINS * width)


def _breakdowns(result: DriveResult) -> list[float]:
    """Breakdown voltages of both bearings that are near enough to be drawn [V], equal ones once."""
    found = sorted({breakdown_of(result, b) for b in range(2)})
    return [volts for volts in found if volts <= _NEAR * float(np.max(result.solution.record.peak))]


def _log_share(ax: Axes, shares: Array) -> None:
    """Logarithmic axis of shares of time [%], over at most some decades."""
    ax.set_yscale("log")
    known = shares[shares > 0.0]
    top = float(np.max(known, initial=1.0))
    least = max(float(np.min(known, initial=top)), _DECADES * top)
    ax.set_ylim(min(0.5 * least, _LOW * top), 2.0 * top)
    ax.yaxis.set_major_locator(LogLocator(numticks=6))
    ax.yaxis.set_minor_formatter(NullFormatter())
