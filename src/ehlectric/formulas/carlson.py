"""Carlson's symmetric elliptic integrals R_F and R_D of many arguments at once.

B. C. Carlson, Numer. Algorithms 10 (1995) 13-26, doi:10.1007/BF02198293: duplication brings the arguments
closer together by a factor of four, until a series in their differences is exact to the last digit. The
complete integral R_F(0, y, z) is pi/2 divided by the arithmetic-geometric mean of the roots of y and z.
``scipy.special`` computes the same integrals, but takes a quarter of a second to load.
"""

from __future__ import annotations

import math

import numpy as np

from ehlectric.arrays import Array, Numbers, as_float

# Largest relative difference of the arguments at which the series is used; its relative error is below 1e-14.
_CLOSE = 0.06

# Relative difference of two means below which their own mean is exact to the last digit.
_ROUNDING = 1e-8

# Duplications before the differences are looked at, and at most.
_FIRST, _MOST = 3, 60

# Arguments that are computed together: few enough for the processor's cache.
_BLOCK = 2048


def both_rd(x: Array, y: Array, z: Array) -> tuple[Array, Array]:
    """Carlson's R_D(x, y, z) and R_D(x, z, y), which share their duplications. ``x``, ``y`` and ``z``,
    arguments; ``x`` not negative, ``y`` and ``z`` positive. Returns R_D(x, y, z) and R_D(x, z, y), with a
    relative error below 1e-14, shape (...).

    Examples
    --------
    >>> first, second = both_rd(np.array([0.0, 2.0]), np.array([2.0, 2.0]), np.array([1.0, 2.0]))
    >>> [round(float(value), 9) for value in (first[0], first[1], second[1])]
    [1.797210352, 0.353553391, 0.353553391]
    """
    x, y, z = np.broadcast_arrays(x, y, z)
    shape, size = x.shape, x.size
    if size == 0:
        return np.empty(shape), np.empty(shape)
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


def complete_rd_pair(y: Numbers, z: Numbers) -> tuple[Array, Array]:
    """Complete integrals R_D(0, y, z) and R_D(0, z, y) of positive arguments, shape (...).

    With m = 1 - y/z for y <= z and the integrals D = (K - E)/m and B = K - D (DLMF 19.25.1) they are
    3 D/z^1.5 and 3 B/(y z^0.5). K and D follow from the arithmetic-geometric mean of 1 and (1 - m)^0.5
    (DLMF 19.8.5 and 19.8.6), whose terms divided by m have no cancellation.

    Examples
    --------
    >>> [round(float(value), 8) for value in complete_rd_pair(2.0, 1.0)]
    [1.79721035, 1.06793799]
    """
    y, z = np.asarray(y, dtype=float), np.asarray(z, dtype=float)
    smaller, larger = np.minimum(y, z), np.maximum(y, z)
    a, b = np.ones(smaller.shape), np.sqrt(smaller / larger)
    # The square of c = (a - b)/2, and this square divided by m; ``total``, sum of 2^n c_n^2/m.
    c2, c2_over_m = 0.25 * (1.0 - b) ** 2, 0.25 * (1.0 - b) / (1.0 + b)
    total, factor = np.ones(smaller.shape), 1.0
    while np.any(a - b > _ROUNDING * a):
        factor *= 2.0
        total += factor * c2_over_m
        a, b = 0.5 * (a + b), np.sqrt(a * b)
        step = c2 / (4.0 * (0.5 * (a + b))) ** 2
        c2_over_m, c2 = c2_over_m * step, c2 * step
    total += 2.0 * factor * c2_over_m
    k = math.pi / (a + b)
    d = 0.5 * k * total
    root = np.sqrt(larger)
    of_larger, of_smaller = 3.0 * d / (larger * root), 3.0 * (k - d) / (smaller * root)
    ordered = y <= z
    return np.where(ordered, of_larger, of_smaller), np.where(ordered, of_smaller, of_larger)


def complete_rd(y: Numbers, z: Numbers) -> Numbers:
    """Complete integral R_D(0, y, z) of positive arguments, shape (...)."""
    return as_float(complete_rd_pair(y, z)[0])


def complete_rf(y: Numbers, z: Numbers) -> Numbers:
    """Complete integral R_F(0, y, z) of positive arguments, shape (...).

    Examples
    --------
    >>> complete_rf(1.0, 1.0) == math.pi / 2.0
    True
    """
    larger, smaller = np.sqrt(np.maximum(y, z)), np.sqrt(np.minimum(y, z))
    while np.any(larger - smaller > _ROUNDING * larger):
        larger, smaller = 0.5 * (larger + smaller), np.sqrt(larger * smaller)
    return as_float(math.pi / (larger + smaller))
