"""Figure of the voltages of a drive over a short time: common-mode voltage, and both bearings below it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ehlectric.drive.result import DriveResult
from ehlectric.figures.data import Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.drive.looks import NAMES
from ehlectric.figures.drive.voltage_panels import bearing_panel, source_panel, time_axis
from ehlectric.figures.style import axes_or_new, legend_above


def source_voltage(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the common-mode voltage of the source over a short time, without its ringing."""
    return _draw(source_panel(result), result, ax)


def bearing_voltage(result: DriveResult, ax: Axes | None = None, *, b: int) -> Axes:
    """Draw the voltage across the films of bearing ``b``, 0 at the drive end, and mark its discharges."""
    return _draw(bearing_panel(result, b), result, ax)


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
            if label not in NAMES:
                found.setdefault(label, handle)
    if found:
        legend_above(axes[0], list(found.values()))


def _draw(panel: Panel, result: DriveResult, ax: Axes | None) -> Axes:
    ax = axes_or_new(ax)
    draw_panel(panel, ax, time_axis(result))
    for line in ax.get_lines():
        # The trace ends with a discharge, whose mark would be cut at the edge.
        line.set_clip_on(line.get_marker() == "None")
    return ax
