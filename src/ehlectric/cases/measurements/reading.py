"""Reading of a measurement: rows of a text file, or a table of pandas, in SI units."""

from __future__ import annotations

import codecs
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.measurements.columns import EXAMPLES, Column, column_of
from ehlectric.errors import InputError, printable, shown
from ehlectric.runtime.reading import read_bytes

if TYPE_CHECKING:
    import pandas as pd

# Largest size of a file [bytes], and largest numbers of rows, of lines above the heads, and of columns.
_MOST_BYTES, MOST_ROWS, _MOST_ABOVE, _MOST_COLUMNS = 8_000_000, 20_000, 500, 200

# Letters of a number, and its largest length [characters].
_OF_NUMBERS, _LONGEST = frozenset("0123456789+-.,eE"), 40

_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


@dataclass(frozen=True, eq=False)
class Measurement:
    """Measured rows beside a case, SI units.

    Attributes
    ----------
    source : str
        Path of the file, or "table" for a table of pandas.
    lines : tuple of int
        Line of each row in the file, from 1; of a table its rows, from 1.
    values : mapping of str to ndarray, shape (n,)
        Quantities of the rows by name, as ``COLUMNS`` has them.
    uncertainties : mapping of str to ndarray, shape (n,)
        Standard uncertainties of the quantities, in the same units; relative ones are multiplied out.
    ignored : tuple of str
        Heads of columns that are not known, and were ignored.
    """

    source: str
    lines: tuple[int, ...]
    values: Mapping[str, Array]
    uncertainties: Mapping[str, Array]
    ignored: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """Number of rows."""
        return len(self.lines)

    def has(self, *names: str) -> bool:
        """Whether the measurement has all of some quantities."""
        return all(name in self.values for name in names)


@dataclass(frozen=True)
class _Rows:
    heads: Sequence[str]
    cells: Sequence[Sequence[str]]
    lines: tuple[int, ...]
    decimal: str


def read_measurement(measured: str | Path | pd.DataFrame) -> Measurement:
    """Read a measurement from a text file or a table of pandas.

    Parameters
    ----------
    measured : str, Path or pandas.DataFrame
        Text file with separators ``,``, ``;`` or tab, decimal points or (not with ``,``) decimal commas, and
        a line of heads such as ``speed [rpm];capacitance [pF]``. Lines that begin with ``#``, and lines above
        the heads, are skipped. A table has such heads as names of its columns.

    Returns
    -------
    Measurement
        All rows in SI units.

    Raises
    ------
    InputError
        If the file cannot be read or is too large, has no heads that are known, a head has no unit or a wrong
        one, or a row has a value that is missing, is no number or is out of bounds; the line is named.

    Examples
    --------
    >>> import pandas as pd
    >>> table = pd.DataFrame({"speed [rpm]": [1000, 3000], "capacitance [pF]": [260.0, 190.0]})
    >>> measurement = read_measurement(table)
    >>> measurement.size, measurement.values["capacitance"]
    (2, array([2.6e-10, 1.9e-10]))
    """
    if hasattr(measured, "columns") and hasattr(measured, "itertuples"):
        source, rows = "table", _of_table(measured)
    else:
        path = Path(measured)
        source, rows = str(path), _of_text(path, decoded(path, read_bytes(path, most=_MOST_BYTES)))
    columns, ignored = _columns(source, rows.heads)
    if not rows.cells:
        raise InputError(source, "has no rows below its heads", takes="at least one")
    if len(rows.cells) > MOST_ROWS:
        raise InputError(source, f"has {len(rows.cells)} rows", takes=f"at most {MOST_ROWS}; average them")
    found = {place: _values(source, rows, place, column) for place, column in columns.items()}
    values = {columns[place].name: found[place] for place in found if not columns[place].uncertainty}
    uncertain = {place: found[place] for place in found if columns[place].uncertainty}
    return Measurement(
        source, rows.lines, values, _uncertainties(source, columns, uncertain, values), ignored
    )


def decoded(path: Path, content: bytes) -> str:
    """Text of a file in UTF-8, UTF-16 or Windows-1252, as instruments write them.

    Raises
    ------
    InputError
        If the file is no text.
    """
    if b"\0" in content[:4096] and content[:2] not in _UTF_16:
        raise InputError(path, "is not a text file")
    for code in ("utf-16",) if content[:2] in _UTF_16 else ("utf-8-sig", "cp1252"):
        try:
            return content.decode(code)
        except UnicodeDecodeError:
            continue
    raise InputError(path, "is not text in UTF-8, UTF-16 or Windows-1252")


def _of_table(table: pd.DataFrame) -> _Rows:
    heads = [str(name) for name in table.columns]
    cells = [[str(cell) for cell in row] for row in table.itertuples(index=False, name=None)]
    return _Rows(heads, cells, tuple(range(1, len(cells) + 1)), ".")


def _of_text(path: Path, text: str) -> _Rows:
    """Heads and rows of a text; the heads may stand in a line of comment above the numbers."""
    lines = text.splitlines()
    at, separator = _head_line(path, lines)
    heads = _fields(lines[at].lstrip("# "), separator)
    below = [(n, line) for n, line in enumerate(lines[at + 1 :], at + 2) if _is_row(line, separator)]
    cells = []
    for number, line in below[: MOST_ROWS + 1]:
        fields = _fields(line, separator)
        if len(fields) != len(heads):
            raise InputError(
                path, f"line {number} has {len(fields)} columns", takes=f"{len(heads)} as in its heads"
            )
        cells.append(fields)
    numbers = tuple(number for number, _ in below[: MOST_ROWS + 1])
    return _Rows(heads, cells, numbers, _decimal(path, cells, separator))


