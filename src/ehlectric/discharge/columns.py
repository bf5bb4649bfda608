"""Values of a film at the columns of its field."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


def at_columns(film: Film | PointFilm, field: Field | PointField, values: Array) -> Array:
    """Values at the nodes of a film at the columns of its field, linear in between."""
    # A column at the edge of the domain may lie outside it by rounding.
    columns = [np.clip(at, axis[0], axis[-1]) for at, axis in zip(field.axes, film.axes, strict=True)]
    interpolated = RegularGridInterpolator(film.axes, values)
    at_them: Array = interpolated(tuple(np.meshgrid(*columns, indexing="ij")))
    return at_them
