"""The domain of a film and the part of it where the field was solved: their nodes, areas and zones."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.arrays import Array
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.zones import Axes
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm


def axes_of(part: Film | Field | PointField) -> Axes:
    """Nodes of a film or columns of a field along its axes [m]."""
    return (part.x, part.y) if isinstance(part, PointFilm | PointField) else (part.x,)


def at_columns(film: Film, field: Field | PointField, values: Array) -> Array:
    """Values at the nodes of a film at the columns of its field, linear in between."""
    nodes = axes_of(film)
    # A column at the edge of the domain may lie outside it by rounding.
    columns = [np.clip(at, axis[0], axis[-1]) for at, axis in zip(axes_of(field), nodes, strict=True)]
    found: Array = RegularGridInterpolator(nodes, values)(tuple(np.meshgrid(*columns, indexing="ij")))
    return found
