"""Maps of a sweep: a value of the summaries over two varied keys, and where the film breaks down."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.tri import Triangulation

from ehlectric.arrays import Array, Mask
from ehlectric.figures.data import is_wide
from ehlectric.figures.style import (
    COLOURS,
    axes_or_new,
    by_logarithm,
    colour_bar,
    legend_above,
    levels_of,
    norm_of,
    outlined,
    scale_axis,
)
from ehlectric.figures.sweep_points import (
    ON_BOX,
    ON_COLOURS,
    TIME_SHARES,
    dot_size,
    fill_regimes,
    kind_handles,
    kinds,
    label_lines,
    labelled,
    mark,
    mark_warned,
    quantile_of,
    regime_handles,
    scatter_regimes,
    voltage_text,
)
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.palette import GREY, ON_MAP, ORANGE
from ehlectric.readable import readable
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import Slice, Surface, applied_at, spaced_log, surface_of, take

# Hatches where the film breaks down, and where contacts open and close.
_BREAKS, _OPENING = "////", "xxx"

# Part of the step between two levels up to which values above the lower one are shown as equal to it.
_REST = 0.01

# Colours of values on both sides of zero.
DIVERGING = colormaps["RdBu_r"]


def value_map(
    results: SweepResults,
    x: str,
    y: str,
    value: str,
    *,
    at: Mapping[str, str] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a map of a value of the summaries over two varied keys.

    Returns axes with the map and a colour bar; cells are coloured if all of their corner points have a value;
    points without one are marked in a hole of the map. Between points the value, or the logarithm of positive
    values if an axis is logarithmic, is linear in the axes as they are drawn. Maps of ``discharge`` values
    and of a bearing's breakdown voltages have a line on which the breakdown voltage equals the applied
    voltage; the side that breaks down is hatched. Maps of the share of time in which a bearing conducts have
    the colours of its regimes and lines at 1, 10, 50 and 99 %. Raises InputError if
    ``ehlectric.sweep.slices.take`` refuses the keys or values, or values of ``y`` are not numbers.
    """
    selection = take(results, x, y, value, at)
    selection.check_numeric()
    ax = axes_or_new(ax)
    across = np.array(selection.across)
    logs = {"log_x": spaced_log(results, x, selection.along), "log_y": spaced_log(results, y, across)}
    (name_x, scale_x), (name_y, scale_y) = labelled(results, x, selection.along), labelled(results, y, across)
    along, up = scale_x.of(selection.along), scale_y.of(across)
    scale_axis(ax.xaxis, name_x.axis(scale_x), values=along, log=logs["log_x"])
    scale_axis(ax.yaxis, name_y.axis(scale_y), values=up, log=logs["log_y"])
    surface = surface_of(selection, **logs)
    handles: list[Artist] = list(kind_handles(selection))
    if surface is None:
        handles += _scatter(results, selection, ax, along, up)
    else:
        between = _Between(results, selection, surface, any(logs.values()), (scale_x, scale_y))
        handles += _fill(between, ax)
        for kind, mask in kinds(selection).items():
            # The white edge keeps the dots visible on dark colours and on hatches.
            look = {"ms": dot_size(selection, 3.4), "mec": "white", "mew": 0.4} if kind == "solved" else {}
            mark(ax, kind, along[mask], up[mask], **look)
    handles += mark_warned(ax, selection, along, up)
    ax.use_sticky_edges = False  # leaves room between the outer points and the frame
    ax.margins(0.03)
    legend_above(ax, handles)
    return ax


@dataclass(frozen=True)
class _Between:
    """Interpolation between the points of a slice over two keys."""

    results: SweepResults
    selection: Slice
    surface: Surface  # nodes and triangles between its points
    log_axis: bool  # whether one of the axes is logarithmic
    scales: tuple[Scale, Scale]  # units of the horizontal and the vertical axis

    def values(self) -> tuple[Array, Mask]:
        """Drawn values at the nodes, in SI units, and mask of the triangles with values throughout."""
        if self.selection.value == self.selection.breakdown.margin:
            return self.margins()
        return self._at_nodes(self.selection.values)

    def margins(self) -> tuple[Array, Mask]:
        """Margin of the breakdown voltage at the nodes, and mask of the triangles with values throughout.

        The margin is breakdown voltage divided by applied voltage. The voltages are interpolated before the
        division.
        """
        selection = self.selection
        breaks = np.where(selection.margin > 0.0, selection.margin * selection.voltage, np.nan)
        nodes, whole = self._at_nodes(breaks)
        applied = applied_at(self.results, selection, self.surface.x, self.surface.y)
        return nodes / (self._at_nodes(selection.voltage)[0] if applied is None else applied), whole

    def _at_nodes(self, values: Array) -> tuple[Array, Mask]:
        return self.surface.at_nodes(values, log=by_logarithm(values, log_axis=self.log_axis))

    def places(self) -> Array:
        """Positions of the points, in the units of the axes, shape (points, 2)."""
        at = (self.selection.along, np.array(self.selection.across))
        return np.column_stack([scale.of(of) for scale, of in zip(self.scales, at, strict=True)])

    def triangles(self, whole: Mask) -> Triangulation:
        """Triangles with values throughout, in the units of the axes."""
        x, y = self.scales[0].of(self.surface.x), self.scales[1].of(self.surface.y)
        return Triangulation(x, y, self.surface.triangles, mask=~whole)


