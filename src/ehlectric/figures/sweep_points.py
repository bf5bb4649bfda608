"""Marks for sweep points, labels on lines of equal value and with units, titles, and shares of time."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import scipy
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.contour import ContourSet
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.tri import Triangulation

from ehlectric.arrays import Array
from ehlectric.cases.defaults import HOW
from ehlectric.figures.data import Curve, MapPanel, Mesh
from ehlectric.figures.draw import marker_look
from ehlectric.figures.style import figure_of, name_over, outlined
from ehlectric.figures.sweep_panels import SHARE_LEVELS, labelled, quantile_of
from ehlectric.quantities.palette import BLUE, GREY, MAP_EDGE, ON_MAP, ORANGE
from ehlectric.sweep import Slice, SweepResults, label_of

# Looks of labels: dark on a white box, and white with a dark edge on colours.
ON_BOX: dict[str, Any] = {
    "color": "black",
    "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 1.2, "alpha": 0.9},
    "zorder": 6.0,
}
ON_COLOURS: dict[str, Any] = {
    "color": ON_MAP,
    "path_effects": outlined(1.6, MAP_EDGE),
    "zorder": 4.5,
}

# Least distance of a label from a mark, from another label and from the frame, as part of the axes.
_ROOM = 0.035

# A label is wider than high: distances along the horizontal axis count less by this factor, and less still in
# figures narrower than this [inches].
_WIDER, _WIDE = 0.55, 6.3

# Places tried along a line.
_TRIED = 200


def label_lines(ax: Axes, lines: ContourSet, taken: Array, texts: Sequence[str], **look: Any) -> Array:
    """Write one label on each line of equal value, where it is farthest from everything else. ``taken``,
    positions of marks and of other labels, in the units of the axes, shape (n, 2). Returns the positions that
    are taken now, with the positions of the m labels, shape (n + m, 2).
    """
    ax.autoscale_view()
    wider = _WIDER * min(1.0, figure_of(ax).get_figwidth() / _WIDE)
    for path, text in zip(lines.get_paths(), texts, strict=True):
        vertices = np.asarray(path.vertices, dtype=float)
        places = vertices[np.all(np.isfinite(vertices), axis=1)]
        if not places.size:
            continue
        places = _between(_on_page(ax, places))
        free = np.ones(len(places))
        if len(taken):
            around = scipy.spatial.KDTree(_on_page(ax, taken) * (wider, 1.0))
            free = np.minimum(around.query(places * (wider, 1.0))[0], 1.0)
        edge = np.min(np.hstack([places, 1.0 - places]) * (wider, 1.0, wider, 1.0), axis=1)
        free = np.minimum(free, edge)
        best = int(np.argmax(free))
        if free[best] < _ROOM:
            continue
        at = ax.transData.inverted().transform(ax.transAxes.transform(places[best]))
        ax.text(float(at[0]), float(at[1]), text, ha="center", va="center", fontsize="x-small", **look)
        taken = np.vstack([taken, at])
    return taken


def _on_page(ax: Axes, at: Array) -> Array:
    """Positions as parts of the axes."""
    return np.asarray(ax.transAxes.inverted().transform(ax.transData.transform(at)))


def _between(places: Array) -> Array:
    """Places along a line with further ones between them, at about equal distances."""
    lengths = np.hypot(*np.diff(places, axis=0).T) if len(places) > 1 else np.empty(0)
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    if along[-1] == 0.0:
        return places
    at = np.linspace(0.0, along[-1], _TRIED)
    nearest = np.abs(at[:, np.newaxis] - along).argmin(axis=1)
    straight = np.column_stack([np.interp(at, along, places[:, k]) for k in (0, 1)])
    # A line of several parts jumps between them: nothing is written into the jump.
    jump = np.concatenate([[False], lengths > 0.3])
    return np.asarray(np.where(jump[nearest, np.newaxis], places[nearest], straight))


# Colours of the areas between the lines of equal share, of which the first, second and last have names.
_AREAS = (
    to_rgba(BLUE, 0.25),
    to_rgba(ORANGE, 0.25),
    to_rgba(ORANGE, 0.45),
    to_rgba(ORANGE, 0.65),
    to_rgba(GREY, 0.65),
)
_NAMED = (_AREAS[0], _AREAS[1], _AREAS[-1])


def draw_regimes(panel: MapPanel, ax: Axes) -> list[Artist]:
    """Colour the regimes of a map of shares of time, with lines at its levels; returns legend entries."""
    if np.any(panel.alone):
        # Dots of the points that belong to no cell have the colour of their regime.
        numbers = np.searchsorted(SHARE_LEVELS, panel.values[panel.alone])
        x, y = panel.places[:, panel.alone]
        colours = [_AREAS[k] for k in numbers]
        ax.scatter(x, y, c=colours, s=40.0, edgecolors="black", lw=0.5, zorder=4.0)
    if panel.between is not None:
        _fill_regimes(triangulated(panel.between), quantile_of(panel.between.values), panel.places.T, ax)
    return [Patch(facecolor=colour, label=name) for colour, name in zip(_NAMED, panel.areas, strict=True)]


def triangulated(mesh: Mesh) -> Triangulation:
    """Triangles of a mesh as Matplotlib takes them."""
    return Triangulation(mesh.x, mesh.y, mesh.triangles)


def _fill_regimes(mesh: Triangulation, quantiles: Array, taken: Array, ax: Axes) -> None:
    """Areas and lines of quantiles at the nodes; labels keep away from the places that are ``taken``."""
    levels = scipy.special.ndtri(SHARE_LEVELS)
    shown = quantiles[mesh.get_masked_triangles()]
    ends = min(float(np.min(shown)), levels[0]) - 1.0, max(float(np.max(shown)), levels[-1]) + 1.0
    ax.tricontourf(mesh, quantiles, levels=[ends[0], *levels, ends[1]], colors=_AREAS)
    inside = [k for k, level in enumerate(levels) if np.min(shown) < level < np.max(shown)]
    if inside:
        inside_levels = [levels[k] for k in inside]
        lines = ax.tricontour(
            mesh, quantiles, levels=inside_levels, colors="black", linewidths=1.2, linestyles="-"
        )
        lines.set_path_effects(outlined(2.2))
        label_lines(ax, lines, taken, [f"{100.0 * SHARE_LEVELS[k]:g} %" for k in inside], **ON_BOX)


def mark(ax: Axes, curve: Curve, **look: Any) -> None:
    """Draw marks of points above everything else in the axes."""
    # A white edge around the rings would hide the curves next to them.
    edge = [] if curve.marker in ("dots", "wide circle") else outlined(2.6)
    plain: dict[str, Any] = {"zorder": 5.0, "clip_on": False, "path_effects": edge}
    ax.plot(curve.x, curve.y, **(plain | _look(curve) | look))


def mark_handles(curves: Sequence[Curve], **look: Any) -> list[Line2D]:
    """Legend entries of the marks that have a name."""
    return [Line2D([], [], label=curve.name, **(_look(curve) | look)) for curve in curves if curve.name]


def _look(curve: Curve) -> dict[str, Any]:
    """Markers of a curve, smaller where the style has smaller markers."""
    scale = mpl.rcParams["lines.markersize"] / mpl.rcParamsDefault["lines.markersize"]
    look = marker_look(curve)
    return look | {"ms": scale * look["ms"], "mew": scale * look.get("mew", 0.0)}


def name_figure(ax: Axes, results: SweepResults, finding: str, more: str) -> None:
    """Write the title of a figure: what it shows, and below it the title of the sweep and ``more``."""
    title = textwrap.shorten(results.title, 70, placeholder=" ...")
    name_over(ax, "\n".join(filter(None, [finding, title, more])))


# Texts of values that are words.
_STATES = {
    "contacts": {contacts: f"contacts {how}" for contacts, how in HOW.items()},
    "bearing.film_factor": {
        "none": "isothermal, fully flooded film",
        "inlet-shear": "film with inlet shear heating",
        "solved": "thermal film",
    },
    "bearing.supply": {
        "flooded": "fully flooded",
        "oil-bath": "oil bath",
        "oil-jet": "oil jet",
        "grease": "grease",
        "oil-air": "oil and air",
    },
}


def held_text(results: SweepResults, selection: Slice) -> str:
    """Text of the keys with a fixed value, and of the varied keys that the figure neither shows nor fixes."""
    texts = []
    for key, value in selection.at.items():
        if str(value) in _STATES.get(key, {}):
            texts.append(_STATES[key][str(value)])
            continue
        numbers = np.array([value]) if isinstance(value, int | float) else np.empty(0)
        label, scale = labelled(results, key, numbers)
        texts.append(f"{label.name} = {scale.text(value)}")
    if selection.free:
        names = ", ".join(label_of(key, results.case).name for key in selection.free)
        texts.append(f"at any {names}")
    return ", ".join(texts)
