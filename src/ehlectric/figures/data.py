"""Figures as data: panels of curves, areas and marked positions, which Matplotlib and Plotly draw alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask

# Axes and colours are logarithmic where the values differ by more than this ratio.
WIDE = 20.0

# Width of a line on the screen [pt].
WIDTH = 1.2


@dataclass(frozen=True)
class Curve:
    """Values over positions, in shown units: a line, or markers where ``marker`` is "dots", "ring" or "star".

    ``dash`` is one of "solid", "dash", "dot", "dashdot" and "longdash", ``width`` in points. A curve without
    name is in no legend.
    """

    name: str
    x: NDArray[Any] = field(repr=False)
    y: NDArray[Any] = field(repr=False)
    colour: str
    dash: str = "solid"
    width: float = WIDTH
    marker: str = ""


@dataclass(frozen=True)
class Area:
    """Shaded area between two curves where ``within``; without ``ends``, over the whole height of a panel."""

    name: str
    x: Array = field(repr=False)
    within: Mask = field(repr=False)
    colour: str
    opacity: float
    ends: tuple[Array, Array] | None = field(default=None, repr=False)
    hatched: bool = False


@dataclass(frozen=True)
class Upright:
    """Line over the whole height of a panel at a position."""

    name: str
    at: float
    colour: str
    dash: str = "solid"


@dataclass(frozen=True)
class Panel:
    """Panel of a figure: a quantity with its unit, empty without one, and the ends of its axis at first."""

    title: str
    unit: str
    curves: Sequence[Curve] = field(repr=False)
    top: float
    bottom: float = 0.0
    areas: Sequence[Area] = ()
    uprights: Sequence[Upright] = ()
    log: bool = False


@dataclass(frozen=True)
class Along:
    """Axis that all panels of a figure share; ``edges`` are positions of dashed lines."""

    name: str
    unit: str
    window: tuple[float, float] | None = None
    edges: tuple[float, ...] = ()
    log: bool = False


def is_wide(values: Array) -> bool:
    """Whether the finite values are all positive and differ by more than the ratio ``WIDE``.

    >>> is_wide(np.array([1.0, 5.0, np.nan])), is_wide(np.array([1.0, 50.0])), is_wide(np.array([]))
    (False, True, False)
    """
    finite = values[np.isfinite(values)]
    return bool(finite.size and finite.min() > 0.0 and finite.max() > WIDE * finite.min())
