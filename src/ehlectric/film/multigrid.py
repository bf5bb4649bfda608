"""V-cycle over all grids that preconditions the Newton steps of the film.

One V-cycle solves J (dP, dH00) = (r, load) approximately: the residual goes down to the coarsest grid and is
solved there by a dense factorisation; each finer grid adds one line relaxation on the way up.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import lapack

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.relaxation import LineRelaxation, distributed_nodes
from ehlectric.film.reynolds import Stencil, linearise, poiseuille_weight

# Change of ln eps between neighbours above which a coarser grid cannot represent the nodes.
_UNRESOLVED = 1.5

# Part of the residual that one cycle on a coarser grid may leave without a second.
_ENOUGH = 0.1


@dataclass(frozen=True)
class Linearised:
    """Jacobian of the film equations on one grid, as a linear operator on its full-film nodes.

    Cavitated nodes do not change: a change of pressure must be zero there, and the changes that the solvers
    return are.

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
        One over the diagonal of the Reynolds equation, and the diagonal; zero at cavitated nodes.
    resolved : ndarray of bool, shape (nx, ny)
        Nodes whose residual the coarser grids receive.
    """

    gap: Gap
    by_p: Stencil
    by_h: Stencil
    full_film: Mask
    poiseuille: Array
    scale: Array
    unscale: Array
    resolved: Mask

    @classmethod
    def of(cls, gap: Gap, at_faces: Flow, full_film: Mask) -> Linearised:
        """Jacobian at a state with this gap, this flow and these full-film nodes (nx, ny)."""
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
            resolved=_resolved(level, at_faces.coefficients.eps, full_film),
        )

    @property
    def level(self) -> Level:
        """Grid."""
        return self.gap.level

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the Reynolds residual (nx, ny) and of the load."""
        dh, load = self.gap.change(dp, dh00)
        return self.by_p(dp) + self.by_h(dh), load

    def image(self, change: Array) -> Array:
        """Scaled residual and load of a change of P and H00, each pair in one vector."""
        r, load = self(change[:-1].reshape(self.full_film.shape), float(change[-1]))
        return np.append(self.scale * r, load)

    @cached_property
    def relax(self) -> LineRelaxation:
        """Line relaxation with this Jacobian: r (nx, ny) -> dP (nx, ny)."""
        distributed = distributed_nodes(self.level, self.poiseuille, self.full_film)
        return LineRelaxation.of(self.gap, (self.by_p, self.by_h), self.full_film, distributed)

    @cached_property
    def solve_dense(self) -> DenseSolver:
        """Exact solver with this Jacobian, for the coarsest grid: (r, load) -> (dP, dH00)."""
        return DenseSolver.of(self.gap, self.by_p, self.by_h, self.full_film)


@dataclass(frozen=True)
class DenseSolver:
    """Jacobian of a grid with the balance of load, factorised whole.

    Attributes
    ----------
    full_film : ndarray of bool, shape (nx, ny)
        Nodes that are solved for; the change of the others is zero.
    factors, pivots : ndarray
        LU factorisation of the matrix of nx ny + 1 rows.
    """

    full_film: Mask
    factors: Array
    pivots: Array

    @classmethod
    def of(cls, gap: Gap, by_p: Stencil, by_h: Stencil, full_film: Mask) -> DenseSolver:
        """Factorise the Jacobian with these derivatives, whose rows are zero at cavitated nodes."""
        n = full_film.size
        matrix = np.zeros((n + 1, n + 1))
        matrix[:n, :n] = by_p.matrix() + by_h.matrix() @ gap.matrix()
        matrix[:n, n] = by_h.coefficients.sum(axis=0).ravel()
        matrix[n, :n] = np.where(full_film, gap.load_weights(), 0.0).ravel()
        cavitated = np.flatnonzero(~full_film.ravel())
        matrix[cavitated, cavitated] = 1.0
        factors, pivots, _ = lapack.dgetrf(matrix)
        return cls(full_film, factors, pivots)

    def __call__(self, r: Array, load: float) -> tuple[Array, float]:
        """Change (dP, dH00) that the right side r (nx, ny) and ``load`` ask for."""
        right = np.append(np.where(self.full_film, r, 0.0), load)
        solution, _ = lapack.dgetrs(self.factors, self.pivots, right)
        return np.where(self.full_film, solution[:-1].reshape(r.shape), 0.0), float(solution[-1])


def _resolved(level: Level, eps: Array, full_film: Mask) -> Mask:
    """Nodes whose residual the coarser grids receive.

    Beside the pressure spike of a line contact eps changes by orders of magnitude from node to node. There
    the relaxation, which is almost exact, works alone.
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
    """Jacobian on every grid: at the given state on the first, at the injected state on the others.

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
        In the order of ``levels``.
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


def v_cycle(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """Approximate (dP, dH00) with J (dP, dH00) = (r, load) on the full-film nodes of the finest grid.

    Parameters
    ----------
    jacobians : list of Linearised
        From the finest grid to the coarsest.
    r : ndarray, shape (nx, ny)
        Right side of the Reynolds equation, dimensionless.
    load : float
        Right side of the balance of load.

    Returns
    -------
    tuple
        dP, ndarray of shape (nx, ny), zero at cavitated nodes, and dH00.
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
    """One V-cycle from a scaled residual and load to a change of P and H00, each pair in one vector."""
    unscale = jacobians[0].unscale
    dp, dh00 = v_cycle(jacobians, unscale * image[:-1].reshape(unscale.shape), float(image[-1]))
    return np.append(dp, dh00)


def _two_cycles(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """Two V-cycles, combined so that the scaled residual becomes smallest.

    Along the ridge of pressure at the exit of a point contact a coarser grid overshoots, by factors that
    grow from grid to grid. The best multiple of its correction does not. This is the K-cycle of Y. Notay and
    P. S. Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473, doi:10.1002/nla.542.
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
        if np.linalg.norm(left) <= _ENOUGH * np.linalg.norm(right):
            break
    change = parts @ changes
    return change[:-1].reshape(r.shape), float(change[-1])
