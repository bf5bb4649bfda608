"""Sweeps of drives on their page: inputs that may vary, and results that are shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.drive_fields import DRIVE_GROUPS
from ehlectric.app.form_fields.field import Field
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.changes import flattened
from ehlectric.cases.drive_case import DriveCase
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import BOTH, ENDS
from ehlectric.sweep.sweep_inputs import check_varied


def values_of(case: DriveCase) -> dict[str, Any]:
    """Values of a drive by the keys that a sweep may vary; equal bearings have one key for both."""
    found = {}
    for key, value in _by_key(case.to_dict(), same=case.drive_end == case.non_drive_end):
        try:
            check_varied(key, case)
        except InputError:
            continue
        found[key] = value
    return found


def texts_of(table: Mapping[str, Any], case: DriveCase) -> dict[str, Any]:
    """Texts of the tables of a drive by the same keys."""
    return dict(_by_key(table, same=case.drive_end == case.non_drive_end))


def fields() -> dict[str, Field]:
    """Fields of a drive by key, with those of both bearings."""
    found = {field.key: field for group in DRIVE_GROUPS for field in group.fields}
    both = (replace(field, key=f"{BOTH}.{field.key}") for group in BEARING_GROUPS for field in group.fields)
    return {**found, **{field.key: field for field in both}}


def in_tables(table: Mapping[str, Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by the keys of the tables of a drive: those of both bearings at each end."""
    ends = [end for end in ENDS if end in table]
    found: dict[str, Any] = {}
    for key, value in values.items():
        first, _, rest = key.partition(".")
        found |= {f"{end}.{rest}": value for end in ends} if first == BOTH else {key: value}
    return found


def _by_key(table: Mapping[str, Any], *, same: bool) -> Iterator[tuple[str, Any]]:
    rest = {key: value for key, value in table.items() if key not in (*ENDS, "remedies")}
    yield from flattened(Inputs(rest).table).items()
    if same:
        yield from ((f"{BOTH}.{key}", value) for key, value in flattened(dict(table[ENDS[0]])).items())
        return
    for end in ENDS:
        yield from ((f"{end}.{key}", value) for key, value in flattened(dict(table.get(end, {}))).items())
