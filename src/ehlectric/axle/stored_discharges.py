"""Discharges over time in axle.nc: the record of the axle, and the record with each remedy.

Each record has its own variables and dimensions, because a remedy may change which elements discharge.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ehlectric.axle.axle_discharges import AxleDischarges
from ehlectric.axle.solution import AxleSolution
from ehlectric.drive import StoredRecord
from ehlectric.runtime.file_rules import UnfitError, is_list, is_table, is_text, json_of
from ehlectric.runtime.stored import values_of

if TYPE_CHECKING:
    import xarray as xr

_COLUMNS = dict.fromkeys(("elements", "shafts"), partial(is_list, right=is_text))


def _stored(variant: int) -> StoredRecord:
    """Record of the axle, or of a remedy by its number from 1."""
    return StoredRecord(f"remedy_{variant}_simulation" if variant else "simulation")


def _read(dataset: xr.Dataset, stored: StoredRecord) -> AxleDischarges | None:
    """Discharges with these variables; None without them."""
    if stored.name not in dataset.attrs:
        return None
    names = json_of(dataset.attrs, stored.name, partial(is_table, columns=_COLUMNS))
    films, shafts = len(names["elements"]), len(names["shafts"])
    stored.check(dataset, {"bearing": films, "shaft": shafts, "voltage": films + shafts})
    record = stored.read(values_of(dataset), voltages=films + shafts)
    return AxleDischarges(tuple(names["elements"]), tuple(names["shafts"]), record)


def discharge_variables(discharges: Sequence[AxleDischarges | None]) -> dict[str, Any]:
    """Variables of the discharges of an axle and with each remedy, in this order."""
    return {
        name: variable
        for variant, each in enumerate(discharges)
        if each is not None
        for name, variable in _stored(variant).variables([each.record]).items()
    }


def discharge_attributes(discharges: Sequence[AxleDischarges | None]) -> dict[str, str]:
    """Names of elements and shafts of each record, as attributes of the file."""
    return {
        _stored(variant).name: json.dumps({"elements": each.names, "shafts": each.shafts})
        for variant, each in enumerate(discharges)
        if each is not None
    }


def discharges_of(
    dataset: xr.Dataset, solutions: Sequence[AxleSolution]
) -> tuple[AxleDischarges | None, ...]:
    """Discharges of a dataset for the axle and for each remedy; empty for a file without them. Raises
    UnfitError where a record is missing, or is not as it was written.
    """
    records = tuple(_read(dataset, _stored(variant)) for variant in range(len(solutions)))
    if not any(records):
        return ()
    for each, solution in zip(records, solutions, strict=True):
        if each is None:
            continue
        films = {element.name for element in solution.elements}
        if not films.issuperset(each.names) or not set(solution.turning).issuperset(each.shafts):
            raise UnfitError("its discharges have not the elements and shafts of its case")
    return records
