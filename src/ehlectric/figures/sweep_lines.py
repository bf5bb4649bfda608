"""Line plots of a sweep: a value of the summaries over one varied key, one line per value of a second key."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array, IntArray
from ehlectric.figures.data import is_wide
from ehlectric.figures.figure_names import literal
from ehlectric.figures.style import (
    axes_or_new,
    broken,
    by_logarithm,
    colour_bar,
    figure_of,
    legend_above,
    levels_of,
    line_colours,
    norm_of,
    round_numbers,
    scale_axis,
)
from ehlectric.figures.sweep_points import (
    TIME_SHARES,
    dot_size,
    kind_handles,
    kinds,
    labelled,
    mark,
    mark_warned,
    quantile_of,
    share_of,
    voltage_text,
)
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.palette import AMBER, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY
from ehlectric.readable import readable
from ehlectric.sweep.computed_lines import computed_line
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import Slice, applied_at, curve_of, spaced_log, take

_TEXTS = (BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY, "black", GREY)

# Largest number of lines named in a legend; more lines have a colour bar instead.
NAMED = 8


@dataclass(frozen=True)
class SeriesLine:
    """One line: a value of the second key, the numbers of its points by increasing x, and its colour."""

    value: Any
    numbers: IntArray
    colour: Any


@dataclass(frozen=True)
class LinePath:
    """Values between the points of the lines of a slice: computed if a bearing takes a millisecond, and
    otherwise interpolated as in a map over the same axes.
    """

    results: SweepResults
    selection: Slice
    log_x: bool
    log_y: bool

    def values(self, line: SeriesLine) -> tuple[Array, Array]:
        """Values of x along a line and the drawn values there, both in SI units."""
        computed = self._computed(line)
        if computed is not None:
            return computed
        if self.selection.value != self.selection.breakdown.margin:
            return self._curve(self.selection.values, line)
        places, breaks = self._curve(self.selection.margin * self.selection.voltage, line)
        return places, breaks / self.voltages(line)[1]

    def voltages(self, line: SeriesLine) -> tuple[Array, Array]:
        """Values of x along a line, in SI units, and the applied voltage there [V]."""
        places, voltage = self._curve(self.selection.voltage, line)
        applied = applied_at(self.results, self.selection, places, line.value)
        return places, voltage if applied is None else np.where(np.isfinite(voltage), applied, np.nan)

    def _computed(self, line: SeriesLine) -> tuple[Array, Array] | None:
        """Computed line; None if it is interpolated."""
        if self.selection.value in TIME_SHARES or len(self.selection.series()) > NAMED:
            return None
        log = by_logarithm(self.selection.values, log_axis=self.log_x or self.log_y)
        return computed_line(self.results, self.selection, line.numbers, log_x=self.log_x, log=log)

    def _curve(self, values: Array, line: SeriesLine) -> tuple[Array, Array]:
        along, heights = self.selection.along[line.numbers], values[line.numbers]
        if line.numbers.size < 2:
            return along, heights
        if self.selection.value in TIME_SHARES:
            places, quantiles = curve_of(along, quantile_of(heights), log_x=self.log_x, log=False)
            return places, share_of(quantiles)
        log = by_logarithm(values, log_axis=self.log_x or self.log_y)
        return curve_of(along, heights, log_x=self.log_x, log=log)


def lines_of(selection: Slice, *, log: bool) -> list[SeriesLine]:
    """Lines of a slice with their colours.

    Colours go from dark to light with a number; for texts they come from a list of distinct ones.
    """
    series = selection.series()
    if selection.y is None:
        return [SeriesLine(None, numbers, BLUE) for _, numbers in series]
    if not selection.numeric:
        return [SeriesLine(value, n, _TEXTS[k % len(_TEXTS)]) for k, (value, n) in enumerate(series)]
    if len(series) <= NAMED:
        places = np.linspace(0.0, 1.0, len(series))
    else:
        values = np.array([value for value, _ in series])
        places = np.asarray(colours_between(values, log=log)(values))
    colours = line_colours()
    return [SeriesLine(value, n, colours(place)) for (value, n), place in zip(series, places, strict=True)]


def joined(selection: Slice, lines: list[SeriesLine]) -> bool:
    """Whether points are joined by lines: those of a line differ in x only, and some line has two of them."""
    return not selection.free and max(line.numbers.size for line in lines) > 1


def colours_between(values: Array, *, log: bool) -> Normalize:
    """Normalisation of colours of many lines, from the smallest value of the second key to the largest."""
    return norm_of(np.array([values.min(), values.max()]), log=log)


# Points without a value are marked in a strip below the values. As fractions of the height of the axes: the
# smallest height of the strip, the height of one mark if several have nearly the same x, and the largest
# height of the strip, at which marks may overlap.
_STRIP, _ROW, _MOST = 0.09, 0.035, 0.28

# Number of crosses that fit side by side into the width of the axes.
_COLUMNS = 50

# A line with at most so many points is drawn thin [pt].
_SPARSE, _THIN = 6, 0.7

# The vertical axis of positive values begins at zero if the smallest is below this part of the largest.
_FROM_ZERO = 0.5


def value_lines(
    results: SweepResults,
    x: str,
    y: str | None,
    value: str,
    *,
    at: Mapping[str, str] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a value of the summaries over one varied key, with a line for each value of a second key.

    ``y``, second varied key, of numbers or texts; None for a single line; Returns axes with the lines,
    interpolated between points as in a map. Raises InputError if ``ehlectric.sweep.slices.take`` refuses the
    keys or values.
    """
    selection = take(results, x, y, value, at)
    ax = axes_or_new(ax)
    name_x, scale_x = labelled(results, x, selection.along)
    needed = _needed_values(selection)
    name, scale = labelled(results, value, needed)
    along = scale_x.of(selection.along)
    log_y = y is not None and selection.numeric and spaced_log(results, y, np.array(selection.across))
    lines = lines_of(selection, log=log_y)
    together = joined(selection, lines)
    solved = kinds(selection).get("solved", np.zeros(along.size, dtype=bool))
    path = LinePath(results, selection, spaced_log(results, x, selection.along), log_y)
    for line in lines:
        heights = scale.of(selection.values[line.numbers])
        if together:
            places, between = path.values(line)
            # Between few points the line is an assumption: thin, with the points standing out.
            width = _THIN if line.numbers.size <= _SPARSE else None
            ax.plot(scale_x.of(places), scale.of(between), color=line.colour, lw=width)
        dots = solved[line.numbers]
        size = 4.5 if line.numbers.size <= _SPARSE else 3.5
        look = {"color": line.colour, "ms": dot_size(selection, size)}
        mark(ax, "solved", along[line.numbers[dots]], heights[dots], **look)
    scale_axis(ax.xaxis, name_x.axis(scale_x), values=along, log=path.log_x)
    scale_axis(ax.yaxis, name.axis(scale), values=scale.of(needed), log=_is_log(selection))
    ax.margins(x=0.03)
    own = {} if y is None else {"color": GREY}  # the marks on the axes have the colours of their lines
    handles: list[Artist] = [*kind_handles(selection, **own)]
    if selection.of_discharge and value not in selection.breakdown.keys and handles:
        at_voltage = f"at the {selection.breakdown.voltage_name} {voltage_text(selection)}"
        handles[0].set_label(f"{handles[0].get_label()} {at_voltage}")
    handles += [
        *mark_warned(ax, selection, along, scale.of(selection.values)),
        *_applied(path, ax, (scale_x, scale), lines),
    ]
    _limit_values(ax, scale.of(needed))
    _strip(selection, ax, lines, along)
    if y is not None:
        _name_lines(results, selection, ax, lines, log=log_y)
    legend_above(ax, handles)
    return ax


