"""Drawing of a section through the film of a line or point contact, coloured by the values of a field."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.contour import ContourSet
from matplotlib.text import Text

from ehlectric.arrays import Array
from ehlectric.figures.style import figure_of, note, outlined
from ehlectric.quantities.palette import BODY, OUT_OF_RANGE

# Mark of a maximum: a ring that can be seen on any colour.
MAXIMUM: dict[str, Any] = {
    "ls": "none",
    "marker": "o",
    "ms": 5.0,
    "mfc": "none",
    "mec": "black",
    "mew": 1.0,
    "path_effects": outlined(2.4),
}


def draw_section(
    ax: Axes,
    x: Array,
    heights: Array,
    values: Array,
    *,
    limits: tuple[float, float],
    potentials: tuple[float, float],
    units: tuple[float, float],
    under: bool = False,
) -> ContourSet:
    """Draw a section through the film, coloured by a value, with the bodies below and above it.

    ``x``, position along the section, in the unit of its axis, shape (nx,); ``heights``, heights of the
    nodes, from the lower to the upper wall, in the unit of its axis, shape (nx, ns); ``values``, values at
    the nodes that the colours show, shape (nx, ns); ``potentials``, potentials of surfaces 1 and 2 [V],
    written on the bodies; ``units``, lengths that the unit of each axis stands for [m]. Returns the filled
    contours, from which a colour bar can be made.
    """
    filled = fill_section(ax, x, heights, values, limits=limits, under=under)
    ax.set_xlim(x[0], x[-1])
    _limit_height(ax, heights)
    # The bodies go on beyond the axes, whose heights may be changed.
    far = 10.0 * float(np.max(np.abs(ax.get_ylim())))
    for wall, end in ((0, -far), (-1, far)):
        body = ax.fill_between(x, end, heights[:, wall], color=BODY, lw=0.0, zorder=0.5)
        body.sticky_edges.y[:] = []
    for surface, (height, where, volts) in enumerate(
        zip((0.04, 0.96), ("bottom", "top"), potentials, strict=True), 1
    ):
        text, edge = f"surface {surface}, {volts:g} V".replace("-", "−"), outlined(2.0, BODY)
        note(ax, 0.88, height, text, ha="right", va=where, fontsize=8.0, path_effects=edge)
    ax.add_artist(_Enlargement(ax, units, np.column_stack([x, heights[:, 0]])))
    return filled


# Distance between the film and the text below it, at least [pt].
_CLEAR = 4.0


class _Enlargement(Text):
    """Text that says how many times the heights of a section are enlarged, once the page is laid out.

    ``wall``, positions of the lower wall in the units of the axes, shape (nx, 2).
    """

    def __init__(self, ax: Axes, units: tuple[float, float], wall: Array) -> None:
        look: dict[str, Any] = {"fontsize": 7.5, "va": "bottom", "transform": ax.transAxes, "zorder": 5.0}
        super().__init__(0.015, 0.04, "", path_effects=outlined(2.0), **look)
        self._drawn_on, self._units, self._wall = ax, units, wall
        self.set_in_layout(False)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the text for the size that the axes have now; a shorter one if it reached into the film."""
        times = float(f"{self._times():.2g}")  # two digits without an exponent
        self.set_text(f"heights enlarged\n{times:g} times")
        box = self.get_window_extent(renderer)
        box = box.padded(_CLEAR * figure_of(self._drawn_on).dpi / 72.0)
        wall = self._drawn_on.transData.transform(self._wall)
        if np.any(wall[(wall[:, 0] >= box.x0) & (wall[:, 0] <= box.x1), 1] < box.y1):
            self.set_text(f"heights × {times:g}")
        super().draw(renderer)

    def _times(self) -> float:
        ax, (along, across) = self._drawn_on, self._units
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
        box = ax.get_window_extent()
        return float(box.height / (abs(high - low) * across) / (box.width / (abs(right - left) * along)))


def fill_section(
    ax: Axes,
    x: Array,
    heights: Array,
    values: Array,
    *,
    limits: tuple[float, float],
    colours: str = "viridis",
    under: bool = False,
) -> ContourSet:
    """Fill the gap between two walls with the colours of values, and draw the walls.

    ``colours`` is the name of a colour map, whose ends are at ``limits``. With ``under``, values below them
    are left without colour.
    """
    along = np.broadcast_to(x[:, np.newaxis], heights.shape)
    levels = np.linspace(*limits, 401)
    # Without clipping, rounding may put the values at a wall outside the levels, and leave it without colour.
    clipped = np.minimum(values, limits[1]) if under else np.clip(values, *limits)
    colour_map = colormaps[colours].with_extremes(under=OUT_OF_RANGE)
    extend = "min" if under else "neither"
    filled = ax.contourf(along, heights, clipped, levels, cmap=colour_map, extend=extend, antialiased=False)
    # In SVG and PDF, 400 bands would be slow to open and have white seams.
    filled.set_rasterized(True)
    for wall in (0, -1):
        ax.plot(x, heights[:, wall], color="black", lw=0.8)
    return filled


def _limit_height(ax: Axes, heights: Array) -> None:
    """Set the range of heights: the film is shown where the gap is at most six times its minimum."""
    gap = heights[:, -1] - heights[:, 0]
    near = gap <= 6.0 * np.min(gap)
    margin = 0.35 * float(np.max(gap[near]))
    ax.set_ylim(float(np.min(heights[near])) - margin, float(np.max(heights[near])) + margin)
