"""Figures of a bearing over the speed of its shaft, from its summaries at several speeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.solution import CONDUCTING, PARTIAL
from ehlectric.discharge.verdict import ratio_text
from ehlectric.figures.axes import is_wide, scale_axis
from ehlectric.figures.bearing.curves import (
    RPM,
    Curves,
    Speed,
    Speeds,
    critical_speed_of,
    curves_of,
    is_coated,
    nearly_equal,
    value_of,
)
from ehlectric.figures.bearing.looks import FIRST, SHAFT, THROUGH, label_ends, volts
from ehlectric.figures.style import BLUE, GREY, ORANGE, axes_or_new, figure_of, legend_above
from ehlectric.quantities import units
from ehlectric.quantities.units import unit_for

# Legend entry of speeds at which no voltage is computed.
_OPENING = r"$\lambda$ < 1: contacts open and close, discharges likely"

# Shading of speeds at which contacts open and close, and at which they touch at times.
_OPEN: dict[str, Any] = {"facecolor": (ORANGE, 0.18), "edgecolor": (ORANGE, 0.5), "hatch": "xxx"}
_AT_TIMES: dict[str, Any] = {"facecolor": (GREY, 0.12), "edgecolor": "none"}

# Height of the room that a label between curves needs, as part of the axes.
_GAP = 0.2

# Place from which on the name of a speed is left of its line, as part of the axes.
_RIGHTMOST = 0.85

# Width of the label of the margin with its distance from its arrow [pt].
_WIDTH = 75.0

_STAR: dict[str, Any] = {"ls": "none", "marker": "*", "ms": 12.0, "color": "black", "mec": "white"}


def capacitance_over_speed(points: Speeds, ax: Axes | None = None, *, own: Speed | None = None) -> Axes:
    """Draw the capacitance of a bearing over its speed, with its range from air to oil around the films.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    own : (float, dict), optional
        Speed and summary of the bearing itself: it is marked with a star, and the curves are scaled to it.

    Returns
    -------
    Axes
        Axes whose scales are logarithmic if the values differ by more than a factor of 20.
    """
    ax = axes_or_new(ax)
    curves = curves_of(points, own)
    speed = _speed_axis(curves, ax)
    oil, air = curves["capacitance_oil"], curves["capacitance_air"]
    factor, unit = unit_for(float(np.nanmax(oil)), "F", least=1.0)
    ax.fill_between(speed, factor * air, factor * oil, color=BLUE, alpha=0.15, lw=0.0)
    fills = {str(summary["inputs"]["bearing"]["fill"]) for _, summary in points}
    used = fills.pop() if len(fills) == 1 else ""
    ends = []
    for fill, values in (("oil", oil), ("air", air)):
        look: dict[str, Any] = {"lw": 1.4, "marker": "o", "ms": 4.0} if fill == used else {"lw": 0.7}
        ax.plot(speed, factor * values, color=BLUE, label=f"{fill} around the films", **look)
        ends.append((float(factor * values[-1]), f"{fill} around\nthe films", BLUE))
    if used not in ("oil", "air"):
        look = {"lw": 1.4, "marker": "o", "ms": 4.0}
        ax.plot(
            speed, factor * curves["capacitance"], color="black", label="capacitance of the bearing", **look
        )
    if own is not None:
        ax.plot([own[0] * RPM], [factor * own[1]["bearing"]["capacitance"]], zorder=6.0, **_STAR)
    everything = factor * np.concatenate([oil, air, curves["capacitance"]])
    log = is_wide(everything)
    scale_axis(ax.yaxis, f"capacitance [{unit}]", values=everything, log=log)
    if not log:
        ax.set_ylim(0.0, 1.1 * float(np.nanmax(everything)))
    label_ends(ax, ends)
    _lubrication(points, ax, speed)
    _contacts_open(curves, ax)
    return ax


def breakdown_over_speed(points: Speeds, ax: Axes | None = None, *, own: Speed | None = None) -> Axes:
    """Draw first and ring-to-ring breakdown of a bearing over its speed, with the shaft voltage.

    Parameters
    ----------
    points : sequence of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    own : (float, dict), optional
        Speed and summary of the bearing itself: its margin is marked, and the curves are scaled to it.

    Returns
    -------
    Axes
        Axes in which the area is shaded where the shaft voltage is above the first breakdown, and the speed
        is marked below which it is. Curves between the speeds are powers of the speed.
    """
    ax = axes_or_new(ax)
    curves = curves_of(points, own)
    speed = _speed_axis(curves, ax)
    first, through, shaft = (curves[key] for key in ("first_break", "through_breakdown", "shaft_voltage"))
    one = nearly_equal(first, through)
    names = [("first and ring-to-ring\nbreakdown" if one else "first\nbreakdown", "first_break", FIRST)]
    names += [] if one else [("ring-to-ring\nbreakdown", "through_breakdown", THROUGH)]
    names += [("shaft\nvoltage", "shaft_voltage", SHAFT)]
    everything = np.concatenate([first, through, shaft])
    log = is_wide(everything)
    name = "shaft" if is_coated(points) else "bearing"
    scale_axis(ax.yaxis, f"{name} voltage [V]", values=everything, log=log)
    if not log:
        ax.set_ylim(0.0, 1.1 * float(np.nanmax(everything)))
    ends = []
    for text, key, look in reversed(names):
        values = curves[key]
        known = np.flatnonzero(np.isfinite(values))
        if known.size:
            at, between = curves.between(key)
            ax.plot(at * RPM, between, label=text.replace("\n", " "), **look)
            ax.plot(speed, values, ls="none", marker="o", ms=3.5, color=look["color"])
            ends.append((float(values[known[-1]]), text, look["color"]))
    danger = _danger(curves, ax)
    _critical(curves, ax)
    _own_margin(own, curves, ax)
    label_ends(ax, ends)
    _lubrication(points, ax, speed, danger)
    _contacts_open(curves, ax)
    return ax


def _contacts_open(curves: Curves, ax: Axes) -> None:
    """Shade the speeds with a lambda ratio below 1 and, lighter, below 3: they must not read as safe."""
    speed, ratio = curves.between("lambda_ratio")
    looks = ((0.0, CONDUCTING, _OPEN), (CONDUCTING, PARTIAL, _AT_TIMES))
    for low, high, look in looks:
        within = (ratio >= low) & (ratio < high)
        # Up to the next node, so that no gap is left between both.
        within[1:] |= within[:-1] & np.isfinite(ratio[1:])
        if np.any(within):
            edge = ax.get_xaxis_transform()
            ax.fill_between(
                speed * RPM, 0.0, 1.0, where=list(within), transform=edge, lw=0.0, zorder=0.0, **look
            )


def _danger(curves: Curves, ax: Axes) -> list[Artist]:
    """Shade the area between first breakdown and shaft voltage where the latter is higher, and return it."""
    speed, first = curves.between("first_break")
    _, shaft = curves.between("shaft_voltage")
    over: Mask = shaft > first
    if not np.any(over):
        return []
    look: dict[str, Any] = {"color": ORANGE, "alpha": 0.2, "lw": 0.0, "label": "breakdown expected"}
    area = ax.fill_between(speed * RPM, first, shaft, where=list(over), interpolate=True, **look)
    return [area]


def _critical(curves: Curves, ax: Axes) -> None:
    """Mark the speed below which breakdown is expected, and write it at its line."""
    critical = critical_speed_of(curves)
    if critical is None:
        return
    rpm = critical * RPM
    ax.axvline(rpm, color=ORANGE, lw=1.0, ls=":")
    ax.plot(
        [rpm],
        [curves.at("shaft_voltage", critical)],
        ls="none",
        marker="o",
        ms=7.0,
        mfc="white",
        mec=ORANGE,
        mew=1.6,
        zorder=5.5,
    )
    inside = (ax.transData + ax.transAxes.inverted()).transform((rpm, 1.0))[0] < _RIGHTMOST
    ax.text(
        rpm,
        0.03,
        f" {rpm_text(critical)} ",
        ha="left" if inside else "right",
        transform=ax.get_xaxis_transform(),
        color=ORANGE,
        va="bottom",
        fontsize="small",
    )


def rpm_text(speed: float) -> str:
    """Text: speed [rad/s] in rpm with three digits, as an interpolated speed deserves.

    Examples
    --------
    >>> rpm_text(144.9)
    '1380 rpm'
    """
    return f"{units.rpm_text(speed)} rpm"


def _own_margin(own: Speed | None, curves: Curves, ax: Axes) -> None:
    """Mark the breakdown voltage of the bearing itself, and write its margin beside an arrow."""
    if own is None or (first := value_of(own[1], "first_break")) is None:
        return
    rpm, shaft = own[0] * RPM, own[1]["bearing"]["shaft_voltage"]
    ax.plot([rpm], [first], zorder=6.0, **_STAR)
    if shaft is None:
        ax.annotate(f"{volts(first)} ", (rpm, first), ha="right", va="bottom", fontsize="small")
        return
    arrow = {"arrowstyle": "<->", "color": GREY, "lw": 0.9, "shrinkA": 0.0, "shrinkB": 2.0}
    ax.annotate("", (rpm, first), (rpm, shaft), arrowprops=arrow)
    middle = (first * shaft) ** 0.5 if ax.get_yscale() == "log" else 0.5 * (first + shaft)
    ax.annotate(
        f"margin {ratio_text(first / shaft)}",
        (rpm, middle),
        textcoords="offset points",
        fontsize="small",
        zorder=6.0,
        path_effects=[withStroke(linewidth=2.0, foreground="white")],
        **_beside(ax, curves, rpm, first=first, shaft=shaft),
    )


def _beside(ax: Axes, curves: Curves, rpm: float, *, first: float, shaft: float) -> dict[str, Any]:
    """Place of a label at two rising curves [V]: between them, below both, or above both where there is room.

    Offset of the label in points, and its alignment. Right of a speed, the curves are above their values at
    this speed, and left of it below them. Where the first breakdown is the lower one, it rises faster than
    the shaft voltage, and may reach a label on the right.
    """
    to_axes = ax.transData + ax.transAxes.inverted()
    below, above = (float(to_axes.transform((rpm, value))[1]) for value in sorted((first, shaft)))
    if above - below > _GAP:
        figure = figure_of(ax)
        width = 72.0 * figure.get_figwidth() * ax.get_position().width
        at = float(to_axes.transform((rpm, first))[0])
        end = to_axes.inverted().transform((min(1.0, at + _WIDTH / width), 0.0))[0] / RPM
        reached = float(to_axes.transform((rpm, curves.at("first_break", end)))[1])
        if first < shaft and reached > 0.5 * (below + above) - 0.5 * _GAP:
            return {"xytext": (-6.0, 0.0), "va": "center", "ha": "right"}
        return {"xytext": (6.0, 0.0), "va": "center"}
    pointer = {"arrowstyle": "-", "color": GREY, "lw": 0.6, "shrinkA": 0.0, "shrinkB": 4.0}
    if below > _GAP:
        return {"xytext": (8.0, -26.0), "va": "top", "arrowprops": pointer}
    return {"xytext": (-8.0, 26.0), "va": "bottom", "ha": "right", "arrowprops": pointer}


def _speed_axis(curves: Curves, ax: Axes) -> Array:
    """Scale the axis of speeds, and return them in ascending order [rpm]."""
    speed: Array = curves.speed * RPM
    scale_axis(ax.xaxis, "speed of the inner ring [rpm]", values=np.round(speed, 6), log=is_wide(speed))
    return speed


def _lubrication(points: Speeds, ax: Axes, speed: Array, areas: Sequence[Artist] = ()) -> None:
    """Draw markers along the lower edge where the lambda ratio is below 3; a legend of them and of areas."""
    states = [summary["bearing"]["lubrication"] for _, summary in sorted(points, key=lambda point: point[0])]
    kinds: tuple[tuple[tuple[str, ...], str, dict[str, Any], dict[str, Any]], ...] = (
        (
            ("conducting", "touching"),
            _OPENING,
            {"color": ORANGE, "marker": "X"},
            _OPEN,
        ),
        (
            ("partial film",),
            r"$\lambda$ from 1 to 3: contacts at times",
            {"color": GREY, "marker": "^"},
            _AT_TIMES,
        ),
    )
    handles: list[Any] = list(areas)
    labels = [str(area.get_label()) for area in areas]
    for names, label, look, shading in kinds:
        on = np.array([state in names for state in states])
        if np.any(on):
            edge = ax.get_xaxis_transform()
            marks: dict[str, Any] = {"ls": "none", "ms": 6.0, "clip_on": False, "zorder": 5.0, "label": label}
            drawn = ax.plot(speed[on], np.zeros(np.sum(on)), transform=edge, **look, **marks)
            # The marks of the speeds stand on the shading between them.
            handles.append((Patch(lw=0.0, **shading), *drawn))
            labels.append(label)
    if handles:
        legend_above(ax, handles, labels=labels)


def breaks_anywhere(points: Speeds) -> bool:
    """Whether there is a breakdown voltage at any speed."""
    return any(summary["bearing"]["first_break"] is not None for _, summary in points)
