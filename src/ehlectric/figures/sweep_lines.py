"""Line plots of a sweep: a value of the summaries over one varied key, one line per value of a second key."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D

from ehlectric.arrays import Array, IntArray
from ehlectric.figures.data import Panel, with_unit
from ehlectric.figures.draw import draw_area, draw_curves
from ehlectric.figures.figure_names import literal
from ehlectric.figures.style import (
    axes_or_new,
    broken,
    colour_bar,
    figure_of,
    legend_above,
    levels_of,
    line_colours,
    norm_of,
    round_numbers,
    scale_axis,
)
from ehlectric.figures.sweep_panels import NAMED, labelled, lines_of, lines_panel
from ehlectric.figures.sweep_points import mark, mark_handles
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.palette import GREY
from ehlectric.readable import readable
from ehlectric.sweep import Slice, SweepResults, select_slice

# Points without a value are marked in a strip below the values. As fractions of the height of the axes: the
# smallest height of the strip, the height of one mark if several have nearly the same x, and the largest
# height of the strip, at which marks may overlap.
_STRIP, _ROW, _MOST = 0.09, 0.035, 0.28

# Number of crosses that fit side by side into the width of the axes.
_COLUMNS = 50


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
    interpolated between points as in a map. Raises InputError if
    ``ehlectric.sweep.slices.select_slice`` refuses the keys or values.
    """
    selection = select_slice(results, x, y, value, at)
    ax = axes_or_new(ax)
    along, panel = lines_panel(results, selection, _shades)
    dots = [curve for curve in panel.curves if curve.marker == "dots"]
    rings = [curve for curve in panel.curves if curve.marker == "wide circle"]
    places = np.concatenate([curve.x for curve in (*dots, *panel.missing)])
    scale_axis(ax.xaxis, along.title, values=places, log=along.log)
    values = np.concatenate([curve.y for curve in panel.curves if curve.marker or curve.dash == "dash"])
    scale_axis(ax.yaxis, with_unit(panel.title, panel.unit), values=values, log=panel.log)
    ax.set(xlim=along.window, ylim=(panel.bottom, panel.top))
    draw_curves([curve for curve in panel.curves if not curve.marker], ax)
    for area in panel.areas:
        draw_area(area, ax)
    for curve in (*dots, *rings):
        mark(ax, curve)
    # The marks on the axes have the colours of their lines.
    grey = {} if y is None else {"color": GREY}
    handles: list[Artist] = [*mark_handles((*dots, *panel.missing), **grey), *mark_handles(rings)]
    handles += ax.get_legend_handles_labels()[0]
    _strip(panel, ax)
    if y is not None:
        _name_lines(results, selection, ax)
    legend_above(ax, handles)
    return ax


def _shades(places: Array) -> list[str]:
    """Colours of lines from dark to light at places from 0 to 1."""
    return [to_hex(colour) for colour in line_colours()(places)]


def _strip(panel: Panel, ax: Axes) -> None:
    """Draw a strip below the values that marks the points without one, stacked if x is nearly equal."""
    if not panel.missing:
        return
    ranks: Counter[int] = Counter()
    placed = []
    for curve in panel.missing:
        heights = []
        for column in _columns(ax, curve.x).tolist():
            ranks[column] += 1
            heights.append(ranks[column])
        placed.append(replace(curve, y=np.array(heights)))
    rows = max(ranks.values()) + 1
    part = min(max(_STRIP, _ROW * rows), _MOST)
    for curve in placed:
        above = replace(curve, y=part * curve.y / rows)
        mark(ax, above, transform=ax.get_xaxis_transform(), path_effects=[])
    low, high = ax.get_ylim()
    ticks = [tick for tick in ax.get_yticks() if low <= tick <= high]
    if ax.get_yscale() == "log":
        ratio = (high / low) ** (part / (1.0 - part))
        bottom, middle = low / ratio, low / ratio**0.5
    else:
        height = (high - low) * part / (1.0 - part)
        bottom, middle = low - height, low - 0.5 * height
    ax.axhspan(bottom, low, color="white", lw=0.0, zorder=2.9)
    ax.axhline(low, color="black", lw=0.5, zorder=2.91)
    ax.set_yticks([middle, *ticks], labels=["no value", *(f"{tick:g}" for tick in ticks)])
    ax.set_ylim(bottom, high)


def _columns(ax: Axes, along: Array) -> IntArray:
    """Number of the column that each x lies in, where a column is as wide as a cross."""
    places = ax.transScale.transform(np.column_stack([along, np.full(along.size, ax.get_ylim()[1])]))
    across = np.asarray(ax.transLimits.transform(places))[:, 0]
    return np.asarray(np.floor(_COLUMNS * across), dtype=np.intp)


# Size of the name of the second key next to the lines [pt], and part of the page's width that it may take.
_NAME_SIZE, _NAMES = 8.0, 0.22


def _name_lines(results: SweepResults, selection: Slice, ax: Axes) -> None:
    """Name the lines next to the axes by their second key: in a legend or by a colour bar."""
    assert selection.y is not None
    lines, log = lines_of(results, selection, _shades)
    numbers = np.array([line.value for line in lines]) if selection.numeric else np.empty(0)
    label, scale = labelled(results, selection.y, numbers)
    if selection.numeric and len(lines) > NAMED:
        scaled = scale.of(numbers)
        levels = round_numbers(scaled.min(), scaled.max()) if log else levels_of(scaled, log=False)
        inside = levels[(levels >= scaled.min()) & (levels <= scaled.max())]
        norm = norm_of(scaled[[np.argmin(scaled), np.argmax(scaled)]], log=log)
        colour_bar(ax, norm, label.axis(scale), inside, line_colours())
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
