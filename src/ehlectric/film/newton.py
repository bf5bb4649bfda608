"""Newton-Krylov iteration for the film on one grid: the state of the film, its residual, and the steps.

The unknowns are the pressure P at the nodes and the rigid displacement H00. Newton's method solves the
Reynolds equation at the nodes with a full film, P = P_amb at the cavitated nodes, and the balance of load.
``ehlectric.film.cavitation`` decides which nodes are cavitated.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.cavitation import full_film_nodes, with_refilled_nodes
from ehlectric.film.face_flow import Coefficients, Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.gmres import KRYLOV_LIMIT, flexible_gmres
from ehlectric.film.levels import Level
from ehlectric.film.multigrid import Linearised, cycled, linearise_levels, with_kept_preconditioner
from ehlectric.film.oil_content import Carried
from ehlectric.film.reynolds import poiseuille_weight, residual
from ehlectric.film.spike import relax_spike, step_length
from ehlectric.quantities.field_metadata import stored

# A film that did not converge counts as collapsed where it is thinner than this fraction of its central
# thickness.
COLLAPSED = 1e-2

Status: TypeAlias = Literal["converged", "stalled", "diverged", "film collapsed"]

# Function that reports progress: (nodes along x, Newton step, residual) -> None.
Progress: TypeAlias = Callable[[int, int, float], None]


@dataclass(frozen=True)
class NewtonStep:
    """Record of one Newton step."""

    # Number of nodes of the grid along x.
    nodes: int = field(metadata=stored("", "1", "not negative", "nodes of the grid of a Newton step"))
    # Residual before the step, a pressure over p_h.
    residual: float = field(metadata=stored("", "1", "not negative", "scaled residual before a Newton step"))
    krylov_iterations: int = field(
        metadata=stored("", "1", "not negative", "GMRES iterations of a Newton step")
    )  # number of GMRES iterations for the linear system of the step


@dataclass(frozen=True)
class State:
    """Iterate of the film on one grid, dimensionless."""

    # Pressure P; where the surfaces touch, the sum of the pressures of oil and asperities, shape (nx, ny).
    pressure: Array
    h00: float
    thickness: Array  # film thickness H, which follows from P and H00, shape (nx, ny)
    # Part of P that asperities carry; zero where the surfaces do not touch, shape (nx, ny).
    contact_pressure: Array | float = 0.0

    @classmethod
    def of(cls, level: Level, pressure: Array, h00: float, contact_pressure: Array | float = 0.0) -> State:
        """State with a pressure P (nx, ny) and a rigid displacement H00 on a grid."""
        return cls(pressure, h00, Gap.of(level, pressure, h00).thickness, contact_pressure)

    @property
    def touching(self) -> Mask:
        """Nodes where asperities carry a part of the pressure, shape (nx, ny)."""
        return np.broadcast_to(np.asarray(self.contact_pressure) > 0.0, self.pressure.shape)

    @property
    def oil_pressure(self) -> Array:
        """Pressure of the oil, shape (nx, ny)."""
        return self.pressure - self.contact_pressure

    @property
    def oil_share(self) -> Array:
        """Part of the pressure of each node that the oil has, shape (nx, ny)."""
        shared = np.clip(self.oil_pressure, 0.0, self.pressure)
        return np.divide(shared, self.pressure, out=np.ones_like(shared), where=self.touching)

    def lifted(self, smallest: float) -> State:
        """State with H00 raised, if necessary, so that H is at least ``smallest`` everywhere."""
        return self.shifted(max(0.0, smallest - float(self.thickness.min())))

    def shifted(self, shift: float) -> State:
        """State without contact pressure whose surfaces are further apart by ``shift``."""
        return State(self.pressure, self.h00 + shift, self.thickness + shift)


@dataclass(frozen=True)
class Residual:
    """Residual of the film equations at one state."""

    flow: Flow  # flow of the lubricant through the faces at the state
    reynolds: Array  # residual r of the Reynolds equation, shape (nx, ny)
    # Approximate derivative of r by the pressure of its own node, not negative, shape (nx, ny).
    diagonal: Array
    # Nodes with a full film; the others are cavitated or on an edge, at ambient pressure, shape (nx, ny).
    full_film: Mask
    load: float  # dimensionless load of the contact minus the load that the pressure carries
    norm: float  # largest scaled residual of all equations, a pressure over p_h

    @property
    def coefficients(self) -> Coefficients:
        """Density and mobility at the nodes."""
        return self.flow.coefficients

    @property
    def scaled(self) -> Array:
        """Residual of the Reynolds equation over its diagonal, a pressure over p_h, shape (nx, ny).

        It is zero where the diagonal is zero.
        """
        zeros = np.zeros_like(self.diagonal)
        return np.divide(self.reynolds, self.diagonal, out=zeros, where=self.diagonal > 0.0)


@dataclass(frozen=True, eq=False)
class GridSolution:
    """Last iterate of Newton's method on one grid."""

    level: Level
    state: State
    final: Residual
    steps: tuple[NewtonStep, ...]  # Newton steps that led to the last iterate
    status: Status  # "converged", "stalled" or "diverged"
    content: Carried | None = None  # oil in the gap; None where it is not carried through cavities

    @property
    def fraction(self) -> Array | None:
        """Part of the gap that oil fills, shape (nx, ny); None where it is not carried."""
        if self.content is None:
            return None
        return self.content.fraction(self.final.flow.carried(self.state.thickness, self.level.mesh.dx))

    @property
    def touches(self) -> bool:
        """Whether asperities carry a part of the load at some node."""
        return bool(np.any(self.state.touching))


