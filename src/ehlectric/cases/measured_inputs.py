"""Table ``measured`` of a case file: measured values with their uncertainties, at one or more points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from ehlectric.cases.measurements import (
    CALIBRATED,
    ColumnBook,
    Measurement,
    calibrated,
    read_measurement,
)
from ehlectric.cases.stated_ranges import value_and_uncertainty, with_uncertainty_text
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, shown
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

if TYPE_CHECKING:
    import pandas as pd


def _text(entry: object, info: ValidationInfo) -> object:
    """Refuse a number, which has neither a unit nor an uncertainty."""
    if isinstance(entry, int | float):
        quantity = calibrated(info.field_name or "")
        takes = with_uncertainty_text(entry, quantity, quantity.usual)
        raise InputError(got=shown(entry), takes=takes)
    return entry


# Measured value with its standard uncertainty, as a user writes it.
Written = Annotated[str | None, BeforeValidator(_text)]


class ShaftFile(Table, book="measured.shaft_record", named_by="file"):
    """Record of the shaft voltage, from which measured values follow."""

    file: str
    column: str | int | None = None
    common_mode_column: str | int | None = None
    time_column: str | int | None = None
    step: float | None = None
    time_unit: str | None = None
    value_unit: str | None = None
    scale: float = 1.0
    common_mode_scale: float = 1.0
    resample: float | None = None
    threshold: float | None = None
    gain_uncertainty: float = 0.03

    @model_validator(mode="before")
    @classmethod
    def _of_file(cls, table: Any) -> Any:
        return cls.of_name(table)


class Measured(Table, book="measured"):
    """Measured values, each with its standard uncertainty: "240 pF +- 5 %"."""

    file: str | None = None
    shaft_record: ShaftFile | None = None
    capacitance: Written = None
    first_breakdown_voltage: Written = None
    breakdown_voltage: Written = None
    shaft_voltage: Written = None
    shaft_voltage_rms: Written = None
    bearing_voltage_ratio: Written = None
    discharge_rate: Written = None
    conducting_share: Written = None
    inner_ring_temperature: Written = None
    outer_ring_temperature: Written = None
    film: Written = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check_measured(self)
        return self

    def values(self) -> dict[str, tuple[float, float]]:
        """Measured values and their standard uncertainties at the operating point of the case, SI units."""
        return {
            name: value_and_uncertainty(name, getattr(self, name), quantity, quantity.usual)
            for name, quantity in CALIBRATED.items()
            if getattr(self, name) is not None
        }


class MeasuredElement(Table, book="axle.measured.elements"):
    """Measured values of a bearing or a mesh of an axle, each with its standard uncertainty."""

    capacitance: Written = None
    breakdown_voltage: Written = None
    conducting_share: Written = None


class MeasuredShaft(Table, book="axle.measured.shafts"):
    """Measured values of a shaft of an axle, each with its standard uncertainty."""

    voltage: Written = None


class AxleMeasured(Table, book="axle.measured"):
    """Measured values of the elements and shafts of an axle, by the keys of elements and shafts."""

    file: str | None = None
    elements: dict[str, MeasuredElement] = Field(default_factory=dict)
    shafts: dict[str, MeasuredShaft] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _check(self) -> Self:
        _check_measured(self)
        return self

    def values(self) -> dict[str, tuple[float, float]]:
        """Measured values and their standard uncertainties at the operating point of the case, SI units."""
        tables: Mapping[str, Mapping[str, Table]] = {"elements": self.elements, "shafts": self.shafts}
        texts = {
            f"{place}.{key}.{name}": text
            for place, of_place in tables.items()
            for key, table in of_place.items()
            for name, text in table.model_dump(exclude_none=True).items()
        }
        return {
            name: value_and_uncertainty(name, text, calibrated(name), calibrated(name).usual)
            for name, text in texts.items()
        }


def _check_measured(table: Measured | AxleMeasured) -> None:
    """Refuse a table [measured] without a value and without a file."""
    record = isinstance(table, Measured) and table.shaft_record is not None
    if not table.values() and table.file is None and not record:
        raise InputError("file", "missing", takes="a file, or a measured value with its uncertainty")


@dataclass(frozen=True)
class MeasuredValue:
    """Measured value of a quantity at an operating point, SI units."""

    quantity: str  # name that ``calibrated`` takes
    value: float
    uncertainty: float  # one standard deviation
    point: int  # place of the operating point
    line: int | None = None  # line of the file; None of a value in [measured]


@dataclass(frozen=True)
class MeasuredPoints:
    """Operating points, and what was measured at them."""

    points: tuple[dict[str, float], ...]  # inputs that differ from the case, by their keys in a bearing file
    values: tuple[MeasuredValue, ...]
    read: Measurement | None = None  # rows of the file
    warnings: tuple[ResultWarning, ...] = ()  # about the record of the shaft voltage

    def with_record(
        self, estimates: Mapping[str, tuple[float, float]], warnings: Iterable[ResultWarning]
    ) -> MeasuredPoints:
        """Points with further values and their standard uncertainties at the operating point of the case.

        A value that the table [measured] already has replaces the value of the record.
        """
        first = [number for number, point in enumerate(self.points) if not point][:1]
        points = self.points if first else (*self.points, {})
        place = first[0] if first else len(self.points)
        known = {value.quantity for value in self.values if value.line is None}
        further = [MeasuredValue(name, *pair, place) for name, pair in estimates.items() if name not in known]
        return replace(
            self, points=points, values=(*self.values, *further), warnings=(*self.warnings, *warnings)
        )


def measured_points(
    measured: Measured | AxleMeasured | None,
    book: ColumnBook,
    file: str | Path | pd.DataFrame | None = None,
    *,
    background: float = 0.0,
    uncertainty: float | None = None,
) -> MeasuredPoints:
    """Measured values of a table [measured], and of a file or a table of pandas with the columns in ``book``.

    ``file`` replaces the file that the table [measured] names; the other values of the table stay.
    ``background``, capacitance [F] that is taken off each measured capacitance; ``uncertainty``, relative
    standard uncertainty of columns of the file without one. Raises InputError if the file cannot be read, has
    a value without an uncertainty, or a capacitance that is not above the background.
    """
    points: list[dict[str, float]] = []
    values: list[MeasuredValue] = []
    source: Any = file
    if measured is not None:
        points += [{}] if measured.values() else []
        values += [MeasuredValue(name, *pair, 0) for name, pair in measured.values().items()]
        source = measured.file if file is None else file
    read = None
    if source is not None:
        read = read_measurement(source, book)
        known = [name for name in book.columns if name in book.gaps and name in read.values]
        if not known:
            heads = f"headings such as {book.examples}"
            raise InputError(read.source, "has no column with a measured quantity", takes=heads)
        if uncertainty is not None:
            usual = {name: uncertainty * np.abs(read.values[name]) for name in known}
            read = replace(read, uncertainties={**usual, **read.uncertainties})
        for name in known:
            if name not in read.uncertainties:
                text = f"a column 'uncertainty of {name.replace('_', ' ')} [%]'"
                raise InputError.missing(f"{read.source}: uncertainty of {name.replace('_', ' ')}", text)
        keys = {name: key for name in read.values if (key := book.columns[name].key)}
        for row, line in enumerate(read.lines):
            points.append({key: float(read.values[name][row]) for name, key in keys.items()})
            values += _row(read, row, line, known, len(points) - 1)
    return MeasuredPoints(tuple(points), tuple(_without(background, value) for value in values), read)


def _without(background: float, value: MeasuredValue) -> MeasuredValue:
    """Measured value, a capacitance without its background [F]."""
    if not background or calibrated(value.quantity).unit != "F":
        return value
    if value.value <= background:
        line = "" if value.line is None else f" in line {value.line}"
        got = f"{readable(1e12 * value.value, 4)} pF{line}"
        takes = f"a capacitance above the background of {readable(1e12 * background, 4)} pF"
        raise InputError(f"measured.{value.quantity}", got=got, takes=takes)
    return replace(value, value=value.value - background)


def _row(read: Measurement, row: int, line: int, known: list[str], point: int) -> Iterator[MeasuredValue]:
    """Values of a row that are not empty."""
    for name in known:
        value, uncertainty = (float(column[name][row]) for column in (read.values, read.uncertainties))
        if np.isnan(value):
            continue
        if not uncertainty > 0.0:
            text = f"line {line}: got no uncertainty of {name.replace('_', ' ')}"
            raise InputError(read.source, text, takes="a standard uncertainty above 0 with each value")
        yield MeasuredValue(name, value, uncertainty, point, line)
