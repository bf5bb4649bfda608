"""A section through the film between its walls, coloured by a value: of line and of point contacts."""

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
    """Fill the film of a section with colours, and draw the bodies beside it.

    Parameters
    ----------
    ax : Axes
        Where to.
    x : ndarray, shape (nx,)
        Position along the section, in the unit of its axis.
    heights, values : ndarray, shape (nx, ns)
        Height from the lower to the upper wall, in the unit of its axis, and what the colours are of.
    limits : tuple of float
        Values at the ends of the colours; beyond them the colours stay.
    potentials : tuple of float
        Of surfaces 1 and 2 [V], for their names.
    colours : str
        Name of the colour map.

    Returns
    -------
    ContourSet
        For a colour bar.
    """
    along = np.broadcast_to(x[:, np.newaxis], heights.shape)
    levels = np.linspace(*limits, 401)
    # Rounding may put a wall beyond its own potential, and so out of the levels.
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
    """Show the film, not the wide gap beside it: heights where the gap is up to six times the least."""
    gap = heights[:, -1] - heights[:, 0]
    near = gap <= 6.0 * np.min(gap)
    margin = 0.35 * float(np.max(gap[near]))
    ax.set_ylim(float(np.min(heights[near])) - margin, float(np.max(heights[near])) + margin)
