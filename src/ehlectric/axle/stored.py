"""Stored form of the result of an axle, axle.nc: its variables in SI units, and the solutions of such a file.

A file contains the drive file with its gear files, and the films of all elements of the axle and of its
remedies. Names, speeds and torques follow from the case.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
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
from ehlectric.runtime.stored import Part, check_parts, values_of

if TYPE_CHECKING:
    import xarray as xr

# Name and version of the layout of axle.nc.
SCHEMA = "ehlectric.axle.result/1"

# Numbers of the elements of each variant, which end with NaN where another one has more elements.
_ELEMENTS = Part(Element, ("variant", "element"))
_NONE = Element("", "bearing", "", HOUSING, math.nan, None, math.nan, math.nan, film_error=math.nan)

# Rows of a duty cycle.
_DUTY = Part(AxleDuty, prefix="duty_")


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
    rows = [[*each.elements, *[_NONE] * (count - len(each.elements))] for each in solutions]
    return Layout(
        {
            **_ELEMENTS.written(rows),
            **({} if duty is None else _DUTY.written(duty)),
            **discharge_variables(discharges),
        },
        {
            "schema": SCHEMA,
            "version": version,
            "case": solutions[0].case.to_toml(),
            "warnings": _text([_rows_of(solution.warnings) for solution in solutions]),
            **_edge_attribute(solutions),
            "seconds": seconds,
            "probable": int(probable),
            **({} if duty is None else {"duty": _text(_duty_attributes(duty))}),
            **discharge_attributes(discharges),
        },
    )


def _duty_attributes(duty: AxleDuty) -> dict[str, Any]:
    return {"source": duty.source, "points": duty.points, "warnings": _rows_of(duty.warnings)}


def duty_of(dataset: xr.Dataset, case: AxleCase) -> AxleDuty | None:
    """Duty cycle of a dataset of ``layout_of``; None without one. Raises UnfitError as ``solutions_of``."""
    if "duty" not in dataset.attrs:
        return None
    about = json_of(
        dataset.attrs,
        "duty",
        lambda value: is_table(value, {"source": is_text, "points": is_number, "warnings": _are_warnings}),
    )
    check_parts(dataset, [_DUTY])
    columns = _DUTY.read(values_of(dataset))
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


def _rows_of(warnings: Sequence[ResultWarning]) -> list[list[str]]:
    """Rows of code and text of warnings."""
    return [[each.code, each.text] for each in warnings]


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
    check_parts(dataset, [_ELEMENTS])
    values, edges, variants = values_of(dataset), _edges(dataset, len(warnings)), dataset.sizes["variant"]
    if variants not in (1, len(cases)) or len(warnings) != variants:
        raise UnfitError(f"it has {variants} variants of an axle with {len(cases) - 1} remedies")
    return tuple(
        AxleSolution(
            of_variant,
            of_variant.turning(),
            tuple(_elements(of_variant, values, k)),
            _warnings(warnings[k]),
            edges[k],
        )
        for k, of_variant in enumerate(cases[:variants])
    )


def _edge_attribute(solutions: Sequence[AxleSolution]) -> dict[str, str]:
    """Largest edge of the measured source of each solution; none for a described source."""
    edges = [solution.measured_edge for solution in solutions]
    return {"edges": _text(edges)} if any(edges) else {}


def _edges(dataset: xr.Dataset, variants: int) -> list[Edge | None]:
    """Largest edge of the measured source of each variant; None for a described source."""
    if "edges" not in dataset.attrs:
        return [None] * variants
    rows = json_of(dataset.attrs, "edges", lambda value: is_list(value, _is_edge))
    if len(rows) != variants:
        raise UnfitError("edges is not as it was written")
    return [None if row is None else Edge(*row) for row in rows]


def _is_edge(value: Any) -> bool:
    """Whether a value is the height and the rise time of an edge, or null."""
    return value is None or (is_list(value, is_number) and len(value) == len(Edge._fields))


def _are_warnings(value: Any) -> bool:
    """Whether a value is a list of codes and texts of warnings."""
    return is_list(
        value,
        lambda row: is_list(row, is_text) and len(row) == 2,
    )


def _elements(case: AxleCase, values: Mapping[str, Array], variant: int) -> Iterator[Element]:
    """Elements of a variant of an axle from the variables of a file."""
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
    named: list[dict[str, Any]] = [*bearings, *meshes]
    if len(named) > (count := values["capacitance"].shape[1]):
        raise UnfitError(f"it has {count} elements of {len(named)}")
    for place, about in enumerate(named):
        numbers = _ELEMENTS.read(values, variant, place)
        for name, value in numbers.items():
            if value is not None and math.isnan(value):
                raise UnfitError(f"{name} of {about['name']} is not a number")
        yield Element(**about, **numbers | {"touching": bool(numbers["touching"])})
