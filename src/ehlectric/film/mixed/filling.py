"""Film between surfaces that touch, followed in time until it is stationary.

Where a ridge of a line contact touches, only the oil of the boundary film passes it. Whether such a ridge
parts depends on the ridges before it, and the film moves through it node by node as the valley in front of
it fills. Newton's method for the stationary film jumps over this course and comes to no end. In time each
step is close to the last one, since the oil that a gap takes up has to flow there first:

    (rho H - rho H before)/dT + stationary residual = 0

with implicit Euler steps. The step grows where Newton's method solves it quickly and falls where it does not.
In the end it is infinite, so that the film is a solution of the stationary equations.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mixed.newton import OIL_TOLERANCE, Stepped, grid_solution, is_solved, newton_step
from ehlectric.film.mixed.touching import Asperities, Touching, assess_touching, projected
from ehlectric.film.newton import ROUNDING
from ehlectric.film.reynolds import Stencil
from ehlectric.film.state import GridSolution, NewtonStep, Progress, State

# Inverse time steps, as the length dX over the way that oil goes in the step: the first one, the one below
# which a step is infinite, the one to which an infinite step falls, and the one at which the way ends.
_FIRST, _LEAST, _AFTER_INFINITE, _MOST = 1.0, 1e-3, 4e-3, 1e5

# Newton steps of a time step: at most, up to which the next time step is longer, and above which it is
# shorter; and the factors between the inverse time steps.
_MOST_NEWTON, _QUICK, _SLOW = 6, 3, 4
_LONGER, _SHORTER, _MUCH_SHORTER = 0.5, 1.3, 4.0

# Residual of a time step at most, and as a part of the stationary residual before it.
_LOOSE, _PART = 1e-2, 0.3

# Relative tolerance of the linear systems: with 0.1, Newton's method needs more steps than it saves work.
_CLOSE = 1e-2


def filled_film(
    fluid: Fluid,
    levels: list[Level],
    state: State,
    *,
    asperities: Asperities,
    tolerance: float,
    max_iterations: int,
    progress: Progress | None = None,
) -> GridSolution:
    """Stationary film on the first of ``levels``, from a film that is followed in time.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest; the coarser ones serve the preconditioner.
    state : State
        Film at the beginning, as the dry contact.
    asperities : Asperities
        Boundary film and hardness.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps of all time steps together.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every time step.

    Returns
    -------
    GridSolution
        Last film, with its status. It converged if its stationary residual is small after an infinite step.

    Notes
    -----
    Pseudo-transient continuation, C. T. Kelley and D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508,
    doi:10.1137/S0036142996304796. A small residual alone does not make a film stationary: oil creeps through
    a boundary film so slowly that the film may change for a long time.
    """
    level = levels[0]
    tolerance = max(tolerance, ROUNDING * level.rate)
    steps: list[NewtonStep] = []
    now = assess_touching(fluid, level, state, asperities)
    state, rate = projected(fluid, state, now.contact), _FIRST
    while len(steps) < max_iterations and rate < _MOST:
        if progress is not None:
            progress(level.nodes, len(steps), now.norm)
        posed = _time_step(levels, now, rate) if rate else levels
        goal = _Goal.of(now, tolerance, stationary=rate == 0.0)
        taken = _solved(fluid, posed, state, asperities, goal)
        steps += [step.record for step in taken]
        if not goal.reached(taken[-1].now):
            rate = _MUCH_SHORTER * rate if rate else _AFTER_INFINITE
            continue
        state = projected(fluid, taken[-1].state, taken[-1].now.contact)
        now = assess_touching(fluid, level, state, asperities)
        state = projected(fluid, state, now.contact)
        if rate == 0.0 and is_solved(now, tolerance):
            return grid_solution(level, state, now, steps, "converged")
        if len(taken) <= _QUICK:
            rate = _LONGER * rate if _LONGER * rate > _LEAST else 0.0
        elif len(taken) > _SLOW:
            rate *= _SHORTER
    return grid_solution(level, state, now, steps, "stalled")


@dataclass(frozen=True)
class _Goal:
    """Residuals at which a time step is solved: of all equations, and of the oil where surfaces touch."""

    norm: float
    oil_norm: float

    @classmethod
    def of(cls, now: Touching, tolerance: float, *, stationary: bool) -> _Goal:
        """Goal of a step from a film with the residual ``now``.

        Without a time step both residuals have to fall. In time the oil may lag behind.
        """
        if stationary:
            return cls(max(0.5 * tolerance, _PART * now.norm), max(0.5 * OIL_TOLERANCE, _PART * now.oil_norm))
        largest = max(now.norm, now.oil_norm)
        return cls(max(0.5 * tolerance, min(_LOOSE, _PART * largest)), np.inf)

    def reached(self, now: Touching) -> bool:
        """Whether the residual of a film is small enough; not where it is not a number."""
        return now.norm <= self.norm and now.oil_norm <= self.oil_norm


def _solved(
    fluid: Fluid, levels: list[Level], state: State, asperities: Asperities, goal: _Goal
) -> list[Stepped]:
    """Newton steps of one time step, up to the first one that reaches its goal."""
    taken: list[Stepped] = []
    now = assess_touching(fluid, levels[0], state, asperities)
    while len(taken) < _MOST_NEWTON and np.isfinite(now.norm):
        taken.append(newton_step(fluid, levels, state, now, asperities, _CLOSE))
        state, now = taken[-1].state, taken[-1].now
        if goal.reached(now):
            break
    return taken


def _time_step(levels: list[Level], now: Touching, rate: float) -> list[Level]:
    """All grids with the equations of a time step from a film; ``rate`` is dX over the way of the oil."""
    finest = levels[0]
    mass: Array = now.flow.coefficients.density * now.thickness
    posed = []
    for level in levels:
        coefficients = level.wedge.coefficients.copy()
        coefficients[2][level.mesh.inner] += rate * finest.rate
        posed.append(replace(level, wedge=Stencil(coefficients)))
    gained = np.where(finest.mesh.inner, rate * finest.rate * mass, 0.0)
    return [replace(posed[0], source=finest.source + gained), *posed[1:]]
