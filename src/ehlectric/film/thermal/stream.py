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
    along = upstream_slope(pressure, u, mesh.dx * length)
    across = columns.gradient[1] * (pressure_scale / length)
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
        compression=np.where(filled < 1.0, 0.0, expansion * (u * along + v * across)),
        compression_p=np.where(filled < 1.0, 0.0, expansion * np.abs(u) / (mesh.dx * length)),
    )


def upstream_slope(pressure: Array, u: Array, dx: float) -> Array:
    """Slope of the pressure along the way that the oil has come.

    Heat of compression from the node upstream to this one depends on no pressure further downstream. The
    difference is of first order: one of second order overshoots behind the pressure spike, where the oil
    cools by expansion within two nodes.

    Parameters
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure [Pa].
    u : ndarray, shape (nz, nx, ny)
        Velocity along x [m/s].
    dx : float
        Spacing [m].

    Returns
    -------
    ndarray, shape (nz, nx, ny)
        Upstream difference [Pa/m].

    Examples
    --------
    >>> pressure = np.array([[0.0], [1.0], [4.0], [9.0]])
    >>> upstream_slope(pressure, np.array([1.0, -1.0]).reshape(2, 1, 1), 1.0)[:, 2, 0].tolist()
    [3.0, 5.0]
    """
    rises = np.diff(pressure, axis=0) / dx
    edge = np.zeros_like(pressure[:1])
    return np.where(u > 0.0, np.concatenate([edge, rises]), np.concatenate([rises, edge]))
