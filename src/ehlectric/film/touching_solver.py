"""Films whose surfaces may touch, on one grid: dry contacts, initial guesses, and iteration in time.

Newton's method converges from different initial guesses at different speeds. If the oil carries part of
the load, the dry contact with its pressure carried by the oil is near enough, since it has the shape that the
surfaces take. If the oil carries almost no load, the dry contact itself is near enough. In between, the
film is followed in time from the dry contact on until it is stationary.

A film that counts its cavities as full is a solution of the equations with a source of oil where it forms
again behind a cavity. Newton's method starts from it without this source. If Newton's method does not
converge, it starts again with less accurate schemes, which converge more often. Their film is a start for
the usual scheme.

If a ridge of a line contact touches, only the oil of the boundary film passes it. Whether such a ridge
parts depends on the ridges before it, and the film moves through it node by node as the valley in front of
it fills. Newton's method for the stationary film skips this process and does not converge. In time each step
is close to the last one, since the oil that a gap takes up has to flow there first:

    (rho H - rho H before)/dT + stationary residual = 0

with implicit Euler steps. The step grows where Newton's method solves it quickly and falls where it does not.
In the end it is infinite, so that the film is a solution of the stationary equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.dry_contact import dry_contact, relieved
from ehlectric.film.face_flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.newton import Asperities, GridProblem, GridSolution, Guess, NewtonStep, State
from ehlectric.film.oil_content import SCHEMES, Scheme, Supply
from ehlectric.film.reynolds import Stencil
from ehlectric.film.starved_solver import flooded_inlet, isothermal, of_full_order, with_inlet
from ehlectric.film.touching_film import Touching, assess_touching, projected
from ehlectric.film.touching_newton import (
    NEAR_DAMPING,
    OIL_TOLERANCE,
    Stepped,
    grid_solution,
    is_solved,
    newton_step,
    touching_newton,
)


@dataclass(frozen=True)
class Conserving:
    """Film with mass-conserving cavitation, to be solved on one grid."""

    problem: GridProblem  # lubricant, grids, asperities and stopping rule
    order: int  # order of the wedge term where oil fills the gap: 1, 2 or 3

    def films(self, attempts: Sequence[tuple[Guess, Scheme]]) -> list[GridSolution]:
        """Films of one attempt after the other, up to the first that converges.

        The film of a simpler scheme is a start for the more accurate schemes. Only the last film may have
        converged. Then its scheme is the most accurate one that converges.
        """
        films: list[GridSolution] = []
        for start, scheme in attempts:
            film = self._film(start, scheme)
            if film.status == "converged":
                return [*films, film if self.problem.only_start else self._most_accurate(film, scheme)]
            films.append(film)
        return films

    def _most_accurate(self, film: GridSolution, scheme: Scheme) -> GridSolution:
        """Film of the most accurate scheme that converges from the film of a scheme, with all steps to it."""
        for better in reversed(SCHEMES[: SCHEMES.index(scheme)]):
            closer = self._film(guess_of(film), better)
            if closer.status == "converged":
                film, scheme = replace(closer, steps=film.steps + closer.steps), better
        return of_full_order(self.problem, film, self._supply(scheme).of_full_order)

    def _film(self, start: Guess, scheme: Scheme) -> GridSolution:
        """Film of a scheme from a start, in which some nodes may have an upwind difference."""
        solved = isothermal(self.problem, full_order=False, first_damping=NEAR_DAMPING)
        return solved(start, self._supply(scheme))

    def _supply(self, scheme: Scheme) -> Supply:
        """Flooded inlet."""
        return flooded_inlet(self.problem.level, self.order, scheme)


def guess_of(film: GridSolution) -> Guess:
    """Initial guess with mass-conserving cavitation from a film on the same grid, with oil at its inlet."""
    return Guess(film.state, with_inlet(film.final.full_film))


# Inverse time steps, as the spacing dX over the distance that oil travels in the step: the first one, the one
# below which a step is infinite, the one after a failed infinite step, and the one at which the iteration
# ends.
_FIRST_STEP, _LEAST_STEP, _AFTER_INFINITE, _MOST = 1.0, 1e-3, 4e-3, 1e5

# Newton steps of a time step: at most, up to which the next time step is longer, and above which it is
# shorter; and the factors between the inverse time steps.
_MOST_NEWTON, _QUICK, _SLOW = 6, 3, 4
_LONGER_STEP, _SHORTER_STEP, _MUCH_SHORTER = 0.5, 1.3, 4.0

# Residual of a time step at most, and as a part of the stationary residual before it.
_LOOSE, _PART = 1e-2, 0.3

# Relative tolerance of the linear systems: with 0.1, Newton's method needs more steps than it saves work.
_CLOSE = 3e-2


def pseudo_transient_film(problem: GridProblem, state: State) -> GridSolution:
    """Stationary film on one grid, from a film that is followed in time.

    It has converged if its stationary residual is small after an infinite time step.

    Pseudo-transient continuation, C. T. Kelley and D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508,
    doi:10.1137/S0036142996304796. A film with a small residual need not be stationary: oil creeps through
    a boundary film so slowly that the film may change for a long time.
    """
    fluid, levels, level, asperities = problem.fluid, problem.levels, problem.level, problem.asperities
    tolerance = problem.reachable_tolerance
    steps: list[NewtonStep] = []
    now = assess_touching(fluid, level, state, asperities)
    state, rate = projected(fluid, state, now.contact), _FIRST_STEP
    while len(steps) < problem.max_iterations and rate < _MOST:
        problem.report(steps, now.norm)
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
            rate = _LONGER_STEP * rate if _LONGER_STEP * rate > _LEAST_STEP else 0.0
        elif len(taken) > _SLOW:
            rate *= _SHORTER_STEP
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
    """All grids with the equations of a time step from a film; ``rate`` is dX over the path of the oil."""
    finest = levels[0]
    mass: Array = now.flow.coefficients.density * now.thickness
    posed = []
    for level in levels:
        coefficients = level.wedge.coefficients.copy()
        coefficients[2][level.mesh.inner] += rate * finest.rate
        posed.append(replace(level, wedge=Stencil(coefficients)))
    gained = np.where(finest.mesh.inner, rate * finest.rate * mass, 0.0)
    return [replace(posed[0], source=finest.source + gained), *posed[1:]]


# Multiple of the largest number of Newton steps from each start, for the film that is followed in time.
_IN_TIME = 8


def touching_films(
    problem: GridProblem,
    dry_pressure: Array,
    *,
    film_guess: float,
    near: State | None = None,
    thorough: bool = True,
) -> Iterator[GridSolution]:
    """Last iterates from one initial guess after the other, up to the first that converges.

    ``dry_pressure`` (nx, ny) is the Hertz pressure P, and ``film_guess`` the film thickness H of smooth
    surfaces by a formula. Unless ``thorough``, as on coarser grids, only the first initial guess is tried.
    """
    boundary_film = problem.asperities.boundary_film
    if near is not None:
        close = [near]
        if problem.level.mesh.y.size > 1:
            close.insert(0, relieved(problem.level, near, boundary_film))
        for start in close:
            yield (film := touching_newton(problem, start, first_damping=NEAR_DAMPING))
            if film.status == "converged":
                return
        if not thorough:
            return
    ambient = problem.fluid.ambient_pressure
    dry = dry_contact(problem.level, dry_pressure, boundary_film, ambient)
    starts = [replace(dry, contact_pressure=0.0), dry]
    if film_guess <= boundary_film:
        starts.reverse()
    at_once = [partial(touching_newton, problem, start) for start in starts]
    long = replace(problem, max_iterations=_IN_TIME * problem.max_iterations)
    in_time = [partial(pseudo_transient_film, long, dry)] if thorough else []
    # Newton's method from the dry contact seldom converges on fine grids of line contacts.
    line = problem.level.mesh.dy is None
    for solved in in_time + at_once if line else at_once + in_time:
        yield (film := solved())
        if film.status == "converged" or not thorough:
            return
