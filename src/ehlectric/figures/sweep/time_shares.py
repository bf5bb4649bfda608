"""Maps of the share of time in which bearings conduct: regimes, with lines at 1, 10, 50 and 99 %."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch
from matplotlib.patheffects import AbstractPathEffect, withStroke
from matplotlib.tri import Triangulation
from scipy.special import ndtr, ndtri

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.intermittency.duty import CAPACITIVE, RESISTIVE
from ehlectric.figures.sweep.line_labels import ON_BOX, label_lines
from ehlectric.quantities.palette import BLUE, GREY, ORANGE

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
    """Colour the regimes of a map, and draw lines at 1, 10, 50 and 99 % of the time.

    Parameters
    ----------
    mesh : Triangulation
        Triangles with values throughout, in the units of the axes.
    quantiles : ndarray, shape (nodes,)
        Quantiles of the shares at the nodes.
    taken : ndarray, shape (n, 2)
        Positions of the points, which labels keep away from.
    ax : Axes
        Axes to draw on.

    Returns
    -------
    list of Artist
        Legend entries.
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
        lines.set_path_effects([cast("AbstractPathEffect", withStroke(linewidth=2.2, foreground="white"))])
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
