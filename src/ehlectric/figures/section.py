"""Drawing of a section through the film of a line or point contact, coloured by the values of a field."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.patheffects import withStroke

from ehlectric.arrays import Array
from ehlectric.figures.style import BODY


def draw_section(
    ax: Axes,
    x: Array,
    heights: Array,
    values: Array,
    *,
    limits: tuple[float, float],
    potentials: tuple[float, float],
    colours: str = "viridis",
) -> ContourSet:
    """Draw a section through the film, coloured by a value, with the bodies below and above it.

    Parameters
    ----------
    ax : Axes
        Axes to draw on.
    x : ndarray, shape (nx,)
        Position along the section, in the unit of its axis.
    heights : ndarray, shape (nx, ns)
        Heights of the nodes, from the lower to the upper wall, in the unit of its axis.
    values : ndarray, shape (nx, ns)
        Values at the nodes that the colours show.
    limits : tuple of float
        Values at the two ends of the colours. Values beyond them have the colour of the nearer end.
    potentials : tuple of float
        Potentials of surfaces 1 and 2 [V], written on the bodies.
    colours : str
        Name of the colour map.

    Returns
    -------
    ContourSet
        The filled contours, from which a colour bar can be made.
    """
    along = np.broadcast_to(x[:, np.newaxis], heights.shape)
    levels = np.linspace(*limits, 401)
    # Without clipping, rounding may put the values at a wall outside the levels, and leave it without colour.
    clipped = np.clip(values, *limits)
    filled = ax.contourf(along, heights, clipped, levels, cmap=colours, antialiased=False)
    for wall in (0, -1):
        ax.plot(x, heights[:, wall], color="black", lw=0.8)
    ax.set_xlim(x[0], x[-1])
    _limit_height(ax, heights)
    low, high = ax.get_ylim()
    ax.fill_between(x, low, heights[:, 0], color=BODY, lw=0.0, zorder=0.5)
    ax.fill_between(x, heights[:, -1], high, color=BODY, lw=0.0, zorder=0.5)
    for surface, (height, where, volts) in enumerate(
        zip((0.04, 0.96), ("bottom", "top"), potentials, strict=True), 1
    ):
        text = f"surface {surface}, {volts:g} V".replace("-", "−")
        ax.text(
            0.5,
            height,
            text,
            transform=ax.transAxes,
            ha="center",
            va=where,
            fontsize=8.0,
            path_effects=[withStroke(linewidth=2.0, foreground=BODY)],
        )
    return filled


def _limit_height(ax: Axes, heights: Array) -> None:
    """Set the range of heights: the film is shown where the gap is at most six times its minimum."""
    gap = heights[:, -1] - heights[:, 0]
    near = gap <= 6.0 * np.min(gap)
    margin = 0.35 * float(np.max(gap[near]))
    ax.set_ylim(float(np.min(heights[near])) - margin, float(np.max(heights[near])) + margin)
