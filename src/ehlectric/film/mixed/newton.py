"""Newton-Krylov iteration for a film whose surfaces touch at some nodes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mixed.jacobian import TouchingJacobian
from ehlectric.film.mixed.touching import Asperities, Touching, assess_touching, projected
from ehlectric.film.newton import ROUNDING, flexible_gmres, linear_tolerance
from ehlectric.film.state import GridSolution, NewtonStep, Progress, Residual, State, Status

# Largest change of Q in a Newton step.
_PRESSURE_STEP = 0.5

# Part of the gap above the boundary film that a step may close, beside half of the boundary film; and the
# smallest part of a step.
_CLOSING, _LEAST_STEP = 0.5, 0.05

# Residual of the oil where surfaces touch, a pressure over p_h, that is small enough: it does not move the
# gap.
_OIL_TOLERANCE = 1e-6

# Largest number of GMRES iterations per Newton step.
_KRYLOV_LIMIT = 100

# Damping of a Newton step at most, the least one when it is raised, and the factors by which it falls and
# rises. It falls after a step of more than half its length that reduces the residual. Without damping, nodes
# at the edges of spots come into contact and leave it in turn.
_MOST_DAMPING, _LEAST_RAISED = 4.0, 0.1
_FALL, _RISE, _LONG = 0.3, 2.0, 0.5

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

    Returns
    -------
    GridSolution
        Last iterate, with its status; its state has the contact pressure.
    """
    level = levels[0]
    tolerance = max(tolerance, ROUNDING * level.rate)
    steps: list[NewtonStep] = []
    now = assess_touching(fluid, level, state, asperities)
    before, damping = np.inf, first_damping
    while len(steps) < max_iterations and not _solved(now, tolerance):
        if progress is not None:
            progress(level.nodes, len(steps), now.norm)
        state = projected(fluid, state, now.contact)
        close = linear_tolerance(now.norm, before, 0.0)
        jacobian = TouchingJacobian.of(fluid, levels, state.oil_pressure, now, damping)
        dq, dp, dh00, krylov = _direction(fluid, jacobian, state, now, close)
        before = now.norm
        length = _length(level, now, dq, dh00, asperities.boundary_film)
        steps.append(NewtonStep(level.nodes, now.norm, krylov))
        pressure = state.pressure + length * dq
        oil = np.where(now.contact, state.oil_pressure + length * dp, pressure)
        moved = State.of(level, np.maximum(pressure, 0.0), state.h00 + length * dh00)
        moved = State(moved.pressure, moved.h00, moved.thickness, moved.pressure - oil)
        candidate = projected(fluid, moved, now.contact)
        assessed = assess_touching(fluid, level, candidate, asperities)
        if not np.isfinite(assessed.norm):
            return _solution(level, state, now, steps, "diverged")
        better = assessed.norm < now.norm and length > _LONG
        damping = _FALL * damping if better else min(_MOST_DAMPING, max(_RISE * damping, _LEAST_RAISED))
        damping = damping if assessed.norm > _NEAR else 0.0
        state, now = candidate, assessed
    status: Status = "converged" if _solved(now, tolerance) else "stalled"
    state = projected(fluid, state, now.contact)
    # The gap of flattened asperities is that of the boundary film.
    flattened = replace(state, thickness=np.where(now.plastic, now.thickness, state.thickness))
    return _solution(level, flattened, now, steps, status)


def _solved(now: Touching, tolerance: float) -> bool:
    return now.norm <= tolerance and now.oil_norm <= max(tolerance, _OIL_TOLERANCE)


def _solution(
    level: Level, state: State, now: Touching, steps: list[NewtonStep], status: Status
) -> GridSolution:
    """Solution on a grid, with the residual in the form of a film without contact."""
    final = Residual(
        flow=now.flow,
        reynolds=now.reynolds,
        diagonal=now.diagonal,
        full_film=now.full_film,
        load=now.load,
        norm=now.norm,
    )
    return GridSolution(level, state, final, tuple(steps), status)


def _direction(
    fluid: Fluid, jacobian: TouchingJacobian, state: State, now: Touching, tolerance: float
) -> tuple[Array, Array, float, int]:
    """Changes dQ, dP of the oil (nx, ny) and dH00 of a Newton step, and the number of GMRES iterations."""
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
    dp = jacobian.oil_of(oil, dq, dh)
    dp = np.where(now.contact, np.where(now.full_film, dp, to_ambient), dq + given)
    return dq + given, dp, dh00, cycles


def _length(level: Level, now: Touching, dq: Array, dh00: float, boundary_film: float) -> float:
    """Part of a full Newton step that keeps the changes of Q and of the open gap within their limits."""
    length = min(1.0, _PRESSURE_STEP / max(float(np.max(np.abs(dq))), 1e-300))
    dh = level.deflection(dq) + dh00
    closing = (dh < 0.0) & ~now.contact
    if closing.any():
        room = _CLOSING * (now.thickness - boundary_film) + 0.5 * boundary_film
        length = min(length, float(np.min(room[closing] / -dh[closing])))
    return max(length, _LEAST_STEP)
