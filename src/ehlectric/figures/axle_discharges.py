"""Figure of the discharges of an axle: voltages of all shafts over a short time, with marks by element."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ehlectric.axle import AxleDischarges, AxleResult
from ehlectric.cases.axle_inputs import HOUSING
from ehlectric.errors import printable
from ehlectric.figures.category_maps import colours_of_names
from ehlectric.figures.data import Along, Curve, Panel
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.style import legend_above, new_panels
from ehlectric.quantities.palette import BLACK, MIDDLE_GREY
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

_SIZE, _HEIGHT = 8.0, 1.5

# Part of the largest voltage to which the axis of a panel extends.
_ROOM = 1.1


def axle_discharges(result: AxleResult) -> Axes:
    """Draw the voltages of the source and of all shafts over a short time.

    A mark is a discharge, at the voltage of the shaft of the element when it begins.
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

    Marks of one element have one colour and, in the first panel with them, a name.
    """
    discharges = result.discharges
    assert discharges is not None
    times, source, shafts = discharges.trace
    factor, unit = unit_for(float(times[-1] - times[0]), "s", least=1.0)
    since = factor * (times - times[0])
    panels = [_panel("source", [Curve("source", since, source, MIDDLE_GREY, width=0.9)])]
    marks = _marks(result, discharges)
    names = [*dict.fromkeys(name for name, *_ in marks)]
    colours = dict(zip(names, colours_of_names(names), strict=True))
    named = set[str]()
    for shaft, volts in shafts.items():
        curves = [Curve(printable(shaft), since, volts, BLACK, width=0.9)]
        for name in names:
            begins = np.array([time for other, at, time in marks if (other, at) == (name, shaft)])
            if begins.size:
                places = np.maximum(np.searchsorted(times, begins, side="right") - 1, 0)
                label = "" if name in named else printable(name)
                at = factor * (begins - times[0])
                curves.append(Curve(label, at, volts[places], colours[name], marker="circle"))
                named.add(name)
        panels.append(_panel(printable(shaft), curves))
    return Along("time", unit, (float(since[0]), float(since[-1]))), panels


def _panel(title: str, curves: list[Curve]) -> Panel:
    top = _ROOM * float(np.max(np.abs(curves[0].y), initial=0.0)) or 1.0
    return Panel(title, "V", curves, top, -top)


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
