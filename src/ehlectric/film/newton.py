"""Newton-Krylov iteration for the film on one grid, preconditioned by all coarser ones.

The unknowns are the pressure and H00 together. Cavitation is a complementarity condition, P >= P_amb
and, where P = P_amb, a residual that is not negative; a primal-dual active set holds such nodes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np
from scipy.sparse.linalg import LinearOperator, gcrotmk

from ehlectric.arrays import Array, Mask
from ehlectric.film.levels import Level
from ehlectric.film.multigrid import cycled, elastic_weight, linearise_levels
from ehlectric.film.reynolds import Coefficients, Fluid, evaluate, poiseuille_weight, residual
from ehlectric.film.spike import relax_spike, step_length

# Limits of one Newton step: change of P, and what is left of the smallest gap. Larger steps leave the
# basin of convergence at the spike of light contacts, smaller ones only cost steps.
PRESSURE_STEP = 0.3
GAP_STEP = 0.3

# Rounding of H, times dX: some tens of the spacing of numbers near one.
ROUNDING = 40.0 * np.finfo(float).eps

# H below which no film is on the way: thousands of times thinner than at the corners of the Moes map.
SMALLEST_GAP = 1e-8

# Relative tolerance of the linear solves: Newton gains about three digits a step.
LINEAR_TOLERANCE = 1e-3
KRYLOV_LIMIT = 60

# The load is balanced this many times as closely as the pressures are solved.
LOAD_WEIGHT = 10.0
Status: TypeAlias = Literal["converged", "stalled", "diverged", "film collapsed"]
Progress: TypeAlias = Callable[[int, int, float], None]  # nodes, Newton step, residual


@dataclass(frozen=True)
class NewtonStep:
    """One Newton step: the grid, the residual it started from, and its GMRES iterations."""

    nodes: int
    residual: float
    krylov_iterations: int


@dataclass(frozen=True)
class State:
    """Iterate on one grid: P (nx, ny), H00 and H (nx, ny)."""

    pressure: Array
    h00: float
    thickness: Array

    @classmethod
    def of(cls, level: Level, pressure: Array, h00: float) -> State:
        """State of a pressure and an H00 on a grid."""
        gap = level.dry_gap + level.deflection(pressure)
        return cls(pressure, h00, h00 + gap)

    def lifted(self, smallest: float) -> State:
        """The state with H00 raised where some gap is below ``smallest``."""
        lift = max(0.0, smallest - float(self.thickness.min()))
        return State(self.pressure, self.h00 + lift, self.thickness + lift)


@dataclass(frozen=True)
class Residual:
    """What Newton's method brings to zero: Reynolds rows, held nodes and load."""

    coefficients: Coefficients
    reynolds: Array
    diagonal: Array
    free: Mask
    load: float
    norm: float

    @property
    def scaled(self) -> Array:
        """Reynolds rows over their local coefficient: pressures, zero in the end rows."""
        zeros = np.zeros_like(self.diagonal)
        return np.divide(self.reynolds, self.diagonal, out=zeros, where=self.diagonal > 0.0)


@dataclass(frozen=True)
class GridSolution:
    """Where Newton's method ended on one grid."""

    level: Level
    state: State
    final: Residual
    steps: tuple[NewtonStep, ...]
    status: Status


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
    """Newton's method on the first of ``levels``, the others serving the preconditioner.

    Parameters
    ----------
    fluid : Fluid
        The lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest.
    state : State
        Where to start.
    tolerance : float
        Residual at which to stop: the largest of the scaled rows, of the distance of held nodes from
        the ambient pressure, and of ten times the relative load imbalance. On very fine grids, what rounding
        allows.
    max_iterations : int
        Newton steps after which to stop.
    min_iterations : int
        Newton steps to take whatever the residual is. A row is measured by the pressure of its own node, and
        where a residual is smooth over many nodes the pressure that is missing is the square of their number
        times larger: a good guess is no solution yet.
    progress : callable, optional
        Called with (nodes, Newton step, residual) before every step.
    eliminate_spike : bool
        Solve the strongly nonlinear nodes by themselves before each step; for states that come from a
        coarser grid.

    Returns
    -------
    GridSolution
        Whatever was reached, with its status.
    """
    level = levels[0]
    # A row takes the difference of films over dX: what rounding leaves of it is no residual.
    tolerance = max(tolerance, ROUNDING * level.rate)
    steps: list[NewtonStep] = []
    now = _assess(fluid, level, state)
    while len(steps) < min_iterations or (now.norm > tolerance and len(steps) < max_iterations):
        if progress is not None:
            progress(level.nodes, len(steps), now.norm)
        if eliminate_spike:
            state, now = _without_spike(fluid, level, state, now)
        dp, dh00, krylov = _direction(fluid, levels, state, now)
        dh = level.deflection(dp) + dh00
        length = step_length(state.thickness, dp, dh, pressure_step=PRESSURE_STEP, gap_step=GAP_STEP)
        steps.append(NewtonStep(level.nodes, now.norm, krylov))
        candidate = State.of(level, state.pressure + length * dp, state.h00 + length * dh00)
        assessed = _assess(fluid, level, candidate)
        if not (np.isfinite(assessed.norm) and np.min(candidate.thickness) > SMALLEST_GAP):
            return GridSolution(level, state, now, tuple(steps), "diverged")
        state, now = candidate, assessed
    status: Status = "converged" if now.norm <= tolerance else "stalled"
    return GridSolution(level, state, now, tuple(steps), status)


