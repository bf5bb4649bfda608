"""Starved films: content of oil in the gap, the Newton-Krylov iteration that finds the meniscus, and its
Jacobian.

Oil that fills only a part of the gap is carried along by the surfaces. Every node fulfils the complementarity
condition of Elrod and Adams in the whole domain:

    P >= P_amb,   theta <= 1,   (P - P_amb) (1 - theta) = 0,
    d(theta rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0

A node is filled (theta = 1) or cavitated (P = P_amb). Where the gap is cavitated, the mass m = theta rho H is
carried along entrainment by an upstream difference of first order, which conserves it whatever the grid. It
begins as the layer of oil at the inlet edge. The masses of a run of cavitated nodes follow from the rows of
the Reynolds equation one after the other. They are eliminated: the row of the first filled node behind a run
is the sum of the rows of the run and its own.

H. G. Elrod, J. Lubr. Technol. 103 (1981) 350, doi:10.1115/1.3251669; F. Chevalier, A. A. Lubrecht,
P. M. E. Cann, F. Colin and G. Dalmaz, J. Tribol. 120 (1998) 126, doi:10.1115/1.2834175 (both second-hand).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse.linalg import SuperLU, splu

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.mesh import Mesh
from ehlectric.film.multigrid import Linearised, cycled
from ehlectric.film.newton import (
    KRYLOV_LIMIT,
    LINEAR_TOLERANCE,
    LOAD_WEIGHT,
    SMALLEST_GAP,
    GridProblem,
    GridSolution,
    NewtonStep,
    Residual,
    State,
    Status,
    after_step,
    flexible_gmres,
    without_spike,
)
from ehlectric.film.reynolds import (
    ALONG,
    Stencil,
    linearise,
    poiseuille_weight,
    residual,
    stencil_matrix,
    without_columns,
)

# Ratio of the full gaps of two nodes above which the gap closes too steeply to be extrapolated.
_STEEP = 1.8


@dataclass(frozen=True)
class Supply:
    """Oil that is supplied at the inlet edge, and the order of the wedge term."""

    mass: Array  # mass rho H of the layer of oil at ambient pressure, dimensionless, shape (ny,)
    order: int  # order of the wedge term where the film is filled: 1, 2 or 3
    # Nodes whose mass enters no formula of a higher order, although they may be filled, shape (nx, ny).
    upwind: Mask | bool = False
    # Nodes to which the gap closes steeply; the mass behind them is the mean of two nodes. None until a gap
    # is met, shape (nx, ny).
    steep: Mask | None = None
    first_order: bool = False  # whether steep nodes have an upwind difference in place of this mean

    @property
    def low(self) -> Mask:
        """Nodes whose mass is extrapolated nowhere."""
        return np.asarray(self.upwind) | (False if self.steep is None else self.steep)

    def wedge(self, mesh: Mesh, filled: Mask) -> Stencil:
        """Operator of the wedge term with given filled nodes, a mask (nx, ny); see ``content_wedge``."""
        steep = None
        if self.steep is not None and not self.first_order:
            steep = filled & self.steep & ~np.asarray(self.upwind)
        return content_wedge(mesh, filled & ~self.low, self.order, steep)

    def bounded(self, full: Array) -> Supply:
        """Supply with no extrapolation where the full gap closes steeply, as at the edge of a spot.

        The mass at the face behind a node is 3/2 m of the node minus 1/2 m of the node before, little where
        the gap falls steeply, and negative where it falls to less than a third from node to node: no oil
        would enter the spot. The nodes are those of the first gap that is met, and stay while Newton's method
        moves the gap: chosen anew in each step they would depend on the way to the solution.
        """
        if self.steep is not None:
            return self
        steep = np.zeros(full.shape, dtype=bool)
        steep[1:] = full[:-1] > _STEEP * full[1:]
        return replace(self, steep=steep)

    def at_rupture(self, filled: Mask, mass: Array) -> Array:
        """Mass of oil (nx, ny) from the flow out of cavitated nodes, whose first one has a higher order.

        Behind a filled node the flow is 3/2 m of the node minus 1/2 m of the node before, as if oil filled
        the node. One whose content is below the full gap thus would be under tension as a filled one, and the
        iteration cannot go round in circles there.
        """
        if self.order == 1:
            return mass
        high = ~filled & ~self.low
        high[:2] = False
        high[1:] &= (filled & ~self.low)[:-1]
        before = np.concatenate([mass[:1], mass[:-1]])
        return np.where(high, (2.0 * mass + before) / 3.0, mass)

    def injected(self, level: Level) -> Supply:
        """Supply on the next coarser grid, for its wedge term only."""
        upwind, steep = self.upwind, self.steep
        if not isinstance(upwind, bool):
            upwind = level.inject(upwind.astype(float)) > 0.0
        if steep is not None:
            steep = level.inject(steep.astype(float)) > 0.0
        return replace(self, upwind=upwind, steep=steep)


@dataclass(frozen=True)
class Runs:
    """Runs of successive cavitated nodes along entrainment."""

    cavitated: Mask  # nodes of the runs, shape (nx, ny)
    # Index along x of the last filled node up to each node, or -1 where there is none, shape (nx, ny).
    before: Array

    @classmethod
    def of(cls, filled: Mask) -> Runs:
        """Runs of the nodes that are not filled, a mask (nx, ny)."""
        number = np.arange(len(filled))[:, np.newaxis]
        return cls(~filled, np.maximum.accumulate(np.where(filled, number, -1), axis=0))

    def summed(self, values: Array) -> Array:
        """Sum of values (nx, ny) over the run of each cavitated node up to the node, zero at filled nodes.

        Examples
        --------
        >>> filled = np.array([[False], [False], [True], [False], [False]])
        >>> Runs.of(filled).summed(np.array([[1.0], [2.0], [4.0], [8.0], [16.0]]))[:, 0].tolist()
        [1.0, 3.0, 0.0, 8.0, 24.0]
        """
        total = np.cumsum(np.where(self.cavitated, values, 0.0), axis=0)
        first = np.take_along_axis(total, np.maximum(self.before, 0), axis=0)
        return np.where(self.cavitated, total - np.where(self.before < 0, 0.0, first), 0.0)

    def reduced(self, rows: Array) -> Array:
        """Rows (nx, ny) with the rows of the run before each node added; only those of filled nodes count.

        Examples
        --------
        >>> filled = np.array([[False], [False], [True], [True]])
        >>> Runs.of(filled).reduced(np.array([[1.0], [2.0], [4.0], [8.0]]))[2:, 0].tolist()
        [7.0, 8.0]
        """
        reduced = rows.copy()
        reduced[1:] += self.summed(rows)[:-1]
        return reduced


def content_wedge(mesh: Mesh, filled: Mask, order: int, steep: Mask | None = None) -> Stencil:
    """Upstream difference d/dX of the mass whose order falls to one where the film is not filled.

    The mass at a face is that of the formula of highest order whose nodes are all filled. Behind the first
    filled node and behind a steep one it is the mean of the two nodes, and behind a cavitated node that of
    this node. The end rows are zero.

    ``filled``, nodes where oil fills the gap, shape (nx, ny); ``order``, order of the wedge term where the
    film is filled: 1, 2 or 3; ``steep``, further nodes, which are filled too, from which nothing is
    extrapolated, shape (nx, ny). Returns operator on the mass (nx, ny).

    Examples
    --------
    The mass at the two last faces is extrapolated from the two nodes before:

    >>> filled = np.array([[False], [True], [True], [True], [True]])
    >>> content_wedge(Mesh.over(5, 0.0, 4.0), filled, 2).coefficients[:, 3, 0].tolist()
    [0.5, -2.0, 1.5, 0.0]
    """
    far = np.zeros((mesh.x.size - 1, mesh.y.size))
    near, ahead = np.ones_like(far), np.zeros_like(far)
    if order > 1:
        # A face behind a meniscus has no second filled node before it, and takes the mean of its two nodes.
        first = filled[:-1] & filled[1:]
        first[1:] &= ~filled[:-2]
        near[first] = ahead[first] = 0.5
        second = filled[1:-1] & filled[:-2]
        far[1:][second], near[1:][second] = -0.5, 1.5
        if order == 3:
            third = second & filled[2:]
            far[1:][third], near[1:][third], ahead[1:][third] = -0.125, 0.75, 0.375
        if steep is not None:
            behind = steep[:-1] & (filled | steep)[1:]
            far[behind], near[behind], ahead[behind] = 0.0, 0.5, 0.5
    c = np.zeros((ALONG, *mesh.shape))
    c[0, 1:-1] = -far[:-1]
    c[1, 1:-1] = far[1:] - near[:-1]
    c[2, 1:-1] = near[1:] - ahead[:-1]
    c[3, 1:-1] = ahead[1:]
    return Stencil(c / mesh.dx)


def of_filled(flow: Flow, filled: Mask) -> Flow:
    """Flow whose density is zero where the film is not filled, so that its mass is that of filled nodes."""
    k = flow.coefficients
    density, density_p = (np.where(filled, values, 0.0) for values in (k.density, k.density_p))
    return replace(flow, coefficients=replace(k, density=density, density_p=density_p))


def unreduced(level: Level, flow: Flow, thickness: Array, filled: Mask, supply: Supply) -> Array:
    """Rows of the Reynolds equation without the masses of cavitated nodes, shape (nx, ny).

    The row of a cavitated node at the inlet edge is the layer of oil that enters there, over -dX.
    """
    wedge = supply.wedge(level.mesh, filled)
    rows = residual(of_filled(flow, filled), wedge, thickness, level.mesh) - level.source
    rows[0] = np.where(filled[0], 0.0, -supply.mass / level.mesh.dx)
    return rows


def content(runs: Runs, rows: Array, full: Array, dx: float) -> Array:
    """Mass of oil (nx, ny): rho H at filled nodes, theta rho H at cavitated nodes.

    ``rows`` (nx, ny) are those of the Reynolds equation without the masses of cavitated nodes, as
    ``unreduced`` returns them; ``full`` (nx, ny) is the mass rho H of the full gap.

    Examples
    --------
    A layer is carried to the first filled node, to which no pressure drives oil:

    >>> runs = Runs.of(np.array([[False], [False], [True]]))
    >>> content(runs, np.array([[-0.2], [0.0], [0.0]]), np.ones((3, 1)), 0.5)[:, 0].tolist()
    [0.1, 0.1, 1.0]
    """
    return np.where(runs.cavitated, -dx * runs.summed(rows), full)


@dataclass(frozen=True)
class StarvedJacobian:
    """Jacobian on the finest grid, with those of all grids that precondition it."""

    # Jacobians on all grids, in which a run of cavitated nodes adds only its last row to the row of the first
    # filled node behind it.
    levels: list[Linearised]
    # by_p and by_h: derivatives of all rows of the finest grid by P and by H, before the elimination.
    by_p: Stencil
    by_h: Stencil
    runs: Runs  # runs of cavitated nodes on the finest grid
    inlet: InletFlow | None  # flow at fixed gap, for a point contact; None for a line contact

    @classmethod
    def of(
        cls, fluid: Fluid, levels: list[Level], state: State, now: Residual, filled: Mask, supply: Supply
    ) -> StarvedJacobian:
        """Jacobian at a state, with the nodes that oil fills; the coarser grids take its injection."""
        pressure, thickness, at_faces, on_edge = state.pressure, state.thickness, now.flow, filled
        by_p, by_h = _stencils(levels[0], at_faces, thickness, filled, supply)
        jacobians = [_linearised(levels[0], (by_p, by_h), at_faces, thickness, filled)]
        for level in levels[1:]:
            pressure, thickness = level.inject(pressure), level.inject(thickness)
            on_edge = level.inside(on_edge)
            supply = supply.injected(level)
            at_faces = flow(fluid, pressure, thickness, level.mesh)
            stencils = _stencils(level, at_faces, thickness, on_edge, supply)
            jacobians.append(_linearised(level, stencils, at_faces, thickness, on_edge))
        runs, inlet = Runs.of(filled), None
        if levels[0].mesh.dy is not None:
            inlet = InletFlow.of(jacobians[0], by_p, runs)
        return cls(jacobians, by_p, by_h, runs, inlet)

    @property
    def finest(self) -> Linearised:
        """Jacobian on the finest grid that preconditions."""
        return self.levels[0]

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the reduced rows (nx, ny) and of the load for changes dP (nx, ny) and dH00."""
        dh, load = self.finest.gap.change(dp, dh00)
        rows = self.runs.reduced(self.by_p(dp) + self.by_h(dh))
        return np.where(self.finest.full_film, rows, 0.0), load

    def image(self, change: Array) -> Array:
        """Change of scaled residual and load, as one vector, for a change of P and H00, as one vector."""
        rows, load = self(change[:-1].reshape(self.finest.full_film.shape), float(change[-1]))
        return np.append(self.finest.scale * rows, load)

    def precondition(self, image: Array) -> Array:
        """Approximate change of P and H00 from a scaled residual and load.

        A V-cycle; in a point contact, what it leaves where the Poiseuille term dominates is solved at fixed
        gap, with the masses of cavitated nodes across which oil flows to the sides.
        """
        change = cycled(self.levels, image)
        if self.inlet is not None:
            left = (image - self.image(change))[:-1].reshape(self.finest.full_film.shape)
            change[:-1] += self.inlet(self.finest.unscale * left).ravel()
        return change


