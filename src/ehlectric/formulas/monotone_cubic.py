"""Monotone cubic interpolation of many curves at once, each with nodes of its own."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array, IntArray


class MonotoneCubic:
    """Piecewise cubic curves with the slopes of Fritsch and Butland, which are monotone where the nodes are.

    Curves of c quantities at points of shape (...) have the same nodes for all quantities of a point. Nodes
    before the place ``first`` of a point are ignored.

    F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, doi:10.1137/0905021, with the
    slopes at the ends of C. B. Moler, Numerical Computing with Matlab, 2004, as
    ``scipy.interpolate.PchipInterpolator`` has them.

    Examples
    --------
    >>> curve = MonotoneCubic(np.array([0.0, 1.0, 2.0, 3.0]), np.array([[0.0, 1.0, 1.0, 4.0]]))
    >>> curve(np.array([0.5, 1.5, 2.5])).tolist()
    [[0.6875, 1.0, 1.9375]]
    """

    def __init__(self, x: Array, y: Array, first: IntArray | int = 0) -> None:
        """Curves through values ``y``, shape (c, ..., m), at increasing abscissae ``x``, shape (..., m)."""
        self._x, self._size = x, x.shape[-1]
        self._first = np.broadcast_to(first, x.shape[:-1])
        if self._size == 1:
            self._only = y
            return
        # A point whose only node is the last one is read in the interval before it.
        unused = np.arange(self._size) < self._first[..., np.newaxis]
        y = np.where(unused, _at(y, self._first)[..., np.newaxis], y)
        step, rise = np.diff(x), np.diff(y)
        step = np.where(step > 0.0, step, 1.0)
        slopes = self._slopes(step, rise / step)
        begin, end = slopes[..., :-1] * step, slopes[..., 1:] * step
        # Coefficients of the powers of the part of an interval; the coefficients of an interval lie next to
        # each other.
        parts = (y[..., :-1], begin, 3.0 * rise - 2.0 * begin - end, begin + end - 2.0 * rise)
        rows = np.moveaxis(np.stack(parts), (0, 1), (-2, -1))
        self._rows = np.ascontiguousarray(rows).reshape(-1, len(parts), y.shape[0])
        self._step = step

    def _slopes(self, step: Array, chord: Array) -> Array:
        """Slopes of the curves at their nodes, shape (c, ..., m)."""
        slopes = np.zeros((*chord.shape[:-1], self._size))
        slopes[..., 1:-1] = inner_slope(step[..., :-1], step[..., 1:], chord[..., :-1], chord[..., 1:])
        # The first interval, and the second one where there is one.
        first = np.minimum(self._first, self._size - 2)
        second = np.minimum(first + 1, self._size - 2)
        line = second == first
        at_first = end_slope(*(_at(values, place) for values in (step, chord) for place in (first, second)))
        last, before = self._size - 2, max(self._size - 3, 0)
        at_last = end_slope(step[..., last], step[..., before], chord[..., last], chord[..., before])
        straight = chord[..., last]
        _put(slopes, first, np.where(line, straight, at_first))
        slopes[..., -1] = np.where(line, straight, at_last)
        return slopes

    def __call__(self, at: Array) -> Array:
        """Values at abscissae, shape (..., k), of all quantities, shape (c, ..., k).

        Beyond the ends they equal the values at the ends.
        """
        if self._size == 1:
            return np.repeat(self._only, at.shape[-1], axis=-1)
        x, last = self._x, self._size - 1
        low = np.take_along_axis(x, self._first[..., np.newaxis], -1)
        at = np.clip(at, low, x[..., -1:])
        if x.ndim == 1:
            place = np.searchsorted(x[1:last], at, side="right")
        else:
            place = np.zeros(at.shape, dtype=np.intp)
            for node in range(1, last):
                place += x[..., node : node + 1] <= at
        part = (at - np.take_along_axis(x, place, -1)) / np.take_along_axis(self._step, place, -1)
        place += last * np.arange(x[..., 0].size).reshape(*x.shape[:-1], 1)
        rows = np.take(self._rows, place.ravel(), axis=0)
        powers = np.stack([np.ones_like(part), part, part**2, part**3], axis=-1).reshape(-1, rows.shape[1])
        values = np.einsum("kb,kbc->kc", powers, rows).reshape(*at.shape, -1)
        return np.moveaxis(values, -1, 0)


def along_axis(nodes: Array, values: Array, at: Array, axis: int) -> Array:
    """Values of the monotone cubic along one axis of an array. ``nodes``, increasing abscissae, shape (m,);
    ``values``, values at the nodes, of length m along the axis; ``at``, abscissae, shape (k,). Returns values
    of length k along the axis.

    Examples
    --------
    >>> along_axis(np.array([0.0, 1.0, 2.0]), np.array([[0.0], [0.5], [2.0]]), np.array([0.5]), 0).tolist()
    [[0.15625]]
    """
    lines = np.moveaxis(values, axis, -1)
    curves = MonotoneCubic(nodes, lines.reshape(-1, nodes.size))(at)
    return np.moveaxis(curves.reshape(*lines.shape[:-1], at.size), -1, axis)


def inner_slope(before: Array, after: Array, left: Array, right: Array) -> Array:
    """Slope at a node from the lengths of the intervals before and after it and the slopes of their chords.

    It is the weighted harmonic mean of both slopes, and zero where their signs differ.
    """
    rising = left * right > 0.0
    first, second = 2.0 * after + before, after + 2.0 * before
    mean = first / np.where(rising, left, 1.0) + second / np.where(rising, right, 1.0)
    return np.where(rising, (first + second) / np.where(rising, mean, 1.0), 0.0)


def end_slope(near: Array, far: Array, near_chord: Array, far_chord: Array) -> Array:
    """Slope at an end node from the lengths and the chords of the two nearest intervals."""
    slope = ((2.0 * near + far) * near_chord - near * far_chord) / (near + far)
    turned = np.sign(slope) != np.sign(near_chord)
    steep = (np.sign(near_chord) != np.sign(far_chord)) & (np.abs(slope) > 3.0 * np.abs(near_chord))
    return np.where(turned, 0.0, np.where(steep, 3.0 * near_chord, slope))


def _at(values: Array, place: IntArray) -> Array:
    """Values (..., m) at the places (...) along the last axis."""
    index = np.broadcast_to(place, values.shape[:-1])[..., np.newaxis]
    return np.take_along_axis(values, index, -1)[..., 0]


def _put(values: Array, place: IntArray, new: Array) -> None:
    """Set values (..., m) at the places (...) along the last axis."""
    index = np.broadcast_to(place, values.shape[:-1])[..., np.newaxis]
    np.put_along_axis(values, index, new[..., np.newaxis], -1)
