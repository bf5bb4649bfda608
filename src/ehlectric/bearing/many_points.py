"""Bearings at many points of operation: solved in parts, with their numbers and warning codes as columns."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.bearing.physical_bounds import outside_bounds
from ehlectric.bearing.preparation import prepare_bearing, with_films_times
from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.solving import POSITIONS, Detail, solution_of, solution_of_prepared
from ehlectric.bearing.summary import tables_of
from ehlectric.bearing.warnings import codes_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.quantities.inputs import SPEED
from ehlectric.quantities.results import is_text_of_points
from ehlectric.runtime.display import is_number
from ehlectric.runtime.files import plain
from ehlectric.runtime.threads import one_blas_thread

# Points that are solved together: their arrays fit into the memory, and the calls take little of the time.
TOGETHER = 1024


# Value and type of a column without results, by whether it has texts.
_EMPTY: Mapping[bool, tuple[Any, type]] = {False: (math.nan, float), True: ("", object)}


@dataclass(frozen=True)
class SolvedPart:
    """Points of a case that were solved together."""

    points: IntArray  # places of the points, shape (m,)
    solution: BearingSolution  # solution with numbers of shape (m,)


@dataclass
class Columns:
    """Numbers, texts and warning codes of n points."""

    size: int  # n
    # Numbers and texts by dotted key of summary.json, shape (n,); NaN or "" where a point has none.
    values: dict[str, Array] = field(default_factory=dict)
    # Points that have a warning, by its code, shape (n,).
    codes: dict[str, Mask] = field(default_factory=dict)
    reasons: dict[int, str] = field(default_factory=dict)  # why a point has no result, by its place

    @property
    def solved(self) -> Mask:
        """Whether a point has a result, shape (n,)."""
        solved = np.ones(self.size, dtype=bool)
        solved[list(self.reasons)] = False
        return solved

    def codes_of(self) -> list[tuple[str, ...]]:
        """Warning codes of each point."""
        columns = list(self.codes.items())
        return [tuple(code for code, mask in columns if mask[k]) for k in range(self.size)]

    def add(
        self, points: IntArray, tables: Mapping[str, Any], codes: Iterable[tuple[str, Mask | bool]]
    ) -> None:
        """Take the numbers and codes of solved points, of shape (m,), or one value for all points."""
        for key, value in flattened(tables).items():
            array = isinstance(value, np.ndarray) and value.dtype.kind in "fiub"
            if is_text_of_points(key) or is_number(value) or array:
                self._column(key)[points] = value
        for code, where in codes:
            if np.any(where):
                self._mask(code)[points] |= where

    def take(self, points: IntArray, columns: Columns) -> None:
        """Take the columns of some of the points."""
        for key, values in columns.values.items():
            self._column(key)[points] = values
        for code, mask in columns.codes.items():
            self._mask(code)[points] = mask
        self.reasons |= {int(points[place]): reason for place, reason in columns.reasons.items()}

    def _column(self, key: str) -> Array:
        """Column of a key, which is empty at first."""
        return self.values.setdefault(key, np.full(self.size, *_EMPTY[is_text_of_points(key)]))

    def _mask(self, code: str) -> Mask:
        """Points that have a warning, which are none at first."""
        return self.codes.setdefault(code, np.zeros(self.size, dtype=bool))


def columns_of(case: BearingCase, *, positions: int = POSITIONS) -> Columns:
    """Numbers, texts and warning codes of all points of a case with arrays; see ``solved_parts``."""
    columns = Columns(case.shape[0])
    for part in solved_parts(case, positions=positions, reasons=columns.reasons):
        columns.add(part.points, tables_of(part.solution), codes_of(part.solution))
    return columns


def solved_parts(
    case: BearingCase,
    *,
    reasons: dict[int, str] | None = None,
    positions: int = POSITIONS,
    detail: Detail = "whole",
    films: Array | None = None,
) -> Iterator[SolvedPart]:
    """Solutions of a case with arrays and estimated contacts of some detail, in parts of ``TOGETHER`` points.

    ``films``, factors on the films of all points, shape (n,). Points without a solution are skipped. Their
    errors are put into ``reasons`` by their places, if it is given; each error takes the time of a single
    bearing. Raises InputError where no point has a solution for a reason that all share, as an oil that needs
    solved contacts.
    """
    if SPEED not in case.arrays():
        # Loads of elements then have an axis of points as all other numbers, also where temperatures or
        # voltages are all that differs.
        case = case.with_values({SPEED: np.full(case.shape, case.bearing.inner_speed)})
    for points in np.array_split(np.arange(case.shape[0]), -(-case.shape[0] // TOGETHER)):
        with one_blas_thread(of_scipy=False):
            part = _solved(case, points, positions, detail, films)
        if part is not None:
            yield part
        if reasons is not None:
            solved = () if part is None else part.points
            for place in np.setdiff1d(points, solved).tolist():
                reasons[place] = reason_of(case.single(place))


def gathered(
    parts: Iterable[SolvedPart],
    numbers: Callable[[BearingSolution], Sequence[Numbers | None]],
    shape: tuple[int, int],
) -> Array:
    """Numbers of solved points in rows, shape (k, n); NaN where a point has none.

    ``numbers``, k numbers of a solution, None for what no point of it has; ``shape``, (k, n).
    """
    rows = np.full(shape, math.nan)
    for part in parts:
        for row, values in zip(rows, numbers(part.solution), strict=True):
            row[part.points] = math.nan if values is None else values
    return rows


def single_tables(part: SolvedPart) -> list[dict[str, dict[str, Any]]]:
    """Tables of numbers and texts of each point, as in the summary of a single bearing."""
    count = part.points.size
    tables = {name: _rows(table, count) for name, table in tables_of(part.solution).items()}
    return [{name: rows[place] for name, rows in tables.items()} for place in range(count)]


def _rows(table: Mapping[str, Any], count: int) -> list[dict[str, Any]]:
    """Table of each of so many points, from a table with arrays of shape (points,)."""
    columns = [_column(value, count) for value in table.values()]
    return [dict(zip(table, row, strict=True)) for row in zip(*columns, strict=True)]


def _column(value: Any, count: int) -> list[Any]:
    """Values of so many points as Python has them: None for NaN and an empty text."""
    if not isinstance(value, np.ndarray):
        return [plain(value)] * count
    if value.dtype.kind == "f":
        numbers = value.astype(object)
        numbers[~np.isfinite(value)] = None
        return list(numbers)
    return [None if each == "" else each for each in value.tolist()]


def many_of(case: BearingCase, arrays: Mapping[str, Any], number: int) -> BearingCase:
    """Case of a number of points with arrays by dotted key; all points are equal where there is none."""
    return case.with_arrays(arrays or {SPEED: np.full(number, case.bearing.inner_speed)})


def some_points(case: BearingCase, points: IntArray) -> BearingCase:
    """Case with some of the points of a case with arrays."""
    return case.with_values({key: array[points] for key, array in case.arrays().items()})


def _solved(
    case: BearingCase, points: IntArray, positions: int, detail: Detail, films: Array | None
) -> SolvedPart | None:
    """Solution of the points that have one; None where none has."""
    while points.size:
        factors = None if films is None else films[points]
        solution, refused = _attempt(some_points(case, points), positions, detail, factors)
        if solution is not None:
            return SolvedPart(points, solution)
        points = points[~np.broadcast_to(refused, points.shape)]
    return None


def _attempt(
    case: BearingCase, positions: int, detail: Detail, films: Array | None
) -> tuple[BearingSolution | None, Mask | bool]:
    """Solution of all points of a case, or None and which points are refused, shape (...)."""
    prepared = prepare_bearing(case, positions)
    if films is not None:
        prepared = with_films_times(prepared, films)
    if np.any(prepared.refused):
        return None, prepared.refused
    # Numbers of contacts beyond the model, whose points are refused then, have no logarithm.
    with np.errstate(invalid="ignore"):
        solution = solution_of_prepared(case, prepared, detail=detail)
    if np.any(solution.refused):
        return None, solution.refused
    outside = outside_bounds(solution) if detail == "whole" else False
    return None if np.any(outside) else solution, outside


def reason_of(case: BearingCase) -> str:
    """Return the error of a single bearing that is beyond the model."""
    for positions in (1, POSITIONS):
        try:
            solution_of(case, positions=positions)
        except (InputError, ConvergenceError) as error:
            return str(error)
    return (
        "the bearing is beyond the model, or a number is outside of its physical bounds, at one of the "
        "positions of its cage"
    )
