"""Newton-Krylov iteration for a film whose surfaces touch at some nodes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mixed.jacobian import TouchingJacobian
from ehlectric.film.mixed.touching import Asperities, Carried, Touching, assess_touching, projected
from ehlectric.film.newton import ROUNDING, flexible_gmres, linear_tolerance
from ehlectric.film.starved.newton import Seen
from ehlectric.film.state import GridSolution, NewtonStep, Progress, Residual, State, Status

# Largest change of Q in a Newton step.
_PRESSURE_STEP = 0.5

# Part of the gap above the boundary film that a step may close, beside half of the boundary film; and the
# smallest part of a step.
_CLOSING, _LEAST_STEP = 0.5, 0.05

# Residual of the oil where surfaces touch, a pressure over p_h, that is small enough: it does not move the
# gap.
OIL_TOLERANCE = 1e-6

# Largest number of GMRES iterations per Newton step.
_KRYLOV_LIMIT = 100

# Damping of a Newton step at most, the least one when it is raised, and the factors by which it falls and
# rises. It falls after a step of more than half its length that reduces the residual. Without damping, nodes
# at the edges of spots come into contact and leave it in turn.
_MOST_DAMPING, _LEAST_RAISED = 4.0, 0.1
_FALL, _RISE, _LONG = 0.3, 2.0, 0.5

# Steps after which the iteration ends if they have not halved the smallest residual so far. Films that
# converged took up to 60.
_PATIENCE = 70

# Residual below which there is no damping.
_NEAR = 1e-3


def mixed_newton(
    fluid: Fluid,
    levels: list[Level],
    state: State,
    *,
    asperities: Asperities,
    tolerance: float,
    max_iterations: int,
    first_damping: float = 1.0,
    progress: Progress | None = None,
    carried: Carried | None = None,
) -> GridSolution:
    """Solve the film equations on the first of ``levels`` where surfaces may touch.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest; the coarser ones serve the preconditioner.
    state : State
        Initial guess.
    asperities : Asperities
        Boundary film and hardness.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps.
    first_damping : float
        Damping of the first step: the length dX over the way that oil goes in the time step that a Newton
        step stands for.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every step.
    carried : Carried, optional
        Nodes that oil fills in the initial guess, where the oil in cavities is carried through them.

    Returns
    -------
    GridSolution
        Last iterate, with its status; its state has the contact pressure.
    """
    level = levels[0]
    tolerance = max(tolerance, ROUNDING * level.rate)
    steps: list[NewtonStep] = []
    now, seen = assess_touching(fluid, level, state, asperities, carried), Seen()
    before, damping = np.inf, first_damping
    best, found = np.inf, 0  # smallest residual that was half of the one before, and its step
    status: Status = "stalled"
    while len(steps) < min(max_iterations, found + _PATIENCE) and not is_solved(now, tolerance):
        if progress is not None:
            progress(level.nodes, len(steps), now.norm)
        if now.norm < 0.5 * best:
            best, found = now.norm, len(steps)
        close = linear_tolerance(now.norm, before, 0.0)
        before = now.norm
        step = newton_step(fluid, levels, state, now, asperities, close, damping)
        steps.append(step.record)
        assessed = step.now
        if not np.isfinite(assessed.norm):
            status = "diverged"
            break
        state = step.state
        if now.carried is not None and assessed.carried is not None and not assessed.settled:
            filled, moved = now.carried.filled, assessed.carried.filled
            supply = seen.calmed(assessed.carried.supply, filled, moved)
            assessed = replace(assessed, carried=replace(assessed.carried, supply=supply))
        better = assessed.norm < now.norm and step.length > _LONG
        damping = _FALL * damping if better else min(_MOST_DAMPING, max(_RISE * damping, _LEAST_RAISED))
        damping = damping if assessed.norm > _NEAR else 0.0
        now = assessed
    if is_solved(now, tolerance):
        status = "converged"
    return grid_solution(level, projected(fluid, state, now.contact), now, steps, status)


@dataclass(frozen=True)
class Stepped:
    """Film after one Newton step.

    Attributes
    ----------
    state : State
        Pressures, H00 and gap.
    now : Touching
        Residual of the state.
    length : float
        Part of the full Newton step that was taken.
    record : NewtonStep
        Residual before the step, and its GMRES iterations.
    """

    state: State
    now: Touching
    length: float
    record: NewtonStep


def newton_step(
    fluid: Fluid,
    levels: list[Level],
    state: State,
    now: Touching,
    asperities: Asperities,
    close: float,
    damping: float = 0.0,
) -> Stepped:
    """Film after one Newton step on the first of ``levels``.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest.
    state : State
        Film before the step.
    now : Touching
        Residual of this film.
    asperities : Asperities
        Boundary film and hardness.
    close : float
        Relative tolerance of the linear system.
    damping : float
        Damping of the step: the length dX over the way that oil goes in the time that it stands for.

    Returns
    -------
    Stepped
        Film after the part of the step that keeps the changes within their limits. Where there is no step,
        as the linear system is singular, the same film with an infinite residual.
    """
    level = levels[0]
    state = projected(fluid, state, now.contact)
    try:
        jacobian = TouchingJacobian.of(fluid, levels, state.oil_pressure, now, damping)
    except np.linalg.LinAlgError:
        return Stepped(state, replace(now, norm=np.inf), 0.0, NewtonStep(level.nodes, now.norm, 0))
    step = _direction(fluid, jacobian, state, now, close)
    length = _length(level, now, step, asperities.boundary_film)
    state = projected(fluid, _moved(level, state, now.contact, step, length), now.contact)
    record = NewtonStep(level.nodes, now.norm, step.krylov)
    assessed = assess_touching(fluid, level, state, asperities, now.carried)
    return Stepped(state, assessed, length, record)


@dataclass(frozen=True)
class _Step:
    """Full Newton step.

    Attributes
    ----------
    pressure, oil : ndarray, shape (nx, ny)
        Changes of Q, and of P where the surfaces touch.
    h00 : float
        Change of H00.
    krylov : int
        Number of GMRES iterations.
    """

    pressure: Array
    oil: Array
    h00: float
    krylov: int


def _moved(level: Level, state: State, contact: Mask, step: _Step, length: float) -> State:
    """State after a part ``length`` of a Newton step."""
    pressure = state.pressure + length * step.pressure
    oil = np.where(contact, state.oil_pressure + length * step.oil, pressure)
    pressure = np.maximum(pressure, 0.0)
    return State.of(level, pressure, state.h00 + length * step.h00, pressure - oil)


def is_solved(now: Touching, tolerance: float) -> bool:
    """Whether all equations hold within a tolerance, those of the oil where surfaces touch within 1e-6."""
    return now.settled and now.norm <= tolerance and now.oil_norm <= max(tolerance, OIL_TOLERANCE)


def grid_solution(
    level: Level, state: State, now: Touching, steps: Sequence[NewtonStep], status: Status
) -> GridSolution:
    """Solution on a grid, with the residual in the form of a film without contact."""
    # The gap of flattened asperities is that of the boundary film. So is that of asperities at the edges,
    # where no pressure opens it, and wherever an iterate that did not converge sinks into the other surface.
    of_flow = now.plastic | level.mesh.edge | (status != "converged")
    state = replace(state, thickness=np.where(of_flow, now.thickness, state.thickness))
    final = Residual(
        flow=now.flow,
        reynolds=now.reynolds,
        diagonal=now.diagonal,
        full_film=now.full_film,
        load=now.load,
        norm=now.norm,
    )
    return GridSolution(level, state, final, tuple(steps), status, now.fraction)


def _direction(
    fluid: Fluid, jacobian: TouchingJacobian, state: State, now: Touching, tolerance: float
) -> _Step:
    """Full Newton step at a state, from the linear system solved to a relative tolerance."""
    finest = jacobian.finest
    resting = fluid.ambient_pressure + finest.level.edge_excess
    to_ambient = np.where(now.full_film, 0.0, resting - state.oil_pressure)
    given = np.where(now.contact, now.to_hardness, to_ambient)
    right, oil = jacobian.right_side(now, to_ambient, given)
    load = now.load - finest.gap.load(given)
    cycles = 0

    def precondition(image: Array) -> Array:
        nonlocal cycles
        cycles += 1
        return jacobian.precondition(image)

    solution = flexible_gmres(
        jacobian.image,
        precondition,
        np.append(finest.scale * right, load),
        tolerance=tolerance,
        limit=_KRYLOV_LIMIT,
    )
    dh00 = float(solution[-1])
    dq = solution[:-1].reshape(now.contact.shape)
    dh, _ = finest.gap.change(dq + given, dh00)
    dp = np.where(now.full_film, jacobian.oil_of(oil, dq, dh), to_ambient)
    return _Step(dq + given, dp, dh00, cycles)


def _length(level: Level, now: Touching, step: _Step, boundary_film: float) -> float:
    """Part of a full Newton step that keeps the changes of Q and of the open gap within their limits."""
    length = min(1.0, _PRESSURE_STEP / max(float(np.max(np.abs(step.pressure))), 1e-300))
    dh = level.deflection(step.pressure) + step.h00
    closing = (dh < 0.0) & ~now.contact
    if closing.any():
        room = _CLOSING * (now.thickness - boundary_film) + 0.5 * boundary_film
        length = min(length, float(np.min(room[closing] / -dh[closing])))
    return max(length, _LEAST_STEP)
