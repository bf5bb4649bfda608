"""Newton-Krylov iteration for a starved film: pressure where it is filled, mass of oil where it is not."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.newton import (
    GAP_STEP,
    KRYLOV_LIMIT,
    LINEAR_TOLERANCE,
    LOAD_WEIGHT,
    PRESSURE_STEP,
    ROUNDING,
    SMALLEST_GAP,
    flexible_gmres,
)
from ehlectric.film.reynolds import poiseuille_weight
from ehlectric.film.spike import relax_spike, step_length
from ehlectric.film.starved.content import Runs, Supply, content, unreduced
from ehlectric.film.starved.jacobian import StarvedJacobian
from ehlectric.film.state import GridSolution, NewtonStep, Progress, Residual, State, Status

# Relative tolerance of the linear systems of a point contact while the filled nodes change.
_UNSETTLED = 1e-2

# Excess of the content over the full gap, relative, and pressure below ambient over p_h, that are rounding.
OVERFLOW, TENSION = 1e-10, 1e-13


@dataclass(frozen=True)
class Content:
    """Residual of a starved film at one state, with its content of oil.

    Attributes
    ----------
    residual : Residual
        Residual of all equations. Its ``reynolds`` are the rows of filled nodes after the elimination of the
        masses of cavitated nodes, zero at cavitated nodes.
    filled : ndarray of bool, shape (nx, ny)
        Nodes where oil fills the gap: inside the domain those with a full film, on the inlet edge those where
        the layer of oil is thicker than the gap.
    mass : ndarray, shape (nx, ny)
        Mass theta rho H of the oil.
    """

    residual: Residual
    filled: Mask
    mass: Array

    @property
    def norm(self) -> float:
        """Largest scaled residual of all equations, a pressure over p_h."""
        return self.residual.norm

    def fraction(self, thickness: Array) -> Array:
        """Part theta of the gap that oil fills, shape (nx, ny)."""
        full = self.residual.coefficients.density * thickness
        return np.where(self.filled, 1.0, np.clip(self.mass / full, 0.0, 1.0))


def starved_newton(
    fluid: Fluid,
    levels: list[Level],
    state: State,
    filled: Mask,
    *,
    supply: Supply,
    tolerance: float,
    max_iterations: int,
    progress: Progress | None = None,
) -> tuple[GridSolution, Content]:
    """Solve the film equations on the first of ``levels`` with a supply of oil at the inlet edge.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    levels : list of Level
        Grids from the one to solve on to the coarsest; the coarser ones serve the preconditioner.
    state : State
        Initial guess.
    filled : ndarray of bool, shape (nx, ny)
        Nodes that oil fills in the initial guess.
    supply : Supply
        Oil at the inlet edge.
    tolerance : float
        Residual at which to stop, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps.
    progress : callable, optional
        Function that is called with (nodes, Newton step, residual) before every step.

    Returns
    -------
    GridSolution
        Last iterate, with its status.
    Content
        Content of oil of the last iterate.
    """
    level = levels[0]
    tolerance = max(tolerance, ROUNDING * level.rate)
    steps: list[NewtonStep] = []
    now = assess_content(fluid, level, state, filled, supply)
    settled, seen = False, Seen()
    status: Status = "stalled"
    while not (settled and now.norm <= tolerance) and len(steps) < max_iterations:
        if progress is not None:
            progress(level.nodes, len(steps), now.norm)
        state, now = _without_spike(fluid, level, state, now, supply)
        jacobian = StarvedJacobian.of(fluid, levels, state, now.residual, now.filled, supply)
        close = LINEAR_TOLERANCE if settled or level.mesh.dy is None else _UNSETTLED
        dp, dh00, krylov = _direction(fluid, jacobian, state, now, close)
        full = State.of(level, state.pressure + dp, state.h00 + dh00)
        dh = full.thickness - state.thickness
        length = step_length(state.thickness, dp, dh, pressure_step=PRESSURE_STEP, gap_step=GAP_STEP)
        steps.append(NewtonStep(level.nodes, now.norm, krylov))
        if length < 1.0:
            full = State.of(level, state.pressure + length * dp, state.h00 + length * dh00)
        assessed = assess_content(fluid, level, full, now.filled, supply)
        if not (np.isfinite(assessed.norm) and np.min(full.thickness) > SMALLEST_GAP):
            status = "diverged"
            break
        moved = next_filled(fluid, level, full, assessed)
        settled = bool(np.array_equal(moved, assessed.filled))
        if not settled:
            supply = seen.calmed(supply, assessed.filled, moved)
            assessed = assess_content(fluid, level, full, moved, supply)
        state, now = full, assessed
    if settled and now.norm <= tolerance:
        status = "converged"
    return GridSolution(level, state, now.residual, tuple(steps), status), now


class Seen:
    """Memory of the masks of filled nodes of an iteration, to find out where it goes round in circles.

    The order of the wedge term depends on the nodes that are filled. It may happen that a node overflows as a
    cavitated node and is under tension as a filled one. With the upwind difference on both sides this is
    impossible, so that the nodes that change in a circle get it for the rest of the iteration.
    """

    def __init__(self) -> None:
        self._masks: set[bytes] = set()

    def calmed(self, supply: Supply, filled: Mask, moved: Mask) -> Supply:
        """Supply with an upwind difference at nodes that change, if this change leads to a known mask."""
        key = np.packbits(moved).tobytes()
        if key in self._masks:
            supply = replace(supply, upwind=supply.upwind | (filled != moved))
        self._masks.add(key)
        return supply


def assess_content(fluid: Fluid, level: Level, state: State, filled: Mask, supply: Supply) -> Content:
    """Residual of a starved film at a state, with given filled nodes.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    level : Level
        Grid.
    state : State
        Pressure, H00 and film thickness.
    filled : ndarray of bool, shape (nx, ny)
        Nodes where oil fills the gap; on the edges only those of the inlet edge count.
    supply : Supply
        Oil at the inlet edge.

    Returns
    -------
    Content
        Residual of every equation, their norm, and the mass of oil.
    """
    mesh, thickness = level.mesh, state.thickness
    at_faces = flow(fluid, state.pressure, thickness, mesh)
    gap, density = Gap(level, thickness), at_faces.coefficients.density
    filled = filled & mesh.inner
    filled[0] = supply.mass >= density[0] * thickness[0]
    full_film = filled & mesh.inner
    runs = Runs.of(filled)
    rows = unreduced(level, at_faces, thickness, filled, supply)
    reynolds = np.where(full_film, runs.reduced(rows), 0.0)
    load = level.load - gap.load(state.pressure)
    diagonal = poiseuille_weight(at_faces, mesh) + gap.elastic_weight(density)
    unnormed = Residual(at_faces, reynolds, diagonal, full_film, load, np.nan)
    excess = state.pressure - fluid.ambient_pressure - level.edge_excess
    largest = np.max(np.abs(np.where(full_film, unnormed.scaled, excess)))
    norm = float(max(largest, LOAD_WEIGHT * abs(load) / level.load))
    mass = supply.at_rupture(filled, content(runs, rows, density * thickness, mesh.dx))
    return Content(replace(unnormed, norm=norm), filled, mass)


def next_filled(fluid: Fluid, level: Level, state: State, now: Content) -> Mask:
    """Nodes that oil fills after a Newton step: no tension where it is filled, no overflow elsewhere.

    A filled node below ambient pressure becomes cavitated, and a cavitated node with more oil than the gap
    holds is filled. The nodes on the edges stay as ``assess_content`` found them.
    """
    full = now.residual.coefficients.density * state.thickness
    under = state.pressure - fluid.ambient_pressure < -TENSION
    over = now.mass > (1.0 + OVERFLOW) * full
    moved = np.where(now.filled, ~under, over | _backed_up(now, full))
    # On the inlet edge the layer and the gap say which nodes are filled, whatever the pressure is.
    return np.where(level.mesh.inner, moved, now.filled)


def _backed_up(now: Content, full: Array) -> Mask:
    """Cavitated nodes upstream of an overflow whose gap is smaller than the mass that overflows.

    The backflow from a filled node overflows the node before it only. The nodes before that one would be
    filled one by one. Those that the overflowing mass would fill are filled at once.
    """
    over = ~now.filled & (now.mass > full)
    backed = np.zeros_like(over)
    if not over.any():
        return backed
    level = np.zeros(over.shape[1])
    for i in range(len(over) - 1, 0, -1):
        level = np.where(over[i], now.mass[i], np.where(now.filled[i] | (full[i] > level), 0.0, level))
        backed[i] = level > 0.0
    return backed


def _without_spike(
    fluid: Fluid, level: Level, state: State, now: Content, supply: Supply
) -> tuple[State, Content]:
    """State of a line contact after a separate solution of the nodes of the pressure spike."""
    if level.mesh.dy is not None:
        return state, now
    posed = replace(level, wedge=supply.wedge(level.mesh, now.filled))
    pressure = relax_spike(
        fluid,
        Gap(posed, state.thickness),
        pressure=state.pressure,
        full_film=now.residual.full_film,
        scaled_residual=np.where(now.residual.full_film, now.residual.scaled, 0.0),
        pressure_step=PRESSURE_STEP,
        gap_step=GAP_STEP,
    )
    if pressure is None:
        return state, now
    relaxed = State.of(level, pressure, state.h00)
    if np.min(relaxed.thickness) <= SMALLEST_GAP:
        return state, now
    assessed = assess_content(fluid, level, relaxed, now.filled, supply)
    return (relaxed, assessed) if assessed.norm < now.norm else (state, now)


def _direction(
    fluid: Fluid, jacobian: StarvedJacobian, state: State, now: Content, tolerance: float
) -> tuple[Array, float, int]:
    """Changes dP (nx, ny) and dH00 of a Newton step, and the number of GMRES iterations."""
    finest, residual = jacobian.finest, now.residual
    resting = fluid.ambient_pressure + finest.level.edge_excess
    to_ambient = np.where(residual.full_film, 0.0, resting - state.pressure)
    change, load = jacobian(to_ambient, 0.0) if to_ambient.any() else (0.0, 0.0)
    right = np.append(-finest.scale * (residual.reynolds + change), residual.load - load)
    cycles = 0

    def precondition(image: Array) -> Array:
        nonlocal cycles
        cycles += 1
        return jacobian.precondition(image)

    solution = flexible_gmres(jacobian.image, precondition, right, tolerance=tolerance, limit=KRYLOV_LIMIT)
    return to_ambient + solution[:-1].reshape(state.pressure.shape), float(solution[-1]), cycles
