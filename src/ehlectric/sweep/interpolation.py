"""Interpolation between the points of a sweep, linear in the axes of a figure, for maps and lines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csr_array
from scipy.spatial import Delaunay, QhullError

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.case import Case
from ehlectric.cases.input_keys import unit_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice

# Approximate number of nodes along each axis of a grid, and number of parts of the edge of a triangle.
# Contour lines are curved on logarithmic axes, and look smooth with these numbers.
_NODES, _PARTS = 160, 6
_POTENTIALS = ("electric.potential_1", "electric.potential_2")

# Smallest voltage between the surfaces that a case allows [V].
_LEAST_VOLTAGE = 1e-6


@dataclass(frozen=True)
class Surface:
    """Triangle mesh between the points of a slice, and the weights that interpolate to its nodes.

    The points are the corners of cells: rectangles of a full grid, or triangles. Each cell is divided into
    triangles of the mesh.

    Attributes
    ----------
    x, y : ndarray, shape (nodes,)
        Positions of the nodes, in SI units.
    triangles : ndarray, shape (triangles, 3)
        Numbers of the nodes of each triangle.
    weights : sparse array, shape (nodes, points)
        Weight of each point of the slice at each node; the weights of a node add up to one.
    corners : ndarray, shape (triangles, 3 or 4)
        Numbers of the points at the corners of the cell that a triangle is part of.
    """

    x: Array
    y: Array
    triangles: IntArray
    weights: csr_array
    corners: IntArray

    def at_nodes(self, values: Array, *, log: bool = False) -> tuple[Array, Mask]:
        """Interpolate values from the points to the nodes.

        Parameters
        ----------
        values : ndarray, shape (points,)
            Values at the points, NaN where a point has none; positive if ``log``.
        log : bool
            Whether the logarithm of the values is linear between the points, instead of the values.

        Returns
        -------
        values : ndarray, shape (nodes,)
            Values at the nodes, finite everywhere, but meaningless outside the triangles of ``whole``.
        whole : ndarray of bool, shape (triangles,)
            Mask of the triangles whose cell has a value at all of its corners.
        """
        known = np.isfinite(values)
        there = np.where(known, values, values[known][0] if np.any(known) else 1.0)
        nodes = np.asarray(self.weights @ (np.log(there) if log else there))
        # Rounding could exceed the values at the points, and so put a probability of 1 outside the colour
        # scale.
        ends = (float(np.min(there)), float(np.max(there)))
        return np.clip(np.exp(nodes) if log else nodes, *ends), self._whole(known)

    def alone(self, values: Array) -> Mask:
        """Mask of the points that have a value, but belong to no cell with a value at all of its corners.

        Parameters
        ----------
        values : ndarray, shape (points,)
            Values at the points, NaN where a point has none.

        Returns
        -------
        ndarray of bool, shape (points,)
            The mask.
        """
        left = np.isfinite(values)
        left[self.corners[self._whole(left)]] = False
        return left

    def _whole(self, known: Mask) -> Mask:
        """Mask of the triangles whose cell has a known value at all of its corners."""
        return np.asarray(np.all(known[self.corners], axis=1))


def surface_of(selection: Slice, *, log_x: bool, log_y: bool) -> Surface | None:
    """Mesh that interpolates between the points of a slice over two varied keys.

    Parameters
    ----------
    selection : Slice
        Slice over ``x`` and ``y``; the values of both are numbers.
    log_x, log_y : bool
        Whether the horizontal and the vertical axis are logarithmic.

    Returns
    -------
    Surface or None
        Bilinear interpolation if the points are a full grid of any spacing, else linear interpolation in a
        Delaunay triangulation of the points. None if the points lie on a line, or differ in further varied
        keys.
    """
    if selection.free:
        return None
    grid = selection.grid()
    if grid is None:
        return _between_points(selection, log_x=log_x, log_y=log_y)
    xs, ys, numbers = grid
    if xs.size < 2 or ys.size < 2:
        return None
    x, cell_x, part_x = _between(xs, log=log_x)
    y, cell_y, part_y = _between(ys, log=log_y)
    i, j = np.divmod(np.arange(x.size * y.size), y.size)
    ends = ((0, 0), (1, 0), (0, 1), (1, 1))
    corners = np.column_stack([numbers[cell_x[i] + p, cell_y[j] + q] for p, q in ends])
    shares = [(part_x if p else 1.0 - part_x)[i] * (part_y if q else 1.0 - part_y)[j] for p, q in ends]
    node = np.arange(i.size).reshape(x.size, y.size)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[1:, :-1], node[:-1, 1:], node[1:, 1:]))
    return Surface(
        x=x[i],
        y=y[j],
        triangles=np.concatenate([np.column_stack([a, b, d]), np.column_stack([a, d, c])]),
        weights=_weights(np.column_stack(shares), corners, len(selection.points)),
        corners=np.concatenate([corners[a], corners[a]]),
    )


def _weights(shares: Array, corners: IntArray, points: int) -> csr_array:
    """Weights of the points at the nodes, shape (nodes, points).

    ``shares`` are the weights of the corners of each node's cell, ``corners`` the numbers of their points;
    both have shape (nodes, corners).
    """
    rows = np.repeat(np.arange(len(corners)), corners.shape[1])
    weights = csr_array((shares.ravel(), (rows, corners.ravel())), shape=(len(corners), points))
    weights.eliminate_zeros()
    return weights


def curve_of(x: Array, values: Array, *, log_x: bool, log: bool) -> tuple[Array, Array]:
    """Interpolate values over increasing x, at the points and at nodes between them.

    Parameters
    ----------
    x : ndarray, shape (points,)
        Increasing positions of at least two points; positive if ``log_x``.
    values : ndarray, shape (points,)
        Values at the points, NaN where a point has none; positive where ``log``.
    log_x : bool
        Whether the nodes are evenly spaced in the logarithm of x.
    log : bool
        Whether the logarithm of the values is linear between the points.

    Returns
    -------
    x, values : ndarray, shape (nodes,)
        Nodes and the values there; NaN between two points of which at least one has no value.

    Examples
    --------
    A power of x on logarithmic axes, between two points:

    >>> x, y = curve_of(np.array([1.0, 4.0]), np.array([1.0, 8.0]), log_x=True, log=True)
    >>> bool(np.allclose(y, x**1.5))
    True
    """
    nodes, cell, part = _between(x, log=log_x)
    ends = _onto(values, log=log)
    between = (1.0 - part) * ends[cell] + part * ends[cell + 1]
    # A node at a point has the value of this point, even if the value of the neighbouring point is NaN.
    at_nodes = np.where(part == 0.0, ends[cell], np.where(part == 1.0, ends[cell + 1], between))
    return nodes, _back(at_nodes, log=log)


def applied_at(results: SweepResults, selection: Slice, along: Array, across: Any) -> Array | None:
    """Exact applied voltage between the points of a slice over a surface potential.

    The applied voltage is an absolute difference of two potentials. It must not be interpolated linearly if
    the potentials cross.

    Parameters
    ----------
    results : SweepResults
        The sweep; its base case has the potentials that do not vary.
    selection : Slice
        Slice of the sweep, with its fixed values.
    along, across : ndarray or float
        Values of ``selection.x`` and ``selection.y``, in SI units.

    Returns
    -------
    ndarray or None
        Applied voltage [V], at least the 1e-6 V that a case allows. None if neither key is a potential, or
        the sweep is one of bearings or drives; the voltage is then interpolated between the points.
    """
    if not isinstance(results.case, Case) or not {selection.x, selection.y} & set(_POTENTIALS):
        return None
    there: dict[Any, Any] = {**selection.at, selection.x: along, selection.y: across}
    electric = results.case.electric
    first = there.get(_POTENTIALS[0], electric.potential_1)
    second = there.get(_POTENTIALS[1], electric.potential_2)
    return np.asarray(np.maximum(np.abs(second - first), _LEAST_VOLTAGE))


def _between(values: Array, *, log: bool) -> tuple[Array, IntArray, Array]:
    """Nodes at and between increasing values, with the number of their cell and their place in it, 0 to 1."""
    parts = max(1, _NODES // values.size)
    cell, step = np.divmod(np.arange((values.size - 1) * parts + 1), parts)
    last = cell == values.size - 1
    cell, part = np.where(last, cell - 1, cell), np.where(last, 1.0, step / parts)
    places = _onto(values, log=log)
    nodes = _back((1.0 - part) * places[cell] + part * places[cell + 1], log=log)
    return nodes, cell, part


def _between_points(selection: Slice, *, log_x: bool, log_y: bool) -> Surface | None:
    """Mesh in the Delaunay triangles of the points, with both axes scaled to the same length."""
    places = np.column_stack(
        [_onto(selection.along, log=log_x), _onto(np.array(selection.across, dtype=float), log=log_y)]
    )
    extent = np.ptp(places, axis=0)
    if np.any(extent == 0.0):
        return None
    try:
        corners = Delaunay(places / extent).simplices
    except (QhullError, ValueError):  # points on a line, or fewer than three
        return None
    steps = [(a, b) for a in range(_PARTS + 1) for b in range(_PARTS + 1 - a)]
    number = {step: k for k, step in enumerate(steps)}
    share = np.array([(_PARTS - a - b, a, b) for a, b in steps]) / _PARTS
    small = [(number[a, b], number[a + 1, b], number[a, b + 1]) for a, b in steps if a + b < _PARTS]
    small += [
        (number[a + 1, b], number[a + 1, b + 1], number[a, b + 1]) for a, b in steps if a + b < _PARTS - 1
    ]
    first = len(steps) * np.arange(len(corners))
    weights = _weights(
        np.tile(share, (len(corners), 1)), np.repeat(corners, len(steps), axis=0), len(selection.points)
    )
    nodes = np.asarray(weights @ places)
    return Surface(
        x=_back(nodes[:, 0], log=log_x),
        y=_back(nodes[:, 1], log=log_y),
        triangles=(first[:, np.newaxis, np.newaxis] + np.array(small)).reshape(-1, 3),
        weights=weights,
        corners=np.repeat(corners, len(small), axis=0),
    )


def spaced_log(results: SweepResults, key: str, values: Array) -> bool:
    """Whether a varied key is drawn on a logarithmic axis.

    Parameters
    ----------
    results : SweepResults
        The sweep.
    key : str
        Varied key.
    values : ndarray
        Values of the key at the points, in SI units.

    Returns
    -------
    bool
        In a "sobol" design, True if the range of the key has logarithmic spacing. In other designs, True if
        the logarithms of the values are more evenly spaced than the values. False for temperatures, which
        figures show in °C.
    """
    if unit_of(key) == "K":
        return False
    if key in results.ranges:
        return results.ranges[key].spacing == "log"
    axis = np.unique(values)
    if axis.size < 3 or axis[0] <= 0.0:
        return False
    even, ratios = np.diff(axis), np.diff(np.log(axis))
    return bool(np.std(ratios) / np.mean(ratios) < 0.999 * np.std(even) / np.mean(even))


def _onto(values: Array, *, log: bool) -> Array:
    """Values, or their logarithms, in which the interpolation is linear."""
    return np.log(values) if log else values


def _back(places: Array, *, log: bool) -> Array:
    """Values from the result of ``_onto``."""
    return np.exp(places) if log else places
