"""Error estimate of the largest field strength of a gap, by finer solutions where it may be largest.

A wave on a wall raises the field next to it. This rise decays within 1/k from the wall, where k is the wave
number. If the gap is much wider than the wave, the polynomial across the gap must resolve a boundary layer.
The columns must resolve the wave along the gap. Both errors are estimated in windows of a few gaps around
the places where the field may be largest, so that the estimate costs little.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

import numpy as np
from scipy.interpolate import Akima1DInterpolator

from ehlectric.arrays import Array
from ehlectric.errors import ConvergenceError
from ehlectric.field.peaks import HIGHER_ORDER, GapProblem, Place, around, places
from ehlectric.field.strength import GapField

# Largest number of windows, by the number of axes.
_MOST_WINDOWS = {1: 8, 2: 5}

# Relative rise above the largest corrected field that does not need a further window.
_NEGLIGIBLE = 1e-3

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
    total_there : float
        Both parts at that degree.
    """

    by_degree: float
    by_columns: float
    degree: int
    total_there: float

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
    In a window, the degree is raised until the field settles; then the distances of the columns are halved.
    The magnitudes of both changes are added. The first window lies around the largest field. The next one
    lies where the field of first order, which does not depend on the degree, promises the highest field.
    This goes on until no other place promises more than the largest corrected field, or to a number of
    windows; then the best promise counts as error. A lower place counts with the part of its rise by which
    it exceeds the largest field.
    """
    try:
        return _error_of(problem, strength, solve)
    except ConvergenceError:
        return None


def _error_of(problem: ProblemT, strength: Array, solve: Callable[[ProblemT], GapField]) -> StrengthError:
    largest = float(np.max(strength))
    degrees: Sequence[int] = range(problem.degree, _MOST_DEGREE + 1, _DEGREE_STEP)
    first, *left = places(problem, strength)
    tried: list[tuple[Place, StrengthError]] = []
    worst, highest = StrengthError(0.0, 0.0, problem.degree, 0.0), largest
    place: Place | None = first
    while place is not None:
        found, degrees = _peak_error(_Window.around(problem, place.column), degrees, solve)
        tried.append((place, found))
        corrected = place.strength * (1.0 + found.total)
        if corrected > highest:
            highest = corrected
            part = (corrected / largest - 1.0) / found.total
            worst = replace(found, by_degree=part * found.by_degree, by_columns=part * found.by_columns)
        place = max(left, key=lambda one: _promise(one, tried), default=None)
        excess = 0.0 if place is None else _promise(place, tried) / highest - 1.0
        if place is None or excess <= _NEGLIGIBLE:
            break
        if len(tried) == _MOST_WINDOWS[strength.ndim]:
            missed = excess * highest / largest
            return replace(worst, by_degree=worst.by_degree + missed, total_there=worst.total_there + excess)
        left.remove(place)
    return worst


def _promise(place: Place, tried: Sequence[tuple[Place, StrengthError]]) -> float:
    """Field strength that a finer solution may have at a place [V/m].

    It lacks the same share of the rise of first order as places that lack at least half as much. The error
    by the columns is at least that of the other places.
    """
    shares = [
        found.total / other.missing
        for other, found in tried
        if other.missing > 0.0 and other.missing >= 0.5 * place.missing
    ]
    share = max(shares, default=HIGHER_ORDER)
    columns = max(found.by_columns for _, found in tried)
    return place.strength * (1.0 + max(share * place.missing, columns))


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
        parts = around(problem, peak, reach=_REACH, least=_LEAST_COLUMNS, most=most)
        axes = {name: axis[part] for (name, axis), part in zip(problem.positions.items(), parts, strict=True)}
        center = around(problem, peak, reach=0.5, least=1, most=most // 2)
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
) -> tuple[StrengthError, Sequence[int]]:
    """Estimated error of the field at one place, and the degrees to compare at other places.

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
    by_columns = _HALVED * abs(halved / strengths[near] - 1.0)
    found = StrengthError(
        by_degree=abs(last / strengths[0] - 1.0),
        by_columns=by_columns,
        degree=tried[near],
        total_there=abs(last / strengths[near] - 1.0) + by_columns,
    )
    return found, sorted({degrees[0], tried[near], tried[-1], *degrees[len(tried) :]})


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
            return _with(field, found.total_there, found.degree)
        found = strength_error(problem, field.column_strength, solve)
    return field if found is None else _with(field, found.total, found.degree)


def _with(field: FieldT, error: float, degree: int) -> FieldT:
    """Field with its error and its sufficient degree."""
    return replace(field, strength_error=error, sufficient_degree=degree)
