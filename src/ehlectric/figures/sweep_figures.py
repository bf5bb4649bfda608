"""Figures of sweeps by name and as files, with their findings, and the figure of a sensitivity analysis."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ehlectric.arrays import Array
from ehlectric.errors import InputError, printable, shown
from ehlectric.figures.bearing_figure_files import save_speed_figures
from ehlectric.figures.figure_names import SENSITIVITY_FIGURE, broken, in_formats, map_files
from ehlectric.figures.style import (
    axes_or_new,
    figure_of,
    legend_above,
    new_panels,
    outlined,
    save_each,
    save_figure,
    style,
    text_colour,
)
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from ehlectric.figures.sweep_panels import (
    TIME_SHARES,
    LinePath,
    joined,
    labelled,
    lines_of,
    range_text,
    voltage_text,
)
from ehlectric.figures.sweep_points import held_text, name_figure
from ehlectric.quantities.formats import OF_TIME, Scale, time_share_text
from ehlectric.quantities.inputs import SPEED
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.readable import capital, ratio_text, readable
from ehlectric.sweep import (
    LEVEL,
    Sensitivity,
    Slice,
    SweepResults,
    breakdown_of,
    categories_of,
    known_values,
    label_of,
    main_value,
    numbers_of,
    ranked_value,
    select_slice,
    sensitivity,
    spaced_log,
)


def of_slice(results: SweepResults, selection: Slice) -> str:
    """Sentence: range of the drawn value; of a discharge, where breakdown is expected."""
    if selection.categories:
        name = "" if selection.value == _NAME else f"{label_of(selection.value, results.case).name}: "
        return capital(printable(name) + _of_names(selection))
    margin = selection.margin[np.isfinite(selection.margin)]
    if not (selection.of_discharge and margin.size):
        label, scale = labelled(results, selection.value, selection.values)
        finite = selection.values[np.isfinite(selection.values)]
        if selection.value in TIME_SHARES:
            return _of_time(TIME_SHARES[selection.value].subject, finite)
        low, high = (readable(scale.of(float(of(finite)))) for of in (np.min, np.max))
        ends = low if low == high else f"{low} to {high}"
        return f"{capital(label.name)}: {ends} {scale.unit}".rstrip()
    return _of_margins(results, selection, margin) + _intermittent(selection)


# Most names of a finding.
_MOST_NAMES = 3


def _of_names(selection: Slice) -> str:
    """Clause: the most frequent names of a text and their numbers of points."""
    known = selection.values[np.isfinite(selection.values)].astype(int)
    counts = Counter(selection.categories[number] for number in known.tolist()).most_common()
    texts = [f"{printable(name)} at {count}" for name, count in counts[:_MOST_NAMES]]
    others = ", others at the rest" if len(counts) > _MOST_NAMES else ""
    return f"{', '.join(texts)} of {len(selection.points)} points{others}"


def _of_time(subject: str, shares: Array) -> str:
    """Sentence: range of the shares of time in which a bearing or a mesh conducts."""
    low, high = (time_share_text(float(of(shares))) for of in (np.min, np.max))
    ends = high if low == high else f"{low.removesuffix(OF_TIME)} to {high}"
    return f"{subject} {ends}"


def _intermittent(selection: Slice) -> str:
    """Clause: the number of points at which contacts open and close, so that no voltage is computed."""
    count = int(np.sum(selection.intermittent))
    return f"; at {count} more, asperity contact is frequent, discharges are likely" if count else ""


def _of_margins(results: SweepResults, selection: Slice, margin: Array) -> str:
    """Sentence: where breakdown is expected, from the margins of the points that have one."""
    below = int(np.sum(margin < 1.0))
    applied = f"{selection.breakdown.voltage_name} {voltage_text(selection)}"
    points = f"{margin.size} points" + " with a voltage" * bool(np.any(selection.intermittent))
    everywhere = f"at all {points}" if margin.size > 1 else "at the point"
    least, most = (ratio_text(float(of(margin))) for of in (np.min, np.max))
    if not below:
        return f"No breakdown expected {everywhere}: minimum margin {least} ({applied})"
    if below == margin.size:
        return f"Breakdown expected {everywhere}: maximum margin {most} ({applied})"
    where = _where(results, selection) or f"at {below} of {margin.size} points"
    return f"Breakdown expected {where} ({applied})"


def _where(results: SweepResults, selection: Slice) -> str:
    """Clause: the values of x below or above which breakdown is expected, if there is one for each line."""
    log_x = spaced_log(results, selection.x, selection.along)
    margins = replace(selection, value=selection.breakdown.margin)
    lines, log_y = lines_of(results, margins)
    if not joined(margins, lines):
        return ""
    path = LinePath(results, margins, log_x, log_y)
    crossings = [crossing(*path.values(line)) for line in lines]
    points = [point for point in crossings if point is not None]
    sides = {side for _, side in points}
    if len(points) < len(lines) or len(sides) > 1:
        return ""
    label, scale = labelled(results, selection.x, selection.along)
    places = sorted(scale.of(at) for at, _ in points)
    texts = list(dict.fromkeys(readable(places[k]) for k in (0, -1)))
    clause = f"{sides.pop()} {' to '.join(texts)} {scale.unit or label.name}"
    if len(texts) == 1 or selection.y is None:
        return clause
    return f"{clause}, depending on {label_of(selection.y, results.case).name}"


def crossing(x: Array, margin: Array) -> tuple[float, str] | None:
    """Place at which a margin passes 1, with "below" or "above" for the side of breakdown.

    None where it does not pass 1 exactly once, or has gaps.

    Examples
    --------
    >>> crossing(np.array([1.0, 2.0, 3.0]), np.array([0.5, 0.9, 1.1]))
    (2.5, 'below')
    """
    if not np.all(np.isfinite(margin)):
        return None
    low = margin < 1.0
    (changes,) = np.nonzero(low[:-1] != low[1:])
    if changes.size != 1:
        return None
    k = int(changes[0])
    part = (1.0 - margin[k]) / (margin[k + 1] - margin[k])
    return round(float(x[k] + part * (x[k + 1] - x[k])), 12), "below" if low[0] else "above"


def of_sensitivity(results: SweepResults, analysis: Sensitivity) -> str:
    """Sentence: the input with the largest part of the variance, and the share of samples that break down."""
    most: Any = max(analysis.indices, key=lambda index: index.total)
    value = label_of(analysis.value, results.case).name
    name = label_of(most.key, results.case).name
    text = f"{capital(name)} has {100.0 * most.total:.0f} % of the variance"
    if analysis.share_below_voltage is None:
        return f"{text} of the {value}"
    voltage = breakdown_of(results.case, analysis.value).voltage_name
    share = readable(100.0 * analysis.share_below_voltage)
    low, high = analysis.share_below_voltage_bounds or (0.0, 0.0)
    if analysis.spread.failed and high > low:
        share = f"{readable(100.0 * low)} to {readable(100.0 * high)}"
    return f"{text}; {share} % of the samples are below the {voltage}"


# Probabilities marked in the distribution.
_MARKED = (0.05, 0.5, 0.95)

# An index is drawn as 0 if its interval contains 0 or it is below _ZERO, and if the interval is within
# _NOTHING of 0.
_ZERO, _NOTHING = 0.01, 0.05

# Width of a figure below which names of inputs have several lines [inches], and letters on each of them.
_NARROW, _LETTERS = 5.0, 18


def distribution(results: SweepResults, analysis: Sensitivity, ax: Axes | None = None) -> Axes:
    """Draw the cumulative distribution of a value, with its 5, 50 and 95 % quantiles.

    For a breakdown voltage or a margin, the applied voltage is also drawn.

    Returns axes with the share of samples below each value; the samples are the solved points of A and B.
    """
    ax = axes_or_new(ax)
    samples = np.sort(_drawn(results, analysis.value))
    label, scale = labelled(results, analysis.value, samples)
    shares = np.arange(1, samples.size + 1) / samples.size
    ax.step(scale.of(samples), shares, where="post", color=BLUE)
    marked = [scale.of(analysis.spread.quantiles[q]) for q in _MARKED]
    ax.vlines(marked, 0.0, _MARKED, color=BLUE, lw=0.8, ls=":")
    (dots,) = ax.plot(marked, _MARKED, ls="none", marker="o", ms=4.0, color=BLUE)
    text = ", ".join(f"{100.0 * q:g}" for q in _MARKED) + " %: "
    text += ", ".join(readable(at) for at in marked)
    dots.set_label(f"{text} {scale.unit}".rstrip())
    handles: list[Artist] = [dots]
    if analysis.share_below_voltage is not None:
        handles.append(_applied(results, analysis, ax, scale))
    ax.set(xlabel=label.axis(scale), ylabel=f"share of {samples.size} samples below", ylim=(0.0, 1.04))
    legend_above(ax, handles, columns=1)
    return ax


def _drawn(results: SweepResults, value: str) -> Array:
    """Values at the solved points of the matrices A and B of the Sobol design."""
    values = numbers_of(results, value)[: 2 * results.samples]
    return np.asarray(values[np.isfinite(values)])


def _applied(results: SweepResults, analysis: Sensitivity, ax: Axes, scale: Scale) -> Line2D:
    """Draw the applied voltage or its range; the title says which part of the samples is below it."""
    about = breakdown_of(results.case, analysis.value)
    volts = results.values(about.voltage)[: 2 * results.samples]
    volts = volts[np.isfinite(volts)]
    ends = scale.of(np.array([volts.min(), volts.max()])) if analysis.value == about.value else np.ones(2)
    line = ax.axvline(ends[0], color=ORANGE, lw=1.4, ls="--")
    if ends[1] > ends[0]:
        ax.axvspan(*ends, color=ORANGE, alpha=0.2, lw=0.0)
    line.set_label(f"{about.voltage_name} {range_text(volts, 'V')}")
    return line


def parts(results: SweepResults, analysis: Sensitivity, ax: Axes | None = None) -> Axes:
    """Draw the first-order and the total sensitivity index of each input with their confidence intervals.
    Returns axes with the indices as bars, the input with the largest total index on top.
    """
    ax = axes_or_new(ax)
    ordered = sorted(analysis.indices, key=lambda index: index.total)
    rows = np.arange(len(ordered))
    kinds = (("total", BLUE, 0.19), ("first_order", ORANGE, -0.19))
    for kind, colour, shift in kinds:
        middle = np.array([getattr(index, kind) for index in ordered])
        ends = np.array([getattr(index, f"{kind}_interval") for index in ordered]).T
        ax.barh(rows + shift, middle, height=0.36, color=colour, label=kind.replace("_", " "))
        # With few rows, the estimate may lie outside its bootstrap interval.
        reach = np.maximum([middle - ends[0], ends[1] - middle], 0.0)
        # At a bar of no length, its interval would look like a stray mark.
        none = (np.abs(middle) < _ZERO) | ((ends[0] <= 0.0) & (ends[1] >= 0.0))
        drawn = ~none | (np.max(np.abs([middle, *ends]), axis=0) > _NOTHING)
        look: dict[str, Any] = {"fmt": "none", "ecolor": "black", "elinewidth": 0.9, "capsize": 2.5}
        bars = ax.errorbar(middle[drawn], (rows + shift)[drawn], xerr=reach[:, drawn], **look)
        for part in (*bars.lines[1], *bars.lines[2]):
            part.set_path_effects(outlined(2.4))
        for row in np.flatnonzero(~drawn):
            ax.text(0.01, rows[row] + shift, "0", va="center", fontsize="small", color=text_colour(colour))
    ax.axvline(0.0, color="black", lw=0.7)
    names = [label_of(index.key, results.case).name for index in ordered]
    if figure_of(ax).get_figwidth() < _NARROW:
        names = [broken(name, _LETTERS) for name in names]
    ax.set_yticks(rows, labels=names)
    highest = max(1.0, *(max(i.total_interval[1], i.first_order_interval[1]) for i in ordered))
    lowest = min(0.0, *(i.first_order_interval[0] for i in ordered))
    ax.set_xlim(1.05 * lowest, 1.03 * highest)
    ax.set_xlabel(f"part of the variance\n{100.0 * LEVEL:g} % intervals of {analysis.used} rows")
    ax.grid(axis="x", color=GREY, alpha=0.25, lw=0.5)
    ax.set_axisbelow(True)
    legend_above(ax)
    return ax


def sensitivity_figure(results: SweepResults, analysis: Sensitivity) -> Figure:
    """Figure of the distribution of a value next to the sensitivity indices of the inputs."""
    with style():
        high = max(3.4, 1.6 + 0.42 * len(analysis.indices))
        left, right = new_panels(1, 2, (8.4, high))
        distribution(results, analysis, left)
        parts(results, analysis, right)
        more = []
        if analysis.dropped:
            more.append(f"{analysis.dropped} of {analysis.rows} rows dropped: not solved")
        if analysis.doubtful:
            more.append(f"{analysis.doubtful} of {analysis.used} used rows have points that must not be used")
        name_figure(left, results, of_sensitivity(results, analysis), ", ".join(more))
    return figure_of(left)


def save_sensitivity(
    results: SweepResults, analysis: Sensitivity, path: Path, formats: Sequence[str] = ("png",)
) -> list[Path]:
    """Write the distribution of a value next to the sensitivity indices, as a file of each format."""
    return save_figure(sensitivity_figure(results, analysis), path, formats)


# Functions that draw a value over varied keys, by the first word of the file's name; sizes [inches].
FIGURES: Mapping[str, Callable[..., Axes]] = {"map": value_map, "lines": value_lines}
_SIZES = {"map": (6.3, 4.7), "lines": (6.3, 4.3)}


def figure(
    results: SweepResults,
    name: str,
    *,
    x: str = "",
    y: str | None = None,
    value: str = "",
    at: Mapping[str, str] | None = None,
) -> Figure:
    """Figure of a sweep. Raises InputError where there is no figure of this name, or as ``select_slice`` and
    ``sensitivity`` raise it.
    """
    (name,) = in_formats([name])
    if name == SENSITIVITY_FIGURE:
        indices = sensitivity(results, value or ranked_value(results.case))
        return sensitivity_figure(results, indices)
    kind, _, key = name.removesuffix(".png").partition("_")
    if kind not in FIGURES or name not in map_files(key):
        allowed = f"map_KEY.png, lines_KEY.png or {SENSITIVITY_FIGURE}"
        raise InputError("figure", got=shown(name), takes=allowed)
    if kind == "map" and y is None:
        raise InputError.missing("y", "a varied key, for a map")
    taken = select_slice(results, x, y, key, at)
    with style():
        ax = new_panels(1, 1, _SIZES[kind])[0]
        FIGURES[kind](results, x, y, key, at=at, ax=ax)
        name_figure(ax, results, of_slice(results, taken), held_text(results, taken))
    return figure_of(ax)


def save_maps(
    results: SweepResults,
    x: str,
    y: str | None,
    value: str,
    folder: Path,
    *,
    at: Mapping[str, str] | None = None,
    formats: Sequence[str] = ("png",),
) -> list[Path]:
    """Draw a value of a sweep as a map and as lines, as files. Raises InputError as ``select_slice`` does."""
    selection = select_slice(results, x, y, value, at)
    numeric = selection.numeric
    if selection.categories and not numeric:
        raise InputError.worded("y", f"missing; {value} is a name, which a map over two keys shows")
    names = dict(zip(map_files(value, at), map_files(value), strict=True))
    drawable = [
        file
        for file in names
        if (not selection.categories if file.startswith("lines_") else y is not None and numeric)
    ]
    return save_each(lambda file: figure(results, names[file], x=x, y=y, at=at), drawable, folder, formats)


def save_speeds(
    results: SweepResults,
    taken: Slice,
    folder: Path,
    formats: Sequence[str] = ("png",),
    *,
    at: Mapping[str, str] | None = None,
) -> list[Path]:
    """Draw capacitance and breakdown voltages of bearings over the speed, as files. Returns files written;
    none where the slice is not over only the speed of a bearing.
    """
    if taken.x != SPEED or taken.y is not None or taken.free:
        return []
    points = [
        (float(speed), dict(point.summary))
        for speed, point in zip(taken.along, taken.points, strict=True)
        if point.solved and not point.doubtful and point.summary is not None
    ]
    # The title of the case may name values that the sweep changes.
    title = ", ".join(filter(None, [results.title, held_text(results, taken).removeprefix("at ")]))
    return save_speed_figures(points, folder, title, formats=formats, at=at) if points else []


# Name that a map of axles shows first.
_NAME = "first.element"

# Value of a sweep without breakdown voltages, by the kind of its case.
_MAIN_VALUES = ("film.minimum_thickness", "bearing.capacitance")


def default_figure(results: SweepResults, options: Mapping[str, Any]) -> tuple[str, dict[str, Any]]:
    """Name and options of the most informative figure of a sweep: the sensitivity of a Sobol design, lines
    over one varied key, or a map over two.
    """
    if results.design == "sobol":
        return SENSITIVITY_FIGURE, {}
    over = default_axes(results, options)
    if not over:
        raise InputError("x", "no varied key has numbers;", takes="a figure by its name")
    named = "y" in over and results.design == "grid" and categories_of(results, _NAME)
    value = options.get("value") or (_NAME if named else _value_of(results))
    files = map_files(value)
    return files[0 if "y" in over and results.design == "grid" else 1], over | {"value": value}


def default_axes(results: SweepResults, options: Mapping[str, Any]) -> dict[str, str]:
    """Varied keys along the axes of a figure: those that are given, else the first ones with numbers. Returns
    ``x``, and ``y`` where there is a second key; empty where no key has numbers.
    """
    x, y = options.get("x"), options.get("y")
    at = options.get("at") or {}
    free = [key for key in _numeric(results) if key not in (x, y, *at)]
    keys = [x] if x else free[:1]
    if not keys:
        return {}
    others = [y] if y else [key for key in free if key not in keys]
    return {"x": keys[0]} | ({"y": others[0]} if others else {})


def _value_of(results: SweepResults) -> str:
    """Breakdown voltage, where there is one, else the film or the capacitance."""
    known, breakdown = known_values(results), main_value(results.case)
    for value in (breakdown, *_MAIN_VALUES, *known):
        if value in known:
            return value
    raise InputError(f"no point of {len(results.points)} is solved, there is nothing to show")


def _numeric(results: SweepResults) -> list[str]:
    """Varied keys with numbers that differ."""
    columns = {key: {repr(point.inputs[key]) for point in results.points} for key in results.varied}
    first = results.points[0].inputs
    return [key for key, values in columns.items() if len(values) > 1 and isinstance(first[key], int | float)]


def default_names(results: SweepResults) -> list[str]:
    """Names of the figures of a sweep over its default axes."""
    axes = default_axes(results, {})
    known = (value for value in known_values(results) if not value.startswith("inputs."))
    labels = {value: label_of(value, results.case) for value in known}
    values = [value for value, label in labels.items() if label.name != value and not label.successor]
    names = []
    for value in values if axes else ():
        on_map, lines = map_files(value)
        names += [on_map, lines] if "y" in axes and results.design == "grid" else [lines]
    return [SENSITIVITY_FIGURE, *names] if results.design == "sobol" else names


def with_axes(results: SweepResults, name: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Options of a figure by its name, with the default axes where none are given. Raises InputError if the
    name is the name of a value.
    """
    if name in known_values(results):
        raise InputError("figure", got=f"{shown(name)}, a value;", takes=f"value={name!r} instead of a name")
    if not name.startswith(("map_", "lines_")):
        return dict(options)
    if options.get("x") and (name.startswith("map_") or results.design != "grid"):
        return dict(options)
    return {**default_axes(results, options), **options}
