"""Figures of a bearing over the speed of its shaft, from its summaries at several speeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array, Mask
from ehlectric.cases.quantity import unit_for
from ehlectric.figures.axes import is_wide, scale_axis
from ehlectric.figures.bearing.circuit import FIRST, SHAFT, THROUGH
from ehlectric.figures.style import BLUE, GREY, ORANGE, axes_or_new, legend_above

# Speed of the inner ring [rad/s] with the summary of the bearing at this speed.
Speed = tuple[float, dict[str, Any]]
Speeds = Sequence[Speed]


def capacitance_over_speed(points: Speeds, ax: Axes | None = None, *, own: Speed | None = None) -> Axes:
    """Draw the capacitance of a bearing over its speed, with its range from air to oil around the films.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    own : (float, dict), optional
        Speed and summary of a bearing to mark with a star, for example one with solved contacts.

    Returns
    -------
    Axes
        Axes whose scales are logarithmic if the values differ by more than a factor of 20.
    """
    ax = axes_or_new(ax)
    speed = _speed(points, ax)
    values, oil, air = (_of(points, key) for key in ("capacitance", "capacitance_oil", "capacitance_air"))
    factor, unit = unit_for(float(np.nanmax(oil)), "F", least=1.0)
    label = "from air to oil around the films"
    ax.fill_between(speed, factor * air, factor * oil, color=BLUE, alpha=0.15, lw=0.0, label=label)
    ax.plot(speed, factor * oil, color=BLUE, lw=0.7)
    ax.plot(speed, factor * air, color=BLUE, lw=0.7)
    fills = {str(summary["inputs"]["bearing"]["fill"]) for _, summary in points}
    fill = f", {fills.pop()} around the films" if len(fills) == 1 else ""
    label = f"capacitance of the bearing{fill}"
    ax.plot(speed, factor * values, color="black", lw=1.4, marker="o", ms=4.0, label=label)
    marked = _mark(ax, own, ("capacitance",), factor)
    everything = np.append(factor * np.concatenate([oil, air, values]), marked)
    log = is_wide(everything)
    scale_axis(ax.yaxis, f"capacitance [{unit}]", values=everything, log=log)
    if not log:
        ax.set_ylim(0.0, 1.1 * float(np.nanmax(everything)))
    _lubrication(points, ax, speed)
    legend_above(ax)
    return ax


def breakdown_over_speed(points: Speeds, ax: Axes | None = None, *, own: Speed | None = None) -> Axes:
    """Draw first break and through breakdown of a bearing over its speed, with the shaft voltage.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    own : (float, dict), optional
        Speed and summary of a bearing to mark with a star, for example one with solved contacts.

    Returns
    -------
    Axes
        Axes with a shaded area between first break and shaft voltage, where the shaft voltage is higher.
    """
    ax = axes_or_new(ax)
    speed = _speed(points, ax)
    first, through = _of(points, "first_break"), _of(points, "through_breakdown")
    shaft = _of(points, "shaft_voltage")
    ax.plot(speed, through, marker="o", ms=6.0, label="through breakdown", **THROUGH)
    ax.plot(speed, first, marker="o", ms=3.5, label="first break", **FIRST)
    if np.any(np.isfinite(shaft)):
        ax.plot(speed, shaft, label="shaft voltage", **SHAFT)
        over: Mask = shaft > first
        if np.any(over):
            label = "shaft voltage above first break"
            look: dict[str, Any] = {"color": ORANGE, "alpha": 0.2, "lw": 0.0, "label": label}
            ax.fill_between(speed, first, shaft, where=list(over), interpolate=True, **look)
    marked = _mark(ax, own, ("through_breakdown", "first_break"), 1.0)
    everything = np.concatenate([first, through, shaft, marked])
    log = is_wide(everything)
    scale_axis(ax.yaxis, "bearing voltage [V]", values=everything, log=log)
    if not log:
        ax.set_ylim(0.0, 1.1 * float(np.nanmax(everything)))
    _lubrication(points, ax, speed)
    legend_above(ax)
    return ax


def breaks_anywhere(points: Speeds) -> bool:
    """Whether there is a breakdown voltage at any speed."""
    return bool(np.any(np.isfinite(_of(points, "first_break"))))


def _mark(ax: Axes, own: Speed | None, keys: Sequence[str], factor: float) -> Array:
    """Draw a star at each value of a single bearing, and return these values."""
    if own is None:
        return np.empty(0)
    values = factor * np.concatenate([_of([own], key) for key in keys])
    look: dict[str, Any] = {"ls": "none", "marker": "*", "ms": 11.0, "color": "black", "mec": "white"}
    label = f"at its own speed, contacts {how_found([own])}"
    ax.plot(np.full(values.size, own[0] * 30.0 / np.pi), values, zorder=6.0, label=label, **look)
    return values


def how_found(points: Speeds) -> str:
    """Text: how films and fields were obtained, "solved" or "by formula"."""
    names = {"solved": "solved", "formula": "by formula"}
    return " or ".join(sorted({names[summary["bearing"]["contacts"]] for _, summary in points}))


def _of(points: Speeds, key: str) -> Array:
    """Values of a key of the bearing in the order of the speeds, NaN in place of None."""
    values = [summary["bearing"][key] for _, summary in sorted(points, key=lambda point: point[0])]
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def _speed(points: Speeds, ax: Axes) -> Array:
    """Speeds in ascending order [rpm], for which the axis is scaled."""
    speed = np.array(sorted(speed for speed, _ in points)) * 30.0 / np.pi
    log = is_wide(speed)
    scale_axis(ax.xaxis, "speed of the inner ring [rpm]", values=np.round(speed, 6), log=log)
    return speed


def _lubrication(points: Speeds, ax: Axes, speed: Array) -> None:
    """Draw markers along the lower edge at speeds at which the lambda ratio is below 3."""
    states = [summary["bearing"]["lubrication"] for _, summary in sorted(points, key=lambda point: point[0])]
    kinds: tuple[tuple[tuple[str, ...], str, dict[str, Any]], ...] = (
        (("conducting", "touching"), r"$\lambda$ < 1: surfaces touch", {"color": ORANGE, "marker": "X"}),
        (("partial film",), r"$\lambda$ from 1 to 3: surfaces may touch", {"color": GREY, "marker": "^"}),
    )
    for names, label, look in kinds:
        on = np.array([state in names for state in states])
        if np.any(on):
            edge = ax.get_xaxis_transform()
            marks: dict[str, Any] = {"ls": "none", "ms": 6.0, "clip_on": False, "zorder": 5.0, "label": label}
            ax.plot(speed[on], np.zeros(np.sum(on)), transform=edge, **look, **marks)
