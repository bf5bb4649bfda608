"""Looks and labels that the figures of a bearing share."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.quantities.palette import BLACK, GREEN, OCHRE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Colour, dash and width [pt] of a line.
Look = tuple[str, str, float]

# Lines of the voltages of the whole bearing in all figures. The voltages are often equal, so the line drawn
# first is the wider one.
FIRST: Look = (BLACK, "solid", 1.1)
THROUGH: Look = (OCHRE, "solid", 3.0)
SHAFT: Look = (GREEN, "dash", 1.4)

# Height of a line of a label at the right edge, as a part of the height of axes that are an inch high.
_LINE = 0.155


def volts(value: float) -> str:
    """Text: voltage with three digits.

    Examples
    --------
    >>> volts(5.8617)
    '5.86 V'
    """
    return f"{value:#.3g}".rstrip(".") + " V"


def label_ends(ax: Axes, ends: Sequence[tuple[float, str, str]]) -> None:
    """Write the names of lines beside the right edge of the axes, at their heights and without overlap.

    Parameters
    ----------
    ax : Axes
        Axes whose limits are final.
    ends : sequence of (float, str, str)
        Height of each line at the right edge in the unit of the axis, its name, and its colour.
    """
    figure = ax.get_figure(root=True)
    assert figure is not None
    line = _LINE / (figure.get_figheight() * ax.get_position().height)
    low, high = ax.get_ylim()
    ordered = sorted(ends)
    values = np.clip(np.array([value for value, _, _ in ordered]), low, high)
    if ax.get_yscale() == "log":
        heights = np.log(values / low) / np.log(high / low)
    else:
        heights = (values - low) / (high - low)
    rooms = [line * (text.count("\n") + 1.2) for _, text, _ in ordered]
    for k in range(1, len(ordered)):
        heights[k] = max(heights[k], heights[k - 1] + 0.5 * (rooms[k] + rooms[k - 1]))
    for height, (_, text, colour) in zip(heights, ordered, strict=True):
        ax.text(1.015, height, text, transform=ax.transAxes, va="center", color=colour, fontsize="small")


def fill_text(fill: float | str) -> str:
    """Text about what fills the gap around the films.

    Examples
    --------
    >>> fill_text("air"), fill_text(0.3)
    ('air fill', '30 % oil fill')
    """
    return f"{fill} fill" if isinstance(fill, str) else f"{100.0 * fill:.3g} % oil fill"
