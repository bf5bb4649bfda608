"""Map of a value over two varied keys of a sweep, with the applied voltage drawn in."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import AbstractPathEffect, withStroke
from matplotlib.tri import Triangulation

from ehlectric.drawing import axes_or_new
from ehlectric.sweep_drawing import (
    COLOURS,
    colour_bar,
    dot_size,
    is_wide,
    kind_handles,
    kinds,
    labelled,
    legend_above,
    levels_of,
    mark,
    norm_of,
    scale_axis,
    voltage_text,
)
from ehlectric.sweep_results import SweepResults
from ehlectric.sweep_slices import Slice, take
from ehlectric.sweep_surfaces import Surface, spaced_log, surface_of
from ehlectric.typing import Array

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
        With a colour bar. Filled between points that are all solved, linearly in the axes as they are drawn;
        points that are not solved are crosses in a hole. Values of ``discharge`` have the line on which the
        breakdown voltage is the applied one, the side that breaks down hatched.

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
        factors = (scale_x.factor, scale_y.factor)
        _fill(results, taken, surface, ax, factors)
        if value.startswith("discharge."):
            handles += _breakdown(taken, surface, ax, factors)
        for kind, mask in kinds(taken).items():
            look = {"ms": dot_size(taken, 2.6)} if kind == "solved" else {}
            mark(ax, kind, along[mask], up[mask], **look)
    ax.use_sticky_edges = False  # points on the edge of the sweep lie clear of the frame
    ax.margins(0.03)
    legend_above(ax, handles)
    return ax


def _triangles(
    surface: Surface, factors: tuple[float, float], values: Array, *, log: bool
) -> tuple[Triangulation, Array] | None:
    """Triangles in the units of the axes and values at their nodes; None where no triangle is whole."""
    nodes, whole = surface.at_nodes(values, log=log)
    if not np.any(whole):
        return None
    x, y = factors[0] * surface.x, factors[1] * surface.y
    return Triangulation(x, y, surface.triangles, mask=~whole), nodes


def _fill(
    results: SweepResults, taken: Slice, surface: Surface, ax: Axes, factors: tuple[float, float]
) -> None:
    """Colours between round levels, with their bar."""
    label, scale = labelled(results, taken.value, taken.values)
    values = scale.factor * taken.values
    if not np.any(np.isfinite(values)):
        return
    log = is_wide(values)
    levels = levels_of(values, log=log)
    norm = norm_of(levels, log=log)
    drawn = _triangles(surface, factors, values, log=log)
    if drawn is not None:
        # A value on the last level, as a probability of 1, is not below it, and so would have no colour.
        bounds = [*levels[:-1], levels[-1] + 1e-9 * (levels[-1] - levels[0])]
        ax.tricontourf(*drawn, levels=bounds, norm=norm, cmap=COLOURS)
        ax.tricontour(*drawn, levels=levels, colors="white", linewidths=0.4, linestyles="-")
    alone = surface.alone(taken.values)
    at = (factors[0] * taken.along[alone], factors[1] * np.array(taken.across)[alone])
    ax.scatter(*at, c=values[alone], s=40.0, cmap=COLOURS, norm=norm, zorder=4.0)
    colour_bar(ax, norm, label.axis(scale), levels)


def _breakdown(taken: Slice, surface: Surface, ax: Axes, factors: tuple[float, float]) -> list[Artist]:
    """The line on which the film breaks down at the applied voltage, the side where it does, their legend."""
    margin = np.where(taken.margin > 0.0, taken.margin, np.nan)
    # As the colours of a breakdown voltage go between the points, so that the line is one of their levels.
    drawn = _triangles(surface, factors, margin, log=is_wide(margin))
    if drawn is None:
        return []
    volts = voltage_text(taken)
    least, most = float(np.nanmin(margin)), float(np.nanmax(margin))
    if least >= 1.0:
        return [Line2D([], [], ls="none", label=f"breakdown voltage above the applied {volts}")]
    side = [min(0.5 * least, 0.5), 1.0]
    ax.tricontourf(*drawn, levels=side, colors=["white"], alpha=0.3)
    ax.tricontourf(*drawn, levels=side, colors="none", hatches=[_BREAKS])
    hatched = Patch(
        facecolor="none", edgecolor="black", hatch=_BREAKS, lw=0.0, label="breakdown voltage below it"
    )
    if most <= 1.0:
        hatched.set_label(f"breakdown voltage below the applied {volts}")
        return [hatched]
    line = ax.tricontour(*drawn, levels=[1.0], colors="black", linewidths=1.8)
    line.set_path_effects([cast("AbstractPathEffect", withStroke(linewidth=3.2, foreground="white"))])
    label = f"breakdown voltage = applied {volts}"
    return [Line2D([], [], color="black", lw=1.8, label=label), hatched]


def _scatter(results: SweepResults, taken: Slice, ax: Axes, along: Array, up: Array) -> list[Artist]:
    """Points coloured by their value, where nothing is known between them, and their legend."""
    label, scale = labelled(results, taken.value, taken.values)
    values = scale.factor * taken.values
    masks = kinds(taken)
    for kind in masks.keys() - {"solved"}:
        mark(ax, kind, along[masks[kind]], up[masks[kind]])
    solved = masks.get("solved")
    if solved is None:
        return []
    log = is_wide(values)
    levels = levels_of(values, log=log)
    norm = norm_of(levels, log=log)
    colour_bar(ax, norm, label.axis(scale), levels)
    parts = {"": (solved, "o")}
    if taken.value.startswith("discharge.") and np.any(np.isfinite(taken.margin)):
        low, volts = solved & (taken.margin < 1.0), voltage_text(taken)
        parts = {
            f"breakdown voltage above the applied {volts}": (solved & ~low, "o"),
            "below it": (low, "v"),
        }
    for part, shape in parts.values():
        look: dict[str, Any] = {
            "marker": shape,
            "s": 26.0,
            "cmap": COLOURS,
            "norm": norm,
            "lw": 0.5,
            "zorder": 4.0,
        }
        ax.scatter(along[part], up[part], c=values[part], edgecolors="black", **look)
    hollow: dict[str, Any] = {"ls": "none", "color": "black", "mfc": "none", "ms": 5.0, "mew": 0.5}
    return [Line2D([], [], marker=m, label=text, **hollow) for text, (_, m) in parts.items() if text]
