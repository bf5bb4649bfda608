"""Figures of the voltages of a drive: over a short time with its discharges, and how long which last."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ehlectric.app.answers.bearing import Figure, Table
from ehlectric.app.figures.look import BLUE, GREY, ORANGE, Plot, axis, plot, thinned, values
from ehlectric.app.figures.stack import Along, Curve, Panel, stack
from ehlectric.arrays import Array
from ehlectric.drive.discharges.record import ON, VOLTAGE
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive import findings
from ehlectric.figures.drive.looks import NAMES, breakdown_of, events_of, voltage_unit
from ehlectric.quantities.units import unit_for

COLOURS = (BLUE, ORANGE)

# Pieces of a curve over time, each drawn by its lowest and its highest point, and marked discharges.
_PIECES, _MARKED = 1500, 400

# Breakdown voltage over the largest voltage of a panel up to which it is drawn, and room around the curves.
_NEAR, _ROOM = 1.8, 1.12

# Least share of time that is drawn, over the largest one.
_LEAST = 1e-6

_HEIGHT = 380


def voltages_figure(result: DriveResult) -> Figure:
    """Common-mode voltage and both bearing voltages over two periods of the carrier, with discharges."""
    trace = result.solution.record.trace
    begin, end = float(trace[0, 0]), float(trace[-1, 0])
    begin = max(begin, 0.0)
    scale, unit = unit_for(end - begin, "s", least=1.0)
    kept = thinned([trace[:, column] for column in (1, 2, 3)], _PIECES)
    time = scale * (trace[kept, 0] - begin)
    span = scale * (end - begin)
    factor, volts = voltage_unit(float(np.max(np.abs(trace[:, 1]), initial=0.0)))
    source = Curve("common mode", time, factor * trace[kept, 1], GREY)
    most = _ROOM * float(np.max(np.abs(source.y), initial=1e-9))
    panels, marks, rows = [Panel("common mode", volts, [source], most, -most)], [], []
    for b, name in enumerate(NAMES):
        panel, here = _bearing(result, b, (begin, end), time, trace[kept, 2 + b])
        panels.append(panel)
        factor, volts = _unit_of(result, b, here)
        marks.append(_marks(scale * (here[:, ON] - begin), factor * here[:, VOLTAGE], volts, b))
        rows += [(name, f"{scale * (one[ON] - begin):.4g}", f"{one[VOLTAGE]:.3g}") for one in here[:_MARKED]]
    after = "" if begin < 1e-9 else f" after {1e3 * begin:.4g} ms"
    figure = stack(Along(f"time{after}", unit, (0.0, span)), panels)
    figure["data"] += marks
    figure["layout"]["showlegend"] = False
    found = findings.voltages(result)
    return Figure(
        "Voltages over two periods of the carrier",
        f"Common-mode voltage and voltages across the films of both bearings over time. {found}.",
        figure,
        Table("Discharges of this time", ("bearing", f"time [{unit}]", "voltage [V]"), tuple(rows)),
        "Circles mark discharges. Dashed: breakdown voltage of the weakest position, where it is near.",
    )


def _bearing(
    result: DriveResult, b: int, ends: tuple[float, float], time: Array, volts: Array
) -> tuple[Panel, Array]:
    """Panel of the voltage across the films of one bearing, and its discharges in this time."""
    own = events_of(result, b)
    here = own[(own[:, ON] >= ends[0]) & (own[:, ON] <= ends[1])][:_MARKED]
    factor, unit = _unit_of(result, b, here)
    largest = factor * max(float(np.max(np.abs(part), initial=1e-12)) for part in (volts, here[:, VOLTAGE]))
    curves, breakdown = [Curve(NAMES[b], time, factor * volts, COLOURS[b])], factor * breakdown_of(result, b)
    if breakdown <= _NEAR * largest:
        at = np.array([0.0, time[-1]])
        curves += [
            Curve("breakdown, weakest", at, np.full(2, sign * breakdown), GREY, dash="dash", width=1.5)
            for sign in (1.0, -1.0)
        ]
        largest = max(largest, breakdown)
    return Panel(NAMES[b], unit, curves, _ROOM * largest, -_ROOM * largest), here


def _unit_of(result: DriveResult, b: int, here: Array) -> tuple[float, str]:
    trace = result.solution.record.trace[:, 2 + b]
    return voltage_unit(max(float(np.max(np.abs(part), initial=0.0)) for part in (trace, here[:, VOLTAGE])))


def _marks(time: Array, volts: Array, unit: str, b: int) -> Plot:
    return {
        "type": "scatter",
        "mode": "markers",
        "x": values(time),
        "y": values(volts),
        "yaxis": ("y2", "y3")[b],
        "name": "discharge",
        "marker": {"color": "rgba(0,0,0,0)", "size": 9, "line": {"color": COLOURS[b], "width": 2}},
        "hovertemplate": f"discharge at %{{y:.4g}} {unit}<extra></extra>",
    }


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
    line = {"color": GREY, "width": 1.5, "dash": "dash"}
    near = sorted({breakdown_of(result, b) for b in range(2)})
    return [
        {"type": "line", "x0": at, "x1": at, "yref": "paper", "y0": 0.0, "y1": 1.0, "line": line}
        for volts in near
        if volts <= most
        for at in (factor * volts, -factor * volts)
    ]
