"""V-cycle over all grids that preconditions the Newton steps of the film.

One V-cycle solves J (dP, dH00) = (r, load) approximately, with the Jacobian J. The residual is restricted to
the coarsest grid, where a dense factorisation solves the system. Each finer grid adds one line relaxation on
the way back.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.linalg import lapack

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.relaxation import LineRelaxation, distributed_nodes
from ehlectric.film.reynolds import ALONG, OFFSETS, Stencil, linearise, poiseuille_weight

# Change of ln eps between neighbours above which a coarser grid cannot resolve the solution.
_UNRESOLVED = 1.5

# Largest change of ln eps at any node up to which a preconditioner is kept. Up to 2 it costs no more GMRES
# iterations than a new one.
_ALIKE = 0.6

# Steps along x to the nodes that a row of a stencil couples.
_STEPS = tuple(step for step, _ in OFFSETS[:ALONG])

# Fraction of the residual below which one cycle on a coarser grid is enough, and no second cycle follows.
_ENOUGH = 0.1


@dataclass(frozen=True)
class Linearised:
    """Jacobian of the film equations on one grid, as a linear operator on its full-film nodes.

    The pressure of cavitated nodes does not change: dP must be zero there, and the solvers return zero there.

    Attributes
    ----------
    gap : Gap
        Gap at the state, with its derivatives.
    by_p, by_h : Stencil
        Derivatives of the Reynolds residual by P at fixed H and by H at fixed P; zero at cavitated nodes.
    full_film : ndarray of bool, shape (nx, ny)
        Nodes with a full film.
    poiseuille : ndarray, shape (nx, ny)
        Diagonal of the Poiseuille term.
    scale, unscale : ndarray, shape (nx, ny)
        Reciprocal of the diagonal of the Reynolds equation, and the diagonal; both zero at cavitated nodes.
    resolved : ndarray of bool, shape (nx, ny)
        Nodes whose residual is passed to the coarser grids.
    log_viscosity : ndarray, shape (nx, ny)
        ln(eta/eta_0) at the state.
    kept : Linearised or None
        Similar Jacobian at an older state, whose line relaxation or factors are used instead of new ones.
    """

    gap: Gap
    by_p: Stencil
    by_h: Stencil
    full_film: Mask
    poiseuille: Array
    scale: Array
    unscale: Array
    resolved: Mask
    log_viscosity: Array
    kept: Linearised | None = None

    @classmethod
    def of(cls, gap: Gap, at_faces: Flow, full_film: Mask) -> Linearised:
        """Jacobian at a state, from its gap, its flow and its full-film nodes (nx, ny)."""
        level = gap.level
        by_p, by_h = linearise(at_faces, level.wedge, gap.thickness, level.mesh)
        poiseuille = poiseuille_weight(at_faces, level.mesh)
        diagonal = poiseuille + gap.elastic_weight(at_faces.coefficients.density)
        return cls(
            gap=gap,
            by_p=by_p.on_rows(full_film),
            by_h=by_h.on_rows(full_film),
            full_film=full_film,
            poiseuille=poiseuille,
            scale=np.divide(1.0, diagonal, out=np.zeros(full_film.shape), where=full_film),
            unscale=np.where(full_film, diagonal, 0.0),
            resolved=resolved_nodes(level, at_faces.coefficients.eps, full_film),
            log_viscosity=at_faces.coefficients.log_viscosity,
        )

    @property
    def level(self) -> Level:
        """Grid of the Jacobian."""
        return self.gap.level

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the Reynolds residual (nx, ny) and of the load for changes dP (nx, ny) and dH00."""
        dh, load = self.gap.change(dp, dh00)
        return self.by_p(dp) + self.by_h(dh), load

    def image(self, change: Array) -> Array:
        """Change of scaled residual and load, as one vector, for a change of P and H00, as one vector."""
        r, load = self(change[:-1].reshape(self.full_film.shape), float(change[-1]))
        return np.append(self.scale * r, load)

    @cached_property
    def relax(self) -> LineRelaxation:
        """Line relaxation with this Jacobian, a function r (nx, ny) -> dP (nx, ny)."""
        if self.kept is not None:
            return self.kept.relax
        distributed = distributed_nodes(self.level, self.poiseuille, self.full_film)
        return LineRelaxation.of(self.gap, (self.by_p, self.by_h), self.full_film, distributed)

    @cached_property
    def solve_dense(self) -> DenseSolver:
        """Direct solver with this Jacobian for the coarsest grid, a function (r, load) -> (dP, dH00)."""
        if self.kept is not None:
            return self.kept.solve_dense
        return DenseSolver.of(self.gap, self.by_p, self.by_h, self.full_film)


