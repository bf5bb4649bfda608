"""Elliptic integrals of many arguments at once, faster than one by one.

B. C. Carlson, Numer. Algorithms 10 (1995) 13-26, doi:10.1007/BF02198293: duplication brings the arguments
closer together by a factor of four, until a series in their differences is exact to the last digit.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import elliprd

from ehlectric.arrays import Array

# Largest relative difference of the arguments at which the series is used; its relative error is below 1e-14.
_CLOSE = 0.06

# Duplications before the differences are looked at, and at most.
_FIRST, _MOST = 3, 60

# Arguments that are computed together: few enough for the processor's cache. Fewer are computed one by one.
_BLOCK, _FEW = 2048, 500


def both_rd(x: Array, y: Array, z: Array) -> tuple[Array, Array]:
    """Carlson's R_D(x, y, z) and R_D(x, z, y), which share their duplications.

    Parameters
    ----------
    x, y, z : ndarray, shapes that broadcast to (...)
        Arguments; ``x`` not negative, ``y`` and ``z`` positive.

    Returns
    -------
    first, second : ndarray, shape (...)
        R_D(x, y, z) and R_D(x, z, y), with a relative error below 1e-14.

    Examples
    --------
    >>> first, second = both_rd(np.array([0.0, 2.0]), np.array([2.0, 2.0]), np.array([1.0, 2.0]))
    >>> [round(float(value), 9) for value in (first[0], first[1], second[1])]
    [1.797210352, 0.353553391, 0.353553391]
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    if x.size < _FEW:
        return elliprd(x, y, z), elliprd(x, z, y)
    shape, size = x.shape, x.size
    given = [np.ascontiguousarray(values, dtype=float).ravel() for values in (x, y, z)]
    first, second = np.empty(size), np.empty(size)
    step = math.ceil(size / math.ceil(size / _BLOCK))
    for start in range(0, size, step):
        part = slice(start, start + step)
        first[part], second[part] = _block(*(values[part] for values in given))
    return first.reshape(shape), second.reshape(shape)


def _block(x: Array, y: Array, z: Array) -> tuple[Array, Array]:
    factor, first, second = 1.0, np.zeros_like(x), np.zeros_like(x)
    for number in range(_MOST):
        if number >= _FIRST and _are_close(x, y, z):
            break
        root_x, root_y, root_z = np.sqrt(x), np.sqrt(y), np.sqrt(z)
        both = root_x * (root_y + root_z) + root_y * root_z
        y_next, z_next = y + both, z + both
        first += factor / (root_z * z_next)
        second += factor / (root_y * y_next)
        x, y, z = 0.25 * (x + both), 0.25 * y_next, 0.25 * z_next
        factor *= 0.25
    return 3.0 * first + factor * _series(x, y, z), 3.0 * second + factor * _series(x, z, y)


def _are_close(x: Array, y: Array, z: Array) -> bool:
    smallest = np.minimum(np.minimum(x, y), z)
    return bool(np.all(np.maximum(np.maximum(x, y), z) <= (1.0 + _CLOSE) * smallest))


def _series(x: Array, y: Array, z: Array) -> Array:
    """R_D(x, y, z) of arguments that are close together."""
    mean = 0.2 * (x + y + 3.0 * z)
    over = 1.0 / mean
    u, v = 1.0 - x * over, 1.0 - y * over
    w = (u + v) / -3.0
    uv, w2 = u * v, w * w
    e2, e3 = uv - 6.0 * w2, (3.0 * uv - 8.0 * w2) * w
    e4, e5 = 3.0 * (uv - w2) * w2, uv * w2 * w
    total: Array = (
        1.0
        + e2 * (-3.0 / 14.0 + e2 * (9.0 / 88.0 - e2 / 16.0 + 45.0 / 272.0 * e3) - 9.0 / 52.0 * e3)
        + e3 * (1.0 / 6.0 + 3.0 / 40.0 * e3)
        + e4 * (-3.0 / 22.0 + 3.0 / 20.0 * e2 - 9.0 / 68.0 * e3)
        + e5 * (3.0 / 26.0 - 9.0 / 68.0 * e2)
    )
    return over * np.sqrt(over) * total
