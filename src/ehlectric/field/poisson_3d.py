"""Poisson's equation in the gap of a point contact, discretised in coordinates that follow the walls.

div(eps grad V) = -rho_q/eps0 is solved between the walls z1(x, y) and z2(x, y). With the coordinate
s = (z - z1)/h both walls are grid surfaces. The Galerkin method takes bilinear elements along x and y, and
one polynomial across the gap on Gauss-Lobatto-Legendre nodes. The matrix is symmetric and positive definite;
the system is solved by preconditioned conjugate gradients.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.constants import EPSILON_0
from ehlectric.errors import ConvergenceError
from ehlectric.field.field_multigrid import NEIGHBOURS, GapMultigrid, neighbour_offsets
from ehlectric.field.poisson import GAUSS, Across

# Corners of a cell as steps (along x, along y). Its four Gauss points are numbered in the same order.
_CORNERS = ((0, 0), (0, 1), (1, 0), (1, 1))

# Indices of the columns on each of the four side faces in an array (nx, ny).
_FACES: tuple[tuple[int | slice, ...], ...] = ((0,), (-1,), (slice(None), 0), (slice(None), -1))

# Error of the potential at which the iteration stops, in the energy norm and relative to the energy norm of
# the boundary values. It bounds the relative error of the capacitance from the charge; the error of the
# capacitance from the energy is its square. In the worst case all of the error lies in one column.
TOLERANCE = 1e-11

# Largest number of iterations. Lubricant films take about six, walls with a slope of 3 about forty.
MAX_ITERATIONS = 300

# Potentials on the faces x[0], x[-1], y[0] and y[-1].
SidePotentials = tuple[Array | None, Array | None, Array | None, Array | None]


@dataclass(frozen=True)
class PointFieldProblem:
    """Problem of the electric field between the two conducting walls of a point contact, in SI units.

    ``x`` and ``y``, positions along the gap [m], increasing, any spacing, at least three each, shapes (nx,);
    ``lower`` and ``upper``, heights z1(x, y) < z2(x, y) of the walls [m], shape (nx, ny); ``permittivity``,
    relative permittivity, one value per column or one per node, shape (nx, ny) or (nx, ny, degree + 1);
    ``potential_1`` and ``potential_2``, potentials of the walls [V]; they must differ; ``degree``, polynomial
    degree across the gap, at least 2; ``most_degree``, degree up to which ``solve_point_field`` may raise the
    degree, where the largest field would else be more than 0.5 % off; ``degree`` by default;
    ``charge_density``, density of free charge [C/m^3] at the nodes s = ``lobatto_nodes(degree)``; no charge
    by default, shape (nx, ny, degree + 1); ``side_potentials``, potentials [V] on the faces x[0] and x[-1],
    shape (ny, degree + 1), and on the faces y[0] and y[-1], shape (nx, degree + 1).
    """

    x: Array
    y: Array
    lower: Array
    upper: Array
    permittivity: Array
    potential_1: float
    potential_2: float
    degree: int = 6
    most_degree: int | None = None
    charge_density: Array | None = None
    side_potentials: SidePotentials | None = None

    @property
    def positions(self) -> dict[str, Array]:
        """Positions of the columns [m], by the name of their axis."""
        return {"x": self.x, "y": self.y}

    @property
    def plain(self) -> bool:
        """Whether the permittivity is constant across the gap, and only the walls have given potentials."""
        prescribed = self.charge_density is not None or self.side_potentials is not None
        return self.permittivity.ndim == self.lower.ndim and not prescribed

    @property
    def given_sides(self) -> SidePotentials:
        """Potentials on the faces x[0], x[-1], y[0] and y[-1] [V]; None for a face without flux."""
        return self.side_potentials or (None, None, None, None)


def by_node(permittivity: Array) -> Array:
    """Permittivity as an array over (x, y, s): shape (nx, ny, ns), or (nx, ny, 1) for values per column."""
    return permittivity if permittivity.ndim == 3 else permittivity[:, :, np.newaxis]


def _between(values: Array, at: float, axis: int) -> Array:
    """Linear interpolation between neighbours along an axis, at the fraction ``at`` of their distance."""
    v = np.moveaxis(values, axis, 0)
    return np.moveaxis((1.0 - at) * v[:-1] + at * v[1:], 0, axis)


def _at_points(values: Array) -> list[Array]:
    """Bilinear interpolation of nodal values (nx, ny, ...) to the four Gauss points of every cell."""
    along_x = [_between(values, g, 0) for g in GAUSS]
    return [_between(along_x[i], GAUSS[j], 1) for i, j in _CORNERS]


def _shapes() -> tuple[Array, Array, Array]:
    """Bilinear shape functions at the Gauss points, and their derivatives along x and y on a unit cell.

    Each array has the shape (corners, points).
    """
    value = np.stack([1.0 - GAUSS, GAUSS])
    sign = np.array([[-1.0, -1.0], [1.0, 1.0]])
    return np.kron(value, value), np.kron(sign, value), np.kron(value, sign)


@dataclass(frozen=True)
class Operator:
    """Matrix of the integral of eps grad W . grad V over the gap, for nodal values (nx, ny, ns).

    W is the test function. With the matrix D that differentiates each column across the gap, the matrix is
    D^T A D + D^T M + M^T D + C. Each of A, M and C couples only nodes of equal s.
    """

    derivative: Array  # D, the derivative d/ds at the nodes of one column, shape (ns, ns)
    across: scipy.sparse.dia_array  # A, the product of the derivatives of W and V across the gap
    # mixed and transposed: M, the product of the derivative of W across the gap and the derivative of V along
    # it; and M^T.
    mixed: scipy.sparse.dia_array
    transposed: scipy.sparse.dia_array
    along: scipy.sparse.dia_array  # C, the product of the derivatives of W and V along the gap

    def __call__(self, v: Array) -> Array:
        """Product of the matrix and nodal values, shape (nx, ny, ns)."""
        value = v.reshape(-1)
        by_s = (v @ self.derivative.T).reshape(-1)
        flux = self.across @ by_s + self.mixed @ value
        result: Array = (self.along @ value + self.transposed @ by_s).reshape(v.shape)
        result += flux.reshape(v.shape) @ self.derivative
        return result


@dataclass(frozen=True)
class Quadrature:
    """Geometry and permittivity at the quadrature points of the cells.

    The quadrature points of a cell are its four Gauss points over (x, y), each with the ns nodes across the
    gap.
    """

    across: Across
    # dx and dy: lengths of the cells along x and y [m], shapes (nx - 1, 1, 1).
    dx: Array
    dy: Array
    gap: list[Array]  # gap at each Gauss point [m], shape (nx - 1, ny - 1, 1)
    # slope_x and slope_y: slopes dz/dx and dz/dy of the surfaces of constant s at each Gauss point,
    # shape (nx - 1, ny - 1, ns).
    slope_x: list[Array]
    slope_y: list[Array]
    # Relative permittivity times the quadrature weight, an area [m^2], at each Gauss point,
    # shape (nx - 1, ny - 1, ns).
    weight: list[Array]

    @classmethod
    def of(cls, problem: PointFieldProblem) -> Quadrature:
        """Quadrature of a field problem."""
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
        """Matrix of the integral of eps grad W . grad V over x, y and z, with test functions W.

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

    def _couplings(self, points: list[Array], pairs: Array) -> scipy.sparse.dia_array:
        """Matrix over the nodes, summed over the quadrature points.

        ``points`` holds the factor at each point, ``pairs`` the products of two shape functions, of shape
        (corner, corner, point).
        """
        stacked = np.stack(points)
        cells = stacked.shape[1:]
        nx, ny, ns = cells[0] + 1, cells[1] + 1, cells[2]
        # One row per neighbour. SciPy stores the entry of a diagonal at the column of the matrix.
        data = np.zeros((9, nx, ny, ns))
        for row, (i, j) in enumerate(_CORNERS):
            blocks = (pairs[row] @ stacked.reshape(len(points), -1)).reshape(4, *cells)
            for block, (k, m) in zip(blocks, _CORNERS, strict=True):
                diagonal = data[NEIGHBOURS.index((k - i, m - j))]
                diagonal[k : k + nx - 1, m : m + ny - 1] += block
        offsets = ns * neighbour_offsets(ny)
        return scipy.sparse.dia_array((data.reshape(9, -1), offsets), shape=(nx * ny * ns, nx * ny * ns))

    def charge(self, density: Array) -> Array:
        """Integral of W rho_q/eps0 [V m], the right side for a charge density (nx, ny, ns) [C/m^3]."""
        load = np.zeros_like(density)
        nx, ny, _ = density.shape
        quarter = 0.25 * self.dx * self.dy * self.across.weights / EPSILON_0
        for g, at_point in enumerate(_at_points(density)):
            cell = quarter * self.gap[g] * at_point
            for (i, j), shape in zip(_CORNERS, _shapes()[0][:, g], strict=True):
                load[i : i + nx - 1, j : j + ny - 1] += shape * cell
        return load

    def energy(self, v: Array) -> float:
        """Integral of eps abs(grad V)^2 over x, y and z [V^2 m], for nodal potentials V (nx, ny, ns) [V].

        It is computed from the gradients at the quadrature points.
        """
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
    """Mask of the columns on side faces with a prescribed potential, shape (nx, ny)."""
    fixed = np.zeros(problem.lower.shape, dtype=bool)
    for face, potentials in zip(_FACES, problem.given_sides, strict=True):
        fixed[face] |= potentials is not None
    return fixed


