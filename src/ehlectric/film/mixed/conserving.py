"""Films whose surfaces may touch and that carry the oil through their cavities.

A film that counts its cavities as full is a solution of the equations with a source of oil where it forms
again behind a cavity. Newton's method starts from it without this source. If that does not converge, the
source is taken away in steps. If that does not help, both are tried with an upwind difference where the gap
closes steeply, which is less accurate and converges more often.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mixed.course import NEAR_DAMPING
from ehlectric.film.mixed.newton import mixed_newton
from ehlectric.film.mixed.touching import Asperities, Carried, carried_rows
from ehlectric.film.starved.reformed import flooded_inlet, of_full_order, with_inlet
from ehlectric.film.state import GridSolution, Progress, State

# Part of the source that is taken away in the first step, the least one, the factors after a step that
# converged and one that did not, and the largest number of Newton steps of each.
_FIRST, _LEAST, _LONGER, _SHORTER, _STEPS = 0.25, 0.01, 1.5, 0.5, 40

# Residual of the steps on the way.
_ON_THE_WAY = 1e-6


@dataclass(frozen=True)
class Conserving:
    """Equations and stopping rule of a film that carries its oil through cavities, on one grid.

    Attributes
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest.
    asperities : Asperities
        Boundary film and hardness.
    order : int
        Order of the wedge term where oil fills the gap: 1, 2 or 3.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps from a start.
    progress : callable or None
        Function that is called with (nodes, Newton step, residual) before every step.
    first_order : bool
        Whether the wedge term is of first order where the gap closes steeply, as in ``Supply``.
    """

    fluid: Fluid
    levels: list[Level]
    asperities: Asperities
    order: int
    tolerance: float
    max_iterations: int
    progress: Progress | None = None
    first_order: bool = False

    def near(self, state: State, filled: Mask) -> GridSolution:
        """Film from a state that is likely to be close, with the nodes (nx, ny) that oil fills in it."""
        return self._solved(self.levels, state, filled, NEAR_DAMPING, self.tolerance, self.max_iterations)

    def from_full(self, solution: GridSolution, *, thorough: bool) -> Iterator[GridSolution]:
        """Films from a converged one that counts its cavities as full: at once, and ``thorough`` in steps.

        They end with the first that converges.
        """
        yield (found := self.near(solution.state, solution.final.full_film))
        if thorough and found.status != "converged":
            yield (found := self._in_steps(solution))
        if found.status != "converged" and not self.first_order:
            yield from replace(self, first_order=True).from_full(solution, thorough=thorough)

    def _in_steps(self, solution: GridSolution) -> GridSolution:
        """Film from which the oil that its cavities make is taken away in steps."""
        made, level = self._made(solution), self.levels[0]
        left, step, last = 1.0, _FIRST, solution
        while left > 0.0 and step > _LEAST:
            part = max(0.0, left - step)
            posed = [replace(level, source=level.source + part * made), *self.levels[1:]]
            tolerance = self.tolerance if part == 0.0 else max(self.tolerance, _ON_THE_WAY)
            found = self._solved(posed, last.state, last.final.full_film, 0.0, tolerance, _STEPS)
            if found.status == "converged":
                left, step, last = part, _LONGER * step, found
            else:
                step *= _SHORTER
        return replace(last, status="converged" if left == 0.0 else "stalled", level=level)

    def _made(self, solution: GridSolution) -> Array:
        """Oil (nx, ny) that appears at the nodes of a film which counts its cavities as full."""
        carried = self._carried(self.levels[0], solution.final.full_film)
        thickness = np.maximum(solution.state.thickness, self.asperities.boundary_film)
        rows, _ = carried_rows(self.levels[0], solution.final.flow, thickness, carried)
        return rows

    def _solved(
        self, levels: list[Level], state: State, filled: Mask, damping: float, tolerance: float, most: int
    ) -> GridSolution:
        found = self._newton(levels, state, filled, damping, tolerance, most)

        def solved(state: State, filled: Mask, most: int, tolerance: float) -> GridSolution:
            return self._newton(levels, state, filled, 0.0, tolerance, most)

        return of_full_order(found, solved, tolerance)

    def _newton(
        self, levels: list[Level], state: State, filled: Mask, damping: float, tolerance: float, most: int
    ) -> GridSolution:
        return mixed_newton(
            self.fluid,
            levels,
            state,
            asperities=self.asperities,
            tolerance=tolerance,
            max_iterations=most,
            first_damping=damping,
            progress=self.progress,
            carried=self._carried(levels[0], filled),
        )

    def _carried(self, level: Level, filled: Mask) -> Carried:
        """Nodes (nx, ny) that oil fills, with those of the inlet edge, and a flooded inlet."""
        return Carried(flooded_inlet(level, self.order, first_order=self.first_order), with_inlet(filled))
