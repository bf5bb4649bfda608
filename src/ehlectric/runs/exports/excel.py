"""Results as workbooks of spreadsheets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from io import BytesIO
from typing import TYPE_CHECKING, Any

from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError, printable
from ehlectric.runtime.tables import column_head
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.points import flat

if TYPE_CHECKING:
    import pandas as pd

    from ehlectric.cases.drives.swept import SweptCase
    from ehlectric.runs.exports.exported import Exported

# Rows and columns of a sheet, and characters of a cell, at most.
_ROWS, _COLUMNS, _TEXT = 1_048_576, 16_384, 32_767

# Widths of the columns of keys, meanings and values [characters].
_WIDTHS = (44, 60, 24, 12)


def workbook(result: Exported) -> bytes:
    """Content of a workbook (.xlsx): sheets "summary", "inputs" and "table", in SI units.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, MotionResult or SweepResults
        Result. Its table is that of ``to_dataframe``: the film node by node, the contacts of a bearing, the
        discharges of a drive, time steps, or the points of a sweep.

    Raises
    ------
    InputError
        If the package openpyxl is missing, or the table has more rows or columns than a sheet.
    """
    try:
        import openpyxl
    except ImportError:
        takes = "it, installed with: pip install 'ehlectric[excel]'"
        raise InputError("openpyxl", "is missing, which writes workbooks", takes=takes) from None
    case = result.case
    if isinstance(case, Setup):
        raise InputError("result", "has no case, which the workbook must hold")
    frame = result.to_dataframe()
    if len(frame) >= _ROWS or len(frame.columns) > _COLUMNS:
        raise InputError(
            "table",
            got=f"{len(frame)} rows and {len(frame.columns)} columns",
            takes=f"less than {_ROWS} rows and at most {_COLUMNS} columns; its CSV file has all of it",
        )
    book = openpyxl.Workbook(write_only=True)
    summary = flat(result.summary())
    inputs = {key: value for key, value in summary.items() if key.startswith("inputs.")}
    if not inputs:
        inputs = flat({"inputs": case.to_dict()})
    _fill(book, "summary", _keys({key: value for key, value in summary.items() if key not in inputs}, case))
    _fill(book, "inputs", _keys(inputs, case))
    _fill(book, "table", _table(frame))
    file = BytesIO()
    book.save(file)
    return file.getvalue()


def _keys(values: dict[str, Any], case: SweptCase) -> Iterator[Iterable[Any]]:
    """Rows of keys: dotted key, name, value and unit."""
    yield "key", "name", "value", "SI unit"
    for key, value in values.items():
        label, own = label_of(key, case), key.removeprefix("inputs.")
        number = isinstance(value, int | float) and not isinstance(value, bool)
        yield own, "" if label.name in (key, own) else label.name, value, _unit(label.unit) if number else ""


def _unit(unit: str) -> str:
    """Unit without the notation of programs.

    Examples
    --------
    >>> _unit("A/m**2"), _unit("Pa*s")
    ('A/m^2', 'Pa s')
    """
    return unit.replace("**", "^").replace("*", " ")


def _table(frame: pd.DataFrame) -> Iterator[Iterable[Any]]:
    """Rows of a table, below heads with units."""
    units = frame.attrs.get("units", {})
    yield [column_head(str(name), units[name]) if name in units else str(name) for name in frame.columns]
    yield from frame.itertuples(index=False, name=None)


def _fill(book: Any, title: str, rows: Iterator[Iterable[Any]]) -> None:
    """Sheet of rows, of which the first one is bold and stays in view."""
    from openpyxl.styles import Font
    from openpyxl.utils import get_column_letter

    sheet = book.create_sheet(title)
    sheet.freeze_panes = "A2"
    heads = list(next(rows))
    widths = _WIDTHS if title != "table" else [max(12, len(str(head)) + 2) for head in heads]
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
