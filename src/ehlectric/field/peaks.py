"""Places in a gap where the field strength may be largest, from a solution that may be too coarse.

To first order in the heights of the walls, the field at a wall follows from integrals over the walls. It
does not depend on the polynomial degree. It shows where a coarse solution lacks the rise at a crest.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.ndimage import maximum_filter

from ehlectric.arrays import Array

# Fraction of the largest field. Places with less, even after correction, are left out. So are columns whose
# thin-gap field is lower than the second fraction: a cylinder of any size doubles the field at its top.
_LOW = 0.7
_LOW_THIN = 0.5

# Distance up to which walls are integrated, in gaps: the integrands decay with exp(-pi distance/gap).
_REACH = 1.5

# Largest number of columns of the integrals on either side.
_MOST_COLUMNS = 200

# Distance between places, in gaps, and their largest number.
_APART = 0.5
_MOST_PLACES = 100

# Factor of the rise of first order, for the terms of higher order.
HIGHER_ORDER = 1.25


class GapProblem(Protocol):
    """Attributes that the field problems of line and of point contacts share."""

    @property
    def lower(self) -> Array:
        """Height of the lower wall [m]."""

    @property
    def upper(self) -> Array:
        """Height of the upper wall [m]."""

    @property
    def permittivity(self) -> Array:
        """Relative permittivity, one value per column."""

    @property
    def potential_1(self) -> float:
        """Potential of the lower wall [V]."""

    @property
    def potential_2(self) -> float:
        """Potential of the upper wall [V]."""

    @property
    def positions(self) -> dict[str, Array]:
        """Positions of the columns along each axis [m], by the name of the attribute."""

    @property
    def degree(self) -> int:
        """Polynomial degree across the gap."""

    @property
    def most_degree(self) -> int | None:
        """Degree up to which the degree may be raised."""

    @property
    def plain(self) -> bool:
        """Whether the permittivity is constant across the gap, and nothing but the walls is prescribed."""


@dataclass(frozen=True)
class Place:
    """Place where the field may be largest.

    Attributes
    ----------
    column : tuple of int
        Indices of its column.
    strength : float
        Largest field strength of the solution within half a gap [V/m].
    missing : float
        Relative rise by which the field of first order exceeds ``strength``, at least 0.
    """

    column: tuple[int, ...]
    strength: float
    missing: float


def places(problem: GapProblem, strength: Array) -> list[Place]:
    """Places where the field may be largest; the first has the largest field of the solution.

    Parameters
    ----------
    problem : FieldProblem or PointFieldProblem
        Problem that was solved.
    strength : ndarray, shape (nx,) or (nx, ny)
        Largest field strength of each column of the solution [V/m].

    Returns
    -------
    list of Place
        The others are local maxima of the higher of ``strength`` and the field of first order, which has a
        surcharge for terms of higher order. They are sorted by this bound, the highest first.
    """
    first_order = first_order_strength(problem, strength)
    return [
        _place(problem, strength, first_order, column) for column in _columns(problem, strength, first_order)
    ]


def _columns(problem: GapProblem, strength: Array, first_order: Array) -> Iterator[tuple[int, ...]]:
    bound = strength + HIGHER_ORDER * np.maximum(first_order - strength, 0.0)
    summits = (bound == maximum_filter(bound, size=3)) & (bound > _LOW * float(np.max(strength)))
    left = np.where(summits, bound, 0.0)
    column = tuple(int(k) for k in np.unravel_index(np.argmax(strength), strength.shape))
    for _ in range(_MOST_PLACES):
        yield column
        left[around(problem, column, reach=_APART, least=1)] = 0.0
        column = tuple(int(k) for k in np.unravel_index(np.argmax(left), left.shape))
        if left[column] == 0.0:
            return


def _place(problem: GapProblem, strength: Array, first_order: Array, column: tuple[int, ...]) -> Place:
    near = around(problem, column, reach=_APART, least=1)
    highest = float(np.max(strength[near]))
    return Place(column, highest, max(float(np.max(first_order[near])) / highest - 1.0, 0.0))


def around(
    problem: GapProblem, column: tuple[int, ...], *, reach: float, least: int, most: int | None = None
) -> tuple[slice, ...]:
    """Indices of the columns within ``reach`` gaps of a column along every axis.

    There are at least ``least`` and at most ``most`` columns on either side.
    """
    distance = reach * float(problem.upper[column] - problem.lower[column])
    parts = []
    for at, axis in zip(column, problem.positions.values(), strict=True):
        start, stop = np.searchsorted(axis, [axis[at] - distance, axis[at] + distance])
        start, stop = min(int(start), at - least), max(int(stop), at + least + 1)
        if most is not None:
            start, stop = max(start, at - most), min(stop, at + most + 1)
        parts.append(slice(max(start, 0), min(stop, axis.size)))
    return tuple(parts)


def first_order_strength(problem: GapProblem, strength: Array) -> Array:
    """Larger field strength of both walls to first order in their heights [V/m].

    Parameters
    ----------
    problem : FieldProblem or PointFieldProblem
        Problem with the walls.
    strength : ndarray, shape (nx,) or (nx, ny)
        Field strength of each column of a solution [V/m].

    Returns
    -------
    ndarray, shape (nx,) or (nx, ny)
        0 where the thin-gap field is below half the largest ``strength``.

    Notes
    -----
    Waves ``a cos kx`` on the lower wall and ``b cos kx`` on the upper wall of a gap h change the field at the
    lower wall by the factor ``1 + a k coth kh - b k / sinh kh``. The change of the thin-gap field accounts
    for ``(a - b)/h``. The Fourier transforms of the rest are integrals over the differences of height from
    the column, weighted by ``pi/(4 h^2) / sinh^2(pi t/2h)`` for the same wall and ``1/cosh^2`` for the other.
    On maps, the integrals along both axes are added: the wave number is at most the sum of its components.

    Examples
    --------
    Waves with a k = 0.1 on the wall of a wide gap raise the field at their crests by 10 %:

    >>> import numpy as np
    >>> from ehlectric.field.poisson import FieldProblem
    >>> x = np.linspace(-4.0, 4.0, 129)
    >>> flat = 0.0 * x
    >>> waves = FieldProblem(x, 0.1 / np.pi * np.cos(np.pi * x), flat + 2.0, flat + 1.0, 0.0, 1.0)
    >>> round(float(first_order_strength(waves, flat)[64]) * 2.0, 1)
    1.1
    """
    gap = problem.upper - problem.lower
    thin = abs(problem.potential_2 - problem.potential_1) / gap
    high = thin >= _LOW_THIN * float(np.max(strength))
    rises = np.zeros((2, *gap.shape))
    if np.any(high):
        widest = float(np.max(gap[high]))
        for axis, positions in enumerate(problem.positions.values()):
            walls = [np.moveaxis(wall, axis, 0) for wall in (problem.lower, -problem.upper)]
            along = _rises(positions, walls[0], walls[1], widest)
            rises += np.moveaxis(along, 1, axis + 1)
    return np.where(high, thin * (1.0 + np.max(rises, axis=0)), 0.0)


def _rises(x: Array, lower: Array, upper: Array, widest: float) -> Array:
    """Relative rises at both walls from waves along the first axis, beyond that of the thin-gap field.

    ``upper`` is the negative height of the upper wall, so that crests are positive on both walls.
    """
    most = min(_columns_within(x, _REACH * widest), x.size - 1)
    far = np.pad(x, most, mode="reflect", reflect_type="odd")
    ends = [(most, most)] + [(0, 0)] * (lower.ndim - 1)
    far_walls = [np.pad(wall, ends, mode="reflect") for wall in (lower, upper)]
    weight = np.gradient(far)
    shape = (-1,) + (1,) * (lower.ndim - 1)
    gap = -upper - lower
    rises = np.zeros((2, *lower.shape))
    for k in (*range(-most, 0), *range(1, most + 1)):
        there = slice(most + k, most + k + x.size)
        distance = np.abs(far[there] - x).reshape(shape)
        # Beyond a distance of 20 gaps sinh^2 is as good as infinite.
        scaled = np.minimum(0.5 * np.pi * distance / gap, 20.0)
        factor = 0.25 * np.pi / gap**2 * weight[there].reshape(shape)
        same, other = factor / np.sinh(scaled) ** 2, factor / np.cosh(scaled) ** 2
        differences = [wall - padded[there] for wall, padded in zip((lower, upper), far_walls, strict=True)]
        rises[0] += same * differences[0] - other * differences[1]
        rises[1] += same * differences[1] - other * differences[0]
        if abs(k) == 1:
            # The column itself: the limit of the integrand, half from either side.
            own = weight[most : most + x.size].reshape(shape) / (2.0 * np.pi * distance**2)
            rises += own * np.array(differences)
    return rises


def _columns_within(x: Array, distance: float) -> int:
    """Largest number of columns within a distance on one side, from 1 to a bound."""
    inside = np.searchsorted(x, x + distance, side="right") - np.arange(x.size) - 1
    return int(np.clip(np.max(inside), 1, _MOST_COLUMNS))
