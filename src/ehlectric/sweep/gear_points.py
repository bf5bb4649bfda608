"""Numbers and warning codes of a gear pair at many points of operation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import Columns
from ehlectric.cases.bearing_case import at_index
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import input_field
from ehlectric.errors import InputError
from ehlectric.gear import gear_summary, gear_warnings, solve_gear_pairs
from ehlectric.sweep.result import array_of
from ehlectric.sweep.sweep_inputs import check_varied, stored_value


def gear_columns(case: GearCase, given: Mapping[str, Any], number: int) -> tuple[Columns, dict[str, Array]]:
    """Results of a gear pair at a number of points, and the inputs of the points in SI units.

    ``given``, values by dotted key, a value for each point. Films of a case with solved films are from the
    atlas. A drawing that cannot run has no numbers but a reason. Raises InputError where a key is unknown, or
    a value is outside of its bounds.
    """
    quick = case if case.contacts != "solved" else case.replace({"contacts": "atlas"})
    inputs = {key: _parsed(key, values, case) for key, values in given.items()}
    columns, cases = Columns(number), dict[int, GearCase]()
    for point in range(number):
        try:
            cases[point] = quick.replace({key: values[point] for key, values in inputs.items()})
        except InputError as error:
            columns.reasons[point] = str(error)
    for point, solution in zip(cases, solve_gear_pairs(cases.values()), strict=True):
        if isinstance(solution, Exception):
            columns.reasons[point] = str(solution)
            continue
        codes = ((warning.code, True) for warning in gear_warnings(solution))
        columns.add(np.array([point]), gear_summary(solution), codes)
    return columns, {key: array_of(values) for key, values in inputs.items()}


def _parsed(key: str, values: Any, case: GearCase) -> list[Any]:
    """Values of a key as the case stores them; numbers are in SI units."""
    check_varied(key, case)
    parse = stored_value(key, input_field(key))
    parsed = []
    for index, value in enumerate(values):
        with at_index(key, index):
            parsed.append(parse(value, written=False))
    return parsed
