"""Electric field of a line contact by the paper's own method: point successive over-relaxation (SOR).

The equations on the Cartesian grid are the equations of ``ehlectric.paper.cartesian``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.errors import ConvergenceError
from ehlectric.field import Field, FieldProblem, field_from_potential
from ehlectric.formulas.polynomials import lobatto_nodes
from ehlectric.paper.cartesian import EAST, NORTH, SOUTH, WEST, CartesianGrid, Stencil, stencil

# Rows in the smallest gap. Eight are enough: across a film the potential is nearly linear, and the error
# comes from the spacing of the columns.
ROWS = 8

# Residual of eq. (16), divided by the voltage, at which the sweeps stop; and largest number of sweeps.
TOLERANCE = 1e-10
MOST_SWEEPS = 100_000


@dataclass(frozen=True)
class Relaxed:
    """Result of the over-relaxation."""

    potential: Array  # potential of the unknowns, then of the lower and the upper surface [V], shape (n + 2,)
    sweeps: int
    factor: float  # damping factor zeta of eq. (17)


def over_relax(equations: Stencil, start: Array, *, factor: float, tolerance: float = TOLERANCE) -> Relaxed:
    """Solve eq. (16) by over-relaxation, eq. (17).

    A sweep updates the nodes with even column + row first, and then the others.

    ``start``, initial guess of the potential, then the potential of the lower and the upper surface [V],
    shape (n + 2,). Returns potential, and number of sweeps. Raises ConvergenceError if 100 000 sweeps do not
    reach the tolerance.
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
    raise ConvergenceError(f"field, residual {largest / voltage:.1e} after {MOST_SWEEPS} sweeps")


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

    Returns ``equations``, equation (16) at every unknown; ``start``, potential that is linear across the gap,
    then the potentials of the lower and the upper surface [V], shape (n + 2,). Raises ValueError if the
    problem has something that the paper's method lacks: free charge, potentials on the end faces, or a
    permittivity that varies across the gap.
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

    ``rows``, number of rows of the grid in the smallest gap, at least 4. Returns field at the same nodes as
    from ``field.line_field.solve_field``. Raises ValueError if the problem has free charge, end potentials or
    a permittivity that varies across the gap; ConvergenceError if the grid would have too many nodes, or 100
    000 sweeps do not reach the tolerance.

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

    The derivative along y is computed from cubic splines along the columns. The derivative along x is a
    difference between columns at the same height.
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
        capacitance=scipy.constants.epsilon_0 * _energy(equations, potential) / voltage**2,
        capacitance_density=scipy.constants.epsilon_0 * charge / abs(voltage),
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
        spline = scipy.interpolate.CubicSpline(
            nodes, np.concatenate([potential[-2:-1], potential[unknowns], potential[-1:]])
        )
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
