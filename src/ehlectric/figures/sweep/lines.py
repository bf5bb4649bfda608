"""A value over one varied key of a sweep, a line for each value of a second one, and the applied voltage."""

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
from ehlectric.figures.axes import (
    DARK_COLOURS,
    by_logarithm,
    colour_bar,
    is_wide,
    levels_of,
    norm_of,
    round_numbers,
    scale_axis,
)
from ehlectric.figures.style import BLUE, GREEN, GREY, ORANGE, axes_or_new, legend_above
from ehlectric.figures.sweep.points import dot_size, kind_handles, kinds, labelled, mark, voltage_text
from ehlectric.sweep.interpolation import applied_at, curve_of, spaced_log
from ehlectric.sweep.labels import Scale
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice, take

_TEXTS = (BLUE, ORANGE, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "black", GREY)

# Lines that a legend names; more are told apart by a colour bar.
_NAMED = 8

# Below the values is a strip for points that have none: its least height, and the height of each of those of
# one x, in parts of the height of the axes; and its largest, in which they may overlap.
_STRIP, _ROW, _MOST = 0.09, 0.035, 0.28

# Crosses side by side in the width of the axes.
_COLUMNS = 50

# A positive value is drawn from zero where its least is below this part of its largest.
_FROM_ZERO = 0.5


@dataclass(frozen=True)
class _Line:
    """Points of one value of the second key, by increasing x, and their colour."""

    value: Any
    numbers: IntArray
    colour: Any


@dataclass(frozen=True)
class _Path:
    """What lines are between the points of a slice, as a map over the same axes has it."""

    results: SweepResults
    taken: Slice
    log_x: bool
    log_y: bool

    def values(self, line: _Line) -> tuple[Array, Array]:
        """Places and what is drawn there, SI."""
        if self.taken.value != self.taken.breakdown.margin:
            return self._curve(self.taken.values, line)
        places, breaks = self._curve(self.taken.margin * self.taken.voltage, line)
        return places, breaks / self.voltages(line)[1]

    def voltages(self, line: _Line) -> tuple[Array, Array]:
        """Places and the applied voltage there [V]."""
        places, voltage = self._curve(self.taken.voltage, line)
        applied = applied_at(self.results, self.taken, places, line.value)
        return places, voltage if applied is None else np.where(np.isfinite(voltage), applied, np.nan)

    def _curve(self, values: Array, line: _Line) -> tuple[Array, Array]:
        along, heights = self.taken.along[line.numbers], values[line.numbers]
        if line.numbers.size < 2:
            return along, heights
        log = by_logarithm(values, log_axis=self.log_x or self.log_y)
        return curve_of(along, heights, log_x=self.log_x, log=log)


