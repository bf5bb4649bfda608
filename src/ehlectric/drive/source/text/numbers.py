"""Numbers of two columns of a text, block by block."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.source.text.dialect import Dialect
from ehlectric.drive.source.text.lines import decoded
from ehlectric.errors import InputError, shown

# Field of the first row that no file has behind its last column.
_BEHIND = "behind-the-last-column"


@dataclass(frozen=True)
class Columns:
    """Columns that are read, and the shape of the rows.

    Attributes
    ----------
    source : str
        Name of the file in errors.
    dialect : Dialect
        Separator and decimal mark.
    places : tuple of int
        Places of the columns, from 0.
    width : int
        Number of columns of a row.
    """

    source: str
    dialect: Dialect
    places: tuple[int, ...]
    width: int


@dataclass(frozen=True, eq=False)
class Block:
    """Numbers of some lines.

    Attributes
    ----------
    values : tuple of ndarray, shape (n,)
        Numbers of each column, all finite.
    text : bytes
        The lines.
    first : int
        Line of the file in which the text begins, from 1.
    columns : Columns
        Columns and shape of the rows.
    """

    values: tuple[Array, ...]
    text: bytes
    first: int
    columns: Columns

    def line(self, row: int) -> int:
        """Line of the file, from 1, of a row of the block."""
        return next(number for k, (number, _) in enumerate(self._rows()) if k == row)

    def fields(self, most: int, *, last: bool) -> list[list[str]]:
        """Fields of the first or last rows of the block."""
        size = 200 * most
        text = self.text[-size:].partition(b"\n")[2] if last and len(self.text) > size else self.text
        text = text if last else text[:size]
        lines = [line for line in text.split(b"\n") if line.strip()]
        # The first lines are cut off somewhere.
        lines = lines[-most:] if last else lines[:most] if len(lines) == 1 else lines[:-1][:most]
        return [self.columns.dialect.fields(decoded(line)) for line in lines]

    def _rows(self) -> Iterator[tuple[int, list[str]]]:
        yield from rows_of(self.text, self.first, self.columns.dialect)


def rows_of(text: bytes, first: int, dialect: Dialect) -> Iterator[tuple[int, list[str]]]:
    """Lines that are not empty, by their numbers in the file, as fields."""
    for number, line in enumerate(text.split(b"\n"), first):
        row = dialect.fields(decoded(line)) if line.strip() else []
        if any(row):
            yield number, row


def block_of(text: bytes, first: int, columns: Columns) -> Block:
    """Numbers of a block of lines.

    Parameters
    ----------
    text : bytes
        Whole lines.
    first : int
        Number of the first line in the file, from 1.
    columns : Columns
        Columns that are read.

    Returns
    -------
    Block
        Numbers of the columns; empty lines are left out.

    Raises
    ------
    InputError
        If a field is missing or is no finite number, or if a line has too many fields; the line is named.
    """
    values = _at_once(text, columns)
    if values is None:
        values = _line_by_line(text, first, columns)
    return Block(values, text, first, columns)


def _at_once(text: bytes, columns: Columns) -> tuple[Array, ...] | None:
    """Numbers as the fast parser reads them; None where it meets a line that is not of numbers only."""
    if b'"' in text:
        # A quote that is not closed would make one field of many lines.
        return None
    import pandas as pd  # takes a while

    kinds: dict[int, Any] = dict.fromkeys(columns.places, np.float64)
    # A field behind the last column would be left out without a word, so that there is a column for it: its
    # category is empty. A row of zeros before the others makes the parser know of this column.
    kinds[columns.width] = "category"
    separator = columns.dialect.separator
    longer = (separator or " ").join([*["0"] * columns.width, _BEHIND]).encode()
    try:
        table = pd.read_csv(
            io.BytesIO(longer + b"\n" + text),
            sep=r"\s+" if separator is None else separator,
            decimal=columns.dialect.decimal,
            header=None,
            names=range(columns.width + 1),
            usecols=list(kinds),
            index_col=False,
            dtype=kinds,
            na_filter=False,
            skipinitialspace=True,
            encoding="latin-1",
        )
    except ValueError:  # of pandas, too
        return None
    values = tuple(table[place].to_numpy()[1:] for place in columns.places)
    if not {"", _BEHIND}.issuperset(table[columns.width].cat.categories) or not all(
        np.isfinite(each).all() for each in values
    ):
        return None
    return values


def _line_by_line(text: bytes, first: int, columns: Columns) -> tuple[Array, ...]:
    """Numbers of lines that the fast parser does not take, or the error of one of them."""
    rows = [_numbers(row, number, columns) for number, row in rows_of(text, first, columns.dialect)]
    values = np.array(rows, dtype=np.float64).reshape(-1, len(columns.places))
    return tuple(np.ascontiguousarray(values[:, k]) for k in range(len(columns.places)))


def _numbers(row: Sequence[str], number: int, columns: Columns) -> list[float]:
    """Numbers of a row; the error of a row names its line."""
    count = max(k for k, field in enumerate(row, 1) if field)
    if count > columns.width:
        raise InputError(
            columns.source, f"line {number} has {count} columns", takes=f"{columns.width} as in other lines"
        )
    values = []
    for place in columns.places:
        if place >= count:
            raise InputError(
                columns.source,
                f"line {number} has no column {place + 1}",
                takes="a number in each line; is the file cut off?",
            )
        value = columns.dialect.number(row[place])
        if value is None:
            mark = "point" if columns.dialect.decimal == "." else "comma"
            raise InputError(
                columns.source,
                f"line {number}, column {place + 1}: got {shown(row[place])}",
                takes=f"a finite number with a decimal {mark}, or none",
            )
        values.append(value)
    return values
