"""Preconditioner for the electric field of a point contact: modes across the gap, multigrid along it.

The potential is expanded in modes across the gap. Between flat walls the modes are independent, and each
obeys a screened Poisson equation over (x, y): -div(h eps grad u) + (lambda eps/h) u = f, with lambda near
(k pi)^2. Slopes of the walls couple the modes weakly. One V-cycle solves for all modes approximately. Because
it relaxes lines along x and along y, it also converges on stretched grids, and for gaps that are much wider
or narrower than the grid spacing.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.field.poisson import Across
from ehlectric.formulas.polynomials import interval, linear_interpolation

# An axis with at most this many nodes is not coarsened. With fewer than three nodes, index offsets of the
# nine neighbours would coincide.
COARSEST = 4

# Damping factor of the line relaxation. All lines are relaxed at once, and undamped they overshoot: an error
# that alternates from line to line has the eigenvalue 2. On stretched grids with much wider gaps, no other
# part of the cycle reduces this error.
DAMPING = 0.8

# The nine columns that a column is coupled to, as steps along x and y; the column itself is in the middle.
NEIGHBOURS = tuple(product((-1, 0, 1), repeat=2))


def neighbour_offsets(ny: int) -> IntArray:
    """Index offsets of the ``NEIGHBOURS`` among columns numbered with y fastest, shape (9,)."""
    offsets: IntArray = np.array(NEIGHBOURS) @ np.array([ny, 1])
    return offsets


def gap_modes(across: Across) -> tuple[Array, Array]:
    """Eigenmodes of -d2/ds2 across the gap that vanish on both walls. Returns ``eigenvalues``, eigenvalues of
    -d2/ds2, ascending, shape (ns - 2,); ``modes``, modes at the nodes, orthonormal with the weights of the
    quadrature, shape (ns, ns - 2).

    Examples
    --------
    The lowest eigenvalues are (k pi)^2 with k = 1, 2, ..., as for a vibrating string:

    >>> eigenvalues, _ = gap_modes(Across.of_degree(12))
    >>> [round(float(v), 6) for v in np.sqrt(eigenvalues[:3]) / np.pi]
    [1.0, 2.0, 3.0]
    """
    stiffness = across.derivative.T @ (across.weights[:, np.newaxis] * across.derivative)
    inner = slice(1, -1)
    eigenvalues, inside = scipy.linalg.eigh(stiffness[inner, inner], np.diag(across.weights[inner]))
    modes = np.zeros((across.nodes.size, eigenvalues.size))
    modes[inner] = inside
    return eigenvalues, modes


class _Lines:
    """Damped relaxation of all lines along one axis, with their tridiagonal matrices factorised as one."""

    def __init__(self, diagonal: Array, off_diagonal: Array) -> None:
        # The couplings from the end of one line to the start of the next are zero.
        self.factors = scipy.linalg.lapack.dpttrf(diagonal, off_diagonal[:-1])[:2]

    def __call__(self, right: Array) -> Array:
        solution: Array = scipy.linalg.lapack.dpttrs(*self.factors, right)[0]
        solution *= DAMPING
        return solution


class _Level:
    """One grid of the V-cycle for all modes, with its operator, relaxations and prolongation.

    ``shape`` is (modes, nx, ny); ``to_finer`` interpolates from the next coarser grid to this one.
    """

    def __init__(self, shape: tuple[int, int, int], matrix: scipy.sparse.dia_array) -> None:
        self.shape = shape
        self.matrix = matrix
        ny = shape[2]
        main, along_x, along_y = (
            np.append(matrix.diagonal(k), np.zeros(k)).reshape(shape) for k in (0, ny, 1)
        )
        self.lines_y = _Lines(main.ravel(), along_y.ravel())
        self.lines_x = _Lines(*(np.swapaxes(d, 1, 2).ravel() for d in (main, along_x)))
        self.to_finer: scipy.sparse.csr_array | None = None

    def relax_y(self, right: Array) -> Array:
        return self.lines_y(right)

    def relax_x(self, right: Array) -> Array:
        modes, nx, ny = self.shape
        turned = self.lines_x(np.swapaxes(right.reshape(self.shape), 1, 2).ravel())
        return np.swapaxes(turned.reshape(modes, ny, nx), 1, 2).ravel()


@dataclass(frozen=True)
class _Grid:
    """Couplings between the columns of one grid, summed over the gap.

    ``free`` marks the columns whose potential is unknown.
    """

    x: Array
    y: Array
    across: scipy.sparse.csr_array
    along: scipy.sparse.csr_array
    free: Mask  # (nx * ny,)

    @classmethod
    def finest(cls, x: Array, y: Array, *, across: Array, along: Array, free: Mask) -> _Grid:
        """Finest grid, from couplings stored by diagonals (9, nx * ny).

        Couplings to columns with a prescribed potential are neglected.
        """
        keep = scipy.sparse.diags_array(free.astype(float))
        offsets, shape = neighbour_offsets(y.size), (free.size, free.size)
        matrices = []
        for data in (across, along):
            couplings: scipy.sparse.dia_array[np.float64] = scipy.sparse.dia_array(
                (data, offsets), shape=shape
            )
            matrices.append(scipy.sparse.csr_array(keep @ couplings @ keep))
        return cls(x, y, _with_identity(matrices[0], free), matrices[1], free)

    def is_thin(self, eigenvalue: float) -> bool:
        """Whether the gap is everywhere so narrow that relaxation, without a coarser grid, solves the mode of
        an eigenvalue.
        """
        return bool(np.all(self.along.diagonal() <= eigenvalue * self.across.diagonal()))

    def level(self, eigenvalues: Array) -> _Level:
        """Level of the V-cycle on this grid, for the modes with these eigenvalues."""
        shape = (eigenvalues.size, self.x.size, self.y.size)
        offsets = neighbour_offsets(self.y.size)
        across, along = (_diagonals(m, offsets) for m in (self.across, self.along))
        data = along[:, np.newaxis] + eigenvalues[:, np.newaxis] * across[:, np.newaxis]
        n = int(np.prod(shape))
        return _Level(shape, scipy.sparse.dia_array((data.reshape(9, n), offsets), shape=(n, n)))

    def coarser(self) -> tuple[_Grid, scipy.sparse.csr_array]:
        """Next coarser grid, with every other column along both axes, and the prolongation from it.

        The couplings of the coarser grid are the Galerkin products.
        """
        (x, by_x), (y, by_y) = _every_other(self.x), _every_other(self.y)
        kept = self.free.reshape(self.x.size, self.y.size)
        free = kept[np.ix_(*(np.searchsorted(a, b) for a, b in ((self.x, x), (self.y, y))))].ravel()
        fine, coarse = (scipy.sparse.diags_array(mask.astype(float)) for mask in (self.free, free))
        prolong = scipy.sparse.csr_array(fine @ scipy.sparse.kron(by_x, by_y, format="csr") @ coarse)
        across, along = (
            scipy.sparse.csr_array(prolong.T @ (matrix @ prolong)) for matrix in (self.across, self.along)
        )
        return _Grid(x, y, _with_identity(across, free), along, free), prolong


def _every_other(x: Array) -> tuple[Array, scipy.sparse.csr_array]:
    """Every other position, including both ends, and the matrix of the linear interpolation from them."""
    if x.size <= COARSEST:
        return x, scipy.sparse.csr_array(scipy.sparse.eye_array(x.size))
    coarse = x[np.unique(np.append(np.arange(0, x.size, 2), x.size - 1))]
    return coarse, linear_interpolation(*interval(coarse, x), coarse.size)


def _with_identity(matrix: scipy.sparse.csr_array, free: Mask) -> scipy.sparse.csr_array:
    return scipy.sparse.csr_array(matrix + scipy.sparse.diags_array((~free).astype(float)))


def _diagonals(matrix: scipy.sparse.csr_array, offsets: IntArray) -> Array:
    """Diagonals of a square matrix as SciPy stores them: an entry is at its column of the matrix."""
    data = np.zeros((offsets.size, matrix.shape[0]))
    for row, offset in zip(data, offsets.tolist(), strict=True):
        diagonal = matrix.diagonal(offset)
        start = max(offset, 0)
        row[start : start + diagonal.size] = diagonal
    return data


class GapMultigrid:
    """Preconditioner of the field problem: one V-cycle over all modes, symmetric and positive definite.

    ``x`` and ``y``, positions of the columns [m], shapes (nx,); ``across`` and ``along``, couplings of each
    column with its neighbours, summed over the gap, from the derivatives across the gap and from the
    derivatives along x and y, shape (9, nx * ny); ``fixed``, columns with a prescribed potential,
    shape (nx, ny).
    """

    def __init__(
        self, x: Array, y: Array, *, across: Array, along: Array, fixed: Mask, of_gap: Across
    ) -> None:
        eigenvalues, self.modes = gap_modes(of_gap)
        grid = _Grid.finest(x, y, across=across, along=along, free=~fixed.ravel())
        self.levels = [grid.level(eigenvalues)]
        while max(grid.x.size, grid.y.size) > COARSEST and not grid.is_thin(eigenvalues[0]):
            grid, prolong = grid.coarser()
            self.levels[-1].to_finer = scipy.sparse.csr_array(
                scipy.sparse.kron(scipy.sparse.eye_array(eigenvalues.size), prolong, format="csr")
            )
            self.levels.append(grid.level(eigenvalues))

    def __call__(self, residual: Array) -> Array:
        """Correction of the potential for a residual, both (nx, ny, ns); it is zero on the walls."""
        by_mode = self.modes.T @ residual.reshape(-1, residual.shape[2]).T
        corrected = self._cycle(by_mode.ravel(), 0).reshape(by_mode.shape)
        return (corrected.T @ self.modes.T).reshape(residual.shape)

    def _cycle(self, right: Array, depth: int) -> Array:
        """Symmetric V-cycle from the level ``depth``, on the residual ``right`` of all modes.

        The steps are lines along x, lines along y, the coarser grid, lines along y, lines along x.
        """
        level = self.levels[depth]
        matrix = level.matrix
        u = level.relax_x(right)
        u += level.relax_y(right - matrix @ u)
        if level.to_finer is not None:
            coarse = level.to_finer.T @ (right - matrix @ u)
            u += level.to_finer @ self._cycle(coarse, depth + 1)
            u += level.relax_y(right - matrix @ u)
        u += level.relax_x(right - matrix @ u)
        return u