def _assess(fluid: Fluid, level: Level, state: State) -> Residual:
    """Residual and active set of a state.

    A node is held at the ambient pressure where (P - P_amb) - c r < 0; a larger c switches nodes off
    inside the Hertz zone, where eps vanishes. Rows are scaled by their local coefficients, so that the
    residual is a pressure.
    """
    mesh = level.mesh
    coefficients = evaluate(fluid, state.pressure, state.thickness)
    r = residual(coefficients, level.wedge, state.pressure, state.thickness, mesh) - level.source
    poiseuille = poiseuille_weight(coefficients, mesh)
    excess = state.pressure - fluid.ambient_pressure
    c = 1.0 / np.maximum(20.0 * level.rate * state.thickness, poiseuille)
    free = (excess - c * r >= 0.0) & mesh.inner

    load = level.load - float(np.vdot(level.weights, state.pressure))
    unnormed = Residual(coefficients, r, poiseuille + elastic_weight(coefficients, level), free, load, np.nan)
    rows = np.where(free, unnormed.scaled, excess)
    norm = float(np.max(np.abs(np.append(rows, LOAD_WEIGHT * load / level.load))))
    return replace(unnormed, norm=norm)


def _without_spike(fluid: Fluid, level: Level, state: State, now: Residual) -> tuple[State, Residual]:
    """The state with the nodes of the pressure spike solved for, where they stand out."""
    pressure = relax_spike(
        fluid,
        level,
        pressure=state.pressure,
        thickness=state.thickness,
        free=now.free,
        scaled_residual=np.where(now.free, now.scaled, 0.0),
        pressure_step=PRESSURE_STEP,
        gap_step=GAP_STEP,
    )
    if pressure is None:
        return state, now
    relaxed = State.of(level, pressure, state.h00)
    if np.min(relaxed.thickness) <= SMALLEST_GAP:
        return state, now
    return relaxed, _assess(fluid, level, relaxed)


def _direction(fluid: Fluid, levels: list[Level], state: State, now: Residual) -> tuple[Array, float, int]:
    """(dP, dH00) of a Newton step, and the GMRES iterations it took.

    The nodes that are not free go to the ambient pressure; the rest follows from the linear system,
    preconditioned from the right so that GMRES minimises the residual itself.
    """
    free = now.free
    jacobians = linearise_levels(
        levels,
        fluid,
        coefficients=now.coefficients,
        pressure=state.pressure,
        thickness=state.thickness,
        free=free,
    )
    held = np.where(free, 0.0, fluid.ambient_pressure - state.pressure)
    change, load_change = jacobians[0](held, 0.0)
    finest = jacobians[0]
    right = np.append(-finest.scale * (now.reynolds + change), now.load - load_change)
    cycles = 0

    def precondition(image: Array) -> Array:
        nonlocal cycles
        cycles += 1
        return cycled(jacobians, image)

    # Flexible, as no two cycles are the same operator: those on coarser grids adapt to what they are given.
    solution, _ = gcrotmk(
        LinearOperator((right.size, right.size), matvec=finest.image, dtype=right.dtype),
        right,
        rtol=LINEAR_TOLERANCE,
        M=LinearOperator((right.size, right.size), matvec=precondition, dtype=right.dtype),
        m=KRYLOV_LIMIT,
        k=0,
        maxiter=1,
    )
    return held + solution[:-1].reshape(state.pressure.shape), float(solution[-1]), cycles
