"""Films whose surfaces may touch, on one grid: dry contacts, initial guesses, and iteration in time.

Newton's method converges from different initial guesses at different speeds. Where the oil carries part of
the load, the dry contact with its pressure carried by the oil is near enough, since it has the shape that the
surfaces take. Where the oil carries hardly any load, the dry contact itself is near enough. In between, the
film is followed in time from the dry contact on until it is stationary.

A film that counts its cavities as full is a solution of the equations with a source of oil where it forms
again behind a cavity. Newton's method starts from it without this source. If that does not converge, the
source is taken away in steps. If that does not help, both are tried with an upwind difference where the gap
closes steeply, which is less accurate and converges more often.

Where a ridge of a line contact touches, only the oil of the boundary film passes it. Whether such a ridge
parts depends on the ridges before it, and the film moves through it node by node as the valley in front of
it fills. Newton's method for the stationary film skips this process and does not converge. In time each step
is close to the last one, since the oil that a gap takes up has to flow there first:

    (rho H - rho H before)/dT + stationary residual = 0

with implicit Euler steps. The step grows where Newton's method solves it quickly and falls where it does not.
In the end it is infinite, so that the film is a solution of the stationary equations.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.newton import GridProblem, GridSolution, NewtonStep, State
from ehlectric.film.reynolds import Stencil
from ehlectric.film.starved_solver import flooded_inlet, of_full_order, with_inlet
from ehlectric.film.touching_film import (
    OIL_TOLERANCE,
    Asperities,
    Carried,
    Stepped,
    Touching,
    assess_touching,
    carried_rows,
    grid_solution,
    is_solved,
    newton_step,
    node_compliance,
    projected,
    touching_newton,
)

# Change of the pressure from step to step, relative to its mean, at which the iteration ends: it is a first
# guess.
_TOLERANCE = 1e-5
_MOST_STEPS = 400

# Root mean square of the gap of nodes in contact over H_s at which asperities count as relieved, and the
# largest number of steps.
_RELIEVED = 1e-4
_RELIEVING_STEPS = 200

# Curvature along a direction, over that of a single node, that is only rounding.
_ROUNDING = 1e-9


def dry_contact(level: Level, pressure: Array, boundary_film: float, ambient_pressure: float) -> State:
    """Contact without oil: Q >= P_amb, H >= H_s, (Q - P_amb)(H - H_s) = 0, and the balance of load.

    ``pressure`` (nx, ny) is an initial guess, such as the Hertz pressure. All of the resulting pressure above
    ambient is contact pressure.

    Conjugate gradients on the nodes in contact, after I. A. Polonsky and L. M. Keer, Wear 231 (1999) 206,
    doi:10.1016/S0043-1648(99)00113-1.
    """
    weights, inner = level.weights, level.mesh.inner
    base = level.dry_gap + level.deflection(np.full(level.mesh.shape, ambient_pressure))
    load = level.load - float(np.sum(weights)) * ambient_pressure
    q = np.where(inner, np.maximum(pressure - ambient_pressure, 0.0), 0.0)
    q *= load / float(np.vdot(weights, q))
    direction, last, h00 = np.zeros_like(q), 1.0, 0.0
    opened, compliance = level.deflection(q), node_compliance(level)
    for _ in range(_MOST_STEPS):
        touching = q > 0.0
        gap = base + opened
        h00 = -float(np.average(gap, weights=weights * touching))
        slack = np.where(touching, gap + h00, 0.0)
        square = float(np.vdot(weights, slack**2))
        direction = np.where(touching, slack + square / last * direction, 0.0)
        image = level.deflection(direction)
        image -= float(np.average(image, weights=weights * touching))
        curvature = float(np.vdot(weights * direction, image))
        # With a single node in contact the rest of the gap and the direction are rounding errors.
        if not curvature > _ROUNDING * compliance * float(np.vdot(weights, direction**2)):
            break
        step = float(np.vdot(weights * slack, direction)) / curvature
        after = np.maximum(q - step * direction, 0.0)
        pressed = inner & (after == 0.0) & (gap + h00 < 0.0)
        last = square
        if pressed.any():
            after[pressed] -= step * (gap + h00)[pressed]
            direction, last = np.zeros_like(q), 1.0
        after *= load / float(np.vdot(weights, after))
        change = float(np.max(np.abs(after - q)))
        q, opened = after, level.deflection(after)
        if change < _TOLERANCE:
            break
    touching = q > 0.0
    h00 = boundary_film - float(np.average(base + opened, weights=weights * touching))
    total = q + ambient_pressure
    return State(total, h00, Gap.of(level, total, h00).thickness, q)


def relieved(level: Level, state: State, boundary_film: float) -> State:
    """Film with the pressure of its oil and its H00, and the contact pressure that leaves no node pierced.

    On a finer grid a rough surface has waves that the film of the coarser grid does not know. Asperities that
    they push through the other surface are flattened here before the oil answers.

    The result has H >= H_s and P_c >= 0 within the domain, P_c about zero where H > H_s; it carries more
    load.

    Conjugate gradients on the nodes in contact, as in ``dry_contact``, without the balance of load.
    """
    weights, inner, oil = level.weights, level.mesh.inner, state.oil_pressure
    base = Gap.of(level, oil, state.h00).thickness - boundary_film
    contact = np.where(inner, state.contact_pressure, 0.0)
    gap, direction, last = base + level.deflection(contact), np.zeros_like(oil), 1.0
    for _ in range(_RELIEVING_STEPS):
        free = inner & ((contact > 0.0) | (gap < 0.0))
        slack = np.where(free, gap, 0.0)
        square = float(np.vdot(weights, slack**2))
        if square <= (_RELIEVED * boundary_film) ** 2 * float(np.sum(weights * free)):
            break
        direction = np.where(free, slack + square / last * direction, 0.0)
        image = level.deflection(direction)
        step = float(np.vdot(weights * slack, direction)) / float(np.vdot(weights * direction, image))
        after, last = contact - step * direction, square
        if np.any(after < 0.0):
            direction, last = np.zeros_like(oil), 1.0
        contact = np.maximum(after, 0.0)
        gap = base + level.deflection(contact)
    return State.of(level, oil + contact, state.h00, contact)


# Part of the source that is taken away in the first step, the least one, the factors after a step that
# converged and one that did not, and the largest number of Newton steps of each.
_FIRST, _LEAST, _LONGER, _SHORTER, _STEPS = 0.25, 0.01, 1.5, 0.5, 40

# Residual of the steps before the last one.
_INTERMEDIATE = 1e-6


@dataclass(frozen=True)
class Conserving:
    """Film that carries its oil through cavities, to be solved on one grid."""

    problem: GridProblem  # lubricant, grids and stopping rule
    asperities: Asperities  # boundary film and hardness
    order: int  # order of the wedge term where oil fills the gap: 1, 2 or 3
    # Whether the wedge term is of first order where the gap closes steeply, as in ``Supply``
    first_order: bool = False

    def near(self, state: State, filled: Mask) -> GridSolution:
        """Film from a state that is likely to be close, with the nodes (nx, ny) that oil fills in it."""
        return self._solved(self.problem, state, filled, NEAR_DAMPING)

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
        made, level, tolerance = self._made(solution), self.problem.level, self.problem.tolerance
        left, step, last = 1.0, _FIRST, solution
        while left > 0.0 and step > _LEAST:
            part = max(0.0, left - step)
            posed = replace(
                self.problem,
                levels=[replace(level, source=level.source + part * made), *self.problem.levels[1:]],
                tolerance=tolerance if part == 0.0 else max(tolerance, _INTERMEDIATE),
                max_iterations=_STEPS,
            )
            found = self._solved(posed, last.state, last.final.full_film, 0.0)
            if found.status == "converged":
                left, step, last = part, _LONGER * step, found
            else:
                step *= _SHORTER
        return replace(last, status="converged" if left == 0.0 else "stalled", level=level)

    def _made(self, solution: GridSolution) -> Array:
        """Oil (nx, ny) that appears at the nodes of a film which counts its cavities as full."""
        level = self.problem.level
        thickness = np.maximum(solution.state.thickness, self.asperities.boundary_film)
        carried = self._carried(level, solution.final.full_film)
        rows, _ = carried_rows(level, solution.final.flow, thickness, carried)
        return rows

    def _solved(self, problem: GridProblem, state: State, filled: Mask, damping: float) -> GridSolution:
        """Film from a state and the nodes (nx, ny) that oil fills in it, with a damping of the first step."""

        def solved(
            posed: GridProblem, state: State, filled: Mask, first_damping: float = 0.0
        ) -> GridSolution:
            carried = self._carried(posed.level, filled)
            return touching_newton(
                posed, state, self.asperities, first_damping=first_damping, carried=carried
            )

        return of_full_order(problem, solved(problem, state, filled, damping), solved)

    def _carried(self, level: Level, filled: Mask) -> Carried:
        """Nodes (nx, ny) that oil fills, with those of the inlet edge, and a flooded inlet."""
        return Carried(flooded_inlet(level, self.order, first_order=self.first_order), with_inlet(filled))


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
_CLOSE = 1e-2


def pseudo_transient_film(problem: GridProblem, state: State, asperities: Asperities) -> GridSolution:
    """Stationary film on one grid, from a film that is followed in time.

    It has converged if its stationary residual is small after an infinite time step.

    Pseudo-transient continuation, C. T. Kelley and D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508,
    doi:10.1137/S0036142996304796. A small residual alone does not make a film stationary: oil creeps through
    a boundary film so slowly that the film may change for a long time.
    """
    fluid, levels, level = problem.fluid, problem.levels, problem.level
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


# Damping of the first step from a state that is likely to be close.
NEAR_DAMPING = 0.1

# Multiple of the largest number of Newton steps from each start, for the film that is followed in time.
_IN_TIME = 8


def touching_films(
    problem: GridProblem,
    dry_pressure: Array,
    asperities: Asperities,
    *,
    film_guess: float,
    near: State | None = None,
    thorough: bool = True,
) -> Iterator[GridSolution]:
    """Last iterates from one initial guess after the other, up to the first that converges.

    ``dry_pressure`` (nx, ny) is the Hertz pressure P, and ``film_guess`` the film thickness H of smooth
    surfaces by a formula. Unless ``thorough``, as on coarser grids, only the first initial guess is tried.
    """
    if near is not None:
        close = [near]
        if problem.level.mesh.y.size > 1:
            close.insert(0, relieved(problem.level, near, asperities.boundary_film))
        for start in close:
            yield (found := touching_newton(problem, start, asperities, first_damping=NEAR_DAMPING))
            if found.status == "converged":
                return
        if not thorough:
            return
    ambient = problem.fluid.ambient_pressure
    dry = dry_contact(problem.level, dry_pressure, asperities.boundary_film, ambient)
    starts = [replace(dry, contact_pressure=0.0), dry]
    for start in starts if film_guess > asperities.boundary_film else starts[::-1]:
        yield (found := touching_newton(problem, start, asperities))
        if found.status == "converged" or not thorough:
            return
    in_time = replace(problem, max_iterations=_IN_TIME * problem.max_iterations)
    yield pseudo_transient_film(in_time, dry, asperities)
