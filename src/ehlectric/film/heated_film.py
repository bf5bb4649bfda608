"""Films with heat and shear thinning on one grid after the other: pressure, film thickness and temperature
solved together, with the error of the temperature.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.across_film import Across
from ehlectric.film.energy_equation import (
    Earlier,
    FrozenTemperature,
    Heat,
    Mixing,
    Stream,
    Surface,
    finite_heat,
    moving_surface,
    stream_of,
)
from ehlectric.film.face_flow import node_mean
from ehlectric.film.hot_oil import Physics, Thermal
from ehlectric.film.levels import Level
from ehlectric.film.mesh import Mesh, at_centre, on_mesh
from ehlectric.film.multigrid import Linearised
from ehlectric.film.nested import (
    filled_on,
    grid_problem,
    interpolated_state,
    levels_of,
    open_state,
    state_with_spots,
)
from ehlectric.film.newton import (
    SMALLEST_GAP,
    GridProblem,
    GridSolution,
    Guess,
    NewtonStep,
    Progress,
    State,
    newton,
)
from ehlectric.film.oil_content import SCHEMES, USUAL, Carried, Scheme, Supply
from ehlectric.film.problem import FilmProblem
from ehlectric.film.shear_flow import Columns, ShearedFlow, filled_part
from ehlectric.film.shear_laws import UNBOUNDED
from ehlectric.film.starved_solver import (
    flooded_inlet,
    forms_again,
    isothermal,
    with_inlet,
)
from ehlectric.film.touching_newton import NEAR_DAMPING, touching_newton

# Degree of the polynomial across the film.
DEGREE = 12

# Largest change of temperature in one outer loop [K].
_MOST_CHANGE = 40.0

# Largest number of outer loops. In all loops except the last the film has this number of Newton steps at
# most, as far as this residual: its temperature is still to change.
MOST_LOOPS, _STEPS, _LOOSE = 60, 2, 1e-3

# The same number of loops of a flooded film that is only a guess for one with a layer of oil.
_GUESS_LOOPS = 25

# Tolerance of a film with mass-conserving cavitation in the quick iteration, divided by the last change of
# the temperature over the change at which it has converged.
_FOLLOWING = 1e-5

# Multiple of the Newton steps of a film with mass-conserving cavitation, whose cavities grow by few nodes a
# step, and least number of steps of one whose surfaces may touch: fewer would leave its spots unsettled.
CARRYING, _TOUCHING = 3, 40

# Successive loops in which a film with mass-conserving cavitation misses its residual, at which the iteration
# ends, and successive loops without a smaller change of the temperature. It goes on where the least change is
# near its limit.
_MISSED, _PATIENCE, _NEAR = 5, 20, 10.0

# Successive turns without a smaller change of the temperature after which the turns are not combined.
_STALE = 6

# Distance of the temperature, relative to its largest rise and absolute [K], and relative distance of the
# central film thickness, at which film and temperature have converged. The multiples hold for the finest
# grid, for the next coarser one, which gives the estimates of the errors, and for all others.
_RISE, _KELVIN, _FILM = 3e-3, 5e-3, 5e-5
_MULTIPLES = (1.0, 5.0, 25.0)

# Largest number of solutions of the energy equation with the film held, and of the turns that have them. From
# the cold, each brings the viscosity down by a factor of e at most; later turns begin hot.
_HELD, _HELD_TURNS = 60, 15

# Least part of a gap that counts as filled in the energy equation, which has no solution without oil.
_LEAST_FILLED = 1e-6

# Largest ratio of two successive changes in the estimate of the distance.
_SLOWEST = 0.9


@dataclass(frozen=True)
class Unsettled:
    """Node whose temperature changed most in the last turn of an iteration that did not converge."""

    change: float  # change of its temperature [K]
    place: tuple[float, float]  # its position X and Y

    @classmethod
    def of(cls, mesh: Mesh, weight: Array, heat: Heat, new: Heat) -> Unsettled:
        """Node of the largest change between two temperatures, with the weights (nx, ny) of the changes."""
        changes = np.max(np.abs(new.temperature - heat.temperature), axis=0)
        i, j = np.unravel_index(int(np.argmax(weight * changes)), mesh.shape)
        return cls(float(changes[i, j]), (float(mesh.x[i]), float(mesh.y[j])))


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedGrid(GridSolution):
    """Film with heat or shear on one grid; its status covers film and temperature together."""

    iteration: OuterIteration  # iteration that found it
    heat: Heat | None  # temperature and heat flow into the bodies; None for an isothermal film
    law: ShearedFlow  # flow law with the temperature of the film
    loops: int = 0  # number of outer loops
    unsettled: Unsettled | None = None  # where the temperature still changed; None where it has converged

    @property
    def middle(self) -> Array | None:
        """Temperature at mid-film (nx, ny) [K]; None without heat."""
        return None if self.heat is None else mid_film(self.heat.temperature)

    @property
    def largest_rise(self) -> float | None:
        """Largest rise of the mid-film temperature above the temperature of the oil that enters [K]."""
        thermal, middle = self.iteration.physics.thermal, self.middle
        if middle is None or thermal is None:
            return None
        return float(np.max(middle)) - thermal.inlet_temperature

    def moved(self, film: GridSolution, heat: Heat) -> HeatedGrid:
        """Another film and temperature on this grid, with the steps that this one took."""
        return replace(
            self,
            state=film.state,
            final=film.final,
            status=film.status,
            content=film.content,
            heat=heat,
        )

    @property
    def filled(self) -> Mask | None:
        """Nodes that oil fills, shape (nx, ny); None of a film without mass-conserving cavitation."""
        return None if self.content is None else self.content.filled


@dataclass(frozen=True, eq=False)
class OuterIteration:
    """Outer iteration on one grid."""

    problem: FilmProblem
    posed: GridProblem  # grid, coarser grids of its preconditioner, and stopping rule of the film
    finer: int  # number of finer grids that follow
    # Whether properties are evaluated again at the pressure of each film, and changes count as they are and
    # not as parts of a geometric sequence: slower, and it converges for hotter films.
    careful: bool = False
    # Whether a film starts with the spots of the coarser grid, and is solved as closely as its temperature
    # changes: faster, and it converges for fewer films.
    quick: bool = False
    # Whether the flow follows the temperature within the first turns, until the energy equation has converged
    # for a held film.
    held: bool = False
    degree: int = DEGREE  # degree of the polynomial across the film
    # Oil at the inlet edge of a film with mass-conserving cavitation; None of one whose cavities count
    # as full.
    supply: Supply | None = None
    most_loops: int = MOST_LOOPS  # largest number of outer loops
    # Temperature of a coarser grid, which the film keeps; None of a film whose temperature is solved with it.
    frozen: FrozenTemperature | None = None

    @property
    def level(self) -> Level:
        """Grid of the film."""
        return self.posed.level

    @property
    def physics(self) -> Physics:
        """Rheology and heat."""
        assert self.problem.physics is not None
        return self.problem.physics

    @property
    def stress_scale(self) -> float:
        """Scale of the shear stress p_h b/R [Pa]."""
        scales = self.problem.scales
        return scales.pressure * scales.thickness / scales.length

    def flow(self, state: State, heat: Heat | None) -> ShearedFlow:
        """Flow with the rheology, and with the temperature that a film has at the pressure of a state."""
        physics, thermal, profile = self.physics, self.physics.thermal, None
        if self.frozen is not None:
            profile = self.frozen
        elif thermal is not None and heat is not None:
            profile = FrozenTemperature(
                Across.of(self.degree),
                self.level.mesh,
                heat,
                self._clipped(state),
                thermal.oil,
                thermal.inlet_temperature,
                self.problem.scales.pressure,
            )
        return ShearedFlow(
            rheology=physics.rheology,
            slide_to_roll_ratio=physics.slide_to_roll_ratio,
            stress_scale=self.stress_scale,
            pressure_scale=self.problem.scales.pressure,
            profile=profile,
        )

    def _clipped(self, state: State) -> Array:
        """Pressure of a state, not below ambient."""
        return np.maximum(state.oil_pressure, self.problem.fluid.ambient_pressure)

    def film(
        self,
        state: State,
        heat: Heat | None,
        *,
        steps: int,
        tolerance: float,
        spike: bool,
        carried: Carried | None = None,
        jacobians: list[Linearised] | None = None,
    ) -> tuple[GridSolution, ShearedFlow, Heat | None]:
        """Film after at most ``steps`` Newton steps from a state, its flow, and the heat at its pressure.

        ``carried`` has the nodes that oil fills at first, of a film with mass-conserving cavitation, and
        ``jacobians`` the Jacobians of the last turn.
        """
        law = self.flow(state, heat)
        fluid = replace(self.problem.fluid, flow=law)
        posed = replace(self.posed, fluid=fluid, tolerance=tolerance, max_iterations=steps)
        if carried is not None:
            solver = isothermal(self._with_steps(posed), full_order=False, min_iterations=1)
            solution = solver(Guess(state, carried.filled), carried.supply)
        else:
            solution = self._apart_or_touching(posed, state, jacobians, spike=spike)
        if heat is not None and isinstance(law.profile, FrozenTemperature):
            heat = law.profile.at(self._clipped(solution.state))
        return solution, law, heat

    def _apart_or_touching(
        self, posed: GridProblem, state: State, jacobians: list[Linearised] | None, *, spike: bool
    ) -> GridSolution:
        """Film whose cavities count as full; surfaces touch where it is thinner than the boundary film."""
        boundary_film = posed.asperities.boundary_film
        if not state.touching.any():
            line = self.problem.width is None
            solution = newton(
                posed, state, min_iterations=1, eliminate_spike=spike and line, jacobians=jacobians
            )
            if float(np.min(solution.state.thickness)) >= boundary_film:
                return solution
        posed = self._with_steps(posed)
        return touching_newton(posed, state, first_damping=NEAR_DAMPING, min_iterations=1)

    @staticmethod
    def _with_steps(posed: GridProblem) -> GridProblem:
        """Equations with enough Newton steps for spots to settle, where surfaces may touch."""
        if not posed.asperities.boundary_film:
            return posed
        return replace(posed, max_iterations=max(posed.max_iterations, _TOUCHING))

    def _closer(self, solution: GridSolution, law: ShearedFlow, *, full_order: bool) -> GridSolution:
        """Film of the same temperature without upwind differences that it does not need, or unless
        ``full_order`` the film after one more Newton step, as a residual that is small as a pressure may be
        much oil. It is the film itself where it carries no oil, or where its iteration fails.
        """
        if solution.content is None or solution.status != "converged":
            return solution
        most = CARRYING * self.problem.max_iterations
        posed = replace(self.posed, fluid=replace(self.problem.fluid, flow=law), max_iterations=most)
        guess = Guess(solution.state, solution.content.filled)
        solver = isothermal(posed, full_order=full_order, min_iterations=0 if full_order else 1)
        again = solver(guess, solution.content.supply)
        return again if again.status == "converged" else solution

    def columns(self, solution: GridSolution, flow: ShearedFlow) -> Columns:
        """Stress, speed and heat across the film at the nodes."""
        state = solution.state
        return flow.columns(self.problem.fluid, state.oil_pressure, state.thickness, self.level.mesh)

    def filled(self, solution: GridSolution) -> Array:
        """Part of the gap that oil fills, shape (nx, ny)."""
        if solution.fraction is not None:
            return _near_edges(solution.fraction, self.level.mesh)
        mass = solution.final.coefficients.density * solution.state.thickness
        return filled_part(solution.final.full_film, mass)

    def pressure(self, state: State) -> Array:
        """Pressure of the oil [Pa], not below ambient, shape (nx, ny)."""
        scales = self.problem.scales
        return np.maximum(scales.pressure * state.oil_pressure, scales.ambient_pressure)

    def stream(
        self,
        solution: GridSolution,
        heat: Heat,
        flow: ShearedFlow,
        filled: Array | None = None,
        earlier: Earlier | None = None,
    ) -> Stream:
        """Flow of the energy equation at a film and a temperature.

        ``filled`` (nx, ny) is the part of the gap that oil fills, and ``earlier`` the oil before a time step;
        None of a stationary film.
        """
        scales, thermal, mesh = self.problem.scales, self.physics.thermal, self.level.mesh
        assert thermal is not None
        state, gap = solution.state, solution.state.thickness
        filled, pressure = self.filled(solution) if filled is None else filled, self.pressure(state)
        along, across = self._through(solution, filled)
        unit = scales.thickness * self.physics.mean_speed
        unit *= float(thermal.oil.density(np.zeros(1), np.full(1, thermal.inlet_temperature)).value[0])
        if earlier is not None:
            # What a column stores does not pass through the faces behind it.
            mass = filled * scales.thickness * gap * thermal.oil.density(pressure, heat.temperature).value
            along[1:] -= np.cumsum(self._stored(mass, earlier)[1:-1] / unit, axis=0)
        full = filled * solution.final.coefficients.density * gap
        speed = np.divide(node_mean(along), full, out=np.full(mesh.shape, np.nan), where=full > 0.0)
        stream = stream_of(
            thermal.oil,
            flow.columns_that_pass(self.problem.fluid, state.oil_pressure, gap, mesh, speed),
            heat.temperature,
            pressure=pressure,
            thickness=scales.thickness * gap,
            filled=filled,
            mesh=mesh,
            length=scales.length,
            pressure_scale=scales.pressure,
            speed=self.physics.mean_speed,
            stress=self.stress_scale,
            rubbing=self._rubbing(state),
            through=(unit * along, unit * across),
        )
        return stream if earlier is None else stream.in_time(earlier, pressure)

    def _stored(self, mass: Array, earlier: Earlier) -> Array:
        """Mass flow [kg/(m s)] that the columns store in a time step, shape (nx, ny).

        ``mass`` [kg/m^2] is the mass of the oil at the nodes across the film, shape (nz, nx, ny).
        """
        gained = np.tensordot(Across.of(len(mass) - 1).weights, mass - earlier.mass, axes=1)
        return np.asarray(self.level.mesh.dx * self.problem.scales.length / earlier.step * gained)

    def _through(self, solution: GridSolution, filled: Array) -> tuple[Array, Array]:
        """Mass flow through the faces along x and across it, dimensionless; NaN on the sides of the domain.

        ``filled`` (nx, ny) is the part of the gap that oil fills.
        The flow across is the flow of the Reynolds equation. The flow along x is the flow through the first
        face and what the mass balance of each column adds to it.
        """
        mesh, flow = self.level.mesh, solution.final.flow
        mass = filled * flow.coefficients.density * solution.state.thickness
        edge = mass[0] if self.problem.wedge_order == 1 else 0.5 * (mass[0] + mass[1])
        content = solution.content
        if content is not None:
            flow = flow.undrifted(~content.filled)
            edge = np.where(content.filled[0], edge, content.mass[0])
        along = np.tile(edge - mesh.dx * flow.along.flux[0], (mesh.x.size - 1, 1))
        across = np.zeros((mesh.x.size, mesh.y.size - 1))
        if flow.across is not None and mesh.dy is not None:
            lines = slice(0 if mesh.symmetric else 1, -1)
            along[1:, lines] += mesh.dx * np.cumsum(flow.across.divergence().T[1:-1], axis=0)
            across = -mesh.dy * flow.across.flux.T[:, -across.shape[1] :]
            along[:, ~mesh.inner[1]] = np.nan
        return along, across

    def _rubbing(self, state: State) -> tuple[Array, Array]:
        """Share of the oil in the pressure of each node, and the heat of asperities that rub [W/m^2], zero
        where none do, (nx, ny).
        """
        first, second = self.physics.speeds
        friction = (self.physics.boundary_friction or 0.0) * abs(second - first)
        pressure = self.problem.scales.pressure * np.asarray(state.contact_pressure)
        return state.oil_share, friction * pressure

    def surfaces(self, thermal: Thermal) -> tuple[Surface, Surface]:
        """Surfaces of both bodies on the grid."""
        mesh, length = self.level.mesh, self.problem.scales.length
        first, second = (
            moving_surface(body, speed, nodes=mesh.x.size, spacing=mesh.dx * length, half_width=length)
            for body, speed in zip(thermal.bodies, self.physics.speeds, strict=True)
        )
        return first, second

    def start(self, thermal: Thermal) -> Heat:
        """Temperature of a film that is nowhere heated: linear between the bodies."""
        shape = self.level.mesh.shape
        a, b = (body.temperature for body in thermal.bodies)
        zeta = Across.of(self.degree).zeta[:, np.newaxis, np.newaxis]
        temperature = np.broadcast_to(a + (b - a) * zeta, (zeta.size, *shape)).copy()
        return Heat(temperature, np.zeros((2, *shape)), np.zeros_like(temperature))

    def __call__(
        self, state: State, heat: Heat | None, *, spike: bool, filled: Mask | None = None
    ) -> HeatedGrid:
        """Film and temperature from an initial guess of both.

        ``filled`` (nx, ny) marks the nodes that oil fills in a guess with mass-conserving cavitation;
        None of one whose cavities count as full. A film without a supply that forms again behind a cavity has
        the oil carried through it.
        """
        if self.supply is not None:
            return self._turns(state, heat, filled, spike=spike)
        if filled is not None:
            carried = self._carrying(state, heat, filled, USUAL)
            # A film that is only a guess is not worth another iteration.
            if carried.status == "converged" or self.most_loops < MOST_LOOPS:
                return carried
        grid = self._turns(state, heat, None, spike=spike)
        full = grid.final.full_film
        if grid.status != "converged" or not forms_again(full):
            return grid
        for scheme in SCHEMES:
            again = self._carrying(grid.state, grid.heat, full, scheme)
            if again.status == "converged":
                return replace(again, steps=grid.steps + again.steps, loops=grid.loops + again.loops)
        # A film that creates oil is better than none; a warning reports it.
        return grid

    def _carrying(self, state: State, heat: Heat | None, filled: Mask, scheme: Scheme) -> HeatedGrid:
        """Flooded film with mass-conserving cavitation, from a guess and its filled nodes (nx, ny)."""
        supply = flooded_inlet(self.level, self.problem.wedge_order, scheme)
        return replace(self, supply=supply)._turns(state, heat, with_inlet(filled), spike=False)

    def _turns(self, state: State, heat: Heat | None, filled: Mask | None, *, spike: bool) -> HeatedGrid:
        """Film and temperature in turns, from an initial guess of both."""
        thermal = self.physics.thermal
        carried = None if self.supply is None or filled is None else Carried(self.supply, filled)
        if thermal is None or self.frozen is not None:
            return self._without_heat(state, carried, spike=spike)
        heat = self.start(thermal) if heat is None else heat
        weight = node_weight(self.level, state)
        grid = self._alternating(thermal, state, heat, carried, weight=weight, spike=spike)
        # A film that is only a guess on the next grid is not worth another iteration.
        guess_only = self.quick and self.most_loops < MOST_LOOPS and self.finer > 0
        return grid if guess_only else self._settled(grid, thermal, weight)

    def _without_heat(self, state: State, carried: Carried | None, *, spike: bool) -> HeatedGrid:
        """Film of an oil that thins under shear, at a temperature that the film does not change."""
        most, tolerance = self.problem.max_iterations, self.posed.tolerance
        steps = most if carried is None else CARRYING * most
        solution, law, _ = self.film(
            state, None, steps=steps, tolerance=tolerance, spike=spike, carried=carried
        )
        solution = self._closer(solution, law, full_order=True)
        frozen, mesh = self.frozen, self.level.mesh
        heat = None if frozen is None else frozen.heat_on(mesh, self._clipped(solution.state))
        return HeatedGrid(**vars(solution), iteration=self, heat=heat, law=law)

    def _alternating(
        self,
        thermal: Thermal,
        state: State,
        heat: Heat,
        carried: Carried | None,
        *,
        weight: Array,
        spike: bool,
    ) -> HeatedGrid:
        """Compute film and temperature alternately until both have converged, or their iteration ends.

        ``weight`` (nx, ny) multiplies the changes of the temperature.
        """
        most, times = self.problem.max_iterations, 1 if carried is None else CARRYING
        # The temperature in cavities and next to spots follows small changes of the film.
        exact = carried is not None and not self.quick
        loose = self.posed.tolerance if exact else max(self.posed.tolerance, _LOOSE)
        surfaces, mixing, taken = self.surfaces(thermal), _mixing(weight, heat), list[NewtonStep]()
        rises, films, central, ends, missed = list[float](), list[float](), np.inf, False, 0
        unsettled: Unsettled | None = None
        jacobians: list[Linearised] = []
        for loop in range(self.most_loops):
            steps, tolerance = (most, self.posed.tolerance) if ends else (_STEPS, loose)
            if self.quick and carried is not None and rises:
                tolerance = max(self.posed.tolerance, min(tolerance, _FOLLOWING * rises[-1]))
            solution, law, now = self.film(
                state,
                heat,
                steps=times * steps,
                tolerance=tolerance,
                spike=spike and loop == 0,
                carried=carried,
                jacobians=jacobians,
            )
            assert now is not None
            heat, carried = now, solution.content
            taken += solution.steps
            before, central = central, at_centre(self.level.mesh, solution.state.thickness)
            films.append(abs(central - before) / (_FILM * max(central, SMALLEST_GAP)))
            change = max(films[-1], self._distance(films))
            stands = ends and solution.status == "converged" and change < self._allowed
            missed = missed + 1 if carried is not None and solution.status == "stalled" else 0
            if stands or solution.status == "diverged" or missed == _MISSED:
                break
            if self.held and loop < _HELD_TURNS:
                new = self._temperature_of_held(solution, heat, surfaces, weight, self._allowed)
            else:
                law = self.flow(solution.state, heat) if self.careful else law
                new = self.heated(solution, heat, law, surfaces)
            if new is None:
                solution = replace(solution, status="diverged")
                break
            rises.append(change_between(weight, heat, new, thermal))
            unsettled = Unsettled.of(self.level.mesh, weight, heat, new)
            if goes_round(rises, self._allowed):
                solution = replace(solution, status="stalled")
                break
            # A temperature that is close enough ends with its film, unless that is far from the last film.
            ends = self._distance(rises) < self._allowed
            state = solution.state
            if is_stale(rises):
                # The combination of the last turns circles around a place without a solution.
                mixing.forget()
            heat = _mixed(mixing, heat, new)
        else:
            solution = replace(solution, status="stalled")
        grid = replace(solution, steps=tuple(taken))
        # A film that misses its own residual has no temperature that could settle.
        left = unsettled if grid.status == "stalled" and grid.final.norm <= loose else None
        return HeatedGrid(**vars(grid), iteration=self, heat=heat, law=law, loops=loop + 1, unsettled=left)

    def _settled(self, grid: HeatedGrid, thermal: Thermal, weight: Array) -> HeatedGrid:
        """Film without upwind differences that it does not need, if its temperature stands there."""
        assert grid.heat is not None
        heat, surfaces = grid.heat, self.surfaces(thermal)
        for full_order in (True, False):
            film = self._closer(grid, grid.law, full_order=full_order)
            if film is grid:
                return grid
            # The film has moved since its temperature was found.
            new = self.heated(film, heat, grid.law, surfaces)
            if new is not None and change_between(weight, heat, new, thermal) < self._allowed:
                return grid.moved(film, new)
        return grid.moved(film, heat)

    @property
    def _allowed(self) -> float:
        """Distance at which film and temperature stand on this grid, over that on the finest grid."""
        return _MULTIPLES[min(self.finer, len(_MULTIPLES) - 1)]

    def _temperature_of_held(
        self,
        solution: GridSolution,
        heat: Heat,
        surfaces: tuple[Surface, Surface],
        weight: Array,
        allowed: float,
    ) -> Heat | None:
        """Temperature of a held film together with its flow; None if it has no finite solution.

        The heat of shear of a cold Newtonian film is many orders of magnitude too large. The film, and above
        all its spike, would follow each intermediate temperature. If the pressure gradient and not the
        slip drives the flow, the temperature of a film far from its solution may run away. The first
        temperature counts then.
        """
        assert self.physics.thermal is not None
        first = new = self.heated(solution, heat, self.flow(solution.state, heat), surfaces)
        for _ in range(_HELD):
            if new is None or change_between(weight, heat, new, self.physics.thermal) < allowed:
                return new
            if np.max(np.abs(new.temperature - heat.temperature)) > _MOST_CHANGE:
                break
            heat = new
            new = self.heated(solution, heat, self.flow(solution.state, heat), surfaces)
        return first

    def heated(
        self, solution: GridSolution, heat: Heat, flow: ShearedFlow, surfaces: tuple[Surface, Surface]
    ) -> Heat | None:
        """Temperature by the energy equation of a film; None if it has no finite solution."""
        thermal = self.physics.thermal
        assert thermal is not None
        stream = self.stream(solution, heat, flow)
        return finite_heat(stream, surfaces, heat, thermal.inlet_temperature)

    def _distance(self, changes: list[float]) -> float:
        """Distance from the limit after changes that fall in a geometric sequence, or the last change."""
        if self.careful or len(changes) < 2 or not np.isfinite(changes[-2]):
            return changes[-1]
        ratio = min(_SLOWEST, changes[-1] / max(changes[-2], 1e-300))
        return changes[-1] * ratio / (1.0 - ratio)


def is_stale(changes: list[float]) -> bool:
    """Whether the last turns of an iteration have not changed it by less than a turn before them."""
    return _least_without_fall(changes, _STALE) is not None


def goes_round(changes: list[float], allowed: float) -> bool:
    """Whether an iteration changes by far more than what is allowed, and has long not changed by less."""
    least = _least_without_fall(changes, _PATIENCE)
    return least is not None and least >= _NEAR * allowed


def _least_without_fall(changes: list[float], turns: int) -> float | None:
    """Least change of the last turns, if no change of them is less than all before them; None otherwise."""
    before, last = changes[:-turns], changes[-turns:]
    return min(last) if before and min(last) >= min(before) else None


def change_between(weight: Array, heat: Heat, new: Heat, thermal: Thermal) -> float:
    """Change of the temperature divided by the change at which it has converged."""
    rise = float(np.max(new.temperature)) - thermal.inlet_temperature
    change = np.max(weight * np.abs(new.temperature - heat.temperature))
    return float(change) / close_enough(rise)


def close_enough(rise: float) -> float:
    """Change of the temperature [K] that is small enough on the finest grid, for a largest rise [K]."""
    return _KELVIN + _RISE * abs(rise)


def node_weight(level: Level, state: State) -> Array:
    """Weight of a change of temperature, shape (nx, ny): its effect on the pressure goes with 1/h^2.

    The reverse flow far upstream would otherwise decide when the temperature stands.
    """
    return np.asarray(np.minimum(1.0, (at_centre(level.mesh, state.thickness) / state.thickness) ** 2))


def _mixing(weight: Array, heat: Heat) -> Mixing:
    """Acceleration of the outer iteration, in the weighted norm of the temperature."""
    of_film = np.broadcast_to(weight, heat.temperature.shape).ravel()
    return Mixing(weights=np.concatenate([of_film, np.zeros(heat.flux.size)]))


def _mixed(mixing: Mixing, heat: Heat, new: Heat) -> Heat:
    """Next temperature, at most 40 K from the last one."""
    mixed = new.with_vector(mixing(heat.vector, new.vector))
    step = float(np.max(np.abs(mixed.temperature - heat.temperature)))
    if step > _MOST_CHANGE:
        mixing.forget()
        mixed = mixed.with_vector(heat.vector + _MOST_CHANGE / step * (mixed.vector - heat.vector))
    return mixed


def _near_edges(fraction: Array, mesh: Mesh) -> Array:
    """Part of the gap that oil fills, nowhere zero, shape (nx, ny); it is not known on the sides."""
    part = np.maximum(fraction, _LEAST_FILLED)
    if mesh.dy is not None:
        part[:, -1] = part[:, -2]
        if not mesh.symmetric:
            part[:, 0] = part[:, 1]
    return part


# Variation of the solution for comparison: iteration and temperature -> iteration and initial temperature.
Variation: TypeAlias = Callable[[OuterIteration, Heat], tuple[OuterIteration, Heat]]

# Growth of the temperature at the pressure spike on a grid that is four times finer, divided by the growth
# from the next coarser grid: as much again. If the stress grows with the spike, the second doubling adds
# twice as much.
_GROWTH, _GROWTH_UNBOUNDED = 1.0, 3.0

# Smallest error that is stated [K].
_LEAST = 0.1

# Degree of the polynomial across the film with which the solution is compared, and multiple of the change of
# the temperature of a held film: where the film follows it, the change is up to 1.4 times as large.
_FINE_DEGREE, _RESPONSE = 20, 2.0


def mid_film(temperature: Array) -> Array:
    """Temperature at mid-film (nx, ny) [K], from that across the film (nz, nx, ny)."""
    weights = Across.of(len(temperature) - 1).at(np.array([0.5]))[0]
    return np.asarray(np.tensordot(weights, temperature, axes=1))


def rise_error(grids: list[HeatedGrid]) -> float | None:
    """Estimated error of the largest rise of the mid-film temperature.

    Returns sum of the errors by the grid along the film, by the polynomial across it and by properties of the
    oil beyond the range in which its laws have values [K]; None without a converged film on the next coarser
    grid, or where a solution for comparison did not converge.
    """
    along = _along(grids)
    if along is None:
        return None
    parts = [_change_of_turn(grids[-2], _finer_across)]
    if _beyond(grids[-1]):
        parts.append(_change(grids[-2], _curved_oil))
    known = [part for part in parts if part is not None]
    return along + sum(known) if len(known) == len(parts) else None


def _along(grids: list[HeatedGrid]) -> float | None:
    """Error by the grid along the film [K].

    At first order the error is the difference to the next coarser grid, and half of the difference between
    the two grids before. The larger one counts, as a difference of two maxima passes through zero. A peak
    that the grid barely shows may still become the largest one.
    """
    known = [grid for grid in grids[-3:] if grid.status == "converged" and grid.heat is not None]
    if len(known) < 2 or known[-2:] != grids[-2:]:
        return None
    rises = [rise for each in reversed(known) if (rise := each.largest_rise) is not None]
    changes = (0.5**k * abs(fine - coarse) for k, (fine, coarse) in enumerate(pairwise(rises)))
    return max(*changes, _LEAST, close_enough(rises[0]), _growing_peak(*known[-2:]))


def _growing_peak(coarse: HeatedGrid, fine: HeatedGrid) -> float:
    """Largest rise less the largest rise on the fine grid [K], if the growth from the coarse grid goes on."""
    before, now = coarse.middle, fine.middle
    assert before is not None and now is not None
    growth = np.maximum(now - on_mesh(before, coarse.level.mesh, fine.level.mesh), 0.0)
    times = _GROWTH_UNBOUNDED if fine.iteration.physics.rheology.name in UNBOUNDED else _GROWTH
    return float(np.max(now + times * growth) - np.max(now))


def _beyond(grid: HeatedGrid) -> bool:
    """Whether the film is hotter than the range in which the laws of the oil have values."""
    thermal = grid.iteration.physics.thermal
    assert thermal is not None and grid.heat is not None
    return bool(np.max(grid.heat.temperature) > thermal.oil.highest)


def _finer_across(iteration: OuterIteration, heat: Heat) -> tuple[OuterIteration, Heat]:
    """Iteration and initial temperature of the film with a polynomial of higher degree across it."""
    rows = Across.of(iteration.degree).at(Across.of(_FINE_DEGREE).zeta)
    temperature, by_pressure = (np.tensordot(rows, v, axes=1) for v in (heat.temperature, heat.by_pressure))
    finer = replace(heat, temperature=temperature, by_pressure=by_pressure)
    return replace(iteration, degree=_FINE_DEGREE), finer


def _curved_oil(iteration: OuterIteration, heat: Heat) -> tuple[OuterIteration, Heat]:
    """Iteration for oil properties that go on beyond their range as parabolas, and not as straight lines."""
    thermal = iteration.physics.thermal
    assert thermal is not None
    physics = replace(iteration.physics, thermal=replace(thermal, oil=replace(thermal.oil, curved=True)))
    return replace(iteration, problem=replace(iteration.problem, physics=physics)), heat


def _change_of_turn(grid: HeatedGrid, other: Variation) -> float | None:
    """Change of the largest rise [K] by a variation of the energy equation of a film, times ``_RESPONSE``.

    Film and temperature of both solutions are the ones of the grid, so that what its iteration has left is in
    neither. None where there is no finite temperature.
    """
    thermal, rises = grid.iteration.physics.thermal, list[float]()
    if thermal is None or grid.heat is None:
        return None
    for iteration, heat in ((grid.iteration, grid.heat), other(grid.iteration, grid.heat)):
        new = iteration.heated(grid, heat, iteration.flow(grid.state, heat), iteration.surfaces(thermal))
        if new is None:
            return None
        rises.append(float(np.max(mid_film(new.temperature))))
    return _RESPONSE * abs(rises[1] - rises[0])


def _change(grid: HeatedGrid, other: Variation) -> float | None:
    """Change of the largest rise [K] by a variation of the solution; None if that does not converge."""
    now = grid.largest_rise
    if now is None or grid.heat is None:
        return None
    iteration, heat = other(grid.iteration, grid.heat)
    varied = iteration(grid.state, heat, spike=False, filled=grid.filled)
    rise = varied.largest_rise
    return abs(rise - now) if rise is not None and varied.status == "converged" else None


# Smallest number of nodes along x of the first grid with heat, in a line and in a point contact.
_FIRST, _FIRST_POINT = 151, 33

# Smallest number of nodes of the first grid of the careful iteration of a line contact.
_FIRST_CAREFUL = 101

# Parts of the slip of a film that does not converge at once.
_SLIPS = (0.0, 0.03, 0.1, 0.3, 1.0)


def heated_on_grids(
    finest: FilmProblem,
    starts: Sequence[GridSolution],
    progress: Progress | None,
    *,
    careful: bool,
    every: bool = False,
    quick: bool = False,
) -> list[HeatedGrid]:
    """Flooded film with heat on all grids.

    ``careful`` and ``quick`` are described in ``OuterIteration``. Unless on ``every`` grid, an iteration that
    is not careful ends with the first grid that it does not solve. ``starts`` are isothermal films over the
    whole domain, the one on their finest grid last.
    """
    grids, least = [finest], _FIRST_CAREFUL if careful else _FIRST
    if finest.width is not None:
        least = _FIRST_POINT
    while len(grids) < 2 or grids[-1].nodes // 2 + 1 >= least:
        grids.append(grids[-1].halved())
    solved: list[HeatedGrid] = []
    for finer, posed in reversed(list(enumerate(grids))):
        most = _GUESS_LOOPS if every else MOST_LOOPS
        iteration = iteration_on(posed, finer=finer, progress=progress)
        iteration = replace(iteration, careful=careful, quick=quick, most_loops=most)
        if careful:
            solved.append(_careful(iteration, starts, solved))
        else:
            state, heat, filled = start_of(iteration, starts, solved)
            solved.append(iteration(state, heat, spike=True, filled=filled))
        if not (careful or every or solved[-1].status == "converged"):
            break
    return solved


def _careful(
    iteration: OuterIteration, starts: Sequence[GridSolution], solved: list[HeatedGrid]
) -> HeatedGrid:
    """Film with heat on a grid by the first careful iteration that converges.

    The variant that converged on the coarser grid comes first.
    """
    variants = _variants(iteration, held=bool(solved) and solved[-1].iteration.held)
    state, heat, filled = start_of(iteration, starts, solved)
    tried: list[HeatedGrid] = []
    for variant in variants:
        tried.append(variant(state, heat, spike=True, filled=filled))
        if tried[-1].status == "converged":
            return tried[-1]
    if iteration.physics.slide_to_roll_ratio != 0.0:
        for variant in variants:
            tried.append(_by_slip(variant, starts))
            if tried[-1].status == "converged":
                return tried[-1]
    return tried[0]


def _variants(iteration: OuterIteration, *, held: bool) -> list[OuterIteration]:
    """Iteration with and without films that are held; the iteration with ``held`` comes first."""
    return [replace(iteration, held=each) for each in (held, not held)]


def iteration_on(problem: FilmProblem, *, finer: int, progress: Progress | None) -> OuterIteration:
    """Outer iteration on the grid of a problem."""
    posed = grid_problem(problem, levels_of(problem), progress, finest=finer == 0)
    return OuterIteration(problem, posed, finer)


def _by_slip(iteration: OuterIteration, starts: Sequence[GridSolution]) -> HeatedGrid:
    """Film with heat on a grid from rolling to its slip in steps, which converges from farther."""
    first, second = iteration.physics.speeds
    mean = iteration.physics.mean_speed
    (state, heat, filled), loops = start_of(iteration, starts, []), 0
    for part in _SLIPS:
        speeds = mean + part * (first - mean), mean + part * (second - mean)
        problem = replace(iteration.problem, physics=replace(iteration.physics, speeds=speeds))
        grid = replace(iteration, problem=problem)(state, heat, spike=False, filled=filled)
        loops += grid.loops
        if grid.status != "diverged":
            state, heat, filled = grid.state, grid.heat, grid.filled
    return replace(grid, loops=loops)


def start_of(
    iteration: OuterIteration, starts: Sequence[GridSolution], grids: list[HeatedGrid]
) -> tuple[State, Heat | None, Mask | None]:
    """Initial guess: the film with heat on the coarser grid, or the isothermal film on the first grid.

    Its filled nodes (nx, ny) are None of a film without mass-conserving cavitation.
    """
    level = iteration.level
    same = [solution for solution in starts if solution.level.mesh.shape == level.mesh.shape]
    simple = same[-1] if same else starts[-1]
    heat, guess = None, simple
    if grids and grids[-1].status == "converged":
        if grids[-1].heat is not None:
            heat = finer_heat(grids[-1].heat, grids[-1].level, level)
        # The spots of a film on a coarser grid are others.
        guess = simple if same and (simple.touches or grids[-1].touches) else grids[-1]
    state = guess.state
    if guess not in same and iteration.quick:
        state = state_with_spots(level, guess, iteration.problem.boundary_film)
    elif guess not in same:
        state = (interpolated_state if guess.touches else open_state)(level, guess)
    return state, heat, _filled_on(level, guess)


def _filled_on(level: Level, coarse: GridSolution) -> Mask | None:
    """Nodes (nx, ny) that oil fills in a film on some grid; None if its cavitation does not conserve mass."""
    return None if coarse.content is None else filled_on(level.mesh, coarse.level.mesh, coarse.content.filled)


def finer_heat(heat: Heat, coarse: Level, level: Level) -> Heat:
    """Temperature and fluxes on a finer grid, interpolated linearly."""
    return Heat(*(on_mesh(values, coarse.mesh, level.mesh) for values in vars(heat).values()))


def changed_heat(fine: Heat, before: Heat, after: Heat, levels: tuple[Level, Level]) -> Heat:
    """Temperature and fluxes of a film, changed as another film differs from it on the coarser grid.

    ``before`` and ``after`` are temperatures on the first of ``levels``, and ``fine`` is one on the last.
    """
    first, last = (vars(finer_heat(heat, *levels)) for heat in (before, after))
    return Heat(**{name: values + last[name] - first[name] for name, values in vars(fine).items()})