def _is_log(selection: Slice) -> bool:
    """Whether the vertical axis is logarithmic; a share of time, whose ends both matter, has a linear one."""
    return selection.value not in TIME_SHARES and is_wide(selection.values)


def _needed_values(selection: Slice) -> Array:
    """Values that the vertical axis must include: the drawn ones, and those for the applied voltage."""
    if selection.value == selection.breakdown.value:
        return np.concatenate([selection.values, selection.voltage])
    if selection.value == selection.breakdown.margin:
        return np.append(selection.values, 1.0)
    return selection.values


def _applied(path: LinePath, ax: Axes, scales: tuple[Scale, Scale], lines: list[SeriesLine]) -> list[Artist]:
    """Draw the value that corresponds to the applied voltage, and return its legend entries."""
    selection, (scale_x, scale) = path.selection, scales
    volts = selection.voltage[np.isfinite(selection.voltage)]
    if not (selection.of_discharge and volts.size) or selection.value not in selection.breakdown.keys:
        return []
    about, applied = selection.breakdown, voltage_text(selection)
    text = f"{about.voltage_name} {applied}"
    if selection.value == selection.breakdown.margin:
        # A margin of 1 is where breakdown voltage and applied voltage are equal.
        level, text = scale.of(1.0), f"margin 1 at {applied}"
    elif np.ptp(volts) <= 1e-9 * volts[0]:
        level = scale.of(float(volts[0]))
    elif not joined(selection, lines):
        ax.axhspan(scale.of(volts.min()), scale.of(volts.max()), color=GREY, alpha=0.15, lw=0.0)
        return [Patch(facecolor=GREY, alpha=0.15, label=text)]
    else:
        # The applied voltage differs from point to point: it is drawn along each line, in its colour, and no
        # range below it is shaded.
        for line in lines:
            places, voltages = path.voltages(line)
            ax.plot(scale_x.of(places), scale.of(voltages), color=line.colour, ls="--", lw=0.9)
        return [Line2D([], [], color=GREY, ls="--", lw=0.9, label=text)]
    ax.axhline(level, color="black", ls="--", lw=1.2, zorder=3.0)
    floor = 1e-3 * level if ax.get_yscale() == "log" else min(0.0, ax.get_ylim()[0])
    ax.axhspan(floor, level, color=GREY, alpha=0.15, lw=0.0)
    below = Patch(facecolor=GREY, alpha=0.15, label=f"below {about.voltage_name}")
    return [Line2D([], [], color="black", ls="--", lw=1.2, label=text), below]


