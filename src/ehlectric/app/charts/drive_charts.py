"""Figures of a drive for a page: voltages over time and how long they last, discharges, spectrum and
remedies.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

import numpy as np

from ehlectric.app.charts.duty_charts import cycle_plot
from ehlectric.app.charts.plotly_panels import Plot, axis, log_ticks, plot, scatter, stack, vertical
from ehlectric.app.view_models import Figure, Table
from ehlectric.arrays import Array
from ehlectric.drive import DriveDuty, DriveResult, end_summary
from ehlectric.figures import drive_figures as findings
from ehlectric.figures.drive_figures import (
    COLOURS,
    NAMES,
    QUANTITIES,
    RATES,
    bins_of,
    breakdown_of,
    events_of,
    has_spectrum,
    highest_lines,
    number_of_events,
    shown_discharges,
    shown_range,
    time_axis,
    variants,
    voltage_unit,
)
from ehlectric.figures.duty_panels import drive_duty_panels
from ehlectric.figures.duty_panels import time_axis as time_axis_of_cycle
from ehlectric.quantities.formats import rpm_text
from ehlectric.quantities.palette import BLUE, MIDDLE_GREY, faint
from ehlectric.quantities.results import EVENT_KEYS, STATISTICS
from ehlectric.quantities.units import unit_for
from ehlectric.readable import formatted, readable

# Largest number of discharges of a bearing in the table.
_LISTED = 400

# Least share of time that is drawn, over the largest one.
_LEAST = 1e-6

# Heights of figures, of those of discharges, of a row of the remedies, and of what surrounds the rows [px].
_HEIGHT, _DISCHARGES_HEIGHT, _ROW, _REST = 380, 300, 62, 110

# Number of the largest lines of the spectrum in its table.
_LINES = 12

# Quantities of a discharge by the names of their figures.
_FIGURES = {
    "discharge-voltage": "voltage",
    "discharge-energy": "energy",
    "discharge-charge": "charge",
    "discharge-current": "peak_current",
}

# Letters on a line of the name of a remedy, and lines after which it is cut.
_LETTERS, _MOST_LINES = 16, 3

# Distances of both bearings, and of their sum, from the middle of their row; and their marks.
_OFFSETS, _SYMBOLS = (-0.22, 0.22, 0.0), ("circle", "square", "diamond")


def drive_figures(result: DriveResult) -> dict[str, Figure]:
    """Figures of a simulated drive; those with nothing to show are left out."""
    figures = {}
    if len(result.solution.record.trace) > 1:
        figures["voltages"] = voltages_figure(result)
    if result.remedies:
        figures["remedies"] = remedies_figure(result)
    if result.duty is not None:
        figures["duty"] = cycle_figure(result, result.duty)
    figures["histogram"] = histogram_figure(result)
    if has_spectrum(result):
        figures["spectrum"] = spectrum_figure(result)
    if len(result.solution.record.events):
        figures |= {name: _distribution(result, key) for name, key in _FIGURES.items()}
    return figures


def voltages_figure(result: DriveResult) -> Figure:
    """Common-mode voltage and both bearing voltages over two periods of the carrier, with discharges."""
    along = time_axis(result)

    rows = [
        (name, readable(at, 4), readable(volts))
        for b, name in enumerate(NAMES)
        for at, volts in list(zip(*shown_discharges(result, b), strict=True))[:_LISTED]
    ]
    finding = findings.voltages(result)
    return Figure(
        "Voltages over two periods of the carrier",
        f"Common-mode voltage and voltages across the films of both bearings over time. {finding}.",
        stack(along, findings.voltage_panels(result), showlegend=False),
        Table("Discharges of this time", ("bearing", f"time [{along.unit}]", "voltage [V]"), tuple(rows)),
        "Circles mark discharges. Dashed: breakdown voltage of the weakest position, where it is near.",
    )


def cycle_figure(result: DriveResult, duty: DriveDuty) -> Figure:
    """Speed, lambda ratios and expected discharges per second over the duty cycle."""
    heads = ("begin [s]", "end [s]", "discharges", "energy [mJ]", "mean speed [rpm]", "least λ")
    rows = tuple(
        (
            *(readable(value, 6) for value in (stretch.start, stretch.end)),
            *(readable(value) for value in (stretch.discharges, 1e3 * stretch.energy)),
            rpm_text(stretch.speed),
            readable(stretch.lambda_ratio),
        )
        for stretch in duty.stretches
    )
    return Figure(
        "Discharges over the duty cycle",
        f"Speed, lambda ratio and discharges per second over the time. {findings.duty_cycle(result)}.",
        cycle_plot(time_axis_of_cycle(duty.rows), drive_duty_panels(duty)),
        Table("Worst stretches, that with the most discharges first", heads, rows),
        f"{findings.duty_cycle(result)}. {duty.points} rows are simulated, the others interpolated.",
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
    # A logarithmic axis leaves out what has no share.
    known = np.where(shares > 0.0, shares, np.nan)
    data = [_steps(factor * middle[inside], known[b], b, f"at %{{x:,.4~r}} {unit}") for b in range(2)]
    positive = shares[shares > 0.0]
    least = max(0.5 * float(np.min(positive, initial=top)), _LEAST * top)
    near = sorted({volts for b in range(2) if (volts := breakdown_of(result, b)) <= most})
    threshold = {"color": MIDDLE_GREY, "width": 1.5, "dash": "dash"}
    rows = [
        (f"{limit:g}", *(readable(100.0 * time / record.duration) for time in column))
        for limit, column in zip(record.limits, record.above.T, strict=True)
    ]
    heads = ("above [V]", *(f"{name} [% of time]" for name in NAMES))
    return Figure(
        "How long which voltages last",
        f"Share of time at the voltages across the films. {findings.histogram(result)}.",
        plot(
            data,
            height=_HEIGHT,
            xaxis=axis(f"voltage across the films [{unit}]", range=[-factor * most, factor * most]),
            yaxis=_log_axis(
                f"share of time per {readable(factor * width)} {unit} [%]",
                (min(least, 0.01 * top), 2.0 * top),
            ),
            shapes=[vertical(sign * factor * volts, line=threshold) for volts in near for sign in (1, -1)],
            hovermode="x",
        ),
        Table("Share of time above a voltage of either sign", heads, tuple(rows)),
        "Dashed: breakdown voltages of the weakest position, where they are near.",
    )


def _log_axis(title: str, ends: tuple[float, float], **more: Any) -> Plot:
    """Logarithmic axis with powers of ten."""
    limits = [math.log10(end) for end in ends]
    return axis(title, type="log", range=limits, exponentformat="power", **more)


def _steps(at: Array, share: Array, b: int, where: str, *, shape: str = "hvh", **more: Any) -> Plot:
    """Shares [%] of one bearing as steps; ``where`` is the text of a position at the pointer."""
    return scatter(
        at,
        share,
        digits=(5, 4),
        hover=f"%{{y:,.3~r}} % {where}",
        label=NAMES[b],
        name=NAMES[b],
        line={"color": COLOURS[b], "width": 2.0, "shape": shape, "dash": ("solid", "dash")[b]},
        **more,
    )


def spectrum_figure(result: DriveResult) -> Figure:
    """Amplitude spectrum of the shaft voltage, with both axes logarithmic."""
    frequencies, amplitudes = highest_lines(result)
    factor, unit = voltage_unit(float(np.max(amplitudes)))
    finding = findings.spectrum(result)
    curve = scatter(
        frequencies,
        factor * amplitudes,
        digits=(6, 4),
        hover=f"%{{y:,.3~r}} {unit} at %{{x:,.5~r}} Hz",
        name="shaft voltage",
        line={"color": BLUE, "width": 1.5},
    )
    low, high = shown_range(amplitudes)
    figure = plot(
        [curve],
        height=_HEIGHT,
        xaxis=axis("frequency [Hz]", type="log", exponentformat="SI"),
        yaxis=_log_axis(f"amplitude of the shaft voltage [{unit}]", (factor * low, factor * high), dtick=1),
    )
    largest = np.argsort(-amplitudes, kind="stable")[:_LINES]
    rows = tuple((readable(frequencies[k], 6), readable(factor * amplitudes[k], 4)) for k in largest)
    return Figure(
        "Spectrum of the shaft voltage",
        f"Amplitude of the shaft voltage over the frequency. {finding}.",
        figure,
        Table("Largest lines", ("frequency [Hz]", f"amplitude [{unit}]"), rows),
        f"{finding}. Amplitudes are peak values, without a window.",
    )


def _distribution(result: DriveResult, key: str) -> Figure:
    about, column = EVENT_KEYS[key], dict(QUANTITIES)[key]
    words = f"{about.label[:1].upper()}{about.label[1:]}"
    values = [np.abs(events_of(result, b)[:, column]) for b in range(2)]
    edges, log = bins_of(np.concatenate(values))
    factor, prefixed = unit_for(float(edges[-1]), about.unit, least=1.0)
    edges = factor * edges
    data = [_bars(edges, factor * part, b, prefixed) for b, part in enumerate(values) if part.size]
    ends_of_axis = log_ticks(log=True) if log else {"range": [edges[0], edges[-1]]}
    ends = [end_summary(result.solution, b) for b in range(2)]
    rows = [
        (name, *(_cell(end, f"{key}_{short}", factor, about.digits) for end in ends))
        for short, name in STATISTICS.items()
    ]
    caption = ", ".join(f"{NAMES[b]}: {number_of_events(result, b)} discharges" for b in range(2))
    lead = caption
    if key in ("energy", "charge", "peak_current"):
        line = findings.arc_line(result)
        caption = f"{caption}. {line[:1].upper()}{line[1:]}."
    heads = ("", *(f"{name} [{prefixed}]" for name in NAMES))
    return Figure(
        words,
        f"Distribution of the {about.label}; {lead}",
        plot(
            data,
            height=_DISCHARGES_HEIGHT,
            xaxis=axis(f"{about.label} [{prefixed}]", **ends_of_axis),
            yaxis=axis("discharges [%]", rangemode="tozero"),
            hovermode="x",
        ),
        Table(words, heads, tuple(rows)),
        caption,
    )


def _cell(end: Mapping[str, Any], key: str, factor: float, digits: str) -> str:
    return formatted(factor * end[key], digits) if end["events"] else "none"


def _bars(edges: Array, values: Array, b: int, unit: str) -> Plot:
    """Share of the discharges in each bin, as steps."""
    counts, _ = np.histogram(np.clip(values, edges[0], edges[-1]), edges)
    share = np.append(100.0 * counts / values.size, 0.0)
    fill = {"fill": "tozeroy", "fillcolor": faint(BLUE, 0.25)} if b == 0 else {}
    return _steps(edges, share, b, f"from %{{x:,.4~r}} {unit}", shape="hv", **fill)


def remedies_figure(result: DriveResult) -> Figure:
    """Discharges per second of the drive as it is and with each remedy."""
    rows = list(variants(result))
    names = [_broken(name) for name, _ in rows]
    ends = [end for _, pair in rows for end in pair]
    known = [end[f"events_per_second{bound}"] for end in ends for bound in ("", "_low", "_high")]
    positive = [value for value in known if value > 0.0]
    data = [trace for b in range(len(RATES)) for trace in _traces(rows, b)]
    finding = findings.remedies(result)
    return Figure(
        "Remedies side by side",
        f"Discharges per second of the drive as it is and with each remedy. {finding}.",
        plot(
            data,
            height=_REST + _ROW * len(rows),
            xaxis=_log_axis("discharges per second", (0.5 * min(positive), 2.0 * max(positive)), dtick=1),
            yaxis=axis(
                tickmode="array",
                tickvals=list(range(len(names))),
                ticktext=names,
                range=[len(names) - 0.5, -0.5],
                ticks="",
            ),
            hovermode="closest",
        ),
        Table(
            "Discharges per second with bounds of 95 %",
            ("", *(f"{name} [1/s]" for _, _, name in RATES)),
            tuple((name, *map(_rate_with_bounds, pair)) for name, pair in rows),
        ),
        f"{finding}. Bars are bounds of 95 %; an open triangle is an upper bound without any discharge.",
    )


def _traces(rows: Sequence[tuple[str, Sequence[Mapping[str, Any]]]], b: int) -> list[Plot]:
    """Rates of one bearing, or of both, with their bounds, and upper bounds where nothing discharged."""
    known = [(row, name, pair[b]) for row, (name, pair) in enumerate(rows) if pair[b]["events"]]
    without = [(row, name, pair[b]) for row, (name, pair) in enumerate(rows) if not pair[b]["events"]]
    traces = []
    if known:
        rate, low, high = (
            np.array([end[f"events_per_second{bound}"] for _, _, end in known])
            for bound in ("", "_low", "_high")
        )
        bars = {"type": "data", "symmetric": False}
        bars |= {"array": (high - rate).tolist(), "arrayminus": (rate - low).tolist()}
        marker = {"symbol": _SYMBOLS[b], "size": 9}
        traces.append(_marks(known, "events_per_second", b, marker) | {"error_x": bars})
    if without:
        marker = {"symbol": "triangle-left-open", "size": 10}
        marks = _marks(without, "events_per_second_high", b, marker)
        traces.append(marks | {"showlegend": not known})
    return traces


def _marks(rows: Sequence[tuple[int, str, Mapping[str, Any]]], key: str, b: int, marker: Plot) -> Plot:
    """Marks of a rate [1/s] of one bearing, or of both, in the rows of the drive and its remedies."""
    colour, _, place = RATES[b]
    return {
        "type": "scatter",
        "mode": "markers",
        "x": [end[key] for _, _, end in rows],
        "y": [row + _OFFSETS[b] for row, _, _ in rows],
        "name": place,
        "marker": {"color": colour, **marker},
        "text": [f"{name}, {place}: {_rate_with_bounds(end)} per second" for _, name, end in rows],
        "hovertemplate": "%{text}<extra></extra>",
    }


def _rate_with_bounds(end: Mapping[str, Any]) -> str:
    high = readable(end["events_per_second_high"])
    if not end["events"]:
        return f"none, at most {high}"
    low = readable(end["events_per_second_low"])
    return f"{readable(end['events_per_second'])} ({low} to {high})"


def _broken(name: str) -> str:
    """Name on few short lines; texts of Plotly take some marks of HTML, which a title must not make."""
    plain = escape(name, quote=False)
    return "<br>".join(textwrap.wrap(plain, _LETTERS, max_lines=_MOST_LINES, placeholder=" ..."))