@dataclass(frozen=True)
class InletFlow:
    """Flow at fixed gap where the Poiseuille term dominates, with the masses of cavitated nodes."""

    opened: Mask  # filled nodes where the Poiseuille term dominates, shape (nx, ny)
    unknown: Mask  # these nodes, and the cavitated nodes from which mass reaches filled ones, shape (nx, ny)
    # Factorisation of their rows by the pressure of the filled and the mass of the cavitated nodes.
    factors: SuperLU

    @classmethod
    def of(cls, finest: Linearised, by_p: Stencil, runs: Runs) -> InletFlow | None:
        """Flow at a state, from the rows by P before the elimination; None where its matrix is singular."""
        level = finest.level
        opened = finest.full_film & (finest.poiseuille > level.rate)
        c = without_columns(by_p, ~opened).coefficients
        coupled = runs.summed(np.abs(c).sum(axis=0)) > 0.0
        # The mass of a cavitated node is carried to the node behind it.
        c[2][runs.cavitated] = level.rate
        c[1][1:][runs.cavitated[:-1]] = -level.rate
        unknown = opened | (coupled & level.mesh.inner)
        if not opened.any():
            return None
        try:
            return cls(opened, unknown, splu(stencil_matrix(Stencil(c), unknown)))
        except RuntimeError:
            return None

    def __call__(self, rows: Array) -> Array:
        """Change of P (nx, ny) for a change of the reduced rows (nx, ny), zero where others dominate."""
        change = np.zeros_like(rows)
        change[self.unknown] = self.factors.solve(np.where(self.opened, rows, 0.0)[self.unknown])
        return np.where(self.opened, change, 0.0)