def _limit_values(ax: Axes, values: Array) -> None:
    """Set the range of the vertical axis: the range of the values with some room, or from zero."""
    finite = values[np.isfinite(values)]
    low, high = float(finite.min()), float(finite.max())
    if ax.get_yscale() == "log":
        room = (high / low) ** 0.05
        ax.set_ylim(low / room, high * room)
    elif 0.0 <= low < _FROM_ZERO * high:
        ax.set_ylim(0.0, 1.06 * high)
    else:
        room = 0.06 * (high - low) or 0.01 * abs(high) or 1.0
        ax.set_ylim(low - room, high + room)


def _strip(selection: Slice, ax: Axes, lines: list[SeriesLine], along: Array) -> None:
    """Draw a strip below the values that marks the points without one, stacked if x is nearly equal."""
    missing = {kind: mask for kind, mask in kinds(selection).items() if kind != "solved"}
    if not missing:
        return
    ax.autoscale_view(scaley=False)
    columns = _columns(ax, along)
    ranks: Counter[int] = Counter()
    # Numbers of points and their ranks in the column, by what their marks look like.
    placed: dict[tuple[str, Any], list[tuple[int, int]]] = {}
    for line in lines:
        for number in line.numbers:
            for kind, mask in missing.items():
                if mask[number]:
                    column = int(columns[number])
                    ranks[column] += 1
                    placed.setdefault((kind, line.colour), []).append((number, ranks[column]))
    rows = max(ranks.values()) + 1
    part = min(max(_STRIP, _ROW * rows), _MOST)
    for (kind, colour), some in placed.items():
        own = {"path_effects": []} | ({} if selection.y is None else {"color": colour})
        numbers, height = np.array(some).T
        mark(ax, kind, along[numbers], part * height / rows, transform=ax.get_xaxis_transform(), **own)
    low, high = ax.get_ylim()
    ticks = [tick for tick in ax.get_yticks() if low <= tick <= high]
    if ax.get_yscale() == "log":
        ratio = (high / low) ** (part / (1.0 - part))
        bottom, middle = low / ratio, low / ratio**0.5
    else:
        height = (high - low) * part / (1.0 - part)
        bottom, middle = low - height, low - 0.5 * height
    ax.axhspan(bottom, low, color="white", lw=0.0, zorder=2.0)
    ax.axhline(low, color="black", lw=0.5, zorder=2.1)
    ax.set_yticks([middle, *ticks], labels=["no value", *(f"{tick:g}" for tick in ticks)])
    ax.set_ylim(bottom, high)


def _columns(ax: Axes, along: Array) -> IntArray:
    """Number of the column that each x lies in, where a column is as wide as a cross."""
    places = ax.transScale.transform(np.column_stack([along, np.full(along.size, ax.get_ylim()[1])]))
    across = np.asarray(ax.transLimits.transform(places))[:, 0]
    return np.asarray(np.floor(_COLUMNS * across), dtype=np.intp)


# Size of the name of the second key beside the lines [pt], and part of the page's width that it may take.
_NAME_SIZE, _NAMES = 8.0, 0.22


def _name_lines(
    results: SweepResults, selection: Slice, ax: Axes, lines: list[SeriesLine], *, log: bool
) -> None:
    """Name the lines beside the axes by their second key: in a legend or by a colour bar."""
    assert selection.y is not None
    numbers = np.array([line.value for line in lines]) if selection.numeric else np.empty(0)
    label, scale = labelled(results, selection.y, numbers)
    if selection.numeric and len(lines) > NAMED:
        scaled = scale.of(numbers)
        levels = round_numbers(scaled.min(), scaled.max()) if log else levels_of(scaled, log=False)
        inside = levels[(levels >= scaled.min()) & (levels <= scaled.max())]
        colour_bar(ax, colours_between(scaled, log=log), label.axis(scale), inside, line_colours())
        return
    handles = [
        Line2D([], [], color=line.colour, marker="o", ms=3.5, label=_line_name(line.value, scale))
        for line in lines
    ]
    unit = f"{label.symbol} {f'[{scale.unit}]' if scale.unit else ''}".strip()
    room = _NAMES * 72.0 * figure_of(ax).get_figwidth()
    named = ax.legend(
        handles=handles[::-1] if selection.numeric else handles,
        title="\n".join(filter(None, [*broken(label.name, _NAME_SIZE, room), unit])),
        alignment="left",
        loc="center left",
        bbox_to_anchor=(1.01, 0.5),
        frameon=False,
        title_fontsize=_NAME_SIZE,
    )
    ax.add_artist(named)
    named.set_clip_on(False)  # the legend lies outside the axes


def _line_name(value: Any, scale: Scale) -> str:
    return readable(scale.of(value), 4) if isinstance(value, int | float) else literal(str(value))
