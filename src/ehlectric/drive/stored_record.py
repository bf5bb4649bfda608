"""Records of simulated times in NetCDF files: of a drive and its remedies together, of an axle one by one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.drive_record import COLUMNS, KEPT, Record
from ehlectric.quantities.field_metadata import arrays_of, stored
from ehlectric.runtime.file_rules import Rule, UnfitError
from ehlectric.runtime.stored import Part, check_parts

if TYPE_CHECKING:
    import xarray as xr

_event = partial(stored, "event", count="event_count")
_sample = partial(stored, "sample", count="sample_count")

# Dimension of the voltages of the trace of an axle: across all films, and of all shafts.
_VOLTAGES = "voltage"


@dataclass(frozen=True)
class EventColumns:
    """Columns of the events of a record, in their order; ``bearing`` is the number of the film."""

    begin: Array = field(metadata=_event("s"))
    end: Array = field(metadata=_event("s"))
    bearing: Array = field(metadata=_event("", "0 or 1", dtype="i8"))
    voltage: Array = field(metadata=_event("V"))
    charge: Array = field(metadata=_event("C"))
    energy: Array = field(metadata=_event("J", "not negative"))
    peak_current: Array = field(metadata=_event("A", "not negative"))
    position: Array = field(metadata=_event("", "whole", dtype="i8"))


@dataclass(frozen=True)
class SampleColumns:
    """Columns of the trace of a record; the last ones are voltages across films and of shafts."""

    time: Array = field(metadata=_sample("s"))
    source: Array = field(metadata=_sample("V"))
    voltage: Array = field(metadata=stored("sample bearing", "V", count="sample_count"))


@dataclass(frozen=True)
class StoredRecord:
    """Variables of records.

    Records of a drive are ``over`` a dimension of variants. A record of an axle has a ``name``, with which
    the names of its variables and dimensions begin, because a remedy may change what discharges.
    """

    name: str = ""
    over: tuple[str, ...] = ()

    @property
    def parts(self) -> tuple[Part, Part, Part]:
        """Record, events and trace."""
        films = {"name": f"{self.name}_event_film", "rule": "whole"}
        samples = {"dims": ("sample", _VOLTAGES)}
        return (
            self._part(Record),
            self._part(EventColumns, "event_", bearing=films),
            self._part(SampleColumns, "sample_", voltage=samples),
        )

    def _part(self, kind: type[Any], prefix: str = "", **changed: Mapping[str, Any]) -> Part:
        """Variables for the fields of a class; in an axle, names begin with this record."""
        if not self.name:
            return Part(kind, self.over, prefix)
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
        """Name of a dimension; a film of an axle is a bearing or a mesh."""
        return f"{self.name}_{'film' if name == 'bearing' else name}" if self.name else name

    @property
    def others(self) -> dict[str, tuple[str, tuple[str, ...]]]:
        """Names and dimensions of variables for the fields that the part of the record does not contain."""
        if not self.name:
            return {"limits": ("limit", ("limit",))}
        limit, shaft, value = map(self.dimension, ("limit", "shaft", "value"))
        return {
            "limits": (f"{self.name}_limits", (limit,)),
            "shafts": (f"{self.name}_shafts", (shaft, value)),
        }

    def variables(self, records: Sequence[Record]) -> dict[str, Any]:
        """Variables of records, of which an axle has one."""
        columns: tuple[list[Any], ...] = (
            [*records],
            [EventColumns(*each.events.T) for each in records],
            [SampleColumns(each.trace[:, 0], each.trace[:, 1], each.trace[:, 2:]) for each in records],
        )
        variables: dict[str, Any] = {}
        for part, objects in zip(self.parts, columns, strict=True):
            variables |= part.written(objects if self.over else objects[0])
        of_others = {
            name: (dims, getattr(records[0], key), {"units": "V"})
            for key, (name, dims) in self.others.items()
        }
        return variables | of_others

    def check(self, dataset: xr.Dataset, sizes: Mapping[str, int], further: Sequence[Part] = ()) -> None:
        """Check all variables, and the ``sizes`` of dimensions by their names without the name of the record.

        Raises UnfitError where a variable is missing, or is not as it was written.
        """
        rules = {
            name: Rule(dims, "increasing" if key == "limits" else "finite", "V")
            for key, (name, dims) in self.others.items()
        }
        check_parts(dataset, [*self.parts, *further], rules)
        bins = dataset.sizes[self.dimension("bin")]
        for name, size in {**sizes, "column": COLUMNS, "edge": bins + 1}.items():
            if dataset.sizes[self.dimension(name)] != size:
                raise UnfitError(f"{self.dimension(name)} has not {size} values")

    def read(self, values: Mapping[str, Array], *at: int, voltages: int) -> Record:
        """Record with the values of variables by their names, of which one is ``at`` a place.

        Raises UnfitError where the events contradict their numbers. ``voltages``, number of films and shafts.
        """
        of_record, of_events, of_samples = self.parts
        events, samples = (
            EventColumns(**of_events.read(values, *at)),
            SampleColumns(**of_samples.read(values, *at)),
        )
        known: dict[str, Any] = of_record.read(values, *at)
        known |= {key: values[name] for key, (name, _) in self.others.items()}
        numbers = np.sum(known["counts"], axis=-1)
        films = np.bincount(events.bearing.astype(int), minlength=numbers.size)
        complete = events.begin.size < KEPT
        # The events one by one are among those that are counted.
        if films.size > numbers.size or np.any(films > numbers) or (complete and np.any(films != numbers)):
            names = of_events.fields["bearing"].name, of_record.fields["counts"].name
            raise UnfitError(f"{names[0]} does not belong to {names[1]}")
        columns = [getattr(events, each.name) for each in fields(events)]
        trace = [samples.time, samples.source, samples.voltage.reshape(-1, voltages)]
        return Record(**known, events=np.column_stack(columns).astype(float), trace=np.column_stack(trace))
