"""Workbooks of spreadsheets: numbers of a result in the units that engineers use, and in SI units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle import AxleResult
from ehlectric.bearing import ON_SHAFT, BearingResult, scaled_curves
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.contact import Setup
from ehlectric.drive import DriveResult
from ehlectric.errors import InputError, printable
from ehlectric.gear import GearResult
from ehlectric.quantities.formats import UNITS, USUAL, Scale, scale_for, scale_of
from ehlectric.quantities.inputs import SPEED, end_and_key
from ehlectric.quantities.quantity import key_of
from ehlectric.quantities.results import AXLE_ELEMENT_KEYS, ELEMENT_KEYS, EVENT_KEYS, POINT_KEYS
from ehlectric.quantities.units import printed
from ehlectric.runs.solve import AnyResult
from ehlectric.runtime.display import is_number
from ehlectric.sweep import SweepResults, flat, flat_summary, label_of, result_keys

if TYPE_CHECKING:
    import pandas as pd


# Rows and columns of a sheet, and characters of a cell, at most.
_ROWS, _COLUMNS, _TEXT = 1_048_576, 16_384, 32_767

# Widths of the columns of keys, names and values [characters].
_WIDTHS = (44, 60, 18, 12, 24, 12)

# Units of all stresses and of all viscosities, so that cells can be compared.
_SINGLE_UNIT = {"Pa": "MPa", "Pa*s": "mPa s"}


def workbook(result: AnyResult | SweepResults) -> bytes:
    """Content of a workbook (.xlsx) with the sheets "summary", "inputs" and "table". A bearing adds the sheet
    "over speed", and a duty cycle the sheet "duty cycle".

    Each number has the unit that engineers use, such as rpm, °C and MPa; the sheets of keys also contain it
    in SI units. Raises InputError if the package openpyxl is missing, or there are more rows or columns
    than a sheet.
    """
    try:
        import openpyxl
    except ImportError:
        takes = "it, installed with: pip install 'ehlectric[excel]'"
        raise InputError("openpyxl", "is missing, but workbooks need it", takes=takes) from None
    case = result.case
    if isinstance(case, Setup):
        raise InputError("result", "has no case, but the workbook must contain it")
    frame = result.to_dataframe()
    if len(frame) >= _ROWS or len(frame.columns) > _COLUMNS:
        raise InputError(
            "table",
            got=f"{len(frame)} rows and {len(frame.columns)} columns",
            takes=f"less than {_ROWS} rows and at most {_COLUMNS} columns; its CSV file has all of it",
        )
    book = openpyxl.Workbook(write_only=True)
    tables = result.summary()
    summary = flat_summary(tables)
    inputs = {key: value for key, value in summary.items() if key.startswith("inputs.")}
    if not inputs:
        inputs = flat({"inputs": case.plain_tables()})
    _fill(book, "summary", _keys({key: value for key, value in summary.items() if key not in inputs}, case))
    _fill(book, "inputs", _keys(inputs, case))
    _fill(book, "table", _table(frame, result, case))
    if isinstance(result, BearingResult):
        _fill_over_speed(book, result.case, tables)
    if isinstance(result, BearingResult | DriveResult | GearResult | AxleResult) and result.duty is not None:
        _fill(book, "duty cycle", _duty(result))
    file = BytesIO()
    book.save(file)
    return file.getvalue()


def _keys(values: dict[str, Any], case: SolvedCase) -> Iterator[Iterable[Any]]:
    """Rows of keys: dotted key, name, value in its usual unit, and value in its SI unit."""
    yield "key", "name", "value", "unit", "SI value", "SI unit"
    for key, value in values.items():
        label, short_key = label_of(key, case), key.removeprefix("inputs.")
        if not is_number(value):
            yield short_key, label.name, value, "", value, ""
            continue
        known = key_of(result_keys(case), key)
        if known is not None and known.unit_of:
            input_key = values[f"{key.rpartition('.')[0]}.{known.unit_of}"]
            given = label_of(input_key, case)
            label = replace(label, unit=given.unit, shown=given.shown)
        scale = scale_of_values(label.unit, label.shown, np.array([value]))
        yield short_key, label.name, _rounded(scale.of(value)), scale.unit, value, _unit(label.unit)


def scale_of_values(unit: str, shown: str, values: Array) -> Scale:
    """Unit in which values are written.

    Parameters
    ----------
    unit, shown : str
        SI unit, in the notation of pint, and unit in which the values are usually shown; empty if unknown.
    values : ndarray
        Values [SI unit], which decide the prefix of a unit without a usual one.

    Examples
    --------
    >>> speed, modulus = np.array([314.159]), np.array([226e9])
    >>> scale_of_values("rad/s", "rpm", speed).unit
    'rpm'
    >>> scale_of_values("Pa", "GPa", modulus).of(226e9)
    226000.0
    >>> scale_of_values("K", "°C", speed).unit, scale_of_values("K", "", speed).unit
    ('°C', 'K')
    """
    named = _SINGLE_UNIT.get(unit) or printed(shown) or USUAL.get(unit, "")
    if named in UNITS and UNITS[named][0] == unit:
        return scale_of(named)
    finite = np.abs(values[np.isfinite(values)])
    return scale_for(float(np.max(finite, initial=0.0)) or 1.0, unit)


def _rounded(value: float) -> float:
    """Value without the rounding error of its conversion."""
    return float(f"{value:.14g}")


def _unit(unit: str) -> str:
    """Unit without the notation of programs.

    Examples
    --------
    >>> _unit("A/m**2"), _unit("Pa*s")
    ('A/m^2', 'Pa s')
    """
    return unit.replace("**", "^").replace("*", " ")


def _table(
    frame: pd.DataFrame, result: AnyResult | SweepResults, case: SolvedCase
) -> Iterator[Iterable[Any]]:
    """Rows of the table of a result, below heads with units."""
    units = frame.attrs.get("units", {})
    columns = {}
    for name in map(str, frame.columns):
        match result:
            case BearingResult():
                shown = ELEMENT_KEYS[name].shown if name in ELEMENT_KEYS else ""
            case DriveResult():
                shown = EVENT_KEYS[name].shown if name in EVENT_KEYS else ""
            case AxleResult():
                shown = AXLE_ELEMENT_KEYS[name].shown if name in AXLE_ELEMENT_KEYS else ""
            case GearResult():
                shown = POINT_KEYS[name].shown if name in POINT_KEYS else ""
            case _:
                shown = label_of(name, case).shown if name in units else ""
        columns[name] = (units.get(name), shown, frame[name].to_numpy())
    return _columns(columns)


def _duty(result: BearingResult | DriveResult | GearResult | AxleResult) -> Iterator[Iterable[Any]]:
    """Rows of the duty cycle, below heads with units."""
    assert result.duty is not None
    columns = {}
    for name, (unit, values) in result.duty.columns().items():
        match result:
            case GearResult():
                key = "gear.bulk_temperature"
            case AxleResult():
                key = "inputs.drive.temperature"
            case BearingResult():
                key = f"bearing.{name}"
            case _:
                key = name if end_and_key(name)[0] else f"drive.{name}"
        columns[name] = (unit, label_of(key, result.case).shown if unit == "K" else "", values)
    return _columns(columns)


def _fill_over_speed(book: Any, case: BearingCase, summary: Mapping[str, Any]) -> None:
    """Sheet of the curves of a bearing over its speed; none if the curves cannot be computed."""
    curves = scaled_curves(case, summary)
    if curves is None:
        return
    values = {SPEED: curves.speed}
    names = {} if case.bearing.coating is None else ON_SHAFT
    values |= {f"bearing.{names.get(key, key)}": value for key, value in curves.values.items()}
    values["bearing.margin"] = curves["first_break"] / curves["shaft_voltage"]
    labels = {key: label_of(key, case) for key in values}
    columns = {key: (labels[key].unit, labels[key].shown, values[key]) for key in values}
    _fill(book, "over speed", _columns(columns))


def _columns(columns: Mapping[str, tuple[str | None, str, Any]]) -> Iterator[Iterable[Any]]:
    """Rows of columns below heads with units.

    ``columns``, SI unit (None of a column without numbers), usual unit, and values of each column by its key.
    """
    heads, written = [], []
    for key, (unit, shown, values) in columns.items():
        if unit is None or not np.issubdtype(np.asarray(values).dtype, np.number):
            heads.append(key)
            written.append(list(values))
            continue
        numbers = np.asarray(values, dtype=float)
        scale = scale_of_values(unit, shown, numbers)
        heads.append(f"{key} [{scale.unit or '-'}]")
        whole = np.issubdtype(np.asarray(values).dtype, np.integer) and scale == Scale(1.0, scale.unit)
        written.append(list(values) if whole else [_rounded(value) for value in scale.of(numbers).tolist()])
    yield heads
    yield from zip(*written, strict=True)


def _fill(book: Any, title: str, rows: Iterator[Iterable[Any]]) -> None:
    """Sheet of rows, of which the first one is bold and stays in view."""
    from openpyxl.styles import Font
    from openpyxl.utils import get_column_letter

    sheet = book.create_sheet(title)
    sheet.freeze_panes = "A2"
    heads = list(next(rows))
    of_keys = title in ("summary", "inputs")
    widths = _WIDTHS if of_keys else [max(12, len(str(head)) + 2) for head in heads]
    for k, width in enumerate(widths, 1):
        sheet.column_dimensions[get_column_letter(k)].width = width
    sheet.append([_cell(sheet, head, Font(bold=True)) for head in heads])
    for row in rows:
        sheet.append([_cell(sheet, value) for value in row])


def _cell(sheet: Any, value: Any, font: Any = None) -> Any:
    """Cell of a value: a text is never a formula, and what is no number is empty."""
    from openpyxl.cell import WriteOnlyCell

    if hasattr(value, "item"):
        value = value.item()
    if value is None or (isinstance(value, float) and not abs(value) < float("inf")):
        return None
    if isinstance(value, bool | int | float) and font is None:
        return value
    cell = WriteOnlyCell(sheet, printable(str(value))[:_TEXT])
    cell.data_type = "s"
    if font is not None:
        cell.font = font
    return cell