def _stencils(
    level: Level, at_faces: Flow, thickness: Array, filled: Mask, supply: Supply
) -> tuple[Stencil, Stencil]:
    """Derivatives of all rows by P and by H at fixed masses of the cavitated nodes."""
    wedge = supply.wedge(level.mesh, filled)
    return linearise(of_filled(at_faces, filled), wedge, thickness, level.mesh)


def _linearised(
    level: Level, stencils: tuple[Stencil, Stencil], at_faces: Flow, thickness: Array, filled: Mask
) -> Linearised:
    """Jacobian on one grid whose rows behind cavitated nodes contain the row of the node before."""
    full_film = filled & level.mesh.inner
    behind = behind_cavities(filled) & full_film
    by_p, by_h = (with_row_before(part, behind).on_rows(full_film) for part in stencils)
    return Linearised.of_stencils(Gap(level, thickness), (by_p, by_h), at_faces, full_film)


def behind_cavities(filled: Mask) -> Mask:
    """Mask of the filled nodes (nx, ny) whose node before is not filled."""
    behind = filled.copy()
    behind[1:] &= ~filled[:-1]
    behind[0] = False
    return behind


def with_row_before(stencil: Stencil, rows: Mask) -> Stencil:
    """Stencil to whose ``rows`` (nx, ny) the row of the node before is added.

    A neighbour of the node before is one step further upstream; the one three steps upstream and those across
    entrainment are left out.
    """
    c = stencil.coefficients.copy()
    for row in range(3):
        c[row, 1:] += np.where(rows[1:], stencil.coefficients[row + 1, :-1], 0.0)
    return Stencil(c)


