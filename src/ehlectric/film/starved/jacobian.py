"""Jacobian of a starved film after the elimination of the cavitated masses, and its preconditioner."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import SuperLU, splu

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.multigrid import Linearised, cycled, resolved_nodes
from ehlectric.film.reynolds import Stencil, linearise, poiseuille_weight, stencil_matrix, without_columns
from ehlectric.film.starved.content import Runs, Supply, of_filled
from ehlectric.film.state import Residual, State


@dataclass(frozen=True)
class StarvedJacobian:
    """Jacobian on the finest grid, with those of all grids that precondition it.

    Attributes
    ----------
    levels : list of Linearised
        Jacobians on all grids, in which a run of cavitated nodes adds only its last row to the row of the
        first filled node behind it.
    by_p, by_h : Stencil
        Derivatives of all rows of the finest grid by P and by H, before the elimination.
    runs : Runs
        Runs of cavitated nodes on the finest grid.
    inlet : InletFlow or None
        Flow at fixed gap, for a point contact; None for a line contact.
    """

    levels: list[Linearised]
    by_p: Stencil
    by_h: Stencil
    runs: Runs
    inlet: InletFlow | None

    @classmethod
    def of(
        cls, fluid: Fluid, levels: list[Level], state: State, now: Residual, filled: Mask, supply: Supply
    ) -> StarvedJacobian:
        """Jacobian at a state, with the nodes that oil fills; the coarser grids take its injection."""
        pressure, thickness, at_faces, on_edge = state.pressure, state.thickness, now.flow, filled
        by_p, by_h = _stencils(levels[0], at_faces, thickness, filled, supply)
        jacobians = [_linearised(levels[0], (by_p, by_h), at_faces, thickness, filled)]
        for level in levels[1:]:
            pressure, thickness = level.inject(pressure), level.inject(thickness)
            on_edge = level.inject(on_edge.astype(float)) > 1.0 - 1e-9
            supply = supply.injected(level)
            at_faces = flow(fluid, pressure, thickness, level.mesh)
            stencils = _stencils(level, at_faces, thickness, on_edge, supply)
            jacobians.append(_linearised(level, stencils, at_faces, thickness, on_edge))
        runs, inlet = Runs.of(filled), None
        if levels[0].mesh.dy is not None:
            inlet = InletFlow.of(jacobians[0], by_p, runs)
        return cls(jacobians, by_p, by_h, runs, inlet)

    @property
    def finest(self) -> Linearised:
        """Jacobian on the finest grid that preconditions."""
        return self.levels[0]

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the reduced rows (nx, ny) and of the load for changes dP (nx, ny) and dH00."""
        dh, load = self.finest.gap.change(dp, dh00)
        rows = self.runs.reduced(self.by_p(dp) + self.by_h(dh))
        return np.where(self.finest.full_film, rows, 0.0), load

    def image(self, change: Array) -> Array:
        """Change of scaled residual and load, as one vector, for a change of P and H00, as one vector."""
        rows, load = self(change[:-1].reshape(self.finest.full_film.shape), float(change[-1]))
        return np.append(self.finest.scale * rows, load)

    def precondition(self, image: Array) -> Array:
        """Approximate change of P and H00 from a scaled residual and load.

        A V-cycle; in a point contact, what it leaves where the Poiseuille term dominates is solved at fixed
        gap, with the masses of cavitated nodes across which oil flows to the sides.
        """
        change = cycled(self.levels, image)
        if self.inlet is not None:
            left = (image - self.image(change))[:-1].reshape(self.finest.full_film.shape)
            change[:-1] += self.inlet(self.finest.unscale * left).ravel()
        return change


@dataclass(frozen=True)
class InletFlow:
    """Flow at fixed gap where the Poiseuille term dominates, with the masses of cavitated nodes.

    Attributes
    ----------
    opened : ndarray of bool, shape (nx, ny)
        Filled nodes where the Poiseuille term dominates.
    unknown : ndarray of bool, shape (nx, ny)
        These nodes, and the cavitated nodes from which mass reaches filled ones.
    factors : SuperLU
        Factorisation of their rows by the pressure of the filled and the mass of the cavitated nodes.
    """

    opened: Mask
    unknown: Mask
    factors: SuperLU

    @classmethod
    def of(cls, finest: Linearised, by_p: Stencil, runs: Runs) -> InletFlow | None:
        """Flow at a state, from the rows by P before the elimination; None where its matrix is singular."""
        level = finest.level
        opened = finest.full_film & (finest.poiseuille > level.rate)
        c = without_columns(by_p, ~opened).coefficients
        coupled = runs.summed(np.abs(c).sum(axis=0)) > 0.0
        # The mass of a cavitated node is carried to the node behind it.
        c[2][runs.cavitated] = level.rate
        c[1][1:][runs.cavitated[:-1]] = -level.rate
        unknown = opened | (coupled & level.mesh.inner)
        if not opened.any():
            return None
        try:
            return cls(opened, unknown, splu(stencil_matrix(Stencil(c), unknown)))
        except RuntimeError:
            return None

    def __call__(self, rows: Array) -> Array:
        """Change of P (nx, ny) for a change of the reduced rows (nx, ny), zero where others dominate."""
        change = np.zeros_like(rows)
        change[self.unknown] = self.factors.solve(np.where(self.opened, rows, 0.0)[self.unknown])
        return np.where(self.opened, change, 0.0)


def _stencils(
    level: Level, at_faces: Flow, thickness: Array, filled: Mask, supply: Supply
) -> tuple[Stencil, Stencil]:
    """Derivatives of all rows by P and by H at fixed masses of the cavitated nodes."""
    wedge = supply.wedge(level.mesh, filled)
    return linearise(of_filled(at_faces, filled), wedge, thickness, level.mesh)


def _linearised(
    level: Level, stencils: tuple[Stencil, Stencil], at_faces: Flow, thickness: Array, filled: Mask
) -> Linearised:
    """Jacobian on one grid whose rows behind cavitated nodes contain the row of the node before."""
    full_film, gap = filled & level.mesh.inner, Gap(level, thickness)
    poiseuille = poiseuille_weight(at_faces, level.mesh)
    diagonal = poiseuille + gap.elastic_weight(at_faces.coefficients.density)
    behind = behind_cavities(filled) & full_film
    by_p, by_h = (with_row_before(part, behind).on_rows(full_film) for part in stencils)
    return Linearised(
        gap=gap,
        by_p=by_p,
        by_h=by_h,
        full_film=full_film,
        poiseuille=poiseuille,
        scale=np.divide(1.0, diagonal, out=np.zeros(full_film.shape), where=full_film),
        unscale=np.where(full_film, diagonal, 0.0),
        resolved=resolved_nodes(level, at_faces.coefficients.eps, full_film),
        log_viscosity=at_faces.coefficients.log_viscosity,
    )


def behind_cavities(filled: Mask) -> Mask:
    """Mask of the filled nodes (nx, ny) whose node before is not filled."""
    behind = filled.copy()
    behind[1:] &= ~filled[:-1]
    behind[0] = False
    return behind


def with_row_before(stencil: Stencil, rows: Mask) -> Stencil:
    """Stencil to whose ``rows`` (nx, ny) the row of the node before is added.

    A neighbour of the node before is one step further upstream; the one three steps upstream and those across
    entrainment are left out.
    """
    c = stencil.coefficients.copy()
    for row in range(3):
        c[row, 1:] += np.where(rows[1:], stencil.coefficients[row + 1, :-1], 0.0)
    return Stencil(c)
