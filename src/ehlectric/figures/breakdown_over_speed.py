"""Figures of a bearing over the speed of its shaft: breakdown and shaft voltage, capacitance and films."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ehlectric.bearing import BearingResult, Curves, Speed, Speeds, critical_speed_of, curves_of, value_of
from ehlectric.figures.bearing_figures import label_ends, volts
from ehlectric.figures.data import Along, Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.speed_panels import breakdown_panel, capacitance_panel, margin_panel, speed_axis
from ehlectric.figures.style import axes_or_new, figure_of, legend_above, note, outlined
from ehlectric.quantities import units
from ehlectric.quantities.formats import speed_text
from ehlectric.quantities.palette import GREY, ORANGE
from ehlectric.readable import ratio_text

# Height of the room that a label between curves needs, as part of the axes.
_GAP = 0.2

# Place from which on the name of a speed is left of its line, as part of the axes.
_RIGHTMOST = 0.85

# Width of the label of the margin with its distance from its arrow [pt].
_WIDTH = 75.0


def capacitance_over_speed(points: Speeds, ax: Axes | None = None, *, at_case: Speed | None = None) -> Axes:
    """Draw the capacitance of a bearing over its speed, with its range from air to oil around the films.

    ``points`` are speeds of the inner ring [rad/s] with their summaries; ``at_case``, speed and summary of
    the bearing itself, is marked with a star, and the curves are scaled to it.
    """
    curves = curves_of(points, at_case)
    return _draw(capacitance_panel(points, curves, at_case), curves, axes_or_new(ax))


def breakdown_over_speed(points: Speeds, ax: Axes | None = None, *, at_case: Speed | None = None) -> Axes:
    """Draw first and ring-to-ring breakdown of a bearing over its speed, with the shaft voltage.

    The arguments are the arguments of ``capacitance_over_speed``. The area is shaded where the shaft voltage
    is above the first breakdown, and the critical speed and the margin of the bearing itself are named.
    """
    ax, curves = axes_or_new(ax), curves_of(points, at_case)
    _draw(breakdown_panel(points, curves, at_case), curves, ax)
    _name_critical(curves, ax)
    _label_margin(at_case, curves, ax)
    return ax


def margin_over_speed(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the margin of a bearing over its speed within the uncertain inputs: median and 90 of 100 cases."""
    ax, band, margin = axes_or_new(ax), result.margin_band, result.margin
    assert band is not None and margin is not None
    panel = margin_panel(band, (result.case.bearing.inner_speed, margin))
    draw_panel(panel, ax, Along("speed of the inner ring", "rpm", log=True))
    label_ends(ax, [(float(line.y[-1]), line.name, line.colour) for line in panel.curves if line.name])
    legend_above(ax, [area for area in ax.collections if not str(area.get_label()).startswith("_")])
    return ax


def _draw(panel: Panel, curves: Curves, ax: Axes) -> Axes:
    """Draw a panel with the names of its lines next to the axes, and of its areas above them."""
    draw_panel(panel, ax, speed_axis(curves))
    ends = [
        (float(line.y[np.isfinite(line.y)][-1]), "\n".join(line.name.rsplit(" ", 1)), line.colour)
        for line in panel.curves
        if line.name
    ]
    label_ends(ax, ends)
    named = [area for area in ax.collections if not str(area.get_label()).startswith("_")]
    if named:
        legend_above(ax, named)
    return ax


def _name_critical(curves: Curves, ax: Axes) -> None:
    """Write the critical speed at its line, at the end that is farther from where curves cross."""
    critical = critical_speed_of(curves)
    if critical is None:
        return
    at = units.rpm(critical)
    crossing = at, curves.at("shaft_voltage", critical)
    along, up = (ax.transData + ax.transAxes.inverted()).transform(crossing)
    side = "left" if along < _RIGHTMOST else "right"
    height, end = (0.03, "bottom") if up > 0.5 else (0.97, "top")
    note(ax, at, height, f" {speed_text(critical)} ", data_axis="x", ha=side, va=end, color=ORANGE)


def _label_margin(at_case: Speed | None, curves: Curves, ax: Axes) -> None:
    """Write the margin of the bearing itself next to an arrow."""
    if at_case is None or (first := value_of(at_case[1], "first_break")) is None:
        return
    rpm, shaft = units.rpm(at_case[0]), at_case[1]["bearing"]["shaft_voltage"]
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
        path_effects=outlined(2.0),
        **_label_place(ax, curves, rpm, first=first, shaft=shaft),
    )


def _label_place(ax: Axes, curves: Curves, rpm: float, *, first: float, shaft: float) -> dict[str, Any]:
    """Place of a label at two rising curves [V]: between them, below both, or above both where there is room.

    Offset of the label in points, and its alignment. Right of a speed, the curves are above their values at
    this speed, and left of it below them. If the first breakdown is the lower one, it rises faster than
    the shaft voltage, and may reach a label on the right.
    """
    to_axes = ax.transData + ax.transAxes.inverted()
    below, above = (float(to_axes.transform((rpm, value))[1]) for value in sorted((first, shaft)))
    if above - below > _GAP:
        figure = figure_of(ax)
        width = 72.0 * figure.get_figwidth() * ax.get_position().width
        at = float(to_axes.transform((rpm, first))[0])
        end = to_axes.inverted().transform((min(1.0, at + _WIDTH / width), 0.0))[0] * units.RPM
        reached = float(to_axes.transform((rpm, curves.at("first_break", end)))[1])
        if first < shaft and reached > 0.5 * (below + above) - 0.5 * _GAP:
            return {"xytext": (-6.0, 0.0), "va": "center", "ha": "right"}
        return {"xytext": (6.0, 0.0), "va": "center"}
    pointer = {"arrowstyle": "-", "color": GREY, "lw": 0.6, "shrinkA": 0.0, "shrinkB": 4.0}
    if below > _GAP:
        return {"xytext": (8.0, -26.0), "va": "top", "arrowprops": pointer}
    return {"xytext": (-8.0, 26.0), "va": "bottom", "ha": "right", "arrowprops": pointer}
