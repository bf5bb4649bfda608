"""Marks of the points of a sweep, labels on lines of equal value and with units, titles, and shares of
time.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.contour import ContourSet
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.tri import Triangulation
from scipy.spatial import KDTree
from scipy.special import ndtr, ndtri

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.bearing_touching import CAPACITIVE, RESISTIVE
from ehlectric.cases.defaults import HOW
from ehlectric.figures.style import figure_of, name_over, outlined
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.palette import BLUE, GREY, MAP_EDGE, ON_MAP, ORANGE
from ehlectric.quantities.result_warnings import CODES
from ehlectric.readable import readable
from ehlectric.sweep.axis_labels import Label, label_of
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.slices import Slice

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
    are taken now, with those of the m labels, shape (n + m, 2).
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
            around = KDTree(_on_page(ax, taken) * (wider, 1.0))
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


# Keys of a bearing's summary that are such shares.
TIME_SHARES = ("bearing.contact_time_share", "bearing.touching_time_share", "bearing.clarke_time_share")

# Lines of equal share.
_LINES = (CAPACITIVE, 0.1, 0.5, RESISTIVE)

# Colours and names of the areas between the lines.
_AREAS = (
    (to_rgba(BLUE, 0.25), "capacitive: contacts short it at most 1 % of the time"),
    (to_rgba(ORANGE, 0.25), "intermittent"),
    (to_rgba(ORANGE, 0.45), ""),
    (to_rgba(ORANGE, 0.65), ""),
    (to_rgba(GREY, 0.65), "resistive: more than 99 %"),
)

# Ends of the shares that are drawn: beyond them their quantiles have no finite value.
_LEAST, _MOST = 1e-300, 1.0 - 1e-16


def quantile_of(share: Array) -> Array:
    """Quantile of the normal distribution at a share of time, about linear in lambda; nan stays nan.

    A share falls as exp(-lambda^2): neither it nor its logarithm is linear between the points of a sweep.

    Examples
    --------
    >>> quantile_of(np.array([0.5, 0.99, np.nan])).round(2).tolist()
    [0.0, 2.33, nan]
    """
    quantiles: Array = ndtri(np.clip(share, _LEAST, _MOST))
    return quantiles


def share_of(quantile: Array) -> Array:
    """Share of time at a quantile of the normal distribution; the inverse of ``quantile_of``."""
    share: Array = ndtr(quantile)
    return share


def fill_regimes(mesh: Triangulation, quantiles: Array, taken: Array, ax: Axes) -> list[Artist]:
    """Colour the regimes of a map, and draw lines at 1, 10, 50 and 99 % of the time. ``quantiles``, quantiles
    of the shares at the nodes, shape (nodes,); ``taken``, positions of the points, which labels keep away
    from, shape (n, 2). Returns legend entries.
    """
    levels = ndtri(_LINES)
    shown = quantiles[mesh.get_masked_triangles()]
    ends = min(float(np.min(shown)), levels[0]) - 1.0, max(float(np.max(shown)), levels[-1]) + 1.0
    ax.tricontourf(
        mesh, quantiles, levels=[ends[0], *levels, ends[1]], colors=[colour for colour, _ in _AREAS]
    )
    inside = [k for k, level in enumerate(levels) if np.min(shown) < level < np.max(shown)]
    if inside:
        own = [levels[k] for k in inside]
        lines = ax.tricontour(mesh, quantiles, levels=own, colors="black", linewidths=1.2, linestyles="-")
        lines.set_path_effects(outlined(2.2))
        label_lines(ax, lines, taken, [f"{100.0 * _LINES[k]:g} %" for k in inside], **ON_BOX)
    return regime_handles()


def regime_handles() -> list[Artist]:
    """Legend entries of the regimes."""
    return [Patch(facecolor=colour, label=name) for colour, name in _AREAS if name]


def scatter_regimes(places: Array, shares: Array, some: Mask, ax: Axes) -> None:
    """Draw points as dots with the colour of their regime: those that belong to no cell of a map."""
    numbers = np.searchsorted(_LINES, shares[some])
    look: dict[str, Any] = {"c": [_AREAS[k][0] for k in numbers], "s": 40.0, "edgecolors": "black", "lw": 0.5}
    ax.scatter(places[some, 0], places[some, 1], zorder=4.0, **look)


# Marker of a point by its kind, in figures and in their legends.
_MARKS: dict[str, dict[str, Any]] = {
    "solved": {"marker": "o", "ms": 2.6, "color": "black", "mew": 0.0},
    "less accurate": {"marker": "o", "ms": 6.5, "color": ORANGE, "mfc": "none", "mew": 0.9},
    "intermittent": {"marker": "X", "ms": 5.0, "color": ORANGE, "mec": "black", "mew": 0.4},
    "without this value": {"marker": "s", "ms": 4.0, "color": GREY, "mfc": "none", "mew": 0.8},
    "do not use": {"marker": "D", "ms": 4.2, "color": ORANGE, "mfc": "none", "mew": 1.2},
    "not converged": {"marker": "+", "ms": 7.0, "color": "black", "mew": 1.3},
    "failed": {"marker": "x", "ms": 5.5, "color": ORANGE, "mew": 1.6},
    "not tried yet": {"marker": "o", "ms": 4.0, "color": GREY, "mfc": "none", "mew": 0.8},
}

# Codes of warnings that say that the numbers of a point are less accurate than those of other points. Other
# warnings, such as that of an expected breakdown, say something about a contact whose numbers are good.
LESS_ACCURATE = frozenset(code for code, cause in CODES.items() if cause.less_accurate)

# Names of kinds in legends, where they differ from the kind.
_NAMES = {
    "solved": "points",
    "do not use": "must not be used",
    "intermittent": "without a voltage: contacts open and close",
}


def kinds(selection: Slice) -> dict[str, Mask]:
    """Mask of the points of each kind of mark, shape (points,); kinds without points are left out."""
    known, intermittent = np.isfinite(selection.values), selection.intermittent
    without = selection.of("solved") & ~known & ~selection.doubtful
    masks = {
        "solved": selection.of("solved") & known,
        "intermittent": without & intermittent,
        "without this value": without & ~intermittent,
        "do not use": selection.doubtful,
        "not converged": selection.of("not converged"),
        "failed": selection.of("failed"),
        "not tried yet": selection.of("open"),
    }
    return {kind: mask for kind, mask in masks.items() if np.any(mask)}


def warned(selection: Slice) -> Mask:
    """Mask of the points with a value whose numbers are less accurate than those of others, shape (points,).

    They have a warning of ``LESS_ACCURATE`` that not all points have: a warning of all points tells no point
    from another.
    """
    # Of a share of time with contact, that surfaces touch is no doubt but what it says.
    doubts = LESS_ACCURATE - {"touching", "partial-film"} if selection.value in TIME_SHARES else LESS_ACCURATE
    codes = [
        {warning.code for warning in point.warnings if warning.code in doubts} for point in selection.points
    ]
    drawn = selection.of("solved") & np.isfinite(selection.values)
    of_all = set.intersection(*(own for own, known in zip(codes, drawn, strict=True) if known))
    return np.asarray(drawn & np.array([bool(own - of_all) for own in codes]))


def mark_warned(ax: Axes, selection: Slice, x: Array, y: Array) -> list[Line2D]:
    """Draw a ring around each point that is less accurate, and return the legend entry of the rings."""
    some = warned(selection)
    if not np.any(some):
        return []
    mark(ax, "less accurate", x[some], y[some])
    return [Line2D([], [], ls="none", label=f"{np.sum(some)} less accurate", **_look("less accurate"))]


def _look(kind: str) -> dict[str, Any]:
    """Marker of a kind, smaller where the style has smaller markers."""
    scale = mpl.rcParams["lines.markersize"] / mpl.rcParamsDefault["lines.markersize"]
    return _MARKS[kind] | {"ms": scale * _MARKS[kind]["ms"], "mew": scale * _MARKS[kind]["mew"]}


def dot_size(selection: Slice, largest: float) -> float:
    """Diameter of the dots of solved points [pt], smaller if there are more than 400 points."""
    largest *= mpl.rcParams["lines.markersize"] / mpl.rcParamsDefault["lines.markersize"]
    return largest * min(1.0, max(0.3, math.sqrt(400.0 / len(selection.points))))


def mark(ax: Axes, kind: str, x: Array, y: Array, **look: Any) -> None:
    """Draw the marks of points of one kind, above everything else in the axes."""
    # A white edge around the rings would hide the curves beside them.
    edge = [] if kind in ("solved", "less accurate") else outlined(2.6)
    plain: dict[str, Any] = {"ls": "none", "zorder": 5.0, "clip_on": False, "path_effects": edge}
    ax.plot(x, y, **(plain | _look(kind) | look))


def kind_handles(selection: Slice, **look: Any) -> list[Line2D]:
    """Legend entries with the number of points of each kind."""
    return [
        Line2D([], [], ls="none", label=f"{np.sum(mask)} {_NAMES.get(kind, kind)}", **(_look(kind) | look))
        for kind, mask in kinds(selection).items()
    ]


def labelled(results: SweepResults, key: str, values: Array) -> tuple[Label, Scale]:
    """Name, symbol and SI unit of a key, and the unit that suits the values; °C for temperatures."""
    label = label_of(key, results.case)
    return label, label.scaled(values)


def voltage_text(selection: Slice) -> str:
    """Applied voltage of the solved points with its unit, or its range if it differs between them."""
    return range_text(selection.voltage[np.isfinite(selection.voltage)], "V")


def range_text(values: Array, unit: str) -> str:
    """Text of the range of values: one value with the unit, or the smallest "to" the largest.

    Examples
    --------
    >>> range_text(np.array([2.0, 2.0]), "V"), range_text(np.array([2.214, 30.0]), "V")
    ('2 V', '2.2 to 30 V')
    """
    low, high = float(values.min()), float(values.max())
    texts = [readable(value, 2) if value < 10.0 else readable(value) for value in (low, high)]
    return f"{readable(low, 4)} {unit}" if high - low <= 1e-9 * high else f"{' to '.join(texts)} {unit}"


def name_figure(ax: Axes, results: SweepResults, finding: str, more: str) -> None:
    """Write the title of a figure: what it shows, and below it the title of the sweep and ``more``."""
    title = textwrap.shorten(results.title, 70, placeholder=" ...")
    name_over(ax, "\n".join(filter(None, [finding, title, more])))


# Texts of values that are words.
_STATES = {
    "contacts": {contacts: f"contacts {how}" for contacts, how in HOW.items()},
    "bearing.film_factor": {
        "none": "isothermal, fully flooded film",
        "inlet-shear": "film with inlet shear",
        "solved": "film with solved heat",
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
