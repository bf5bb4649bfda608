"""Preconditioner of the field in three dimensions: modes across the gap, multigrid along it.

Where the walls are flat the potential's modes across the gap decouple, and each obeys a screened Poisson
equation over (x, y): -div(h eps grad u) + (lambda eps/h) u = f with lambda near (k pi)^2. Slopes of the walls
couple them weakly. A V-cycle solves all modes at once, approximately, with lines along x and along y as its
relaxation, so that neither stretched grids nor gaps far wider or narrower than the columns hurt.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy import sparse
from scipy.linalg import eigh, lapack

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.field.poisson import Across

# A direction of at most this many nodes is not coarsened: three are the fewest whose couplings are distinct.
COARSEST = 4

# Of a relaxation by lines. All at once they overshoot: its eigenvalue is 2 for what alternates from line to
# line. Where columns are long one way and the gap is far wider, nothing else reduces that.
DAMPING = 0.8

# The nine columns that a column is coupled to, itself in the middle, as steps along x and y.
NEIGHBOURS = tuple(product((-1, 0, 1), repeat=2))


def neighbour_offsets(ny: int) -> IntArray:
    """Distances of the neighbours in the order of the columns, y fastest, shape (9,)."""
    offsets: IntArray = np.array(NEIGHBOURS) @ np.array([ny, 1])
    return offsets


def gap_modes(across: Across) -> tuple[Array, Array]:
    """Modes across the gap that vanish on both walls.

    Parameters
    ----------
    across : Across
        Nodes, weights and differentiation across the gap.

    Returns
    -------
    ndarray, shape (ns - 2,)
        Eigenvalues of -d2/ds2, ascending.
    ndarray, shape (ns, ns - 2)
        Modes at the nodes, orthonormal in the quadrature.

    Examples
    --------
    The lowest are those of a string, (k pi)^2 with k = 1, 2, ...

    >>> eigenvalues, _ = gap_modes(Across.of_degree(12))
    >>> [round(float(v), 6) for v in np.sqrt(eigenvalues[:3]) / np.pi]
    [1.0, 2.0, 3.0]
    """
    stiffness = across.derivative.T @ (across.weights[:, np.newaxis] * across.derivative)
    inner = slice(1, -1)
    eigenvalues, inside = eigh(stiffness[inner, inner], np.diag(across.weights[inner]))
    modes = np.zeros((across.nodes.size, eigenvalues.size))
    modes[inner] = inside
    return eigenvalues, modes


class _Lines:
    """Tridiagonal factors of all lines of a direction, one after the other in one matrix."""

    def __init__(self, diagonal: Array, beside: Array) -> None:
        # The couplings from the end of one line to the start of the next are zero.
        self.factors = lapack.dpttrf(diagonal, beside[:-1])[:2]

    def __call__(self, right: Array) -> Array:
        solution: Array = lapack.dpttrs(*self.factors, right)[0]
        solution *= DAMPING
        return solution


class _Level:
    """All modes on one grid: the operator, its relaxations, and the transfers to the next coarser grid."""

    def __init__(self, shape: tuple[int, int, int], matrix: sparse.dia_array) -> None:
        self.shape = shape
        self.matrix = matrix
        ny = shape[2]
        main, along_x, along_y = (
            np.append(matrix.diagonal(k), np.zeros(k)).reshape(shape) for k in (0, ny, 1)
        )
        self.lines_y = _Lines(main.ravel(), along_y.ravel())
        self.lines_x = _Lines(*(np.swapaxes(d, 1, 2).ravel() for d in (main, along_x)))
        self.to_finer: sparse.csr_array | None = None

    def relax_y(self, right: Array) -> Array:
        return self.lines_y(right)

    def relax_x(self, right: Array) -> Array:
        modes, nx, ny = self.shape
        turned = self.lines_x(np.swapaxes(right.reshape(self.shape), 1, 2).ravel())
        return np.swapaxes(turned.reshape(modes, ny, nx), 1, 2).ravel()


@dataclass(frozen=True)
class _Grid:
    """Couplings between the columns of one grid, summed over the gap, and the columns that are solved for."""

    x: Array
    y: Array
    across: sparse.csr_array
    along: sparse.csr_array
    free: Mask  # (nx * ny,)

    @classmethod
    def finest(cls, x: Array, y: Array, *, across: Array, along: Array, free: Mask) -> _Grid:
        """The grid of all columns, of couplings stored by diagonals; without those of given columns."""
        keep = sparse.diags_array(free.astype(float))
        offsets, shape = neighbour_offsets(y.size), (free.size, free.size)
        matrices = []
        for data in (across, along):
            couplings: sparse.dia_array[np.float64] = sparse.dia_array((data, offsets), shape=shape)
            matrices.append(sparse.csr_array(keep @ couplings @ keep))
        return cls(x, y, _with_identity(matrices[0], free), matrices[1], free)

    def is_thin(self, eigenvalue: float) -> bool:
        """Whether the gap is everywhere so narrow that relaxation alone solves even the lowest mode."""
        return bool(np.all(self.along.diagonal() <= eigenvalue * self.across.diagonal()))

    def level(self, eigenvalues: Array) -> _Level:
        """Operator and relaxations for all modes."""
        shape = (eigenvalues.size, self.x.size, self.y.size)
        offsets = neighbour_offsets(self.y.size)
        across, along = (_diagonals(m, offsets) for m in (self.across, self.along))
        data = along[:, np.newaxis] + eigenvalues[:, np.newaxis] * across[:, np.newaxis]
        n = int(np.prod(shape))
        return _Level(shape, sparse.dia_array((data.reshape(9, n), offsets), shape=(n, n)))

    def coarser(self) -> tuple[_Grid, sparse.csr_array]:
        """The grid of every other column either way, its couplings by Galerkin, and the prolongation."""
        (x, by_x), (y, by_y) = _every_other(self.x), _every_other(self.y)
        kept = self.free.reshape(self.x.size, self.y.size)
        free = kept[np.ix_(*(np.searchsorted(a, b) for a, b in ((self.x, x), (self.y, y))))].ravel()
        fine, coarse = (sparse.diags_array(mask.astype(float)) for mask in (self.free, free))
        prolong = sparse.csr_array(fine @ sparse.kron(by_x, by_y, format="csr") @ coarse)
        across, along = (
            sparse.csr_array(prolong.T @ (matrix @ prolong)) for matrix in (self.across, self.along)
        )
        return _Grid(x, y, _with_identity(across, free), along, free), prolong


def _every_other(x: Array) -> tuple[Array, sparse.csr_array]:
    """Every other position with both ends, and linear interpolation from there."""
    if x.size <= COARSEST:
        return x, sparse.csr_array(sparse.eye_array(x.size))
    coarse = x[np.unique(np.append(np.arange(0, x.size, 2), x.size - 1))]
    left = np.clip(np.searchsorted(coarse, x, side="right") - 1, 0, coarse.size - 2)
    share = (x - coarse[left]) / (coarse[left + 1] - coarse[left])
    rows = np.repeat(np.arange(x.size), 2)
    columns = np.stack([left, left + 1], axis=1).ravel()
    values = np.stack([1.0 - share, share], axis=1).ravel()
    matrix = sparse.csr_array((values, (rows, columns)), shape=(x.size, coarse.size))
    matrix.eliminate_zeros()
    return coarse, matrix


def _with_identity(matrix: sparse.csr_array, free: Mask) -> sparse.csr_array:
    return sparse.csr_array(matrix + sparse.diags_array((~free).astype(float)))


def _diagonals(matrix: sparse.csr_array, offsets: IntArray) -> Array:
    """Diagonals of a square matrix as scipy stores them: an entry stands at its column."""
    data = np.zeros((offsets.size, matrix.shape[0]))
    for row, offset in zip(data, offsets.tolist(), strict=True):
        diagonal = matrix.diagonal(offset)
        start = max(offset, 0)
        row[start : start + diagonal.size] = diagonal
    return data


class GapMultigrid:
    """One V-cycle over all modes, an approximate inverse: symmetric and positive definite.

    Parameters
    ----------
    x, y : ndarray, shapes (nx,), (ny,)
        Positions of the columns [m].
    across, along : ndarray, shape (9, nx * ny)
        Couplings of each column with its neighbours, summed over the gap: of the derivatives across it, and
        of those along x and y. An entry stands at the neighbour, as in a sparse matrix of diagonals.
    fixed : ndarray, shape (nx, ny)
        Columns whose potential is given.
    of_gap : Across
        Nodes, weights and differentiation across the gap.
    """

    def __init__(
        self, x: Array, y: Array, *, across: Array, along: Array, fixed: Mask, of_gap: Across
    ) -> None:
        eigenvalues, self.modes = gap_modes(of_gap)
        grid = _Grid.finest(x, y, across=across, along=along, free=~fixed.ravel())
        self.levels = [grid.level(eigenvalues)]
        while max(grid.x.size, grid.y.size) > COARSEST and not grid.is_thin(eigenvalues[0]):
            grid, prolong = grid.coarser()
            self.levels[-1].to_finer = sparse.csr_array(
                sparse.kron(sparse.eye_array(eigenvalues.size), prolong, format="csr")
            )
            self.levels.append(grid.level(eigenvalues))

    def __call__(self, residual: Array) -> Array:
        """Correction (nx, ny, ns) of a residual, zero on the walls."""
        by_mode = self.modes.T @ residual.reshape(-1, residual.shape[2]).T
        corrected = self._cycle(by_mode.ravel(), 0).reshape(by_mode.shape)
        correction: Array = (corrected.T @ self.modes.T).reshape(residual.shape)
        return correction

    def _cycle(self, right: Array, depth: int) -> Array:
        """Lines along x, along y, the coarser grid, and back in the reverse order."""
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
