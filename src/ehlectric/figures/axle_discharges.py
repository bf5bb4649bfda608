"""Figure of the discharges of an axle: voltages of all shafts over a short time, with marks by element."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ehlectric.axle import AxleDischarges, AxleResult
from ehlectric.cases.axle_inputs import HOUSING
from ehlectric.errors import printable
from ehlectric.figures.category_maps import colours_of_names
from ehlectric.figures.style import legend_above, new_panels
from ehlectric.quantities.palette import BLACK
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

_SIZE, _HEIGHT = 8.0, 1.5


def axle_discharges(result: AxleResult) -> Axes:
    """Draw the voltages of the source and of all shafts over a short time.

    A mark is a discharge, at the voltage of the shaft of the element when it begins.
    """
    discharges = result.discharges
    assert discharges is not None
    times, source, shafts = discharges.trace
    factor, unit = unit_for(float(times[-1] - times[0]), "s", least=1.0)
    since = factor * (times - times[0])
    axes = new_panels(1 + len(shafts), 1, (_SIZE, 1.2 + _HEIGHT * (1 + len(shafts))))
    axes[0].plot(since, source, color=BLACK, lw=0.9)
    axes[0].set_ylabel("source [V]")
    marks = _marks(result, discharges)
    names = [*dict.fromkeys(name for name, *_ in marks)]
    colours = dict(zip(names, colours_of_names(names), strict=True))
    for ax, (shaft, volts) in zip(axes[1:], shafts.items(), strict=True):
        ax.plot(since, volts, color=BLACK, lw=0.9)
        for name, of_shaft, time in marks:
            if of_shaft == shaft:
                value = volts[max(int(np.searchsorted(times, time, side="right")) - 1, 0)]
                ax.plot(
                    factor * (time - times[0]), value, "o", ms=4.5, color=colours[name], mec=BLACK, mew=0.4
                )
        ax.set_ylabel(f"{printable(shaft)} [V]")
    for ax in axes:
        ax.set_xlim(since[0], since[-1])
        ax.tick_params(labelbottom=ax is axes[-1])
    axes[-1].set_xlabel(f"time [{unit}]")
    handles = [
        Line2D([], [], ls="none", marker="o", mec=BLACK, mew=0.4, color=colours[name], label=printable(name))
        for name in names
    ]
    if handles:
        legend_above(axes[0], handles, columns=2)
    return axes[0]


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
