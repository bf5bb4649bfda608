"""Nodes of computed curves: more where a curve bends, and where it begins or ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.arrays import Array, Mask

# Values at positions, shape (m,) -> (k, m); NaN where a curve has no value.
Values = Callable[[Array], Array]

# Largest number of times that each interval is halved.
_HALVINGS = 16


def where_it_bends(
    values_of: Values, x: Array, values: Array, *, tolerance: float, closest: float, always: int = 1
) -> tuple[Array, Array]:
    """Add nodes to curves until straight lines between the nodes are as accurate as wanted.

    Every interval is halved some times in any case, so that no middle is on a straight line by chance. Then
    both halves are halved again if a value in the middle differs from the straight line. The halves with
    values are also halved again if a curve ends in an interval.

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
        Smallest length of an interval that is halved, in the unit of the positions.
    always : int
        Number of times that every interval is halved in any case.

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
    (10, 1)
    """
    low, high = np.arange(x.size - 1), np.arange(1, x.size)
    for number in range(_HALVINGS):
        wide = x[high] - x[low] > closest
        low, high = low[wide], high[wide]
        if not low.size:
            break
        middle = x.size + np.arange(low.size)
        x = np.append(x, 0.5 * (x[low] + x[high]))
        values = np.append(values, values_of(x[middle]), axis=1)
        first, between, last = (values[:, places] for places in (low, middle, high))
        left, right = _halved(first, between, last, tolerance if number + 1 >= always else -1.0)
        low, high = (
            np.concatenate([low[left], middle[right]]),
            np.concatenate([middle[left], high[right]]),
        )
    order = np.argsort(x)
    return x[order], values[:, order]


def _halved(first: Array, middle: Array, last: Array, tolerance: float) -> tuple[Mask, Mask]:
    """Whether the left and the right half of each interval are halved again, shape (n,), from the values at
    its ends and in its middle, shape (k, n). A negative tolerance halves every interval with values.
    """
    bent = np.abs(middle - 0.5 * (first + last)) > tolerance
    known = [np.isfinite(values) for values in (first, middle, last)]
    # A line is compared only if all three values are known.
    open_end = ~np.logical_and.reduce(known)
    left, right = (open_end & (known[1] | end) for end in (known[0], known[2]))
    return np.any(bent | left, axis=0), np.any(bent | right, axis=0)
