"""The V-cycle over all grids that preconditions the film's Newton steps.

One V-cycle solves J (dP, dH00) = (r, load) approximately: the residual goes down to the coarsest grid,
is solved there by a dense factorisation, and each finer grid adds one line relaxation on the way up.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from scipy.linalg import lapack

from ehlectric.arrays import Array, Mask
from ehlectric.film.levels import Distribution, Level
from ehlectric.film.reynolds import (
    ALONG,
    OFFSETS,
    Coefficients,
    Fluid,
    evaluate,
    linearise,
    poiseuille_weight,
)

# Half-bandwidth of the line relaxation. The part of the kernel dropped beyond it decays as 1/distance^2: at 6
# a V-cycle reduces the error three- to twelvefold, and 10 gains little.
HALF_BAND = 6

# That of a point contact: from 6 to 14 it halves the iterations that the ridge of a heavy contact takes, and
# 20 costs what it gains.
HALF_BAND_POINT = 14

# Change of ln eps between neighbours above which a coarser grid cannot represent the nodes.
UNRESOLVED = 1.5

# Part of the residual that one cycle on a coarser grid may leave without a second.
ENOUGH = 0.1


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
        # Nodes whose unknown is distributed: where eps/dX^2 is small and the deflection decides.
        poiseuille = poiseuille_weight(coefficients, level.mesh)
        self.distributed = free & (poiseuille < level.rate)
        for offset, _ in self.beside:
            here, there = _shifted(offset)
            self.distributed[here] &= free[there]
        line_contact = level.mesh.dy is None
        # No wider than the grid: one contact may have many times more nodes across than along.
        self.half_band = min(HALF_BAND if line_contact else HALF_BAND_POINT, level.nodes - 3)
        # Nodes whose residual the coarser grids are given. Beside the pressure spike of a line contact eps
        # changes by orders of magnitude from node to node: there the relaxation, almost exact, is left alone.
        self.resolved = free.copy()
        if line_contact:
            steep = np.abs(np.diff(np.log(coefficients.eps), axis=0)) > UNRESOLVED
            self.resolved[1:] &= ~steep
            self.resolved[:-1] &= ~steep
        diagonal = poiseuille + elastic_weight(coefficients, level)
        self.scale = np.divide(1.0, diagonal, out=np.zeros(free.shape), where=free)
        self.unscale = np.where(free, diagonal, 0.0)

    @property
    def beside(self) -> Distribution:
        """What an unknown adds to the nodes beside it."""
        return tuple(part for part in self.level.distribution if part[0])

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the Reynolds residual and of the load integral."""
        dh = self.level.deflection(dp) + dh00
        return self.by_p(dp) + self.by_h(dh), float(np.vdot(self.level.weights, dp))

    def image(self, change: Array) -> Array:
        """Scaled residual and load of a change of P and H00, all in one vector."""
        r, load = self(change[:-1].reshape(self.free.shape), float(change[-1]))
        return np.append(self.scale * r, load)

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
    def _line_factors(self) -> list[tuple[slice, Array, Array]]:
        """Banded LU in the distributed unknowns, every second line along x in one matrix, then the others."""
        nx, ny = self.free.shape
        band = self.half_band
        matrix = np.zeros((3 * band + 1, ny, nx))
        diagonals = {offset: self._diagonal(offset) for offset in range(-band - 1, band + 2)}
        for offset in range(-band, band + 1):
            rows = slice(max(0, -offset), min(nx, nx - offset))
            columns = slice(max(0, offset), min(nx, nx + offset))
            entry = diagonals[offset][rows]
            for shift, share in self.beside:
                added = share * diagonals[offset + shift][rows]
                entry = entry + np.where(self.distributed[columns], added, 0.0)
            matrix[2 * band - offset, :, columns] = entry.T
        matrix[2 * band][~self.free.T] = 1.0
        factors = []
        for lines in (slice(0, ny, 2), slice(1, ny, 2))[:ny]:
            part = matrix[:, lines].reshape(3 * band + 1, -1)
            lu, pivots, _ = lapack.dgbtrf(part, band, band, overwrite_ab=1)
            factors.append((lines, lu, pivots))
        return factors

    def relax(self, r: Array) -> Array:
        """One line relaxation: dP with (band of J) dP = r on the free nodes.

        The second half of the lines knows what flows to it from the first.
        """
        dp = np.zeros_like(r)
        for lines, lu, pivots in self._line_factors:
            if lines.start:
                r = r - self.by_p.add_across(dp, np.zeros_like(r))
            right = r[:, lines].T.reshape(-1)
            solution, _ = lapack.dgbtrs(lu, self.half_band, self.half_band, right, pivots)
            unknown = solution.reshape(-1, r.shape[0]).T
            dp[:, lines] = unknown
            shared = np.where(self.distributed[:, lines], unknown, 0.0)
            for offset, share in self.beside:
                here, there = _shifted(offset)
                dp[there, lines] += share * shared[here]
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


def _shifted(offset: int) -> tuple[slice, slice]:
    """Nodes that have a neighbour so far along x, and that neighbour of each."""
    if offset < 0:
        return slice(-offset, None), slice(None, offset)
    return slice(None, -offset), slice(offset, None)


def elastic_weight(coefficients: Coefficients, level: Level) -> Array:
    """The elastic part of a row's own coefficient: what a distributed unknown opens where it is."""
    influence = level.deflection.influence
    weight: Array = coefficients.density * ((influence[0, 0] - influence[1, 0]) * level.rate)
    return weight


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
    """Approximate (dP, dH00) with J (dP, dH00) = (r, load) on the free nodes of the finest grid."""
    finest, *coarser = jacobians
    if not coarser:
        return finest.solve_dense(r, load)
    level = coarser[0].level
    restricted = level.restrict(np.where(finest.resolved, r, 0.0))
    if len(coarser) == 1 or level.mesh.dy is None:
        coarse_dp, dh00 = v_cycle(coarser, restricted, load)
    else:
        coarse_dp, dh00 = _two_cycles(coarser, restricted, load)
    dp = np.where(finest.free, level.prolong(coarse_dp), 0.0)
    change, _ = finest(dp, dh00)
    return dp + finest.relax(r - change), dh00


def cycled(jacobians: list[Linearised], image: Array) -> Array:
    """One V-cycle from a scaled residual and load to a change of P and H00, all in one vector."""
    finest = jacobians[0]
    dp, dh00 = v_cycle(jacobians, finest.unscale * image[:-1].reshape(finest.free.shape), float(image[-1]))
    return np.append(dp, dh00)


def _two_cycles(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """Two V-cycles, combined so that the least scaled residual is left.

    Along the ridge of pressure at the exit of a point contact a coarser grid overshoots, by factors that
    grow from grid to grid; the best multiple does not. The K-cycle of Y. Notay and P. S. Vassilevski, Numer.
    Linear Algebra Appl. 15 (2008) 473, doi:10.1002/nla.542.
    """
    finest = jacobians[0]
    right = np.append(finest.scale * r, load)
    changes, images = [], []
    left = right
    for _ in range(2):
        changes.append(cycled(jacobians, left))
        images.append(finest.image(changes[-1]))
        parts = np.linalg.lstsq(np.stack(images, axis=1), right)[0]
        left = right - parts @ images
        if np.linalg.norm(left) <= ENOUGH * np.linalg.norm(right):
            break
    change = parts @ changes
    return change[:-1].reshape(r.shape), float(change[-1])
