"""Stored form of a drive's result, drive.nc: its dataset in SI units, and the result of such a dataset."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import KEYS as LIFE_KEYS
from ehlectric.bearing import CycleLife, Path, StoredDuty, with_smooth_films
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.drive_cycle import DriveDuty, DriveDutyRows, DriveStretch, Expected
from ehlectric.drive.drive_record import DriveSolution
from ehlectric.drive.stored_record import StoredRecord
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import TEXTS, texts_and_codes
from ehlectric.runtime.file_rules import (
    UnfitError,
    case_of,
    is_list,
    is_number_or_null,
    is_table,
    is_text,
    json_of,
    number_of,
    text_of,
)
from ehlectric.runtime.stored import Part, values_of, warnings_in_tables

if TYPE_CHECKING:
    import xarray as xr

# Title, changes and solution of each remedy.
Remedies = Sequence[tuple[str, dict[str, Any], DriveSolution]]

# Name and version of the layout of drive.nc.
SCHEMA = "ehlectric.drive.result/1"

# The drive as it is comes first along the first dimension, and its remedies follow.
_VARIANT, _END = "variant", "bearing"


_RECORDS, _SOLUTION = StoredRecord(over=(_VARIANT,)), Part(DriveSolution, (_VARIANT,))
_ELEMENT, _PATH = Part(BearingElement, (_VARIANT, _END), "element_"), Part(Path, (_VARIANT, _END), "path_")
_DUTY = StoredDuty(
    DriveDuty,
    DriveDutyRows,
    {"discharges": Expected, "energy": Expected, "stretches": DriveStretch},
    {"lives": CycleLife},
)


def dataset_of(
    solution: DriveSolution,
    remedies: Remedies,
    duties: Sequence[DriveDuty | None],
    seconds: float,
    version: str,
) -> xr.Dataset:
    """Dataset of a result of a drive, SI units. ``duties``, results of the duty cycle of the drive and of
    each remedy; None without one.

    Its variables are over the drive and its remedies, both bearings, events, bins of the voltage, lines of
    the spectrum and samples of the trace. Its attributes hold the case, so that ``parts_of`` returns equal
    values.
    """
    import xarray as xr

    solutions = [solution, *(solved for _, _, solved in remedies)]
    elements = [part.elements for part in solutions]
    of_records = _RECORDS.variables([part.record for part in solutions])
    coordinates = {_END: list(ENDS), "limit": of_records.pop("limit")}
    return xr.Dataset(
        {
            **_SOLUTION.written(solutions),
            **of_records,
            **_ELEMENT.written(elements),
            **_PATH.written([[part.path for part in pair] for pair in elements]),
            **{key: part for k, duty in enumerate(duties) for key, part in _duty(k).variables(duty).items()},
        },
        coords=coordinates,
        attrs={
            "schema": SCHEMA,
            "version": version,
            "case": solution.case.to_toml(),
            "seconds": seconds,
            TEXTS: json.dumps([texts_and_codes(part.prior_warnings) for part in solutions]),
            _LIVES: json.dumps([list(part.lives) for part in solutions]),
            **{key: part for k, duty in enumerate(duties) for key, part in _duty(k).attributes(duty).items()},
        },
    )


def _duty(variant: int) -> StoredDuty[DriveDuty]:
    """Duty cycle of the drive, or of a remedy by its number from 1."""
    return replace(_DUTY, name=f"remedy_{variant}_duty") if variant else _DUTY


def duties_of(dataset: xr.Dataset, remedies: int) -> tuple[DriveDuty | None, tuple[DriveDuty, ...]]:
    """Return the duty-cycle results of a drive, None without a cycle, and of each remedy, from a dataset that
    ``dataset_of`` made. Files of version 1.0 have no cycles of remedies.

    Raises UnfitError if a variable or an attribute is missing, or is not as it was written.
    """
    of_drive, *others = (_duty_of(dataset, variant) for variant in range(1 + remedies))
    known = tuple(duty for duty in others if duty is not None)
    if len(known) not in (0, remedies):
        raise UnfitError("some mitigation measures have no duty cycle")
    return of_drive, known


def _duty_of(dataset: xr.Dataset, variant: int) -> DriveDuty | None:
    """Result of the duty cycle of the drive, or of a remedy by its number from 1; None without one."""
    duty = _duty(variant).read(dataset)
    if duty is not None and any(
        len(pair) != len(ENDS) for pair in (duty.discharges, duty.energy, duty.lives)
    ):
        raise UnfitError("discharges, energy or lives of a duty cycle have not the values of two bearings")
    return duty


def parts_of(dataset: xr.Dataset) -> tuple[DriveSolution, Remedies, float, str]:
    """Solution, remedies, computing time [s] and version of a dataset that ``dataset_of`` made. Raises
    UnfitError where a variable or an attribute is missing, or is not as it was written.
    """
    attributes = dataset.attrs
    case = case_of(attributes, _case)
    cases = [case, *case.variants()]
    check(dataset, len(cases))
    values, prior_warnings = values_of(dataset), warnings_in_tables(attributes)
    if len(prior_warnings) != len(cases):
        raise UnfitError(f"{TEXTS} is not as it was written")
    lives = _lives(attributes, len(cases))
    solutions = [
        _solution_of(values, k, case=variant, prior_warnings=prior_warnings[k], lives=lives[k])
        for k, variant in enumerate(cases)
    ]
    remedies = tuple(
        (remedy.title, dict(remedy.changes), solved)
        for (_, remedy), solved in zip(case.numbered_remedies, solutions[1:], strict=True)
    )
    return solutions[0], remedies, number_of(attributes, "seconds"), text_of(attributes, "version")


# Attribute with the rating lives of both bearings of the drive and of each remedy.
_LIVES = "lives"


def _is_text_or_null(value: Any) -> bool:
    return value is None or is_text(value)


def _lives(attributes: Mapping[Any, Any], variants: int) -> list[tuple[dict[str, Any], ...]]:
    """Rating lives of both bearings of each variant; none for a file of version 1.0."""
    if _LIVES not in attributes:
        return [()] * variants
    checks = {key: _is_text_or_null if key.endswith("_source") else is_number_or_null for key in LIFE_KEYS}
    ends = partial(is_list, right=partial(is_table, columns=checks))
    lives = json_of(attributes, _LIVES, partial(is_list, right=ends))
    if len(lives) != variants or any(len(pair) != len(ENDS) for pair in lives):
        raise UnfitError(f"{_LIVES} is not as it was written")
    return [tuple(pair) for pair in lives]


def _case(tables: dict[str, Any]) -> DriveCase:
    """Case of the tables in a file; the films of its bearings are smooth where the file knows no summits."""
    bearings = {end: with_smooth_films(tables[end]) for end in ENDS if isinstance(tables.get(end), dict)}
    return DriveCase.from_dict(tables | bearings)


def _solution_of(values: Mapping[str, Array], k: int, **given: Any) -> DriveSolution:
    record = _RECORDS.read(values, k, voltages=len(ENDS))
    first, second = (
        BearingElement(**_ELEMENT.read(values, k, b), path=Path(**_PATH.read(values, k, b)))
        for b in range(len(ENDS))
    )
    parts = _SOLUTION.read(values, k)
    divider = tuple(parts.pop("divider").tolist())
    return DriveSolution(**parts, **given, divider=divider, elements=(first, second), record=record)


def check(dataset: xr.Dataset, variants: int) -> None:
    """Check the variables of a drive.nc with a number of variants before any of them is used. Raises
    UnfitError where a variable is missing, or is not as it was written.
    """
    _RECORDS.check(dataset, {_VARIANT: variants, _END: len(ENDS)}, (_SOLUTION, _ELEMENT, _PATH))
    if np.any(dataset["position_count"].values < 1):
        raise UnfitError("position_count is not positive")
