"""Error estimate of the largest field strength of a gap, by finer solutions around its highest peaks.

A wave on a wall raises the field next to it. This rise decays within 1/k from the wall, where k is the wave
number. If the gap is much wider than the wave, the polynomial across the gap must resolve a boundary layer.
The columns must resolve the wave along the gap. Both errors are estimated in windows of a few gaps around
the columns with the highest field, so that the estimate costs little.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, Protocol, TypeVar

import numpy as np
from scipy.interpolate import Akima1DInterpolator

from ehlectric.arrays import Array
from ehlectric.errors import ConvergenceError
from ehlectric.field.strength import GapField

# Number of peaks of the field that are solved again. A field that is too coarse may hide which is highest.
_PEAKS = 3

# A peak lower than this fraction of the largest field is not solved again.
_LOW = 0.7

# Distance of the ends of a window from its peak, in gaps. The disturbance by an end decays with
# exp(-pi distance/gap), and cancels between solutions in the same window.
_REACH = 1.5

# Smallest number of columns of a window on either side of its peak; and the largest, by the number of axes.
_LEAST_COLUMNS = 3
_MOST_COLUMNS = {1: 200, 2: 16}

# Steps in which the degree is raised in a window, relative change of the field at which this ends, and
# largest degree in a window.
_DEGREE_STEP = 4
_SETTLED = 1e-3
_MOST_DEGREE = 48

# Error of the columns over its change when their distances are halved. Linear elements have errors of second
# order, of which a quarter remains: 4/3. The walls between the columns are not known: a quarter more.
_HALVED = 5.0 / 3.0

# Relative error of the largest field, from the degree, above which the degree is raised.
TOLERANCE = 5e-3


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


ProblemT = TypeVar("ProblemT", bound=GapProblem)
FieldT = TypeVar("FieldT", bound=GapField)


@dataclass(frozen=True)
class StrengthError:
    """Estimated relative error of the largest field strength of a gap.

    Attributes
    ----------
    by_degree, by_columns : float
        Part from the polynomial degree across the gap, and part from the spacing of the columns.
    degree : int
        Polynomial degree at which the first part is below ``TOLERANCE``, as far as the estimate can tell.
    by_that_degree : float
        First part at that degree.
    """

    by_degree: float
    by_columns: float
    degree: int
    by_that_degree: float

    @property
    def total(self) -> float:
        """Sum of both parts, dimensionless."""
        return self.by_degree + self.by_columns


def strength_error(
    problem: ProblemT, strength: Array, solve: Callable[[ProblemT], GapField]
) -> StrengthError | None:
    """Estimate the error of the largest field strength of a solved field problem.

    Parameters
    ----------
    problem : FieldProblem or PointFieldProblem
        Problem that is ``plain``.
    strength : ndarray, shape (nx,) or (nx, ny)
        Largest field strength of each column of the solution [V/m].
    solve : callable
        Function that solves a field problem.

    Returns
    -------
    StrengthError or None
        The estimate; None if a finer solution in a window does not converge.

    Notes
    -----
    In a window around each of the highest peaks, the degree is raised until the field settles; then the
    distances of the columns are halved. The magnitudes of both changes are added. A lower peak counts with
    the part of its rise by which it exceeds the largest field.
    """
    largest = float(np.max(strength))
    worst = StrengthError(0.0, 0.0, problem.degree, 0.0)
    try:
        degrees = tuple(range(problem.degree, _MOST_DEGREE + 1, _DEGREE_STEP))
        for peak in _peaks(problem, strength):
            found, degrees = _peak_error(_Window.around(problem, peak), degrees, solve)
            height = float(strength[peak]) / largest
            rise = height * (1.0 + found.total) - 1.0
            if rise > worst.total:
                part = rise / found.total
                worst = StrengthError(
                    part * found.by_degree, part * found.by_columns, found.degree, found.by_that_degree
                )
    except ConvergenceError:
        return None
    return worst


def _peaks(problem: GapProblem, strength: Array) -> Iterator[tuple[int, ...]]:
    """Indices of the highest columns, each at least one gap away from all higher ones."""
    left, floor = strength.copy(), _LOW * float(np.max(strength))
    for _ in range(_PEAKS):
        peak = tuple(int(k) for k in np.unravel_index(np.argmax(left), left.shape))
        if left[peak] <= floor:
            return
        yield peak
        left[_around(problem, peak, reach=1.0, least=1)] = 0.0


def _around(
    problem: GapProblem, peak: tuple[int, ...], *, reach: float, least: int, most: int | None = None
) -> tuple[slice, ...]:
    """Indices of the columns within ``reach`` gaps of a peak along every axis.

    There are at least ``least`` and at most ``most`` columns on either side of the peak.
    """
    distance = reach * float(problem.upper[peak] - problem.lower[peak])
    parts = []
    for at, axis in zip(peak, problem.positions.values(), strict=True):
        start, stop = np.searchsorted(axis, [axis[at] - distance, axis[at] + distance])
        start, stop = min(int(start), at - least), max(int(stop), at + least + 1)
        if most is not None:
            start, stop = max(start, at - most), min(stop, at + most + 1)
        parts.append(slice(max(start, 0), min(stop, axis.size)))
    return tuple(parts)


def _replaced(problem: ProblemT, **changes: Any) -> ProblemT:
    """Changed copy of a problem; both kinds of problems are dataclasses."""
    changed: ProblemT = replace(problem, **changes)  # type: ignore[type-var]
    return changed


@dataclass(frozen=True)
class _Window(Generic[ProblemT]):
    """Part of a field problem around a peak, and the ends of the central part whose field is compared [m]."""

    problem: ProblemT
    ends: tuple[tuple[float, float], ...]

    @classmethod
    def around(cls, problem: ProblemT, peak: tuple[int, ...]) -> _Window[ProblemT]:
        most = _MOST_COLUMNS[len(peak)]
        parts = _around(problem, peak, reach=_REACH, least=_LEAST_COLUMNS, most=most)
        axes = {name: axis[part] for (name, axis), part in zip(problem.positions.items(), parts, strict=True)}
        center = _around(problem, peak, reach=0.5, least=1, most=most // 2)
        inside = [axis[part] for axis, part in zip(problem.positions.values(), center, strict=True)]
        return cls(
            _replaced(
                problem,
                lower=problem.lower[parts],
                upper=problem.upper[parts],
                permittivity=problem.permittivity[parts],
                **axes,
            ),
            tuple((float(axis[0]), float(axis[-1])) for axis in inside),
        )

    def of_degree(self, degree: int) -> _Window[ProblemT]:
        """The window with another polynomial degree."""
        return replace(self, problem=_replaced(self.problem, degree=degree))

    def halved(self) -> _Window[ProblemT]:
        """The window with a further column between neighbours; its walls are interpolated.

        The logarithm of the gap is interpolated, so that the walls cannot cross.
        """
        values = [
            0.5 * (self.problem.lower + self.problem.upper),
            np.log(self.problem.upper - self.problem.lower),
            self.problem.permittivity,
        ]
        axes = {}
        for k, (name, axis) in enumerate(self.problem.positions.items()):
            fine = np.empty(2 * axis.size - 1)
            fine[::2], fine[1::2] = axis, 0.5 * (axis[:-1] + axis[1:])
            values = [Akima1DInterpolator(axis, value, axis=k, method="makima")(fine) for value in values]
            axes[name] = fine
        middle, gap, permittivity = values[0], np.exp(values[1]), values[2]
        walls = {"lower": middle - 0.5 * gap, "upper": middle + 0.5 * gap}
        return replace(self, problem=_replaced(self.problem, **axes, **walls, permittivity=permittivity))

    def strength(self, solve: Callable[[ProblemT], GapField]) -> float:
        """Largest field strength of the central part [V/m]."""
        strength = solve(self.problem).column_strength
        for k, (axis, (start, stop)) in enumerate(
            zip(self.problem.positions.values(), self.ends, strict=True)
        ):
            strength = np.compress((axis >= start) & (axis <= stop), strength, axis=k)
        return float(np.max(strength))


def _peak_error(
    window: _Window[ProblemT], degrees: Sequence[int], solve: Callable[[ProblemT], GapField]
) -> tuple[StrengthError, tuple[int, ...]]:
    """Estimated error of the field at one peak, and the degrees to compare at other peaks.

    The first of ``degrees`` is that of the solution; the others are tried until the field settles.
    """
    strengths: list[float] = []
    for degree in degrees:
        strengths.append(window.of_degree(degree).strength(solve))
        if len(strengths) > 1 and abs(strengths[-1] - strengths[-2]) <= _SETTLED * strengths[-2]:
            break
    last, tried = strengths[-1], degrees[: len(strengths)]
    near = [abs(last / strength - 1.0) <= TOLERANCE for strength in strengths].index(True)
    halved = window.of_degree(tried[near]).halved().strength(solve)
    found = StrengthError(
        by_degree=abs(last / strengths[0] - 1.0),
        by_columns=_HALVED * abs(halved / strengths[near] - 1.0),
        degree=tried[near],
        by_that_degree=abs(last / strengths[near] - 1.0),
    )
    return found, tuple(sorted({degrees[0], tried[near], tried[-1]}))


def with_error(problem: ProblemT, solve: Callable[[ProblemT], FieldT]) -> FieldT:
    """Solve a field problem with as high a degree as its largest field needs, and estimate the error.

    Parameters
    ----------
    problem : FieldProblem or PointFieldProblem
        Problem to solve; its ``most_degree`` bounds the degree.
    solve : callable
        Function that solves a field problem of a given degree.

    Returns
    -------
    GapField
        The field with its ``strength_error`` and ``sufficient_degree``. Both are None for a problem that is
        not ``plain``, and where the estimate did not converge.
    """
    field = solve(problem)
    if not problem.plain:
        return field
    found = strength_error(problem, field.column_strength, solve)
    most = problem.degree if problem.most_degree is None else problem.most_degree
    if found is not None and problem.degree < min(found.degree, most):
        problem = _replaced(problem, degree=min(found.degree, most))
        field = solve(problem)
        if problem.degree == found.degree:
            found = replace(found, by_degree=found.by_that_degree)
        else:
            found = strength_error(problem, field.column_strength, solve)
    if found is None:
        return field
    known = {"strength_error": found.total, "sufficient_degree": found.degree}
    checked: FieldT = replace(field, **known)  # type: ignore[type-var]
    return checked
