"""Nodes of computed curves: more where a curve bends, and where it begins or ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.arrays import Array, IntArray

# Values at positions, shape (m,) -> (k, m); NaN where a curve has no value.
Values = Callable[[Array], Array]

# Largest number of times that nodes are added, largest number of parts into which an interval is divided at
# once, and number of parts of an interval in which a curve ends.
_ROUNDS, _MOST, _OPEN = 16, 8, 8

# Length over the smallest length of an interval that is rounding.
_ROUNDED = 1e-6


def where_it_bends(
    values_of: Values, x: Array, values: Array, *, tolerance: float, closest: float, always: int = 1
) -> tuple[Array, Array]:
    """Add nodes to curves until straight lines between the nodes are as accurate as wanted.

    Every interval is first divided into ``2**always`` equal parts, so that no node is on a straight line by
    chance. Then an interval of length h is divided again if h^2/2 times the second divided difference at one
    of its ends exceeds the tolerance. This product is the difference from a straight line of length 2 h, four
    times the error of the line in the interval. The number of parts is the product over the tolerance, which
    is enough at a corner. An interval in which a curve ends is also divided.

    Parameters
    ----------
    values_of : callable
        Values of k curves at positions, shape (m,) -> (k, m); NaN where a curve has no value.
    x : ndarray, shape (n,)
        Increasing positions.
    values : ndarray, shape (k, n)
        Values of the curves at these positions.
    tolerance : float
        Largest difference between a value and the straight line, in the unit of the values.
    closest : float
        Smallest length of an interval that is divided, in the unit of the positions.
    always : int
        Binary logarithm of the number of parts into which every interval is divided in any case.

    Returns
    -------
    x : ndarray, shape (m,)
        Increasing positions of all nodes.
    values : ndarray, shape (k, m)
        Values of the curves at the nodes.

    Examples
    --------
    The root of x is steep near 0, and has more nodes there:

    >>> root = lambda x: np.sqrt(x)[np.newaxis]
    >>> start = np.array([0.0, 0.5, 1.0])
    >>> x, y = where_it_bends(root, start, root(start), tolerance=0.02, closest=0.01)
    >>> len(x[x < 0.25]), len(x[x > 0.75])
    (14, 1)
    """
    parts = np.full(x.size - 1, 2**always) if always else _parts(x, values, tolerance)
    for _ in range(_ROUNDS):
        added = _between(x, np.minimum(parts, np.ceil(np.diff(x) / closest - _ROUNDED).astype(int)))
        if not added.size:
            break
        order = np.argsort(np.concatenate([x, added]), kind="stable")
        values = np.concatenate([values, values_of(added)], axis=1)[:, order]
        x = np.concatenate([x, added])[order]
        parts = _parts(x, values, tolerance)
    return x, values


def _between(x: Array, parts: IntArray) -> Array:
    """Positions that divide each interval into equal parts, without its ends."""
    number = np.repeat(np.arange(parts.size), parts - 1)
    place = np.arange(number.size) - np.repeat(np.cumsum(parts - 1) - (parts - 1), parts - 1) + 1
    return np.asarray(x[number] + place / parts[number] * np.diff(x)[number])


def _parts(x: Array, values: Array, tolerance: float) -> IntArray:
    """Number of parts into which each interval is divided, shape (n - 1,), from values of shape (k, n)."""
    length = np.diff(x)
    bend = np.zeros(x.size)
    slope = np.diff(values, axis=1) / length
    second = np.abs(np.diff(slope, axis=1)) / (0.5 * (x[2:] - x[:-2]))
    # A line is compared only if all three values are known.
    bend[1:-1] = np.max(np.where(np.isfinite(second), second, 0.0), axis=0)
    off = 0.5 * length**2 * np.maximum(bend[:-1], bend[1:])
    parts = np.clip(np.ceil(off / tolerance), 1, _MOST).astype(int)
    known = np.isfinite(values)
    ends = np.any(known[:, :-1] != known[:, 1:], axis=0)
    return np.where(ends, _OPEN, parts)
