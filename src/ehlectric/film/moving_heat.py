"""Heat of a moving film: stored in the oil from instant to instant, and in the surfaces under its whole past.

A time step is implicit. At each node across the film the heat that the oil holds enters as

    rho c theta h (T - T_before)/dt,

and the mass that the gap gains there moves oil across the film. Compression also heats the oil by the change
of the pressure in time. A surface is a half-space that takes up the flux that each of its points has met on
its way. Conduction along the surface is neglected in what changes with time. With the flux q of the
stationary film, from which the motion starts, and the flux q' above it, the temperature of a surface with the
speed u is

    T(x, t) = T_stationary(x) + 1/sqrt(pi rho c k) Int_0^t q'(x - u (t - s), s)/sqrt(t - s) ds,

with q' constant in each time step (H. S. Carslaw and J. C. Jaeger, Conduction of Heat in Solids, 2nd ed.,
Oxford 1959, section 2.9). Without motion the film therefore stays the stationary one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.energy_equation import Earlier, Heat, Stream, Surface, finite_heat
from ehlectric.film.heated_film import HeatedGrid, OuterIteration, change_between, mid_film, node_weight
from ehlectric.film.hot_oil import Thermal
from ehlectric.film.newton import GridSolution

# Largest number of turns between film and temperature in one time step.
MOST_TURNS = 12


@dataclass(frozen=True, eq=False)
class Warmth:
    """Heat at one instant, and what surfaces have met until then."""

    heat: Heat
    mass: Array  # mass theta rho h of the oil at the nodes across the film [kg/m^2], shape (nz, nx, ny)
    pressure: Array  # pressure [Pa], shape (nx, ny)
    # Ends of the time steps so far [s], the first of which is the time of the stationary film, shape (n +
    # 1,).
    times: Array
    # Flux into both surfaces in each step above the flux of the stationary film [W/m^2], shape (n, 2, nx,
    # ny).
    excess: Array

    @property
    def middle(self) -> Array:
        """Temperature at mid-film [K], shape (nx, ny)."""
        return mid_film(self.heat.temperature)


@dataclass(frozen=True, eq=False)
class MovingHeat:
    """Energy equation of the time steps of a film."""

    iteration: OuterIteration  # rheology, heat and grid
    stationary: Heat
    surfaces: tuple[Surface, Surface]  # surfaces of the stationary film

    @classmethod
    def of(cls, steady: HeatedGrid) -> MovingHeat | None:
        """Energy equation after a stationary film; None of a film without heat."""
        thermal = steady.iteration.physics.thermal
        if thermal is None or steady.heat is None:
            return None
        return cls(steady.iteration, steady.heat, steady.iteration.surfaces(thermal))

    @property
    def thermal(self) -> Thermal:
        """Bodies and oil."""
        assert self.iteration.physics.thermal is not None
        return self.iteration.physics.thermal

    @property
    def time_scale(self) -> float:
        """Time [s] in which the surfaces travel the length of dimensionless time 1 at their mean speed."""
        return self.iteration.problem.scales.length / self.iteration.physics.mean_speed

    def start(self, steady: HeatedGrid, filled: Array) -> Warmth:
        """Heat of the stationary film, whose gap oil fills to the part ``filled`` (nx, ny)."""
        stream = self._stream(steady, self.stationary, filled)
        shape = (0, *self.stationary.flux.shape)
        return Warmth(
            heat=self.stationary,
            mass=stream.mass,
            pressure=self.iteration.pressure(steady.state),
            times=np.zeros(1),
            excess=np.zeros(shape),
        )

    def after(
        self, solution: GridSolution, heat: Heat, filled: Array, before: Warmth, step: float
    ) -> Warmth | None:
        """Heat after a time step T, from the temperature of a last turn; None if it is not finite."""
        seconds, pressure = step * self.time_scale, self.iteration.pressure(solution.state)
        earlier = Earlier(before.heat.temperature, before.mass, before.pressure, seconds)
        stream = self._stream(solution, heat, filled, earlier)
        now = float(before.times[-1]) + seconds
        surfaces = self._surface(0, before, now, seconds), self._surface(1, before, now, seconds)
        new = finite_heat(stream, surfaces, heat, self.thermal.inlet_temperature)
        if new is None:
            return None
        excess = np.concatenate([before.excess, (new.flux - self.stationary.flux)[np.newaxis]])
        return Warmth(new, stream.mass, pressure, np.append(before.times, now), excess)

    def stands(self, solution: GridSolution, heat: Heat, new: Heat) -> bool:
        """Whether a new temperature of a film is close enough to the temperature with which the film was
        solved.
        """
        weight = node_weight(self.iteration.level, solution.state)
        return change_between(weight, heat, new, self.thermal) < 1.0

    def _surface(self, number: int, before: Warmth, now: float, step: float) -> Surface:
        """Surface whose temperature is known except for the flux of this step."""
        body, surface = self.thermal.bodies[number], self.surfaces[number]
        flux = self.stationary.flux[number]
        effusivity = np.sqrt(np.pi * body.density * body.heat_capacity * body.thermal_conductivity)
        response = 2.0 * np.sqrt(step) / effusivity
        known = surface.bulk + surface.rise(flux) - response * flux
        ends = before.times
        weights = 2.0 * (np.sqrt(now - ends[:-1]) - np.sqrt(now - ends[1:])) / effusivity
        speed = self.iteration.physics.speeds[number]
        spacing = self.iteration.level.mesh.dx * self.iteration.problem.scales.length
        ways = speed * (now - 0.5 * (ends[:-1] + ends[1:])) / spacing
        for weight, way, excess in zip(weights, ways, before.excess[:, number], strict=True):
            known = known + weight * shifted(excess, float(way))
        nodes = flux.shape[0]
        downstream = np.zeros(nodes)
        downstream[0] = response
        return Surface(known, downstream, np.zeros(nodes))

    def _stream(
        self, solution: GridSolution, heat: Heat, filled: Array, earlier: Earlier | None = None
    ) -> Stream:
        """Flow of the energy equation at a film and a temperature."""
        flow = self.iteration.flow(solution.state, heat)
        return self.iteration.stream(solution, heat, flow, filled, earlier)


def shifted(values: Array, way: float) -> Array:
    """Nodal values (nx, ny) after they have moved downstream by a way in grid spacings, zero upstream.

    Examples
    --------
    >>> shifted(np.array([[1.0], [2.0], [4.0]]), 1.5)[:, 0].tolist()
    [0.0, 0.5, 1.5]
    """
    whole = int(np.floor(way))
    part, moved = way - whole, np.zeros_like(values)
    nodes = len(values)
    for steps, weight in ((whole, 1.0 - part), (whole + 1, part)):
        if steps < nodes:
            moved[steps:] += weight * values[: nodes - steps]
    return moved
