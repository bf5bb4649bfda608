"""Line relaxation of the film: the smoother of the multigrid cycle.

All nodes of a line along x are changed at once, with the band of the Jacobian around its diagonal. Where the
deflection dominates the Jacobian, an unknown is not the pressure of one node but a dipole or a second
difference of pressures. Its deflection decays faster with distance (``ehlectric.film.levels.Distribution``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.linalg import lapack

from ehlectric.arrays import Array, Mask
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Distribution, Level
from ehlectric.film.reynolds import ALONG, OFFSETS, Stencil

# Half-bandwidth of the line relaxation. The part of the kernel beyond the band is neglected; it decays as
# 1/distance^2. With 6 a V-cycle reduces the error by a factor of 3 to 12, and 10 gains little.
_HALF_BAND = 6

# Half-bandwidth for a point contact. Compared with 6, 14 halves the number of iterations that the ridge of a
# heavy contact needs; 20 costs as much as it gains.
_HALF_BAND_POINT = 14


@dataclass(frozen=True)
class LineRelaxation:
    """One relaxation of all lines along x: first every second line, then the lines between them.

    Attributes
    ----------
    by_p : Stencil
        Derivative of the Reynolds residual by P at fixed H.
    full_film : ndarray of bool, shape (nx, ny)
        Nodes whose pressure changes.
    distributed : ndarray of bool, shape (nx, ny)
        Nodes whose unknown is distributed over several nodes.
    beside : tuple of (int, float)
        Offsets of the other nodes over which an unknown is distributed, each with its part.
    half_band : int
        Number of nodes on each side whose influence is kept.
    factors : tuple
        For each of the two sets of lines: the lines, and the LU factors and pivots of the transpose of their
        common band matrix.
    """

    by_p: Stencil
    full_film: Mask
    distributed: Mask
    beside: Distribution
    half_band: int
    factors: tuple[tuple[slice, Array, Array], ...]

    @classmethod
    def of(
        cls, gap: Gap, stencils: tuple[Stencil, Stencil], full_film: Mask, distributed: Mask
    ) -> LineRelaxation:
        """Line relaxation with a Jacobian, from the derivatives of the residual by P and by H.

        ``full_film`` and ``distributed`` are masks of nodes (nx, ny).
        """
        band = half_band(gap.level)
        rows = _rows(gap, stencils, distributed, band)
        rows[~full_film.T, 2 * band] = 1.0
        factors = []
        for lines in (slice(0, None, 2), slice(1, None, 2))[: full_film.shape[1]]:
            # The rows of the matrix are the columns of its transpose, which LAPACK factorises.
            part = rows[lines].reshape(-1, 3 * band + 1).T
            lu, pivots, _ = lapack.dgbtrf(part, band, band, overwrite_ab=1)
            factors.append((lines, lu, pivots))
        return cls(stencils[0], full_film, distributed, _beside(gap.level), band, tuple(factors))

    def __call__(self, r: Array) -> Array:
        """Change dP (nx, ny) that solves (band of the Jacobian) dP = r at the full-film nodes.

        The second set of lines includes the flow across entrainment that the change of the first set causes.
        """
        dp = np.zeros_like(r)
        for lines, lu, pivots in self.factors:
            if lines.start:
                r = r - self.by_p.add_across(dp, np.zeros_like(r))
            right = r[:, lines].T.reshape(-1)
            solution, _ = lapack.dgbtrs(lu, self.half_band, self.half_band, right, pivots, trans=1)
            unknown = solution.reshape(-1, r.shape[0]).T
            dp[:, lines] = unknown
            shared = np.where(self.distributed[:, lines], unknown, 0.0)
            for offset, share in self.beside:
                here, there = _shifted(offset)
                dp[there, lines] += share * shared[here]
            dp[~self.full_film] = 0.0
        return dp


def half_band(level: Level) -> int:
    """Half-bandwidth of the line relaxation on a grid, in nodes.

    It is limited by the number of nodes along x, which may be small on coarse grids of wide contacts: the
    rows reach one node beyond the band, and the wedge term two more.
    """
    return min(_HALF_BAND if level.mesh.dy is None else _HALF_BAND_POINT, level.nodes - 4)


def distributed_nodes(level: Level, poiseuille: Array, full_film: Mask) -> Mask:
    """Mask of the nodes whose unknown is distributed, where eps/dX^2 is small and the deflection dominates.

    ``poiseuille`` (nx, ny) is the diagonal of the Poiseuille term. An unknown is only distributed over nodes
    with a full film.
    """
    distributed = full_film & (poiseuille < level.rate)
    for offset, _ in _beside(level):
        here, there = _shifted(offset)
        distributed[here] &= full_film[there]
    return distributed


def _beside(level: Level) -> Distribution:
    """Offsets of the other nodes over which an unknown is distributed, each with its part."""
    return tuple(part for part in level.distribution if part[0])


def _shifted(offset: int) -> tuple[slice, slice]:
    """Slices along x of the nodes that have a neighbour at this offset, and of these neighbours."""
    if offset < 0:
        return slice(-offset, None), slice(None, offset)
    return slice(None, -offset), slice(offset, None)


def _rows(gap: Gap, stencils: tuple[Stencil, Stencil], distributed: Mask, band: int) -> Array:
    """Rows of the band of the Jacobian for the distributed unknowns, shape (ny, nx, 3 band + 1).

    The diagonal has the index 2 band. The first ``band`` entries are space for the factorisation.
    """
    nx, ny = distributed.shape
    offsets = np.arange(-band - 1, band + 2)
    steps = np.array([step for step, _ in OFFSETS[:ALONG]])
    by_p, by_h = (np.ascontiguousarray(part.coefficients[:ALONG].transpose(2, 1, 0)) for part in stencils)
    # Derivatives by P of all nodes within the band and one beyond, and of these by the flow at fixed H.
    nodal = by_h @ gap.along(steps[:, np.newaxis] - offsets)
    nodal[..., steps[0] + band + 1 : steps[-1] + band + 2] += by_p
    rows = np.empty((ny, nx, 3 * band + 1))
    rows[..., :band] = 0.0
    kept, inner = rows[..., band:], slice(1, -1)
    # An unknown beside node i, at i + offset, also changes P of the nodes over which it is distributed.
    padded = np.zeros((ny, nx + 2 * band))
    padded[:, band:-band] = distributed.T
    kept[...] = sum(
        share * nodal[..., inner.start + offset : inner.stop + offset or None]
        for offset, share in _beside(gap.level)
    )
    kept *= sliding_window_view(padded, 2 * band + 1, axis=1)
    kept += nodal[..., inner]
    # The matrix ends with the line.
    for k in range(band):
        kept[:, k, : band - k] = 0.0
        kept[:, nx - 1 - k, band + 1 + k :] = 0.0
    return rows
