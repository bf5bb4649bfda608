"""Designs of a sweep: the values of the varied inputs at each point of a grid, paired or Sobol design."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.sweep.results import Range


def grid(axes: Mapping[str, Sequence[Any]]) -> Iterator[dict[str, Any]]:
    """Points of a grid design: every combination of the values of all keys.

    Parameters
    ----------
    axes : mapping
        Values of each key.

    Yields
    ------
    dict
        Inputs of a point by key; the last key varies fastest.

    Examples
    --------
    >>> list(grid({"a": [1, 2], "b": [3, 4]}))
    [{'a': 1, 'b': 3}, {'a': 1, 'b': 4}, {'a': 2, 'b': 3}, {'a': 2, 'b': 4}]
    """
    for values in product(*axes.values()):
        yield dict(zip(axes, values, strict=True))


def paired(axes: Mapping[str, Sequence[Any]]) -> Iterator[dict[str, Any]]:
    """Points of a paired design: the first values of all keys, then the second values, and so on.

    Parameters
    ----------
    axes : mapping
        Values of each key, equally many.

    Yields
    ------
    dict
        Inputs of a point by key.

    Raises
    ------
    ValueError
        If the keys have different numbers of values.

    Examples
    --------
    >>> list(paired({"a": [1, 2], "b": [3, 4]}))
    [{'a': 1, 'b': 3}, {'a': 2, 'b': 4}]
    """
    for values in zip(*axes.values(), strict=True):
        yield dict(zip(axes, values, strict=True))


def sobol(
    ranges: Mapping[str, Range], samples: int, seed: int, whole: Collection[str] = ()
) -> Iterator[dict[str, Any]]:
    """Points of a Sobol design, from which first-order and total sensitivity indices are estimated.

    Parameters
    ----------
    ranges : mapping
        Range of each key, in SI units.
    samples : int
        Number n of rows of the matrices A and B, a power of two.
    seed : int
        Seed of the scrambling of Sobol's sequence: the same seed gives the same points.
    whole : collection of str
        Keys whose values are whole numbers. Every whole number of the range is equally likely with linear
        spacing.

    Yields
    ------
    dict
        Inputs of a point by key, in SI units. For d keys there are n(d + 2) points. The rows of A come
        first, then the rows of B. For each key, the rows of A follow with the column of this key from B.

    Notes
    -----
    A and B are the halves of a scrambled Sobol sequence in 2d dimensions. Saltelli et al., Comput. Phys.
    Commun. 181 (2010) 259, doi:10.1016/j.cpc.2009.09.018, table 2. The values computed at
    these points are f_A, f_B and f_AB of ``scipy.stats.sobol_indices``.

    Examples
    --------
    >>> points = list(sobol({"a": Range(0.0, 1.0), "b": Range(1.0, 100.0, "log")}, 4, seed=0))
    >>> len(points), points[8] == {"a": points[4]["a"], "b": points[0]["b"]}
    (16, True)
    """
    from scipy.stats import qmc

    count = len(ranges)
    engine = qmc.Sobol(2 * count, scramble=True, seed=np.random.default_rng(seed))
    # The sequence is balanced only for a power of two of samples.
    unit = engine.random_base2(samples.bit_length() - 1)
    first, second = unit[:, :count], unit[:, count:]
    yield from _rows(ranges, first, whole)
    yield from _rows(ranges, second, whole)
    for k in range(count):
        mixed = first.copy()
        mixed[:, k] = second[:, k]
        yield from _rows(ranges, mixed, whole)


def _rows(ranges: Mapping[str, Range], unit: Array, whole: Collection[str]) -> Iterator[dict[str, Any]]:
    """Points of a design from rows of the unit cube, shape (n, keys)."""
    columns = [
        (shares if key in whole else between)(over, unit[:, k]).tolist()
        for k, (key, over) in enumerate(ranges.items())
    ]
    for values in zip(*columns, strict=True):
        yield dict(zip(ranges, values, strict=True))


def between(over: Range, unit: ArrayLike) -> Array:
    """Values at given fractions of a range.

    Parameters
    ----------
    over : Range
        Ends and spacing of the range.
    unit : array_like, shape (...)
        Fraction of the range, from 0 at its start to 1 at its end.

    Returns
    -------
    ndarray, shape (...)
        Values in the unit of the range; at 0 and 1 its exact ends.

    Examples
    --------
    >>> between(Range(1.0, 100.0, "log"), [0.0, 0.5, 1.0])
    array([  1.,  10., 100.])
    """
    unit = np.asarray(unit, dtype=float)
    if over.spacing == "log":
        values = over.start ** (1.0 - unit) * over.stop**unit
    else:
        values = (1.0 - unit) * over.start + unit * over.stop
    return np.clip(values, over.start, over.stop)


def shares(over: Range, unit: ArrayLike) -> Array:
    """Whole numbers at given fractions of a range.

    Parameters
    ----------
    over : Range
        Ends of the range, whole numbers, and its spacing.
    unit : array_like, shape (...)
        Fraction of the range, from 0 to 1.

    Returns
    -------
    ndarray of int, shape (...)
        Whole numbers of the range. With linear spacing, each covers an equal part of the unit interval.
        Rounding alone would give half a part to each of the two ends.

    Examples
    --------
    >>> shares(Range(1, 3), [0.0, 0.3, 0.4, 0.6, 0.7, 1.0])
    array([1, 1, 2, 2, 3, 3])
    """
    wider = Range(over.start - 0.5, over.stop + 0.5, over.spacing)
    rounded = np.floor(between(wider, unit) + 0.5)
    return np.clip(rounded, over.start, over.stop).astype(np.int64)
