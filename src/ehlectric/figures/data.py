"""Figures as data: panels of curves, areas and marked positions, and maps, which Matplotlib and Plotly draw
alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, IntArray, Mask

# Axes and colours are logarithmic where the values differ by more than this ratio.
WIDE = 20.0

# Width of a line on the screen [pt].
WIDTH = 1.2


@dataclass(frozen=True)
class Curve:
    """Values over positions, in shown units: a line, or markers where ``marker`` is not empty.

    ``dash`` is one of "solid", "dash", "dot", "dashdot" and "longdash", ``width`` in points. Markers are
    "dots", "ring", "star", "circle", "wide circle", "square", "diamond", "triangle", "plus", "cross",
    "wide cross", "full square", "full diamond" or "bound", with a relative ``size`` and ``texts`` at the
    pointer. A curve without name is in no legend. With ``steps``, each value applies up to the next position.
    """

    name: str
    x: NDArray[Any] = field(repr=False)
    y: NDArray[Any] = field(repr=False)
    colour: str
    dash: str = "solid"
    width: float = WIDTH
    marker: str = ""
    size: float = 1.0
    steps: bool = False
    texts: Sequence[str] = field(default=(), repr=False)


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
    """Panel of a figure: a quantity with its unit, empty without one, and the ends of its axis at first.

    A logarithmic axis only has ends if ``bottom`` is above zero. ``missing`` are markers at positions without
    a value, which are drawn in a strip below the curves. ``rows`` are names of the heights 0, 1, ... instead
    of numbers.
    """

    title: str
    unit: str
    curves: Sequence[Curve] = field(repr=False)
    top: float
    bottom: float = 0.0
    areas: Sequence[Area] = ()
    uprights: Sequence[Upright] = ()
    log: bool = False
    missing: Sequence[Curve] = ()
    rows: Sequence[str] = ()

    @property
    def ends(self) -> tuple[float, float] | None:
        """Ends of the axis; None of a logarithmic axis that begins at zero."""
        return None if self.log and self.bottom <= 0.0 else (self.bottom, self.top)


@dataclass(frozen=True)
class Along:
    """Axis that all panels of a figure share; ``edges`` are positions of dashed lines."""

    name: str
    unit: str
    window: tuple[float, float] | None = None
    edges: tuple[float, ...] = ()
    log: bool = False

    @property
    def title(self) -> str:
        """Name with the unit in brackets."""
        return with_unit(self.name, self.unit)


@dataclass(frozen=True)
class Mesh:
    """Values at nodes, shape (nodes,), and numbers of the nodes of each triangle, shape (triangles, 3)."""

    x: Array = field(repr=False)
    y: Array = field(repr=False)
    values: Array = field(repr=False)
    triangles: IntArray = field(repr=False)


@dataclass(frozen=True)
class Limit:
    """Margins of the points of a map to a limit, and between the points; breakdown is expected below 1."""

    margins: Array = field(repr=False)  # NaN where a point has none, shape (points,)
    between: Mesh | None = field(repr=False)
    name: str  # what the margin compares, such as "breakdown voltage"
    against: str  # limit, such as "applied voltage"
    amount: str  # limit with its unit, or its range

    @property
    def line(self) -> str:
        """Name of the line on which the margin is 1."""
        return f"margin 1 at {self.amount}"


@dataclass(frozen=True)
class MapPanel:
    """Map of a quantity over two axes: values at points, and between them where cells have a value at all of
    their corners.
    """

    axes: tuple[Along, Along]
    title: str
    unit: str
    places: Array = field(repr=False)  # positions of the points on both axes, shape (2, points)
    values: Array = field(repr=False)  # NaN where a point has none, shape (points,)
    marks: Sequence[Curve] = field(repr=False)
    alone: Mask = field(repr=False)  # points with a value outside of the mesh, shape (points,)
    log: bool = False  # whether colours follow the logarithm
    between: Mesh | None = field(default=None, repr=False)
    opening: Mesh | None = field(default=None, repr=False)  # cells in which contacts open and close
    limit: Limit | None = None
    levels: tuple[float, ...] = ()  # values between which areas have colours of their own
    # Names of the areas below the first level, between levels, and above the last one.
    areas: tuple[str, ...] = ()
    # Names of values that are texts; ``values`` are their numbers from 0, and each point has an area.
    categories: tuple[str, ...] = ()


def with_unit(name: str, unit: str) -> str:
    """Name with a unit in brackets; without them where there is no unit."""
    return f"{name} [{unit}]" if unit else name


def is_wide(values: Array) -> bool:
    """Whether the finite values are all positive and differ by more than the ratio ``WIDE``.

    >>> is_wide(np.array([1.0, 5.0, np.nan])), is_wide(np.array([1.0, 50.0])), is_wide(np.array([]))
    (False, True, False)
    """
    finite = values[np.isfinite(values)]
    return bool(finite.size and finite.min() > 0.0 and finite.max() > WIDE * finite.min())


def by_logarithm(values: Array, *, log_axis: bool) -> bool:
    """Whether values are interpolated linearly in their logarithm between points.

    Film thickness and breakdown voltage are nearly powers of speed and load. On a logarithmic axis of speed
    or load, linear interpolation of the values themselves would overstate them between the points.

    Returns True where all finite values are positive, and an axis is logarithmic or they differ by more than
    the ratio ``WIDE``.

    Examples
    --------
    >>> by_logarithm(np.array([1.0, 2.0]), log_axis=False), by_logarithm(np.array([1.0, 2.0]), log_axis=True)
    (False, True)
    """
    finite = values[np.isfinite(values)]
    positive = bool(finite.size and finite.min() > 0.0)
    return positive and (log_axis or is_wide(finite))
