"""Stored form of the result of an axle, axle.nc: its variables in SI units, and the solutions of such a file.

A file contains the drive file with its gear files, and the films of all elements of the axle and of its
remedies. Names, speeds and torques follow from the case.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle.axle_discharges import AxleDischarges
from ehlectric.axle.axle_duty import STATES, AxleDuty
from ehlectric.axle.solution import AxleSolution, Element
from ehlectric.axle.stored_discharges import discharge_attributes, discharge_variables
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.axle_keys import HOUSING
from ehlectric.drive import Edge
from ehlectric.quantities.result_warnings import CODES_OF_TEXTS, TEXTS, ResultWarning, warnings_of
from ehlectric.runtime.file_rules import UnfitError, case_of, is_list, is_number, is_table, is_text, json_of
from ehlectric.runtime.files import plain
from ehlectric.runtime.netcdf import Layout

if TYPE_CHECKING:
    import xarray as xr

# Name and version of the layout of axle.nc.
SCHEMA = "ehlectric.axle.result/1"

_DIMENSIONS = ("variant", "element")

# Fields of an element that are numbers, with whether they may be missing.
_NUMBERS = {
    "capacitance": False,
    "breakdown_voltage": True,
    "contact_time_share": False,
    "lambda_ratio": False,
    "radial_load": True,
    "axial_load": True,
    "touching": False,
    "film_error": False,
}


def layout_of(
    solutions: Sequence[AxleSolution],
    seconds: float,
    version: str,
    *,
    probable: bool,
    duty: AxleDuty | None = None,
    discharges: Sequence[AxleDischarges | None] = (),
) -> Layout:
    """Variables and attributes of an axle.nc, SI units, from which ``solutions_of`` makes equal solutions.

    ``solutions`` of the axle, and of the axle with each of its remedies; ``probable``, whether the result
    contains the probabilities of the elements; ``discharges`` over time of each solution, or of none.
    """
    count = max(len(solution.elements) for solution in solutions)
    warnings = [[[each.code, each.text] for each in solution.warnings] for solution in solutions]
    return Layout(
        {
            **{name: (_DIMENSIONS, _column(solutions, name, count)) for name in _NUMBERS},
            **_duty_variables(duty),
            **discharge_variables(discharges),
        },
        {
            "schema": SCHEMA,
            "version": version,
            "case": solutions[0].case.to_toml(),
            "warnings": _text(warnings),
            **_edge_attribute(solutions),
            "seconds": seconds,
            "probable": int(probable),
            **({} if duty is None else {"duty": _text(_duty_attributes(duty))}),
            **discharge_attributes(discharges),
        },
    )


# Variables of a duty cycle with their dimensions.
_ROWS, _OF_ELEMENTS = ("row",), ("row", "element")
_DUTY: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(("time", "speed", "torque", "temperature"), _ROWS),
    **dict.fromkeys(("voltages", "limits", "states"), _OF_ELEMENTS),
}


def _duty_variables(duty: AxleDuty | None) -> dict[str, Any]:
    """Variables of the rows of a duty cycle; none without one."""
    if duty is None:
        return {}
    return {
        f"duty_{name}": (dims, np.asarray(getattr(duty, name), dtype=float)) for name, dims in _DUTY.items()
    }


def _duty_attributes(duty: AxleDuty) -> dict[str, Any]:
    warnings = [[each.code, each.text] for each in duty.warnings]
    return {"source": duty.source, "points": duty.points, "warnings": warnings}


def duty_of(dataset: xr.Dataset, case: AxleCase) -> AxleDuty | None:
    """Duty cycle of a dataset of ``layout_of``; None without one. Raises UnfitError as ``solutions_of``."""
    if "duty" not in dataset.attrs:
        return None
    about = json_of(
        dataset.attrs,
        "duty",
        lambda value: is_table(value, {"source": is_text, "points": is_number, "warnings": _are_warnings}),
    )
    columns = {}
    for name, dims in _DUTY.items():
        variable = f"duty_{name}"
        if variable not in dataset or tuple(dataset[variable].dims) != dims:
            raise UnfitError(f"{variable} is missing, or has other dimensions")
        columns[name] = np.asarray(dataset[variable].values, dtype=float)
    states, elements = columns.pop("states"), case.keys_of_elements()
    if states.shape[1] != len(elements) or not np.all(np.isin(states, range(len(STATES)))):
        raise UnfitError("duty_states is not the state of each element")
    return AxleDuty(
        source=about["source"],
        names=tuple(elements.values()),
        keys=tuple(elements),
        states=states.astype(int),
        points=int(about["points"]),
        warnings=_warnings(about["warnings"]),
        **columns,
    )


def _warnings(rows: Sequence[Sequence[str]]) -> tuple[ResultWarning, ...]:
    """Warnings from rows of code and text."""
    return warnings_of({CODES_OF_TEXTS: [row[0] for row in rows], TEXTS: [row[1] for row in rows]})


def _column(solutions: Sequence[AxleSolution], name: str, count: int) -> Array:
    """Numbers of a field of all elements, NaN where an element has none, shape (variants, elements)."""
    column = np.full((len(solutions), count), math.nan)
    for row, solution in zip(column, solutions, strict=True):
        for place, element in enumerate(solution.elements):
            value = getattr(element, name)
            row[place] = math.nan if value is None else float(value)
    return column


def _text(value: Any) -> str:
    import json

    return json.dumps(plain(value))


def solutions_of(dataset: xr.Dataset) -> tuple[AxleSolution, ...]:
    """Solutions of a dataset of ``layout_of``, first without remedies. Raises UnfitError where a variable or
    an attribute is missing, or is not as it was written.
    """
    case = case_of(dataset.attrs, AxleCase.from_dict)
    cases = [case, *case.variants()]
    warnings = json_of(dataset.attrs, "warnings", lambda value: is_list(value, _are_warnings))
    columns, edges = {name: _read(dataset, name) for name in _NUMBERS}, _edges(dataset, len(warnings))
    (variants, count) = columns["capacitance"].shape
    if variants not in (1, len(cases)) or len(warnings) != variants:
        raise UnfitError(f"it has {variants} variants of an axle with {len(case.remedies)} remedies")
    if any(column.shape != (variants, count) for column in columns.values()):
        raise UnfitError("its variables differ in their shape")
    return tuple(
        AxleSolution(
            of_variant,
            of_variant.turning(),
            tuple(_elements(of_variant, {name: column[k] for name, column in columns.items()})),
            _warnings(warnings[k]),
            edges[k],
        )
        for k, of_variant in enumerate(cases[:variants])
    )


def _edge_attribute(solutions: Sequence[AxleSolution]) -> dict[str, str]:
    """Largest edge of the measured source of each solution; none for a described source."""
    edges = [solution.measured_edge for solution in solutions]
    return {} if None in edges else {"edges": _text(edges)}


def _edges(dataset: xr.Dataset, variants: int) -> list[Edge | None]:
    """Largest edge of the measured source of each variant; None for a described source."""
    if "edges" not in dataset.attrs:
        return [None] * variants
    rows = json_of(dataset.attrs, "edges", lambda value: is_list(value, lambda row: is_list(row, is_number)))
    if len(rows) != variants or any(len(row) != len(Edge._fields) for row in rows):
        raise UnfitError("edges is not as it was written")
    return [Edge(*row) for row in rows]


def _are_warnings(value: Any) -> bool:
    """Whether a value is a list of codes and texts of warnings."""
    return is_list(
        value,
        lambda row: is_list(row, is_text) and len(row) == 2,
    )


def _read(dataset: xr.Dataset, name: str) -> Array:
    """Numbers of a field, shape (variants, elements)."""
    if name not in dataset or tuple(dataset[name].dims) != _DIMENSIONS:
        raise UnfitError(f"{name} is missing, or has other dimensions")
    values = np.asarray(dataset[name].values)
    if values.dtype.kind != "f" or np.any(np.isinf(values)):
        raise UnfitError(f"{name} is not a number")
    return values


def _elements(case: AxleCase, rows: dict[str, Array]) -> list[Element]:
    """Elements of an axle from the numbers of their fields, shape (elements,)."""
    bearings = [
        {"name": name, "kind": "bearing", "first": bearing.shaft, "second": HOUSING}
        for name, bearing in zip(case.names_of_bearings(), case.bearing, strict=True)
    ]
    meshes = [
        {
            "name": name,
            "kind": "mesh",
            "first": mesh.gears[0],
            "second": mesh.gears[1],
            "conduction": mesh.pair.gear.contact.conduction,
        }
        for name, mesh in zip(case.names_of_meshes(), case.mesh, strict=True)
    ]
    fields: list[dict[str, Any]] = [*bearings, *meshes]
    if len(fields) > rows["capacitance"].size:
        raise UnfitError(f"it has {rows['capacitance'].size} elements of {len(fields)}")
    for place, values in enumerate(fields):
        for name, optional in _NUMBERS.items():
            value = float(rows[name][place])
            if math.isnan(value) and not optional:
                raise UnfitError(f"{name} of {values['name']} is not a number")
            values[name] = None if math.isnan(value) else value
        values["touching"] = bool(values["touching"])
    return [Element(**values) for values in fields]
