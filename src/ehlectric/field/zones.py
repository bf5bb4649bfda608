"""Parts of a line or a map, finer than its cells, and the zones of a contact."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from ehlectric.arrays import Array, Mask

# Nodes along x, and of a point contact along y [m].
Axes = tuple[Array, ...]

# The zone of high field is where the field is at least this part of its maximum.
HIGH_FIELD = 0.95

# Sample points of a zone by cell and direction: its area is right to about a hundredth of the cells it cuts.
SAMPLES = 8

# Whether points (x, y) [m] are inside.
Zone = Callable[[Array, Array], NDArray[Any]]


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


def part_widths(x: Array, start: float, stop: float) -> Array:
    """Width of each node's part of a line that is between two places.

    Parameters
    ----------
    x : ndarray, shape (nx,)
        Nodes, increasing [m].
    start, stop : float
        Places; beyond the nodes there is nothing [m].

    Returns
    -------
    ndarray, shape (nx,)
        Times nodal values they give the integral of the linear interpolant from ``start`` to ``stop``.

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
    """Ends of the contiguous interval around the maximum where values are at least a level.

    Parameters
    ----------
    x, values : ndarray, shape (nx,)
        Positions [m] and values, linear in between.
    level : float
        Not above the maximum.

    Returns
    -------
    start, stop : float
        Interpolated between nodes [m].

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
    """Area of each node's part of the map, shape (nx, ny): the weights of the trapezoidal rule.

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
    areas: Array = np.outer(*widths)
    return areas


def zone_areas(x: Array, y: Array, zone: Zone) -> Array:
    """Area of each node's part of the map that is inside a zone.

    Parameters
    ----------
    x, y : ndarray, shapes (nx,), (ny,)
        Nodes [m].
    zone : callable
        Whether the points of two arrays x, y [m] of one shape are inside, as an array of that shape.

    Returns
    -------
    ndarray, shape (nx, ny)
        Times nodal values they give the integral over the zone [m^2]: the cells are sampled, and each
        sample counts for the corners by bilinear shares. Zones that share out the plane add up to
        ``node_areas`` to rounding.

    Examples
    --------
    A quarter of a unit disc.

    >>> x = np.linspace(0.0, 1.0, 65)
    >>> round(float(np.sum(zone_areas(x, x, lambda x, y: x**2 + y**2 < 1.0))), 4)
    0.7854
    """
    at = (np.arange(SAMPLES) + 0.5) / SAMPLES
    dx, dy = np.diff(x), np.diff(y)
    areas = np.zeros((x.size, y.size))
    columns = (y[:-1, np.newaxis] + dy[:, np.newaxis] * at).ravel()
    for share in at:  # a fine line of each cell at a time: all samples would take 64 times a map's memory
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
    """Area where a map is at least a level.

    Parameters
    ----------
    x, y : ndarray, shapes (nx,), (ny,)
        Nodes [m].
    values : ndarray, shape (nx, ny)
        The map.
    level : float
        Not above its maximum.

    Returns
    -------
    float
        Area [m^2]. The map is taken as linear over the four triangles between the corners of a cell and its
        middle, so that the area converges with the square of the spacing.

    Examples
    --------
    A cone above half its height.

    >>> x = np.linspace(-1.0, 1.0, 201)
    >>> cone = 1.0 - np.hypot(x[:, np.newaxis], x)
    >>> round(area_above(x, x, cone, 0.5) / np.pi, 4)
    0.25
    """
    region: Mask = values >= level
    above = values - level
    corners = [slice(None, -1), slice(1, None)]
    # Counted around the cell.
    ring = [(corners[i], corners[j]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    touched = np.any([region[corner] for corner in ring], axis=0)
    cells = np.outer(np.diff(x), np.diff(y))[touched]
    ends = [above[corner][touched] for corner in ring]
    middle = np.mean(ends, axis=0)
    parts = [_positive_part(ends[k - 1], ends[k], middle) for k in range(4)]
    return float(np.sum(0.25 * cells * np.sum(parts, axis=0)))


def lobe_above(x: Array, y: Array, values: Array, level: float) -> float:
    """Area of the one connected part around the maximum of a map where it is at least a level.

    Parameters
    ----------
    x, y, values, level
        As of ``area_above``.

    Returns
    -------
    float
        Area [m^2].

    Examples
    --------
    Of two cones with a unit base, the higher one above half of its height:

    >>> x = np.linspace(-1.0, 1.0, 201)
    >>> lower = 0.9 - np.hypot(x[:, np.newaxis], x)
    >>> cones = np.concatenate([lower + 0.1, lower])
    >>> wide = np.concatenate([x, x + 2.01])
    >>> round(lobe_above(wide, x, cones, 0.5) / np.pi, 4)
    0.25
    """
    parts, _ = label(values >= level, structure=np.ones((3, 3)))
    others = (parts > 0) & (parts != parts.flat[np.argmax(values)])
    return area_above(x, y, np.where(others, 2.0 * level - values, values), level)


def _positive_part(a: Array, b: Array, c: Array) -> Array:
    """Part of a triangle's area where a linear function, a, b and c at its corners, is not negative."""
    low, mid, high = np.sort([a, b, c], axis=0)
    part = np.where(low >= 0.0, 1.0, 0.0)
    one_below = (low < 0.0) & (mid >= 0.0)
    tip = (low[one_below] - mid[one_below]) * (low[one_below] - high[one_below])
    part[one_below] = 1.0 - low[one_below] ** 2 / tip
    one_above = (mid < 0.0) & (high >= 0.0)
    tip = (high[one_above] - mid[one_above]) * (high[one_above] - low[one_above])
    part[one_above] = high[one_above] ** 2 / tip
    return part
