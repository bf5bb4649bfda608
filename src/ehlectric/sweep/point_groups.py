"""Groups of sweep points whose bearings differ only in quantities, and keys of all their cases."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

from ehlectric.bearing import is_quick
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_keys import is_quantity
from ehlectric.cases.table_edits import set_keys
from ehlectric.errors import InputError
from ehlectric.runtime.display import is_number
from ehlectric.sweep.engine import Planned, case_key, hash_of, plan, planned_point, text_of
from ehlectric.sweep.sweep_inputs import Sweep

Inputs = Mapping[str, Any]

# Mark in the text of a case instead of a quantity, by its number; no text of a case has this character.
_MARK, _MARKS = "\0{}", re.compile(r'"\\u0000(\d+)"')


@dataclass(frozen=True)
class PointGroup:
    """Points of a sweep that differ in quantities only."""

    quantities: tuple[str, ...]  # dotted keys of the varied inputs that are quantities
    places: list[int]  # places of the points among all those that were grouped
    inputs: list[Inputs]  # values of the varied keys of each point, in SI units


def groups_of(sweep: Sweep, inputs: Iterable[Inputs]) -> list[PointGroup]:
    """Groups of points whose names, whole numbers and lists are equal, in the order of their first points."""
    amounts = {key for key in sweep.vary if is_quantity(key)}
    groups: dict[tuple[str, ...], PointGroup] = {}
    for place, values in enumerate(inputs):
        # An input such as a clearance may be a number at one point and a name at another one.
        numbers = [key for key, value in values.items() if key in amounts and is_number(value)]
        names = (key if key in numbers else f"{key}={value!r}" for key, value in values.items())
        group = groups.setdefault(tuple(names), PointGroup(tuple(numbers), [], []))
        group.places.append(place)
        group.inputs.append(values)
    return list(groups.values())


def plan_together(sweep: Sweep) -> Iterator[Planned]:
    """Points of a sweep as ``plan`` yields them, faster for bearings with estimated contacts.

    Rules between inputs, such as that a bore is less than the inner raceway, are checked where all quantities
    of a group have their least or largest values: rules that hold there hold between them. A group is planned
    point by point where one does not hold.
    """
    if not isinstance(sweep.case, BearingCase):
        yield from plan(sweep)
        return
    points = list(sweep.points())
    keys: dict[int, str] = {}
    for group in groups_of(sweep, points):
        key_of = _key_function(sweep, group)
        if key_of is not None:
            keys |= zip(group.places, map(key_of, group.inputs), strict=True)
    for number, inputs in enumerate(points):
        known = number in keys
        yield Planned(number, inputs, keys[number]) if known else planned_point(sweep, number, inputs)


def _key_function(sweep: Sweep, group: PointGroup) -> Callable[[Inputs], str] | None:
    """Function that gives the key of the case of each point of a group; None where there is no fast one."""
    corners = _corners(group)
    if len(corners) >= len(group.inputs):
        return None
    try:
        cases = [sweep.case.replace(corner) for corner in corners]
    except InputError:
        return None
    table = cases[0].to_dict()
    set_keys(table, {key: _MARK.format(number) for number, key in enumerate(group.quantities)})
    # Texts, and between them the numbers of quantities.
    pieces: list[Any] = _MARKS.split(text_of(table, sweep.uncertainty_samples))
    pieces[1::2] = [group.quantities[int(number)] for number in pieces[1::2]]

    def key_of(inputs: Inputs) -> str:
        values = pieces.copy()
        values[1::2] = [repr(float(inputs[key])) for key in pieces[1::2]]
        return hash_of("".join(values))

    # They differ where a case has further values that follow from the quantities.
    same = is_quick(cases[0]) and all(map(_is_same(sweep, key_of), cases, corners))
    return key_of if same else None


def _is_same(sweep: Sweep, key_of: Callable[[Inputs], str]) -> Callable[[Any, Inputs], bool]:
    return lambda case, inputs: key_of(inputs) == case_key(case, sweep.uncertainty_samples)


def _corners(group: PointGroup) -> list[Inputs]:
    """Inputs of a group with the least or the largest value of each quantity, in all combinations."""
    ends = []
    for key in group.quantities:
        values = [values[key] for values in group.inputs]
        ends.append(sorted({min(values), max(values)}))
    changes = (zip(group.quantities, values, strict=True) for values in product(*ends))
    return [{**group.inputs[0], **dict(change)} for change in changes]
