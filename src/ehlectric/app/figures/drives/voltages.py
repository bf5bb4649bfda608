"""Figures of the voltages of a drive: over a short time with its discharges, and how long which last."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ehlectric.app.answers.bearing import Figure, Table
from ehlectric.app.figures.look import Plot, axis, plot, values
from ehlectric.app.figures.stack import stack
from ehlectric.arrays import Array
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive import findings
from ehlectric.figures.drive.looks import COLOURS, NAMES, breakdown_of, voltage_unit
from ehlectric.figures.drive.voltage_panels import bearing_panel, shown_discharges, source_panel, time_axis
from ehlectric.quantities.palette import MIDDLE_GREY

# Largest number of discharges of a bearing in the table.
_LISTED = 400

# Least share of time that is drawn, over the largest one.
_LEAST = 1e-6

_HEIGHT = 380


def voltages_figure(result: DriveResult) -> Figure:
    """Common-mode voltage and both bearing voltages over two periods of the carrier, with discharges."""
    along = time_axis(result)
    panels = [source_panel(result), *(bearing_panel(result, b) for b in range(2))]
    rows = [
        (name, f"{at:.4g}", f"{volts:.3g}")
        for b, name in enumerate(NAMES)
        for at, volts in list(zip(*shown_discharges(result, b), strict=True))[:_LISTED]
    ]
    found = findings.voltages(result)
    return Figure(
        "Voltages over two periods of the carrier",
        f"Common-mode voltage and voltages across the films of both bearings over time. {found}.",
        stack(along, panels, showlegend=False),
        Table("Discharges of this time", ("bearing", f"time [{along.unit}]", "voltage [V]"), tuple(rows)),
        "Circles mark discharges. Dashed: breakdown voltage of the weakest position, where it is near.",
    )


def histogram_figure(result: DriveResult) -> Figure:
    """Share of time at the voltages across the films of both bearings."""
    record = result.solution.record
    most = 1.05 * float(np.max(record.peak))
    factor, unit = voltage_unit(most)
    middle = 0.5 * (record.edges[1:] + record.edges[:-1])
    width = float(record.edges[1] - record.edges[0])
    # Voltages beyond the largest one have no share, and need not be sent.
    inside = np.abs(middle) <= max(most, 3.0 * width) + width
    shares = 100.0 * record.histogram[:, inside] / record.duration
    top = float(np.max(shares, initial=1e-12))
    data = [_steps(factor * middle[inside], share, b, unit) for b, share in enumerate(shares)]
    positive = shares[shares > 0.0]
    least = max(0.5 * float(np.min(positive, initial=top)), _LEAST * top)
    layout: dict[str, Any] = {
        "xaxis": axis(f"voltage across the films [{unit}]", range=[-factor * most, factor * most]),
        "yaxis": axis(
            f"share of time per {factor * width:.3g} {unit} [%]",
            type="log",
            range=[math.log10(min(least, 0.01 * top)), math.log10(2.0 * top)],
            exponentformat="power",
        ),
        "shapes": _thresholds(result, factor, most),
        "hovermode": "x",
    }
    rows = [
        (f"{limit:g}", *(f"{100.0 * time / record.duration:.3g}" for time in column))
        for limit, column in zip(record.limits, record.above.T, strict=True)
    ]
    heads = ("above [V]", *(f"{name} [% of time]" for name in NAMES))
    return Figure(
        "How long which voltages last",
        f"Share of time at the voltages across the films. {findings.histogram(result)}.",
        plot(data, height=_HEIGHT, **layout),
        Table("Share of time above a voltage of either sign", heads, tuple(rows)),
        "Dashed: breakdown voltages of the weakest position, where they are near.",
    )


def _steps(at: Array, share: Array, b: int, unit: str) -> Plot:
    """Steps of a histogram; a logarithmic axis leaves out what has no share."""
    known = np.where(share > 0.0, share, np.nan)
    return {
        "type": "scatter",
        "mode": "lines",
        "x": values(at, 5),
        "y": values(known, 4),
        "name": NAMES[b],
        "line": {"color": COLOURS[b], "width": 2.0, "shape": "hvh", "dash": ("solid", "dash")[b]},
        "hovertemplate": f"%{{y:.3g}} % at %{{x:.4g}} {unit}<extra>{NAMES[b]}</extra>",
    }


def _thresholds(result: DriveResult, factor: float, most: float) -> list[Plot]:
    line = {"color": MIDDLE_GREY, "width": 1.5, "dash": "dash"}
    near = sorted({breakdown_of(result, b) for b in range(2)})
    return [
        {"type": "line", "x0": at, "x1": at, "yref": "paper", "y0": 0.0, "y1": 1.0, "line": line}
        for volts in near
        if volts <= most
        for at in (factor * volts, -factor * volts)
    ]
