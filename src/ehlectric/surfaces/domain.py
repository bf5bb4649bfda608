"""The part of a contact where surfaces are needed, and positions in axes that are turned."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.cases.roughness import Roughness


@dataclass(frozen=True)
class Domain:
    """Where a surface is needed [m]: from inlet to outlet along x, ``side`` to either side along y.

    A line contact is infinitely wide.
    """

    inlet: float
    outlet: float
    side: float = np.inf

    @property
    def length(self) -> float:
        """Length along x [m]."""
        return self.outlet - self.inlet

    @property
    def shorter(self) -> float:
        """The shorter of its two lengths [m]."""
        return min(self.length, 2.0 * self.side)

    def reach(self, table: Roughness) -> tuple[float, float]:
        """Distances from the middle of a shifted surface to which it is needed, along its own axes [m]."""
        x = np.array([self.inlet, self.outlet]) - table.shift
        y = np.array([-self.side, self.side]) - table.shift_y
        along, across = turned(x[:, np.newaxis], y, table.orientation or 0.0)
        return float(np.max(np.abs(along))), float(np.max(np.abs(across)))


def turned(x: ArrayLike, y: ArrayLike, orientation: float) -> tuple[Array, Array]:
    """Positions in axes that are turned counter-clockwise by an angle in degrees.

    Examples
    --------
    >>> [round(float(value), 12) for value in turned(0.0, 1.0, 90.0)]
    [1.0, 0.0]
    """
    angle = np.deg2rad(orientation)
    x, y = np.asarray(x, float), np.asarray(y, float)
    return x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
