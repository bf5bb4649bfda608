"""Solution of many axles: bearings that differ in quantities only are solved together, and so are meshes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle.shaft_loads import BearingLoads
from ehlectric.axle.solution import (
    AxleSolution,
    Element,
    adjustment_warnings,
    bearing_elements,
    load_of,
    mesh_element,
    named_warnings,
    shaft_loads,
)
from ehlectric.bearing import codes_of, is_quick, solve_bearing, solved_parts
from ehlectric.cases.axle_case import AxleCase, Turning
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.gear import gear_warnings, solve_gear_pairs
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.display import is_number

# Solution of an axle, or why it has none.
Outcome = AxleSolution | InputError | ConvergenceError

# Element with its warnings, or why it has no film.
_Solved = tuple[Element, tuple[ResultWarning, ...]] | InputError | ConvergenceError


@dataclass(frozen=True)
class _Axle:
    """Axle with speeds and loads, before its films are known."""

    case: AxleCase
    turning: dict[str, Turning]
    loads: dict[str, BearingLoads]


@dataclass(frozen=True)
class _Mounted:
    """Bearing of one of many axles."""

    axle: int  # place of the axle among all
    number: int  # number of the bearing on its axle
    name: str
    shaft: str
    axial: float  # axial force along z [N]
    case: BearingCase


def solve_axles(cases: Iterable[AxleCase]) -> list[Outcome]:
    """Axles as ``solve_elements`` solves them, or the errors of axles without a solution, in their order.

    The text of a warning is the meaning of its code.
    """
    outcomes: dict[int, Outcome] = {}
    axles: dict[int, _Axle] = {}
    mounted: list[_Mounted] = []
    for place, case in enumerate(cases):
        try:
            axle = _Axle(case, case.turning(), shaft_loads(case))
            mounted += _mounted(place, axle)
            axles[place] = axle
        except InputError as error:
            outcomes[place] = error
    bearings = _solved_bearings(mounted)
    meshes = _solved_meshes(axles)
    for place, axle in axles.items():
        of_axle = [bearings[place, number] for number in range(len(axle.case.bearing))]
        of_axle += [meshes[place, number] for number in range(len(axle.case.mesh))]
        outcomes[place] = _together(axle, of_axle)
    return [outcomes[place] for place in sorted(outcomes)]


def _together(axle: _Axle, solved: Sequence[_Solved]) -> Outcome:
    """Solution of an axle from its elements; the first error if an element has no film."""
    known: list[tuple[Element, tuple[ResultWarning, ...]]] = []
    for each in solved:
        if not isinstance(each, tuple):
            return each
        known.append(each)
    warnings = named_warnings(
        (
            *adjustment_warnings(axle.case, axle.loads),
            *((element.name, of_element) for element, of_element in known),
        )
    )
    return AxleSolution(axle.case, axle.turning, tuple(element for element, _ in known), tuple(warnings))


def _mounted(place: int, axle: _Axle) -> Iterator[_Mounted]:
    """Bearings of an axle with their cases."""
    case = axle.case
    for number, (bearing, name) in enumerate(zip(case.bearing, case.names_of_bearings(), strict=True)):
        radial, axial = load_of(case, number, axle.loads)
        of_bearing = case.bearing_case(number, axle.turning[bearing.shaft].speed, radial, abs(axial))
        yield _Mounted(place, number, name, bearing.shaft, axial, of_bearing)


def _solved_bearings(mounted: Sequence[_Mounted]) -> dict[tuple[int, int], _Solved]:
    """Elements of all bearings by the place of the axle and the number of the bearing."""
    solved: dict[tuple[int, int], _Solved] = {}
    for group, values in _groups(mounted):
        for each, element in zip(group, _of_group(group, values), strict=True):
            solved[each.axle, each.number] = element
    return solved


def _groups(mounted: Sequence[_Mounted]) -> Iterator[tuple[list[_Mounted], dict[str, Array]]]:
    """Bearings that differ in quantities only, with the quantities in which they differ, shape (n,)."""
    groups: dict[str, tuple[list[_Mounted], list[dict[str, float]]]] = {}
    for each in mounted:
        values: dict[str, float] = {}
        names: dict[str, Any] = {}
        for key, value in flattened(each.case.to_dict()).items():
            (values if is_number(value) and is_quantity(key) else names)[key] = value
        members, rows = groups.setdefault(repr((names, list(values))), ([], []))
        members.append(each)
        rows.append(values)
    for members, rows in groups.values():
        columns = {key: np.array([row[key] for row in rows], dtype=float) for key in rows[0]}
        yield members, {key: column for key, column in columns.items() if np.ptp(column) != 0.0}


def _of_group(group: Sequence[_Mounted], values: dict[str, Array]) -> list[_Solved]:
    """Elements of bearings that differ in quantities only."""
    first = group[0].case
    if len(group) == 1 or not values or not is_quick(first):
        return [_alone(each) for each in group]
    solved: dict[int, _Solved] = {}
    reasons: dict[int, str] = {}
    try:
        for part in solved_parts(first.with_arrays(values), reasons=reasons):
            members = [group[place] for place in part.points.tolist()]
            solved |= zip(part.points.tolist(), _elements(members, part.solution), strict=True)
    except InputError:
        # Alone, each bearing has its own reason.
        return [_alone(each) for each in group]
    return [solved[place] if place in solved else _alone(each) for place, each in enumerate(group)]


def _elements(group: Sequence[_Mounted], solution: Any) -> list[_Solved]:
    """Elements of bearings that were solved together, with their warnings."""
    count = len(group)
    masks = [(code, np.broadcast_to(where, count)) for code, where in codes_of(solution)]
    elements = bearing_elements(solution, [(each.name, each.shaft, each.axial) for each in group])
    return [
        (
            element,
            tuple(ResultWarning.in_general(code) for code, mask in masks if mask[place]),
        )
        for place, element in enumerate(elements)
    ]


def _alone(mounted: _Mounted) -> _Solved:
    """Element of a single bearing."""
    try:
        result = solve_bearing(mounted.case, workers=1)
    except (InputError, ConvergenceError) as error:
        if isinstance(error, InputError):
            return error.with_text(error.key or "bearing", f"{error.text} ({mounted.name})")
        return error
    (element,) = bearing_elements(result.solution, [(mounted.name, mounted.shaft, mounted.axial)])
    return element, result.warnings


def _solved_meshes(axles: dict[int, _Axle]) -> dict[tuple[int, int], _Solved]:
    """Elements of all meshes by the place of the axle and the number of the mesh."""
    solved: dict[tuple[int, int], _Solved] = {}
    places: list[tuple[int, int]] = []
    pairs: list[GearCase] = []
    for place, axle in axles.items():
        for number in range(len(axle.case.mesh)):
            try:
                pairs.append(axle.case.gear_case(number, axle.turning))
                places.append((place, number))
            except InputError as error:
                solved[place, number] = error
    for (place, number), outcome in zip(places, solve_gear_pairs(pairs), strict=True):
        case = axles[place].case
        if isinstance(outcome, InputError):
            solved[place, number] = outcome.under("mesh.pair")
        elif isinstance(outcome, ConvergenceError):
            solved[place, number] = outcome
        else:
            element = mesh_element(case.names_of_meshes()[number], case.mesh[number].gears, outcome)
            solved[place, number] = element, tuple(gear_warnings(outcome))
    return solved