@dataclass(frozen=True)
class Guess:
    """Initial guess of a film on one grid with mass-conserving cavitation."""

    state: State
    filled: Mask  # nodes that oil fills, shape (nx, ny)
    # Film of the guess, on the same or a coarser grid: a film with heat begins with its temperature.
    of: GridSolution | None = None


@dataclass(frozen=True)
class Asperities:
    """Boundary film and hardness of asperities that touch."""

    boundary_film: float = 0.0  # thickness H_s of the boundary film; 0 where surfaces cannot touch
    hardness: float = np.inf  # largest pressure P_y of nodes in contact, over p_h


@dataclass(frozen=True)
class EarlyEnd:
    """Rule by which the iteration of a film ends early that is only a start on a finer grid."""

    tolerance: float  # residual of a film from which a finer grid starts, a pressure over p_h
    # Whether a finer grid follows the last one of the films on successive grids; it has this residual.
    is_followed: Callable[[list[GridSolution]], bool]
    if_unknown: bool  # whether a finer grid follows a film whose error is unknown
    coarser: tuple[GridSolution, ...] = ()  # films on the coarser grids


@dataclass(frozen=True)
class GridProblem:
    """Film to be solved on one grid, with the stopping rule of its iteration."""

    fluid: Fluid  # lubricant over dimensionless pressure
    levels: list[Level]  # grids from the one to solve on to the coarsest of the preconditioner
    tolerance: float  # residual at which to stop, a pressure over p_h
    max_iterations: int  # largest number of Newton steps from each start
    # Function that is called with (nodes, Newton step, residual) before every step.
    progress: Progress | None = None
    asperities: Asperities = Asperities()  # boundary film and hardness where surfaces touch
    # Whether the film is only a start on finer grids: the oil where surfaces touch may change further.
    only_start: bool = False
    early_end: EarlyEnd | None = None  # rule by which the iteration ends early; None if it does not

    @property
    def level(self) -> Level:
        """Grid to solve on."""
        return self.levels[0]

    @property
    def reachable_tolerance(self) -> float:
        """Tolerance, at least the residual that is caused by rounding of H, whose differences are over dX."""
        return max(self.tolerance, ROUNDING * self.level.rate)

    def report(self, steps: Sequence[NewtonStep], residual: float) -> None:
        """Call ``progress`` with the residual after the steps so far."""
        if self.progress is not None:
            self.progress(self.level.nodes, len(steps), residual)


# Residual times dX that is caused by rounding of H: about 40 times the machine epsilon.
ROUNDING = 40.0 * np.finfo(float).eps

# Smallest H of an iterate; thinner iterates count as diverged. It is thousands of times thinner than the
# films at the corners of the Moes map.
SMALLEST_GAP = 1e-8

