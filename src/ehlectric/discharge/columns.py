"""Interpolation of values from the nodes of a film to the columns of its field."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


def at_columns(film: Film | PointFilm, field: Field | PointField, values: Array) -> Array:
    """Interpolate values linearly from the nodes of a film to the columns of its field."""
    # A column at the edge of the domain may be outside it because of rounding.
    columns = [np.clip(at, axis[0], axis[-1]) for at, axis in zip(field.axes, film.axes, strict=True)]
    interpolated = RegularGridInterpolator(film.axes, values)
    values_at_columns: Array = interpolated(tuple(np.meshgrid(*columns, indexing="ij")))
    return values_at_columns
