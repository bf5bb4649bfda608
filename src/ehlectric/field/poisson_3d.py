"""Poisson's equation between two conductors in three dimensions, discretised in mapped coordinates.

div(eps grad V) = -rho_q/eps0 between z1(x, y) and z2(x, y), with s = (z - z1)/h, so that both walls are grid
surfaces. Galerkin: bilinear elements along x and y, one polynomial of a few degrees across the gap on
Gauss-Lobatto-Legendre nodes. The matrix is symmetric; conjugate gradients solve it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.constants import epsilon_0

from ehlectric.arrays import Array, Mask
from ehlectric.errors import ConvergenceError
from ehlectric.field.multigrid import NEIGHBOURS, GapMultigrid, neighbour_offsets
from ehlectric.field.poisson import GAUSS, Across

# Corners of a cell, and by the same order its Gauss points, as (along x, along y).
_CORNERS = ((0, 0), (0, 1), (1, 0), (1, 1))

# The side faces, as columns (nx, ny).
_FACES: tuple[tuple[int | slice, ...], ...] = ((0,), (-1,), (slice(None), 0), (slice(None), -1))

# Error of the potential in the norm of its energy, relative to that of the boundary values. The error
# of the capacitance by charge is at most as large, of that by energy its square; one column may hold it all.
TOLERANCE = 1e-11

# Films take about six, walls of slope 3 some forty.
MAX_ITERATIONS = 300
SidePotentials = tuple[Array | None, Array | None, Array | None, Array | None]


@dataclass(frozen=True)
class PointFieldProblem:
    """Two conductors and what is between them, in three dimensions.

    Parameters
    ----------
    x, y : ndarray, shapes (nx,), (ny,)
        Positions along the gap [m], increasing, any spacing, at least three each.
    lower, upper : ndarray, shape (nx, ny)
        Surfaces z1(x, y) < z2(x, y) [m], at ``potential_1`` and ``potential_2``.
    permittivity : ndarray, shape (nx, ny) or (nx, ny, degree + 1)
        Relative permittivity, uniform across the gap or at its nodes.
    potential_1, potential_2 : float
        Potentials of the walls [V], different.
    degree : int
        Polynomial degree across the gap, at least 2.
    charge_density : ndarray, shape (nx, ny, degree + 1), optional
        Free charge in the gap [C/m^3], at the nodes s = ``lobatto_nodes(degree)``.
    side_potentials : tuple of four ndarray or None, optional
        Potentials [V] on the faces x[0], x[-1], shape (ny, degree + 1), and y[0], y[-1], shape
        (nx, degree + 1). Through a face without one no flux leaves.
    """

    x: Array
    y: Array
    lower: Array
    upper: Array
    permittivity: Array
    potential_1: float
    potential_2: float
    degree: int = 6
    charge_density: Array | None = None
    side_potentials: SidePotentials | None = None

    @property
    def given_sides(self) -> SidePotentials:
        """Potentials on the four faces, none for a face without flux."""
        return self.side_potentials or (None, None, None, None)


def by_node(permittivity: Array) -> Array:
    """Permittivity as an array over (x, y, s), of length one across the gap where it is given by column."""
    return permittivity if permittivity.ndim == 3 else permittivity[:, :, np.newaxis]


def _between(values: Array, at: float, axis: int) -> Array:
    """Linear interpolation between neighbours along an axis, at a fraction of their distance."""
    v = np.moveaxis(values, axis, 0)
    interpolated: Array = np.moveaxis((1.0 - at) * v[:-1] + at * v[1:], 0, axis)
    return interpolated


def _at_points(values: Array) -> list[Array]:
    """Bilinear interpolation of nodal values (nx, ny, ...) to the four Gauss points of every cell."""
    along_x = [_between(values, g, 0) for g in GAUSS]
    return [_between(along_x[i], GAUSS[j], 1) for i, j in _CORNERS]


def _shapes() -> tuple[Array, Array, Array]:
    """Shape functions at the Gauss points, (corners, points), and their unit derivatives along x and y."""
    value = np.stack([1.0 - GAUSS, GAUSS])
    sign = np.array([[-1.0, -1.0], [1.0, 1.0]])
    return np.kron(value, value), np.kron(sign, value), np.kron(value, sign)


@dataclass(frozen=True)
class Operator:
    """The integral of eps grad W . grad V over the gap, as a matrix over nodal values (nx, ny, ns).

    With D the differentiation across the gap in each column it is D^T A D + D^T M + M^T D + C, and the four
    matrices couple nodes of the same s alone.
    """

    derivative: Array  # (ns, ns)
    across: sparse.dia_array  # A: both differentiated across the gap
    mixed: sparse.dia_array  # M: W across, V along
    transposed: sparse.dia_array  # M^T
    along: sparse.dia_array  # C: both along

    def __call__(self, v: Array) -> Array:
        """The matrix times nodal values."""
        value = v.reshape(-1)
        by_s = (v @ self.derivative.T).reshape(-1)
        flux = self.across @ by_s + self.mixed @ value
        result: Array = (self.along @ value + self.transposed @ by_s).reshape(v.shape)
        result += flux.reshape(v.shape) @ self.derivative
        return result


@dataclass(frozen=True)
class Quadrature:
    """Geometry and permittivity at the quadrature points: four Gauss points of a cell, the nodes across.

    The lists run over the Gauss points; slopes along x differ by the point's y alone, and along y by its x.
    """

    across: Across
    dx: Array  # (nx - 1, 1, 1)
    dy: Array  # (ny - 1, 1)
    gap: list[Array]  # 4 of (nx - 1, ny - 1, 1)
    slope_x: list[Array]  # 4 of (nx - 1, ny - 1, ns), dz/dx at fixed s
    slope_y: list[Array]  # the same by dy
    weight: list[Array]  # the same: permittivity times area and weight

    @classmethod
    def of(cls, problem: PointFieldProblem) -> Quadrature:
        """The quadrature of a problem."""
        across = Across.of_degree(problem.degree)
        dx = np.diff(problem.x)[:, np.newaxis, np.newaxis]
        dy = np.diff(problem.y)[:, np.newaxis]
        gap = (problem.upper - problem.lower)[:, :, np.newaxis]
        z = problem.lower[:, :, np.newaxis] + gap * across.nodes
        by_x = [_between(np.diff(z, axis=0) / dx, g, 1) for g in GAUSS]
        by_y = [_between(np.diff(z, axis=1) / dy, g, 0) for g in GAUSS]
        quarter = 0.25 * dx * dy * across.weights
        return cls(
            across=across,
            dx=dx,
            dy=dy,
            gap=_at_points(gap),
            slope_x=[by_x[j] for _, j in _CORNERS],
            slope_y=[by_y[i] for i, _ in _CORNERS],
            weight=[quarter * p for p in _at_points(by_node(problem.permittivity))],
        )

    def operator(self) -> Operator:
        """The matrix of the integral of eps grad W . grad V over x, y and z.

        With the slopes m of the surfaces of constant s, grad = (d/dx - (m_x/h) d/ds, d/dy - (m_y/h) d/ds,
        (1/h) d/ds) and dx dy dz = h dx dy ds.
        """
        value, by_x, by_y = _shapes()
        points = list(zip(self.weight, self.gap, self.slope_x, self.slope_y, strict=True))
        across = [w * (1.0 + mx**2 + my**2) / h for w, h, mx, my in points]
        pairs = np.einsum("ag,bg->abg", value, value)
        a = self._couplings(across, pairs)
        along = [w * h / self.dx**2 for w, h, _, _ in points] + [w * h / self.dy**2 for w, h, _, _ in points]
        pairs = np.concatenate([np.einsum("ag,bg->abg", d, d) for d in (by_x, by_y)], axis=2)
        c = self._couplings(along, pairs)
        mixed = [-w * mx / self.dx for w, _, mx, _ in points] + [-w * my / self.dy for w, _, _, my in points]
        pairs = np.concatenate([np.einsum("ag,bg->abg", value, d) for d in (by_x, by_y)], axis=2)
        m, transposed = self._couplings(mixed, pairs), self._couplings(mixed, np.swapaxes(pairs, 0, 1))
        return Operator(self.across.derivative, a, m, transposed, c)

    def _couplings(self, points: list[Array], pairs: Array) -> sparse.dia_array:
        """Matrix over the nodes of given values at points, and products of shapes (corner, corner, point)."""
        stacked = np.stack(points)
        cells = stacked.shape[1:]
        nx, ny, ns = cells[0] + 1, cells[1] + 1, cells[2]
        # Row by the neighbour; a diagonal's entry stands at its column, as scipy has it.
        data = np.zeros((9, nx, ny, ns))
        for row, (i, j) in enumerate(_CORNERS):
            blocks = (pairs[row] @ stacked.reshape(len(points), -1)).reshape(4, *cells)
            for block, (k, m) in zip(blocks, _CORNERS, strict=True):
                diagonal = data[NEIGHBOURS.index((k - i, m - j))]
                diagonal[k : k + nx - 1, m : m + ny - 1] += block
        offsets = ns * neighbour_offsets(ny)
        return sparse.dia_array((data.reshape(9, -1), offsets), shape=(nx * ny * ns, nx * ny * ns))

    def charge(self, density: Array) -> Array:
        """Right side of a charge density (nx, ny, ns): the integral of W rho_q/eps0."""
        load = np.zeros_like(density)
        nx, ny, _ = density.shape
        quarter = 0.25 * self.dx * self.dy * self.across.weights / epsilon_0
        for g, at_point in enumerate(_at_points(density)):
            cell = quarter * self.gap[g] * at_point
            for (i, j), shape in zip(_CORNERS, _shapes()[0][:, g], strict=True):
                load[i : i + nx - 1, j : j + ny - 1] += shape * cell
        return load

    def energy(self, v: Array) -> float:
        """Integral of eps abs(grad V)^2, from the gradients at the quadrature points [V^2 m]."""
        by_s = _at_points(v @ self.across.derivative.T)
        by_x = [_between(np.diff(v, axis=0) / self.dx, g, 1) for g in GAUSS]
        by_y = [_between(np.diff(v, axis=1) / self.dy, g, 0) for g in GAUSS]
        total = 0.0
        for g, (i, j) in enumerate(_CORNERS):
            ez = by_s[g] / self.gap[g]
            square = (by_x[j] - self.slope_x[g] * ez) ** 2 + (by_y[i] - self.slope_y[g] * ez) ** 2 + ez**2
            total += float(np.sum(self.weight[g] * self.gap[g] * square))
        return total


def fixed_columns(problem: PointFieldProblem) -> Mask:
    """Columns on the faces whose potential is given, shape (nx, ny)."""
    fixed = np.zeros(problem.lower.shape, dtype=bool)
    for face, potentials in zip(_FACES, problem.given_sides, strict=True):
        fixed[face] |= potentials is not None
    return fixed


class PotentialSolver:
    """The discretised problem, its boundary values, and conjugate gradients for what is inside."""

    def __init__(self, problem: PointFieldProblem) -> None:
        self.problem = problem
        self.quadrature = Quadrature.of(problem)
        self.operator = self.quadrature.operator()
        self.fixed = fixed_columns(problem)
        self.preconditioner = GapMultigrid(
            problem.x,
            problem.y,
            across=self._summed(self.operator.across),
            along=self._summed(self.operator.along),
            fixed=self.fixed,
            of_gap=self.quadrature.across,
        )

    def _summed(self, couplings: sparse.dia_array) -> Array:
        """Couplings between columns (9, nx * ny), summed over the gap."""
        ns = self.quadrature.across.nodes.size
        summed: Array = couplings.data.reshape(9, -1, ns).sum(axis=2)
        return summed

    def lifted(self) -> Array:
        """Potential above wall 1 with the boundary values: linear across, or given on the side faces."""
        problem, s = self.problem, self.quadrature.across.nodes
        lifted = np.empty((*problem.lower.shape, s.size))
        lifted[...] = (problem.potential_2 - problem.potential_1) * s
        for face, potentials in zip(_FACES, problem.given_sides, strict=True):
            if potentials is not None:
                lifted[face][:, 1:-1] = potentials[:, 1:-1] - problem.potential_1
        return lifted

    def solve(self, load: Array | None = None) -> tuple[Array, int]:
        """Nodal potential above wall 1 [V], with the right side of a charge, and the iterations it took."""
        lifted = self.lifted()
        product = self.operator(lifted)
        scale = float(np.vdot(lifted, product))
        right = self._inside(-product if load is None else load - product)
        inside, iterations = conjugate_gradients(
            lambda v: self._inside(self.operator(v)), self.preconditioner, right, scale=scale
        )
        return lifted + inside, iterations

    def _inside(self, residual: Array) -> Array:
        """The residual with zeros where the potential is given, in place."""
        residual[:, :, 0] = residual[:, :, -1] = 0.0
        residual[self.fixed] = 0.0
        return residual


def conjugate_gradients(
    operator: Callable[[Array], Array],
    preconditioner: Callable[[Array], Array],
    right: Array,
    *,
    scale: float,
) -> tuple[Array, int]:
    """Preconditioned conjugate gradients from zero.

    Parameters
    ----------
    operator, preconditioner : callable
        Symmetric and positive definite.
    right : ndarray
        Right side.
    scale : float
        Square of the energy norm that the error is measured by, unless the solution's is larger.

    Returns
    -------
    ndarray, int
        The solution, its error ``TOLERANCE`` in the energy norm, and the iterations it took.

    Raises
    ------
    ConvergenceError
        Where ``MAX_ITERATIONS`` are not enough.
    """
    solution = np.zeros_like(right)
    residual = right.copy()
    direction = preconditioner(residual)
    # With a good preconditioner the product of residual and correction is the error's energy.
    error = float(np.vdot(residual, direction))
    limit = TOLERANCE**2 * max(scale, error)
    for iteration in range(MAX_ITERATIONS):
        if error <= limit:
            return solution, iteration
        change = operator(direction)
        step = error / float(np.vdot(direction, change))
        solution += step * direction
        residual -= step * change
        correction = preconditioner(residual)
        error, before = float(np.vdot(residual, correction)), error
        direction *= error / before
        direction += correction
    raise ConvergenceError(f"the field's conjugate gradients did not converge in {MAX_ITERATIONS} iterations")