# Relative tolerance of the linear systems of a point contact while the filled nodes change.
_UNSETTLED = 1e-2

# Excess of the content over the full gap, relative, and pressure below ambient over p_h, that are rounding.
OVERFLOW, TENSION = 1e-10, 1e-13


@dataclass(frozen=True)
class Content:
    """Residual of a starved film at one state, with its content of oil."""

    residual: Residual
    # Nodes where oil fills the gap: inside the domain those with a full film, on the inlet edge those where
    # the layer of oil is thicker than the gap, shape (nx, ny).
    filled: Mask
    mass: Array  # mass theta rho H of the oil, shape (nx, ny)

    @property
    def norm(self) -> float:
        """Largest scaled residual of all equations, a pressure over p_h."""
        return self.residual.norm

    def fraction(self, thickness: Array) -> Array:
        """Part theta of the gap that oil fills, shape (nx, ny)."""
        full = self.residual.coefficients.density * thickness
        return np.where(self.filled, 1.0, np.clip(self.mass / full, 0.0, 1.0))


def starved_newton(
    problem: GridProblem, state: State, filled: Mask, supply: Supply
) -> tuple[GridSolution, Content]:
    """Last iterate on one grid with a supply of oil at the inlet edge, and its content of oil.

    ``filled`` (nx, ny) marks the nodes that oil fills in the initial guess.
    """
    fluid, level, tolerance = problem.fluid, problem.level, problem.reachable_tolerance
    steps: list[NewtonStep] = []
    now = assess_content(fluid, level, state, filled, supply)
    settled, memory = False, MaskMemory()
    status: Status = "stalled"
    while not (settled and now.norm <= tolerance) and len(steps) < problem.max_iterations:
        problem.report(steps, now.norm)
        state, now = _without_spike(fluid, level, state, now, supply)
        jacobian = StarvedJacobian.of(fluid, problem.levels, state, now.residual, now.filled, supply)
        close = LINEAR_TOLERANCE if settled or level.mesh.dy is None else _UNSETTLED
        dp, dh00, krylov = _direction(fluid, jacobian, state, now, close)
        candidate = after_step(level, state, dp, dh00)
        steps.append(NewtonStep(level.nodes, now.norm, krylov))
        assessed = assess_content(fluid, level, candidate, now.filled, supply)
        if not (np.isfinite(assessed.norm) and np.min(candidate.thickness) > SMALLEST_GAP):
            status = "diverged"
            break
        moved = next_filled(fluid, level, candidate, assessed)
        settled = bool(np.array_equal(moved, assessed.filled))
        if not settled:
            supply = memory.supply_after(supply, assessed.filled, moved)
            assessed = assess_content(fluid, level, candidate, moved, supply)
        state, now = candidate, assessed
    if settled and now.norm <= tolerance:
        status = "converged"
    return GridSolution(level, state, now.residual, tuple(steps), status), now


