"""Utilisation of the dielectric strength by the field of a contact, and the position of its maximum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.columns import at_columns
from ehlectric.discharge.laws import BREAKING
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.poisson import ATOM
from ehlectric.field.zones import areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


@dataclass(frozen=True)
class FieldUtilisation:
    """Utilisation of the dielectric strength: the ratio of field strength to dielectric strength.

    Attributes
    ----------
    strength : ndarray, shape (nx,) or (nx, ny)
        Largest field strength of each column of the solved field, on either wall or at mid-film [V/m].
    dielectric_strength : ndarray, shape (nx,) or (nx, ny)
        Dielectric strength at each column [V/m]; 1 V/m if the case gives none, or gives a Weibull law.
    position : tuple of float
        Position of the largest utilisation, (x,) or (x, y) [m].
    extent : float
        Width [m], or area [m^2] for a point contact, of the zone around ``position`` where the utilisation
        is at least 95 % of its maximum.
    over_domain : ndarray, shape (n,)
        Field strength over the whole domain of the film [V/m]; outside the field range that of a thin gap.
    areas : ndarray, shape (n,)
        Area that each value of ``over_domain`` stands for [m^2]; for a line contact the width [m].
    """

    strength: Array
    dielectric_strength: Array
    position: tuple[float, ...]
    extent: float
    over_domain: Array
    areas: Array

    @property
    def dielectric_strength_there(self) -> float:
        """Dielectric strength at the position of the largest utilisation [V/m]."""
        return float(self.dielectric_strength.flat[np.argmax(self.strength / self.dielectric_strength)])

    @classmethod
    def of(cls, discharge: Discharge, film: Film | PointFilm, field: Field | PointField) -> FieldUtilisation:
        """Utilisation of the dielectric strength in a solved contact."""
        strength, columns = field.column_strength, field.axes
        warm = None if film.temperature is None else at_columns(film, field, film.temperature)
        limit = dielectric_strength(discharge, at_columns(film, field, film.pressure), warm)
        utilisation = strength / limit
        place = np.unravel_index(np.argmax(utilisation), utilisation.shape)
        thin = field.voltage / np.maximum(film.thickness, ATOM)
        around = areas(film.axes) - areas(film.axes, columns)
        return cls(
            strength=strength,
            dielectric_strength=limit,
            position=tuple(float(axis[k]) for axis, k in zip(columns, place, strict=True)),
            extent=field.extent_above(utilisation, BREAKING * float(np.max(utilisation))),
            over_domain=np.concatenate([strength.ravel(), thin.ravel()]),
            areas=np.concatenate([areas(columns).ravel(), around.ravel()]),
        )


def dielectric_strength(discharge: Discharge, pressure: Array, temperature: Array | None = None) -> Array:
    """Dielectric strength of a film at given pressures.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge: a constant strength, a table over pressure or temperature, or neither.
    pressure : ndarray, shape (...)
        Pressure in the film [Pa].
    temperature : ndarray, shape (...), optional
        Temperature in a film with heat [K], in place of that of the discharge.

    Returns
    -------
    ndarray, shape (...)
        Dielectric strength [V/m]. A table is interpolated linearly, and its end values hold beyond its ends.
        If the case gives neither a constant nor a table, it is 1 V/m.

    Examples
    --------
    >>> table = {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "25 V/um"]}
    >>> discharge = Discharge.from_dict({"strength_table": table})
    >>> dielectric_strength(discharge, np.array([0.0, 0.5e9, 2e9])).tolist()
    [15000000.0, 20000000.0, 25000000.0]
    """
    table = discharge.strength_table
    if table is None:
        constant = discharge.dielectric_strength
        return np.full_like(pressure, 1.0 if constant is None else constant)
    warm = np.full_like(pressure, discharge.temperature) if temperature is None else temperature
    at = pressure if table.over == "pressure" else warm
    strength: Array = np.interp(at, table.places, table.strength)
    return strength
