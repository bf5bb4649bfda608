"""One bearing at many changed inputs or speeds, with estimated contacts that are solved together."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Numbers
from ehlectric.bearing.many_points import SolvedPart, gathered, solved_parts, some_points
from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.solving import NOT_IN_FILMS, UNUSED, Detail, key_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import SPEED

# Speed of the inner ring, which is varied where nothing else is.

# Smallest and largest speed that are looked at, divided by the speed of the case.
LEAST, MOST = 0.1, 4.0

# Speeds at which a bearing is solved, divided by the speed of the case, which is one of them: close enough
# for smooth curves between them.
PARTS: tuple[float, ...] = tuple(
    float(part) for part in (*np.geomspace(LEAST, 1.0, 8), *np.geomspace(1.0, MOST, 5)[1:])
)

# Place of the speed of the case among them.
AT_CASE = PARTS.index(1.0)


@dataclass(frozen=True)
class Several:
    """Solutions of one bearing at n changed inputs, in parts, with the reasons of those that have none."""

    size: int  # n
    parts: tuple[SolvedPart, ...]
    reasons: dict[int, str]  # why a point has no solution, by its place

    def columns(self, numbers: Callable[[BearingSolution], Sequence[Numbers | None]], count: int) -> Array:
        """Numbers of all solutions, shape (count, n), NaN without one. ``numbers``, the numbers of a
        solution.
        """
        return gathered(self.parts, numbers, (count, self.size))


def solve_several(case: BearingCase, detail: Detail = "coarse") -> Several:
    """Solutions of a case with arrays and estimated contacts, which have few loads.

    Their numbers are within 1e-3 of the numbers of whole solutions, and ratios of these within 1e-4. Points
    without a solution have their reasons.
    """
    reasons: dict[int, str] = {}
    size = case.shape[0]
    try:
        parts = tuple(solved_parts(case, reasons=reasons, detail=detail))
    except InputError as error:
        return Several(size, (), dict.fromkeys(range(size), str(error)))
    return Several(size, parts, reasons)


def at_speeds(case: BearingCase, speeds: Array, detail: Detail = "coarse") -> Several:
    """Solutions of a case with estimated contacts at speeds of its inner ring [rad/s], shape (n,)."""
    return solve_several(_alone(case).with_values({SPEED: np.asarray(speeds, dtype=float)}), detail)


def over_parts(case: BearingCase) -> tuple[Array, Several]:
    """Speeds of ``PARTS`` of a case with estimated contacts [rad/s], shape (n,), and its solutions, computed
    once for equal cases.
    """
    several, speeds = _over_parts(key_of(case, without_effect=(*NOT_IN_FILMS, *UNUSED))), _speeds(case)
    # Inputs on which films do not depend are taken from this case.
    of_case = _alone(case).with_values({SPEED: speeds})
    parts = (
        replace(part, solution=replace(part.solution, case=some_points(of_case, part.points)))
        for part in several.parts
    )
    return speeds, replace(several, parts=tuple(parts))


def _speeds(case: BearingCase) -> Array:
    """Speeds of ``PARTS`` [rad/s]."""
    return case.bearing.inner_speed * np.array(PARTS)


# Series of solutions over the speed that are kept: for the bearings of a comparison.
_KEPT = 8


@lru_cache(maxsize=_KEPT)
def _over_parts(key: Any) -> Several:
    """Solutions of the case of a key at the speeds of ``PARTS``."""
    return at_speeds(key.case, _speeds(key.case))


def _alone(case: BearingCase) -> BearingCase:
    """Case without ranges, which a value at another point may leave."""
    return case if case.ranges is None else case.model_copy(update={"ranges": None})


def alike(cases: Sequence[BearingCase]) -> Iterator[tuple[IntArray, BearingCase]]:
    """Cases of one point joined to cases with arrays, each with the places of its points.

    Cases are joined that differ by quantities only: a number of elements or a law is equal for all points.
    """
    tables = [flattened(_alone(case).to_dict()) for case in cases]
    groups: dict[str, list[int]] = {}
    for place, table in enumerate(tables):
        fixed = {key: value for key, value in table.items() if not _is_varied(key, value)}
        names = sorted(key for key, value in table.items() if _is_varied(key, value))
        groups.setdefault(repr((sorted(fixed.items(), key=str), names)), []).append(place)
    for places in groups.values():
        first = tables[places[0]]
        columns = {
            key: np.array([tables[place][key] for place in places])
            for key, value in first.items()
            if _is_varied(key, value)
        }
        varied = {key: values for key, values in columns.items() if key == SPEED or np.ptp(values) > 0.0}
        yield np.array(places), _alone(cases[places[0]]).with_values(varied)


def _is_varied(key: str, value: object) -> bool:
    """Whether a value is a quantity, of which a case may have an array."""
    return type(value) is float and is_quantity(key)


# Number of times that points are added, distance of logarithms of speeds up to which a crossing is bracketed,
# and part of it by which the points next to an estimate are away from it.
_ROUNDS, _CLOSE, _OFFSET = 12, 2e-3, 0.45

# Values at logarithms of speeds, shape (m,) -> (k, m); NaN where there is none.
Values = Callable[[Array], Array]


@dataclass
class Sampled:
    """Quantities of a bearing at logarithms of speeds, to which more are added near their crossings of 0."""

    values_of: Values
    log: Array  # logarithms of speeds in increasing order, shape (n,)
    values: Array  # shape (k, n)
    last: frozenset[int] = field(default=frozenset())  # quantities of which only the last rise counts

    def refine(self) -> None:
        """Add speeds until each crossing lies between two that are 0.2 % apart."""
        for number in range(_ROUNDS):
            speeds = [
                point
                for row in range(len(self.values))
                for k in self.brackets(row)
                if self.log[k + 1] - self.log[k] > _CLOSE
                for point in self._near(row, k, halve=number > 1)
            ]
            if not speeds:
                return
            self.add(np.unique(speeds))

    def add(self, log: Array) -> None:
        """Compute the quantities at further logarithms of speeds; quantities without any are skipped."""
        values = self.values_of(log)
        known = np.isfinite(values).any(axis=0)
        both = np.concatenate([self.log, log[known]])
        self.log, order = np.unique(both, return_index=True)
        self.values = np.concatenate([self.values, values[:, known]], axis=1)[:, order]

    def brackets(self, row: int) -> list[int]:
        """Places of the speeds before a crossing of a quantity."""
        values = self.values[row]
        both = np.isfinite(values[:-1]) & np.isfinite(values[1:])
        rises = both & (values[:-1] < 0.0) & (values[1:] >= 0.0)
        falls = both & (values[:-1] >= 0.0) & (values[1:] < 0.0)
        intervals: list[int] = np.flatnonzero(rises if row in self.last else rises | falls).tolist()
        return intervals[-1:] if row in self.last else intervals

    def crossings(self, row: int) -> list[float]:
        """Logarithms of the speeds at which a quantity crosses 0, in increasing order."""
        return [self._estimate(row, k) for k in self.brackets(row)]

    def _near(self, row: int, k: int, *, halve: bool) -> Iterator[float]:
        """Speeds on both sides of an estimated crossing, and in the middle of its bracket."""
        low, high, at = self.log[k], self.log[k + 1], self._estimate(row, k)
        nearby = at - _OFFSET * _CLOSE, at + _OFFSET * _CLOSE
        yield from (float(value) for value in nearby if low < value < high)
        if halve:
            yield float(0.5 * (low + high))

    def _estimate(self, row: int, k: int) -> float:
        """Crossing between two speeds by the polynomial of the speed over the values at up to four speeds."""
        values, count = self.values[row], self.log.size
        nodes = [n for n in range(max(0, k - 1), min(count, k + 3)) if np.isfinite(values[n])]
        at, over = self.log[nodes], values[nodes]
        low, high = self.log[k], self.log[k + 1]
        if np.all(np.diff(over) > 0.0) or np.all(np.diff(over) < 0.0):
            root = _through(over, at)
            if low <= root <= high:
                return root
        first, second = values[k], values[k + 1]
        return float(low + (high - low) * first / (first - second))


def _through(over: Array, at: Array) -> float:
    """Value at 0 of the polynomial through values ``at`` over ``over``, by Lagrange's formula.

    Examples
    --------
    >>> round(_through(np.array([-1.0, 1.0, 3.0]), np.array([1.0, 3.0, 5.0])), 9)
    2.0
    """
    total = 0.0
    for n, value in enumerate(at.tolist()):
        others = np.delete(over, n)
        total += value * float(np.prod(-others / (over[n] - others)))
    return total


def log_of(values: Array) -> Array:
    """Logarithms, NaN of values that are not positive.

    Examples
    --------
    >>> log_of(np.array([1.0, 0.0])).tolist()
    [0.0, nan]
    """
    positive = values > 0.0
    return np.where(positive, np.log(np.where(positive, values, 1.0)), math.nan)
