"""Solution of many axles: bearings that differ in quantities only are solved together, and so are meshes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import repeat
from typing import Any

import numpy as np

from ehlectric.axle.solution import (
    AxleSolution,
    Element,
    axle_warnings,
    bearing_elements,
    load_of,
    loads_of_axles,
    machine_notes,
    mesh_element,
    mesh_warnings,
    named_warnings,
    naming_torque,
    thinnest_first,
)
from ehlectric.bearing import Detail, codes_of, is_quick, many_of, solve_bearing, solved_parts
from ehlectric.cases.axle_case import AxleCase, Turning
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.discharge_inputs import AxleDischarge
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.cases.input_keys import is_quantity
from ehlectric.cases.table_edits import flattened
from ehlectric.drive import measured_edge
from ehlectric.errors import ConvergenceError, InputError, within
from ehlectric.formulas.shaft_statics import BearingLoads
from ehlectric.gear import GearSolution, open_area, reference_area_of, solve_loose_pairs
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.display import is_number

# Solution of an axle, or why it has none.
Outcome = AxleSolution | InputError | ConvergenceError

# Element with its warnings, or why it has no film.
_Solved = tuple[Element, tuple[ResultWarning, ...]] | InputError | ConvergenceError


# Oils whose values are kept.
_OILS = 64

# Key of the roughness, which films within their error are compared with.
_ROUGHNESS = "bearing.composite_rq"


@dataclass(frozen=True)
class FilmScales:
    """Factors on the films of an axle within their error, and on what the state of its flanks depends."""

    bearings: float = 1.0  # factor on all films of bearings
    meshes: float = 1.0  # factor on all films of meshes
    summits: float = 0.0  # step of the height of the summits of flanks, divided by their composite Rq
    area: float = 1.0  # factor on the reference area of the share of time of meshes


@dataclass(frozen=True)
class _Axle:
    """Axle with speeds and loads, before its films are known."""

    case: AxleCase
    turning: dict[str, Turning]
    loads: dict[str, BearingLoads]
    scales: FilmScales | None = None  # only ratios of voltages are used if there are any


@dataclass(frozen=True)
class _Mounted:
    """Bearing of one of many axles."""

    place: int  # place of the axle among all
    number: int  # number of the bearing on its axle
    axle: _Axle
    radial: float  # radial load [N]
    axial: float  # axial force along z [N]
    # Values of the bearing file by dotted key: numbers of quantities in SI units, and everything else.
    values: dict[str, float]
    names: str

    @property
    def name(self) -> str:
        """Name of the bearing."""
        return self.axle.case.names_of_bearings()[self.number]

    @property
    def mounting(self) -> tuple[str, str, float]:
        """Name of the bearing, its shaft, and its axial force along z [N]."""
        return self.name, self.axle.case.bearing[self.number].shaft, self.axial

    @property
    def case(self) -> BearingCase:
        """Case of the bearing."""
        speed = self.axle.turning[self.axle.case.bearing[self.number].shaft].speed
        case = self.axle.case.bearing_case(self.number, speed, self.radial, abs(self.axial))
        if self.axle.scales is None:
            return case
        return case.replace({_ROUGHNESS: self.values[_ROUGHNESS]})


def solve_axles(
    cases: Iterable[AxleCase], *, scales: Iterable[FilmScales | None] = repeat(None)
) -> list[Outcome]:
    """Axles as ``solve_elements`` solves them, or the errors of axles without a solution, in their order.

    The text of a warning is the meaning of its code. ``scales`` of the films of each axle: such axles have no
    warnings, and capacitances without these factors, from fewer loads on the elements.
    """
    outcomes: dict[int, Outcome] = {}
    axles: dict[int, _Axle] = {}
    mounted: list[_Mounted] = []
    given = list(cases)
    for place, (case, scale, loads) in enumerate(zip(given, scales, loads_of_axles(given), strict=False)):
        if isinstance(loads, Exception):
            outcomes[place] = loads
            continue
        try:
            axle = _Axle(case, case.turning(), loads, scale)
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
            *axle_warnings(axle.case, axle.turning, axle.loads),
            *thinnest_first(
                [element for element, _ in known],
                [(element.name, of_element) for element, of_element in known],
            ),
        )
    )
    elements = tuple(element for element, _ in known)
    edge, of_source = measured_edge(axle.case.source)
    solution = AxleSolution(axle.case, axle.turning, elements, (*of_source, *warnings), edge)
    return replace(solution, warnings=(*solution.warnings, *machine_notes(solution)))


def _mounted(place: int, axle: _Axle) -> Iterator[_Mounted]:
    """Bearings of an axle with the values of their files."""
    case = axle.case
    for number, bearing in enumerate(case.bearing):
        shared, text = _of_oil(case.oil_of(number), case.strength_of(number), case.drive.contacts)
        radial, axial = load_of(case, number, axle.loads)
        keys = {"radial_load": radial, "axial_load": abs(axial)} | case.keys_of_bearing(number)
        keys |= {
            "inner_speed": abs(axle.turning[bearing.shaft].speed),
            "temperature": case.drive.temperature,
        }
        if axle.scales is not None:
            given = keys.get("composite_rq")
            rq = given if is_number(given) else case.tables_of_bearings[number].composite_rq
            # Films that are f times as thick are films on surfaces with the roughness Rq/f, times f.
            keys["composite_rq"] = rq / axle.scales.bearings
        values, names = _split({"bearing": keys})
        texts = f"{names!r}, {[*values]}, {text}"
        yield _Mounted(place, number, axle, radial, axial, values | shared, texts)


@lru_cache(_OILS)
def _of_oil(
    lubricant: Lubricant, discharge: AxleDischarge, contacts: str | None
) -> tuple[dict[str, float], str]:
    """Oil and strength of bearing files: numbers of quantities by dotted key, and a text with all else."""
    given = {"lubricant": lubricant, "discharge": discharge}
    tables = {name: each.model_dump(mode="json", exclude_none=True) for name, each in given.items()}
    values, names = _split(tables)
    return values, f"{names!r}, {[*values]}, {contacts}"


def _split(tables: Mapping[str, Any]) -> tuple[dict[str, float], dict[str, Any]]:
    """Numbers of quantities in nested tables by dotted key, and everything else."""
    values: dict[str, float] = {}
    names: dict[str, Any] = {}
    for key, value in flattened(tables).items():
        (values if is_number(value) and is_quantity(key) else names)[key] = value
    return values, names


def _solved_bearings(mounted: Iterable[_Mounted]) -> dict[tuple[int, int], _Solved]:
    """Elements of all bearings by the place of the axle and the number of the bearing."""
    groups: dict[str, list[_Mounted]] = {}
    for each in mounted:
        groups.setdefault(each.names, []).append(each)
    solved: dict[tuple[int, int], _Solved] = {}
    for group in groups.values():
        for each, element in zip(group, _of_group(group), strict=True):
            solved[each.place, each.number] = element
    return solved


def _of_group(group: Sequence[_Mounted]) -> list[_Solved]:
    """Elements of bearings that differ in quantities only."""
    if len(group) == 1:
        return [_alone(each) for each in group]
    columns = {key: np.array([each.values[key] for each in group]) for key in group[0].values}
    arrays = {key: column for key, column in columns.items() if np.ptp(column) != 0.0}
    solved: dict[int, _Solved] = {}
    try:
        first = group[0].case
        if not is_quick(first):
            return [_alone(each) for each in group]
        detail: Detail = "whole" if group[0].axle.scales is None else "coarse"
        for part in solved_parts(many_of(first, arrays, len(group)), detail=detail):
            places = part.points.tolist()
            solved |= zip(places, _elements([group[place] for place in places], part.solution), strict=True)
    except InputError:
        # Alone, each bearing has its own reason.
        return [_alone(each) for each in group]
    return [solved[place] if place in solved else _alone(each) for place, each in enumerate(group)]


def _elements(group: Sequence[_Mounted], solution: Any) -> list[_Solved]:
    """Elements of bearings that were solved together, with their warnings."""
    count = len(group)
    if group[0].axle.scales is not None:
        elements = bearing_elements(solution, [each.mounting for each in group])
        return [
            (_scaled(element, each.axle.scales), ()) for element, each in zip(elements, group, strict=True)
        ]
    masks = [(code, np.broadcast_to(where, count)) for code, where in codes_of(solution)]
    elements = bearing_elements(solution, [each.mounting for each in group])
    return [
        (
            element,
            tuple(ResultWarning.in_general(code) for code, mask in masks if mask[place]),
        )
        for place, element in enumerate(elements)
    ]


def _scaled(element: Element, scales: FilmScales | None) -> Element:
    """Element of a bearing with films that are ``scales.bearings`` times as thick."""
    voltage = element.breakdown_voltage
    if scales is None or voltage is None:
        return element
    return replace(element, breakdown_voltage=voltage * scales.bearings)


def _alone(mounted: _Mounted) -> _Solved:
    """Element of a single bearing."""
    try:
        of_bearing = mounted.case
    except InputError as error:
        # Its load is beyond the bounds of a file; the error names the bearing.
        return error
    try:
        with naming_torque(mounted.axle.case, mounted.number, of_bearing):
            result = solve_bearing(of_bearing, workers=1)
    except (InputError, ConvergenceError) as error:
        if isinstance(error, InputError):
            named = "" if error.key == "drive.torque" else f" ({mounted.name})"
            return error.with_text(error.key or "bearing", f"{error.text}{named}")
        return error
    (element,) = bearing_elements(result.solution, [mounted.mounting])
    return _scaled(element, mounted.axle.scales), result.warnings


def _solved_meshes(axles: Mapping[int, _Axle]) -> dict[tuple[int, int], _Solved]:
    """Elements of all meshes by the place of the axle and the number of the mesh."""
    solved: dict[tuple[int, int], _Solved] = {}
    places: list[tuple[int, int]] = []
    pairs: list[GearCase] = []
    # Pairs with the oil of the axle, by what they are made of.
    known: dict[tuple[Any, ...], GearCase] = {}
    for place, axle in axles.items():
        for number in range(len(axle.case.mesh)):
            try:
                pairs.append(_pair(axle, number, known))
                places.append((place, number))
            except InputError as error:
                solved[place, number] = error
    whole = any(axle.scales is None for axle in axles.values())
    for (place, number), outcome in zip(places, solve_loose_pairs(pairs, unloaded=whole), strict=True):
        case = axles[place].case
        if isinstance(outcome, InputError):
            solved[place, number] = outcome.under(f"mesh.{number + 1}.pair")
        elif isinstance(outcome, ConvergenceError):
            solved[place, number] = outcome
        else:
            element = mesh_element(case.names_of_meshes()[number], case.mesh[number].gears, outcome)
            scales = axles[place].scales
            if scales is None:
                torque = case.torque_of_gear(number, axles[place].turning)
                solved[place, number] = element, tuple(mesh_warnings(outcome, torque))
            else:
                solved[place, number] = _scaled_mesh(element, outcome, scales), ()
    return solved


def _scaled_mesh(element: Element, solution: GearSolution, scales: FilmScales) -> Element:
    """Element of a mesh with other films, summits and reference area."""
    film = scales.meshes * float(np.nanmin(solution.films.minimum))
    gap = film - (solution.case.gear.summit_height + scales.summits) * solution.rq
    area = scales.area * reference_area_of(solution.case)
    share = -np.expm1(open_area(solution.loads, solution.films, solution.rq / scales.meshes) / area)
    strength = solution.strength
    return replace(
        element,
        touching=strength is not None and gap <= 0.0,
        breakdown_voltage=strength * gap if strength is not None and gap > 0.0 else None,
        contact_time_share=float(solution.loads.mean(share)),
        lambda_ratio=film / solution.rq,
    )


def _pair(axle: _Axle, number: int, known: dict[tuple[Any, ...], GearCase]) -> GearCase:
    """Gear pair of a mesh at the operating point of its axle."""
    case = axle.case
    parts = case.mesh[number], case.lubricant, case.discharge, case.drive.contacts
    if parts not in known:
        known[parts] = case.gear_case(number, axle.turning)
    numbers = case.gear_operation(number, axle.turning).items()
    with within(f"mesh.{number + 1}.pair"):
        return changed_pair(
            known[parts],
            {f"gear.operation.{key}": value for key, value in numbers if is_number(value)},
        )
