"""Splines of several variables on a grid, as products of B-splines along each variable.

C. de Boor, A Practical Guide to Splines, 2001: B-splines (chapter IX), interpolation without knots next to
the ends (XIII) and tensor products (XVII). ``scipy.interpolate.NdBSpline`` is the same spline, but takes a
third of a second to load.
"""

from __future__ import annotations

from collections.abc import Sequence
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
            first, basis = _basis(along, k, axis)
            matrix = np.zeros((axis.size, axis.size))
            matrix[np.arange(axis.size)[:, np.newaxis], first[:, np.newaxis] + np.arange(k + 1)] = basis.T
            lines = np.moveaxis(coefficients, number, 0)
            solved: Array = np.linalg.solve(matrix, lines.reshape(axis.size, -1)).reshape(lines.shape)
            coefficients = np.moveaxis(solved, 0, number)
            knots.append(along)
            degrees.append(k)
        return cls(tuple(knots), tuple(degrees), np.ascontiguousarray(coefficients))

    def __call__(self, points: Array) -> Array:
        """Values at points of shape (..., variables), shape (..., n)."""
        flat = np.reshape(points, (-1, points.shape[-1]))
        values = np.empty((len(flat), self.coefficients.shape[-1]))
        for start in range(0, len(flat), _BLOCK):
            values[start : start + _BLOCK] = self._at(flat[start : start + _BLOCK])
        return values.reshape(*points.shape[:-1], -1)

    def _at(self, points: Array) -> Array:
        """Values at points of shape (m, variables), shape (m, n)."""
        number = len(points)
        places, weights = np.zeros((number, 1), dtype=int), np.ones((number, 1))
        for size, knots, k, at in zip(
            self.coefficients.shape[:-1], self.knots, self.degrees, points.T, strict=True
        ):
            first, basis = _basis(knots, k, at)
            along = first[:, np.newaxis] + np.arange(k + 1)
            places = (places[:, :, np.newaxis] * size + along[:, np.newaxis]).reshape(number, -1)
            weights = (weights[:, :, np.newaxis] * basis.T[:, np.newaxis]).reshape(number, -1)
        near = self.coefficients.reshape(-1, self.coefficients.shape[-1]).take(places, axis=0)
        values: Array = np.einsum("mp,mpn->mn", weights, near)
        return values


def _knots(axis: Array, k: int) -> Array:
    """Knots of a spline of degree ``k`` through as many nodes as it has B-splines."""
    inner = axis if k % 2 else 0.5 * (axis[1:] + axis[:-1])
    skipped = (k + 1) // 2
    inner = inner[skipped : inner.size - skipped]
    return np.concatenate([np.repeat(axis[0], k + 1), inner, np.repeat(axis[-1], k + 1)])


def _basis(knots: Array, k: int, at: Array) -> tuple[IntArray, Array]:
    """Number of the first B-spline that is not zero at points, shape (m,), and the values there of k + 1
    B-splines from this one on, shape (k + 1, m), by the recurrence of de Boor.
    """
    interval = np.clip(np.searchsorted(knots, at, side="right") - 1, k, knots.size - k - 2)
    basis = np.zeros((k + 1, at.size))
    basis[0] = 1.0
    for degree in range(1, k + 1):
        carried = np.zeros(at.size)
        for r in range(degree):
            right, left = knots[interval + r + 1], knots[interval + r + 1 - degree]
            part = basis[r] / (right - left)
            basis[r] = carried + (right - at) * part
            carried = (at - left) * part
        basis[degree] = carried
    return interval - k, basis
