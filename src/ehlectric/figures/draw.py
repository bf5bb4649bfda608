"""Panels of figures that are data, drawn by Matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator

from ehlectric.figures.data import WIDTH, Along, Area, Curve, Panel, with_unit
from ehlectric.figures.figure_names import broken
from ehlectric.figures.style import scale_axis
from ehlectric.quantities.palette import GREY

# Letters on a line of the name of a row, and lines of it.
_LETTERS, _LINES = 20, 2

# Dashes by their names.
DASHES: Mapping[str, Any] = {
    "solid": "-",
    "dash": "--",
    "dot": ":",
    "dashdot": "-.",
    "longdash": (0, (5.0, 1.5)),
}

_MARKERS: Mapping[str, dict[str, Any]] = {
    "dots": {"marker": "o", "ms": 3.5},
    "ring": {"marker": "o", "ms": 4.5, "mfc": "white", "mew": 1.2, "zorder": 5.5},
    "star": {"marker": "*", "ms": 12.0, "mec": "white", "zorder": 6.0},
    "circle": {"marker": "o", "ms": 4.0, "mfc": "none", "mew": 0.8},
    "wide circle": {"marker": "o", "ms": 6.5, "mfc": "none", "mew": 0.9},
    "square": {"marker": "s", "ms": 4.0, "mfc": "none", "mew": 0.8},
    "diamond": {"marker": "D", "ms": 4.2, "mfc": "none", "mew": 1.2},
    "plus": {"marker": "+", "ms": 7.0, "mew": 1.3},
    "cross": {"marker": "x", "ms": 5.5, "mew": 1.6},
    "wide cross": {"marker": "X", "ms": 5.0, "mec": "black", "mew": 0.4},
    "full square": {"marker": "s", "ms": 3.5},
    "full diamond": {"marker": "D", "ms": 3.5},
    "bound": {"marker": "<", "ms": 4.2, "mfc": "white"},
}


def marker_look(curve: Curve) -> dict[str, Any]:
    """Look of the markers of a curve as Matplotlib takes it."""
    look = _MARKERS[curve.marker]
    return {"ls": "none", "color": curve.colour, **look, "ms": curve.size * look["ms"]}


def line_look(colour: str, dash: str = "solid", width: float = WIDTH) -> dict[str, Any]:
    """Look of a line as Matplotlib takes it."""
    return {"color": colour, "ls": DASHES[dash], "lw": width}


def draw_curves(curves: Sequence[Curve], ax: Axes) -> list[Line2D]:
    """Draw curves over each other, the last one on top."""
    lines: list[Line2D] = []
    # Lines of a journal are thinner, by its settings of Matplotlib.
    thinner = mpl.rcParams["lines.linewidth"] / WIDTH
    for k, curve in enumerate(curves):
        look = line_look(curve.colour, curve.dash, thinner * curve.width) | {"zorder": 2.0 + 0.01 * k}
        if curve.marker:
            look |= marker_look(curve)
        if curve.steps:
            look["drawstyle"] = "steps-post"
        lines += ax.plot(curve.x, curve.y, label=curve.name or "_", **look)
    return lines


def draw_panel(panel: Panel, ax: Axes, along: Along | None = None) -> None:
    """Draw a panel with its axis and, where it is given, the axis along it."""
    x, y = (np.concatenate([getattr(curve, axis) for curve in panel.curves]) for axis in ("x", "y"))
    if along is not None:
        scale_axis(ax.xaxis, along.title, values=np.round(x, 6), log=along.log)
        if along.window is not None:
            ax.set_xlim(*along.window)
    # Ticks also reach as far as shaded areas.
    ends = [end for area in panel.areas if area.ends is not None for end in area.ends]
    scale_axis(ax.yaxis, with_unit(panel.title, panel.unit), values=np.concatenate([y, *ends]), log=panel.log)
    if panel.ends is not None:
        ax.set_ylim(*panel.ends)
    if panel.rows:
        _name_rows(panel.rows, ax)
    for area in panel.areas:
        draw_area(area, ax)
    draw_curves(panel.curves, ax)
    for line in panel.uprights:
        ax.axvline(line.at, label=line.name or "_", **line_look(line.colour, line.dash, 1.0))


def _name_rows(names: Sequence[str], ax: Axes) -> None:
    """Write the names of rows, from top to bottom, and draw lines between them."""
    ax.yaxis.set_minor_locator(NullLocator())
    ax.set_yticks(np.arange(len(names)), labels=[broken(name, _LETTERS, _LINES) for name in names])
    ax.tick_params(axis="y", length=0.0)
    for row in range(1, len(names)):
        ax.axhline(row - 0.5, color=GREY, lw=0.4, alpha=0.5)


def draw_area(area: Area, ax: Axes) -> None:
    """Draw a shaded area."""
    look: dict[str, Any] = {"facecolor": (area.colour, area.opacity), "lw": 0.0, "label": area.name or "_"}
    if area.hatched:
        look |= {"edgecolor": (area.colour, 0.3), "hatch": "//"}  # a curve over it stays visible
    if area.ends is None:
        look |= {"transform": ax.get_xaxis_transform(), "zorder": 0.0}
    low, high = (0.0, 1.0) if area.ends is None else area.ends
    ax.fill_between(area.x, low, high, where=list(area.within), interpolate=area.ends is not None, **look)
