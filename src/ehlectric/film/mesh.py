"""Uniform grids of a contact: nodes along and across entrainment, and weights of integrals."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.formulas.polynomials import on_nodes


@dataclass(frozen=True)
class Width:
    """Domain of a point contact across entrainment, abs(Y) <= ``side``."""

    nodes: int
    side: float  # largest Y, in semi-axes along entrainment
    # Whether the contact is symmetric about Y = 0. If it is, and the number of nodes is odd, the film is
    # solved for Y >= 0 only.
    symmetric: bool = True

    @property
    def halved(self) -> bool:
        """Whether the film is solved for Y >= 0 only."""
        return self.symmetric and self.nodes % 2 == 1

    @property
    def y(self) -> Array:
        """Positions Y of the nodes of the solution, from 0 or from -side to side, shape (ny,)."""
        if self.halved:
            return np.linspace(0.0, self.side, self.nodes // 2 + 1)
        return np.linspace(-self.side, self.side, self.nodes)

    def coarser(self) -> Width:
        """Domain with half the number of intervals and the same range of Y."""
        nodes = 2 * (self.y.size // 2) + 1 if self.halved else self.nodes // 2 + 1
        # If the finest grid covers the whole domain, all coarser grids also cover it.
        return replace(self, nodes=nodes, symmetric=self.halved)


@dataclass(frozen=True)
class Mesh:
    """Uniform grid of a contact, dimensionless."""

    # x and y: equidistant positions along and across entrainment. A line contact has one position y = 0,
    # shapes (nx,).
    x: Array
    y: Array
    symmetric: bool = False  # whether the mesh covers only y >= 0 of a symmetric contact

    @classmethod
    def over(cls, nodes: int, inlet: float, outlet: float, width: Width | None = None) -> Mesh:
        """Mesh with ``nodes`` nodes along x from ``inlet`` to ``outlet``.

        ``width`` is the domain of a point contact across entrainment; None makes the mesh of a line contact.
        """
        x = np.linspace(inlet, outlet, nodes)
        y = np.zeros(1) if width is None else width.y
        return cls(x, y, symmetric=width is not None and width.halved)

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of nodes (nx, ny) along and across entrainment."""
        return self.x.size, self.y.size

    @property
    def dx(self) -> float:
        """Grid spacing along entrainment, dimensionless."""
        return float(self.x[-1] - self.x[0]) / (self.x.size - 1)

    @property
    def dy(self) -> float | None:
        """Grid spacing across entrainment, dimensionless; None for a line contact."""
        return None if self.y.size == 1 else float(self.y[-1] - self.y[0]) / (self.y.size - 1)

    @property
    def weights_along(self) -> Array:
        """Trapezoidal weights of the integral over x, shape (nx,)."""
        return trapezoidal_weights(self.x.size, self.dx)

    @property
    def weights_across(self) -> Array:
        """Trapezoidal weights of the integral over y, shape (ny,).

        For a symmetric contact they include the half y < 0. A line contact has the weight one.
        """
        if self.dy is None:
            return np.ones(1)
        return trapezoidal_weights(self.y.size, 2.0 * self.dy if self.symmetric else self.dy)

    @property
    def weights(self) -> Array:
        """Weights of the integral over the contact, shape (nx, ny)."""
        return self.weights_along[:, np.newaxis] * self.weights_across

    @cached_property
    def inner(self) -> Mask:
        """Mask of the nodes inside the domain, shape (nx, ny).

        It is False on the edges of the domain. A line of symmetry is not an edge.
        """
        inner = np.ones(self.shape, dtype=bool)
        inner[[0, -1]] = False
        if self.y.size > 1:
            inner[:, -1] = False
            inner[:, 0] &= self.symmetric
        return inner

    @property
    def edge(self) -> Mask:
        """Mask of the nodes on the edges of the domain, shape (nx, ny); a line of symmetry is not an edge."""
        return ~self.inner

    def mirrored(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values over the whole contact, from nodal values (nx, ny).

        If the mesh covers only y >= 0, the mirror image is added; otherwise the values are returned
        unchanged.
        """
        return np.concatenate([values[:, :0:-1], values], axis=1) if self.symmetric else values

    @property
    def whole_y(self) -> Array:
        """Positions across entrainment of the whole contact, for the values that ``mirrored`` returns."""
        return np.concatenate([-self.y[:0:-1], self.y]) if self.symmetric else self.y


def trapezoidal_weights(count: int, spacing: float) -> Array:
    """Weights of the trapezoidal rule on equidistant nodes, shape (count,), in the unit of the spacing."""
    weights = np.full(count, spacing)
    weights[[0, -1]] *= 0.5
    return weights


def at_centre(mesh: Mesh, values: Array) -> float:
    """Value at the centre of the contact, X = Y = 0, by linear interpolation of nodal values. ``values``,
    nodal values, in any unit, shape (nx, ny).
    """
    # The two rows on either side of X = 0 suffice.
    after = min(max(int(np.searchsorted(mesh.x, 0.0)), 1), mesh.x.size - 1)
    rows = slice(after - 1, after + 1)
    line = [np.interp(0.0, mesh.y, row) for row in values[rows]]
    return float(np.interp(0.0, mesh.x[rows], line))


def on_mesh(values: Array, of: Mesh, mesh: Mesh) -> Array:
    """Nodal values on another mesh of the same contact, by linear interpolation. ``values``, values on the
    mesh ``of``, shape (..., nx, ny). Returns values on ``mesh``, shape (..., nx', ny'); the given array if
    both meshes have the same nodes.

    Examples
    --------
    >>> of, mesh = Mesh.over(3, 0.0, 2.0), Mesh.over(5, 0.0, 2.0)
    >>> on_mesh(np.array([[0.0], [1.0], [4.0]]), of, mesh)[:, 0].tolist()
    [0.0, 0.5, 1.0, 2.5, 4.0]
    """
    return on_nodes(values, (of.x, of.y), (mesh.x, mesh.y))
