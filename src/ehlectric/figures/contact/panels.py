"""Two panels below each other, the lower of which enlarges a range of the upper one."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Patch

from ehlectric.figures.style import new_panels
from ehlectric.quantities.palette import GREY


def stacked_panels(size: tuple[float, float]) -> list[Axes]:
    """Axes of two panels of a new figure, the upper one higher; their size on the screen in inches."""
    panels = new_panels(2, 1, size)
    gridspec = panels[0].get_gridspec()
    assert gridspec is not None
    gridspec.set_height_ratios([3.0, 2.0])
    return panels


def enlarged_below(ax: Axes, ends: tuple[float, float], *, framed: bool = False) -> Patch:
    """Shade the range of the horizontal axis that the panel below enlarges, or frame it on filled axes."""
    look: dict[str, Any] = {"color": GREY, "alpha": 0.2, "lw": 0.0, "zorder": 0.2}
    if framed:
        look = {"facecolor": "none", "edgecolor": "black", "lw": 0.7, "ls": "--", "zorder": 3.0}
    return ax.axvspan(*ends, label="enlarged below", **look)
