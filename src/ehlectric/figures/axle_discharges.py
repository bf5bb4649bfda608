"""Figure of the discharges of an axle: voltages of all shafts over a short time. Each element has a row of
marks.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ehlectric.arrays import Array
from ehlectric.axle import AxleDischarges, AxleResult
from ehlectric.cases.axle_keys import HOUSING
from ehlectric.errors import printable
from ehlectric.figures.category_maps import colours_of_names
from ehlectric.figures.data import Along, Curve, Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.style import legend_above, new_panels
from ehlectric.quantities.palette import BLACK, MIDDLE_GREY
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

_SIZE, _HEIGHT = 8.0, 1.5

# Height of a row of marks, and of the space around the voltages, over the height of a panel.
_ROW, _SPACE = 0.085, 0.05


def axle_discharges(result: AxleResult) -> Axes:
    """Draw the voltages of the source and of all shafts over a short time.

    A mark is a discharge when it begins. Each element of a shaft has a row of marks above its voltage, so
    that discharges at one time do not hide each other.
    """
    along, panels = discharge_panels(result)
    axes = new_panels(len(panels), 1, (_SIZE, 1.2 + _HEIGHT * len(panels)))
    for ax, panel in zip(axes, panels, strict=True):
        draw_panel(panel, ax, along)
        ax.tick_params(labelbottom=ax is axes[-1])
        if ax is not axes[-1]:
            ax.set_xlabel("")
    by_label: dict[str, Artist] = {}
    for ax, panel in zip(axes, panels, strict=True):
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            if label != panel.curves[0].name:
                by_label.setdefault(label, handle)
    if by_label:
        legend_above(axes[0], list(by_label.values()), columns=2)
    return axes[0]


def discharge_panels(result: AxleResult) -> tuple[Along, list[Panel]]:
    """Axis of a short time around a discharge, and panels with the voltages of the source and of all shafts.

    Marks of one element are one row, and have one colour and, in the first panel with them, a name.
    """
    discharges = result.discharges
    assert discharges is not None
    times, source, shafts = discharges.trace
    factor, unit = unit_for(float(times[-1] - times[0]), "s", least=1.0)
    since = factor * (times - times[0])
    low, high, _ = _limits(source, 0)
    panels = [Panel("source", "V", [Curve("source", since, source, MIDDLE_GREY, width=0.9)], high, low)]
    marks = _marks(result, discharges)
    names = [*dict.fromkeys(name for name, *_ in marks)]
    colours = dict(zip(names, colours_of_names(names), strict=True))
    named = set[str]()
    for shaft, volts in shafts.items():
        curves = [Curve(printable(shaft), since, volts, BLACK, width=0.9)]
        of_shaft = [name for name in names if any((name, shaft) == (other, at) for other, at, _ in marks)]
        low, high, heights = _limits(volts, len(of_shaft))
        for name, height in zip(of_shaft, heights, strict=True):
            begins = np.array([time for other, at, time in marks if (other, at) == (name, shaft)])
            places = np.maximum(np.searchsorted(times, begins, side="right") - 1, 0)
            curves.append(
                Curve(
                    "" if name in named else printable(name),
                    factor * (begins - times[0]),
                    np.full(begins.size, height),
                    colours[name],
                    marker="circle",
                    texts=[f"{printable(name)} at {readable(float(volts[k]), 3)} V" for k in places],
                )
            )
            named.add(name)
        panels.append(Panel(printable(shaft), "V", curves, high, low))
    return Along("time", unit, (float(since[0]), float(since[-1]))), panels


def _limits(volts: Array, rows: int) -> tuple[float, float, list[float]]:
    """Lowest and highest value of an axis for some voltages, and heights of the marks above them [V]."""
    low, high = float(np.min(volts)), float(np.max(volts))
    height = (high - low or 1.0) / (1.0 - 2.0 * _SPACE - _ROW * rows)
    top = high + (_SPACE + _ROW * rows) * height
    return low - _SPACE * height, top, [top - _ROW * (row + 0.7) * height for row in range(rows)]


def _marks(result: AxleResult, discharges: AxleDischarges) -> list[tuple[str, str, float]]:
    """Element, shaft and time of each discharge within the trace [s], of a mesh for both of its shafts."""
    times, _, shafts = discharges.trace
    ends = {each.name: (each.first, each.second) for each in result.solution.elements}
    return [
        (row["element"], shaft, row["time"])
        for row in discharges.events()
        if times[0] <= row["time"] <= times[-1]
        for shaft in ends[row["element"]]
        if shaft != HOUSING and shaft in shafts
    ]


def discharges_finding(result: AxleResult) -> str:
    """Sentence about the element with the most discharges."""
    assert result.discharges is not None
    rows = result.discharges.summary()["elements"]
    most = max(rows, key=lambda row: float(row["events_per_second"]), default=None)
    if most is None or not most["events"]:
        return "No discharge in the simulated time"
    energy = readable(1e9 * most["energy_mean"], 2)
    return f"{most['element']}: {readable(most['events_per_second'], 2)} discharges/s, {energy} nJ on average"
