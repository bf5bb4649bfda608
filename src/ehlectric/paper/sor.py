"""Electric field of a line contact by the paper's own method: point successive over-relaxation (SOR).

The grid is Cartesian. The equations are (16), (17) and (A1) to (A5) of Morris et al. (2022),
doi:10.3390/lubricants10050087, extended to cells of any shape. With unequal distances ("arms") h_W, h_E, h_S
and h_N from node (l, k) to its neighbours, the coefficient a_1 of the eastern neighbour is::

    a_1 = (eps_(l,k) + eps_(l,k-1))/2 dy^2 2/(h_E (h_E + h_W))

with a_0 = a_1 + a_2 + a_3 + a_4 and Q = rho_q dy^2. Where all arms are dx = dy, these are the equations of
the paper. An arm that meets a surface ends there, at the potential of the surface (Shortley and Weller 1938,
doi:10.1063/1.1710426).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.constants import epsilon_0
from scipy.interpolate import CubicSpline

from ehlectric.arrays import Array, IntArray
from ehlectric.errors import ConvergenceError
from ehlectric.field.line import Field, field_from_potential
from ehlectric.field.poisson import FieldProblem, lobatto_nodes

# Rows in the least gap. Eight are enough: across a film the potential is nearly linear, and the error comes
# from the spacing of the columns.
ROWS = 8

# Residual of eq. (16) over the voltage at which the sweeps stop, and largest number of sweeps.
TOLERANCE = 1e-10
MOST_SWEEPS = 100_000

# Largest number of nodes of the Cartesian grid, including those inside the bodies.
MOST_NODES = 3e7

# A node nearer to a surface than this part of the row spacing counts as on the surface.
_ON_SURFACE = 1e-9
EAST, NORTH, WEST, SOUTH = range(4)


@dataclass(frozen=True)
class CartesianGrid:
    """Cartesian grid over the gap, whose unknowns are the potentials of the nodes between the surfaces.

    Attributes
    ----------
    x : ndarray, shape (nx,)
        Positions of the columns [m].
    lower, upper : ndarray, shape (nx,)
        Heights of the two surfaces at the columns [m].
    y : ndarray, shape (ny,)
        Heights of the equidistant rows [m].
    column, row : ndarray of int, shape (n,)
        Column and row of every unknown. Unknowns with even column + row come first.
    number : ndarray of int, shape (nx, ny)
        Number of the unknown at a node; -1 where the node is none.
    even : int
        Number of unknowns with even column + row.
    """

    x: Array
    lower: Array
    upper: Array
    y: Array
    column: IntArray
    row: IntArray
    number: IntArray
    even: int

    @classmethod
    def over(cls, x: Array, lower: Array, upper: Array, *, rows: int) -> CartesianGrid:
        """Create a grid with ``rows`` rows in the least gap.

        Raises
        ------
        ConvergenceError
            Where the grid would have more than 3e7 nodes.
        """
        dy = float(np.min(upper - lower)) / rows
        nodes = x.size * float(np.max(upper) - np.min(lower)) / dy
        if nodes > MOST_NODES:
            raise ConvergenceError(
                f"the paper's Cartesian grid would have {nodes:.2g} nodes, {rows} rows in the least gap, "
                f"and takes at most {MOST_NODES:.0e}: narrow grid.field_range, or leave --solver paper out"
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

    Attributes
    ----------
    grid : CartesianGrid
        Nodes and surfaces.
    neighbour : ndarray of int, shape (4, n)
        Numbers of the neighbours of every unknown; n is the lower surface and n + 1 the upper one.
    share : ndarray, shape (4, n)
        Coefficients a_1 to a_4 over a_0.
    source : ndarray or float
        Contribution of free charge [V], shape (n,) where there is any.
    arm : ndarray, shape (4, n)
        Distances to the neighbours [m].
    permittivity : ndarray, shape (4, n)
        Relative permittivity on the arms.
    """

    grid: CartesianGrid
    neighbour: IntArray
    share: Array
    source: Array
    arm: Array
    permittivity: Array


