"""Uniform grids of a contact: nodes along and across entrainment, and weights of their integrals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask


@dataclass(frozen=True)
class Width:
    """The domain across entrainment, abs(Y) <= ``side``, of a contact that has an end there.

    ``nodes`` are those from side to side. A symmetric contact with an odd number of them is solved for
    Y >= 0 alone.
    """

    nodes: int
    side: float
    symmetric: bool = True

    @property
    def halved(self) -> bool:
        """Whether Y >= 0 alone is solved for."""
        return self.symmetric and self.nodes % 2 == 1

    @property
    def y(self) -> Array:
        """Nodes that are solved for: from 0 or from -side to side, shape (ny,)."""
        if self.halved:
            return np.linspace(0.0, self.side, self.nodes // 2 + 1)
        return np.linspace(-self.side, self.side, self.nodes)

    def coarser(self) -> Width:
        """The same domain with half the intervals, and as much of it solved for."""
        nodes = 2 * (self.y.size // 2) + 1 if self.halved else self.nodes // 2 + 1
        # Of an even number of nodes the whole domain is solved for, on every grid.
        return replace(self, nodes=nodes, symmetric=self.halved)


@dataclass(frozen=True)
class Mesh:
    """Nodes of a contact, dimensionless.

    Attributes
    ----------
    x, y : ndarray, shapes (nx,), (ny,)
        Positions along and across entrainment, equidistant. A line contact has the one line y = 0.
    symmetric : bool
        The lines y < 0 are the mirror image of those beyond y[0] = 0, and left out.
    """

    x: Array
    y: Array
    symmetric: bool = False

    @classmethod
    def over(cls, nodes: int, inlet: float, outlet: float, width: Width | None = None) -> Mesh:
        """The mesh of a domain with so many nodes along entrainment; without a width, of a line contact."""
        x = np.linspace(inlet, outlet, nodes)
        y = np.zeros(1) if width is None else width.y
        return cls(x, y, symmetric=width is not None and width.halved)

    @property
    def shape(self) -> tuple[int, int]:
        """Number of nodes along and across entrainment."""
        return self.x.size, self.y.size

    @property
    def dx(self) -> float:
        """Distance of neighbours along entrainment."""
        return float(self.x[-1] - self.x[0]) / (self.x.size - 1)

    @property
    def dy(self) -> float | None:
        """Distance of neighbours across entrainment, None for a line contact."""
        return None if self.y.size == 1 else float(self.y[-1] - self.y[0]) / (self.y.size - 1)

    @property
    def weights_along(self) -> Array:
        """Trapezoidal weights of the integral over x, shape (nx,)."""
        weights = np.full(self.x.size, self.dx)
        weights[[0, -1]] *= 0.5
        return weights

    @property
    def weights_across(self) -> Array:
        """Those of the integral over y, of both halves of a symmetric contact; one for a line contact."""
        if self.dy is None:
            return np.ones(1)
        weights = np.full(self.y.size, 2.0 * self.dy if self.symmetric else self.dy)
        weights[[0, -1]] *= 0.5
        return weights

    @property
    def weights(self) -> Array:
        """Weights of the integral over the contact, shape (nx, ny)."""
        return self.weights_along[:, np.newaxis] * self.weights_across

    @cached_property
    def inner(self) -> Mask:
        """Nodes that are on no edge of the domain, shape (nx, ny); a line of symmetry is no edge."""
        inner = np.ones(self.shape, dtype=bool)
        inner[[0, -1]] = False
        if self.y.size > 1:
            inner[:, -1] = False
            inner[:, 0] &= self.symmetric
        return inner

    def mirrored(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values (nx, ny) on the whole domain, the part that symmetry leaves out added."""
        return np.concatenate([values[:, :0:-1], values], axis=1) if self.symmetric else values

    @property
    def whole_y(self) -> Array:
        """Positions across entrainment of ``mirrored`` values."""
        return np.concatenate([-self.y[:0:-1], self.y]) if self.symmetric else self.y


def at_centre(mesh: Mesh, values: Array) -> float:
    """Value at X = Y = 0 of nodal values (nx, ny), by linear interpolation."""
    line = np.array([np.interp(0.0, mesh.y, row) for row in values])
    return float(np.interp(0.0, mesh.x, line))
