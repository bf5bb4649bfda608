"""Dataset of a result of a drive, SI units, and the result of such a dataset."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.meter.path import Path
from ehlectric.cases.drives.case import ENDS, DriveCase
from ehlectric.drive.bearings import BearingElement
from ehlectric.drive.discharges.record import COLUMNS, FILM, PLACE, Record
from ehlectric.drive.solution import DriveSolution
from ehlectric.drive.storage.content import (
    COUNTS,
    ELEMENTS,
    END,
    EVENTS,
    LATER,
    PATHS,
    RULES,
    SAMPLES,
    VARIANT,
    check,
)
from ehlectric.runtime.checks.schema import case_of
from ehlectric.runtime.stored_warnings import TEXTS, texts_and_codes, warnings_of

if TYPE_CHECKING:
    import xarray as xr

# Title, changes and solution of each remedy.
Remedies = Sequence[tuple[str, dict[str, Any], DriveSolution]]

# Name and version of the layout of drive.nc.
SCHEMA = "ehlectric.drive.result/1"

# Columns of an event that are whole numbers.
_WHOLE = (FILM, PLACE)


def dataset_of(solution: DriveSolution, remedies: Remedies, seconds: float, version: str) -> xr.Dataset:
    """Dataset of a result of a drive.

    Parameters
    ----------
    solution : DriveSolution
        Solved drive.
    remedies : sequence of (str, dict, DriveSolution)
        Title, changes and solution of each remedy.
    seconds : float
        Computing time [s].
    version : str
        Version of ehlectric that solved it.

    Returns
    -------
    xarray.Dataset
        Variables over the drive and its remedies, both bearings, events, bins of the voltage, lines of the
        spectrum and samples of the trace; SI units. Its attributes hold the case, so that ``parts_of``
        returns equal values.
        Without events it has no variables of events.
    """
    import xarray as xr

    solutions = [solution, *(found for _, _, found in remedies)]
    records = [one.record for one in solutions]
    elements = [one.elements for one in solutions]
    values: dict[str, Any] = {
        "limit": records[0].limits,
        "event_count": [len(one.events) for one in records],
        "line_count": [len(one.spectrum) for one in records],
        "sample_count": [len(one.trace) for one in records],
        "position_count": [[one.capacitance.size for one in pair] for pair in elements],
        "position_capacitance": np.concatenate([one.capacitance for pair in elements for one in pair]),
        "position_breakdown": np.concatenate([one.breakdown for pair in elements for one in pair]),
        "duration": [one.duration for one in records],
        "highest_source": [one.highest_source for one in solutions],
        "divider": [one.divider for one in solutions],
        "converged": [one.converged for one in solutions],
        "block_events": [one.counts for one in records],
        "event_sum": [one.sums for one in records],
        "event_largest": [one.largest for one in records],
        "voltage_edge": [one.edges for one in records],
        "time_at_voltage": [one.histogram for one in records],
        "time_above": [one.above for one in records],
        "peak_voltage": [one.peak for one in records],
        "rms_voltage": [one.rms for one in records],
        "burning_time": [one.burning for one in records],
        "touching_voltage": [one.touching for one in records],
    }
    for name in ELEMENTS:
        values[f"element_{name}"] = [[getattr(one, name) for one in pair] for pair in elements]
    for name in PATHS:
        pairs = [[getattr(one.path, name) for one in pair] for pair in elements]
        values[f"path_{name}"] = np.array(pairs, dtype=float)  # None becomes NaN
    values |= _events(np.concatenate([one.events for one in records]))
    lines = np.concatenate([one.spectrum for one in records])
    values |= {"line_amplitude": lines} if len(lines) else {}
    values |= _samples(np.concatenate([one.trace for one in records]))
    return xr.Dataset(
        {name: _variable(name, found) for name, found in values.items()},
        coords={END: list(ENDS)},
        attrs={
            "schema": SCHEMA,
            "version": version,
            "case": solution.case.to_toml(),
            "seconds": seconds,
            TEXTS: json.dumps([texts_and_codes(one.told) for one in solutions]),
        },
    )


def _variable(name: str, values: Any) -> tuple[tuple[str, ...], Any, dict[str, str]]:
    array = np.array(values)
    return RULES[name].dims, array.astype(np.int8) if array.dtype == bool else array, _units(name)


def _units(name: str) -> dict[str, str]:
    unit = RULES[name].unit
    return {} if unit is None else {"units": unit}


def _events(events: Array) -> dict[str, Array]:
    """Variables of events; none without an event, as a dimension of a file has a size."""
    if not len(events):
        return {}
    whole = dict.fromkeys(_WHOLE, np.int64)
    return {
        name: events[:, column].astype(whole.get(column, np.float64)) for column, name in enumerate(EVENTS)
    }


def _samples(trace: Array) -> dict[str, Array]:
    if not len(trace):
        return {}
    return {"sample_time": trace[:, 0], "sample_source": trace[:, 1], "sample_voltage": trace[:, 2:]}


def parts_of(dataset: xr.Dataset) -> tuple[DriveSolution, Remedies, float, str]:
    """Solution, remedies, computing time [s] and version of a dataset that ``dataset_of`` made.

    Raises
    ------
    UnfitError
        Where a variable or an attribute is missing, or is not as it was written.
    """
    attributes = dataset.attrs
    case = case_of(attributes, DriveCase.from_dict)
    check(dataset, 1 + len(case.remedies))
    sizes = {VARIANT: 1 + len(case.remedies), END: 2}
    arrays = {name: np.zeros([sizes[one] for one in RULES[name].dims]) for name in LATER}
    arrays |= {str(name): np.asarray(dataset[name].values) for name in dataset.variables}
    cases = [case, *case.variants()]
    told = [warnings_of(one) for one in json.loads(attributes[TEXTS])]
    solutions = [
        DriveSolution(
            case=own,
            elements=_elements_of(arrays, k),
            record=_record_of(arrays, k),
            divider=(float(arrays["divider"][k, 0]), float(arrays["divider"][k, 1])),
            highest_source=float(arrays["highest_source"][k]),
            converged=bool(arrays["converged"][k]),
            told=told[k],
        )
        for k, own in enumerate(cases)
    ]
    remedies = tuple(
        (one.title, dict(one.changes), found) for one, found in zip(case.remedies, solutions[1:], strict=True)
    )
    return solutions[0], remedies, float(attributes["seconds"]), str(attributes["version"])


def _part(arrays: dict[str, np.ndarray], dimension: str, number: int) -> slice:
    """Part of a dimension along which the values of all variants, or of all bearings, follow each other."""
    ends = np.concatenate([[0], np.cumsum(arrays[COUNTS[dimension]].ravel())]).astype(int)
    return slice(int(ends[number]), int(ends[number + 1]))


def _elements_of(arrays: dict[str, np.ndarray], k: int) -> tuple[BearingElement, BearingElement]:
    first, second = (_element_of(arrays, k, b) for b in range(2))
    return first, second


def _element_of(arrays: dict[str, np.ndarray], k: int, b: int) -> BearingElement:
    part = _part(arrays, "position", 2 * k + b)
    path = {name: float(arrays[f"path_{name}"][k, b]) for name in PATHS}
    breakdown = path.pop("coating_breakdown")
    return BearingElement(
        capacitance=arrays["position_capacitance"][part],
        breakdown=arrays["position_breakdown"][part],
        path=Path(**path, coating_breakdown=None if np.isnan(breakdown) else breakdown),
        **{name: float(arrays[f"element_{name}"][k, b]) for name in ELEMENTS},
    )


def _record_of(arrays: dict[str, np.ndarray], k: int) -> Record:
    return Record(
        duration=float(arrays["duration"][k]),
        events=_columns(arrays, tuple(EVENTS), COLUMNS, _part(arrays, "event", k)),
        counts=arrays["block_events"][k],
        sums=arrays["event_sum"][k],
        largest=arrays["event_largest"][k],
        edges=arrays["voltage_edge"][k],
        histogram=arrays["time_at_voltage"][k],
        limits=arrays["limit"],
        above=arrays["time_above"][k],
        peak=arrays["peak_voltage"][k],
        rms=arrays["rms_voltage"][k],
        spectrum=arrays.get("line_amplitude", np.zeros(0))[_part(arrays, "line", k)],
        burning=arrays["burning_time"][k],
        touching=arrays["touching_voltage"][k],
        trace=_columns(arrays, SAMPLES, 4, _part(arrays, "sample", k)),
    )


def _columns(arrays: dict[str, np.ndarray], names: Sequence[str], width: int, part: slice) -> Array:
    """Table of variables side by side, in a part of their rows; empty where the file has none."""
    if names[0] not in arrays:
        return np.zeros((0, width))
    return np.column_stack([arrays[name][part] for name in names]).astype(float)
