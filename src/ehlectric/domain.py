"""The domain of a film and the part of it where the field was solved: their nodes, areas and zones."""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from ehlectric.field import Field
from ehlectric.film import Film
from ehlectric.point_field import PointField
from ehlectric.point_film import PointFilm
from ehlectric.typing import Array
from ehlectric.zones import Zone, part_widths, zone_areas

# Nodes along x, and of a point contact along y [m].
Axes = tuple[Array, ...]


def axes_of(part: Film | Field | PointField) -> Axes:
    """Nodes of a film or columns of a field along its axes [m]."""
    return (part.x, part.y) if isinstance(part, PointFilm | PointField) else (part.x,)


def areas(axes: Axes, within: Axes | None = None) -> Array:
    """Area of each node's part of the domain; of a line its width.

    Parameters
    ----------
    axes : tuple of ndarray
        Nodes [m].
    within : tuple of ndarray, optional
        Other nodes [m]: only what lies between their ends counts.

    Returns
    -------
    ndarray, shape (nx,) or (nx, ny)
        [m] or [m^2].

    Examples
    --------
    >>> areas((np.array([0.0, 1.0, 2.0]),), (np.array([0.0, 1.0]),)).tolist()
    [0.5, 0.5, 0.0]
    """
    ends = [(-np.inf, np.inf)] * len(axes) if within is None else [(axis[0], axis[-1]) for axis in within]
    widths = [part_widths(axis, *end) for axis, end in zip(axes, ends, strict=True)]
    area: Array = reduce(np.multiply.outer, widths)
    return area


def at_columns(film: Film, field: Field | PointField, values: Array) -> Array:
    """Values at the nodes of a film at the columns of its field, linear in between."""
    nodes = axes_of(film)
    # A column at the edge of the domain may lie outside it by rounding.
    columns = [np.clip(at, axis[0], axis[-1]) for at, axis in zip(axes_of(field), nodes, strict=True)]
    found: Array = RegularGridInterpolator(nodes, values)(tuple(np.meshgrid(*columns, indexing="ij")))
    return found


def contact_zones(semi_axis_x: float, semi_axis_y: float) -> dict[str, Zone]:
    """Parts of a point contact that share it out.

    The Hertz ellipse; before it and behind it the strip as wide as the ellipse, its inlet and its outlet; and
    the sides beyond that strip.

    Parameters
    ----------
    semi_axis_x, semi_axis_y : float
        b along and a across entrainment [m].

    Returns
    -------
    dict of callable
        "hertz", "inlet", "outlet" and "sides": whether points x, y [m] are inside.

    Examples
    --------
    >>> zones = contact_zones(1e-4, 2e-4)
    >>> [name for name, zone in zones.items() if zone(np.array([-2e-4]), np.array([1e-4]))[0]]
    ['inlet']
    """
    b, a = semi_axis_x, semi_axis_y

    def hertz(x: Array, y: Array) -> Any:
        return (x / b) ** 2 + (y / a) ** 2 <= 1.0

    return {
        "hertz": hertz,
        "inlet": lambda x, y: ~hertz(x, y) & (np.abs(y) <= a) & (x < 0.0),
        "outlet": lambda x, y: ~hertz(x, y) & (np.abs(y) <= a) & (x >= 0.0),
        "sides": lambda x, y: ~hertz(x, y) & (np.abs(y) > a),
    }


def line_zone_areas(axes: Axes, half_width: float) -> dict[str, Array]:
    """Width of each node's part of a line contact's zones [m]: "hertz", abs(x) <= b, "inlet" and "outlet"."""
    (x,) = axes
    return {
        "hertz": part_widths(x, -half_width, half_width),
        "inlet": part_widths(x, -np.inf, -half_width),
        "outlet": part_widths(x, half_width, np.inf),
    }


def point_zone_areas(axes: Axes, semi_axis_x: float, semi_axis_y: float) -> dict[str, Array]:
    """Area of each node's part of the ``contact_zones`` [m^2]."""
    x, y = axes
    zones = contact_zones(semi_axis_x, semi_axis_y)
    return {name: zone_areas(x, y, zone) for name, zone in zones.items()}
