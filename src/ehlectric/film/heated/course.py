"""Film with heat on one grid: pressure and film thickness in turn with the temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.levels import Level
from ehlectric.film.mesh import at_centre
from ehlectric.film.newton import newton
from ehlectric.film.problem import FilmProblem
from ehlectric.film.sheared.columns import Columns
from ehlectric.film.sheared.flow import ShearedFlow
from ehlectric.film.sheared.profile import Across
from ehlectric.film.sheared.traction import filled_part
from ehlectric.film.starved.reformed import conserving_film, forms_again
from ehlectric.film.state import GridSolution, NewtonStep, Progress, State
from ehlectric.film.thermal.columns import HeatColumns, Stream
from ehlectric.film.thermal.energy import Heat, solve_energy
from ehlectric.film.thermal.frozen import FrozenTemperature
from ehlectric.film.thermal.half_space import Surface, moving_surface
from ehlectric.film.thermal.mixing import Mixing
from ehlectric.film.thermal.physics import Physics, Thermal
from ehlectric.film.thermal.stream import stream_of

# Degree of the polynomial across the film.
DEGREE = 12

# Largest change of temperature in one outer loop [K].
_MOST_CHANGE = 40.0

# Largest number of outer loops. In all loops but the last the film has this number of Newton steps at most,
# as far as this residual: its temperature is still to change.
_LOOPS, _STEPS, _LOOSE = 60, 2, 1e-3

# Multiple of the Newton steps of a film that carries its oil, whose cavities grow by few nodes a step.
_CARRYING = 3

# Distance of the temperature, relative to its largest rise and absolute [K], and relative distance of the
# central film thickness, at which film and temperature stand. The multiples are those of the finest grid, of
# the next coarser one, which gives the estimates of the errors, and of all others.
_RISE, _KELVIN, _FILM = 3e-3, 5e-3, 5e-5
_MULTIPLES = (1.0, 5.0, 25.0)

# Largest number of solutions of the energy equation with the film held, and of the turns that have them. From
# the cold, each brings the viscosity down by a factor of e at most; later turns begin hot.
_HELD, _HELD_TURNS = 60, 15

# Largest ratio of two successive changes in the estimate of the distance.
_SLOWEST = 0.9


@dataclass(frozen=True, eq=False)
class HeatedGrid:
    """Film with heat on one grid.

    Attributes
    ----------
    solution : GridSolution
        Pressure and film thickness.
    heat : Heat or None
        Temperature and heat flow into the bodies; None for an isothermal film.
    flow : ShearedFlow
        Flow with the rheology at this temperature.
    loops : int
        Number of outer loops.
    """

    solution: GridSolution
    heat: Heat | None
    flow: ShearedFlow
    loops: int

    @property
    def converged(self) -> bool:
        """Whether film and temperature stand."""
        return self.solution.status == "converged"


@dataclass(frozen=True, eq=False)
class Course:
    """Outer iteration on one grid.

    Attributes
    ----------
    problem : FilmProblem
        Problem on the grid; it has ``physics``.
    levels : list of Level
        Grid, and the coarser grids of its preconditioner.
    tolerance : float
        Tolerance of the residual of the film.
    finer : int
        Number of finer grids that follow.
    progress : callable or None
        Function that is called before every Newton step.
    careful : bool
        Whether properties are evaluated again at the pressure of each film, and changes count as they are and
        not as parts of a geometric sequence: slower, and it converges for hotter films.
    held : bool
        Whether the flow follows the temperature within the first turns, until the energy equation has
        converged for a held film.
    degree : int
        Degree of the polynomial across the film.
    filled : ndarray of bool, shape (nx, ny), or None
        Nodes that oil fills at first, of a film that carries its oil through cavities; None of one whose
        cavities count as full.
    """

    problem: FilmProblem
    levels: list[Level]
    tolerance: float
    finer: int
    progress: Progress | None
    careful: bool = False
    held: bool = False
    degree: int = DEGREE
    filled: Mask | None = None

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
        if thermal is not None and heat is not None:
            profile = FrozenTemperature(
                Across.of(self.degree),
                self.levels[0].mesh,
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
        return np.maximum(state.pressure, self.problem.fluid.ambient_pressure)

    def film(
        self,
        state: State,
        heat: Heat | None,
        *,
        steps: int,
        tolerance: float,
        spike: bool,
        filled: Mask | None = None,
    ) -> tuple[GridSolution, ShearedFlow, Heat | None]:
        """Film after at most ``steps`` Newton steps from a state, its flow, and the heat at its pressure.

        With the nodes ``filled`` that oil fills at first, the film carries its oil through cavities.
        """
        flow = self.flow(state, heat)
        fluid = replace(self.problem.fluid, flow=flow)
        if filled is None:
            solution = newton(
                fluid,
                self.levels,
                state,
                tolerance=tolerance,
                max_iterations=steps,
                min_iterations=1,
                progress=self.progress,
                eliminate_spike=spike and self.problem.width is None,
            )
        else:
            solution = conserving_film(
                fluid,
                self.levels,
                (state, filled),
                order=self.problem.wedge_order,
                tolerance=tolerance,
                max_iterations=steps,
                progress=self.progress,
            )
        if isinstance(flow.profile, FrozenTemperature):
            heat = flow.profile.at(self._clipped(solution.state))
        return solution, flow, heat

    def columns(self, solution: GridSolution, flow: ShearedFlow) -> tuple[Columns, Array]:
        """Stresses and speeds across the film, and the share of the gap that oil fills."""
        state, mesh = solution.state, self.levels[0].mesh
        found = flow.columns(self.problem.fluid, state.pressure, state.thickness, mesh)
        if solution.fraction is not None:
            return found, solution.fraction
        mass = solution.final.coefficients.density * state.thickness
        return found, filled_part(solution.final.full_film, mass)

    def stream(self, solution: GridSolution, heat: Heat, columns: Columns, filled: Array) -> Stream:
        """Flow of the energy equation at a film and a temperature."""
        scales, thermal = self.problem.scales, self.physics.thermal
        assert thermal is not None
        return stream_of(
            thermal.oil,
            columns,
            heat.temperature,
            pressure=np.maximum(scales.pressure * solution.state.pressure, scales.ambient_pressure),
            thickness=scales.thickness * solution.state.thickness,
            filled=filled,
            mesh=self.levels[0].mesh,
            length=scales.length,
            pressure_scale=scales.pressure,
            speed=self.physics.mean_speed,
            stress=self.stress_scale,
        )

    def surfaces(self, thermal: Thermal) -> tuple[Surface, Surface]:
        """Surfaces of both bodies on the grid."""
        mesh, length = self.levels[0].mesh, self.problem.scales.length
        first, second = (
            moving_surface(body, speed, nodes=mesh.x.size, spacing=mesh.dx * length, half_width=length)
            for body, speed in zip(thermal.bodies, self.physics.speeds, strict=True)
        )
        return first, second

    def start(self, thermal: Thermal) -> Heat:
        """Temperature of a film that is nowhere heated: linear between the bodies."""
        shape = self.levels[0].mesh.shape
        a, b = (body.temperature for body in thermal.bodies)
        zeta = Across.of(self.degree).zeta[:, np.newaxis, np.newaxis]
        temperature = np.broadcast_to(a + (b - a) * zeta, (zeta.size, *shape)).copy()
        return Heat(temperature, np.zeros((2, *shape)), np.zeros_like(temperature))

    def __call__(self, state: State, heat: Heat | None, *, spike: bool) -> HeatedGrid:
        """Film and temperature from an initial guess of both.

        A film that forms again behind a cavity is solved once more, with the oil carried through it.
        """
        found = self._turns(state, heat, spike=spike)
        full = found.solution.final.full_film
        if self.filled is not None or not found.converged or not forms_again(full):
            return found
        again = replace(self, filled=full)._turns(found.solution.state, found.heat, spike=False)
        if not again.converged:
            return found
        taken = found.solution.steps + again.solution.steps
        return replace(again, solution=replace(again.solution, steps=taken), loops=found.loops + again.loops)

    def _turns(self, state: State, heat: Heat | None, *, spike: bool) -> HeatedGrid:
        """Film and temperature in turns, from an initial guess of both."""
        thermal, most, filled = self.physics.thermal, self.problem.max_iterations, self.filled
        if thermal is None:
            if filled is not None:
                most *= _CARRYING
            solution, flow, _ = self.film(
                state, None, steps=most, tolerance=self.tolerance, spike=spike, filled=filled
            )
            return HeatedGrid(solution, None, flow, 0)
        heat = self.start(thermal) if heat is None else heat
        surfaces, weight = self.surfaces(thermal), _weight(self.levels[0], state)
        mixing, taken = _mixing(weight, heat), list[NewtonStep]()
        allowed = _MULTIPLES[min(self.finer, len(_MULTIPLES) - 1)]
        rises, films, central, ends = list[float](), list[float](), np.inf, False
        for loop in range(_LOOPS):
            steps, tolerance = (most, self.tolerance) if ends else (_STEPS, max(self.tolerance, _LOOSE))
            if filled is not None:
                steps *= _CARRYING
            solution, flow, heat = self.film(
                state, heat, steps=steps, tolerance=tolerance, spike=spike and loop == 0, filled=filled
            )
            assert heat is not None
            filled = None if filled is None else solution.final.full_film
            taken += solution.steps
            before, central = central, at_centre(self.levels[0].mesh, solution.state.thickness)
            films.append(abs(central - before) / (_FILM * central))
            stands = ends and solution.status == "converged" and films[-1] < allowed
            if stands or solution.status == "diverged":
                break
            if self.held and loop < _HELD_TURNS:
                new = self._temperature_of_held(solution, heat, surfaces, weight, allowed)
            else:
                flow = self.flow(solution.state, heat) if self.careful else flow
                new = self._heated(solution, heat, flow, surfaces)
            if new is None:
                solution = replace(solution, status="diverged")
                break
            rises.append(_change(weight, heat, new, thermal))
            # Film and temperature that are close enough end with a film at the last temperature.
            ends = max(self._distance(rises), self._distance(films)) < allowed
            state = solution.state
            heat = _mixed(mixing, heat, new)
        else:
            solution = replace(solution, status="stalled")
        return HeatedGrid(replace(solution, steps=tuple(taken)), heat, flow, loop + 1)

    def _temperature_of_held(
        self,
        solution: GridSolution,
        heat: Heat,
        surfaces: tuple[Surface, Surface],
        weight: Array,
        allowed: float,
    ) -> Heat | None:
        """Temperature of a held film together with its flow; None if it has no finite solution.

        The heat of shear of a cold Newtonian film is many orders of magnitude too large. The film, and
        above all its spike, would follow each temperature on the way. Where the pressure gradient and not the
        slip drives the flow, the temperature of a film far from its solution may run away. The first
        temperature counts then.
        """
        assert self.physics.thermal is not None
        first = new = self._heated(solution, heat, self.flow(solution.state, heat), surfaces)
        for _ in range(_HELD):
            if new is None or _change(weight, heat, new, self.physics.thermal) < allowed:
                return new
            if np.max(np.abs(new.temperature - heat.temperature)) > _MOST_CHANGE:
                break
            heat = new
            new = self._heated(solution, heat, self.flow(solution.state, heat), surfaces)
        return first

    def _heated(
        self, solution: GridSolution, heat: Heat, flow: ShearedFlow, surfaces: tuple[Surface, Surface]
    ) -> Heat | None:
        """Temperature by the energy equation of a film; None if it has no finite solution."""
        thermal = self.physics.thermal
        assert thermal is not None
        stream = self.stream(solution, heat, *self.columns(solution, flow))
        try:
            new = solve_energy(
                HeatColumns.of(stream, heat.temperature),
                surfaces,
                heat,
                inlet_temperature=thermal.inlet_temperature,
                symmetric=stream.symmetric,
            )
        except np.linalg.LinAlgError:
            return None
        return new if np.all(np.isfinite(new.temperature)) else None

    def _distance(self, changes: list[float]) -> float:
        """Distance from the limit after changes that fall in a geometric sequence, or the last change."""
        if self.careful or len(changes) < 2 or not np.isfinite(changes[-2]):
            return changes[-1]
        ratio = min(_SLOWEST, changes[-1] / max(changes[-2], 1e-300))
        return changes[-1] * ratio / (1.0 - ratio)


def _change(weight: Array, heat: Heat, new: Heat, thermal: Thermal) -> float:
    """Change of the temperature over that at which it stands."""
    rise = float(np.max(new.temperature)) - thermal.inlet_temperature
    change = np.max(weight * np.abs(new.temperature - heat.temperature))
    return float(change) / close_enough(rise)


def close_enough(rise: float) -> float:
    """Change of the temperature [K] that is small enough on the finest grid, for a largest rise [K]."""
    return _KELVIN + _RISE * abs(rise)


def _weight(level: Level, state: State) -> Array:
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
    mixed = mixing(
        np.concatenate([heat.temperature.ravel(), heat.flux.ravel()]),
        np.concatenate([new.temperature.ravel(), new.flux.ravel()]),
    )
    size = heat.temperature.size
    temperature = mixed[:size].reshape(heat.temperature.shape)
    flux = mixed[size:].reshape(heat.flux.shape)
    step = float(np.max(np.abs(temperature - heat.temperature)))
    if step > _MOST_CHANGE:
        mixing.forget()
        part = _MOST_CHANGE / step
        temperature = heat.temperature + part * (temperature - heat.temperature)
        flux = heat.flux + part * (flux - heat.flux)
    return replace(new, temperature=temperature, flux=flux)
