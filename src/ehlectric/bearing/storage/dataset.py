"""Dataset of a solved bearing, SI units, and the solution of such a dataset."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingConditions, ContactFriction
from ehlectric.bearing.contacts import ContactCurve, ContactSolution, ContactValues
from ehlectric.bearing.loads.kinematics import Speeds
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution, Position, RingState
from ehlectric.bearing.storage.content import EQUILIBRIA, FRICTION, HEAT, RINGS, UNITS, check
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.runtime.checks.schema import UnfitError, case_of
from ehlectric.runtime.stored_warnings import texts_and_codes, warnings_of

if TYPE_CHECKING:
    import xarray as xr

# Name and version of the layout of bearing.nc.
SCHEMA = "ehlectric.bearing.solution/1"


def dataset_of(solution: BearingSolution) -> xr.Dataset:
    """Dataset of a solved bearing.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    xarray.Dataset
        Variables over loads, cage positions, rings and elements, SI units. Its attributes hold the case, so
        that ``solution_of`` returns an equal solution.
    """
    import xarray as xr

    variables: dict[str, tuple[tuple[str, ...], Array, dict[str, str]]] = {}
    for name, curve in zip(RINGS, solution.curves, strict=True):
        variables |= _curve_variables(name, curve)
    states = [position.rings for position in solution.positions]
    for name in ("load", "gap", "solved"):
        variables[name] = _over_elements(name, [[getattr(ring, name) for ring in pair] for pair in states])
    for name in ContactValues.__dataclass_fields__:
        stack = [[getattr(ring.values, name) for ring in pair] for pair in states]
        variables[name] = _over_elements(name, stack)
    variables |= _equilibrium_variables([position.equilibrium for position in solution.positions])
    shape = solution.positions[0].shape
    return xr.Dataset(
        variables,
        coords={"ring": list(RINGS)},
        attrs={
            "schema": SCHEMA,
            "version": solution.version,
            "case": solution.case.to_toml(),
            "seconds": solution.seconds,
            "equilibrium": type(solution.positions[0].equilibrium).__name__,
            **_solved_heat(solution),
            "weibull_shape": "" if shape is None else repr(shape),
            "contact_angle": [ring.angle for ring in (solution.inner, solution.outer)],
            "entrainment_speed": [ring.speed for ring in (solution.inner, solution.outer)],
            "warnings": json.dumps(
                [[texts_and_codes(one.warnings) for one in curve.solutions] for curve in solution.curves]
            ),
        },
    )


def _solved_heat(solution: BearingSolution) -> dict[str, list[float | None]]:
    """Attributes with the solved heat and friction of both rings; none of any other case."""
    if solution.case.bearing.film_factor != "solved":
        return {}
    rings = (solution.conditions.inner, solution.conditions.outer)
    friction = [vars(own.friction) for own in rings if own.friction is not None]
    pairs = {HEAT: [own.heat_factor for own in rings]}
    if len(friction) == len(rings):
        pairs |= {
            FRICTION + name: [np.nan if own[name] is None else own[name] for own in friction]
            for name in friction[0]
        }
    return pairs


def _heated(
    conditions: BearingConditions[Any], case: BearingCase, dataset: xr.Dataset
) -> BearingConditions[Any]:
    """Conditions with the solved factors of the heat, and with the friction, that a file has."""
    if case.bearing.film_factor != "solved":
        return conditions
    if HEAT not in dataset.attrs:
        raise UnfitError(f"{HEAT} is missing")
    inner, outer = (
        own.heated(float(dataset.attrs[HEAT][k]), _friction_of(dataset, k))
        for k, own in enumerate((conditions.inner, conditions.outer))
    )
    return replace(conditions, inner=inner, outer=outer)


def _friction_of(dataset: xr.Dataset, ring: int) -> ContactFriction | None:
    """Friction of the most loaded contact with a ring; None in a file of an earlier version."""
    if FRICTION + "load" not in dataset.attrs:
        return None
    names = [field.name for field in dataclasses.fields(ContactFriction)]
    numbers = {name: float(dataset.attrs[FRICTION + name][ring]) for name in names}
    error = numbers.pop("temperature_rise_error")
    return ContactFriction(**numbers, temperature_rise_error=None if np.isnan(error) else error)


def _over_elements(name: str, values: Any) -> tuple[tuple[str, ...], Array, dict[str, str]]:
    return ("cage_position", "ring", "element"), np.array(values), {"units": UNITS.get(name, "")}


def _curve_variables(ring: str, curve: ContactCurve) -> dict[str, Any]:
    """Variables of the solved contacts with one ring over their load; NaN where an error is unknown."""
    solutions, dims = curve.solutions, (f"{ring}_load",)
    columns = dict(zip(ContactValues.__dataclass_fields__, curve.stack().columns(), strict=True))
    others = {
        "load": curve.loads,
        "error": np.array([np.nan if one.error is None else one.error for one in solutions]),
        "moes_m": np.array([one.moes_m for one in solutions]),
        "moes_l": np.array([one.moes_l for one in solutions]),
        "mismatch": np.array([one.mismatch for one in solutions]),
        "converged": np.array([one.converged for one in solutions]),
    }
    return {
        f"{ring}_curve_{name}": (dims, values, {"units": UNITS.get(name, "")})
        for name, values in (columns | others).items()
    }


def _equilibrium_variables(equilibria: Sequence[Equilibrium]) -> dict[str, Any]:
    """Variables of the equilibria over the cage positions, each with its own further dimensions."""
    elements = equilibria[0].position.size
    variables = {}
    for name, values in _stacked(equilibria).items():
        sizes = {0: (), 1: ("element",) if values.shape[1:] == (elements,) else ("slice",)}
        dims = ("cage_position", *sizes.get(values.ndim - 1, ("element", "slice")))
        variables[f"equilibrium_{name}"] = (dims, values)
    return variables


def _stacked(equilibria: Sequence[Equilibrium]) -> dict[str, Array]:
    """Quantities of the equilibria by name, stacked over the cage positions; speeds have a prefix."""
    tables = []
    for at in equilibria:
        table = {field.name: getattr(at, field.name) for field in dataclasses.fields(at)}
        speeds = vars(table.pop("speeds"))
        tables.append(table | {f"speeds_{name}": value for name, value in speeds.items()})
    return {name: np.array([table[name] for table in tables]) for name in tables[0]}


def solution_of(dataset: xr.Dataset) -> BearingSolution:
    """Solution of a dataset that ``dataset_of`` made.

    Raises
    ------
    UnfitError
        Where a variable or an attribute is missing, or is not as it was written.
    InputError
        Where its case cannot be resolved.
    """
    attributes = dataset.attrs
    case = case_of(attributes, BearingCase.from_dict)
    check(dataset)
    conditions = _heated(resolve_bearing(case), case, dataset)
    stored = json.loads(attributes["warnings"])
    inner, outer = (
        RingContacts(conditions, name == "inner", float(angle), float(speed))
        for name, angle, speed in zip(
            RINGS, attributes["contact_angle"], attributes["entrainment_speed"], strict=True
        )
    )
    inner_curve, outer_curve = (
        _curve_of(dataset, name, texts) for name, texts in zip(RINGS, stored, strict=True)
    )
    shape = float(attributes["weibull_shape"]) if attributes["weibull_shape"] else None
    positions = tuple(
        Position(_equilibrium_of(dataset, k), _state_of(dataset, k, 0), _state_of(dataset, k, 1), shape)
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
        seconds=float(attributes["seconds"]),
        version=str(attributes["version"]),
    )


def _curve_of(dataset: xr.Dataset, ring: str, stored: Sequence[Mapping[str, Any]]) -> ContactCurve:
    names = (*ContactValues.__dataclass_fields__, "load", "error", "moes_m", "moes_l", "mismatch")
    columns = {name: _known(dataset, f"{ring}_curve_{name}", f"{ring}_curve_load") for name in names}
    converged = dataset[f"{ring}_curve_converged"].values
    return ContactCurve(
        tuple(
            _contact_of(
                {name: float(column[k]) for name, column in columns.items()},
                texts,
                converged=bool(converged[k]),
            )
            for k, texts in enumerate(stored)
        )
    )


def _known(dataset: xr.Dataset, name: str, other: str) -> Array:
    """Values of a variable; NaN, in the shape of another variable, where an earlier version has none."""
    if name in dataset:
        return np.asarray(dataset[name].values)
    return np.full(dataset[other].shape, np.nan)


def _contact_of(
    numbers: Mapping[str, float], stored: Mapping[str, Any], *, converged: bool
) -> ContactSolution:
    error = numbers["error"]
    return ContactSolution(
        load=numbers["load"],
        values=ContactValues(**{name: numbers[name] for name in ContactValues.__dataclass_fields__}),
        error=None if np.isnan(error) else error,
        moes_m=numbers["moes_m"],
        moes_l=numbers["moes_l"],
        mismatch=numbers["mismatch"],
        converged=converged,
        warnings=warnings_of(stored),
    )


def _state_of(dataset: xr.Dataset, position: int, ring: int) -> RingState:
    def at(name: str) -> Array:
        return np.asarray(_known(dataset, name, "load")[position, ring])

    return RingState(
        load=at("load"),
        gap=at("gap"),
        solved=at("solved").astype(bool),
        values=ContactValues(**{name: at(name) for name in ContactValues.__dataclass_fields__}),
    )


def _equilibrium_of(dataset: xr.Dataset, position: int) -> Equilibrium:
    kind = EQUILIBRIA[dataset.attrs["equilibrium"]]

    def at(name: str) -> Any:
        values = dataset[f"equilibrium_{name}"].values[position]
        return values.item() if values.ndim == 0 else values

    speeds = Speeds(**{field.name: at(f"speeds_{field.name}") for field in dataclasses.fields(Speeds)})
    names = {field.name for field in dataclasses.fields(kind)} - {"speeds"}
    return kind(speeds=speeds, **{name: at(name) for name in names})