# Smallest relative tolerance of the linear solutions: Newton's method gains about three digits per step.
LINEAR_TOLERANCE = 1e-3

# Relative tolerance of the first linear solution and of the least accurate one, and the multiple of the
# squared reduction of the residual in the last step.
_FIRST_TOLERANCE, _LOOSEST, _FORCING = 0.03, 0.1, 0.5

# Residual below which a film that has grown in two successive steps is filled over many nodes at a time.
_NEAR = 1e-3

# Numbers of nodes of a stationary line contact between which an older preconditioner is kept. On fewer nodes
# a new one takes less time than an iteration; on more nodes an older one takes one and a half times as many.
_KEPT = (201, 10_000)

# Weight of the relative load imbalance in the residual: the load is balanced ten times as closely as the
# Reynolds equation.
LOAD_WEIGHT = 10.0


def newton(
    problem: GridProblem,
    state: State,
    *,
    min_iterations: int = 0,
    eliminate_spike: bool = False,
    transient: bool = False,
    jacobians: list[Linearised] | None = None,
) -> GridSolution:
    """Last iterate of Newton's method for the film equations on one grid, with its status.

    ``jacobians``, Jacobians on all grids of an earlier solution on this grid, whose preconditioner serves as
    long as the film is similar; the last ones of this solution replace them. The state is near such a film.
    """
    fluid, levels, level = problem.fluid, problem.levels, problem.level
    tolerance = problem.reachable_tolerance
    # In a stationary line contact the pressure spike dominates the norm of the residual. A linear system that
    # is not solved closely leaves errors in the inlet, which take more Newton steps on fine grids.
    loose = transient or level.mesh.dy is not None
    keeps = _keeps(levels, transient=transient)
    steps: list[NewtonStep] = []
    grown = 0  # successive steps in which the full film has grown
    now = assess(fluid, level, state)
    near = jacobians is not None
    jacobians = [] if jacobians is None else jacobians
    before, early_end = np.inf, problem.early_end
    while len(steps) < min_iterations or (now.norm > tolerance and len(steps) < problem.max_iterations):
        problem.report(steps, now.norm)
        if eliminate_spike:
            relaxed = without_spike(fluid, level, state, now)
            if relaxed is not None:
                state, now = relaxed, assess(fluid, level, relaxed)
        jacobians[:] = _linearised(fluid, levels, state, now, last=jacobians if keeps else [])
        close = LINEAR_TOLERANCE
        if loose:
            close = linear_tolerance(now.norm, before, tolerance, first=now.norm if near else np.inf)
        dp, dh00, krylov = _direction(fluid, jacobians, state, now, close)
        before = now.norm
        candidate = after_step(level, state, dp, dh00)
        steps.append(NewtonStep(level.nodes, now.norm, krylov))
        assessed = assess(fluid, level, candidate)
        if not (np.isfinite(assessed.norm) and np.min(candidate.thickness) > SMALLEST_GAP):
            return GridSolution(level, state, now, tuple(steps), "diverged")
        grown = grown + 1 if np.sum(assessed.full_film) > np.sum(now.full_film) else 0
        if grown > 1 and tolerance < assessed.norm < _NEAR:
            assessed = _refilled(assessed)
        state, now = candidate, assessed
        if early_end is not None and now.norm <= early_end.tolerance:
            film = GridSolution(level, state, now, tuple(steps), "converged")
            if early_end.is_followed([*early_end.coarser, film]):
                return film
            early_end = None
    status: Status = "converged" if now.norm <= tolerance else "stalled"
    return GridSolution(level, state, now, tuple(steps), status)


def _keeps(levels: list[Level], *, transient: bool) -> bool:
    """Whether the preconditioner of one Newton step may serve the next."""
    least, most = _KEPT
    if levels[0].mesh.dy is None and not transient:
        return least < levels[0].nodes < most
    return len(levels) > 1


def _refilled(now: Residual) -> Residual:
    """Residual with a full film also at the cavitated nodes that a surplus of oil fills."""
    return replace(now, full_film=with_refilled_nodes(now.full_film, now.reynolds))