class MaskMemory:
    """Masks of filled nodes that an iteration has had, to detect cycles.

    The order of the wedge term depends on the nodes that are filled. It may happen that a node overflows as a
    cavitated node and is under tension as a filled one. With the upwind difference on both sides this is
    impossible, so that the nodes that change in a circle get it for the rest of the iteration. Circles of
    several nodes may take long to meet in a known mask: a node that changes more than ``most_changes`` times
    counts as one that goes in a circle.
    """

    def __init__(self, most_changes: float = np.inf) -> None:
        self._most_changes, self._masks = most_changes, set[bytes]()
        self._changes: Array | int = 0  # number of changes of each node, shape (nx, ny)

    def supply_after(self, supply: Supply, filled: Mask, moved: Mask) -> Supply:
        """Supply with an upwind difference at the nodes that go in circles, the last change included."""
        key, changed = np.packbits(moved).tobytes(), filled != moved
        self._changes = self._changes + changed
        circling = changed
        if key not in self._masks:
            circling = changed & (self._changes > self._most_changes)
        if circling.any():
            supply = replace(supply, upwind=supply.upwind | circling)
        self._masks.add(key)
        return supply


def assess_content(fluid: Fluid, level: Level, state: State, filled: Mask, supply: Supply) -> Content:
    """Residual of a starved film at a state, and the mass of oil, with given filled nodes (nx, ny).

    On the edges of the domain only the filled nodes of the inlet edge count.
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
    relaxed = without_spike(fluid, posed, state, now.residual)
    if relaxed is None:
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
    solution, cycles = flexible_gmres(
        jacobian.image, jacobian.precondition, right, tolerance=tolerance, limit=KRYLOV_LIMIT
    )
    return to_ambient + solution[:-1].reshape(state.pressure.shape), float(solution[-1]), cycles