def _is_row(line: str, separator: str | None) -> bool:
    """Whether a line below the heads is a row: neither empty nor a comment."""
    text = line.strip()
    return bool(text.strip(separator or "")) and not text.startswith("#")


def _head_line(path: Path, lines: Sequence[str]) -> tuple[int, str | None]:
    """Place of the heads, the first line with a known quantity, and the separator of the columns."""
    wrong: InputError | None = None
    for place, line in enumerate(lines[:_MOST_ABOVE]):
        text = line.lstrip("# ")
        separator = next((mark for mark in (";", "\t", ",") if mark in text), None)
        fields = _fields(text, separator)
        known = 0
        for field in fields[:_MOST_COLUMNS]:
            try:
                known += column_of(field) is not None
            except InputError as error:
                # A sentence above the heads may be the name of a quantity, too: it has no unit.
                wrong = wrong or error
        if known:
            if len(fields) > _MOST_COLUMNS:
                raise InputError(path, f"has {len(fields)} columns", takes=f"at most {_MOST_COLUMNS}")
            return place, separator
    if wrong is not None:
        raise InputError(path, str(wrong))
    raise InputError(path, "has no heads of known columns", takes=f"heads such as {EXAMPLES}")


def _fields(line: str, separator: str | None) -> list[str]:
    return [field.strip().strip('"').strip() for field in line.strip("\r\n").split(separator or "\0")]


def _decimal(path: Path, cells: Sequence[Sequence[str]], separator: str | None) -> str:
    """Decimal mark of all numbers of a file."""
    if separator == ",":
        return "."
    numbers = [cell for row in cells for cell in row if _OF_NUMBERS.issuperset(cell)]
    comma = next((cell for cell in numbers if "," in cell), None)
    point = next((cell for cell in numbers if "." in cell), None)
    if comma is not None and point is not None:
        raise InputError(
            path, f"mixes decimal points and decimal commas, {shown(point)} and {shown(comma)}", takes="one"
        )
    return "." if comma is None else ","


def _columns(source: str, heads: Sequence[str]) -> tuple[dict[int, Column], tuple[str, ...]]:
    """Known columns by their place, and heads of the others."""
    columns: dict[int, Column] = {}
    ignored = []
    for place, head in enumerate(heads):
        try:
            column = column_of(head)
        except InputError as error:
            raise InputError(source, str(error)) from None
        if column is None:
            ignored.append(printable(head[:60]))
            continue
        same = [other for other in columns.values() if _key(other) == _key(column)]
        if same:
            raise InputError(
                source,
                f"has the columns {shown(same[0].head)} and {shown(column.head)}",
                takes="one of the two",
            )
        columns[place] = column
    if not any(not column.uncertainty for column in columns.values()):
        raise InputError(source, "has no heads of known columns", takes=f"heads such as {EXAMPLES}")
    return columns, tuple(head for head in ignored if head)


def _key(column: Column) -> tuple[str, bool]:
    return column.name, column.uncertainty


def _values(source: str, rows: _Rows, place: int, column: Column) -> Array:
    """Values of a column in SI units, shape (n,)."""
    values = np.empty(len(rows.cells))
    for k, (row, line) in enumerate(zip(rows.cells, rows.lines, strict=True)):
        cell = row[place]
        try:
            number = _number(cell, rows.decimal)
            # A relative uncertainty has no quantity of its own; others are converted with that of the value.
            later = column.uncertainty and column.unit != "%"
            values[k] = number if later else column.value(number)
        except ValueError as error:
            raise InputError(
                source, f"line {line}, {column.head}: got {shown(cell)}", takes=str(error)
            ) from None
    return values


def _number(cell: str, decimal: str) -> float:
    if not cell or len(cell) > _LONGEST or not _OF_NUMBERS.issuperset(cell):
        raise ValueError("a number")
    if decimal == "." and "," in cell:
        raise ValueError("a number with a decimal point")
    try:
        number = float(cell.replace(",", "."))
    except ValueError:
        raise ValueError("a number") from None
    if not np.isfinite(number):
        raise ValueError("a finite number")
    return number


def _uncertainties(
    source: str, columns: Mapping[int, Column], found: Mapping[int, Array], values: Mapping[str, Array]
) -> dict[str, Array]:
    """Standard uncertainties in SI units by quantity; one without a name belongs to the measured quantity."""
    uncertainties: dict[str, Array] = {}
    for place, numbers in found.items():
        column = columns[place]
        name = column.name or next((key for key in ("capacitance", "impedance", "film") if key in values), "")
        if name not in values:
            what = name or "capacitance, impedance or film"
            raise InputError(source, f"has the column {shown(column.head)}", takes=f"a column {what} with it")
        if column.unit == "%":
            uncertainties[name] = numbers * np.abs(values[name])
            continue
        named = Column(name, column.head, column.unit, uncertainty=True)
        uncertainties[name] = _absolute(source, named, numbers)
    return uncertainties


def _absolute(source: str, column: Column, numbers: Array) -> Array:
    """Uncertainties in the SI unit of their quantity, from numbers in the unit of the column."""
    unit = {"degC": "K", "°C": "K", "C": "K"}.get(column.unit, column.unit)
    try:
        factor = Column(column.name, column.head, unit, uncertainty=True).factor()
    except ValueError as error:
        takes = f"per cent or a unit of {column.name.replace('_', ' ')}"
        raise InputError(source, f"column {shown(column.head)}: {error}", takes=takes) from None
    if not np.all(numbers > 0.0):
        raise InputError(source, f"column {shown(column.head)} has a value of 0 or below", takes="above 0")
    return numbers * factor
