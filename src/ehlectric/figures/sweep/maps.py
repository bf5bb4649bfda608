"""Map of a value over two varied keys of a sweep, with the applied voltage drawn in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import AbstractPathEffect, withStroke
from matplotlib.tri import Triangulation

from ehlectric.arrays import Array, Mask
from ehlectric.figures.axes import COLOURS, by_logarithm, colour_bar, is_wide, levels_of, norm_of, scale_axis
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.figures.sweep.points import dot_size, kind_handles, kinds, labelled, mark, voltage_text
from ehlectric.sweep.interpolation import Surface, applied_at, spaced_log, surface_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice, take

_BREAKS = "////"


def value_map(
    results: SweepResults,
    x: str,
    y: str,
    value: str,
    *,
    at: Mapping[str, str] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Map of a value over two varied keys.

    Parameters
    ----------
    results : SweepResults
        What to draw.
    x, y : str
        Varied keys whose values are numbers.
    value : str
        Dotted key of the summary.
    at : mapping, optional
        What is held, by varied key, where more than two vary.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With a colour bar. Filled between points that all have a value, linearly in the axes as they are drawn
        (the logarithm of positive values where an axis is logarithmic); other points are marked in a hole.
        Values of ``discharge``, and breakdown voltages of a bearing, have the line on which the breakdown
        voltage is the applied one, the side that breaks down hatched.

    Raises
    ------
    InputError
        As for ``take``.
    """
    taken = take(results, x, y, value, at)
    taken.check_numeric()
    ax = axes_or_new(ax)
    across = np.array(taken.across)
    logs = {"log_x": spaced_log(results, x, taken.along), "log_y": spaced_log(results, y, across)}
    (name_x, scale_x), (name_y, scale_y) = labelled(results, x, taken.along), labelled(results, y, across)
    along, up = scale_x.factor * taken.along, scale_y.factor * across
    scale_axis(ax.xaxis, name_x.axis(scale_x), values=along, log=logs["log_x"])
    scale_axis(ax.yaxis, name_y.axis(scale_y), values=up, log=logs["log_y"])
    surface = surface_of(taken, **logs)
    handles: list[Artist] = list(kind_handles(taken))
    if surface is None:
        handles += _scatter(results, taken, ax, along, up)
    else:
        between = _Between(results, taken, surface, any(logs.values()), (scale_x.factor, scale_y.factor))
        handles += _fill(between, ax)
        for kind, mask in kinds(taken).items():
            # With a white edge, as they lie on dark colours and hatches too.
            look = {"ms": dot_size(taken, 3.4), "mec": "white", "mew": 0.4} if kind == "solved" else {}
            mark(ax, kind, along[mask], up[mask], **look)
    ax.use_sticky_edges = False  # points on the edge of the sweep lie clear of the frame
    ax.margins(0.03)
    legend_above(ax, handles)
    return ax


@dataclass(frozen=True)
class _Between:
    """A slice with its surface, whether an axis is logarithmic, and the factors of the units of both axes."""

    results: SweepResults
    taken: Slice
    surface: Surface
    log_axis: bool
    factors: tuple[float, float]

    def values(self) -> tuple[Array, Mask]:
        """What is drawn, SI, as ``Surface.at_nodes`` gives it."""
        return (
            self.margins()
            if self.taken.value == self.taken.breakdown.margin
            else self._at_nodes(self.taken.values)
        )

    def margins(self) -> tuple[Array, Mask]:
        """Breakdown voltage over applied voltage, each between the points for itself."""
        taken = self.taken
        breaks = np.where(taken.margin > 0.0, taken.margin * taken.voltage, np.nan)
        nodes, whole = self._at_nodes(breaks)
        applied = applied_at(self.results, taken, self.surface.x, self.surface.y)
        return nodes / (self._at_nodes(taken.voltage)[0] if applied is None else applied), whole

    def _at_nodes(self, values: Array) -> tuple[Array, Mask]:
        return self.surface.at_nodes(values, log=by_logarithm(values, log_axis=self.log_axis))

    def triangles(self, whole: Mask) -> Triangulation:
        """Those that have values throughout, in the units of the axes."""
        x, y = self.factors[0] * self.surface.x, self.factors[1] * self.surface.y
        return Triangulation(x, y, self.surface.triangles, mask=~whole)


