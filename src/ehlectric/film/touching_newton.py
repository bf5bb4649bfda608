"""Newton-Krylov iteration for films whose surfaces touch at some nodes (``ehlectric.film.touching_film``)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.face_flow import Fluid
from ehlectric.film.gmres import flexible_gmres
from ehlectric.film.levels import Level
from ehlectric.film.newton import (
    LINEAR_TOLERANCE,
    SMALLEST_GAP,
    Asperities,
    GridProblem,
    GridSolution,
    NewtonStep,
    Residual,
    State,
    Status,
    linear_tolerance,
)
from ehlectric.film.oil_content import Carried, MaskMemory
from ehlectric.film.touching_film import (
    Touching,
    TouchingJacobian,
    assess_touching,
    node_compliance,
    projected,
    with_oil_step,
)

# Largest change of Q in a Newton step.
_PRESSURE_STEP = 0.5

# Part of the gap above the boundary film that a step may close, in addition to half of the boundary film;
# part of the closing nodes that may close further, as single nodes that come into contact; and the smallest
# part of a step.
_CLOSING, _FURTHER, _LEAST_STEP = 0.9, 0.002, 0.05

# Residual of the oil where surfaces touch, a pressure over p_h, that is small enough: it does not move the
# gap.
OIL_TOLERANCE = 1e-6

# Largest number of GMRES iterations per Newton step.
_KRYLOV_LIMIT = 100

# Damping of a Newton step at most, the least one when it is raised, and the factors by which it falls and
# rises. It falls after a step of more than half its largest length that reduces the residual. Without
# damping, nodes at the edges of spots come into contact and leave it in turn, and nodes at the edges of
# cavities are filled and cavitate in turn.
_MOST_DAMPING, _LEAST_RAISED = 4.0, 0.1
_FALL, _RISE, _LONG = 0.3, 2.0, 0.5

# Largest number of nodes of a line contact whose linear systems are solved loosely. A linear system that is
# not solved closely leaves errors in the inlet. On fine grids films with cavities do not converge then.
_LOOSE_LINE = 401

# Damping of the first step from a state that is likely to be close.
NEAR_DAMPING = 0.1

# Steps after which the iteration ends if they have not halved the smallest residual so far. Of 290 films that
# converged two took longer.
_PATIENCE = 30

# Changes of a node, from filled to cavitated or back, above which it goes in a circle.
_MOST_CHANGES = 4

# Residual below which there is no damping, and the factor by which it falls where a step without damping ends
# above it.
_NEAR, _NEARER = 1e-3, 0.03


def touching_newton(
    problem: GridProblem,
    state: State,
    *,
    first_damping: float = 1.0,
    carried: Carried | None = None,
    min_iterations: int = 0,
) -> GridSolution:
    """Last iterate of Newton's method on one grid, where the surfaces may touch.

    Where the oil in cavities is carried through them, ``carried`` has the nodes that oil fills in the initial
    guess. The state of the result contains the contact pressure.
    """
    fluid, level, tolerance = problem.fluid, problem.level, problem.reachable_tolerance
    asperities = problem.asperities
    loose = level.mesh.dy is not None or level.nodes <= _LOOSE_LINE
    with_oil = not problem.only_start
    steps: list[NewtonStep] = []
    now, memory = assess_touching(fluid, level, state, asperities, carried), MaskMemory(_MOST_CHANGES)
    before, damping, near = np.inf, first_damping, _NEAR
    best, best_step = np.inf, 0  # smallest residual that was half of the one before, and its step
    status: Status = "stalled"
    while len(steps) < min(problem.max_iterations, best_step + _PATIENCE):
        if len(steps) >= min_iterations and is_solved(now, tolerance, with_oil=with_oil):
            break
        problem.report(steps, now.norm)
        if now.norm < 0.5 * best:
            best, best_step = now.norm, len(steps)
        close = linear_tolerance(now.norm, before, 0.0) if loose else LINEAR_TOLERANCE
        before = now.norm
        part, constant = _way(now, best, len(steps) - best_step)
        here = _at_constant_weights(now) if constant else now
        step = newton_step(fluid, problem.levels, state, here, asperities, close, damping, part)
        steps.append(step.record)
        assessed = step.now
        thinnest = max(float(np.min(step.state.thickness)), asperities.boundary_film)
        if not (np.isfinite(assessed.norm) and thinnest > SMALLEST_GAP):
            status = "diverged"
            break
        state = step.state
        assessed = _remembered(memory, now, assessed)
        better = assessed.norm < now.norm and step.length > _LONG * part
        damping = _FALL * damping if better else min(_MOST_DAMPING, max(_RISE * damping, _LEAST_RAISED))
        near = _NEARER * near if now.norm <= near < assessed.norm else near
        damped = asperities.boundary_film > 0.0 and (carried is not None or assessed.contact.any())
        damping = damping if damped and assessed.norm > near else 0.0
        now = assessed
        if with_oil and not is_solved(now, tolerance):
            state, now = _with_oil_solved(fluid, level, state, now, asperities, tolerance)
    if is_solved(now, tolerance, with_oil=with_oil):
        status = "converged"
    return grid_solution(level, projected(fluid, state, now.contact), now, steps, status)


def _remembered(memory: MaskMemory, before: Touching, now: Touching) -> Touching:
    """Residual after a step, whose nodes that are filled and cavitate in turn have an upwind difference."""
    if before.carried is None or now.carried is None or now.settled:
        return now
    supply = memory.supply_after(now.carried.supply, before.carried.filled, now.carried.filled)
    return replace(now, carried=replace(now.carried, supply=supply))


def _with_oil_solved(
    fluid: Fluid, level: Level, state: State, now: Touching, asperities: Asperities, tolerance: float
) -> tuple[State, Touching]:
    """Film whose oil in the spots is solved at a given gap; the film itself where this is not possible.

    The end of a cavity may move through a spot by one node in each step, while all other equations hold. A
    step of the whole film for each node would take most of the time. If the same nodes are filled again and
    the residual of the oil has not fallen, the steps go in a circle and end.
    """
    moved, after = state, now
    known: dict[bytes, float] = {}  # residual of the oil by the nodes that are filled
    while (carried := after.carried) is not None and after.norm <= tolerance:
        filled = np.packbits(carried.filled).tobytes()
        if not after.oil_norm < 0.5 * known.get(filled, np.inf):
            break
        known[filled] = after.oil_norm
        moved = with_oil_step(fluid, level, moved, after)
        after = assess_touching(fluid, level, moved, asperities, carried)
        if is_solved(after, tolerance):
            return moved, after
    return state, now


# Residual below which Newton steps change where it does not fall, and the number of steps in which it has to
# halve. After each such number the next entry of the list counts, and after the last entry the first one: the
# largest part of a step, and whether it keeps the weights of the nodes.
_CLOSE_TO, _WITHIN = 1e-2, 4
_WAYS = ((1.0, False), (1.0, True), (1.0, True), (0.5, True), (0.5, True), (0.25, False))


def _way(now: Touching, best: float, waited: int) -> tuple[float, bool]:
    """Largest part of the next Newton step, and whether it keeps the weights of the nodes.

    ``best`` is the smallest residual that was half of the one before, and ``waited`` the number of steps
    since then. The weight of a node rises with its pressure, so that the mass that leaves the node may fall
    with its pressure. If the balance of the node has a minimum above zero there, Newton's method alternates
    between both sides of it. At constant weights the steps lead past it.
    """
    weighted = now.carried is not None and now.carried.supply.scheme.continuous
    return _WAYS[waited // _WITHIN % len(_WAYS)] if weighted and best <= _CLOSE_TO else _WAYS[0]


def _at_constant_weights(now: Touching) -> Touching:
    """Residual whose Jacobian does not contain the change of the weights with the pressure."""
    carried = now.carried
    if carried is None or carried.supply.fullness is None:
        return now
    fullness = replace(carried.supply.fullness, slope=np.zeros_like(now.reynolds))
    return replace(now, carried=replace(carried, supply=replace(carried.supply, fullness=fullness)))


@dataclass(frozen=True)
class Stepped:
    """Film after one Newton step."""

    state: State  # pressures, H00 and gap
    now: Touching
    length: float  # part of the full Newton step that was taken
    record: NewtonStep  # residual before the step, and its GMRES iterations


def newton_step(
    fluid: Fluid,
    levels: list[Level],
    state: State,
    now: Touching,
    asperities: Asperities,
    close: float,
    damping: float = 0.0,
    part: float = 1.0,
) -> Stepped:
    """Film on the first of ``levels`` after the part of a Newton step that keeps P and H within limits.

    ``part`` is the largest part of the step that is taken.
    """
    level = levels[0]
    state = projected(fluid, state, now.contact)
    try:
        jacobian = TouchingJacobian.of(fluid, levels, state.oil_pressure, now, damping)
    except np.linalg.LinAlgError:
        return Stepped(state, replace(now, norm=np.inf), 0.0, NewtonStep(level.nodes, now.norm, 0))
    step = _direction(fluid, jacobian, state, now, close)
    length = min(part, _length(level, now, step, asperities.boundary_film))
    moved = _moved(level, state, now.contact, step, length)
    state = _released(level, moved, projected(fluid, moved, now.contact), asperities.boundary_film)
    record = NewtonStep(level.nodes, now.norm, step.krylov)
    assessed = assess_touching(fluid, level, state, asperities, now.carried)
    return Stepped(state, assessed, length, record)


@dataclass(frozen=True)
class _Step:
    """Full Newton step."""

    # pressure and oil: changes of Q, and of P where the surfaces touch, shape (nx, ny).
    pressure: Array
    oil: Array
    h00: float
    krylov: int  # number of GMRES iterations


def _moved(level: Level, state: State, contact: Mask, step: _Step, length: float) -> State:
    """State after a part ``length`` of a Newton step."""
    pressure = state.pressure + length * step.pressure
    oil = np.where(contact, state.oil_pressure + length * step.oil, pressure)
    pressure = np.maximum(pressure, 0.0)
    return State.of(level, pressure, state.h00 + length * step.h00, pressure - oil)


def _released(level: Level, moved: State, state: State, boundary_film: float) -> State:
    """Projected state of a Newton step, whose nodes with negative contact pressure in the step open.

    The gap of a node in contact is the boundary film up to the error of the linear solution. Without contact
    pressure, only this error would decide whether the surfaces still touch.
    """
    least = np.minimum((state.thickness - boundary_film) / node_compliance(level), 0.0)
    opens = (moved.contact_pressure < 0.0) & (moved.contact_pressure <= least)
    return replace(state, contact_pressure=np.where(opens, least, state.contact_pressure))


def is_solved(now: Touching, tolerance: float, *, with_oil: bool = True) -> bool:
    """Whether all equations hold within a tolerance, the equations of the oil where surfaces touch within
    1e-6. Unless ``with_oil``, these equations, and the nodes that oil fills, are not checked.
    """
    if not with_oil:
        return now.norm <= tolerance
    return now.settled and now.norm <= tolerance and now.oil_norm <= max(tolerance, OIL_TOLERANCE)


def grid_solution(
    level: Level, state: State, now: Touching, steps: Sequence[NewtonStep], status: Status
) -> GridSolution:
    """Solution on a grid, with the residual in the form of a film without contact."""
    # The gap of flattened asperities is the boundary film. This also holds for asperities at the edges,
    # where no pressure opens the gap, and wherever an iterate that did not converge sinks into the other
    # surface.
    of_flow = now.plastic | level.mesh.edge | (status != "converged")
    state = replace(state, thickness=np.where(of_flow, now.thickness, state.thickness))
    final = Residual(**{each.name: getattr(now, each.name) for each in fields(Residual)})
    return GridSolution(level, state, final, tuple(steps), status, now.carried)


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
    solution, cycles = flexible_gmres(
        jacobian.image,
        jacobian.precondition,
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
    # The nodes of the mirror image count, so that a contact and half of it take the same step.
    dh, room = (level.mesh.mirrored(values) for values in (dh, now.thickness - boundary_film))
    closing = (dh < 0.0) & ~level.mesh.mirrored(now.contact)
    if closing.any():
        room = _CLOSING * room[closing] + 0.5 * boundary_film
        length = min(length, float(np.quantile(room / -dh[closing], _FURTHER)))
    return max(length, _LEAST_STEP)
