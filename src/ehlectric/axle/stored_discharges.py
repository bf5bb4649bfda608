"""Discharges over time in axle.nc: the record of the axle, and the record with each remedy.

Each record has its own variables and dimensions, because a remedy may change which elements discharge.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.axle.axle_discharges import AxleDischarges
from ehlectric.axle.solution import AxleSolution
from ehlectric.drive import EventColumns, Record, SampleColumns, check_events
from ehlectric.quantities.field_metadata import arrays_of
from ehlectric.runtime.file_rules import Rule, UnfitError, is_list, is_table, is_text, json_of
from ehlectric.runtime.stored import Part, check_parts, values_of

if TYPE_CHECKING:
    import xarray as xr

# Dimension of the voltages of a trace: across all films, and of all shafts.
_VOLTAGES = "voltage"


@dataclass(frozen=True)
class _Stored:
    """Variables of a record; ``name`` is the attribute with the elements and shafts, and begins all names."""

    name: str

    def part(self, kind: type[Any], prefix: str = "", **changed: Mapping[str, Any]) -> Part:
        """Variables of the fields of a class, all with names and dimensions of this record."""
        entries = arrays_of(kind)
        names = {
            key: {
                "name": f"{self.name}_{prefix}{entry.name or key}",
                "count": entry.count and f"{self.name}_{entry.count}",
                **changed.get(key, {}),
            }
            for key, entry in entries.items()
        }
        dims = {dim for entry in entries.values() for dim in entry.dims}
        return Part(kind, axes={dim: (self.dimension(dim),) for dim in (*dims, _VOLTAGES)}, changed=names)

    def dimension(self, name: str) -> str:
        """Dimension of this record; a film is a bearing or a mesh."""
        return f"{self.name}_{'film' if name == 'bearing' else name}"

    @property
    def parts(self) -> tuple[Part, Part, Part]:
        """Record, events and trace."""
        films = {"name": f"{self.name}_event_film", "rule": "whole"}
        samples = {"dims": ("sample", _VOLTAGES)}
        return (
            self.part(Record),
            self.part(EventColumns, "event_", bearing=films),
            self.part(SampleColumns, "sample_", voltage=samples),
        )

    @property
    def others(self) -> dict[str, tuple[str, tuple[str, ...]]]:
        """Fields of the record that its part does not contain, with the dimensions of their variables."""
        limit, shaft, value = map(self.dimension, ("limit", "shaft", "value"))
        return {
            "limits": (f"{self.name}_limits", (limit,)),
            "shafts": (f"{self.name}_shafts", (shaft, value)),
        }

    def variables(self, discharges: AxleDischarges) -> dict[str, Any]:
        """Variables of the discharges of an axle."""
        record, (of_record, events, samples) = discharges.record, self.parts
        trace = record.trace
        return {
            **of_record.written(record),
            **events.written(EventColumns(*record.events.T)),
            **samples.written(SampleColumns(trace[:, 0], trace[:, 1], trace[:, 2:])),
            **{name: (dims, getattr(record, key)) for key, (name, dims) in self.others.items()},
        }

    def read(self, dataset: xr.Dataset) -> AxleDischarges:
        """Discharges with these variables. Raises UnfitError where one is not as it was written."""
        names = json_of(dataset.attrs, self.name, partial(is_table, columns=_COLUMNS))
        rules = {name: Rule(dims, "finite") for name, dims in self.others.values()}
        check_parts(dataset, self.parts, rules)
        films, shafts = len(names["elements"]), len(names["shafts"])
        for key, count in (("bearing", films), ("shaft", shafts), (_VOLTAGES, films + shafts)):
            if dataset.sizes[self.dimension(key)] != count:
                raise UnfitError(f"{self.dimension(key)} has not {count} values")
        values, (of_record, of_events, of_samples) = values_of(dataset), self.parts
        events, samples = EventColumns(**of_events.read(values)), SampleColumns(**of_samples.read(values))
        fields: dict[str, Any] = of_record.read(values)
        fields |= {key: values[name] for key, (name, _) in self.others.items()}
        counted = np.sum(fields["counts"], axis=-1)
        check_events(
            events.bearing.astype(int),
            counted,
            of_events.fields["bearing"].name,
            of_record.fields["counts"].name,
        )
        trace = np.column_stack([samples.time, samples.source, samples.voltage.reshape(-1, films + shafts)])
        record = Record(**fields, events=events.table(), trace=trace)
        return AxleDischarges(tuple(names["elements"]), tuple(names["shafts"]), record)


_COLUMNS = dict.fromkeys(("elements", "shafts"), partial(is_list, right=is_text))


def _stored(variant: int) -> _Stored:
    """Record of the axle, or of a remedy by its number from 1."""
    return _Stored(f"remedy_{variant}_simulation" if variant else "simulation")


def discharge_variables(discharges: Sequence[AxleDischarges | None]) -> dict[str, Any]:
    """Variables of the discharges of an axle and with each remedy, in this order."""
    return {
        name: variable
        for variant, each in enumerate(discharges)
        if each is not None
        for name, variable in _stored(variant).variables(each).items()
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
    stored = [_stored(variant) for variant in range(len(solutions))]
    if not any(each.name in dataset.attrs for each in stored):
        return ()
    records = tuple(each.read(dataset) if each.name in dataset.attrs else None for each in stored)
    for each, solution in zip(records, solutions, strict=True):
        if each is None:
            continue
        films = {element.name for element in solution.elements}
        if not films.issuperset(each.names) or not set(solution.turning).issuperset(each.shafts):
            raise UnfitError("its discharges have not the elements and shafts of its case")
    return records