def value_lines(
    results: SweepResults,
    x: str,
    y: str | None,
    value: str,
    *,
    at: Mapping[str, str] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """A value over one varied key, a line for each value of a second one.

    Parameters
    ----------
    results : SweepResults
        What to draw.
    x : str
        Varied key whose values are numbers.
    y : str or None
        Varied key, of numbers or texts.
    value : str
        Dotted key of the summary.
    at : mapping, optional
        What is held, by varied key, where more vary.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        A line ends where a point has no value, and is between points as a map is; its cross stands at the
        bottom. Points of a design without lines, as "sobol", are drawn by themselves. A breakdown voltage has
        the applied voltage, a margin 1.

    Raises
    ------
    InputError
        As for ``take``.
    """
    taken = take(results, x, y, value, at)
    ax = axes_or_new(ax)
    name_x, scale_x = labelled(results, x, taken.along)
    shown = _shown_values(taken)
    name, scale = labelled(results, value, shown)
    along = scale_x.factor * taken.along
    log_y = y is not None and taken.numeric and spaced_log(results, y, np.array(taken.across))
    lines = _lines(taken, log=log_y)
    joined = _joined(taken, lines)
    solved = kinds(taken).get("solved", np.zeros(along.size, dtype=bool))
    path = _Path(results, taken, spaced_log(results, x, taken.along), log_y)
    for line in lines:
        heights = scale.factor * taken.values[line.numbers]
        if joined:
            places, between = path.values(line)
            ax.plot(scale_x.factor * places, scale.factor * between, color=line.colour)
        dots = solved[line.numbers]
        look = {"color": line.colour, "ms": dot_size(taken, 3.5)}
        mark(ax, "solved", along[line.numbers[dots]], heights[dots], **look)
    scale_axis(ax.xaxis, name_x.axis(scale_x), values=along, log=path.log_x)
    scale_axis(ax.yaxis, name.axis(scale), values=scale.factor * shown, log=is_wide(taken.values))
    ax.margins(x=0.03)
    own = {} if y is None else {"color": GREY}  # marks have the colours of their lines
    handles: list[Artist] = [*kind_handles(taken, **own), *_applied(path, ax, (scale_x, scale), lines)]
    _limit_values(ax, scale.factor * shown)
    _strip(taken, ax, lines, along)
    if y is not None:
        _name_lines(results, taken, ax, lines, log=log_y)
    legend_above(ax, handles)
    return ax


def _shown_values(taken: Slice) -> Array:
    """Values that the axis must hold: those drawn, and what is drawn in for the applied voltage."""
    if taken.value == taken.breakdown.value:
        return np.concatenate([taken.values, taken.voltage])
    return np.append(taken.values, 1.0) if taken.value == taken.breakdown.margin else taken.values


def _lines(taken: Slice, *, log: bool) -> list[_Line]:
    """Lines with their colours: from dark to light by a number, else of a few that stay apart."""
    series = taken.series()
    if taken.y is None:
        return [_Line(None, numbers, BLUE) for _, numbers in series]
    if not taken.numeric:
        return [_Line(value, n, _TEXTS[k % len(_TEXTS)]) for k, (value, n) in enumerate(series)]
    if len(series) <= _NAMED:
        places = np.linspace(0.0, 1.0, len(series))
    else:
        values = np.array([value for value, _ in series])
        places = np.asarray(_norm(values, log=log)(values))
    return [_Line(value, n, DARK_COLOURS(place)) for (value, n), place in zip(series, places, strict=True)]


def _joined(taken: Slice, lines: list[_Line]) -> bool:
    """Whether points of a line differ in x alone, and some line has two of them."""
    return not taken.free and max(line.numbers.size for line in lines) > 1


def _norm(values: Array, *, log: bool) -> Normalize:
    """Colours of many lines, from the least value to the largest."""
    return norm_of(np.array([values.min(), values.max()]), log=log)


def _applied(path: _Path, ax: Axes, scales: tuple[Scale, Scale], lines: list[_Line]) -> list[Artist]:
    """What the value is at the applied voltage, with its legend."""
    taken, (scale_x, scale) = path.taken, scales
    volts = taken.voltage[np.isfinite(taken.voltage)]
    if not (taken.of_discharge and volts.size):
        return []
    about, applied = taken.breakdown, voltage_text(taken)
    text = f"{about.voltage_name} {applied}"
    if taken.value not in taken.breakdown.keys:
        return [Line2D([], [], ls="none", label=f"at the {text}")]
    if taken.value == taken.breakdown.margin:
        # No voltage but where the two are equal.
        level, text = scale.factor, f"{about.name} = {about.whose} {applied}"
    elif np.ptp(volts) <= 1e-9 * volts[0]:
        level = scale.factor * float(volts[0])
    elif not _joined(taken, lines):
        ax.axhspan(scale.factor * volts.min(), scale.factor * volts.max(), color=GREY, alpha=0.15, lw=0.0)
        return [Patch(facecolor=GREY, alpha=0.15, label=text)]
    else:
        # No one voltage to shade below: that of each point, in the colour of its line.
        for line in lines:
            places, voltages = path.voltages(line)
            ax.plot(scale_x.factor * places, scale.factor * voltages, color=line.colour, ls="--", lw=0.9)
        return [Line2D([], [], color=GREY, ls="--", lw=0.9, label=text)]
    ax.axhline(level, color="black", ls="--", lw=1.2, zorder=3.0)
    floor = 1e-3 * level if ax.get_yscale() == "log" else min(0.0, ax.get_ylim()[0])
    ax.axhspan(floor, level, color=GREY, alpha=0.15, lw=0.0)
    below = Patch(facecolor=GREY, alpha=0.15, label=f"below the {about.whose} {applied}")
    return [Line2D([], [], color="black", ls="--", lw=1.2, label=text), below]


def _limit_values(ax: Axes, values: Array) -> None:
    """Range of the vertical axis: that of the values with some room, or from zero."""
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


def _strip(taken: Slice, ax: Axes, lines: list[_Line], along: Array) -> None:
    """A strip below the values, with the points that have none: those of one x one above the other."""
    missing = {kind: mask for kind, mask in kinds(taken).items() if kind != "solved"}
    if not missing:
        return
    ax.autoscale_view(scaley=False)
    columns = _columns(ax, along)
    ranks: Counter[int] = Counter()
    found = []
    for line in lines:
        for number in line.numbers:
            for kind, mask in missing.items():
                if mask[number]:
                    column = int(columns[number])
                    ranks[column] += 1
                    found.append((kind, number, ranks[column], line.colour))
    rows = max(ranks.values()) + 1
    part = min(max(_STRIP, _ROW * rows), _MOST)
    for kind, number, rank, colour in found:
        own = {"path_effects": []} | ({} if taken.y is None else {"color": colour})
        place = (along[[number]], np.array([part * rank / rows]))
        mark(ax, kind, *place, transform=ax.get_xaxis_transform(), **own)
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
    """Which of some columns as wide as a cross each x lies in."""
    places = ax.transScale.transform(np.column_stack([along, np.full(along.size, ax.get_ylim()[1])]))
    across = np.asarray(ax.transLimits.transform(places))[:, 0]
    return np.asarray(np.floor(_COLUMNS * across), dtype=np.intp)


def _name_lines(results: SweepResults, taken: Slice, ax: Axes, lines: list[_Line], *, log: bool) -> None:
    """Which line is of which value: beside the axes."""
    assert taken.y is not None
    numbers = np.array([line.value for line in lines]) if taken.numeric else np.empty(0)
    label, scale = labelled(results, taken.y, numbers)
    if taken.numeric and len(lines) > _NAMED:
        shown = scale.factor * numbers
        levels = round_numbers(shown.min(), shown.max()) if log else levels_of(shown, log=False)
        inside = levels[(levels >= shown.min()) & (levels <= shown.max())]
        colour_bar(ax, _norm(shown, log=log), label.axis(scale), inside, DARK_COLOURS)
        return
    handles = [
        Line2D([], [], color=line.colour, marker="o", ms=3.5, label=_line_name(line.value, scale))
        for line in lines
    ]
    named = ax.legend(
        handles=handles[::-1] if taken.numeric else handles,
        title="\n".join(
            [label.name, " ".join([label.symbol, f"[{scale.unit}]" if scale.unit else ""])]
        ).strip(),
        loc="center left",
        bbox_to_anchor=(1.01, 0.5),
        frameon=False,
        title_fontsize=8.0,
    )
    ax.add_artist(named)
    named.set_clip_on(False)  # it lies outside of the axes


def _line_name(value: Any, scale: Scale) -> str:
    return f"{scale.factor * value:.4g}" if isinstance(value, int | float) else str(value)