class PotentialSolver:
    """Solver for the potential of a discretised field problem, by preconditioned conjugate gradients."""

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

    def _summed(self, couplings: scipy.sparse.dia_array) -> Array:
        """Couplings of each column with its neighbours, summed over the gap, shape (9, nx * ny)."""
        ns = self.quadrature.across.nodes.size
        summed: Array = couplings.data.reshape(9, -1, ns).sum(axis=2)
        return summed

    def lifted(self) -> Array:
        """Potential relative to wall 1 that fulfils the boundary conditions [V], shape (nx, ny, ns).

        It is linear across the gap, except on side faces with a prescribed potential.
        """
        problem, s = self.problem, self.quadrature.across.nodes
        lifted = np.empty((*problem.lower.shape, s.size))
        lifted[...] = (problem.potential_2 - problem.potential_1) * s
        for face, potentials in zip(_FACES, problem.given_sides, strict=True):
            if potentials is not None:
                lifted[face][:, 1:-1] = potentials[:, 1:-1] - problem.potential_1
        return lifted

    def solve(self, load: Array | None = None) -> tuple[Array, int]:
        """Nodal potential relative to wall 1 [V], and the number of conjugate-gradient iterations.

        ``load`` (nx, ny, ns) is the right side of a charge density (``Quadrature.charge``).
        """
        lifted = self.lifted()
        product = self.operator(lifted)
        scale = float(np.vdot(lifted, product))
        right = self._inside(-product if load is None else load - product)
        inside, iterations = conjugate_gradients(
            lambda v: self._inside(self.operator(v)), self.preconditioner, right, scale=scale
        )
        return lifted + inside, iterations

    def _inside(self, residual: Array) -> Array:
        """Set the residual to zero, in place, at the nodes where the potential is prescribed."""
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
    """Solve a linear system by preconditioned conjugate gradients, with the initial guess zero.

    ``operator`` and ``preconditioner``, matrix and approximate inverse, both applied to an array; symmetric
    and positive definite; ``scale``, square of the energy norm that ``TOLERANCE`` refers to, unless the
    energy norm of the solution is larger. Returns ``solution``, solution, with a relative error of at most
    about ``TOLERANCE`` in the energy norm; ``iterations``, number of iterations. Raises ConvergenceError if
    the error is above ``TOLERANCE`` after ``MAX_ITERATIONS`` iterations.
    """
    solution = np.zeros_like(right)
    residual = right.copy()
    direction = preconditioner(residual)
    # With a good preconditioner the product of residual and correction is the energy of the error.
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
    raise ConvergenceError(f"the electric field did not converge in {MAX_ITERATIONS} iterations")
