"""Mesh of the electric field along the film: positions of its columns of elements.

``poisson.Across`` and ``poisson.Elements`` divide a column from wall to wall.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ehlectric.arrays import Array

# Distance from an end of the range within which a node counts as this end [spacings].
_SAME_NODE = 1e-6

# Columns of a smooth contact's field either way, at least, that are enough: the field of smooth walls varies
# over the length of the constriction, not over the spacing that its film needs. Of two circles with films of
# 24 and 195 nm, half of 429 columns changed the capacitance by 3e-4 and 6e-4 and the maximum field by 5e-7.
ENOUGH = 193


def columns_within(nodes: Array, ends: Sequence[float], number: int | None) -> Array:
    """Positions of the columns of the field between two ends [m].

    They are the film nodes between the ends and both ends, or ``number`` equidistant positions.

    Examples
    --------
    >>> columns_within(np.arange(6.0), (0.5, 3.5), None).tolist()
    [0.5, 1.0, 2.0, 3.0, 3.5]
    """
    start, stop = ends
    if number is not None:
        return np.linspace(start, stop, number)
    spacing = nodes[1] - nodes[0]
    inside = nodes[(nodes > start + _SAME_NODE * spacing) & (nodes < stop - _SAME_NODE * spacing)]
    return np.concatenate([[start], inside, [stop]])


def thinned(columns: Array, kept: Sequence[float]) -> Array:
    """Every second column, or third and so on, so that not many more than ``ENOUGH`` are left.

    ``columns``, increasing positions of all columns [m], shape (n,); ``kept``, positions of columns that
    stay, such as the position of the smallest film [m]; both ends stay too, and so does the middle one.
    Returns positions of the columns that are left, shape (m,); of symmetric columns with a symmetric ``kept``
    they are symmetric.

    Examples
    --------
    >>> few = thinned(np.linspace(-1.0, 1.0, 1025), [-0.5, 0.5])
    >>> few.size, bool(np.all(few == -few[::-1]))
    (209, True)
    """
    every = (columns.size - 1) // (ENOUGH - 1)
    if every < 2:
        return columns
    middle = columns.size // 2
    chosen = {*range(middle, columns.size, every), *range(middle, -1, -every), 0, columns.size - 1}
    chosen |= {int(np.argmin(np.abs(columns - place))) for place in kept}
    return columns[sorted(chosen)]
