"""Direct solver for the nodes of a film where the deflection dominates, by a dense factorisation.

Spots in contact are often a few nodes wide, and so is the film of high pressure around them. Coarser grids
do not resolve them, and a V-cycle over all grids increases the residual of such nodes. The stiff nodes are
the nodes in contact and the nodes of a full film whose Reynolds equation the deflection dominates. All
other nodes are open: the Poiseuille term dominates their Reynolds equation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.film.gap import Gap
from ehlectric.film.multigrid import preconditioner_type
from ehlectric.film.reynolds import OFFSETS, Stencil

# Largest number of stiff nodes, divided by the cube root of the number of nodes of the grid. The
# factorisation then takes about as long as ten V-cycles.
_MOST = 80.0

# Rows of influence coefficients that are read together.
_BLOCK = 256


def few_enough(nodes: Mask) -> bool:
    """Whether the dense factorisation of these nodes of a grid (nx, ny) takes less time than V-cycles."""
    return 0 < int(nodes.sum()) <= int(_MOST * np.cbrt(nodes.size))


@dataclass(frozen=True)
class StiffSolver:
    """Solver for the pressure of some nodes and for H00, from the rows of these nodes and of the load."""

    nodes: Mask  # nodes whose pressure changes; the change at all others is zero, shape (nx, ny)
    # factors and pivots: LU factorisation of the rows of these nodes and of the load, nodes with y fastest.
    factors: Array
    pivots: Array

    @classmethod
    def of(cls, gap: Gap, by_p: Stencil, by_h: Stencil, nodes: Mask) -> StiffSolver:
        """Factorise the Jacobian between some nodes, from the derivatives of the residual by P and by H.

        Raises numpy.linalg.LinAlgError where the matrix is singular.
        """
        kind = preconditioner_type(gap.level)
        n = int(nodes.sum())
        matrix = np.zeros((n + 1, n + 1), dtype=kind)
        _add_deflection(matrix[:n, :n], gap, by_h, nodes)
        _add_flow(matrix[:n, :n], by_p, nodes)
        matrix[:n, n] = by_h.coefficients.sum(axis=0)[nodes]
        matrix[n, :n] = gap.level.weights[nodes]
        factorised = scipy.linalg.lapack.sgetrf if kind is np.float32 else scipy.linalg.lapack.dgetrf
        # LAPACK takes columns, which are the rows of the transposed matrix here: nothing is copied.
        factors, pivots, singular = factorised(matrix.T, overwrite_a=1)
        if singular:
            raise np.linalg.LinAlgError("the stiff nodes have a singular matrix")
        return cls(nodes, factors, pivots)

    def __call__(self, r: Array, load: float) -> tuple[Array, float]:
        """Change dP (nx, ny) and dH00 that solve the rows of the nodes for the right side r (nx, ny)."""
        single = self.factors.dtype == np.float32
        solved = scipy.linalg.lapack.sgetrs if single else scipy.linalg.lapack.dgetrs
        right = np.append(r[self.nodes], load).astype(self.factors.dtype)
        solution, _ = solved(self.factors, self.pivots, right, trans=1, overwrite_b=1)
        dp = np.zeros_like(r)
        dp[self.nodes] = solution[:-1]
        return dp, float(solution[-1])


def _add_deflection(matrix: Array, gap: Gap, by_h: Stencil, nodes: Mask) -> None:
    """Add the derivatives by the deflection to the Jacobian between nodes, shape (n, n)."""
    deflection = gap.level.deflection
    # Influence coefficients for distances of both signs; the distance of two nodes is the difference of
    # their places in this table.
    half = deflection.influence.astype(matrix.dtype)
    along = np.concatenate([half[:0:-1], half])
    table = np.concatenate([along[:, :0:-1], along], axis=1)
    lines = table.shape[1]
    centre = (half.shape[0] - 1) * lines + half.shape[1] - 1
    flat = table.ravel()
    i, j = np.nonzero(nodes)
    place = i * lines + j
    parts, rows, of = [], [], []
    for coefficients, (q, p) in zip(by_h.coefficients, OFFSETS, strict=False):
        part = coefficients[nodes]
        at = np.flatnonzero(part)
        parts.append(part[at])
        rows.append(at)
        of.append(place[at] + (q * lines + p))
    # The gap of a node enters the rows of several nodes: its influence coefficients are read once.
    gaps, column = np.unique(np.concatenate(of), return_inverse=True)
    influence = np.empty((len(gaps), len(place)), dtype=matrix.dtype)
    mirrored = np.flatnonzero(j)
    for block in (slice(k, k + _BLOCK) for k in range(0, len(gaps), _BLOCK)):
        here = (gaps[block] + centre)[:, np.newaxis]
        influence[block] = flat.take(here - place)
        if deflection.symmetric:
            influence[block, mirrored] += flat.take(here - (i * lines - j)[mirrored])
    weights = np.concatenate(parts).astype(matrix.dtype), (np.concatenate(rows), column)
    matrix += np.asarray(scipy.sparse.csr_array(weights, shape=(len(place), len(gaps))) @ influence)


def _add_flow(matrix: Array, by_p: Stencil, nodes: Mask) -> None:
    """Add the derivatives by the pressure at fixed gap to the Jacobian between nodes, shape (n, n)."""
    number = np.full(np.add(nodes.shape, 4), -1)
    number[2:-2, 2:-2][nodes] = np.arange(len(matrix))
    i, j = np.nonzero(nodes)
    for coefficients, (q, p) in zip(by_p.coefficients, OFFSETS, strict=False):
        column = number[i + 2 + q, j + 2 + p]
        rows = np.flatnonzero(column >= 0)
        matrix[rows, column[rows]] += coefficients[nodes][rows]
