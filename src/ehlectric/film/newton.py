"""Newton-Krylov iteration for the film on one grid, preconditioned by all coarser grids.

The unknowns are the pressure P at the nodes and the rigid displacement H00. Newton's method solves the
Reynolds equation at the nodes with a full film, P = P_amb at the cavitated nodes, and the balance of load.
``ehlectric.film.cavitation`` decides which nodes are cavitated.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse.linalg import LinearOperator, gcrotmk

from ehlectric.arrays import Array
from ehlectric.film.cavitation import full_film_nodes, with_refilled_nodes
from ehlectric.film.flow import Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.multigrid import cycled, linearise_levels
from ehlectric.film.reynolds import poiseuille_weight, residual
from ehlectric.film.spike import relax_spike, step_length
from ehlectric.film.state import GridSolution, NewtonStep, Progress, Residual, State, Status

# Limits of one Newton step: largest change of P, and smallest fraction of every gap that remains. Larger
# steps leave the basin of convergence at the spike of light contacts; smaller steps only take more of them.
PRESSURE_STEP = 0.3
GAP_STEP = 0.3

# Residual times dX that is caused by rounding of H: about 40 times the machine epsilon.
ROUNDING = 40.0 * np.finfo(float).eps

# Smallest H of an iterate; thinner iterates count as diverged. It is thousands of times thinner than the
# films at the corners of the Moes map.
_SMALLEST_GAP = 1e-8

# Relative tolerance of the linear solutions: Newton's method gains about three digits per step.
LINEAR_TOLERANCE = 1e-3

# Largest number of GMRES iterations per Newton step.
KRYLOV_LIMIT = 60

# Residual below which a film that has grown in two successive steps is filled over many nodes at a time.
_NEAR = 1e-3

# Weight of the relative load imbalance in the residual: the load is balanced ten times as closely as the
# Reynolds equation.
_LOAD_WEIGHT = 10.0


def newton(
    fluid: Fluid,
    levels: list[Level],
    state: State,
    *,
    tolerance: float,
    max_iterations: int,
    min_iterations: int = 0,
    progress: Progress | None = None,
    eliminate_spike: bool = False,
) -> GridSolution:
    """Solve the film equations on the first of ``levels`` by Newton's method.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest; the coarser ones serve the preconditioner.
    state : State
        Initial guess.
    tolerance : float
        Residual at which to stop: the largest of the scaled Reynolds residuals, of P - P_amb at cavitated
        nodes, and of ten times the relative load imbalance. On very fine grids it is raised to what rounding
        allows.
    max_iterations : int
        Largest number of Newton steps.
    min_iterations : int
        Smallest number of Newton steps, whatever the residual is. The residual of each row is scaled with the
        derivative by the pressure at its own node. Where the residual is smooth over n nodes, the error in
        pressure is n^2 times larger. An initial guess with a small residual may therefore not be a solution.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every step.
    eliminate_spike : bool
        Whether to solve the strongly nonlinear nodes separately before each step. This helps with initial
        guesses from a coarser grid.

    Returns
    -------
    GridSolution
        Last iterate, with its status.
    """
    level = levels[0]
    # The residual contains differences of H over dX, so that rounding of H causes a residual of this size.
    tolerance = max(tolerance, ROUNDING * level.rate)
    steps: list[NewtonStep] = []
    grown = 0  # successive steps in which the full film has grown
    now = assess(fluid, level, state)
    while len(steps) < min_iterations or (now.norm > tolerance and len(steps) < max_iterations):
        if progress is not None:
            progress(level.nodes, len(steps), now.norm)
        if eliminate_spike:
            state, now = _without_spike(fluid, level, state, now)
        dp, dh00, krylov = _direction(fluid, levels, state, now)
        dh, _ = Gap(level, state.thickness).change(dp, dh00)
        length = step_length(state.thickness, dp, dh, pressure_step=PRESSURE_STEP, gap_step=GAP_STEP)
        steps.append(NewtonStep(level.nodes, now.norm, krylov))
        candidate = State.of(level, state.pressure + length * dp, state.h00 + length * dh00)
        assessed = assess(fluid, level, candidate)
        if not (np.isfinite(assessed.norm) and np.min(candidate.thickness) > _SMALLEST_GAP):
            return GridSolution(level, state, now, tuple(steps), "diverged")
        grown = grown + 1 if np.sum(assessed.full_film) > np.sum(now.full_film) else 0
        if grown > 1 and tolerance < assessed.norm < _NEAR:
            assessed = _refilled(assessed)
        state, now = candidate, assessed
    status: Status = "converged" if now.norm <= tolerance else "stalled"
    return GridSolution(level, state, now, tuple(steps), status)


def _refilled(now: Residual) -> Residual:
    """Residual with a full film also at the cavitated nodes that a surplus of oil fills."""
    return replace(now, full_film=with_refilled_nodes(now.full_film, now.reynolds))


def assess(fluid: Fluid, level: Level, state: State) -> Residual:
    """Residual of the film equations at a state, with the nodes that have a full film there.

    The norm takes the rows of the Reynolds equation over their diagonal, so that each is a pressure over p_h.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    level : Level
        Grid.
    state : State
        Pressure, H00 and film thickness.

    Returns
    -------
    Residual
        Residual of every equation, and their norm.
    """
    mesh, thickness = level.mesh, state.thickness
    at_faces = flow(fluid, state.pressure, thickness, mesh)
    gap = Gap(level, thickness)
    r = residual(at_faces, level.wedge, thickness, mesh) - level.source
    poiseuille = poiseuille_weight(at_faces, mesh)
    excess = state.pressure - fluid.ambient_pressure - level.edge_excess
    full_film = full_film_nodes(
        excess, r, poiseuille=poiseuille, rate=level.rate, thickness=thickness, inner=mesh.inner
    )
    load = level.load - gap.load(state.pressure)
    diagonal = poiseuille + gap.elastic_weight(at_faces.coefficients.density)
    unnormed = Residual(at_faces, r, diagonal, full_film, load, np.nan)
    rows = np.where(full_film, unnormed.scaled, excess)
    norm = float(np.max(np.abs(np.append(rows, _LOAD_WEIGHT * load / level.load))))
    return replace(unnormed, norm=norm)


def _without_spike(fluid: Fluid, level: Level, state: State, now: Residual) -> tuple[State, Residual]:
    """State after a separate solution of the nodes of the pressure spike, with its residual.

    If no residual stands out, or the separate solution fails, the state is returned unchanged.
    """
    pressure = relax_spike(
        fluid,
        Gap(level, state.thickness),
        pressure=state.pressure,
        full_film=now.full_film,
        scaled_residual=np.where(now.full_film, now.scaled, 0.0),
        pressure_step=PRESSURE_STEP,
        gap_step=GAP_STEP,
    )
    if pressure is None:
        return state, now
    relaxed = State.of(level, pressure, state.h00)
    if np.min(relaxed.thickness) <= _SMALLEST_GAP:
        return state, now
    return relaxed, assess(fluid, level, relaxed)


def _direction(fluid: Fluid, levels: list[Level], state: State, now: Residual) -> tuple[Array, float, int]:
    """Changes dP (nx, ny) and dH00 of a Newton step, and the number of GMRES iterations.

    The pressure of cavitated nodes changes to ambient. The change at the other nodes solves the linear
    system. The preconditioner is on the right, so that GMRES minimises the residual itself.
    """
    jacobians = linearise_levels(
        levels, fluid, now.flow, pressure=state.pressure, thickness=state.thickness, full_film=now.full_film
    )
    finest = jacobians[0]
    resting = fluid.ambient_pressure + levels[0].edge_excess
    to_ambient = np.where(now.full_film, 0.0, resting - state.pressure)
    change, load_change = finest(to_ambient, 0.0)
    right = np.append(-finest.scale * (now.reynolds + change), now.load - load_change)
    cycles = 0

    def precondition(image: Array) -> Array:
        nonlocal cycles
        cycles += 1
        return cycled(jacobians, image)

    # Flexible GMRES is needed, as the preconditioner varies: its cycles on coarser grids adapt to the right
    # side.
    solution, _ = gcrotmk(
        LinearOperator((right.size, right.size), matvec=finest.image, dtype=right.dtype),
        right,
        rtol=LINEAR_TOLERANCE,
        M=LinearOperator((right.size, right.size), matvec=precondition, dtype=right.dtype),
        m=KRYLOV_LIMIT,
        k=0,
        maxiter=1,
    )
    return to_ambient + solution[:-1].reshape(state.pressure.shape), float(solution[-1]), cycles
