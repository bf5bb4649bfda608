"""Transient film of a contact, solved on the patch where a point contact's film is decided.

The pressure outside the patch is the pressure of the stationary film before the motion: roughness that passes
there changes it very little, as the gap is several times the film. Its deflection, its load and its values on
the edges of the patch enter as in a stationary patch. A line contact, and a film that fills its domain, are
solved on the whole domain.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.errors import ConvergenceError
from ehlectric.film.film_solver import StarvedSolution, film_method
from ehlectric.film.heated_film import HeatedGrid
from ehlectric.film.heated_solution import heated_solution
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import GridSolution, State
from ehlectric.film.patch import Patch
from ehlectric.film.problem import FilmProblem
from ehlectric.film.unsteady import History, Instant, MovingGap, UnsteadyFilm
from ehlectric.runtime.threads import quiet_solution

# Distance of the patch's edge ahead of the dry contact, in semi-axes along entrainment. It is twice the
# distance of a stationary patch: with 0.7 the central film of four moving rough contacts was off by up to
# 0.27 %, with 1.4 by 0.05 %.
AHEAD = 1.4


class MovingFilm:
    """Solver of a transient film and of the stationary film before it, on a patch where there is one.
    ``moving_gap``, gap that moving roughness adds: function of T, X (nx,) and Y (ny,) -> (nx, ny).
    """

    def __init__(self, problem: FilmProblem, moving_gap: MovingGap) -> None:
        self.problem = problem
        self._moving_gap = moving_gap

    @cached_property
    def steady(self) -> GridSolution:
        """Stationary film on the whole domain before the motion. Raises ConvergenceError if it does not
        converge.
        """
        return self._steady_and_layer[0]

    @property
    def layer(self) -> Array | None:
        """Thickness H of the layer of oil at the inlet edge (ny,); None where the inlet is flooded."""
        return self._steady_and_layer[1]

    @cached_property
    def _steady_and_layer(self) -> tuple[GridSolution, Array | None]:
        """Stationary film, and its layer of oil where it is starved."""
        problem, layer = replace(self.problem, target_error=None), None
        with quiet_solution():
            if problem.physics is not None:
                refined = heated_solution(problem, None, order=problem.wedge_order)[1]
            else:
                refined = film_method(problem)(problem, None)
        steady = refined.last
        if isinstance(refined, StarvedSolution) and refined.starved:
            layer = refined.layer
        if steady.status != "converged":
            raise ConvergenceError(f"film before the motion, {steady.status}")
        return steady, layer

    @cached_property
    def patch(self) -> Patch | None:
        """Patch on which the film is solved; None for the whole domain.

        The meniscus of a starved film moves, and oil flows to and from the sides ahead of a patch. A film
        with heat has a temperature everywhere.
        """
        if self.layer is not None or self.problem.physics is not None:
            return None
        return Patch.around(self.problem, self.steady, ahead=AHEAD)

    @cached_property
    def film(self) -> UnsteadyFilm:
        """Solver of the time steps, on the patch or on the whole domain."""
        problem = self.problem if self.patch is None else self.patch.refined(1)
        hot = self.steady if isinstance(self.steady, HeatedGrid) else None
        return UnsteadyFilm(problem, self._moving_gap, self.layer, hot)

    def start(self, step: float) -> History:
        """History that starts from the stationary film, with a time T between its two instants."""
        if self.patch is None:
            return self.film.start(self.steady, step)
        with quiet_solution():
            inside = nested_iteration(self.film.problem, None, [self.steady])[-1]
        if inside.status != "converged":
            raise ConvergenceError(f"film before the motion, {inside.status}")
        return self.film.start(inside, step)

    def whole(self, instant: Instant) -> Instant:
        """Instant over the whole domain: outside the patch with the stationary pressure."""
        patch, steady = self.patch, self.steady
        if patch is None:
            return instant
        level, inside = steady.level, patch.nodes
        pressure = _composed(steady.state.pressure, instant.state.pressure, inside)
        gap = level.dry_gap + self._moving_gap(instant.time, level.mesh.x, level.mesh.y)
        state = State.of(replace(level, dry_gap=gap), pressure, instant.state.h00)
        thickness = _composed(state.thickness, instant.state.thickness, inside)
        density = _composed(steady.final.coefficients.density, instant.density, inside)
        touching = [
            np.broadcast_to(each.contact_pressure, each.pressure.shape)
            for each in (steady.state, instant.state)
        ]
        return Instant(
            time=instant.time,
            state=replace(
                state,
                thickness=thickness,
                contact_pressure=_composed(touching[0], touching[1], inside),
            ),
            mass=_composed(density * thickness, instant.mass, inside),
            density=density,
            full_film=_composed(steady.final.full_film, instant.full_film, inside),
        )


def _composed(outside: NDArray[Any], inside: NDArray[Any], nodes: tuple[slice, slice]) -> NDArray[Any]:
    """Nodal values of the whole domain (nx, ny), with the values of a patch at its nodes."""
    values = outside.copy()
    values[nodes] = inside
    return values
