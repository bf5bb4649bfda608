"""Film with heat on one grid: pressure and film thickness in turn with the temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.flow import Fluid
from ehlectric.film.levels import Level
from ehlectric.film.mesh import at_centre
from ehlectric.film.newton import newton
from ehlectric.film.problem import FilmProblem
from ehlectric.film.sheared.columns import Columns
from ehlectric.film.sheared.flow import ShearedFlow
from ehlectric.film.sheared.profile import Across
from ehlectric.film.sheared.traction import filled_part
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

# Largest number of outer loops, and of Newton steps in each of them.
_LOOPS, _STEPS = 60, 2

# Change of the temperature, relative to its largest rise and absolute [K], and relative change of the central
# film thickness, at which film and temperature stand. On the coarser grids five times as much is enough.
_RISE, _KELVIN, _FILM, _COARSE = 2e-3, 5e-3, 5e-5, 5.0


@dataclass(frozen=True, eq=False)
class HeatedGrid:
    """Film with heat on one grid.

    Attributes
    ----------
    solution : GridSolution
        Pressure and film thickness.
    heat : Heat or None
        Temperature and heat flow into the bodies; None for an isothermal film.
    columns : Columns
        Stresses and speeds across the film.
    stream : Stream or None
        Flow of the energy equation; None for an isothermal film.
    filled : ndarray, shape (nx, ny)
        Share of the gap that oil fills.
    loops : int
        Number of outer loops.
    """

    solution: GridSolution
    heat: Heat | None
    columns: Columns
    stream: Stream | None
    filled: Array
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
    finest : bool
        Whether this is the last grid.
    progress : callable or None
        Function that is called before every Newton step.
    """

    problem: FilmProblem
    levels: list[Level]
    tolerance: float
    finest: bool
    progress: Progress | None

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

    def fluid(self, heat: Heat | None) -> tuple[Fluid, ShearedFlow]:
        """Fluid whose flow has the rheology and a frozen temperature."""
        physics, thermal, profile = self.physics, self.physics.thermal, None
        if thermal is not None and heat is not None:
            profile = FrozenTemperature(
                Across.of(DEGREE),
                self.levels[0].mesh,
                heat.temperature,
                thermal.oil,
                thermal.inlet_temperature,
                self.problem.scales.pressure,
            )
        flow = ShearedFlow(
            rheology=physics.rheology,
            slide_to_roll_ratio=physics.slide_to_roll_ratio,
            stress_scale=self.stress_scale,
            pressure_scale=self.problem.scales.pressure,
            profile=profile,
        )
        return replace(self.problem.fluid, flow=flow), flow

    def film(self, state: State, heat: Heat | None, *, steps: int, spike: bool) -> GridSolution:
        """Film at a frozen temperature, after at most ``steps`` Newton steps."""
        fluid, _ = self.fluid(heat)
        return newton(
            fluid,
            self.levels,
            state,
            tolerance=self.tolerance,
            max_iterations=steps,
            min_iterations=1,
            progress=self.progress,
            eliminate_spike=spike and self.problem.width is None,
        )

    def columns(self, solution: GridSolution, heat: Heat | None) -> tuple[Columns, Array]:
        """Stresses and speeds across the film, and the share of the gap that oil fills."""
        fluid, flow = self.fluid(heat)
        state, mesh = solution.state, self.levels[0].mesh
        found = flow.columns(fluid, state.pressure, state.thickness, mesh)
        mass = solution.final.coefficients.density * state.thickness
        return found, filled_part(solution.final.full_film, mass)

    def stream(self, thermal: Thermal, solution: GridSolution, heat: Heat) -> tuple[Stream, Columns, Array]:
        """Flow of the energy equation at a film and a temperature."""
        columns, filled = self.columns(solution, heat)
        scales = self.problem.scales
        stream = stream_of(
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
        return stream, columns, filled

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
        zeta = Across.of(DEGREE).zeta[:, np.newaxis, np.newaxis]
        return Heat(np.broadcast_to(a + (b - a) * zeta, (zeta.size, *shape)).copy(), np.zeros((2, *shape)))

    def __call__(self, state: State, heat: Heat | None, *, spike: bool) -> HeatedGrid:
        """Film and temperature from an initial guess of both."""
        thermal = self.physics.thermal
        if thermal is None:
            solution = self.film(state, None, steps=self.problem.max_iterations, spike=spike)
            columns, filled = self.columns(solution, None)
            return HeatedGrid(solution, None, columns, None, filled, 0)
        heat = self.start(thermal) if heat is None else heat
        surfaces = self.surfaces(thermal)
        weight = _weight(self.levels[0], state)
        mixing, taken = _mixing(weight, heat), list[NewtonStep]()
        before = np.inf
        for loop in range(_LOOPS):
            solution = self.film(state, heat, steps=_STEPS, spike=spike and loop == 0)
            taken += solution.steps
            stream, columns, filled = self.stream(thermal, solution, heat)
            if solution.status == "diverged":
                break
            new = solve_energy(
                HeatColumns.of(stream, heat.temperature),
                surfaces,
                heat,
                inlet_temperature=thermal.inlet_temperature,
                symmetric=stream.symmetric,
            )
            central = at_centre(self.levels[0].mesh, solution.state.thickness)
            change = max(_change(weight, heat, new, thermal), abs(central - before) / (_FILM * central))
            stands = change < (1.0 if self.finest else _COARSE)
            if stands and solution.status != "converged":
                # The temperature stands; only the film has digits to gain.
                solution = self.film(solution.state, heat, steps=self.problem.max_iterations, spike=False)
                taken += solution.steps
                stream, columns, filled = self.stream(thermal, solution, heat)
            if stands and solution.status == "converged":
                break
            before, state = central, solution.state
            heat = _mixed(mixing, heat, new)
        else:
            solution = replace(solution, status="stalled")
        solution = replace(solution, steps=tuple(taken))
        return HeatedGrid(solution, heat, columns, stream, filled, loop + 1)


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
    return Heat(temperature, flux)
