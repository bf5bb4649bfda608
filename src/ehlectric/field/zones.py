"""Widths and areas of the zones of a contact, resolved more finely than the cells of its grid."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask

# Nodes along x and, for a point contact, along y [m].
Axes = tuple[Array, ...]

# Smallest gap in the field problem [m], the size of an atom; thinner gaps are replaced by it.
ATOM = 1e-10

# In the high-field zone the field strength is at least this fraction of its maximum.
HIGH_FIELD = 0.95

# Sample points per cell and axis. The error of a zone's area is about 1 % of the area of the cells that its
# boundary cuts.
SAMPLES = 8

# Zone of a point contact: a function of points x, y [m] that returns which of them are inside.
Zone = Callable[[Array, Array], NDArray[Any]]


def areas(axes: Axes, within: Axes | None = None) -> Array:
    """Area that belongs to each node of a grid, or width for a grid along one axis.

    They are the weights of the trapezoidal rule.

    ``axes``, nodes along each axis [m]; ``within``, positions along each axis [m]. Returns widths [m] or
    areas [m^2], shape (nx,) or (nx, ny).

    Examples
    --------
    >>> areas((np.array([0.0, 1.0, 2.0]),), (np.array([0.0, 1.0]),)).tolist()
    [0.5, 0.5, 0.0]
    """
    ends = [(-np.inf, np.inf)] * len(axes) if within is None else [(axis[0], axis[-1]) for axis in within]
    widths = [part_widths(axis, *end) for axis, end in zip(axes, ends, strict=True)]
    return reduce(np.multiply.outer, widths)


def contact_zones(semi_axis_x: float, semi_axis_y: float) -> dict[str, Zone]:
    """Zones of a point contact: the Hertz ellipse, the inlet, the outlet and the sides.

    Inlet and outlet are the strip before and behind the ellipse, as wide as the ellipse. The sides lie beyond
    this strip. Together the zones cover the plane without overlap.

    ``semi_axis_x`` and ``semi_axis_y``, semi-axes of the Hertz ellipse [m], b along and a across entrainment.
    Returns zones "hertz", "inlet", "outlet" and "sides": functions of points x, y [m] that return which are
    inside.

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
    """Width that belongs to each node of a line contact, split by zone [m], each of shape (nx,).

    The zones are "hertz", where abs(x) is at most ``half_width`` [m], "inlet" and "outlet".
    """
    (x,) = axes
    return {
        "hertz": part_widths(x, -half_width, half_width),
        "inlet": part_widths(x, -np.inf, -half_width),
        "outlet": part_widths(x, half_width, np.inf),
    }


def point_zone_areas(axes: Axes, semi_axis_x: float, semi_axis_y: float) -> dict[str, Array]:
    """Area that belongs to each node of a point contact, split by zone [m^2], each of shape (nx, ny).

    The zones are ``contact_zones`` of a Hertz ellipse with these semi-axes [m].
    """
    x, y = axes
    zones = contact_zones(semi_axis_x, semi_axis_y)
    return {name: zone_areas(x, y, zone) for name, zone in zones.items()}


def areas_by_zone(axes: Axes, semi_axes: tuple[float, ...]) -> dict[str, Array]:
    """Width [m] or area [m^2] of each node, split by zone, of a contact with one semi-axis or two [m]."""
    return line_zone_areas(axes, *semi_axes) if len(semi_axes) == 1 else point_zone_areas(axes, *semi_axes)


def part_widths(x: Array, start: float, stop: float) -> Array:
    """Width that belongs to each node of a line between two positions.

    The sum of nodal values times these widths is the integral of their linear interpolant from ``start`` to
    ``stop``.

    ``x``, positions of the nodes, increasing [m], shape (nx,); ``start`` and ``stop``, ends of the interval
    [m]. Returns widths [m], shape (nx,).

    Examples
    --------
    >>> part_widths(np.array([0.0, 1.0, 2.0]), 0.5, np.inf)
    array([0.125, 0.875, 0.5  ])
    """
    dx = np.diff(x)
    left, right = np.clip(x[:-1], start, stop), np.clip(x[1:], start, stop)
    to_right = (right - left) * (0.5 * (left + right) - x[:-1]) / dx
    widths = np.append(right - left - to_right, 0.0)
    widths[1:] += to_right
    return widths


def interval_above(x: Array, values: Array, level: float) -> tuple[float, float]:
    """Ends of the contiguous interval around the maximum where values are at least ``level``. ``x`` and
    ``values``, positions of the nodes [m], and values there, in any unit, shape (nx,); ``level``, level in
    the unit of ``values``, at most their maximum. Returns ends of the interval, interpolated between nodes
    [m].

    Examples
    --------
    >>> interval_above(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 0.0]), 0.5)
    (0.5, 1.5)
    """
    peak = int(np.argmax(values))
    below = np.flatnonzero(values < level)
    left, right = below[below < peak], below[below > peak]

    def crossing(outside: int, inside: int) -> float:
        share = (level - values[outside]) / (values[inside] - values[outside])
        return float(x[outside] + share * (x[inside] - x[outside]))

    start = crossing(left[-1], left[-1] + 1) if left.size else float(x[0])
    stop = crossing(right[0], right[0] - 1) if right.size else float(x[-1])
    return start, stop


