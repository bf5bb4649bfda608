"""Temperature of the film that its flow takes as known, with the oil's properties at it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh
from ehlectric.film.sheared.profile import Across, Properties, on_mesh
from ehlectric.film.thermal.energy import Heat
from ehlectric.film.thermal.oil import HotOil


@dataclass(frozen=True, eq=False)
class FrozenTemperature:
    """Temperature across the film as a ``Profile`` of its flow.

    The temperature belongs to a pressure p0. Where the pressure changes, the temperature follows it by the
    heat of compression, T + T_p (p - p0). Without T_p, film and temperature converge slowly at the pressure
    spike, which heats the oil in passing. Viscosity ratio and density are linear in p - p0 as well: they are
    computed only once, and exact where film and temperature have converged.

    Attributes
    ----------
    across : Across
        Nodes across the film.
    mesh : Mesh
        Mesh of the temperature.
    heat : Heat
        Temperature T at the pressure ``pressure``, and its derivative T_p.
    pressure : ndarray, shape (nx, ny)
        Pressure P0 over p_h, not below ambient.
    oil : HotOil
        Oil over pressure and temperature.
    inlet_temperature : float
        Temperature of the oil whose laws the fluid of the film problem has [K].
    pressure_scale : float
        Hertz pressure p_h [Pa].
    """

    across: Across
    mesh: Mesh
    heat: Heat
    pressure: Array
    oil: HotOil
    inlet_temperature: float
    pressure_scale: float
    _on_meshes: dict[tuple[int, int, float], tuple[Properties, Array]] = field(
        default_factory=dict, init=False, repr=False
    )

    def at(self, pressure: Array) -> Heat:
        """Heat with the temperature at a pressure P (nx, ny) that is not below ambient."""
        change = self.pressure_scale * (pressure - self.pressure)
        return replace(self.heat, temperature=self.heat.temperature + self.heat.by_pressure * change)

    @cached_property
    def properties(self) -> Properties:
        """Properties at the pressure P0, on the mesh of the temperature."""
        p = self.pressure_scale * self.pressure
        with_inlet = np.concatenate([self.heat.temperature, np.full((1, *p.shape), self.inlet_temperature)])
        viscosity, density = self.oil.log_viscosity(p, with_inlet), self.oil.density(p, self.heat.temperature)
        cold = self.oil.density(np.zeros(1), np.full(1, self.inlet_temperature)).value[0]
        log_ratio_p = viscosity.by_pressure[:-1] - viscosity.by_pressure[-1]
        log_ratio_p += self.heat.by_pressure * viscosity.by_temperature[:-1]
        density_p = density.by_pressure + self.heat.by_pressure * density.by_temperature
        return Properties(
            log_ratio=viscosity.value[:-1] - viscosity.value[-1],
            log_ratio_p=self.pressure_scale * log_ratio_p,
            density=density.value / cold,
            density_p=self.pressure_scale / cold * density_p,
        )

    def _on(self, mesh: Mesh) -> tuple[Properties, Array]:
        """Properties at P0, and P0, on another mesh of the same contact."""
        key = (*mesh.shape, float(mesh.x[0]))
        if key not in self._on_meshes:
            values = (on_mesh(each, self.mesh, mesh) for each in vars(self.properties).values())
            pressure = on_mesh(self.pressure[np.newaxis], self.mesh, mesh)[0]
            self._on_meshes[key] = Properties(*values), pressure
        return self._on_meshes[key]

    def __call__(self, pressure: Array, mesh: Mesh) -> Properties:
        """Properties at a pressure P (nx, ny) that is not below ambient."""
        known, of = self._on(mesh)
        change = pressure - of
        return Properties(
            log_ratio=known.log_ratio + known.log_ratio_p * change,
            log_ratio_p=known.log_ratio_p,
            density=known.density + known.density_p * change,
            density_p=known.density_p,
        )
