"""Position axes of contacts: in half-widths, and above the axes as lengths."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import ScalarFormatter
from matplotlib.transforms import offset_copy

from ehlectric.arrays import Array
from ehlectric.figures.style import OfContact, figure_of
from ehlectric.quantities.units import unit_for

if TYPE_CHECKING:
    from matplotlib.axis import Axis


def in_half_widths(result: OfContact, x: Array) -> Array:
    """Positions [m] divided by the half-width of the contact."""
    return x / result.conditions.half_width


def label_position(result: OfContact, ax: Axes, axis: str = "x") -> None:
    """Label the horizontal axis with x/b or y/b, and with the value of the half-width b."""
    factor, unit = unit_for(result.conditions.half_width, "m", least=1.0)
    ax.set_xlabel(f"${axis}/b$   ($b$ = {factor * result.conditions.half_width:.4g} {unit})")


# Room that the axis of lengths above the axes takes [pt], and place of its name beside its numbers [pt].
LENGTH_AXIS, _LENGTH_NAME = 18.0, (-4.0, 6.0)


# Part of an axis of lengths at its left end within which a number would run into the name of the axis.
_NAME_REACH = 0.035


class _BesideName(ScalarFormatter):
    """Numbers of an axis of lengths, without those that would run into its name at the left end."""

    def __call__(self, x: float, pos: int | None = None) -> str:
        left, right = cast("Axis", self.axis).get_view_interval()
        near = abs(x - left) < _NAME_REACH * abs(right - left)
        return "" if near else super().__call__(x, pos)


def length_axis(result: OfContact, ax: Axes, axis: str = "x") -> None:
    """Add an axis above the axes with the position as a length, in micrometres or millimetres."""
    b = result.conditions.half_width
    factor, unit = unit_for(b * max(abs(end) for end in ax.get_xlim()), "m", least=1.0)
    top = ax.secondary_xaxis(
        "top", functions=(lambda x: np.asarray(x) * factor * b, lambda x: np.asarray(x) / (factor * b))
    )
    top.xaxis.set_major_formatter(_BesideName())
    top.set_xlabel(f"${axis}$ [{unit}]", ha="right", va="bottom")
    left, up = _LENGTH_NAME
    beside = offset_copy(ax.transAxes, figure_of(ax), x=left, y=up, units="points")
    top.xaxis.set_label_coords(0.0, 1.0, transform=beside)
