"""Figures of a drive: voltages over time, how long which voltages last, discharges, spectrum and remedies."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from ehlectric.arrays import Array
from ehlectric.drive import CHARGE, ENERGY, FILM, ON, PEAK, VOLTAGE, DriveResult, end_summary, whole_row
from ehlectric.figures.bearing_figures import prefixed
from ehlectric.figures.data import Along, Area, Curve, Panel, Upright, is_wide
from ehlectric.figures.draw import draw_panel, line_look
from ehlectric.figures.duty_panels import cycle_lines, drive_duty_panels
from ehlectric.figures.duty_panels import time_axis as time_axis_of_cycle
from ehlectric.figures.figure_names import DRIVE_FIGURE_FILES
from ehlectric.figures.shaft_forces import draw_forces, forces_on_rotor, legend_of_rotor
from ehlectric.figures.style import (
    drawing_of,
    legend_above,
    new_panels,
    note,
    share_below,
    side_by_side,
    style,
    titled,
)
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.palette import BLACK, BLUE, GREY, MIDDLE_GREY, ORANGE
from ehlectric.quantities.results import DRIVE_BOOK, EVENT_KEYS, NAMES_OF_ENDS
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Names of both bearings in titles and legends, and their colours.
NAMES = tuple(NAMES_OF_ENDS.values())
COLOURS = (BLUE, ORANGE)


def events_of(result: DriveResult, b: int) -> Array:
    """Events of one bearing, a row for each, as in ``Record``."""
    events = result.solution.record.events
    return np.asarray(events[events[:, FILM] == b])


def number_of_events(result: DriveResult, b: int) -> int:
    """Number of all events of one bearing, also of those that are not kept one by one."""
    return int(np.sum(result.solution.record.counts[b]))


def breakdown_of(result: DriveResult, b: int) -> float:
    """Voltage across the films at which the weakest position of a bearing breaks down [V], or infinity."""
    return float(np.min(result.solution.elements[b].breakdown))


def voltage_unit(largest: float) -> tuple[float, str]:
    """Factor and unit in which a voltage [V] is at least 1, and nanovolts for none at all."""
    return unit_for(max(largest, 1e-9), "V", least=1.0)


# Least share of time for which a title states a voltage [%].
_LEAST_SHARE = 1.0


def voltages(result: DriveResult) -> str:
    """Sentence: how often both bearings discharge, and at which voltages; or why none does."""
    ends = _ends(result)
    if not any(end["events"] for end in ends):
        return f"No discharge in {_duration(result)}: {_largest(result)}{_limit(result)}"
    rates = " and ".join(
        f"{readable(end['events_per_second'])} ({name})" for end, name in zip(ends, NAMES, strict=True)
    )
    mean = sum(end["events"] * end["voltage_mean"] for end in ends if end["events"])
    mean /= sum(end["events"] for end in ends)
    return f"{rates} discharges a second, mean of all {readable(mean)} V"


def histogram(result: DriveResult) -> str:
    """Sentence: for which share of time the bearing voltages are above the largest limit that matters."""
    record = result.solution.record
    shares = 100.0 * record.above / record.duration
    stated = np.flatnonzero(np.max(shares, axis=0) >= _LEAST_SHARE)
    if not stated.size:
        share = float(np.max(shares[:, 0]))
        above = f"Above {record.limits[0]:g} V for {readable(share, 2)} % of the time"
        return f"{above if share else 'Low bearing voltage'}: {_largest(result)}"
    k = int(stated[-1])
    texts = [f"{readable(share)} %" for share in shares[:, k]]
    if len(set(texts)) == 1:
        return f"Voltage of both bearings above {record.limits[k]:g} V for {texts[0]} of the time"
    both = " and ".join(f"{text} ({name})" for text, name in zip(texts, NAMES, strict=True))
    return f"Above {record.limits[k]:g} V for {both} of the time"


def spectrum(result: DriveResult) -> str:
    """Sentence: the largest line of the shaft voltage, and the spacing of the lines."""
    record = result.solution.record
    line = 1 + int(np.argmax(record.spectrum[1:]))
    largest, at = prefixed(float(record.spectrum[line]), "V"), prefixed(line / record.duration, "Hz")
    spacing = prefixed(1.0 / record.duration, "Hz")
    return f"Largest line of the shaft voltage {largest} at {at}; lines every {spacing}"


def discharges(result: DriveResult) -> str:
    """Sentence: mean energy of the discharges of each bearing, and the largest one."""
    ends = _ends(result)
    means = ", ".join(
        f"{_energy(end['energy_mean'])} ({name})" if end["events"] else f"none ({name})"
        for name, end in zip(NAMES, ends, strict=True)
    )
    largest = max(end["energy_largest"] for end in ends if end["events"])
    return f"Mean energy of a discharge {means}; largest {_energy(largest)}"


def remedies(result: DriveResult) -> str:
    """Sentence: which remedy has the fewest discharges, compared with the drive as it is."""
    rows = list(variants(result))
    (_, unchanged), *others = rows
    rates = [both["events_per_second"] for _, (*_, both) in others]
    least, now = min(rates), unchanged[-1]["events_per_second"]
    best = [name for (name, _), rate in zip(others, rates, strict=True) if rate == least]
    if not now + max(rates):
        highest = max(end["events_per_second_high"] for _, pair in rows for end in pair)
        return f"No discharge, with or without mitigation measures: at most {readable(highest)} a second"
    if not least < now:
        return f"No mitigation measure lowers the {readable(now)} discharges a second of both bearings"
    names = " and ".join(textwrap.shorten(name, 40, placeholder=" ...") for name in best[:3])
    if not least:
        return f"No discharge with {names}; {readable(now)} a second in both bearings as it is"
    left = "leaves" if len(best) == 1 else "leave"
    return f"{names} {left} {readable(least)} of the {readable(now)} discharges a second"


def duty_cycle(result: DriveResult) -> str:
    """Sentence: expected discharges of each bearing over the duty cycle, and their energy."""
    assert result.duty is not None
    sums = zip(NAMES, result.duty.discharges, result.duty.energy, strict=True)
    texts = [f"{_count(count.value)} with {_energy(energy.value)} ({name})" for name, count, energy in sums]
    return f"Expected discharges over the cycle: {' and '.join(texts)}"


def _count(number: float) -> str:
    """Large number in words.

    >>> _count(41_200_000.0), _count(520.0)
    ('41.2 million', '520')
    """
    return f"{readable(1e-6 * number)} million" if number >= 1e6 else readable(number)


def case_lines(result: DriveResult) -> list[str]:
    """Lines: title of the case, speed, temperature and simulated time."""
    bearing, title = result.case.bearings[0].bearing, result.case.title
    parts = [
        textwrap.shorten(title, 70, placeholder=" ..."),
        *operating_point(bearing.inner_speed, bearing.oil_temperature),
        f"{_duration(result)} simulated",
    ]
    return [", ".join(filter(None, parts))]


def arc_line(result: DriveResult) -> str:
    """Line: the input from which charges, energies and currents follow."""
    arc, kept = result.case.breakdown.arc_resistance, len(result.solution.record.events)
    text = f"charges, energies and currents follow from the given arc of {amount(arc, 'Ω')}"
    if kept < sum(number_of_events(result, b) for b in range(len(ENDS))):
        text += f"; of the first {kept} discharges"
    return text


def _energy(value: float) -> str:
    return prefixed(value, "J")


def _largest(result: DriveResult) -> str:
    """Clause: the largest bearing voltage."""
    peaks = result.solution.record.peak
    b = int(np.argmax(peaks))
    return f"at most {prefixed(float(peaks[b]), 'V')} ({NAMES[b]})"


def _limit(result: DriveResult) -> str:
    """Clause: the lowest voltage at which films break down."""
    breakdown = min(breakdown_of(result, b) for b in range(len(ENDS)))
    return f", films break down at {readable(breakdown)} V" if math.isfinite(breakdown) else ""


def _ends(result: DriveResult) -> list[dict[str, float]]:
    return [end_summary(result.solution, b) for b in range(len(ENDS))]


def _duration(result: DriveResult) -> str:
    return amount(result.solution.record.duration, "s")


# Decades of the share of time that are drawn at most.
_DECADES = 1e-6

# Share of time at the lower end of the axis over the largest one, at most.
_LOW = 1e-2

# Breakdown voltage over the largest voltage up to which it is drawn.
_NEAR_LIMIT = 1.5

# Least number of bins on each side of zero that are drawn.
_BINS = 3


def at_voltage(result: DriveResult) -> tuple[Along, Panel]:
    """Share of time at the voltages across the films of both bearings, and the breakdown voltages that are
    near.
    """
    record, most = result.solution.record, _most(result)
    factor, unit = voltage_unit(most)
    width = float(record.edges[1] - record.edges[0])
    # Bins beyond the largest voltage have no share.
    edges = record.edges[np.abs(record.edges) <= most + 1.5 * width]
    first = int(np.searchsorted(record.edges, edges[0]))
    shares = 100.0 * record.histogram[:, first : first + edges.size - 1] / record.duration
    bottom, top = _share_ends(shares)
    curves = [_steps(factor * edges, values, b, NAMES[b]) for b, values in enumerate(shares)]
    levels = [sign * factor * volts for volts in _breakdowns(result) for sign in (1.0, -1.0)]
    names = ["breakdown, weakest position", *("" for _ in levels)]
    return Along("voltage across the films", unit, (-factor * most, factor * most)), Panel(
        f"share of time\nper {readable(factor * width)} {unit}",
        "%",
        curves,
        top,
        bottom,
        [_under(curves[0], bottom)],
        [Upright(name, level, BLACK, "dash") for name, level in zip(names, levels, strict=False)],
        log=True,
    )


def time_at_voltage(result: DriveResult, ax: Axes) -> None:
    """Draw the share of time at the voltages across the films of both bearings."""
    along, panel = at_voltage(result)
    draw_panel(panel, ax, along)
    _log_axis(ax.yaxis, panel.bottom, panel.top, ticks=6)
    legend_above(ax, columns=3)


def time_above(result: DriveResult, ax: Axes) -> None:
    """Draw the share of time above a voltage, whatever its sign, with the limits of the summary as dots."""
    record = result.solution.record
    most = _most(result)
    factor, unit = voltage_unit(most)
    edges, shares = shares_above(result)
    for b, values in enumerate(shares):
        known = values > 0.0
        ax.plot(factor * edges[known], values[known], color=COLOURS[b], lw=1.1, ls=("-", (0, (5, 2)))[b])
        above = 100.0 * record.above[b] / record.duration
        seen = above > 0.0
        marker, size, face = (("o", 8.0, "white"), ("s", 4.0, COLOURS[1]))[b]
        at = factor * record.limits[seen]
        ax.plot(at, above[seen], color=COLOURS[b], ls="none", marker=marker, ms=size, mfc=face)
    _log_axis(ax.yaxis, *_share_ends(shares), ticks=6)
    for volts in _breakdowns(result):
        ax.axvline(factor * volts, **line_look(BLACK, "dash", 1.0))
    ax.set_xlim(0.0, factor * most)
    ax.set_xlabel(f"voltage across the films, without its sign [{unit}]")
    ax.set_ylabel("share of time\nabove it [%]")


def _steps(edges: Array, values: Array, b: int, name: str) -> Curve:
    """Steps of bearing ``b`` between the edges of bins."""
    return Curve(name, edges, np.append(values, 0.0), COLOURS[b], ("solid", "dash")[b], steps=True)


def _under(steps: Curve, bottom: float) -> Area:
    """Area below steps."""
    x, y = np.repeat(steps.x, 2)[1:-1], np.repeat(steps.y[:-1], 2)
    ends = np.full(x.size, bottom), np.maximum(y, bottom)
    return Area("", x, np.ones(x.size, dtype=bool), steps.colour, 0.3, ends)


def shares_above(result: DriveResult) -> tuple[Array, Array]:
    """Voltages from 0 on [V], and the share of time in which each film has a larger one [%]. Returns
    ``edges``, edges of the bins that are not negative, shape (m,); ``shares``, share of time above each edge,
    in either direction, shape (2, m).
    """
    record = result.solution.record
    half = record.histogram.shape[1] // 2
    both = record.histogram[:, half:] + record.histogram[:, half - 1 :: -1]
    beyond = np.cumsum(both[:, ::-1], axis=1)[:, ::-1]
    shares: Array = 100.0 * np.column_stack([beyond, np.zeros(2)]) / record.duration
    return record.edges[half:], shares


def _most(result: DriveResult) -> float:
    """Largest voltage on the axis [V]."""
    record = result.solution.record
    width = float(record.edges[1] - record.edges[0])
    return max(1.05 * float(np.max(record.peak)), _BINS * width)


def _breakdowns(result: DriveResult) -> list[float]:
    """Breakdown voltages of both bearings that are near enough to be drawn [V], equal ones once."""
    levels = sorted({breakdown_of(result, b) for b in range(2)})
    return [volts for volts in levels if volts <= _NEAR_LIMIT * float(np.max(result.solution.record.peak))]


def _share_ends(shares: Array) -> tuple[float, float]:
    """Ends of a logarithmic axis of shares of time [%], over at most some decades."""
    known = shares[shares > 0.0]
    top = float(np.max(known, initial=1.0))
    least = max(float(np.min(known, initial=top)), _DECADES * top)
    return min(0.5 * least, _LOW * top), 2.0 * top


# Number of points that are drawn for each decade of frequency, and part of the largest line that is drawn.
_POINTS, _LEAST = 400, 1e-6


def spectrum_lines(result: DriveResult) -> tuple[Along, Panel]:
    """Amplitude spectrum of the shaft voltage, without the line at 0 Hz; the largest one of close lines."""
    frequencies, amplitudes = highest_lines(result)
    factor, unit = voltage_unit(float(np.max(amplitudes)))
    shown = factor * amplitudes
    curve = Curve("shaft voltage", frequencies, shown, BLUE, width=0.8)
    ends = 3.0 * float(np.max(shown)), 0.5 * float(np.min(shown))
    window = 0.6 * float(frequencies[0]), 1.7 * float(frequencies[-1])
    panel = Panel("amplitude of the shaft voltage", unit, [curve], *ends, log=True)
    return Along("frequency", "Hz", window, log=True), panel


def shaft_spectrum(result: DriveResult, ax: Axes) -> None:
    """Draw the amplitude spectrum of the shaft voltage."""
    along, panel = spectrum_lines(result)
    draw_panel(panel, ax, along)
    assert along.window is not None
    _log_axis(ax.xaxis, *along.window, ticks=9)
    _log_axis(ax.yaxis, panel.bottom, panel.top, ticks=9)


def has_spectrum(result: DriveResult) -> bool:
    """Whether a result has a spectrum with a line above 0 Hz to draw."""
    return bool(np.any(result.solution.record.spectrum[1:] > 0.0))


def highest_lines(result: DriveResult) -> tuple[Array, Array]:
    """Return the largest spectral line in each of many parts of a frequency decade. Returns frequency [Hz]
    and amplitude [V] of each of these lines, in the order of frequency, shape (m,).
    """
    amplitudes = result.solution.record.spectrum
    lines = np.arange(1, amplitudes.size)
    part = np.floor(_POINTS * np.log10(lines))
    starts = np.flatnonzero(np.diff(part, prepend=-1.0))
    # Largest amplitude first within each part.
    order = np.lexsort((-amplitudes[lines], part))
    kept = lines[order[starts]]
    least = _LEAST * float(np.max(amplitudes[lines]))
    return kept / result.solution.record.duration, np.maximum(amplitudes[kept], least)


# Distances of both bearings, and of their sum, from the middle of their row, and size of their marks.
_OFFSETS, _LARGE = (-0.24, 0.24, 0.0), 1.3

AS_IT_IS = "as it is"

# Colour, marker and name of each bearing and of both together.
RATES = (
    (BLUE, "dots", NAMES[0]),
    (ORANGE, "full square", NAMES[1]),
    (BLACK, "full diamond", "both bearings"),
)

# Name of the drive or of a remedy, and summaries of both bearings and of their sums.
Variant = tuple[str, list[dict[str, Any]]]


def variants(result: DriveResult) -> Iterator[Variant]:
    """Yield the name and the summaries of the unchanged drive and each remedy: per bearing, and sums."""
    solutions = [(AS_IT_IS, result.solution), *((title, remedied) for title, _, remedied in result.remedies)]
    for name, solution in solutions:
        yield name, [*(end_summary(solution, b) for b in range(len(ENDS))), whole_row(solution.record)]


def rates_of(variants: Sequence[Variant]) -> tuple[Along, Panel]:
    """Discharges per second of the drive and its remedies, with bounds of 95 %, a row for each.

    Where no discharge happened, a triangle is the upper bound.
    """
    ends = [end for _, summaries in variants for end in summaries]
    known = [value for end in ends for key in _BOUNDS if (value := end[key]) > 0.0]
    bottom = 10.0 ** math.floor(math.log10(0.5 * min(known)))
    curves = [curve for b in range(len(RATES)) for curve in _rates(variants, b, bottom)]
    along = Along(DRIVE_BOOK["end.events_per_second"].label, "", (bottom, 2.0 * max(known)), log=True)
    return along, _in_rows(variants, curves)


# Keys of a rate, and of its bounds of 95 %.
_BOUNDS = ("events_per_second", "events_per_second_low", "events_per_second_high")


def _rates(variants: Sequence[Variant], b: int, bottom: float) -> Iterator[Curve]:
    """Rates of one bearing, or of both, with their bounds, and upper bounds where nothing discharged."""
    colour, marker, place = RATES[b]
    name = f"{place}, bounds of 95 %"
    for some in (True, False):
        rows = [
            (k, title, pair[b]) for k, (title, pair) in enumerate(variants) if bool(pair[b]["events"]) == some
        ]
        if not rows:
            continue
        rate, low, high = (np.array([end[key] for *_, end in rows]) for key in _BOUNDS)
        at = _OFFSETS[b] + np.array([k for k, *_ in rows])
        gaps = np.full(at.size, np.nan)
        reach = np.column_stack([np.maximum(low, bottom), high, gaps]).ravel()
        yield Curve("", reach, np.repeat(at, 3), colour, "solid" if some else "dot", 1.3)
        texts = [f"{title}, {place}: {rate_text(end)} per second" for _, title, end in rows]
        mark = marker if some else "bound"
        yield Curve(name, rate if some else high, at, colour, marker=mark, size=_LARGE, texts=texts)
        name = ""


def rate_text(end: Mapping[str, Any]) -> str:
    """Text of a rate with its bounds of 95 %."""
    rate, low, high = (readable(end[key]) for key in _BOUNDS)
    return f"{rate} ({low} to {high})" if end["events"] else f"none, at most {high}"


def _in_rows(variants: Sequence[Variant], curves: Sequence[Curve]) -> Panel:
    """Panel with a row for the drive as it is and for each remedy."""
    names = [name for name, _ in variants]
    return Panel("", "", curves, -0.5, len(names) - 0.5, rows=names)


def rates(result: DriveResult, ax: Axes) -> None:
    """Draw the discharges per second of the drive and its remedies, with bounds of 95 %, a row for each."""
    along, panel = rates_of(list(variants(result)))
    draw_panel(panel, ax, along)
    assert along.window is not None
    _log_axis(ax.xaxis, *along.window, ticks=5)


def energies(result: DriveResult, ax: Axes) -> None:
    """Draw the mean energy of a discharge of the drive and of each remedy in its row."""
    rows = list(variants(result))
    means = [end["energy_mean"] for _, (*pair, _) in rows for end in pair if end["events"]]
    factor, unit = unit_for(max(means, default=1e-9), "J", least=1.0)
    curves = []
    for b, (colour, marker, _) in enumerate(RATES[:-1]):
        here = [(k + _OFFSETS[b], pair[b]) for k, (_, pair) in enumerate(rows) if pair[b]["events"]]
        values = factor * np.array([end["energy_mean"] for _, end in here])
        curves.append(Curve("", values, np.array([at for at, _ in here]), colour, marker=marker, size=_LARGE))
    draw_panel(_in_rows(rows, curves), ax)
    for row, (_, (*_, both)) in enumerate(rows):
        if not both["events"]:
            note(ax, 0.03, row, "no discharge", data_axis="y", va="center", color=GREY)
    positive = [factor * value for value in means if value > 0.0]
    if positive and max(positive) > 20.0 * min(positive):
        _log_axis(ax.xaxis, 0.5 * min(positive), 2.0 * max(positive), ticks=5)
    else:
        ax.set_xlim(0.0, 1.15 * max(positive, default=1.0))
    ax.set_xlabel(f"{DRIVE_BOOK['end.energy_mean'].label} [{unit}]")
    if side_by_side(ax) > 1:
        ax.tick_params(labelleft=False)


def legend_of_remedies(axes: list[Axes]) -> None:
    """Legend above the first panel: both bearings, and the bounds."""
    legend_above(axes[0], columns=1)


def _log_axis(axis: Axis, low: float, high: float, ticks: int) -> None:
    """Logarithmic axis between two values, with few ticks."""
    ax = axis.axes
    if axis is ax.xaxis:
        ax.set(xscale="log", xlim=(low, high))
    else:
        ax.set(yscale="log", ylim=(low, high))
    axis.set_major_locator(LogLocator(numticks=ticks))
    axis.set_minor_formatter(NullFormatter())


Draw = Callable[[DriveResult, Axes], None]


@dataclass(frozen=True)
class _Drawing:
    """Figure of a drive: its panels, how they stand, its size [inches], its title, and its legend."""

    panels: tuple[Draw, ...]
    rows: int
    size: tuple[float, float]
    finding: Callable[[DriveResult], str]
    legend: Callable[[list[Axes]], None] | None = None  # none where the panels have legends themselves
    shared: bool = False


def drive_figures_of(result: DriveResult) -> dict[str, _Drawing]:
    """Figures of a drive by the names of their files.

    Figures with nothing to show are omitted: a spectrum without lines, distributions without discharges,
    remedies, a duty cycle and a rotor where the file lacks them, and voltages where no time was recorded.
    """
    voltages_file, over_voltage, over_frequency, of_events, *others = DRIVE_FIGURE_FILES
    of_remedies, over_cycle, on_rotor = others
    drawings: dict[str, _Drawing] = {}
    if len(result.solution.record.trace) > 1:
        drawings[voltages_file] = _Drawing(VOLTAGE_PANELS, 3, (6.3, 5.4), voltages, legend_of, shared=True)
    drawings[over_voltage] = _Drawing((time_at_voltage, time_above), 2, (6.3, 5.0), histogram)
    if has_spectrum(result):
        drawings[over_frequency] = _Drawing((shaft_spectrum,), 1, (6.3, 3.6), spectrum)
    if len(result.solution.record.events):
        drawings[of_events] = _Drawing(DISTRIBUTIONS, 2, (6.3, 5.0), discharges, legend_of_discharges)
    if result.remedies:
        height = 1.7 + 0.5 * (1 + len(result.remedies))
        drawings[of_remedies] = _Drawing((rates, energies), 1, (6.9, height), remedies, legend_of_remedies)
    if result.duty is not None:
        drawings[over_cycle] = _Drawing(DUTY_PANELS, 3, (6.3, 5.4), duty_cycle, legend_of_cycle, shared=True)
    if result.case.rotor is not None:
        drawings[on_rotor] = _Drawing(FORCE_PANELS, 1, (9.0, 3.1), loads, legend_of_rotor)
    return drawings


def figure(result: DriveResult, name: str) -> Figure:
    """Figure of a drive. Raises InputError where the drive has no figure of this name."""
    drawing = drawing_of(drive_figures_of(result), name)
    lines = [drawing.finding(result), *case_lines(result)]
    duty = result.duty
    if drawing.finding is duty_cycle and duty is not None:
        text = f"{duty.points} rows simulated, the others interpolated"
        lines[1:] = cycle_lines(result.case.title, duty.source, text)
    if drawing.finding is discharges:
        lines.append(arc_line(result))
    with style():
        axes = new_panels(drawing.rows, len(drawing.panels) // drawing.rows, drawing.size)
        for draw, ax in zip(drawing.panels, axes, strict=True):
            draw(result, ax)
        if drawing.legend is not None:
            drawing.legend(axes)
        if drawing.shared:
            share_below(axes)
        return titled(axes[0], "\n".join(lines), converged=result.converged)


# Breakdown voltage over the largest voltage of a panel up to which it is drawn, and room around the curves.
_NEAR, _ROOM = 1.8, 1.12


def time_axis(result: DriveResult) -> Along:
    """Axis of the time of the trace, from its begin."""
    begin, span = _begin(result), _span(result)
    factor, unit = unit_for(span, "s", least=1.0)
    scale, unit_of_begin = unit_for(begin, "s", least=1.0)
    since = "" if begin < 1e-3 * span else f" after {readable(scale * begin, 4)} {unit_of_begin}"
    return Along(f"time{since}", unit, (0.0, factor * span))


def source_panel(result: DriveResult) -> Panel:
    """Common-mode voltage of the source, without its ringing."""
    volts = result.solution.record.trace[:, 1]
    largest = float(np.max(np.abs(volts), initial=0.0))
    factor, unit = voltage_unit(largest)
    curve = Curve("common mode", _times(result), factor * volts, MIDDLE_GREY, width=0.9)
    return _around_zero("common mode", unit, [curve], factor * largest)


def bearing_panel(result: DriveResult, b: int) -> Panel:
    """Voltage across the films of a bearing with its discharges, and its breakdown voltage where near."""
    volts, (times, peaks) = result.solution.record.trace[:, 2 + b], shown_discharges(result, b)
    largest = max(float(np.max(np.abs(part), initial=0.0)) for part in (volts, peaks))
    factor, unit = voltage_unit(largest)
    curves = [Curve(NAMES[b], _times(result), factor * volts, COLOURS[b], width=0.9)]
    breakdown = breakdown_of(result, b)
    if breakdown <= _NEAR * largest:
        scattered = " (63 %)" if math.isfinite(result.solution.elements[b].shape) else ""
        ends = np.array(time_axis(result).window)
        for sign, name in ((1.0, f"breakdown, weakest position{scattered}"), (-1.0, "")):
            level = np.full(2, sign * factor * breakdown)
            curves.append(Curve(name, ends, level, BLACK, "dash", 0.9))
        largest = max(largest, breakdown)
    if times.size:
        curves.append(Curve("discharge", times, factor * peaks, BLACK, marker="ring"))
    return _around_zero(NAMES[b], unit, curves, factor * largest)


def shown_discharges(result: DriveResult, b: int) -> tuple[Array, Array]:
    """Times of the discharges of a bearing in the trace, in the unit of the axis; voltages [V]."""
    events, begin = events_of(result, b), _begin(result)
    here = events[(events[:, ON] >= begin) & (events[:, ON] <= begin + _span(result))]
    return _times(result, here[:, ON]), here[:, VOLTAGE]


def _begin(result: DriveResult) -> float:
    """Begin of the trace [s]."""
    return max(float(result.solution.record.trace[0, 0]), 0.0)


def _around_zero(title: str, unit: str, curves: list[Curve], largest: float) -> Panel:
    top = _ROOM * largest or 1.0
    return Panel(title, unit, curves, top, -top)


def _span(result: DriveResult) -> float:
    """Time that the trace covers [s]."""
    return float(result.solution.record.trace[-1, 0]) - _begin(result)


def _times(result: DriveResult, times: Array | None = None) -> Array:
    """Times [s], or times of the trace from its start, in the unit of the axis."""
    factor, _ = unit_for(_span(result), "s", least=1.0)
    since: Array = (result.solution.record.trace[:, 0] if times is None else times) - _begin(result)
    return factor * since


def voltage_panels(result: DriveResult) -> list[Panel]:
    """Voltages over a short time, from top to bottom: of the source, and across the films of the bearings."""
    return [source_panel(result), *(bearing_panel(result, b) for b in range(2))]


def over_time(result: DriveResult, ax: Axes, *, number: int) -> None:
    """Draw one of the voltages over a short time, and mark discharges."""
    draw_panel(voltage_panels(result)[number], ax, time_axis(result))
    for line in ax.get_lines():
        # The trace ends with a discharge, whose mark would be cut at the edge.
        line.set_clip_on(line.get_marker() == "None")


def over_cycle_time(result: DriveResult, ax: Axes, *, number: int) -> None:
    """Draw one of the quantities over the duty cycle."""
    assert result.duty is not None
    panels = list(drive_duty_panels(result.duty))
    draw_panel(panels[number], ax, time_axis_of_cycle(result.duty.rows))


def legend_of_cycle(axes: list[Axes]) -> None:
    """Legend above the first panel: states of the films, and both bearings."""
    by_label: dict[str, Artist] = {}
    for ax in (axes[0], axes[-1]):
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            if not label.startswith("_") and label != "speed":
                by_label.setdefault(label, handle)
    legend_above(axes[0], list(by_label.values()), columns=3)


def loads(result: DriveResult) -> str:
    """Sentence about the loads of both bearings."""
    pairs = zip(NAMES, result.case.bearings, strict=True)
    carried = " and ".join(f"{amount(each.bearing.radial_load, 'N')} at the {name}" for name, each in pairs)
    return f"The bearings carry {carried}"


def on_rotor_along(result: DriveResult, ax: Axes, *, way: int) -> None:
    """Draw the forces on the rotor along x (0) or y (1)."""
    draw_forces(ax, "rotor", forces_on_rotor(result.case), way)


# Panels of the figure, from top to bottom.
FORCE_PANELS = tuple(partial(on_rotor_along, way=way) for way in range(2))
DUTY_PANELS = tuple(partial(over_cycle_time, number=number) for number in range(3))
VOLTAGE_PANELS = tuple(partial(over_time, number=number) for number in range(3))


def legend_of(axes: list[Axes]) -> None:
    """Legend above the first panel, with what any of the panels shows."""
    by_label: dict[str, Artist] = {}
    for ax in axes[1:]:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            if label not in NAMES:
                by_label.setdefault(label, handle)
    if by_label:
        legend_above(axes[0], list(by_label.values()))


# Quantities of a discharge, and their columns of a record.
QUANTITIES = {"voltage": VOLTAGE, "charge": CHARGE, "energy": ENERGY, "peak_current": PEAK}

# Number of bins of a distribution, and values outside of which lie too few discharges to be seen [%].
_LEAST_EVENTS, _MOST = 8, 40
_SHOWN = (0.05, 99.95)

# Relative difference of values below which they are shown as nearly equal.
_NARROW = 0.05


def distribution_of(result: DriveResult, name: str) -> tuple[Along, Panel]:
    """Return the distribution of a discharge quantity in both bearings [% of the discharges in each]."""
    about, column = EVENT_KEYS[name], QUANTITIES[name]
    values = [np.abs(events_of(result, b)[:, column]) for b in range(2)]
    edges, log = bins_of(np.concatenate(values))
    factor, unit = unit_for(float(edges[-1]), about.unit, least=1.0)
    curves = []
    for b, sample in enumerate(values):
        if sample.size:
            counts, _ = np.histogram(np.clip(sample, edges[0], edges[-1]), edges)
            label = f"{NAMES[b]}: {number_of_events(result, b)} discharges"
            curves.append(_steps(factor * edges, 100.0 * counts / sample.size, b, label))
    top = 1.05 * max(float(np.max(curve.y)) for curve in curves)
    areas = [_under(curve, 0.0) for curve in curves if curve.colour == COLOURS[0]]
    ends = (float(factor * edges[0]), float(factor * edges[-1]))
    return Along(about.label, unit, ends, log=log), Panel("discharges", "%", curves, top, areas=areas)


def distribution(result: DriveResult, ax: Axes, *, quantity: str) -> None:
    """Draw how a quantity of the discharges of both bearings is distributed."""
    along, panel = distribution_of(result, quantity)
    draw_panel(panel, ax, along)
    if not along.log:
        ax.xaxis.set_major_locator(MaxNLocator(5))


# Panels of the figure, row by row.
DISTRIBUTIONS = tuple(partial(distribution, quantity=name) for name in QUANTITIES)


def legend_of_discharges(axes: list[Axes]) -> None:
    """Legend above the first panel."""
    legend_above(axes[0], columns=1)


def bins_of(values: Array) -> tuple[Array, bool]:
    """Edges of the bins of a distribution of positive values, and whether they have equal ratios. ``values``,
    values of all discharges, of which the rarest are dropped, shape (n,).
    """
    low, high = np.percentile(values[values > 0.0] if np.any(values) else [1.0], _SHOWN)
    log = is_wide(np.array([low, high]))
    return _edges(float(low), float(high), values.size, log=log), log


def _edges(low: float, high: float, number: int, *, log: bool) -> Array:
    """Edges of bins, about as many as the square root of the number of values."""
    bins = int(np.clip(np.sqrt(number), _LEAST_EVENTS, _MOST))
    if log:
        return np.asarray(np.geomspace(low, high, bins + 1))
    room = _NARROW * high if high - low < _NARROW * high else 0.0
    return np.linspace(low - room, high + room, bins + 1)
