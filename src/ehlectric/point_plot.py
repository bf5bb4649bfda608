"""Figures of a point contact's result: each function draws on the axes it is given, and solves nothing."""

from __future__ import annotations

from collections.abc import Callable

from matplotlib.axes import Axes

from ehlectric.point_result import PointResult


def point_figures_of(_result: PointResult) -> dict[str, Callable[..., Axes]]:
    """The figures of a result by the names of their files."""
    return {}
