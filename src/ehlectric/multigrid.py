"""Grid hierarchy and the V-cycle that preconditions the film's Newton steps.

One V-cycle solves J (dP, dH00) = (r, load) approximately: the residual goes down to the coarsest grid,
is solved there by a dense factorisation, and each finer grid adds one line relaxation on the way up.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.linalg import lapack

from ehlectric.elastic import Deflection, Geometry
from ehlectric.mesh import Mesh, Width
from ehlectric.reynolds import (
    ALONG,
    OFFSETS,
    Coefficients,
    Fluid,
    Stencil,
    evaluate,
    linearise,
    poiseuille_weight,
    wedge_stencil,
)
from ehlectric.typing import Array, Mask

# Half-bandwidth of the line relaxation. The part of the kernel dropped beyond it decays as 1/distance^2: at 6
# a V-cycle reduces the error three- to twelvefold, and 10 gains little.
HALF_BAND = 6

# The hierarchy ends at the first grid of at most this many nodes, of line and of point contacts: the dense
# solve there costs less than one more grid.
COARSEST = 101
COARSEST_POINT = 1100

# Change of ln eps between neighbours above which a coarser grid cannot represent the nodes.
UNRESOLVED = 1.5


def interpolation(coarse: int, fine: int) -> sparse.csr_array:
    """Linear interpolation between two uniform grids over one interval, shape (fine, coarse)."""
    numerator = np.arange(fine) * (coarse - 1)
    left = np.minimum(numerator // (fine - 1), coarse - 2)
    weight = numerator / (fine - 1) - left
    rows = np.repeat(np.arange(fine), 2)
    columns = np.stack([left, left + 1], axis=1).ravel()
    values = np.stack([1.0 - weight, weight], axis=1).ravel()
    matrix = sparse.csr_array((values, (rows, columns)), shape=(fine, coarse))
    matrix.eliminate_zeros()
    return matrix


@dataclass(frozen=True)
class Transfer:
    """Linear interpolation between two grids, along and across entrainment."""

    along: sparse.csr_array
    across: sparse.csr_array | None

    @classmethod
    def between(cls, coarse: Mesh, fine: Mesh) -> Transfer:
        """From a coarse mesh to a fine one, or back, over one domain."""
        across = None if coarse.y.size == 1 else interpolation(coarse.y.size, fine.y.size)
        return cls(interpolation(coarse.x.size, fine.x.size), across)

    def __call__(self, values: Array) -> Array:
        """Values (nx, ny) on the other mesh."""
        moved: Array = self.along @ values
        return moved if self.across is None else (self.across @ moved.T).T


@dataclass(frozen=True)
class Level:
    """One grid: nodes, quadrature weights, operators, and the transfers to and from the next finer.

    The finest grid has no finer one, and no transfers.
    """

    mesh: Mesh
    weights: Array  # (nx, ny), trapezoidal
    deflection: Deflection
    dry_gap: Array  # (nx, ny)
    load: float
    wedge: Stencil
    source: Array  # (nx, ny), right side of the Reynolds equation, zero on the edges
    to_finer: Transfer | None
    from_finer: Transfer | None

    @property
    def nodes(self) -> int:
        """Number of nodes along x."""
        return self.mesh.x.size

    def inject(self, values: Array) -> Array:
        """Values of the next finer grid at the nodes of this one."""
        assert self.from_finer is not None
        return self.from_finer(values)

    def prolong(self, values: Array) -> Array:
        """Values of this grid, linearly interpolated to the next finer one."""
        assert self.to_finer is not None
        return self.to_finer(values)

    @cached_property
    def deflection_matrix(self) -> Array:
        """The dense deflection operator, for the coarsest grid alone."""
        return self.deflection.matrix()


def hierarchy(
    nodes: int,
    *,
    inlet: float,
    outlet: float,
    geometry: Geometry,
    second_order: bool,
    width: Width | None = None,
    source: Callable[[Array, Array], Array] | None = None,
) -> list[Level]:
    """Grids from the finest to the coarsest, each with half the intervals of the one before.

    An odd number of intervals is halved upwards; such grids share only their end nodes, and the
    transfers interpolate. There are always two grids at least, for the error estimate.
    """
    meshes = _meshes(nodes, inlet, outlet, width)
    levels = []
    for k, mesh in enumerate(meshes):
        right = np.zeros(mesh.shape)
        if source is not None:
            right[mesh.inner] = source(mesh.x, mesh.y)[mesh.inner]
        levels.append(
            Level(
                mesh=mesh,
                weights=mesh.weights,
                deflection=Deflection.on(mesh, geometry),
                dry_gap=geometry.dry_gap(mesh.x, mesh.y),
                load=geometry.load,
                wedge=wedge_stencil(mesh.shape, mesh.dx, second_order=second_order),
                source=right,
                to_finer=Transfer.between(mesh, meshes[k - 1]) if k else None,
                from_finer=Transfer.between(meshes[k - 1], mesh) if k else None,
            )
        )
    return levels


def _meshes(nodes: int, inlet: float, outlet: float, width: Width | None) -> list[Mesh]:
    meshes = [Mesh.over(nodes, inlet, outlet, width)]
    coarsest = COARSEST if width is None else COARSEST_POINT
    while meshes[-1].weights.size > coarsest or len(meshes) < 2:
        nodes = nodes // 2 + 1
        if width is not None:
            width = replace(width, nodes=_halved(width))
        meshes.append(Mesh.over(nodes, inlet, outlet, width))
    return meshes


def _halved(width: Width) -> int:
    """Nodes across the next coarser grid, which keeps the line of symmetry."""
    if width.y[0] == 0.0:
        return 2 * (width.y.size // 2) + 1
    return width.nodes // 2 + 1


class Linearised:
    """The Jacobian on one grid over its free nodes, as an operator and as a smoother.

    Nodes that are not free stay as they are: what goes in must be zero there, and what the solvers give
    back is.
    """

    def __init__(
        self,
        level: Level,
        coefficients: Coefficients,
        pressure: Array,
        thickness: Array,
        free: Mask,
    ) -> None:
        self.level = level
        self.free = free
        self.by_p, self.by_h = linearise(coefficients, level.wedge, pressure, thickness, level.mesh)
        self.by_p.coefficients[:, ~free] = 0.0
        self.by_h.coefficients[:, ~free] = 0.0
        # Nodes whose unknown is distributed, +1 to P_j and -1 to P_(j-1). Where eps/dX^2 is small
        # against 1/dX the equation is the first difference of the deflection and acts like
        # 1/(i - j - 1/2); on dipoles it acts like 1/(i - j)^2 and is diagonally dominant.
        self.dipole = free & (poiseuille_weight(coefficients, level.mesh) < 1.0 / level.mesh.dx)
        self.dipole[1:] &= free[:-1]
        # Nodes whose residual the coarser grids are given. Beside the pressure spike eps changes by orders
        # of magnitude from node to node: there the relaxation, almost exact, is left alone.
        steep = np.abs(np.diff(np.log(coefficients.eps), axis=0)) > UNRESOLVED
        self.resolved = free.copy()
        self.resolved[1:] &= ~steep
        self.resolved[:-1] &= ~steep

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the Reynolds residual and of the load integral."""
        dh = self.level.deflection(dp) + dh00
        return self.by_p(dp) + self.by_h(dh), float(np.vdot(self.level.weights, dp))

    def _diagonal(self, offset: int) -> Array:
        """Entries J_(i, i+offset) of the Jacobian along x, shape (nx, ny)."""
        influence = self.level.deflection.influence[:, 0]
        diagonal = np.zeros(self.free.shape)
        for row, (shift, _) in enumerate(OFFSETS[:ALONG]):
            diagonal += self.by_h.coefficients[row] * influence[abs(shift - offset)]
            if shift == offset:
                diagonal += self.by_p.coefficients[row]
        return diagonal

    @cached_property
    def _line_factors(self) -> tuple[Array, Array]:
        """Banded LU in the distributed unknowns, all lines along x in one matrix."""
        nx, ny = self.free.shape
        matrix = np.zeros((3 * HALF_BAND + 1, ny, nx))
        left = self._diagonal(-HALF_BAND - 1)
        for offset in range(-HALF_BAND, HALF_BAND + 1):
            rows = slice(max(0, -offset), min(nx, nx - offset))
            columns = slice(max(0, offset), min(nx, nx + offset))
            here = self._diagonal(offset)
            entry = here[rows] - np.where(self.dipole[columns], left[rows], 0.0)
            matrix[2 * HALF_BAND - offset, :, columns] = entry.T
            left = here
        matrix[2 * HALF_BAND][~self.free.T] = 1.0
        factors, pivots, _ = lapack.dgbtrf(
            matrix.reshape(3 * HALF_BAND + 1, nx * ny), HALF_BAND, HALF_BAND, overwrite_ab=1
        )
        return factors, pivots

    def relax(self, r: Array) -> Array:
        """One line relaxation: dP with (band of J) dP = r on the free nodes."""
        nx, ny = r.shape
        factors, pivots = self._line_factors
        solution, _ = lapack.dgbtrs(factors, HALF_BAND, HALF_BAND, r.T.reshape(-1), pivots)
        unknown = solution.reshape(ny, nx).T
        dp: Array = unknown.copy()
        dp[:-1] -= np.where(self.dipole[1:], unknown[1:], 0.0)
        dp[~self.free] = 0.0
        return dp

    @cached_property
    def _dense_factors(self) -> tuple[Array, Array]:
        """LU of the whole bordered Jacobian."""
        n = self.free.size
        matrix = np.zeros((n + 1, n + 1))
        matrix[:n, :n] = self.by_p.matrix() + self.by_h.matrix() @ self.level.deflection_matrix
        matrix[:n, n] = self.by_h.coefficients.sum(axis=0).ravel()
        matrix[n, :n] = np.where(self.free, self.level.weights, 0.0).ravel()
        fixed = np.flatnonzero(~self.free.ravel())
        matrix[fixed, fixed] = 1.0
        factors, pivots, _ = lapack.dgetrf(matrix)
        return factors, pivots

    def solve_dense(self, r: Array, load: float) -> tuple[Array, float]:
        """Exact (dP, dH00), for the coarsest grid."""
        right = np.append(np.where(self.free, r, 0.0), load)
        solution, _ = lapack.dgetrs(*self._dense_factors, right)
        return np.where(self.free, solution[:-1].reshape(r.shape), 0.0), float(solution[-1])


