"""Colours and axes of the figures of measurements."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from ehlectric.quantities.palette import ORANGE

MEASURED: dict[str, Any] = {"color": ORANGE, "marker": "o", "ms": 4, "capsize": 2, "lw": 0.9, "ls": "none"}


def new(width: float = 5.6, height: float = 3.4, *, columns: int = 1) -> tuple[Figure, Any]:
    """Figure without pyplot, and its axes."""
    figure = Figure(figsize=(width, height))
    return figure, figure.subplots(1, columns, sharey=columns > 1)


def decades(axis: Any, ticks: list[float]) -> None:
    """Ticks of a logarithmic axis, as plain numbers."""
    axis.set_ticks(ticks)
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def label(ax: Axes, x: str, y: str) -> None:
    """Labels of both axes, and a light grid."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(visible=True, lw=0.3, color="#cccccc")
