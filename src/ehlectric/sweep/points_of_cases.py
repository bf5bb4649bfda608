"""Numbers and warning codes of a gear pair or an axle at many points of operation."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle import solve_axles, tables_of_point
from ehlectric.bearing import Columns
from ehlectric.cases.axle_case import AxleCase, changed_axle
from ehlectric.cases.bearing_case import at_index
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.cases.input_keys import input_field
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.errors import InputError
from ehlectric.gear import gear_summary, solve_gear_pairs, warning_codes
from ehlectric.quantities.results import is_text_of_points
from ehlectric.sweep.points import flat
from ehlectric.sweep.result import array_of
from ehlectric.sweep.sweep_inputs import check_varied, key_in_file, stored_value


def gear_columns(case: GearCase, given: Mapping[str, Any], number: int) -> tuple[Columns, dict[str, Array]]:
    """Results of a gear pair at a number of points, and the inputs of the points in SI units.

    ``given``, values by dotted key, a value for each point. Films of a case with solved films are from the
    atlas. A drawing that cannot run has no numbers but a reason. Raises InputError where a key is unknown, or
    a value is outside of its bounds.
    """
    quick = case if case.contacts != "solved" else case.replace({"contacts": "atlas"})

    def solved(cases: Iterable[GearCase]) -> Iterator[_Solved]:
        solutions = iter(solve_gear_pairs(cases, unloaded=False))
        while some := list(islice(solutions, _TOGETHER)):
            codes = iter(warning_codes([each for each in some if not isinstance(each, Exception)]))
            for solution in some:
                yield solution if isinstance(solution, Exception) else (gear_summary(solution), next(codes))

    return _evaluated(case, given, number, partial(changed_pair, quick, parsed=True), solved)


def axle_columns(case: AxleCase, given: Mapping[str, Any], number: int) -> tuple[Columns, dict[str, Array]]:
    """Results of an axle at a number of points, and the inputs of the points, as for ``gear_columns``."""
    quick = {"drive.contacts": "atlas"} if case.solves_films else {}
    alone = case.replace({"remedies": [], **quick})

    def solved(cases: Iterable[AxleCase]) -> Iterator[_Solved]:
        for solution in solve_axles(cases):
            if isinstance(solution, Exception):
                yield solution
            else:
                yield tables_of_point(solution), [warning.code for warning in solution.warnings]

    return _evaluated(case, given, number, partial(changed_axle, alone), solved)


# Tables and codes of the warnings of a point, or why it has no result.
_Solved = tuple[Mapping[str, Any], Iterable[str]] | Exception

# Gear pairs whose warnings are computed together.
_TOGETHER = 256


def _evaluated(
    case: SolvedCase,
    given: Mapping[str, Any],
    number: int,
    changed: Callable[[Mapping[str, Any]], Any],
    solved: Callable[[Iterable[Any]], Iterator[_Solved]],
) -> tuple[Columns, dict[str, Array]]:
    """Results of changed cases that are solved together, and their inputs."""
    inputs = {key: _parsed(key, values, case) for key, values in given.items()}
    columns, cases = Columns(number), dict[int, Any]()
    for point in range(number):
        try:
            cases[point] = changed({key: values[point] for key, values in inputs.items()})
        except InputError as error:
            columns.reasons[point] = str(error)
    rows, codes = dict[int, dict[str, Any]](), dict[str, list[int]]()
    for point, outcome in zip(cases, solved(cases.values()), strict=True):
        if isinstance(outcome, Exception):
            columns.reasons[point] = str(outcome)
            continue
        tables, of_point = outcome
        rows[point] = flat(tables)
        for code in of_point:
            codes.setdefault(code, []).append(point)
    points = np.array(list(rows), dtype=int)
    masks = ((code, np.isin(points, some)) for code, some in codes.items())
    columns.add(points, _columns(list(rows.values())), masks)
    return columns, {key: array_of(values) for key, values in inputs.items()}


def _columns(rows: Sequence[Mapping[str, Any]]) -> dict[str, Array]:
    """Numbers, NaN for none, and texts of rows with equal keys, by key; shape (rows,). Keys without a value
    are omitted.
    """
    columns: dict[str, Array] = {}
    for key in rows[0] if rows else ():
        values = [row[key] for row in rows]
        if is_text_of_points(key):
            columns[key] = np.array(values, dtype=object)
        elif any(value is not None for value in values):
            columns[key] = np.array([math.nan if value is None else value for value in values], dtype=float)
    return columns


def _parsed(key: str, values: Any, case: SolvedCase) -> list[Any]:
    """Values of a key as the case stores them; numbers are in SI units."""
    check_varied(key, case)
    parse = stored_value(key, input_field(key_in_file(key, case)))
    parsed = []
    for index, value in enumerate(values):
        with at_index(key, index):
            parsed.append(parse(value, written=False))
    return parsed
