"""The field of a contact as a discharge sees it: how much of the strength is used, and where first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.columns import at_columns, axes_of
from ehlectric.discharge.laws import BREAKING
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.poisson import ATOM
from ehlectric.field.zones import areas, interval_above, lobe_above
from ehlectric.film.line import Film


@dataclass(frozen=True)
class FieldUtilisation:
    """Field strength of a contact beside the dielectric strength of its film.

    Attributes
    ----------
    strength, dielectric_strength : ndarray, shape (nx,) or (nx, ny)
        Largest field strength of each column of the solved field, and the dielectric strength there [V/m]; 1
        V/m where the case gives none, or a Weibull law.
    position : tuple of float
        Place where the strength is used most [m].
    extent : float
        Width [m], or of a point contact area [m^2], of the zone around it where it is used to 95 % of that or
        more.
    over_domain, areas : ndarray, shape (n,)
        Field strength over the whole domain of the film, that of a thin gap where no field was solved [V/m],
        and the area of each part [m^2]; of a line contact the width [m].
    """

    strength: Array
    dielectric_strength: Array
    position: tuple[float, ...]
    extent: float
    over_domain: Array
    areas: Array

    @property
    def dielectric_strength_there(self) -> float:
        """Dielectric strength where it is used most [V/m]."""
        return float(self.dielectric_strength.flat[np.argmax(self.strength / self.dielectric_strength)])

    @classmethod
    def of(cls, given: Discharge, film: Film, field: Field | PointField) -> FieldUtilisation:
        """Utilisation of the strength in a solved contact."""
        strength, columns = field.column_strength, axes_of(field)
        limit = dielectric_strength(given, at_columns(film, field, film.pressure))
        used = strength / limit
        level = BREAKING * float(np.max(used))
        if isinstance(field, PointField):
            extent = lobe_above(field.x, field.y, used, level)
        else:
            start, stop = interval_above(field.x, used, level)
            extent = stop - start
        place = np.unravel_index(np.argmax(used), used.shape)
        thin = field.voltage / np.maximum(film.thickness, ATOM)
        around = areas(axes_of(film)) - areas(axes_of(film), columns)
        return cls(
            strength=strength,
            dielectric_strength=limit,
            position=tuple(float(axis[k]) for axis, k in zip(columns, place, strict=True)),
            extent=extent,
            over_domain=np.concatenate([strength.ravel(), thin.ravel()]),
            areas=np.concatenate([areas(columns).ravel(), around.ravel()]),
        )


def dielectric_strength(given: Discharge, pressure: Array) -> Array:
    """Dielectric strength of a film.

    Parameters
    ----------
    given : Discharge
        What the case gives: a strength, a table of it over pressure or temperature, or none of them.
    pressure : ndarray, shape (...)
        Pressure in the film [Pa].

    Returns
    -------
    ndarray, shape (...)
        [V/m]; a table is linear in between and holds its ends, and without a strength it is 1 V/m.

    Examples
    --------
    >>> table = {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "25 V/um"]}
    >>> given = Discharge.from_dict({"strength_table": table})
    >>> dielectric_strength(given, np.array([0.0, 0.5e9, 2e9])).tolist()
    [15000000.0, 20000000.0, 25000000.0]
    """
    table = given.strength_table
    if table is None:
        return np.full_like(pressure, 1.0 if given.dielectric_strength is None else given.dielectric_strength)
    at = pressure if table.over == "pressure" else np.full_like(pressure, given.temperature)
    strength: Array = np.interp(at, table.places, table.strength)
    return strength