def _rounded(values: Array) -> Array:
    """Interpolated values without their rounding errors, by which a plateau at a level would be speckled.

    Examples
    --------
    >>> _rounded(np.array([60000.00000000001, 0.04999999999999998, 0.0, -1e-9])).tolist()
    [60000.0, 0.05, 0.0, -1e-09]
    """
    sizes = np.abs(values)
    factors = 10.0 ** (11.0 - np.floor(np.log10(sizes, out=np.zeros_like(sizes), where=sizes > 0.0)))
    return np.asarray(np.rint(values * factors) / factors)


def _without_rest(levels: Array, values: Array) -> Array:
    """Levels without a last one for values that are hardly above the last but one.

    A plateau that scatters around a level, as that of events at nearly every edge of a source, would have
    lines through it that mean nothing.

    Examples
    --------
    >>> _without_rest(np.array([55e3, 60e3, 65e3]), np.array([56e3, 60005.0]))
    array([55000., 60000.])
    """
    if levels.size < 3:
        return levels
    over = float(np.nanmax(values)) - levels[-2]
    return levels[:-1] if over < _REST * (levels[-1] - levels[-2]) else levels


def _fill(between: _Between, ax: Axes) -> list[Artist]:
    """Colour the map between round levels, and add the colour bar and, of a discharge, the breakdown line.

    Returns the legend entries.
    """
    selection = between.selection
    if selection.value in TIME_SHARES:
        return _regimes(between, ax)
    label, scale = labelled(between.results, selection.value, selection.values)
    values = scale.of(selection.values)
    log = is_wide(values)
    levels = _without_rest(levels_of(values, log=log), values)
    norm, colours = colours_of(levels, log=log)
    nodes, whole = between.values()
    handles = _intermittent(between, whole, ax)
    if np.any(whole):
        drawn = between.triangles(whole), np.clip(_rounded(scale.of(nodes)), levels[0], levels[-1])
        # A value equal to the last level, such as a probability of 1, would be outside the colour scale.
        bounds = [*levels[:-1], levels[-1] + 1e-9 * (levels[-1] - levels[0])]
        ax.tricontourf(*drawn, levels=bounds, norm=norm, cmap=colours)
        # Nothing is beyond the first and the last level: a line there would follow the edge of a plateau.
        inner = levels[1:-1] if levels.size > 2 else levels
        if selection.of_discharge and np.array_equal(selection.values, selection.margin, equal_nan=True):
            inner = inner[inner != 1.0]  # the line of breakdown has a name already
        lines = ax.tricontour(*drawn, levels=inner, colors=ON_MAP, linewidths=0.4, linestyles="-")
        entries, taken = _breakdown(between, ax)
        handles += entries
        label_lines(ax, lines, taken, [readable(level, 6) for level in inner], **ON_COLOURS)
    alone = between.surface.alone(selection.values)
    if np.any(alone):
        at = between.scales[0].of(selection.along), between.scales[1].of(np.array(selection.across))
        look = {"c": values, "cmap": colours, "norm": norm, "s": 40.0}
        handles += _dots(selection, ax, at, alone, look, beside=bool(np.any(whole)))
    colour_bar(ax, norm, label.axis(scale), levels, colours)
    return handles


def _regimes(between: _Between, ax: Axes) -> list[Artist]:
    """Colour the regimes of bearings by their share of time with contact; returns the legend entries."""
    shares = between.selection.values
    quantiles, whole = between.surface.at_nodes(quantile_of(shares))
    alone = between.surface.alone(shares)
    scatter_regimes(between.places(), shares, alone, ax)
    if not np.any(whole):
        return regime_handles()
    return fill_regimes(between.triangles(whole), quantiles, between.places(), ax)


def _intermittent(between: _Between, whole: Mask, ax: Axes) -> list[Artist]:
    """Shade cells without a value at whose corners contacts open and close; returns the legend entry.

    Without it, the map would be white there, as if nothing could happen.
    """
    selection = between.selection
    opening = selection.intermittent & ~np.isfinite(selection.values)
    some = np.any(opening[between.surface.corners], axis=1)
    if not np.any(some & ~whole):
        return []
    ones = np.ones_like(between.surface.x)
    look: dict[str, Any] = {"colors": [ORANGE], "alpha": 0.25, "hatches": [_OPENING]}
    ax.tricontourf(between.triangles(some & ~whole), ones, levels=[0.5, 1.5], **look)
    label = "surfaces touch there or nearby: discharges likely, no voltage computed"
    return [Patch(facecolor=(ORANGE, 0.25), edgecolor=GREY, hatch=_OPENING, lw=0.0, label=label)]


