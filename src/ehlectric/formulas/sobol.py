"""Scrambled Sobol points: numbers from 0 to 1 that fill a unit cube evenly.

I. M. Sobol, USSR Comput. Math. Math. Phys. 7 (1967) 86, doi:10.1016/0041-5553(67)90144-9. Direction numbers:
``sobol_directions.txt``. Scrambling by random lower triangular matrices and random shifts: J. Matousek,
J. Complexity 14 (1998) 527, doi:10.1006/jcom.1998.0489. ``scipy.stats.qmc.Sobol`` draws the same points, but
loading ``scipy.stats`` takes a quarter of a second.
"""

from __future__ import annotations

from functools import cache
from importlib import resources
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array

# Bits of a point.
_BITS = 30

# Integers of so many bits.
_Bits = NDArray[np.uint32]


def sobol_points(width: int, number: int, seed: int | np.random.SeedSequence) -> Array:
    """Draw the first points of a scrambled Sobol sequence.

    Parameters
    ----------
    width
        Number of dimensions, from 1 to 700.
    number
        Number of points, at most 2^30. The points are balanced for a power of 2.
    seed
        Seed of the scrambling.

    Returns
    -------
    Array
        Points from 0 to 1, the end 1 excluded, shape (number, width).

    Raises
    ------
    ValueError
        If there are no direction numbers for the width.

    Examples
    --------
    >>> points = sobol_points(2, 4, seed=0)
    >>> sorted((4.0 * points[:, 0]).astype(int).tolist())  # one point in each quarter
    [0, 1, 2, 3]
    """
    directions = _directions(width)
    random = np.random.default_rng(seed)
    powers = np.uint32(1) << np.arange(_BITS, dtype=np.uint32)
    shift = random.integers(2, size=(width, _BITS), dtype=np.uint32) @ powers
    below = np.tril(random.integers(2, size=(width, _BITS, _BITS), dtype=np.uint32), -1)
    scrambled = _scrambled(directions, below | np.eye(_BITS, dtype=np.uint32))
    # The point n is the sum modulo 2 of the directions of the bits of its Gray code n ^ (n >> 1).
    index = np.arange(number, dtype=np.uint32)
    gray = index ^ (index >> np.uint32(1))
    points = np.tile(shift, (number, 1))
    for bit in range(max(0, number - 1).bit_length()):
        points ^= np.where((gray[:, np.newaxis] >> np.uint32(bit)) & np.uint32(1), scrambled[:, bit], 0)
    return points * 2.0**-_BITS


def _scrambled(directions: _Bits, matrices: _Bits) -> _Bits:
    """Directions multiplied by matrices modulo 2, shape (width, bits), the highest bit first in a matrix."""
    highest_first = np.arange(_BITS - 1, -1, -1, dtype=np.uint32)
    bits = (directions[:, np.newaxis, :] >> highest_first[:, np.newaxis]) & np.uint32(1)
    products = np.einsum("wij,wjk->wik", matrices, bits) & np.uint32(1)
    summed: _Bits = np.sum(products << highest_first[:, np.newaxis], axis=1, dtype=np.uint32)
    return summed


@cache
def _directions(width: int) -> _Bits:
    """Direction numbers of each dimension as integers of ``_BITS`` bits, shape (width, bits)."""
    rows = [[1] * _BITS]
    with (resources.files(__package__) / "sobol_directions.txt").open(encoding="utf-8") as lines:
        numbers = (line for line in lines if not line.startswith("#"))
        rows += [_numbers(*map(int, line.split())) for line in islice(numbers, width - 1)]
    if len(rows) != width:
        raise ValueError(f"Sobol points of {width} dimensions: there are direction numbers for {len(rows)}")
    return np.array(rows, dtype=np.uint32) << np.arange(_BITS - 1, -1, -1, dtype=np.uint32)


def _numbers(degree: int, coefficients: int, *initial: int) -> list[int]:
    """Numbers m of a dimension from their recurrence; equations (2) and (3) of Joe and Kuo."""
    numbers = list(initial)
    for k in range(degree, _BITS):
        number = numbers[k - degree] ^ numbers[k - degree] << degree
        for i in range(1, degree):
            if coefficients >> (degree - 1 - i) & 1:
                number ^= numbers[k - i] << i
        numbers.append(number)
    return numbers
