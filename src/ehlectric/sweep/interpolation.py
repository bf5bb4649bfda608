"""Between the points of a sweep: linear in the axes a figure has, with holes where points have no value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.sparse import csr_array
from scipy.spatial import Delaunay, QhullError

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice

# Nodes along either axis of a grid, about, and parts of the edge of a triangle: enough for lines of equal
# value to look as curved as they are on logarithmic axes.
_NODES, _PARTS = 160, 6
_POTENTIALS = ("electric.potential_1", "electric.potential_2")

# A case takes no less between its surfaces [V].
_LEAST_VOLTAGE = 1e-6


@dataclass(frozen=True)
class Surface:
    """Nodes between the points of a slice, and triangles of them.

    Attributes
    ----------
    x, y : ndarray, shape (nodes,)
        Position of the nodes, SI.
    triangles : ndarray, shape (triangles, 3)
        Numbers of their nodes.
    weights : sparse array, shape (nodes, points)
        What each point of the slice counts at a node; the weights of a node add up to one.
    corners : ndarray, shape (triangles, 3 or 4)
        Numbers of the points around the cell that a triangle is a part of.
    """

    x: Array
    y: Array
    triangles: IntArray
    weights: csr_array
    corners: IntArray

    def at_nodes(self, values: Array, *, log: bool = False) -> tuple[Array, Mask]:
        """A value of the points between them.

        Parameters
        ----------
        values : ndarray, shape (points,)
            Not a number where there is none; above 0 where ``log``.
        log : bool
            Whether the logarithm is linear between the points.

        Returns
        -------
        values : ndarray, shape (nodes,)
            Finite, but of no meaning where no cell around is whole.
        whole : ndarray, shape (triangles,)
            Which triangles are part of a cell that has the value at all of its corners.
        """
        known = np.isfinite(values)
        there = np.where(known, values, values[known][0] if np.any(known) else 1.0)
        nodes = np.asarray(self.weights @ (np.log(there) if log else there))
        # No further than the points themselves: rounding would take a probability of 1 out of its colours.
        ends = (float(np.min(there)), float(np.max(there)))
        return np.clip(np.exp(nodes) if log else nodes, *ends), self._whole(known)

    def alone(self, values: Array) -> Mask:
        """Which points have a value, but no cell around them has it at all of its corners.

        Parameters
        ----------
        values : ndarray, shape (points,)
            Not a number where there is none.
        """
        left = np.isfinite(values)
        left[self.corners[self._whole(left)]] = False
        return left

    def _whole(self, known: Mask) -> Mask:
        return np.asarray(np.all(known[self.corners], axis=1))


def surface_of(taken: Slice, *, log_x: bool, log_y: bool) -> Surface | None:
    """Nodes between the points of a slice over two varied keys.

    Parameters
    ----------
    taken : Slice
        Of numbers over ``x`` and ``y``.
    log_x, log_y : bool
        Whether that axis is logarithmic.

    Returns
    -------
    Surface or None
        Bilinear on a full grid, however it is spaced; linear on Delaunay's triangles otherwise. None where
        the points lie on a line, or depend on varied keys that are not held.
    """
    if taken.free:
        return None
    grid = taken.grid()
    if grid is None:
        return _between_points(taken, log_x=log_x, log_y=log_y)
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
        weights=_weights(np.column_stack(shares), corners, len(taken.points)),
        corners=np.concatenate([corners[a], corners[a]]),
    )


def _weights(shares: Array, corners: IntArray, points: int) -> csr_array:
    """What each point counts at each node: shares of the corners of its cell, shape (nodes, corners) both."""
    rows = np.repeat(np.arange(len(corners)), corners.shape[1])
    weights = csr_array((shares.ravel(), (rows, corners.ravel())), shape=(len(corners), points))
    weights.eliminate_zeros()
    return weights


def curve_of(x: Array, values: Array, *, log_x: bool, log: bool) -> tuple[Array, Array]:
    """Values over increasing places, at these and between them.

    Parameters
    ----------
    x, values : ndarray, shape (points,)
        Two points at least; a value is not a number where there is none, and above 0 where ``log``.
    log_x, log : bool
        Whether the nodes are even in the logarithm of x, and the values linear in theirs.

    Returns
    -------
    x, values : ndarray, shape (nodes,)
        Linear between the points in these terms; not a number between points that do not both have a value.

    Examples
    --------
    A power of x on logarithmic axes, between two points:

    >>> x, y = curve_of(np.array([1.0, 4.0]), np.array([1.0, 8.0]), log_x=True, log=True)
    >>> bool(np.allclose(y, x**1.5))
    True
    """
    nodes, cell, part = _between(x, log=log_x)
    ends = _onto(values, log=log)
    found = (1.0 - part) * ends[cell] + part * ends[cell + 1]
    # A point is drawn though its neighbour has no value.
    found = np.where(part == 0.0, ends[cell], np.where(part == 1.0, ends[cell + 1], found))
    return nodes, _back(found, log=log)


def applied_at(results: SweepResults, taken: Slice, along: Array, across: Any) -> Array | None:
    """The applied voltage [V] anywhere between the points of a slice that is drawn over a potential.

    Parameters
    ----------
    results : SweepResults
        Of whose case the other potential is.
    taken : Slice
        Which holds what it is not drawn over.
    along, across : ndarray or float
        Values of ``taken.x`` and ``taken.y``, SI.

    Returns
    -------
    ndarray or None
        Exact, but never 0; None where neither key is a potential: that of the points counts there.
    """
    if isinstance(results.case, BearingCase) or not {taken.x, taken.y} & set(_POTENTIALS):
        return None
    there: dict[Any, Any] = {**taken.at, taken.x: along, taken.y: across}
    given = results.case.electric
    first = there.get(_POTENTIALS[0], given.potential_1)
    second = there.get(_POTENTIALS[1], given.potential_2)
    return np.asarray(np.maximum(np.abs(second - first), _LEAST_VOLTAGE))


def _between(values: Array, *, log: bool) -> tuple[Array, IntArray, Array]:
    """Nodes at and between increasing values, with the cell of each and its part of it from 0 to 1."""
    parts = max(1, _NODES // values.size)
    cell, step = np.divmod(np.arange((values.size - 1) * parts + 1), parts)
    last = cell == values.size - 1
    cell, part = np.where(last, cell - 1, cell), np.where(last, 1.0, step / parts)
    places = _onto(values, log=log)
    nodes = _back((1.0 - part) * places[cell] + part * places[cell + 1], log=log)
    return nodes, cell, part


def _between_points(taken: Slice, *, log_x: bool, log_y: bool) -> Surface | None:
    """Nodes in Delaunay's triangles of the points, to the scale of the figure."""
    places = np.column_stack(
        [_onto(taken.along, log=log_x), _onto(np.array(taken.across, dtype=float), log=log_y)]
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
        np.tile(share, (len(corners), 1)), np.repeat(corners, len(steps), axis=0), len(taken.points)
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
    """Whether a varied key is drawn on a logarithmic axis: where its values are spaced more evenly so.

    Parameters
    ----------
    results : SweepResults
        Whose ranges, of a "sobol" design, say it.
    key : str
        Varied key.
    values : ndarray
        SI.
    """
    if key in results.ranges:
        return results.ranges[key].spacing == "log"
    axis = np.unique(values)
    if axis.size < 3 or axis[0] <= 0.0:
        return False
    even, ratios = np.diff(axis), np.diff(np.log(axis))
    return bool(np.std(ratios) / np.mean(ratios) < 0.999 * np.std(even) / np.mean(even))


def _onto(values: Array, *, log: bool) -> Array:
    return np.log(values) if log else values


def _back(places: Array, *, log: bool) -> Array:
    return np.exp(places) if log else places
