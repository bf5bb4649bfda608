"""Numbers that mark points without data in files of heights, such as -32768 or 1e10."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning

# Numbers that instruments and programs write for points without data.
_KNOWN = frozenset(
    sign * number
    for sign in (1.0, -1.0)
    for number in (
        999.0, 9999.0, 99999.0, 999999.0, 32767.0, 32768.0, 65535.0, 2147483647.0, 2147483648.0,
        1e9, 1e10, 1e20,
    )
)  # fmt: skip

# Size above which each number far from the others is a mark, such as the largest numbers of floats.
_HUGE = 1e29

# Distance of a number to the nearest other height / range of the other heights, above which a known number
# is a mark, and above which a repeated number may be a mark.
_FAR, _SUSPECT = 1.0, 3.0


class Extreme(NamedTuple):
    """Smallest or largest of some heights, and how far it is from the others."""

    value: float
    points: int  # number of points with this value
    distance: float  # distance to the nearest other height / range of the other heights


def _extremes(heights: Array) -> list[Extreme]:
    """Both extremes of heights with NaN at points without data; none if the other heights are all equal."""
    there = heights[np.isfinite(heights)]
    extremes = []
    if there.size < 2:
        return []
    for value, nearest in ((np.min(there), np.min), (np.max(there), np.max)):
        others = there[there != value]
        span = float(np.ptp(others)) if others.size else 0.0
        if span > 0.0:
            distance = abs(float(nearest(others)) - float(value)) / span
            extremes.append(Extreme(float(value), there.size - others.size, distance))
    return extremes


def without_void_numbers(source: object, heights: Array) -> tuple[Array, tuple[ResultWarning, ...]]:
    """Heights as stored, with NaN instead of known numbers that mark points without data, and warnings.

    A known number is a mark if its distance to the nearest other height exceeds the range of the others.

    Examples
    --------
    >>> import numpy as np
    >>> heights, warnings = without_void_numbers("a.txt", np.array([0.1, 0.3, -9999.0, 0.2]))
    >>> heights, warnings[0].code
    (array([0.1, 0.3, nan, 0.2]), 'void-numbers')
    """
    warnings: tuple[ResultWarning, ...] = ()
    with np.errstate(over="ignore"):
        for _ in range(2):
            for extreme in _extremes(heights):
                if (extreme.value in _KNOWN or abs(extreme.value) > _HUGE) and extreme.distance > _FAR:
                    heights = np.where(heights == extreme.value, np.nan, heights)
                    warnings += (
                        ResultWarning.of(
                            "void-numbers", file=source, count=extreme.points, value=extreme.value
                        ),
                    )
    return heights, warnings


def refuse_void_numbers(source: object, heights: Array) -> None:
    """Raise an InputError if a repeated height [m] lies so far from the others that it may mark voids."""
    for extreme in _extremes(heights):
        if extreme.points > 1 and extreme.distance > _SUSPECT:
            raise InputError(
                source,
                f"{extreme.points} heights are {extreme.value:g} m, far from all others at "
                f"{extreme.distance:.2g} times their range",
                takes="empty fields or NaN at points without data",
            )
