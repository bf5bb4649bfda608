"""Figures of a drive for a page: voltages over time and how long they last, discharges, spectrum and
remedies.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ehlectric.app.answers import Figure, Table
from ehlectric.app.figures.charts import Plot, axis, plot, stack, values
from ehlectric.arrays import Array
from ehlectric.drive.result import DriveResult
from ehlectric.drive.summary import end_summary
from ehlectric.figures import drive_figures as drive_findings
from ehlectric.figures.drive_figures import (
    COLOURS,
    NAMES,
    QUANTITIES,
    bearing_panel,
    bins_of,
    breakdown_of,
    events_of,
    has_spectrum,
    highest_lines,
    number_of_events,
    shown_discharges,
    shown_range,
    source_panel,
    time_axis,
    variants,
    voltage_unit,
)
from ehlectric.quantities.formats import formatted, number_text
from ehlectric.quantities.palette import BLUE, MIDDLE_GREY, faint
from ehlectric.quantities.results import EVENT_KEYS, STATISTICS
from ehlectric.quantities.units import unit_for

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
    found = drive_findings.voltages(result)
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
        f"Share of time at the voltages across the films. {drive_findings.histogram(result)}.",
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


_SPECTRUM_HEIGHT = 380

# Lines of the table, the largest ones.
_TOLD = 12


def spectrum_figure(result: DriveResult) -> Figure:
    """Amplitude spectrum of the shaft voltage, with both axes logarithmic."""
    frequencies, amplitudes = highest_lines(result)
    factor, unit = voltage_unit(float(np.max(amplitudes)))
    curve = {
        "type": "scatter",
        "mode": "lines",
        "x": values(frequencies, 6),
        "y": values(factor * amplitudes, 4),
        "name": "shaft voltage",
        "line": {"color": BLUE, "width": 1.5},
        "hovertemplate": f"%{{y:.3g}} {unit} at %{{x:.5g}} Hz<extra></extra>",
    }
    shown = [math.log10(factor * end) for end in shown_range(amplitudes)]
    figure = plot(
        [curve],
        height=_SPECTRUM_HEIGHT,
        xaxis=axis("frequency [Hz]", type="log", exponentformat="SI"),
        yaxis=axis(
            f"amplitude of the shaft voltage [{unit}]",
            type="log",
            exponentformat="power",
            dtick=1,
            range=shown,
        ),
    )
    largest = np.argsort(-amplitudes, kind="stable")[:_TOLD]
    rows = tuple((f"{frequencies[k]:.6g}", f"{factor * amplitudes[k]:.4g}") for k in largest)
    return Figure(
        "Spectrum of the shaft voltage",
        f"Amplitude of the shaft voltage over the frequency. {drive_findings.spectrum(result)}.",
        figure,
        Table("Largest lines", ("frequency [Hz]", f"amplitude [{unit}]"), rows),
        f"{drive_findings.spectrum(result)}. Amplitudes are peak values, without a window.",
    )


# Quantities of a discharge by the names of their figures.
_FIGURES = {
    "discharge-voltage": "voltage",
    "discharge-energy": "energy",
    "discharge-charge": "charge",
    "discharge-current": "peak_current",
}

_DISCHARGES_HEIGHT = 300


def distributions(result: DriveResult) -> dict[str, Figure]:
    """Figures of the discharges by their names; none without a discharge."""
    if not len(result.solution.record.events):
        return {}
    return {name: _distribution(result, key) for name, key in _FIGURES.items()}


def _distribution(result: DriveResult, key: str) -> Figure:
    about, column = EVENT_KEYS[key], dict(QUANTITIES)[key]
    words = f"{about.label[:1].upper()}{about.label[1:]}"
    own = [np.abs(events_of(result, b)[:, column]) for b in range(2)]
    edges, log = bins_of(np.concatenate(own))
    factor, prefixed = unit_for(float(edges[-1]), about.unit, least=1.0)
    data = [_bars(factor * edges, part, factor, b, prefixed) for b, part in enumerate(own) if part.size]
    title = f"{about.label} [{prefixed}]"
    layout: dict[str, Any] = {
        "xaxis": axis(title, **(_decades() if log else {"range": [factor * edges[0], factor * edges[-1]]})),
        "yaxis": axis("discharges [%]", rangemode="tozero"),
        "hovermode": "x",
    }
    ends = [end_summary(result.solution, b) for b in range(2)]
    rows = [
        (name, *(_cell(end, f"{key}_{short}", factor, about.digits) for end in ends))
        for short, name in STATISTICS.items()
    ]
    caption = ", ".join(f"{NAMES[b]}: {number_of_events(result, b)} discharges" for b in range(2))
    lead = caption
    if key in ("energy", "charge", "peak_current"):
        line = drive_findings.arc_line(result)
        caption = f"{caption}. {line[:1].upper()}{line[1:]}."
    heads = ("", *(f"{name} [{prefixed}]" for name in NAMES))
    return Figure(
        words,
        f"Distribution of the {about.label}; {lead}",
        plot(data, height=_DISCHARGES_HEIGHT, **layout),
        Table(words, heads, tuple(rows)),
        caption,
    )


def _cell(end: Mapping[str, Any], key: str, factor: float, digits: str) -> str:
    return formatted(factor * end[key], digits) if end["events"] else "none"


def _decades() -> Plot:
    ticks = [digit * 10.0**power for power in range(-6, 10) for digit in (1.0, 2.0, 5.0)]
    text = [f"{tick:.12g}" for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": text}


def _bars(edges: Array, own: Array, factor: float, b: int, unit: str) -> Plot:
    """Share of the discharges in each bin, as steps."""
    counts, _ = np.histogram(np.clip(factor * own, edges[0], edges[-1]), edges)
    share = np.append(100.0 * counts / own.size, 0.0)
    fill = {"fill": "tozeroy", "fillcolor": faint(BLUE, 0.25)} if b == 0 else {}
    return {
        "type": "scatter",
        "mode": "lines",
        "x": values(edges, 5),
        "y": values(share, 4),
        "name": NAMES[b],
        "line": {"color": COLOURS[b], "width": 2.0, "shape": "hv", "dash": ("solid", "dash")[b]},
        "hovertemplate": f"%{{y:.3g}} % from %{{x:.4g}} {unit}<extra>{NAMES[b]}</extra>",
        **fill,
    }


# Height of a row, and of what surrounds the rows [px]; letters on a line of a name.
_ROW, _REST, _LETTERS = 62, 110, 16

# Distance of both bearings from the middle of their row.
_BESIDE = 0.14

# Ends at which a name is cut.
_MOST_LINES = 3


def remedies_figure(result: DriveResult) -> Figure:
    """Discharges per second of the drive as it is and with each remedy."""
    rows = list(variants(result))
    names = [_broken(name) for name, _ in rows]
    ends = [end for _, pair in rows for end in pair]
    known = [end[f"events_per_second{bound}"] for end in ends for bound in ("", "_low", "_high")]
    positive = [value for value in known if value > 0.0]
    low, high = 0.5 * min(positive), 2.0 * max(positive)
    data = [trace for b in range(2) for trace in _traces(rows, b)]
    layout: dict[str, Any] = {
        "xaxis": axis(
            "discharges per second",
            type="log",
            range=[math.log10(low), math.log10(high)],
            dtick=1,
            exponentformat="power",
        ),
        "yaxis": axis(
            tickmode="array",
            tickvals=list(range(len(names))),
            ticktext=names,
            range=[len(names) - 0.5, -0.5],
            ticks="",
        ),
        "hovermode": "closest",
    }
    table = Table(
        "Discharges per second with bounds of 95 %",
        ("", *(f"{name} [1/s]" for name in NAMES)),
        tuple((name, *(_remedies_cell(end) for end in pair)) for name, pair in rows),
    )
    found = drive_findings.remedies(result)
    caption = f"{found}. Bars are bounds of 95 %; an open triangle is an upper bound without any discharge."
    return Figure(
        "Remedies side by side",
        f"Discharges per second of the drive as it is and with each remedy. {found}.",
        plot(data, height=_REST + _ROW * len(rows), **layout),
        table,
        caption,
    )


def _traces(rows: Sequence[tuple[str, Sequence[Mapping[str, Any]]]], b: int) -> list[Plot]:
    """Rates of one bearing with their bounds, and upper bounds where nothing discharged."""
    own = [(row, name, pair[b]) for row, (name, pair) in enumerate(rows)]
    with_events = [one for one in own if one[2]["events"]]
    without = [one for one in own if not one[2]["events"]]
    found = []
    if with_events:
        rates = [end["events_per_second"] for _, _, end in with_events]
        bars = {
            "type": "data",
            "symmetric": False,
            "array": [end["events_per_second_high"] - end["events_per_second"] for _, _, end in with_events],
            "arrayminus": [
                end["events_per_second"] - end["events_per_second_low"] for _, _, end in with_events
            ],
        }
        marker = {"symbol": ("circle", "square")[b], "size": 9}
        found.append(_trace(with_events, rates, b, marker) | {"error_x": bars})
    if without:
        highest = [end["events_per_second_high"] for _, _, end in without]
        marker = {"symbol": "triangle-left-open", "size": 10}
        found.append(_trace(without, highest, b, marker) | {"showlegend": not with_events})
    return found


def _trace(
    own: Sequence[tuple[int, str, Mapping[str, Any]]], rates: Sequence[float], b: int, marker: Plot
) -> Plot:
    return {
        "type": "scatter",
        "mode": "markers",
        "x": list(rates),
        "y": [row + (_BESIDE if b else -_BESIDE) for row, _, _ in own],
        "name": NAMES[b],
        "marker": {"color": COLOURS[b], **marker},
        "text": [f"{name}, {NAMES[b]}: {_remedies_cell(end)} per second" for _, name, end in own],
        "hovertemplate": "%{text}<extra></extra>",
    }


def _remedies_cell(end: Mapping[str, Any]) -> str:
    high = number_text(end["events_per_second_high"])
    if not end["events"]:
        return f"none, at most {high}"
    low = number_text(end["events_per_second_low"])
    return f"{number_text(end['events_per_second'])} ({low} to {high})"


def _broken(name: str) -> str:
    """Name on few short lines; texts of Plotly take some marks of HTML, which a title must not make."""
    plain = name.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return "<br>".join(textwrap.wrap(plain, _LETTERS, max_lines=_MOST_LINES, placeholder=" ..."))


def drive_figures(result: DriveResult) -> dict[str, Figure]:
    """Figures of a simulated drive; those with nothing to show are left out."""
    found = {}
    if len(result.solution.record.trace) > 1:
        found["voltages"] = voltages_figure(result)
    if result.remedies:
        found["remedies"] = remedies_figure(result)
    found["histogram"] = histogram_figure(result)
    if has_spectrum(result):
        found["spectrum"] = spectrum_figure(result)
    return {**found, **distributions(result)}