def linearise_levels(
    levels: list[Level],
    fluid: Fluid,
    *,
    coefficients: Coefficients,
    pressure: Array,
    thickness: Array,
    free: Mask,
) -> list[Linearised]:
    """The Jacobian on every grid: given on the first, rebuilt on the others at the injected state."""
    jacobians = [Linearised(levels[0], coefficients, pressure, thickness, free)]
    for level in levels[1:]:
        pressure = level.inject(pressure)
        thickness = level.inject(thickness)
        # A coarse node between a free and a fixed one counts as fixed.
        free = level.inject(free.astype(float)) > 1.0 - 1e-9
        coefficients = evaluate(fluid, pressure, thickness)
        jacobians.append(Linearised(level, coefficients, pressure, thickness, free))
    return jacobians


def v_cycle(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """Approximate (dP, dH00) with J (dP, dH00) = (r, load) on the free nodes of the finest grid.

    The residual is injected, not averaged: beside the pressure spike neighbouring rows differ by orders
    of magnitude, and an average hands the small ones the error of the large.
    """
    finest, *coarser = jacobians
    if not coarser:
        return finest.solve_dense(r, load)
    level = coarser[0].level
    resolved = np.where(finest.resolved, r, 0.0)
    coarse_dp, dh00 = v_cycle(coarser, level.inject(resolved), load)
    dp = np.where(finest.free, level.prolong(coarse_dp), 0.0)
    change, _ = finest(dp, dh00)
    return dp + finest.relax(r - change), dh00