def colours_of(levels: Array, *, log: bool) -> tuple[Normalize, Colormap]:
    """Normalisation and colour map of levels: with white at zero where there are values on both sides of it.

    Examples
    --------
    >>> norm, colours = colours_of(np.array([-1.0, 0.0, 3.0]), log=False)
    >>> norm.vmin, norm.vmax, colours.name
    (-3.0, 3.0, 'RdBu_r')
    """
    if levels[0] < 0.0 < levels[-1]:
        reach = float(np.max(np.abs(levels)))
        return Normalize(-reach, reach), DIVERGING
    return norm_of(levels, log=log), COLOURS


def _breakdown(between: _Between, ax: Axes) -> tuple[list[Artist], Array]:
    """Draw where breakdown voltage and applied voltage are equal, and hatch where the film breaks down.

    Returns the legend entries, and the positions of points and of the label.
    """
    taken = between.places()
    if not between.selection.of_discharge:
        return [], taken
    margin, whole = between.margins()
    if not np.any(whole):
        return [], taken
    shown = margin[between.surface.triangles[whole]]
    least, most = float(np.min(shown)), float(np.max(shown))
    about, volts = between.selection.breakdown, voltage_text(between.selection)
    applied = f"{about.voltage_name} {volts}"
    if least >= 1.0:
        where = " where filled" * bool(np.any(between.surface.alone(between.selection.margin)))
        label = f"{about.name} above {applied}{where}"
        return [Patch(facecolor="none", edgecolor=GREY, lw=0.5, label=label)], taken
    drawn = between.triangles(whole), margin
    ax.tricontourf(*drawn, levels=[min(0.5 * least, 0.5), 1.0], colors="none", hatches=[_BREAKS])
    hatched = Patch(facecolor="none", edgecolor="black", hatch=_BREAKS, lw=0.0)
    if most <= 1.0:
        hatched.set_label(f"{about.name} below {applied}")
        return [hatched], taken
    line = ax.tricontour(*drawn, levels=[1.0], colors="black", linewidths=1.8)
    line.set_path_effects(outlined(3.2))
    taken = label_lines(ax, line, taken, ["margin 1"], **ON_BOX)
    hatched.set_label(f"below {about.voltage_name}")
    return [Line2D([], [], color="black", lw=1.8, label=f"margin 1 at {volts}"), hatched], taken


def _dots(
    selection: Slice,
    ax: Axes,
    at: tuple[Array, Array],
    some: Mask,
    look: Mapping[str, Any],
    *,
    beside: bool = False,
) -> list[Artist]:
    """Draw points as dots coloured by their value, and return their legend entries.

    Of a discharge, triangles mark points whose breakdown voltage is below the applied voltage.

    ``some``, the points that are drawn, shape (points,).
    """
    parts = {"": (some, "o")}
    if selection.of_discharge and np.any(np.isfinite(selection.margin[some])):
        low, about = some & (selection.margin < 1.0), selection.breakdown
        applied = f"{about.voltage_name} {voltage_text(selection)}"
        parts = {
            f"{'alone,' if beside else about.name} above {applied}": (some & ~low, "o"),
            f"{'alone, ' if beside else ''}below {applied}": (low, "v"),
        }
    for part, shape in parts.values():
        own = {**look, "c": look["c"][part], "marker": shape}
        ax.scatter(at[0][part], at[1][part], edgecolors="black", lw=0.5, zorder=4.0, **own)
    hollow: dict[str, Any] = {"ls": "none", "color": "black", "mfc": "none", "ms": 5.0, "mew": 0.5}
    return [
        Line2D([], [], marker=shape, label=text, **hollow)
        for text, (part, shape) in parts.items()
        if text and np.any(part)
    ]


def _scatter(results: SweepResults, selection: Slice, ax: Axes, along: Array, up: Array) -> list[Artist]:
    """Draw the points as dots coloured by their value, without interpolation; returns the legend entries."""
    label, scale = labelled(results, selection.value, selection.values)
    values = scale.of(selection.values)
    masks = kinds(selection)
    for kind in masks.keys() - {"solved"}:
        mark(ax, kind, along[masks[kind]], up[masks[kind]])
    log = is_wide(values)
    levels = levels_of(values, log=log)
    norm, colours = colours_of(levels, log=log)
    colour_bar(ax, norm, label.axis(scale), levels, colours)
    look = {"c": values, "cmap": colours, "norm": norm, "s": 26.0}
    return _dots(selection, ax, (along, up), masks["solved"], look)
