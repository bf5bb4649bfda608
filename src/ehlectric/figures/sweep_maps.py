"""Maps of a sweep: a value of the summaries over two varied keys, and where the film breaks down."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array
from ehlectric.figures.category_maps import draw_categories
from ehlectric.figures.data import MapPanel, with_unit
from ehlectric.figures.style import (
    COLOURS,
    axes_or_new,
    colour_bar,
    legend_above,
    levels_of,
    norm_of,
    outlined,
    scale_axis,
)
from ehlectric.figures.sweep_panels import map_panel
from ehlectric.figures.sweep_points import (
    ON_BOX,
    ON_COLOURS,
    draw_regimes,
    label_lines,
    mark,
    mark_handles,
    triangulated,
)
from ehlectric.quantities.palette import GREY, ON_MAP, ORANGE
from ehlectric.readable import readable
from ehlectric.sweep import SweepResults, select_slice

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
    the colours of its regimes and lines at 1, 10, 50 and 99 %. A value that is a text has the colours of its
    names, which the legend lists with their numbers of points. Raises InputError if
    ``ehlectric.sweep.slices.select_slice`` refuses the keys or values, or values of ``y`` are not numbers.
    """
    ax = axes_or_new(ax)
    draw_map(map_panel(results, select_slice(results, x, y, value, at)), ax)
    return ax


def draw_map(panel: MapPanel, ax: Axes) -> None:
    """Draw a map with its axes, its marks, its colour bar and its legend."""
    for axis, along, places in zip((ax.xaxis, ax.yaxis), panel.axes, panel.places, strict=True):
        scale_axis(axis, along.title, values=places, log=along.log)
    rings = [curve for curve in panel.marks if curve.marker == "wide circle"]
    others = [curve for curve in panel.marks if curve.marker != "wide circle"]
    fill = draw_categories if panel.categories else draw_regimes if panel.levels else _fill
    handles = [*mark_handles(others), *fill(panel, ax), *mark_handles(rings)]
    for curve in panel.marks:
        # The white edge keeps the dots visible on dark colours and on hatches.
        mark(ax, curve, **({"mec": "white", "mew": 0.4} if curve.marker == "dots" else {}))
    ax.use_sticky_edges = False  # leaves room between the outer points and the frame
    ax.margins(0.03)
    legend_above(ax, handles)


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
    """Levels without a last one for values that are only slightly above the second last.

    A plateau that scatters around a level, such as events at nearly every edge of a source, would have
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


def _fill(panel: MapPanel, ax: Axes) -> list[Artist]:
    """Colour the map between round levels, and add the colour bar and, where there is one, the limit.

    Returns the legend entries.
    """
    levels = _without_rest(levels_of(panel.values, log=panel.log), panel.values)
    norm, colours = colours_of(levels, log=panel.log)
    handles = _opening(panel, ax)
    if panel.between is not None:
        values = np.clip(_rounded(panel.between.values), levels[0], levels[-1])
        drawn = triangulated(panel.between), values
        # A value equal to the last level, such as a probability of 1, would be outside the colour scale.
        bounds = [*levels[:-1], levels[-1] + 1e-9 * (levels[-1] - levels[0])]
        ax.tricontourf(*drawn, levels=bounds, norm=norm, cmap=colours)
        # Nothing is beyond the first and the last level: a line there would follow the edge of a plateau.
        inner = levels[1:-1] if levels.size > 2 else levels
        if panel.limit is not None and np.array_equal(panel.values, panel.limit.margins, equal_nan=True):
            inner = inner[inner != 1.0]  # the line of breakdown has a name already
        lines = ax.tricontour(*drawn, levels=inner, colors=ON_MAP, linewidths=0.4, linestyles="-")
        entries, taken = _breakdown(panel, ax)
        handles += entries
        label_lines(ax, lines, taken, [readable(level, 6) for level in inner], **ON_COLOURS)
    if np.any(panel.alone):
        handles += _dots(panel, ax, {"c": panel.values, "cmap": colours, "norm": norm, "s": 40.0})
    colour_bar(ax, norm, with_unit(panel.title, panel.unit), levels, colours)
    return handles


def _opening(panel: MapPanel, ax: Axes) -> list[Artist]:
    """Shade cells without a value at whose corners contacts open and close; returns the legend entry."""
    if panel.opening is None:
        return []
    look: dict[str, Any] = {"colors": [ORANGE], "alpha": 0.25, "hatches": [_OPENING]}
    ax.tricontourf(triangulated(panel.opening), panel.opening.values, levels=[0.5, 1.5], **look)
    label = "frequent asperity contact there or nearby: discharges likely, no voltage computed"
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


def _breakdown(panel: MapPanel, ax: Axes) -> tuple[list[Artist], Array]:
    """Draw where breakdown voltage and applied voltage are equal, and hatch where the film breaks down.

    Returns the legend entries, and the positions of points and of the label.
    """
    limit, taken = panel.limit, panel.places.T
    if limit is None or limit.between is None:
        return [], taken
    mesh = limit.between
    shown = mesh.values[mesh.triangles]
    least, most = float(np.min(shown)), float(np.max(shown))
    applied = f"{limit.against} {limit.amount}"
    if least >= 1.0:
        where = " where filled" * bool(np.any(panel.alone))
        label = f"{limit.name} above {applied}{where}"
        return [Patch(facecolor="none", edgecolor=GREY, lw=0.5, label=label)], taken
    drawn = triangulated(mesh), mesh.values
    ax.tricontourf(*drawn, levels=[min(0.5 * least, 0.5), 1.0], colors="none", hatches=[_BREAKS])
    hatched = Patch(facecolor="none", edgecolor="black", hatch=_BREAKS, lw=0.0)
    if most <= 1.0:
        hatched.set_label(f"{limit.name} below {applied}")
        return [hatched], taken
    line = ax.tricontour(*drawn, levels=[1.0], colors="black", linewidths=1.8)
    line.set_path_effects(outlined(3.2))
    taken = label_lines(ax, line, taken, ["margin 1"], **ON_BOX)
    hatched.set_label(f"below {limit.against}")
    return [Line2D([], [], color="black", lw=1.8, label=limit.line), hatched], taken


def _dots(panel: MapPanel, ax: Axes, look: Mapping[str, Any]) -> list[Artist]:
    """Draw points that belong to no cell as dots coloured by their value, and return their legend entries.

    Triangles mark points whose margin is below 1.
    """
    limit, parts = panel.limit, {"": (panel.alone, "o")}
    if limit is not None and np.any(np.isfinite(limit.margins[panel.alone])):
        low, applied = panel.alone & (limit.margins < 1.0), f"{limit.against} {limit.amount}"
        among = panel.between is not None
        parts = {
            f"{'alone,' if among else limit.name} above {applied}": (panel.alone & ~low, "o"),
            f"{'alone, ' if among else ''}below {applied}": (low, "v"),
        }
    for part, shape in parts.values():
        places = panel.places[:, part]
        ax.scatter(
            *places, edgecolors="black", lw=0.5, zorder=4.0, marker=shape, **{**look, "c": look["c"][part]}
        )
    hollow: dict[str, Any] = {"ls": "none", "color": "black", "mfc": "none", "ms": 5.0, "mew": 0.5}
    return [
        Line2D([], [], marker=shape, label=text, **hollow)
        for text, (part, shape) in parts.items()
        if text and np.any(part)
    ]
