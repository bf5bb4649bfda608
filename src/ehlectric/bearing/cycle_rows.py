"""Rows of a duty cycle, of a bearing or a drive: states, stretches of rows, duty.csv, and stored form."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.lubrication_states import BOUNDARY, BOUNDARY_LIMIT, FREQUENT, FULL, MIXED
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.runtime.display import Values, read_only_property
from ehlectric.runtime.file_rules import UnfitError
from ehlectric.runtime.files import Content, column_head, csv_of
from ehlectric.runtime.result_names import DUTY
from ehlectric.runtime.stored import (
    Part,
    check_parts,
    many_numbers_of,
    numbers_of,
    read_many_numbers,
    read_numbers,
    values_of,
    warnings_in_tables,
)

if TYPE_CHECKING:
    import xarray as xr

# States of a bearing by their numbers, and their words in the former column "state" of duty.csv.
STATES = ("standstill", "touching", "partial film", "full film", "not computed")
STANDSTILL, TOUCHING, PARTIAL_FILM, FULL_FILM, LEFT_OUT = range(len(STATES))

# Largest number of stretches that are listed, the worst first.
MOST_STRETCHES = 10


@dataclass(frozen=True, eq=False, repr=False)
class CycleRows(Values):
    """Rows of a duty cycle, SI units; a subclass has their films, and ``state``, numbers in ``STATES``."""

    time: Array = field(metadata=stored("duty_row", "s", "increasing"))
    duration: Array = field(metadata=stored("duty_row", "s", "positive"))  # time for which a row stands
    speed: Array = field(metadata=stored("duty_row", "rad/s"))

    def share(self, within: Mask) -> float:
        """Share of the time of some rows, from 0 to 1."""
        return float(np.sum(self.duration[within]) / np.sum(self.duration))


def edges_of(time: Array) -> Array:
    """Times between rows, halfway, with the first and the last time as ends, shape (n + 1,)."""
    return np.concatenate([time[:1], 0.5 * (time[1:] + time[:-1]), time[-1:]])


def stretches_of(within: Mask) -> list[tuple[int, int]]:
    """Return the places of the first row of each stretch, and of the row after it.

    Examples
    --------
    >>> stretches_of(np.array([True, True, False, True]))
    [(0, 2), (3, 4)]
    """
    ends = np.flatnonzero(np.diff(np.concatenate([[0], within, [0]])))
    return [(int(first), int(after)) for first, after in ends.reshape(-1, 2)]


def lubrication_names(state: Array, ratio: Array) -> Array:
    """Return the state of lubrication of each row as a text, "standstill" or "not computed", shape (n,).

    ``state``, numbers of the states; ``ratio``, lambda ratios; both of shape (n,).

    Examples
    --------
    >>> lubrication_names(np.array([0, 1, 1, 2]), np.array([np.nan, 0.5, 1.5, 2.5])).tolist()
    ['standstill', 'boundary lubrication', 'frequent asperity contact', 'mixed lubrication']
    """
    words = (STATES[STANDSTILL], FREQUENT.name, MIXED.name, FULL.name, STATES[LEFT_OUT])
    names = np.array(words, dtype=object)[state.astype(int)]
    return np.where((state == TOUCHING) & (ratio < BOUNDARY_LIMIT), BOUNDARY.name, names)


# Column of a table over the rows of a cycle: SI unit, None for texts, and values, shape (n,).
Written = tuple[str | None, Array]


def written_columns(
    columns: Mapping[str, Array], about: Mapping[str, Mapping[str, str]]
) -> dict[str, Written]:
    """Columns of a duty cycle with their units, the state of each row as a text.

    ``columns``, values of the rows by name, shape (n,); ``about``, unit of a column by its name, or by the
    part of it after a point, none for a text.
    """
    written: dict[str, Written] = {}
    for name, values in columns.items():
        quantity = name.rpartition(".")[2]
        unit = about[quantity].get("unit")
        if quantity == "state":
            table = name.removesuffix(quantity)
            names = lubrication_names(values, columns[f"{table}lambda_ratio"])
            written |= {f"{table}lubrication_state": (None, names)}
            written[name] = (None, np.array(STATES, dtype=object)[values.astype(int)])
            continue
        written[name] = (None if unit is None else unit.removeprefix("-"), values)
    return written


def duty_csv(columns: Mapping[str, Written]) -> dict[str, Content]:
    """Content of duty.csv by its name, from ``written_columns``; NaN is empty."""
    heads = [name if unit is None else column_head(name, unit) for name, (unit, _) in columns.items()]
    cells = [["" if value != value else value for value in shown.tolist()] for _, shown in columns.values()]
    return {DUTY: csv_of(heads, zip(*cells, strict=True))}


class _Result(Protocol):
    """Result of a duty cycle."""

    def __init__(self, **values: Any) -> None: ...

    @property
    def rows(self) -> CycleRows: ...

    @property
    def warnings(self) -> tuple[ResultWarning, ...]: ...


R = TypeVar("R", bound=_Result)


@dataclass(frozen=True)
class StoredDuty(Generic[R]):
    """Duty cycle in the file of a result: a variable for each quantity of its rows, and attributes with its
    numbers, its lists of objects and its warnings.
    """

    kind: type[R]
    rows: type[CycleRows]
    lists: Mapping[str, type[Any]]  # class of the objects of a list, by the name of its field
    # Lists that files of version 1.0 do not contain; the field then keeps its default.
    later: Mapping[str, type[Any]] = field(default_factory=dict)
    name: str = "duty"  # of the attribute with the numbers, and before the names of all others

    @read_only_property
    def _part(self) -> Part:
        return Part(self.rows, prefix=f"{self.name}_")

    def variables(self, duty: R | None) -> dict[str, Any]:
        """Variables of the rows; none without a duty cycle."""
        return {} if duty is None else self._part.written(duty.rows)

    def attributes(self, duty: R | None) -> dict[str, str]:
        """Attributes of everything else; none without a duty cycle."""
        if duty is None:
            return {}
        names = (*self.lists, *self.later)
        lists = {f"{self.name}_{name}": many_numbers_of(getattr(duty, name)) for name in names}
        warnings = json.dumps(texts_and_codes(duty.warnings))
        return {self.name: numbers_of(duty), f"{self.name}_warnings": warnings, **lists}

    def read(self, dataset: xr.Dataset) -> R | None:
        """Duty cycle with these variables and attributes; None without one. Raises UnfitError where one is
        missing, or is not as it was written.
        """
        attributes = dataset.attrs
        if self.name not in attributes:
            return None
        check_parts(dataset, [self._part])
        values = self._part.read(values_of(dataset))
        if np.any(values["state"] >= len(STATES)):
            raise UnfitError(f"{self.name}_state is no state")
        known = {name: kind for name, kind in self.later.items() if f"{self.name}_{name}" in attributes}
        lists: dict[str, Any] = {
            name: tuple(kind(**row) for row in read_many_numbers(kind, attributes, f"{self.name}_{name}"))
            for name, kind in {**self.lists, **known}.items()
        }
        return self.kind(
            rows=self.rows(**values),
            **lists,
            **read_numbers(self.kind, attributes, self.name),
            warnings=warnings_in_tables(attributes, depth=0, name=f"{self.name}_warnings"),
        )
