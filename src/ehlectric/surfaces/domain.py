"""Domain of a contact over which its rough surfaces are needed, and rotation of coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.cases.roughness import Roughness


@dataclass(frozen=True)
class Domain:
    """Domain of the film, over which the heights of rough surfaces are needed.

    Attributes
    ----------
    inlet, outlet : float
        Ends along x [m].
    side : float
        Distance from y = 0 to either side [m]; infinite for a line contact.
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
        """Length of the shorter side of the domain [m]."""
        return min(self.length, 2.0 * self.side)

    def reach(self, table: Roughness) -> tuple[float, float]:
        """Half-lengths [m] that a surface needs along its own x and y axes to cover the domain.

        ``table`` has the shift and the orientation of the surface.
        """
        x = np.array([self.inlet, self.outlet]) - table.shift
        y = np.array([-self.side, self.side]) - table.shift_y
        along, across = turned(x[:, np.newaxis], y, table.orientation or 0.0)
        return float(np.max(np.abs(along))), float(np.max(np.abs(across)))


def turned(x: ArrayLike, y: ArrayLike, orientation: float) -> tuple[Array, Array]:
    """Coordinates of positions (x, y) along axes that are rotated counter-clockwise.

    Parameters
    ----------
    x, y : array_like, shapes that broadcast to (...)
        Positions [m].
    orientation : float
        Angle of rotation of the axes [degrees].

    Returns
    -------
    tuple of ndarray, shape (...)
        Positions along the two rotated axes [m].

    Examples
    --------
    >>> [round(float(value), 12) for value in turned(0.0, 1.0, 90.0)]
    [1.0, 0.0]
    """
    angle = np.deg2rad(orientation)
    x, y = np.asarray(x, float), np.asarray(y, float)
    return x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
