"""Course of the solution of a starved film on one grid: starts, and the layer of oil that falls in steps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mesh import at_centre
from ehlectric.film.starved.content import Supply
from ehlectric.film.starved.newton import Content, starved_newton
from ehlectric.film.state import GridSolution, Progress, State

# Multiple of the layer of oil above which the inlet of an initial guess is not filled.
_FILLED = 3.0

# Smallest gap of an initial guess over the layer of oil.
_LEAST_GAP = 0.5

# Films thinner than this part of the flooded one start from the pressure of the dry contact first.
_DRY = 0.15

# Factor of the layer between two steps: at first, and the one closest to 1 with which the steps end.
_FALL, _LEAST_FALL = 0.6, 0.97

# Largest number of films with a layer between the flooded film and the layer asked for.
_MOST_STEPS = 40


@dataclass(frozen=True)
class StarvedFilm:
    """Starved film on one grid.

    Attributes
    ----------
    solution : GridSolution
        Last iterate, with its status.
    content : Content
        Its content of oil.
    layer : ndarray, shape (ny,)
        Thickness H of the layer of oil at the lines of the grid.
    """

    solution: GridSolution
    content: Content
    layer: Array

    @property
    def fraction(self) -> Array:
        """Part of the gap that oil fills, shape (nx, ny)."""
        return self.content.fraction(self.solution.state.thickness)


@dataclass(frozen=True)
class Course:
    """Equations and stopping rule of a starved film on one grid.

    Attributes
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest of the preconditioner.
    order : int
        Order of the wedge term where the film is filled.
    flooded : GridSolution
        Flooded film on the same grid.
    dry_pressure : ndarray, shape (nx, ny)
        Hertz pressure P.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps from each start.
    progress : callable or None
        Function that is called with (nodes, Newton step, residual) before every step.
    """

    fluid: Fluid
    levels: list[Level]
    order: int
    flooded: GridSolution
    dry_pressure: Array
    tolerance: float
    max_iterations: int
    progress: Progress | None = None

    @property
    def level(self) -> Level:
        """Grid to solve on."""
        return self.levels[0]

    @property
    def flooded_mass(self) -> float:
        """Mass rho H of the flooded film at the centre."""
        density = self.flooded.final.coefficients.density
        return at_centre(self.level.mesh, density * self.flooded.state.thickness)

    def solved(self, layer: Array, near: tuple[State, Mask] | None = None) -> StarvedFilm:
        """Starved film under a layer of oil (ny,), from one start after the other until one converges.

        ``near`` is a state with its filled nodes that is likely to be close, as that of a coarser grid.
        """
        best = None
        for film in self._attempts(layer, near):
            if best is None or film.solution.final.norm < best.solution.final.norm:
                best = film
            if film.solution.status == "converged":
                return film
        assert best is not None
        return best

    def _attempts(self, layer: Array, near: tuple[State, Mask] | None) -> Iterator[StarvedFilm]:
        """Films from all starts, the likeliest one first."""
        if near is not None:
            yield self._newton(layer, *near)
        starts = [self._from_flooded, self._from_dry]
        scarce = at_centre_line(self.level, layer) < _DRY * self.flooded_mass
        for start in reversed(starts) if scarce else starts:
            yield self._newton(layer, *start(layer))
        yield from self._in_steps(layer)

    def _newton(self, layer: Array, state: State, filled: Mask) -> StarvedFilm:
        ambient = self.flooded.final.coefficients.density[0]
        found = starved_newton(
            self.fluid,
            self.levels,
            state,
            filled,
            supply=Supply(ambient * layer, self.order),
            tolerance=self.tolerance,
            max_iterations=self.max_iterations,
            progress=self.progress,
        )
        return StarvedFilm(*found, layer)

    def _from_flooded(self, layer: Array) -> tuple[State, Mask]:
        """Flooded film whose surfaces are brought together until its centre is as thick as the layer."""
        state = self.flooded.state
        return self._lowered(layer, replace(state, contact_pressure=0.0), self.flooded.final.full_film)

    def _from_dry(self, layer: Array) -> tuple[State, Mask]:
        """Dry contact at a distance as large as the layer."""
        pressure = np.maximum(self.dry_pressure, self.fluid.ambient_pressure)
        state = State.of(self.level, pressure, 0.0)
        return self._lowered(layer, state, self.level.mesh.inner)

    def _lowered(self, layer: Array, state: State, filled: Mask) -> tuple[State, Mask]:
        """State whose centre is as thick as the layer, or as the flooded film, and its filled nodes."""
        mesh, least = self.level.mesh, at_centre_line(self.level, layer)
        centre = at_centre(mesh, state.thickness)
        density = self.flooded_mass / at_centre(mesh, self.flooded.state.thickness)
        shift = min(least, self.flooded_mass) / density - centre
        state = State(state.pressure, state.h00 + shift, state.thickness + shift)
        state = state.lifted(_LEAST_GAP * min(least, self.flooded_mass))
        inlet = mesh.x[:, np.newaxis] < 0.0
        return state, filled & ~(inlet & (state.thickness > _FILLED * layer))

    def _in_steps(self, layer: Array) -> Iterator[StarvedFilm]:
        """Films under a layer that falls from that of the flooded film; the last one is that asked for."""
        least = float(np.min(layer))
        part = max(1.0, 0.9 * self.flooded_mass / max(least, 1e-300))
        fall, last = _FALL, None
        for _ in range(_MOST_STEPS):
            here = part * layer
            start = self._from_flooded(here) if last is None else self._follow(last, here)
            film = self._newton(here, *start)
            if film.solution.status == "converged":
                if part == 1.0:
                    yield film
                    return
                last, fall = film, fall**1.5
            else:
                part, fall = part / fall, fall**0.5
                if fall > _LEAST_FALL or last is None:
                    return
            part = max(1.0, fall * part)

    def _follow(self, last: StarvedFilm, layer: Array) -> tuple[State, Mask]:
        """Start for a slightly thinner layer from a converged film."""
        state = last.solution.state
        fall = at_centre_line(self.level, layer) / at_centre_line(self.level, last.layer)
        shift = (fall - 1.0) * at_centre(self.level.mesh, state.thickness)
        lowered = State(state.pressure, state.h00 + shift, state.thickness + shift)
        return lowered.lifted(_LEAST_GAP * fall * float(np.min(state.thickness))), last.content.filled


def at_centre_line(level: Level, layer: Array) -> float:
    """Thickness of a layer of oil (ny,) on the line Y = 0."""
    return float(np.interp(0.0, level.mesh.y, layer))