def _fill(between: _Between, ax: Axes) -> list[Artist]:
    """Colours between round levels, with their bar, and of a discharge where the film breaks down."""
    taken = between.taken
    label, scale = labelled(between.results, taken.value, taken.values)
    values = scale.factor * taken.values
    log = is_wide(values)
    levels = levels_of(values, log=log)
    norm = norm_of(levels, log=log)
    nodes, whole = between.values()
    handles: list[Artist] = []
    if np.any(whole):
        drawn = between.triangles(whole), scale.factor * nodes
        # A value on the last level, as a probability of 1, is not below it, and so would have no colour.
        bounds = [*levels[:-1], levels[-1] + 1e-9 * (levels[-1] - levels[0])]
        ax.tricontourf(*drawn, levels=bounds, norm=norm, cmap=COLOURS)
        ax.tricontour(*drawn, levels=levels, colors="white", linewidths=0.4, linestyles="-")
        handles += _breakdown(between, ax)
    alone = between.surface.alone(taken.values)
    if np.any(alone):
        at = between.factors[0] * taken.along, between.factors[1] * np.array(taken.across)
        look = {"c": values, "cmap": COLOURS, "norm": norm, "s": 40.0}
        handles += _dots(taken, ax, at, alone, look, beside=bool(np.any(whole)))
    colour_bar(ax, norm, label.axis(scale), levels)
    return handles


def _breakdown(between: _Between, ax: Axes) -> list[Artist]:
    """The line on which the film breaks down at the applied voltage, the side where it does, their legend."""
    if not between.taken.of_discharge:
        return []
    margin, whole = between.margins()
    if not np.any(whole):
        return []
    shown = margin[between.surface.triangles[whole]]
    least, most = float(np.min(shown)), float(np.max(shown))
    about, volts = between.taken.breakdown, voltage_text(between.taken)
    whose = f"the {about.whose} {volts}"
    if least >= 1.0:
        where = " where filled" * bool(np.any(between.surface.alone(between.taken.margin)))
        return [Line2D([], [], ls="none", label=f"{about.name} above {whose}{where}")]
    drawn = between.triangles(whole), margin
    ax.tricontourf(*drawn, levels=[min(0.5 * least, 0.5), 1.0], colors="none", hatches=[_BREAKS])
    hatched = Patch(facecolor="none", edgecolor="black", hatch=_BREAKS, lw=0.0)
    if most <= 1.0:
        hatched.set_label(f"{about.name} below {whose}")
        return [hatched]
    line = ax.tricontour(*drawn, levels=[1.0], colors="black", linewidths=1.8)
    line.set_path_effects([cast("AbstractPathEffect", withStroke(linewidth=3.2, foreground="white"))])
    hatched.set_label(f"below {whose}")
    return [Line2D([], [], color="black", lw=1.8, label=f"{about.name} = {about.whose} {volts}"), hatched]


def _dots(
    taken: Slice,
    ax: Axes,
    at: tuple[Array, Array],
    some: Mask,
    look: Mapping[str, Any],
    *,
    beside: bool = False,
) -> list[Artist]:
    """Points by themselves, coloured by their value; of a discharge by their side of the applied voltage.

    ``beside`` what is filled, which has a legend of its own, they are said to be alone.
    """
    parts = {"": (some, "o")}
    if taken.of_discharge and np.any(np.isfinite(taken.margin[some])):
        low, about = some & (taken.margin < 1.0), taken.breakdown
        whose = f"the {about.whose} {voltage_text(taken)}"
        parts = {
            f"{'alone,' if beside else about.name} above {whose}": (some & ~low, "o"),
            f"{'alone, ' if beside else ''}below {whose}": (low, "v"),
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


def _scatter(results: SweepResults, taken: Slice, ax: Axes, along: Array, up: Array) -> list[Artist]:
    """Points coloured by their value, where nothing is known between them, and their legend."""
    label, scale = labelled(results, taken.value, taken.values)
    values = scale.factor * taken.values
    masks = kinds(taken)
    for kind in masks.keys() - {"solved"}:
        mark(ax, kind, along[masks[kind]], up[masks[kind]])
    log = is_wide(values)
    levels = levels_of(values, log=log)
    norm = norm_of(levels, log=log)
    colour_bar(ax, norm, label.axis(scale), levels)
    look = {"c": values, "cmap": COLOURS, "norm": norm, "s": 26.0}
    return _dots(taken, ax, (along, up), masks["solved"], look)
