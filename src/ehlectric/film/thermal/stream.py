"""Flow and properties of the oil in all columns of a film, for the energy equation."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh
from ehlectric.film.sheared.columns import Columns
from ehlectric.film.thermal.columns import Stream
from ehlectric.film.thermal.oil import HotOil


def stream_of(
    oil: HotOil,
    columns: Columns,
    temperature: Array,
    *,
    pressure: Array,
    thickness: Array,
    filled: Array,
    mesh: Mesh,
    length: float,
    pressure_scale: float,
    speed: float,
    stress: float,
) -> Stream:
    """Flow and properties of the oil, SI units.

    Parameters
    ----------
    oil : HotOil
        Oil over pressure and temperature.
    columns : Columns
        Dimensionless stresses and speeds across the film.
    temperature : ndarray, shape (nz, nx, ny)
        Temperature [K].
    pressure, thickness : ndarray, shape (nx, ny)
        Pressure [Pa] and film thickness [m].
    filled : ndarray, shape (nx, ny)
        Share of the gap that oil fills.
    mesh : Mesh
        Grid.
    length, pressure_scale, speed, stress : float
        Half-width b [m], Hertz pressure [Pa], entrainment speed [m/s], and scale of the stresses [Pa].

    Returns
    -------
    Stream
        Velocities, properties and sources of heat.
    """
    u, v = speed * columns.speed
    viscosity = oil.log_viscosity(pressure, temperature)
    density = oil.density(pressure, temperature)
    heating = columns.heating * (stress * speed / thickness)
    gradient = columns.gradient * (pressure_scale / length)
    expansion = -density.by_temperature / density.value
    return Stream(
        across=columns.across,
        dx=mesh.dx * length,
        dy=0.0 if mesh.dy is None else mesh.dy * length,
        symmetric=mesh.symmetric,
        thickness=thickness,
        filling=filled,
        u=u,
        v=v,
        density=density.value,
        heat_capacity=oil.heat_capacity(pressure, temperature).value,
        conductivity=oil.thermal_conductivity(pressure, temperature).value,
        heating=heating,
        heating_slope=np.minimum(0.0, heating * columns.softening * viscosity.by_temperature),
        compression=np.where(filled < 1.0, 0.0, expansion * (u * gradient[0] + v * gradient[1])),
    )
