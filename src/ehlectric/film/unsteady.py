"""Transient film of a contact with moving roughness: discretisation along characteristics, time steps,
supply of oil.

Dimensionless, with T = t u/b for the mean speed u of the surfaces:

    d(rho H)/dT + d(rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0

The squeeze term and the wedge term are one derivative D(rho H)/DT along the lines X - T = const, on which the
Couette flow carries the oil. It is discretised by a backward difference over two steps (BDF2). The mass of
the last two instants is carried along the lines to the nodes. A time step is therefore a Reynolds equation
whose wedge term is the mass at the node times a rate, and whose right side follows from the carried mass.

A film that is carried through the Hertz zone keeps its shape. With time steps as long as the grid spacing the
lines begin at nodes, and nothing is interpolated. Without motion the film is then equal to the film of the
stationary scheme of second order, to the last digit. If the film is cavitated, its mass is the oil that
flows in, which does not fill the gap.

With a supply of oil, a layer of oil travels at the mean speed u along the lines X - T = const until it fills
the gap. If the gap is filled at the foot of a line, the derivative of the mass along the line is the
backward difference over two steps. The derivative of the mass at a meniscus is not bounded. If the gap is
not filled at the foot, it is therefore the difference over one step. Both are differences of one sum, which
the row of the next node takes as it is:

    W = m + D,   D = r/(1 + r) (m - m at the foot) where the foot is filled, 0 elsewhere,
    W(X, T + dT) - W(X - dT, T) = dT [d/dX(eps dP/dX) + d/dY(eps dP/dY)]

Here r is the step over the last step. At the first filled node behind a meniscus, D is the same part of dT
times the slope of the mass to the next node at the last instant. With equal steps, r = 1, the sum of W over
the nodes changes only by the flow across the ends of the domain. Between steps of different lengths the
weight of the differences in D changes, and the sum of W with it. A film that does not change fulfils the
equations of ``ehlectric.film.oil_content``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.errors import ConvergenceError
from ehlectric.film.energy_equation import Heat, Mixing
from ehlectric.film.face_flow import Undrifted
from ehlectric.film.heated_film import HeatedGrid
from ehlectric.film.levels import SECOND_DIFFERENCE, Level
from ehlectric.film.moving_heat import MOST_TURNS, MovingHeat, Warmth
from ehlectric.film.nested import levels_of
from ehlectric.film.newton import GridProblem, GridSolution, State, assess, newton
from ehlectric.film.problem import FilmProblem
from ehlectric.film.reynolds import ALONG, Stencil, residual
from ehlectric.film.touching_newton import touching_newton

# Distance in grid spacings within which the foot of a line counts as a node.
SAME_NODE = 1e-9


def step_levels(
    levels: list[Level], masses: tuple[Array, Array], steps: tuple[float, float], added_gap: Array
) -> list[Level]:
    """Grids with the Reynolds equation of one time step, in the order of ``levels``.

    ``masses`` are the oil masses rho H (nx, ny) on the finest grid at the last instant and at the instant
    before it. ``added_gap`` (nx, ny) is the gap that moving roughness adds there at the new instant.

    With r = step/last step, the BDF2 weights of the new, the last and the earlier mass are (1 + 2r)/(1 + r),
    -(1 + r) and r^2/(1 + r), all divided by the step. If the line of the earlier mass begins upstream of
    the inlet, the difference is over one step only.
    """
    mesh, (step, last) = levels[0].mesh, steps
    ratio = step / last
    here, old, older = np.array([(1 + 2 * ratio) / (1 + ratio), 1 + ratio, -(ratio**2) / (1 + ratio)]) / step
    first = carried(masses[0], step / mesh.dx)
    second = carried(masses[1], (step + last) / mesh.dx)
    outside = mesh.x - mesh.x[0] < (step + last) - SAME_NODE * mesh.dx
    source = np.where(outside[:, np.newaxis], first / step, old * first + older * second)
    rates = np.where(outside, 1.0 / step, here)[:, np.newaxis]
    return _of_time_step(levels, here, rates, source, added_gap)


def _of_time_step(
    levels: list[Level], rate: float, rates: Array, source: Array, added_gap: Array
) -> list[Level]:
    """Grids of a time step, with the rates of the mass, the right side and the gap of the finest one."""
    finest, *coarser = (in_time(level, rate) for level in levels)
    finest = replace(
        finest,
        wedge=_mass_term(finest.mesh.shape, rates),
        dry_gap=finest.dry_gap + added_gap,
        source=np.where(finest.mesh.inner, source, 0.0),
    )
    return [finest, *coarser]


def in_time(level: Level, rate: float) -> Level:
    """Grid for a transient film, whose wedge term is ``rate`` times the mass at the node itself."""
    wedge = _mass_term(level.mesh.shape, np.full((level.nodes, 1), rate))
    return replace(level, wedge=wedge, rate=rate, distribution=SECOND_DIFFERENCE)


def _mass_term(shape: tuple[int, int], rates: Array) -> Stencil:
    """Operator that multiplies the mass at each node by its rate, (nx, 1) or (nx, ny); end rows are zero."""
    coefficients = np.zeros((ALONG, *shape))
    coefficients[2, 1:-1] = rates[1:-1]
    return Stencil(coefficients)


def carried(values: Array, distance: float) -> Array:
    """Nodal values (nx, ny) after they have been carried downstream along x by a distance in spacings, >= 0.

    Examples
    --------
    >>> carried(np.arange(5.0)[:, np.newaxis] ** 2, 0.5)[:, 0]
    array([ 0.25,  0.25,  2.25,  6.25, 12.25])
    """
    whole, part = _split(distance)
    ghosts = whole + 2
    before = parabola_before(values, ghosts)
    beyond = 3.0 * values[-1:] - 3.0 * values[-2:-1] + values[-3:-2]
    padded = np.concatenate([before, values, beyond])
    start, n = ghosts - whole, values.shape[0]
    if abs(part) <= SAME_NODE:
        return padded[start : start + n].copy()
    weights = zip((-2, -1, 0, 1), lagrange_weights(part), strict=True)
    return np.asarray(np.sum([w * padded[start + k : start + k + n] for k, w in weights], axis=0))


def parabola_before(values: Array, number: int) -> Array:
    """Values at ``number`` nodes upstream of the domain, from the parabola of the first nodes of (nx, ny)."""
    steps = np.arange(-number, 0.0)[:, np.newaxis]
    v0, v1, v2 = values[0], values[1], values[2]
    before: Array = v0 + steps * (-1.5 * v0 + 2.0 * v1 - 0.5 * v2) + steps**2 * (0.5 * v0 - v1 + 0.5 * v2)
    return before


def lagrange_weights(part: float) -> tuple[float, float, float, float]:
    """Weights of the nodes -2, -1, 0 and 1 of a cubic at the position -``part``, between -1 and 0.

    Examples
    --------
    >>> lagrange_weights(0.5)
    (-0.0625, 0.5625, 0.5625, -0.0625)
    """
    return (
        (part + 1.0) * part * (part - 1.0) / 6.0,
        -(part + 1.0) * part * (part - 2.0) / 2.0,
        (part + 1.0) * (part - 1.0) * (part - 2.0) / 2.0,
        -part * (part - 1.0) * (part - 2.0) / 6.0,
    )


def mass_after(step: GridSolution) -> Array:
    """Oil mass rho H (nx, ny) after a time step; at cavitated nodes the mass of the oil that is left."""
    level, final = step.level, step.final
    mass = final.coefficients.density * step.state.thickness
    rate = level.wedge.coefficients[2]
    cavitated = ~final.full_film & level.mesh.inner
    flowing = mass[cavitated] - final.reynolds[cavitated] / rate[cavitated]
    mass[cavitated] = np.clip(flowing, 0.0, mass[cavitated])
    mass[-1] = np.minimum(mass[-1], mass[-2])
    return mass


def stationary_mass(stationary: GridSolution) -> Array:
    """Oil mass rho H (nx, ny) of a stationary film; of cavitated nodes behind X = 0 the oil that flows in."""
    level, final = stationary.level, stationary.final
    full = final.coefficients.density * stationary.state.thickness
    mass = full.copy()
    cavitated = ~final.full_film & level.mesh.inner & (level.mesh.x > 0.0)[:, np.newaxis]
    # Oil that the pressure gradient drives into a node, mainly into the first node behind the full film.
    flow = final.flow.undrifted(cavitated)
    driven = level.wedge(full) - residual(flow, level.wedge, stationary.state.thickness, level.mesh)
    driven += level.source
    for i in np.flatnonzero(cavitated.any(axis=1)):
        flowing = (4.0 * mass[i - 1] - mass[i - 2] + 2.0 * level.mesh.dx * driven[i]) / 3.0
        mass[i] = np.where(cavitated[i], np.clip(flowing, 0.0, full[i]), full[i])
    mass[-1] = np.minimum(full[-1], mass[-2])
    return mass


@dataclass(frozen=True)
class Oil:
    """Oil at one instant, from which the next one takes it."""

    mass: Array  # mass theta rho H of the oil, shape (nx, ny)
    # Nodes where oil fills the gap, on the inlet edge those where the layer of oil does, shape (nx, ny).
    filled: Mask

    def at_feet(self, distance: float, values: Array | None = None) -> Array:
        """Mass, or other ``values`` (nx, ny), carried downstream over a distance in grid spacings.

        Where all nodes around the foot of a line are filled, the values are interpolated by a cubic, and
        elsewhere linearly. Both are differences of flows through the faces, so that the sum of the values
        changes only by the flow across the ends. Upstream of the inlet edge a layer of oil is uniform.
        """
        values = self.mass if values is None else values
        whole, part = _split(distance)
        ghosts = whole + 2
        padded = self._padded(values, ghosts)
        start, n = ghosts - whole, values.shape[0]
        here = padded[start : start + n]
        if part <= SAME_NODE:
            return here.copy()
        filled = self._padded_mask(ghosts)
        (far, near, _, ahead) = lagrange_weights(part)
        # Flow through the face downstream of each node except the first and the last, in one step.
        flow = part * padded[1:-1]
        cubic = far * padded[:-2] + (far + near) * padded[1:-1] - ahead * padded[2:]
        smooth = filled[:-2] & filled[1:-1] & filled[2:]
        flow = np.where(smooth, cubic, flow)
        return np.asarray(here - flow[start - 1 : start - 1 + n] + flow[start - 2 : start - 2 + n])

    def filled_feet(self, distance: float) -> Mask:
        """Whether all nodes are filled from which ``at_feet`` takes the value of a node, shape (nx, ny)."""
        whole, part = _split(distance)
        ghosts = whole + 2
        padded, n = self._padded_mask(ghosts), self.filled.shape[0]
        start = ghosts - whole
        around = (0,) if part <= SAME_NODE else (-2, -1, 0, 1)
        return np.asarray(np.all([padded[start + k : start + k + n] for k in around], axis=0))

    @property
    def first(self) -> Mask:
        """First nodes of two and more that are filled behind a node that is not, shape (nx, ny)."""
        first = np.zeros_like(self.filled)
        first[1:-1] = self.filled[1:-1] & self.filled[2:] & ~self.filled[:-2]
        return first

    @property
    def rise(self) -> Array:
        """Mass at the next node minus the mass at the node, shape (nx, ny)."""
        return np.append(np.diff(self.mass, axis=0), np.zeros_like(self.mass[:1]), axis=0)

    def _padded(self, values: Array, ghosts: int) -> Array:
        before = np.where(self.filled[0], parabola_before(values, ghosts), values[0])
        return np.concatenate([before, values, values[-1:]])

    def _padded_mask(self, ghosts: int) -> Mask:
        before = np.repeat(self.filled[:1], ghosts, axis=0)
        return np.concatenate([before, self.filled, self.filled[-1:]])


def _split(distance: float) -> tuple[int, float]:
    """Whole number of grid spacings in a distance, and the rest, which is 0 up to rounding or above."""
    whole = int(np.floor(distance + SAME_NODE))
    return whole, distance - whole


def sums(now: Oil, before: Oil, last: float, ratio: float) -> Array:
    """Sum W of mass and difference at the last instant, from which the next step starts, shape (nx, ny).

    ``last`` is the last step in grid spacings, and ``ratio`` the next step over the last step.
    """
    difference = np.where(before.filled_feet(last), now.mass - before.at_feet(last), 0.0)
    difference = np.where(before.first, last * before.rise, difference)
    return now.mass + ratio**2 / (1.0 + ratio) * difference


def supplied_step_levels(
    levels: list[Level], instants: tuple[Oil, Oil], steps: tuple[float, float], added_gap: Array
) -> list[Level]:
    """Grids with the Reynolds equation of one time step of a film with a supply of oil, as ``step_levels``.

    On lines that are filled at the inlet edge the scheme equals the scheme of ``step_levels``.
    """
    mesh, (now, before), (step, last) = levels[0].mesh, instants, steps
    ratio, dx = step / last, mesh.dx
    second = ratio / (1.0 + ratio)
    feet, filled = now.at_feet(step / dx), now.filled_feet(step / dx)
    # A flooded line has no difference over two steps where its first foot lies upstream of the inlet.
    outside = (mesh.x - mesh.x[0] < (step + last) - SAME_NODE * dx)[:, np.newaxis] & now.filled[0]
    filled &= ~outside & ~now.first
    carried = now.at_feet(step / dx, sums(now, before, last / dx, ratio))
    carried = np.where(outside, feet, carried)
    rates = np.where(filled, 1.0 + second, 1.0) / step
    behind = np.where(now.first, -step / dx * now.rise, 0.0)
    source = (carried + second * np.where(filled, feet, behind)) / step
    return _of_time_step(levels, (1.0 + second) / step, rates, source, added_gap)


def oil_after(step: GridSolution, layer: Array) -> Oil:
    """Oil after a time step on the grids of ``supplied_step_levels``.

    ``layer`` (ny,) is the mass of the layer of oil that is supplied at the inlet edge. It lies on all edges
    of the domain that oil does not fill.
    """
    full = step.final.coefficients.density * step.state.thickness
    filled = step.final.full_film.copy()
    filled[0] = layer >= full[0]
    layered = step.level.mesh.edge.copy()
    layered[0], layered[-1] = ~filled[0], False
    mass = np.where(layered, np.minimum(full, layer), mass_after(step))
    mass[-1] = np.minimum(full[-1], mass[-2])
    return Oil(mass, filled)


# Tolerance of the residual in a time step, a pressure over p_h, far below the discretisation error of the
# step.
STEP_TOLERANCE = 1e-6

# Part of the load that the pressure may miss: a step with more has one Newton step more.
_LOAD_MISSED = 1e-9

# Largest numbers of Newton steps before a time step is halved: from the better of two initial guesses, the
# extrapolated and the last film, and from the other one.
_FEW_ITERATIONS, _MANY_ITERATIONS = 8, 30

# Largest number of times that a time step is halved.
_MOST_HALVINGS = 6

# Smallest gap of an extrapolated film that may be an initial guess, as a fraction of the last smallest gap.
_LEAST_START = 0.3

# Change of P in a time step above which the pressure of a node is not extrapolated: a spike passes the node.
_MOST_CHANGE = 0.1

# Largest distance that oil travels in a time step, in grid spacings.
MOST_COURANT = 8.0

# Gap that moving roughness adds: function of T, X (nx,) and Y (ny,) -> (nx, ny).
MovingGap: TypeAlias = Callable[[float, Array, Array], Array]


@dataclass(frozen=True)
class Instant:
    """Transient film at one instant of time, dimensionless."""

    time: float
    state: State  # pressure P, rigid displacement H00 and film thickness H
    # Oil mass rho H; where the film is cavitated, the mass of the oil that is left, shape (nx, ny).
    mass: Array
    density: Array  # density ratio rho/rho_0, shape (nx, ny)
    # Nodes with a full film; on the inlet edge, those that a given layer of oil fills, shape (nx, ny).
    full_film: Mask
    warmth: Warmth | None = None  # heat of the film and of its past; None of an isothermal film

    @property
    def oil(self) -> Oil:
        """Mass of oil, and the nodes that it fills."""
        return Oil(self.mass, self.full_film)

    @property
    def oil_fraction(self) -> Array:
        """Part of the gap that oil fills, 0 to 1, shape (nx, ny)."""
        part = self.mass / (self.density * self.state.thickness)
        return np.where(self.full_film, 1.0, np.clip(part, 0.0, 1.0))


@dataclass(frozen=True)
class Effort:
    """Computational work of a time step."""

    newton: int = 0
    krylov: int = 0  # number of GMRES iterations in all Newton steps
    halvings: int = 0  # number of times that a step was halved

    @classmethod
    def of(cls, solution: GridSolution) -> Effort:
        """Work of a solution on one grid."""
        return cls(len(solution.steps), sum(step.krylov_iterations for step in solution.steps))

    def __add__(self, other: Effort) -> Effort:
        return Effort(self.newton + other.newton, self.krylov + other.krylov, self.halvings + other.halvings)


@dataclass(frozen=True)
class History:
    """Last two instants of a transient film, from which the next follows."""

    now: Instant
    before: Instant
    effort: Effort = Effort()  # work of the last step


class UnsteadyFilm:
    """Solver for the transient film of a contact with moving roughness. ``moving_gap``, gap that moving
    roughness adds: function of T, X (nx,) and Y (ny,) -> (nx, ny); ``layer``, thickness H of the layer of oil
    at the inlet edge; None for a flooded inlet, shape (ny,); ``hot``, stationary film with the rheology or
    the heat of the moving one; None for an isothermal Newtonian film.
    """

    def __init__(
        self,
        problem: FilmProblem,
        moving_gap: MovingGap,
        layer: Array | None = None,
        hot: HeatedGrid | None = None,
    ) -> None:
        self.problem, self.layer = problem, layer
        self._moving_gap, self._hot = moving_gap, hot
        self._heat = None if hot is None else MovingHeat.of(hot)
        self._levels = levels_of(replace(problem, wedge_order=2))

    @property
    def level(self) -> Level:
        """Finest grid, with the operators of the stationary film."""
        return self._levels[0]

    def start(self, steady: GridSolution, step: float) -> History:
        """History with a stationary film, flooded or with a layer of oil, at T = 0 and at T = -``step``."""
        state, density = steady.state, steady.final.coefficients.density
        if self.layer is None or steady.content is None:
            mass, filled = stationary_mass(steady), steady.final.full_film
        else:
            filled, full = steady.content.filled, density * state.thickness
            mass = np.where(filled, full, np.clip(steady.content.mass, 0.0, full))
        now = Instant(0.0, state, mass, density, filled)
        if self._heat is not None and self._hot is not None:
            now = replace(now, warmth=self._heat.start(self._hot, now.oil_fraction))
        return History(now, replace(now, time=-step))

    def advance(self, history: History, step: float) -> History:
        """Advance the film by one time step, which is halved until the film equations converge.

        ``step``, length of the step in T, at most ``MOST_COURANT`` grid spacings. Returns last two instants
        after the step, with the work of the step. Raises ConvergenceError if the film equations do not
        converge after six halvings.
        """
        return self._advance(replace(history, effort=Effort()), step, _MOST_HALVINGS)

    def _advance(self, history: History, step: float, halvings: int) -> History:
        instant, effort = self._stepped(history, step)
        effort = history.effort + effort
        if instant is not None:
            return History(instant, history.now, effort)
        if not halvings:
            raise ConvergenceError(
                f"film at T = {history.now.time + step:.6g}, although the time step was halved "
                f"{_MOST_HALVINGS} times"
            )
        halved = replace(history, effort=effort + Effort(halvings=1))
        for _ in range(2):
            halved = self._advance(halved, 0.5 * step, halvings - 1)
        return halved

    def _stepped(self, history: History, step: float) -> tuple[Instant | None, Effort]:
        """Instant one step later, or None if the film or its temperature does not converge, with the work."""
        time, before = history.now.time + step, history.now.warmth
        levels = self._levels_at(history, step)
        heat = None if before is None else before.heat
        effort, mixing, solution = Effort(), Mixing(), None
        for _ in range(MOST_TURNS):
            last = history.now.state if solution is None else solution.state
            posed = self._posed(levels, last, heat, history.now.full_film)
            solution, work = self._solved(posed, history, step, solution)
            effort += work
            if solution is None:
                break
            instant = self._instant(time, solution)
            if before is None or heat is None or self._heat is None:
                return instant, effort
            new = self._heat.after(solution, heat, instant.oil_fraction, before, step)
            if new is None:
                break
            if self._heat.stands(solution, heat, new.heat):
                return replace(instant, warmth=new), effort
            heat = new.heat.with_vector(mixing(heat.vector, new.heat.vector))
        return None, effort

    def _posed(self, levels: list[Level], last: State, heat: Heat | None, filled: Mask) -> GridProblem:
        """Equations of a time step, with the flow law of the temperature of a film at the state ``last``.

        ``filled`` (nx, ny) marks the nodes that oil filled before the step: the flow behind the others has
        no drift.
        """
        fluid, tolerance = self.problem.fluid, max(self.problem.tolerance, STEP_TOLERANCE)
        if self._hot is not None:
            cavitated = ~filled if self.layer is not None else ~filled & self.level.mesh.inner
            law = self._hot.iteration.flow(last, heat)
            fluid = replace(fluid, flow=Undrifted(law, self.level.mesh, cavitated))
        return GridProblem(fluid, levels, tolerance, _MANY_ITERATIONS, None, self.problem.asperities)

    def _solved(
        self, posed: GridProblem, history: History, step: float, near: GridSolution | None
    ) -> tuple[GridSolution | None, Effort]:
        """Film after a time step, or None if Newton's method does not converge, with the work.

        ``near`` is the film of the same step at another temperature.
        """
        effort, boundary_film = Effort(), self.problem.boundary_film
        last = history.now.state if near is None else near.state
        line = self.problem.width is None
        starts = [(last, line)] if near is not None else self._starts(posed, history, step)
        limits = [_FEW_ITERATIONS, _MANY_ITERATIONS][-len(starts) :]
        for (start, spike), iterations in zip(starts, limits, strict=True):
            if last.touching.any():
                break
            limited = replace(posed, max_iterations=iterations)
            solution = newton(limited, start, min_iterations=1, eliminate_spike=spike, transient=True)
            effort += Effort.of(solution)
            if solution.status == "converged":
                if abs(solution.final.load) > _LOAD_MISSED * posed.level.load:
                    solution, effort = self._closer(solution, effort, newton, limited)
                if float(solution.state.thickness.min()) < boundary_film:
                    break
                return solution, effort
        if boundary_film > 0.0:
            # The surfaces touch or part in this step: it starts from the last film.
            start = State.of(posed.level, last.pressure, last.h00, last.contact_pressure)
            solution = touching_newton(posed, start, first_damping=0.0)
            effort += Effort.of(solution)
            if solution.status == "converged":
                # A residual that is small as a pressure may be much oil: one step more leaves none.
                return self._closer(solution, effort, partial(touching_newton, first_damping=0.0), posed)
        return None, effort

    @staticmethod
    def _closer(
        solution: GridSolution, effort: Effort, method: Callable[..., GridSolution], posed: GridProblem
    ) -> tuple[GridSolution, Effort]:
        """Film after at least one Newton step more by a method, or the film itself where it misses."""
        closer = method(posed, solution.state, min_iterations=1)
        effort += Effort.of(closer)
        return closer if closer.status == "converged" else solution, effort

    def _starts(self, posed: GridProblem, history: History, step: float) -> list[tuple[State, bool]]:
        """Initial guesses of a time step: the last film and, unless it is too thin, the extrapolated film.

        Each comes with a flag whether to solve the pressure spike separately. The guess with the smaller
        residual comes first. If short waves pass, this is often the last film.
        """
        now, before = history.now.state, history.before.state
        ratio = step / (history.now.time - history.before.time)
        ambient = self.problem.fluid.ambient_pressure
        change = ratio * (now.pressure - before.pressure)
        change[np.abs(change) > _MOST_CHANGE] = 0.0
        pressure = np.maximum(now.pressure + change, ambient)
        h00 = now.h00 + ratio * (now.h00 - before.h00)
        least = _LEAST_START * float(now.thickness.min())
        last = State.of(posed.level, now.pressure, now.h00).lifted(least)
        starts = [(last, self.problem.width is None)]
        extrapolated = State.of(posed.level, pressure, h00)
        if float(extrapolated.thickness.min()) >= least:
            starts.append((extrapolated, False))
        return sorted(starts, key=lambda start: assess(posed.fluid, posed.level, start[0]).norm)

    def _levels_at(self, history: History, step: float) -> list[Level]:
        """All grids with the Reynolds equation of the next time step."""
        now, before = history.now, history.before
        mesh, steps = self.level.mesh, (step, now.time - before.time)
        added = self._moving_gap(now.time + step, mesh.x, mesh.y)
        if self.layer is not None:
            return supplied_step_levels(self._levels, (now.oil, before.oil), steps, added)
        return step_levels(self._levels, (now.mass, before.mass), steps, added)

    def _instant(self, time: float, solution: GridSolution) -> Instant:
        """Instant after a time step that was solved."""
        density = solution.final.coefficients.density
        if self.layer is None:
            mass, full_film = mass_after(solution), solution.final.full_film
        else:
            oil = oil_after(solution, self.problem.fluid.ambient_density * self.layer)
            mass, full_film = oil.mass, oil.filled
        return Instant(time, solution.state, mass, density, full_film)
