"""Figures of a drive for a page: voltages over time and how long they last, discharges, spectrum and
remedies.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.app.charts.duty_charts import cycle_plot
from ehlectric.app.charts.plotly_panels import Plot, stack
from ehlectric.app.view_models import Figure, Table
from ehlectric.drive import DriveDuty, DriveResult, end_summary
from ehlectric.figures import drive_figures as findings
from ehlectric.figures.data import Along, Panel
from ehlectric.figures.drive_figures import (
    NAMES,
    RATES,
    has_spectrum,
    number_of_events,
    shown_discharges,
    time_axis,
    variants,
)
from ehlectric.figures.duty_panels import drive_duty_panels
from ehlectric.figures.duty_panels import time_axis as time_axis_of_cycle
from ehlectric.quantities.formats import rpm_text, scale_of
from ehlectric.quantities.results import EVENT_KEYS, STATISTICS
from ehlectric.readable import capital, formatted, readable

# Largest number of discharges of a bearing in the table.
_LISTED = 400

# Least share of time that is drawn, over the largest one.
_LEAST = 1e-6

# Heights of figures, of figures of discharges, of a row of the remedies, and of what surrounds the rows [px].
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
    """Figures of a simulated drive; figures with nothing to show are omitted."""
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
        Table("Worst stretches, most discharges first", heads, rows),
        f"{findings.duty_cycle(result)}. {duty.points} rows are simulated, the others interpolated.",
    )


def histogram_figure(result: DriveResult) -> Figure:
    """Share of time at the voltages across the films of both bearings."""
    record = result.solution.record
    rows = [
        (f"{limit:g}", *(readable(100.0 * time / record.duration) for time in column))
        for limit, column in zip(record.limits, record.above.T, strict=True)
    ]
    heads = ("above [V]", *(f"{name} [% of time]" for name in NAMES))
    return Figure(
        "How long which voltages last",
        f"Share of time at the voltages across the films. {findings.histogram(result)}.",
        _drawn(findings.at_voltage(result)),
        Table("Share of time above a voltage of either sign", heads, tuple(rows)),
        "Dashed: breakdown voltages of the weakest position, where they are near.",
    )


def _drawn(figure: tuple[Along, Panel], height: int = _HEIGHT) -> Plot:
    """Figure of one panel of a height [px]."""
    along, panel = figure
    return stack(along, [panel], height=height, showlegend=len(panel.curves) > 1)


def spectrum_figure(result: DriveResult) -> Figure:
    """Amplitude spectrum of the shaft voltage, with both axes logarithmic."""
    along, panel = findings.spectrum_lines(result)
    (curve,), finding = panel.curves, findings.spectrum(result)
    largest = np.argsort(-curve.y, kind="stable")[:_LINES]
    rows = tuple((readable(curve.x[k], 6), readable(curve.y[k], 4)) for k in largest)
    return Figure(
        "Spectrum of the shaft voltage",
        f"Amplitude of the shaft voltage over the frequency. {finding}.",
        _drawn((along, panel)),
        Table("Largest lines", ("frequency [Hz]", f"amplitude [{panel.unit}]"), rows),
        f"{finding}. Amplitudes are peak values, without a window.",
    )


def _distribution(result: DriveResult, key: str) -> Figure:
    about, (along, panel) = EVENT_KEYS[key], findings.distribution_of(result, key)
    words = capital(about.label)
    ends = [end_summary(result.solution, b) for b in range(2)]
    rows = [
        (name, *(_cell(end, f"{key}_{short}", along.unit, about.digits) for end in ends))
        for short, name in STATISTICS.items()
    ]
    caption = ", ".join(f"{NAMES[b]}: {number_of_events(result, b)} discharges" for b in range(2))
    lead = caption
    if key in ("energy", "charge", "peak_current"):
        line = findings.arc_line(result)
        caption = f"{caption}. {capital(line)}."
    heads = ("", *(f"{name} [{along.unit}]" for name in NAMES))
    return Figure(
        words,
        f"Distribution of the {about.label}; {lead}",
        _drawn((along, panel), _DISCHARGES_HEIGHT),
        Table(words, heads, tuple(rows)),
        caption,
    )


def _cell(end: Mapping[str, Any], key: str, unit: str, digits: str) -> str:
    return formatted(scale_of(unit).of(end[key]), digits) if end["events"] else "none"


def remedies_figure(result: DriveResult) -> Figure:
    """Discharges per second of the drive as it is and with each remedy."""
    rows = list(variants(result))
    along, panel = findings.rates_of(rows)
    finding = findings.remedies(result)
    return Figure(
        "Mitigation measures compared",
        f"Discharges per second of the drive as it is and with each mitigation measure. {finding}.",
        stack(along, [panel], height=_REST + _ROW * len(rows), hovermode="closest"),
        Table(
            "Discharges per second with bounds of 95 %",
            ("", *(f"{name} [1/s]" for _, _, name in RATES)),
            tuple((name, *map(findings.rate_text, pair)) for name, pair in rows),
        ),
        f"{finding}. Bars are bounds of 95 %; an open triangle is an upper bound without any discharge.",
    )
