"""Temperature of the film that its flow takes as fixed, with the oil's properties at it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh
from ehlectric.film.sheared.profile import Across, Properties, on_mesh
from ehlectric.film.thermal.oil import HotOil


@dataclass(frozen=True, eq=False)
class FrozenTemperature:
    """Temperature across the film as a ``Profile`` of its flow.

    Attributes
    ----------
    across : Across
        Nodes across the film.
    mesh : Mesh
        Mesh of the temperature.
    temperature : ndarray, shape (nz, nx, ny)
        Temperature [K].
    oil : HotOil
        Oil over pressure and temperature.
    inlet_temperature : float
        Temperature of the oil whose laws the fluid of the film problem has [K].
    pressure_scale : float
        Hertz pressure p_h [Pa].
    """

    across: Across
    mesh: Mesh
    temperature: Array
    oil: HotOil
    inlet_temperature: float
    pressure_scale: float
    _on_meshes: dict[tuple[int, int, float], Array] = field(default_factory=dict, init=False, repr=False)

    def on(self, mesh: Mesh) -> Array:
        """Temperature (nz, nx, ny) on another mesh of the same contact."""
        key = (*mesh.shape, float(mesh.x[0]))
        if key not in self._on_meshes:
            self._on_meshes[key] = on_mesh(self.temperature, self.mesh, mesh)
        return self._on_meshes[key]

    def __call__(self, pressure: Array, mesh: Mesh) -> Properties:
        """Properties at a pressure P (nx, ny) that is not below ambient."""
        p = self.pressure_scale * pressure
        temperature = np.concatenate([self.on(mesh), np.full((1, *p.shape), self.inlet_temperature)])
        viscosity = self.oil.log_viscosity(p, temperature)
        density = self.oil.density(p, self.on(mesh))
        cold = self.oil.density(np.zeros(1), np.full(1, self.inlet_temperature)).value[0]
        return Properties(
            log_ratio=viscosity.value[:-1] - viscosity.value[-1],
            log_ratio_p=self.pressure_scale * (viscosity.by_pressure[:-1] - viscosity.by_pressure[-1]),
            density=density.value / cold,
            density_p=self.pressure_scale * density.by_pressure / cold,
        )