def stencil(grid: CartesianGrid, cells: Array, charge_density: Array | None = None) -> Stencil:
    """Coefficients of eq. (16) at every unknown, (A1) to (A5) divided by a_0.

    Parameters
    ----------
    grid : CartesianGrid
        Nodes and surfaces.
    cells : ndarray, shape (nx - 1, ny - 1)
        Relative permittivity in the cells between the nodes.
    charge_density : ndarray, shape (n,), optional
        Density of free charge at the unknowns [C/m^3].

    Returns
    -------
    Stencil
        The coefficients. No flux leaves through the first and the last column: the neighbour beyond them is
        the mirror image of the one inside.
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
    return Stencil(grid, neighbour, a / a0, charge * grid.dy**2 / (epsilon_0 * a0), arm, permittivity)


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
        beside = column + step
        beyond = (beside < 0) | (beside >= grid.x.size)
        beside = np.where(beyond, column - step, beside)
        neighbour[side] = grid.number[beside, row]
        width = np.abs(grid.x[beside] - grid.x[column])
        below = (neighbour[side] < 0) & (y < 0.5 * (grid.lower[beside] + grid.upper[beside]))
        above = (neighbour[side] < 0) & ~below
        share = np.ones(n)
        for cut, wall, surface in ((below, lower_wall, grid.lower), (above, upper_wall, grid.upper)):
            here, there = surface[column[cut]], surface[beside[cut]]
            share[cut] = (y[cut] - here) / (there - here)
            neighbour[side, cut] = wall
        arm[side] = share * width
    return neighbour, arm


@dataclass(frozen=True)
class Relaxed:
    """Result of the over-relaxation.

    Attributes
    ----------
    potential : ndarray, shape (n + 2,)
        Potential of the unknowns, then of the lower and the upper surface [V].
    sweeps : int
        Number of sweeps.
    factor : float
        Damping factor zeta of eq. (17).
    """

    potential: Array
    sweeps: int
    factor: float


def over_relax(equations: Stencil, start: Array, *, factor: float, tolerance: float = TOLERANCE) -> Relaxed:
    """Solve eq. (16) by over-relaxation, eq. (17).

    A sweep updates the nodes with even column + row first, and then the others.

    Parameters
    ----------
    equations : Stencil
        Equations of the unknowns.
    start : ndarray, shape (n + 2,)
        Initial guess of the potential, then the potential of the lower and the upper surface [V].
    factor : float
        Damping factor zeta, from 0 to 2.
    tolerance : float
        Largest residual over the voltage at which the sweeps stop.

    Returns
    -------
    Relaxed
        Potential, and number of sweeps.

    Raises
    ------
    ConvergenceError
        Where 100 000 sweeps do not reach the tolerance.
    """
    v = start.copy()
    voltage = abs(v[-1] - v[-2])
    even, n = equations.grid.even, equations.grid.column.size
    halves = [
        (part, [np.ascontiguousarray(row) for row in equations.neighbour[:, part]], equations.share[:, part])
        for part in (slice(0, even), slice(even, n))
    ]
    for sweep in range(1, MOST_SWEEPS + 1):
        largest = 0.0
        for part, neighbours, shares in halves:
            residual = equations.source[part] - v[part]
            for neighbour, share in zip(neighbours, shares, strict=True):
                residual += share * v[neighbour]
            v[part] += factor * residual
            largest = max(largest, float(np.max(np.abs(residual), initial=0.0)))
        if largest <= tolerance * voltage:
            return Relaxed(v, sweep, factor)
    raise ConvergenceError(
        f"field stalled at the residual {largest / voltage:.1e} after {MOST_SWEEPS} sweeps"
    )


def young_factor(grid: CartesianGrid) -> float:
    """Optimal damping factor of a plate capacitor whose gap h is the largest gap of the grid.

    Young's factor 2/(1 + sqrt(1 - mu^2)), with the spectral radius of Jacobi's iteration
    mu = 1 - (1 - cos(pi dy/h)) dx^2/(dx^2 + dy^2).

    Examples
    --------
    >>> import numpy as np
    >>> x = np.linspace(0.0, 8.0, 9)
    >>> round(young_factor(CartesianGrid.over(x, 0.0 * x, 0.0 * x + 8.0, rows=8)), 4)
    1.5708
    """
    dx, height = float(np.median(np.diff(grid.x))), float(np.max(grid.upper - grid.lower))
    radius = 1.0 - (1.0 - math.cos(math.pi * grid.dy / height)) * dx**2 / (dx**2 + grid.dy**2)
    return 2.0 / (1.0 + math.sqrt(1.0 - radius**2))


def cartesian(problem: FieldProblem, rows: int) -> tuple[Stencil, Array]:
    """Equations of a field problem on a Cartesian grid, and an initial guess of the potential.

    Parameters
    ----------
    problem : FieldProblem
        Geometry, permittivity by column and potentials, SI units.
    rows : int
        Number of rows in the least gap.

    Returns
    -------
    equations : Stencil
        Equation (16) at every unknown.
    start : ndarray, shape (n + 2,)
        Potential that is linear across the gap, then that of the lower and the upper surface [V].

    Raises
    ------
    ValueError
        Where the problem has something that the paper's method lacks: free charge, potentials on the end
        faces, or a permittivity that varies across the gap.
    """
    if problem.charge_density is not None or problem.end_potentials is not None:
        raise ValueError("the paper's field has no free charge and no given end potentials")
    if problem.permittivity.ndim != 1:
        raise ValueError("the paper's permittivity is uniform across the gap")
    grid = CartesianGrid.over(problem.x, problem.lower, problem.upper, rows=rows)
    staggered = 0.5 * (problem.permittivity[1:] + problem.permittivity[:-1])
    cells = np.broadcast_to(staggered[:, np.newaxis], (grid.x.size - 1, grid.y.size - 1))
    gap = (grid.upper - grid.lower)[grid.column]
    share = (grid.y[grid.row] - grid.lower[grid.column]) / gap
    voltage = problem.potential_2 - problem.potential_1
    linear = np.concatenate(
        [problem.potential_1 + voltage * share, [problem.potential_1, problem.potential_2]]
    )
    return stencil(grid, cells), linear


def solve_field(problem: FieldProblem, *, rows: int = ROWS) -> Field:
    """Field between two conducting walls by the paper's successive over-relaxation.

    Parameters
    ----------
    problem : FieldProblem
        Geometry, permittivity by column and potentials, SI units; its ``x`` are the columns of the grid.
    rows : int
        Number of rows of the grid in the least gap, at least 4.

    Returns
    -------
    Field
        Field at the same nodes as from ``ehlectric.field.line.solve_field``. Between the rows, the potential
        is interpolated by cubic splines along the columns. ``capacitance`` follows from the energy of the
        field, ``capacitance_by_charge`` from the field on wall 1; they agree within the error of the grid.

    Raises
    ------
    ValueError
        Where the problem has free charge, end potentials or a permittivity that varies across the gap.
    ConvergenceError
        Where the grid would have too many nodes, or 100 000 sweeps do not reach the tolerance.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.linspace(0.0, 1e-3, 11)
    >>> plates = FieldProblem(x, 0.0 * x, 0.0 * x + 1e-6, 1.0 + 0.0 * x, 0.0, 1.0)
    >>> round(solve_field(plates).capacitance * 1e9, 6)
    8.854188
    """
    equations, linear = cartesian(problem, rows)
    relaxed = over_relax(equations, linear, factor=young_factor(equations.grid))
    return field_from(problem, equations, relaxed.potential)


def field_from(problem: FieldProblem, equations: Stencil, potential: Array) -> Field:
    """Field from the potential of the unknowns and the two surfaces, shape (n + 2,) [V].

    The derivative along y is that of cubic splines along the columns. The derivative along x is a difference
    between columns at the same height.
    """
    grid, voltage = equations.grid, problem.potential_2 - problem.potential_1
    s = np.append(lobatto_nodes(problem.degree), 0.5)
    gap = (problem.upper - problem.lower)[:, np.newaxis]
    y = problem.lower[:, np.newaxis] + gap * s
    v, by_y = _along_columns(grid, potential, y)
    # dV/dx at fixed y is dV/dx at fixed s minus dV/dy times the slope of the line of fixed s.
    slope = np.gradient(y, problem.x, axis=0, edge_order=2)
    by_x = np.gradient(v, problem.x, axis=0, edge_order=2) - slope * by_y
    strength = np.hypot(by_x, by_y)
    charge = problem.permittivity * strength[:, 0] * np.sqrt(1.0 + slope[:, 0] ** 2)
    field = field_from_potential(
        problem,
        v[:, :-1] - problem.potential_1,
        capacitance=epsilon_0 * _energy(equations, potential) / voltage**2,
        capacitance_density=epsilon_0 * charge / abs(voltage),
    )
    return replace(
        field,
        field_x=-by_x[:, :-1],
        field_y=-by_y[:, :-1],
        strength=strength[:, :-1],
        middle_strength=strength[:, -1],
    )


def _along_columns(grid: CartesianGrid, potential: Array, y: Array) -> tuple[Array, Array]:
    """Potential [V] and its derivative by y [V/m] at heights y (nx, m), from cubic splines along columns."""
    values, slopes = np.empty_like(y), np.empty_like(y)
    order = np.lexsort((grid.row, grid.column))
    starts = np.searchsorted(grid.column[order], np.arange(grid.x.size + 1))
    for column, (low, high) in enumerate(zip(grid.lower, grid.upper, strict=True)):
        unknowns = order[starts[column] : starts[column + 1]]
        nodes = np.concatenate([[low], grid.y[grid.row[unknowns]], [high]])
        spline = CubicSpline(nodes, np.concatenate([potential[-2:-1], potential[unknowns], potential[-1:]]))
        values[column], slopes[column] = spline(y[column]), spline(y[column], 1)
    return values, slopes


def _energy(equations: Stencil, potential: Array) -> float:
    """Integral of eps abs(grad V)^2 over the gap [V^2], a sum over all arms, each counted once."""
    grid = equations.grid
    widths = np.empty_like(grid.x)
    widths[1:-1] = 0.5 * (grid.x[2:] - grid.x[:-2])
    widths[0], widths[-1] = 0.5 * (grid.x[1] - grid.x[0]), 0.5 * (grid.x[-1] - grid.x[-2])
    drop = potential[equations.neighbour] - potential[: grid.column.size]
    across = np.empty_like(equations.arm)
    across[[EAST, WEST]] = grid.dy
    across[[NORTH, SOUTH]] = widths[grid.column]
    per_arm = equations.permittivity * drop**2 / equations.arm * across
    # An arm between two unknowns belongs to both; a mirrored neighbour beyond the end columns is no arm.
    per_arm[equations.neighbour < grid.column.size] *= 0.5
    per_arm[EAST, grid.column == grid.x.size - 1] = 0.0
    per_arm[WEST, grid.column == 0] = 0.0
    return float(np.sum(per_arm))