@dataclass(frozen=True)
class DenseSolver:
    """Direct solver for the Jacobian of a grid and the balance of load, by a dense LU factorisation.

    Attributes
    ----------
    full_film : ndarray of bool, shape (nx, ny)
        Nodes whose pressure changes; the change at all others is zero.
    part : slice
        Nodes from the first one with a full film to the last one, of all nodes with y fastest.
    factors, pivots : ndarray
        LU factorisation of the transposed matrix of these nodes and of the balance of load.
    """

    full_film: Mask
    part: slice
    factors: Array
    pivots: Array

    @classmethod
    def of(cls, gap: Gap, by_p: Stencil, by_h: Stencil, full_film: Mask) -> DenseSolver:
        """Factorise the Jacobian, from the derivatives of the residual by P and by H.

        The rows of the derivatives must be zero at cavitated nodes.
        """
        # Nodes before and behind the full film, as in a cavitated outlet, are left out.
        free = np.flatnonzero(full_film)
        part = slice(int(free[0]), int(free[-1]) + 1) if free.size else slice(0, 1)
        n = part.stop - part.start
        matrix = np.zeros((n + 1, n + 1))
        if full_film.shape[1] == 1:
            _fill_of_line(matrix, gap, by_p, by_h, part)
        else:
            matrix[:n, :n] = (by_p.matrix() + by_h.times(gap.matrix()))[part, part]
        matrix[:n, n] = by_h.coefficients.sum(axis=0).ravel()[part]
        matrix[n, :n] = np.where(full_film, gap.load_weights(), 0.0).ravel()[part]
        cavitated = np.flatnonzero(~full_film.ravel()[part])
        matrix[cavitated, cavitated] = 1.0
        # LAPACK takes columns, which are the rows of the transposed matrix here: nothing is copied.
        factors, pivots, _ = lapack.dgetrf(matrix.T, overwrite_a=1)
        return cls(full_film, part, factors, pivots)

    def __call__(self, r: Array, load: float) -> tuple[Array, float]:
        """Solution dP (nx, ny) and dH00 for the right side r (nx, ny) and ``load``."""
        right = np.append(np.where(self.full_film, r, 0.0).ravel()[self.part], load)
        solution, _ = lapack.dgetrs(self.factors, self.pivots, right, trans=1, overwrite_b=1)
        dp = np.zeros(r.size)
        dp[self.part] = solution[:-1]
        return np.where(self.full_film, dp.reshape(r.shape), 0.0), float(solution[-1])


def _fill_of_line(matrix: Array, gap: Gap, by_p: Stencil, by_h: Stencil, part: slice) -> None:
    """Write the Jacobian of some nodes of a line contact by the pressures of these nodes into ``matrix``.

    ``matrix`` has one more row and column than there are nodes. The derivatives of H depend on the distance
    of the nodes only. All rows over this distance are one product of matrices, and the Jacobian is a view of
    it whose rows begin one distance further left from row to row.
    """
    n, nodes = len(matrix) - 1, gap.level.nodes
    kernel = gap.level.deflection.beside(_STEPS)[:, nodes - n : nodes + n - 1]
    over_distance = (by_h.coefficients[:ALONG, part, 0].T @ kernel).reshape(-1)
    if n == 1:
        matrix[0, 0] = over_distance[0]
    else:
        matrix[:n, :n] = over_distance[n - 1 : n - 1 + n * (2 * n - 2)].reshape(n, 2 * n - 2)[:, :n]
    flat = matrix.reshape(-1)
    for row, step in zip(by_p.coefficients[:ALONG, part, 0], _STEPS, strict=True):
        first, count = max(0, -step), n - abs(step)
        if count > 0:
            start = first * (n + 2) + step
            flat[start : start + count * (n + 2) : n + 2] += row[first : first + count]


def resolved_nodes(level: Level, eps: Array, full_film: Mask) -> Mask:
    """Mask of the nodes whose residual is passed to the coarser grids.

    Beside the pressure spike of a line contact eps changes by orders of magnitude from node to node. There
    only the relaxation acts, which is almost exact.
    """
    resolved = full_film.copy()
    if level.mesh.dy is None:
        steep = np.abs(np.diff(np.log(eps), axis=0)) > _UNRESOLVED
        resolved[1:] &= ~steep
        resolved[:-1] &= ~steep
    return resolved


