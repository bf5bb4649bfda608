"""Splines of several variables on a grid, as products of B-splines along each variable.

C. de Boor, A Practical Guide to Splines, 2001: B-splines (chapter IX), interpolation without knots next to
the ends (XIII) and tensor products (XVII). ``scipy.interpolate.NdBSpline`` is the same spline, but takes a
third of a second to load.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, IntArray

# Points that are computed together: few enough for the processor's cache.
_BLOCK = 1024


@dataclass(frozen=True, eq=False)
class TensorSpline:
    """Spline of several variables; outside of its grid it continues the polynomials at the ends."""

    knots: tuple[Array, ...]  # knots along each variable, each knot at the ends degree + 1 times
    degrees: tuple[int, ...]
    coefficients: Array  # shape (..., n), an axis for each variable and one for n functions

    @classmethod
    def through(cls, axes: Sequence[Array], values: Array, degree: int = 3) -> TensorSpline:
        """Interpolate values on a grid.

        ``axes``, nodes along each variable; ``values``, shape (..., n). An axis with few nodes has a lower
        degree. The spline has no knot at the nodes next to the ends.

        Examples
        --------
        >>> axis = np.array([0.0, 1.0, 2.0, 4.0, 5.0])
        >>> spline = TensorSpline.through([axis], axis[:, np.newaxis] ** 3)
        >>> round(float(spline(np.array([[3.0]]))[0, 0]), 12)
        27.0
        """
        knots, degrees, coefficients = [], [], np.asarray(values, dtype=float)
        for number, axis in enumerate(axes):
            k = min(degree, axis.size - 1)
            along = _knots(axis, k)
            first = _first(along, k, axis)
            basis = _basis(along, k, axis, first)
            matrix = np.zeros((axis.size, axis.size))
            matrix[np.arange(axis.size)[:, np.newaxis], first[:, np.newaxis] + np.arange(k + 1)] = basis.T
            lines = np.moveaxis(coefficients, number, 0)
            solved: Array = np.linalg.solve(matrix, lines.reshape(axis.size, -1)).reshape(lines.shape)
            coefficients = np.moveaxis(solved, 0, number)
            knots.append(along)
            degrees.append(k)
        return cls(tuple(knots), tuple(degrees), np.ascontiguousarray(coefficients))

    def on_grid(self, axes: Sequence[Array]) -> Array:
        """Values at all points of a grid, from its nodes along each variable, shape (..., n).

        Examples
        --------
        >>> axis = np.array([0.0, 1.0, 2.0, 4.0])
        >>> spline = TensorSpline.through([axis, axis], (axis[:, np.newaxis] * axis**2)[..., np.newaxis])
        >>> spline.on_grid([np.array([1.0, 3.0]), np.array([3.0])])[..., 0].round(12).tolist()
        [[9.0], [27.0]]
        """
        values = self.coefficients
        for number, (knots, k, at) in enumerate(zip(self.knots, self.degrees, axes, strict=True)):
            first = _first(knots, k, at)
            shape = [1] * values.ndim
            shape[number] = at.size
            values = sum(
                part.reshape(shape) * np.take(values, first + place, axis=number)
                for place, part in enumerate(_basis(knots, k, at, first))
            )
        return values

    def __call__(self, points: Array) -> Array:
        """Values at points of shape (..., variables), shape (..., n)."""
        flat = np.reshape(points, (-1, points.shape[-1]))
        shape, n = self.coefficients.shape[:-1], self.coefficients.shape[-1]
        firsts = [_first(*law) for law in zip(self.knots, self.degrees, flat.T, strict=True)]
        cells = np.zeros(len(flat), dtype=np.intp)
        for first, size in zip(firsts, shape, strict=True):
            cells = cells * size + first
        # Points of a cell have the same coefficients, and their values are a product of matrices.
        order = np.argsort(cells, kind="stable")
        flat, firsts = flat[order], [first[order] for first in firsts]
        basis = list(map(_basis, self.knots, self.degrees, flat.T, firsts))
        values = np.empty((len(flat), n))
        for part in _blocks(cells[order]):
            lows = [int(first[part.start]) for first in firsts]
            near = tuple(slice(low, low + k + 1) for low, k in zip(lows, self.degrees, strict=True))
            weights = np.ones((1, part.stop - part.start))
            for along in basis:
                weights = (weights[:, np.newaxis] * along[:, part]).reshape(-1, weights.shape[1])
            values[order[part]] = (self.coefficients[near].reshape(-1, n).T @ weights).T
        return values.reshape(*points.shape[:-1], -1)


def _blocks(cells: IntArray) -> Iterator[slice]:
    """Parts of points, in the order of their cells, that are in one cell each."""
    start = 0
    for end in [*(np.flatnonzero(np.diff(cells)) + 1).tolist(), cells.size]:
        for first in range(start, end, _BLOCK):
            yield slice(first, min(first + _BLOCK, end))
        start = end


def _knots(axis: Array, k: int) -> Array:
    """Knots of a spline of degree ``k`` through as many nodes as it has B-splines."""
    inner = axis if k % 2 else 0.5 * (axis[1:] + axis[:-1])
    skipped = (k + 1) // 2
    inner = inner[skipped : inner.size - skipped]
    return np.concatenate([np.repeat(axis[0], k + 1), inner, np.repeat(axis[-1], k + 1)])


def _first(knots: Array, k: int, at: Array) -> IntArray:
    """Number of the first B-spline that is not zero at points, shape (m,)."""
    interval = np.searchsorted(knots, at, side="right") - 1
    return np.clip(interval, k, knots.size - k - 2) - k


def _basis(knots: Array, k: int, at: Array, first: IntArray) -> Array:
    """Values at points, shape (m,), of k + 1 B-splines from the first one on, shape (k + 1, m), by the
    recurrence of de Boor.
    """
    near = [knots[first + place] for place in range(1, 2 * k + 1)]
    basis = np.zeros((k + 1, at.size))
    basis[0] = 1.0
    for degree in range(1, k + 1):
        carried = np.zeros(at.size)
        for r in range(degree):
            right, left = near[k + r], near[k + r - degree]
            part = basis[r] / (right - left)
            basis[r] = carried + (right - at) * part
            carried = (at - left) * part
        basis[degree] = carried
    return basis
