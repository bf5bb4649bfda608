"""Labels on lines of equal value, at places where no mark and no other label is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.patheffects import withStroke

from ehlectric.arrays import Array

# Looks of labels: dark on a white box, and white with a dark edge on colours.
ON_BOX: dict[str, Any] = {
    "color": "black",
    "bbox": {"facecolor": "white", "edgecolor": "none", "pad": 1.2, "alpha": 0.9},
    "zorder": 6.0,
}
ON_COLOURS: dict[str, Any] = {
    "color": "white",
    "path_effects": [withStroke(linewidth=1.6, foreground="#222222")],
    "zorder": 4.5,
}

# Least distance of a label from a mark, from another label and from the frame, as part of the axes.
_ROOM = 0.035

# A label is wider than high: distances along the horizontal axis count less by this factor.
_WIDER = 0.55

# Places tried along a line.
_TRIED = 200


def label_lines(ax: Axes, lines: ContourSet, taken: Array, texts: Sequence[str], **look: Any) -> Array:
    """Write one label on each line of equal value, where it is farthest from everything else.

    Parameters
    ----------
    ax : Axes
        Axes with the lines and with the scales of both axes.
    lines : ContourSet
        Lines of equal value.
    taken : ndarray, shape (n, 2)
        Positions of marks and of other labels, in the units of the axes.
    texts : sequence of str
        Label of each level. A line without a free place has none.
    **look
        Properties of the labels.

    Returns
    -------
    ndarray, shape (n + m, 2)
        The positions that are taken now, with those of the m labels.
    """
    ax.autoscale_view()
    for path, text in zip(lines.get_paths(), texts, strict=True):
        vertices = np.asarray(path.vertices, dtype=float)
        places = vertices[np.all(np.isfinite(vertices), axis=1)]
        if not places.size:
            continue
        places = _between(_on_page(ax, places))
        around = _on_page(ax, taken)
        apart = (places[:, np.newaxis] - around) * (_WIDER, 1.0)
        free = np.min(np.hypot(*np.moveaxis(apart, -1, 0)), axis=1, initial=1.0)
        edge = np.min(np.hstack([places, 1.0 - places]) * (_WIDER, 1.0, _WIDER, 1.0), axis=1)
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