def node_areas(x: Array, y: Array) -> Array:
    """Area that belongs to each node of a map [m^2], shape (nx, ny): the weights of the trapezoidal rule.

    ``x`` (nx,) and ``y`` (ny,) are the positions of the nodes [m].

    Examples
    --------
    >>> node_areas(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0]))
    array([[0.5, 0.5],
           [1.5, 1.5],
           [1. , 1. ]])
    """
    widths = []
    for at in (x, y):
        halves = 0.5 * np.diff(at)
        widths.append(np.append(halves, 0.0) + np.append(0.0, halves))
    return np.outer(*widths)


def zone_areas(x: Array, y: Array, zone: Zone) -> Array:
    """Area that belongs to each node of a map, of the part inside a zone.

    The sum of nodal values times these areas approximates the integral over the zone.

    ``x`` and ``y``, positions of the nodes [m], shapes (nx,); ``zone``, function of two arrays x, y [m] of
    one shape. Returns areas [m^2], shape (nx, ny).

    Each cell is sampled at 8 x 8 points, and the area of a sample inside the zone is shared among the four
    corners by bilinear weights. For zones that cover the plane without overlap the areas add up to
    ``node_areas``, except for rounding.

    Examples
    --------
    A quarter of a unit disc has the area pi/4:

    >>> x = np.linspace(0.0, 1.0, 65)
    >>> round(float(np.sum(zone_areas(x, x, lambda x, y: x**2 + y**2 < 1.0))), 4)
    0.7854
    """
    at = (np.arange(SAMPLES) + 0.5) / SAMPLES
    dx, dy = np.diff(x), np.diff(y)
    areas = np.zeros((x.size, y.size))
    columns = (y[:-1, np.newaxis] + dy[:, np.newaxis] * at).ravel()
    # One line of samples of every cell at a time: all samples would take 64 times the memory of a map.
    for share in at:
        inside = zone(*np.meshgrid(x[:-1] + share * dx, columns, indexing="ij"))
        sampled = np.asarray(inside, dtype=bool).reshape(dx.size, dy.size, SAMPLES)
        cell = np.outer(dx, dy) / SAMPLES**2
        for corner, parts in ((0, 1.0 - at), (1, at)):
            part = cell * (sampled @ parts)
            side = slice(corner, corner + dy.size)
            areas[:-1, side] += (1.0 - share) * part
            areas[1:, side] += share * part
    return areas


def area_above(x: Array, y: Array, values: Array, level: float) -> float:
    """Area where the values of a map are at least ``level``. ``x`` and ``y``, positions of the nodes [m],
    shapes (nx,); ``values``, values of the map at the nodes, in any unit, shape (nx, ny); ``level``, level in
    the unit of ``values``, at most their maximum. Returns area [m^2].

    Each cell is divided into four triangles between its sides and its middle, and the map is linear in each
    of them. The area converges with the square of the grid spacing.

    Examples
    --------
    Area of a cone above half its height:

    >>> x = np.linspace(-1.0, 1.0, 201)
    >>> cone = 1.0 - np.hypot(x[:, np.newaxis], x)
    >>> round(area_above(x, x, cone, 0.5) / np.pi, 4)
    0.25
    """
    region: Mask = values >= level
    above = values - level
    corners = [slice(None, -1), slice(1, None)]
    # Corners in their order around the cell.
    ring = [(corners[i], corners[j]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    touched = np.any([region[corner] for corner in ring], axis=0)
    cells = np.outer(np.diff(x), np.diff(y))[touched]
    ends = [above[corner][touched] for corner in ring]
    middle = np.mean(ends, axis=0)
    parts = [_positive_part(ends[k - 1], ends[k], middle) for k in range(4)]
    return float(np.sum(0.25 * cells * np.sum(parts, axis=0)))


def lobe_above(x: Array, y: Array, values: Array, level: float) -> float:
    """Area of the connected region around the maximum of a map where its values are at least ``level``. ``x``
    and ``y``, positions of the nodes [m], shapes (nx,); ``values``, values of the map at the nodes, in any
    unit, shape (nx, ny); ``level``, level in the unit of ``values``, at most their maximum. Returns area
    [m^2].

    Examples
    --------
    Two cones of unit base radius; only the higher one counts, above half of its height:

    >>> x = np.linspace(-1.0, 1.0, 201)
    >>> lower = 0.9 - np.hypot(x[:, np.newaxis], x)
    >>> cones = np.concatenate([lower + 0.1, lower])
    >>> wide = np.concatenate([x, x + 2.01])
    >>> round(lobe_above(wide, x, cones, 0.5) / np.pi, 4)
    0.25
    """
    parts, _ = scipy.ndimage.label(values >= level, structure=np.ones((3, 3)))
    others = (parts > 0) & (parts != parts.flat[np.argmax(values)])
    return area_above(x, y, np.where(others, 2.0 * level - values, values), level)


def _positive_part(a: Array, b: Array, c: Array) -> Array:
    """Fraction of a triangle where a linear function is not negative; a, b and c are its corner values."""
    low, mid, high = np.sort([a, b, c], axis=0)
    part = np.where(low >= 0.0, 1.0, 0.0)
    only_low_negative = (low < 0.0) & (mid >= 0.0)
    tip = (low[only_low_negative] - mid[only_low_negative]) * (
        low[only_low_negative] - high[only_low_negative]
    )
    part[only_low_negative] = 1.0 - low[only_low_negative] ** 2 / tip
    only_high_positive = (mid < 0.0) & (high >= 0.0)
    tip = (high[only_high_positive] - mid[only_high_positive]) * (
        high[only_high_positive] - low[only_high_positive]
    )
    part[only_high_positive] = high[only_high_positive] ** 2 / tip
    return part
