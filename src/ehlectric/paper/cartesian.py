"""Cartesian grid between two surfaces, and the five-point equations of the potential on it.

The equations are (16), (17) and (A1) to (A5) of Morris et al. (2022), doi:10.3390/lubricants10050087,
extended to cells of any shape. With unequal distances ("arms") h_W, h_E, h_S and h_N from node (l, k) to its
neighbours, the coefficient a_1 of the eastern neighbour is::

    a_1 = (eps_(l,k) + eps_(l,k-1))/2 dy^2 2/(h_E (h_E + h_W))

with a_0 = a_1 + a_2 + a_3 + a_4 and Q = rho_q dy^2. If all arms are dx = dy, these are the equations of the
paper. An arm that meets a surface ends there, at the potential of the surface (Shortley and Weller 1938,
doi:10.1063/1.1710426).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray
from ehlectric.errors import ConvergenceError

# Largest number of nodes of the Cartesian grid, including nodes inside the bodies.
MOST_NODES = 3e7

# A node nearer to a surface than this part of the row spacing counts as on the surface.
_ON_SURFACE = 1e-9
EAST, NORTH, WEST, SOUTH = range(4)


@dataclass(frozen=True)
class CartesianGrid:
    """Cartesian grid over the gap, whose unknowns are the potentials of the nodes between the surfaces."""

    x: Array  # positions of the columns [m], shape (nx,)
    # lower and upper: heights of the two surfaces at the columns [m], shape (nx,).
    lower: Array
    upper: Array
    y: Array  # heights of the equidistant rows [m], shape (ny,)
    # column and row: column and row of every unknown. Unknowns with even column + row come first, shape (n,).
    column: IntArray
    row: IntArray
    number: IntArray  # number of the unknown at a node; -1 if the node is not an unknown, shape (nx, ny)
    even: int  # number of unknowns with even column + row

    @classmethod
    def over(cls, x: Array, lower: Array, upper: Array, *, rows: int) -> CartesianGrid:
        """Create a grid with ``rows`` rows in the smallest gap. Raises ConvergenceError if the grid would
        have more than 3e7 nodes.
        """
        dy = float(np.min(upper - lower)) / rows
        nodes = x.size * float(np.max(upper) - np.min(lower)) / dy
        if nodes > MOST_NODES:
            raise ConvergenceError(
                f"the paper's Cartesian grid would have {nodes:.2g} nodes, {rows} rows in the minimum gap; "
                f"expected at most {MOST_NODES:.0e}: narrow grid.field_range, or omit --solver paper"
            )
        y = np.arange(float(np.min(lower)), float(np.max(upper)) + dy, dy)
        margin = _ON_SURFACE * dy
        inside = (y > lower[:, np.newaxis] + margin) & (y < upper[:, np.newaxis] - margin)
        column, row = np.nonzero(inside)
        order = np.argsort((column + row) % 2, kind="stable")
        column, row = column[order], row[order]
        number = np.full(inside.shape, -1)
        number[column, row] = np.arange(column.size)
        return cls(x, lower, upper, y, column, row, number, int(np.sum((column + row) % 2 == 0)))

    @property
    def dy(self) -> float:
        """Distance between rows [m]."""
        return float(self.y[1] - self.y[0])


@dataclass(frozen=True)
class Stencil:
    """Equation (16) at every unknown: V = sum over the neighbours of share times their V, plus source.

    Arrays of shape (4, n) are in the order of a_1 to a_4: east, north, west, south.
    """

    grid: CartesianGrid
    # Numbers of the neighbours of every unknown; n is the lower surface and n + 1 the upper one,
    # shape (4, n).
    neighbour: IntArray
    share: Array  # coefficients a_1 to a_4 divided by a_0, shape (4, n)
    source: Array  # contribution of free charge [V], shape (n,) if there is any
    arm: Array  # distances to the neighbours [m], shape (4, n)
    permittivity: Array  # relative permittivity on the arms, shape (4, n)


def stencil(grid: CartesianGrid, cells: Array, charge_density: Array | None = None) -> Stencil:
    """Coefficients of eq. (16) at every unknown, (A1) to (A5) divided by a_0. ``cells``, relative
    permittivity in the cells between the nodes, shape (nx - 1, ny - 1); ``charge_density``, density of free
    charge at the unknowns [C/m^3], shape (n,).
    """
    neighbour, arm = _arms(grid)
    east = np.minimum(grid.column, grid.x.size - 2)
    west = np.maximum(grid.column - 1, 0)
    north = np.minimum(grid.row, cells.shape[1] - 1)
    south = np.maximum(grid.row - 1, 0)
    around = {
        (side, level): cells[column, row]
        for side, column in ((EAST, east), (WEST, west))
        for level, row in ((NORTH, north), (SOUTH, south))
    }
    permittivity = 0.5 * np.stack(
        [
            around[EAST, NORTH] + around[EAST, SOUTH],
            around[WEST, NORTH] + around[EAST, NORTH],
            around[WEST, SOUTH] + around[WEST, NORTH],
            around[EAST, SOUTH] + around[WEST, SOUTH],
        ]
    )
    opposite = arm[[WEST, SOUTH, EAST, NORTH]]
    a = permittivity * grid.dy**2 * 2.0 / (arm * (arm + opposite))
    a0 = a.sum(axis=0)
    charge = 0.0 if charge_density is None else charge_density
    return Stencil(
        grid, neighbour, a / a0, charge * grid.dy**2 / (scipy.constants.epsilon_0 * a0), arm, permittivity
    )


def _arms(grid: CartesianGrid) -> tuple[IntArray, Array]:
    """Neighbours of every unknown in the four directions, and the distances to them [m], each (4, n)."""
    n, dy = grid.column.size, grid.dy
    lower_wall, upper_wall = n, n + 1
    column, row = grid.column, grid.row
    y = grid.y[row]
    neighbour = np.empty((4, n), dtype=np.intp)
    arm = np.empty((4, n))
    neighbour[NORTH] = grid.number[column, np.minimum(row + 1, grid.y.size - 1)]
    neighbour[SOUTH] = grid.number[column, np.maximum(row - 1, 0)]
    for side, wall, distance in (
        (NORTH, upper_wall, grid.upper[column] - y),
        (SOUTH, lower_wall, y - grid.lower[column]),
    ):
        cut = neighbour[side] < 0
        neighbour[side, cut] = wall
        arm[side] = np.where(cut, distance, dy)
    for side, step in ((EAST, 1), (WEST, -1)):
        adjacent = column + step
        beyond = (adjacent < 0) | (adjacent >= grid.x.size)
        adjacent = np.where(beyond, column - step, adjacent)
        neighbour[side] = grid.number[adjacent, row]
        width = np.abs(grid.x[adjacent] - grid.x[column])
        below = (neighbour[side] < 0) & (y < 0.5 * (grid.lower[adjacent] + grid.upper[adjacent]))
        above = (neighbour[side] < 0) & ~below
        share = np.ones(n)
        for cut, wall, surface in ((below, lower_wall, grid.lower), (above, upper_wall, grid.upper)):
            here, there = surface[column[cut]], surface[adjacent[cut]]
            share[cut] = (y[cut] - here) / (there - here)
            neighbour[side, cut] = wall
        arm[side] = share * width
    return neighbour, arm