def linearise_levels(
    levels: list[Level],
    fluid: Fluid,
    at_faces: Flow,
    *,
    pressure: Array,
    thickness: Array,
    full_film: Mask,
) -> list[Linearised]:
    """Jacobian on every grid, at the state of the finest grid and at its injection on the coarser grids.

    Parameters
    ----------
    levels : list of Level
        Grids from the finest to the coarsest.
    fluid : Fluid
        Lubricant over dimensionless pressure.
    at_faces : Flow
        Flow at the state on the finest grid.
    pressure, thickness, full_film : ndarray, shape (nx, ny)
        State on the finest grid: P, H and the nodes with a full film.

    Returns
    -------
    list of Linearised
        Jacobians in the order of ``levels``.
    """
    jacobians = [Linearised.of(Gap(levels[0], thickness), at_faces, full_film)]
    for level in levels[1:]:
        pressure = level.inject(pressure)
        thickness = level.inject(thickness)
        # A coarse node between a full-film and a cavitated one counts as cavitated.
        full_film = level.inject(full_film.astype(float)) > 1.0 - 1e-9
        at_faces = flow(fluid, pressure, thickness, level.mesh)
        jacobians.append(Linearised.of(Gap(level, thickness), at_faces, full_film))
    return jacobians


def with_kept_preconditioner(
    jacobians: list[Linearised], at_faces: Flow, thickness: Array, full_film: Mask
) -> list[Linearised] | None:
    """Jacobian at a new state with the coarser grids and the line relaxation of an older state.

    Parameters
    ----------
    jacobians : list of Linearised
        Jacobians at the older state, from the finest grid to the coarsest; may be empty.
    at_faces : Flow
        Flow on the finest grid at the new state.
    thickness, full_film : ndarray, shape (nx, ny)
        Film thickness H and full-film nodes of the new state.

    Returns
    -------
    list of Linearised or None
        None where the states differ too much for the older preconditioner, or are cavitated elsewhere.
    """
    if not jacobians:
        return None
    last, *coarser = jacobians
    old = last.kept or last
    if not np.array_equal(old.full_film, full_film):
        return None
    thinner = np.abs(np.log(thickness / old.gap.thickness))
    thicker = np.abs(at_faces.coefficients.log_viscosity - old.log_viscosity)
    if not np.max((thicker + 3.0 * thinner)[full_film], initial=0.0) < _ALIKE:
        return None
    new = Linearised.of(Gap(old.level, thickness), at_faces, full_film)
    return [replace(new, kept=old), *coarser]


def v_cycle(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """One V-cycle: approximate solution of J (dP, dH00) = (r, load) on the full-film nodes.

    Parameters
    ----------
    jacobians : list of Linearised
        Jacobians from the finest grid to the coarsest.
    r : ndarray, shape (nx, ny)
        Right side of the Reynolds equation, dimensionless.
    load : float
        Right side of the balance of load.

    Returns
    -------
    dp : ndarray, shape (nx, ny)
        Change of P on the finest grid, zero at cavitated nodes.
    dh00 : float
        Change of H00.
    """
    finest, *coarser = jacobians
    if not coarser:
        return finest.solve_dense(r, load)
    level = coarser[0].level
    restricted = level.restrict(np.where(finest.resolved, r, 0.0))
    if len(coarser) == 1 or level.mesh.dy is None:
        coarse_dp, dh00 = v_cycle(coarser, restricted, load)
    else:
        coarse_dp, dh00 = _two_cycles(coarser, restricted, load)
    dp = np.where(finest.full_film, level.prolong(coarse_dp), 0.0)
    change, _ = finest(dp, dh00)
    return dp + finest.relax(r - change), dh00


def cycled(jacobians: list[Linearised], image: Array) -> Array:
    """One V-cycle with vectors: from a scaled residual and load to a change of P and H00."""
    unscale = jacobians[0].unscale
    dp, dh00 = v_cycle(jacobians, unscale * image[:-1].reshape(unscale.shape), float(image[-1]))
    return np.append(dp, dh00)


def _two_cycles(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """Two V-cycles, combined so that the norm of the scaled residual becomes smallest.

    Along the ridge of pressure at the exit of a point contact, the correction of a coarser grid is too large,
    by a factor that grows from grid to grid. The combination finds the best multiple of the correction. This
    is the K-cycle of Y. Notay and P. S. Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473,
    doi:10.1002/nla.542.
    """
    finest = jacobians[0]
    right = np.append(finest.scale * r, load)
    first = cycled(jacobians, right)
    image = finest.image(first)
    square = np.vdot(image, image)
    change, left = _best_multiple(first, image, right)
    if np.linalg.norm(left) > _ENOUGH * np.linalg.norm(right):
        second = cycled(jacobians, left)
        next_image = finest.image(second)
        # The second image is made orthogonal to the first, so that both have their best multiple.
        part = np.vdot(image, next_image) / square if square > 0.0 else 0.0
        added, _ = _best_multiple(second - part * first, next_image - part * image, left)
        change = change + added
    return change[:-1].reshape(r.shape), float(change[-1])


def _best_multiple(change: Array, image: Array, right: Array) -> tuple[Array, Array]:
    """Multiple of a change whose image is nearest to the right side, and what is left of the right side."""
    square = np.vdot(image, image)
    part = np.vdot(image, right) / square if square > 0.0 else 0.0
    return part * change, right - part * image
