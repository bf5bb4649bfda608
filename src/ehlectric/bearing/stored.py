"""Stored form of a solved bearing, bearing.nc: its dataset in SI units, and the solution of a dataset."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingConditions, ContactFriction
from ehlectric.bearing.cycle_life import CycleLife
from ehlectric.bearing.cycle_rows import StoredDuty
from ehlectric.bearing.duty_cycle import DutyResult, DutyRows
from ehlectric.bearing.loads.ball_loads import BallEquilibrium
from ehlectric.bearing.loads.geometry import Speeds
from ehlectric.bearing.loads.roller_loads import RollerEquilibrium
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.margin_cycle import Stretch
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.bearing.ring_contacts import ContactCurve, ContactSolution, ContactValues, RingContacts
from ehlectric.bearing.solution import BearingSolution, Position, RingState
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.runtime.file_rules import (
    VALUES,
    Rule,
    UnfitError,
    case_of,
    number_of,
    text_of,
    unfit_error,
)
from ehlectric.runtime.netcdf import Layout
from ehlectric.runtime.stored import (
    Part,
    check_parts,
    values_of,
    warnings_in_tables,
)

if TYPE_CHECKING:
    import xarray as xr

# Name and version of the layout of bearing.nc.
SCHEMA = "ehlectric.bearing.solution/1"

RINGS = ("inner", "outer")

# Attribute with the solved factors of the heat of both rings, where a case has them solved, and attributes
# with the friction of their most loaded contacts.
_HEAT, _FRICTIONS = "heat_factor", Part(ContactFriction, ("ring",), "solved_")

_DUTY = StoredDuty(DutyResult, DutyRows, {"stretches": Stretch}, {"lives": CycleLife})

# Contacts of all elements, and what these contacts are made of: solved contacts of each ring over the load.
_OVER = ("cage_position", "ring", "element")
_STATES, _VALUES = Part(RingState, _OVER), Part(ContactValues, _OVER)

# Quantities of loaded contacts; only the breakdown voltage is infinite.
_LOADED = "positive or infinite"
_QUANTITIES = tuple(name for name in _VALUES.fields if name != "hertz")
_CURVES, _CURVE_VALUES = (
    tuple(Part(kind, (f"{ring}_load",), f"{ring}_curve_", changed=changed) for ring in RINGS)
    for kind, changed in (
        (ContactSolution, {}),
        (ContactValues, {name: {"rule": _LOADED} for name in _QUANTITIES}),
    )
)

_EQUILIBRIA: Mapping[str, type[Equilibrium]] = {
    kind.__name__: kind for kind in (BallEquilibrium, RollerEquilibrium)
}
# Quantities of rollers that results of bearings with only cylindrical rollers did not have: they are zero.
_ANGLES, _ALONG = ("inner_angle", "outer_angle"), "axial_displacement"

# Dimensions of quantities of an equilibrium, after the positions of the cage.
_OF_EQUILIBRIA = ((), ("element",), ("slice",), ("element", "slice"))


def dataset_of(solution: BearingSolution, duty: DutyResult | None = None) -> xr.Dataset:
    """Dataset of a solved bearing over loads, cage positions, rings and elements, and of the rows of its duty
    cycle, SI units.

    Its attributes hold the case, so that ``solution_of`` returns an equal solution, and ``duty_of`` an equal
    duty cycle.
    """
    return layout_of(solution, duty).dataset()


def layout_of(solution: BearingSolution, duty: DutyResult | None = None) -> Layout:
    """Variables and attributes of the dataset of a solved bearing and its duty cycle."""
    variables: dict[str, Any] = {}
    for numbers, quantities, curve in zip(_CURVES, _CURVE_VALUES, solution.curves, strict=True):
        variables |= numbers.written(curve.solutions)
        variables |= quantities.written([contact.values for contact in curve.solutions])
    states = [position.rings for position in solution.positions]
    variables |= _STATES.written(states)
    variables |= _VALUES.written([[ring.values for ring in rings] for rings in states])
    variables |= _equilibrium_variables([position.equilibrium for position in solution.positions])
    variables |= _DUTY.variables(duty)
    rings, shape = (solution.inner, solution.outer), solution.positions[0].shape
    return Layout(
        variables | {"ring": ("ring", list(RINGS))},
        {
            "schema": SCHEMA,
            "version": solution.version,
            "case": solution.case.to_toml(),
            "seconds": solution.seconds,
            "equilibrium": type(solution.positions[0].equilibrium).__name__,
            **_solved_heat(solution),
            **_DUTY.attributes(duty),
            "weibull_shape": "" if shape is None else repr(shape),
            "contact_angle": [ring.angle for ring in rings],
            "entrainment_speed": [ring.speed for ring in rings],
            "warnings": json.dumps(
                [[texts_and_codes(at.warnings) for at in curve.solutions] for curve in solution.curves]
            ),
        },
    )


def duty_of(dataset: xr.Dataset) -> DutyResult | None:
    """Result of the duty cycle in a dataset that ``dataset_of`` made; None without one. Raises UnfitError
    where a variable or an attribute is missing, or is not as it was written.
    """
    duty = _DUTY.read(dataset)
    if duty is not None and len(duty.lives) != 1:
        raise UnfitError("duty_lives has not the values of one bearing")
    return duty


def _solved_heat(solution: BearingSolution) -> dict[str, Any]:
    """Attributes with the solved heat and friction of both rings; none of any other case."""
    if solution.case.bearing.film_factor != "solved":
        return {}
    rings = solution.conditions.rings
    frictions = [ring.friction for ring in rings]
    pairs: dict[str, Any] = {_HEAT: [ring.heat_factor for ring in rings]}
    if None not in frictions:
        pairs |= {name: values for name, (_, values, _) in _FRICTIONS.written(frictions).items()}
    return pairs


def _equilibrium_variables(equilibria: list[Equilibrium]) -> dict[str, Any]:
    """Variables of the equilibria over the cage positions, each with its own further dimensions."""
    elements, variables = equilibria[0].position.size, {}
    tables = [
        vars(at) | {f"speeds_{name}": value for name, value in vars(at.speeds).items()} for at in equilibria
    ]
    for name in _equilibrium_names(type(equilibria[0])):
        values = np.array([table[name] for table in tables])
        single = ("element",) if values.shape[1:] == (elements,) else ("slice",)
        dims = {0: (), 1: single}.get(values.ndim - 1, ("element", "slice"))
        variables[f"equilibrium_{name}"] = (("cage_position", *dims), values)
    return variables


def _equilibrium_names(kind: type[Equilibrium]) -> Iterator[str]:
    """Names of the quantities of an equilibrium; speeds have a prefix."""
    yield from (each.name for each in fields(kind) if each.name != "speeds")
    yield from (f"speeds_{each.name}" for each in fields(Speeds))


def solution_of(dataset: xr.Dataset) -> BearingSolution:
    """Solution of a dataset that ``dataset_of`` made. Raises UnfitError where a variable or an attribute is
    missing, or is not as it was written; InputError where its case cannot be resolved.
    """
    attributes = dataset.attrs
    case = case_of(attributes, _case)
    kind, warnings = _check(dataset)
    values = values_of(dataset)
    conditions = _heated(resolve_bearing(case), case, attributes)
    angles, speeds = _pair(attributes, "contact_angle"), _pair(attributes, "entrainment_speed")
    inner, outer = (RingContacts(conditions, k == 0, angles[k], speeds[k]) for k in range(2))
    inner_curve, outer_curve = (_curve_of(values, k, warnings[k]) for k in range(2))
    shape = _shape_of(text_of(attributes, "weibull_shape"))
    tracks = conditions.geometry.tracks
    positions = tuple(
        Position(
            equilibrium=_equilibrium_of(values, kind, k),
            inner=_state_of(values, k, 0),
            outer=_state_of(values, k, 1),
            shape=shape,
            tracks=tracks,
        )
        for k in range(dataset.sizes["cage_position"])
    )
    return BearingSolution(
        case=case,
        conditions=conditions,
        inner=inner,
        outer=outer,
        inner_curve=inner_curve,
        outer_curve=outer_curve,
        positions=positions,
        seconds=number_of(attributes, "seconds"),
        version=text_of(attributes, "version"),
    )


def _case(tables: dict[str, Any]) -> BearingCase:
    return BearingCase.from_dict(with_smooth_films(tables))


def with_smooth_films(tables: dict[str, Any]) -> dict[str, Any]:
    """Tables of the case of a bearing in a file, with smooth films where the file knows no summits."""
    bearing = tables.get("bearing")
    if not isinstance(bearing, dict):
        return tables
    return {**tables, "bearing": {"summit_height": 0.0, **bearing}}


def _curve_of(values: Mapping[str, Array], ring: int, warnings: list[Any]) -> ContactCurve:
    numbers, quantities = _CURVES[ring], _CURVE_VALUES[ring]
    return ContactCurve.of(
        tuple(
            ContactSolution(
                **numbers.read(values, k),
                values=ContactValues(**quantities.read(values, k)),
                warnings=texts,
            )
            for k, texts in enumerate(warnings)
        )
    )


def _state_of(values: Mapping[str, Array], *at: int) -> RingState:
    return RingState(**_STATES.read(values, *at), values=ContactValues(**_VALUES.read(values, *at)))


def _equilibrium_of(values: Mapping[str, Array], kind: type[Equilibrium], position: int) -> Equilibrium:
    inputs: dict[str, Any] = {}
    for name in _equilibrium_names(kind):
        variable = f"equilibrium_{name}"
        if variable in values:
            value = values[variable][position]
        else:
            value = np.zeros(values["equilibrium_inner_load"].shape[1:] if name in _ANGLES else ())
        inputs[name] = value.item() if value.ndim == 0 else value
    speeds = {each.name: inputs.pop(f"speeds_{each.name}") for each in fields(Speeds)}
    return kind(**inputs, speeds=Speeds(**speeds))


def _heated(
    conditions: BearingConditions[Any], case: BearingCase, attributes: Mapping[Any, Any]
) -> BearingConditions[Any]:
    """Conditions with the solved factors of the heat, and with the friction, that a file has."""
    if case.bearing.film_factor != "solved":
        return conditions
    factors = _pair(attributes, _HEAT, "positive")
    frictions: list[ContactFriction | None] = [None, None]
    if _FRICTIONS.fields["load"].name in attributes:
        entries = [each for each in _FRICTIONS.fields.values() if each.needed or each.name in attributes]
        pairs = {entry.name: np.array(_pair(attributes, entry.name, entry.rule)) for entry in entries}
        frictions = [ContactFriction(**_FRICTIONS.read(pairs, k)) for k in range(len(RINGS))]
    solved = zip(conditions.rings, factors, frictions, strict=True)
    inner, outer = (ring.heated(factor, friction) for ring, factor, friction in solved)
    return replace(conditions, inner=inner, outer=outer)


def _pair(attributes: Mapping[Any, Any], name: str, rule: str = "finite") -> tuple[float, float]:
    """Attribute with a number for each ring; raises an UnfitError where it is none."""
    if name not in attributes:
        raise UnfitError(f"{name} is missing")
    values = np.asarray(attributes[name])
    if values.dtype.kind not in "fiu" or values.shape != (len(RINGS),):
        raise UnfitError(f"{name} is not a number for each ring")
    if not VALUES[rule](values):
        raise unfit_error(name, values, rule)
    return float(values[0]), float(values[1])


def _check(dataset: xr.Dataset) -> tuple[type[Equilibrium], list[list[tuple[ResultWarning, ...]]]]:
    """Check the content of a bearing.nc; the class of its equilibria, and the warnings of its curves."""
    attributes = dataset.attrs
    name = text_of(attributes, "equilibrium")
    if name not in _EQUILIBRIA:
        raise UnfitError("equilibrium is no kind of equilibrium")
    kind = _EQUILIBRIA[name]
    check_parts(dataset, [_STATES, _VALUES, *_CURVES, *_CURVE_VALUES], _equilibrium_rules(dataset, kind))
    if dataset.sizes["ring"] != len(RINGS):
        raise UnfitError(f"it has {dataset.sizes['ring']} rings")
    solved = dataset["solved"].values.astype(bool)
    if not solved.any(axis=dataset["solved"].get_axis_num("element")).all():
        raise UnfitError("no contact of a ring is loaded")
    for quantity in ("load", *_QUANTITIES):
        if not VALUES[_LOADED](dataset[quantity].values[solved]):
            raise UnfitError(f"{quantity} of a loaded contact is not {_LOADED}")
    warnings = warnings_in_tables(attributes, depth=2)
    if [len(curve) for curve in warnings] != [dataset.sizes[f"{ring}_load"] for ring in RINGS]:
        raise UnfitError("warnings is not as it was written")
    return kind, warnings


def _equilibrium_rules(dataset: xr.Dataset, kind: type[Equilibrium]) -> dict[str, Rule]:
    """Rules for the variables of the equilibria, whose number of dimensions follows from the file."""
    rules = {}
    names = _equilibrium_names(kind)
    variables = (f"equilibrium_{name}" for name in names)
    later = () if kind is BallEquilibrium else tuple(f"equilibrium_{name}" for name in (*_ANGLES, _ALONG))
    for variable in variables:
        if variable in later and variable not in dataset:
            continue
        dims = tuple(map(str, dataset[variable].dims)) if variable in dataset else ()
        known = dims[:1] == ("cage_position",) and dims[1:] in _OF_EQUILIBRIA
        rules[variable] = Rule(dims if known else ("cage_position",))
    return rules


def _shape_of(text: str) -> float | None:
    """Shape parameter of a Weibull distribution; the text is empty where there is none."""
    if not text:
        return None
    try:
        shape = float(text)
    except ValueError:
        shape = 0.0
    if not 0.0 < shape < np.inf:
        raise UnfitError("weibull_shape is not positive")
    return shape