def assess(fluid: Fluid, level: Level, state: State) -> Residual:
    """Residual of the film equations at a state, with the nodes that have a full film there.

    The norm takes the rows of the Reynolds equation over their diagonal, so that each is a pressure over p_h.

    ``fluid``, lubricant over dimensionless pressure.
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
    norm = float(np.max(np.abs(np.append(rows, LOAD_WEIGHT * load / level.load))))
    return replace(unnormed, norm=norm)


def after_step(level: Level, state: State, dp: Array, dh00: float) -> State:
    """State after the part of a Newton step dP (nx, ny) and dH00 that keeps P and H within their limits."""
    full = State.of(level, state.pressure + dp, state.h00 + dh00)
    length = step_length(state.thickness, dp, full.thickness - state.thickness)
    if length < 1.0:
        return State.of(level, state.pressure + length * dp, state.h00 + length * dh00)
    return full


def without_spike(fluid: Fluid, level: Level, state: State, now: Residual) -> State | None:
    """State after a separate solution of the nodes of the pressure spike.

    None if no residual stands out, or if the separate solution fails.
    """
    pressure = relax_spike(
        fluid,
        Gap(level, state.thickness),
        pressure=state.pressure,
        full_film=now.full_film,
        scaled_residual=np.where(now.full_film, now.scaled, 0.0),
    )
    relaxed = None if pressure is None else State.of(level, pressure, state.h00)
    return None if relaxed is None or np.min(relaxed.thickness) <= SMALLEST_GAP else relaxed


def linear_tolerance(norm: float, before: float, tolerance: float, *, first: float = np.inf) -> float:
    """Relative tolerance of the linear system of a Newton step.

    Choice 2 of S. C. Eisenstat and H. F. Walker, SIAM J. Sci. Comput. 17 (1996) 16, doi:10.1137/0917003: far
    from the solution the linear model is not worth a close solution. Close to it, a tenth of ``tolerance``
    is enough. Near a solution the residual after the ``first`` step is about the square of the residual
    before. A step that can reach the ``tolerance`` is solved closely enough to reach it.
    """
    predicted = min(_FIRST_TOLERANCE, first) if np.isinf(before) else _FORCING * min(1.0, norm / before) ** 2
    last = 0.5 * tolerance / norm
    least = last if 0.1 * LINEAR_TOLERANCE < last < LINEAR_TOLERANCE else LINEAR_TOLERANCE
    return min(_LOOSEST, max(least, predicted, 0.1 * tolerance / norm))


def _linearised(
    fluid: Fluid, levels: list[Level], state: State, now: Residual, *, last: list[Linearised]
) -> list[Linearised]:
    """Jacobians on all grids at a state; the coarser ones are taken from the last step if they serve."""
    kept = with_kept_preconditioner(last, now.flow, state.thickness, now.full_film)
    if kept is not None:
        return kept
    last.clear()  # its factors would need as much memory as the new ones
    return linearise_levels(
        levels, fluid, now.flow, pressure=state.pressure, thickness=state.thickness, full_film=now.full_film
    )


def _direction(
    fluid: Fluid, jacobians: list[Linearised], state: State, now: Residual, tolerance: float
) -> tuple[Array, float, int]:
    """Changes dP (nx, ny) and dH00 of a Newton step, and the number of GMRES iterations.

    The pressure of cavitated nodes changes to ambient. The change at the other nodes solves the linear
    system. The preconditioner is on the right, so that GMRES minimises the residual itself.
    """
    finest = jacobians[0]
    resting = fluid.ambient_pressure + finest.level.edge_excess
    to_ambient = np.where(now.full_film, 0.0, resting - state.pressure)
    change, load_change = finest(to_ambient, 0.0) if to_ambient.any() else (0.0, 0.0)
    right = np.append(-finest.scale * (now.reynolds + change), now.load - load_change)
    if len(jacobians) == 1 and finest.kept is None:
        solution = cycled(jacobians, right)
        return to_ambient + solution[:-1].reshape(state.pressure.shape), float(solution[-1]), 1
    solution, cycles = flexible_gmres(
        finest.image, lambda image: cycled(jacobians, image), right, tolerance=tolerance, limit=KRYLOV_LIMIT
    )
    return to_ambient + solution[:-1].reshape(state.pressure.shape), float(solution[-1]), cycles
