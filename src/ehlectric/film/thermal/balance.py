"""Balance of heat over the whole film, by integration over every column."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.thermal.columns import Stream
from ehlectric.film.thermal.energy import Heat


def energy_imbalance(stream: Stream, heat: Heat, inlet_temperature: float) -> float:
    """Heat that neither the bodies nor the oil take up, over the heat that is made.

    Parameters
    ----------
    stream : Stream
        Flow and sources of the film.
    heat : Heat
        Temperature and heat flow into the bodies.
    inlet_temperature : float
        Temperature of the oil that enters [K].

    Returns
    -------
    float
        Relative imbalance, >= 0. Heat and cold of compression count with their size.

    Notes
    -----
    The heat that the oil carries is the flow of c (T - T_inlet) through the edges of the grid, less what the
    change of c along the way takes up. Nothing here uses the discrete equations of the columns.
    """
    weights = stream.across.weights[:, np.newaxis, np.newaxis]
    filled = weights * stream.filling * stream.thickness
    area = _trapezoid(stream.u.shape[1], stream.dx)[:, np.newaxis] * _lines(stream)
    compression = stream.compression * heat.temperature
    made = np.sum(filled * (stream.heating + compression), axis=0)
    size = np.sum(filled * (stream.heating + np.abs(compression)), axis=0)
    rise = heat.temperature - inlet_temperature
    carried = filled * stream.heat_capacity
    # div(c m (T - T0)) with the mass flow m, less (T - T0) m grad c
    specific = stream.heat_capacity / stream.density
    through = np.sum(carried * stream.u * rise, axis=0)
    out = float(np.sum(_lines(stream) * (through[-1] - through[0])))
    slope = np.gradient(specific, stream.dx, axis=1) * stream.u
    if stream.dy:
        slope += np.gradient(specific, stream.dy, axis=2) * stream.v
        sides = np.sum(carried * stream.v * rise, axis=0)
        along = _trapezoid(stream.u.shape[1], stream.dx)
        left = 0.0 if stream.symmetric else float(along @ sides[:, 0])
        out += (2.0 if stream.symmetric else 1.0) * float(along @ sides[:, -1]) - left
    changed = np.sum(filled * stream.density * slope * rise, axis=0)
    into_bodies = heat.flux.sum(axis=0)
    left_over = float(np.sum(area * (made - into_bodies + changed))) - out
    return abs(left_over) / max(float(np.sum(area * size)), 1e-300)


def _trapezoid(count: int, spacing: float) -> Array:
    weights = np.full(count, spacing)
    weights[[0, -1]] *= 0.5
    return weights


def _lines(stream: Stream) -> Array:
    """Weights of the integral across the contact, with the half y < 0 of a symmetric one."""
    if not stream.dy:
        return np.ones(1)
    return _trapezoid(stream.u.shape[2], (2.0 if stream.symmetric else 1.0) * stream.dy)
