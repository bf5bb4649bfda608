"""Separator of columns and decimal mark of a text of numbers, and the line where its numbers begin."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass

from ehlectric.errors import InputError, shown

# Letters of a number with a decimal point, and its largest length [characters].
_OF_NUMBERS, _LONGEST = frozenset("0123456789+-.eE"), 100

# Lines that are tried with every dialect: enough for one in which the first values are all zero.
_TRIED = 400

# Signs that programs put before a line of comment.
_COMMENT = "#%/ \t"


@dataclass(frozen=True)
class Dialect:
    """Separator and decimal mark of a text.

    Attributes
    ----------
    separator : str or None
        Separator of the columns; None for white space.
    decimal : str
        Decimal mark, "." or ",".
    """

    separator: str | None
    decimal: str

    def fields(self, line: str) -> list[str]:
        """Fields of a line, without white space and quotes around them."""
        if self.separator is None:
            return [field.strip('"') for field in line.split()]
        if '"' in line:
            try:
                found = next(csv.reader([line], delimiter=self.separator, skipinitialspace=True), [])
            except csv.Error:
                found = line.split(self.separator)
        else:
            found = line.split(self.separator)
        return [field.strip().strip('"').strip() for field in found]

    def number(self, field: str) -> float | None:
        """Number in a field; None for other texts, and for numbers that are not finite.

        Examples
        --------
        >>> Dialect(";", ",").number("-1,5e-3"), Dialect(";", ",").number("1.5")
        (-0.0015, None)
        """
        if self.decimal == ",":
            if "." in field or field.endswith(","):
                return None
            field = field.replace(",", ".")
        if not field or len(field) > _LONGEST or not _OF_NUMBERS.issuperset(field):
            return None
        try:
            value = float(field)
        except ValueError:
            return None
        return value if math.isfinite(value) else None


# Dialects in the order of preference: a comma separates columns only where neither semicolon nor tab does.
_DIALECTS = (
    *(Dialect(separator, decimal) for separator in (";", "\t") for decimal in ".,"),
    *(Dialect(separator, decimal) for separator in (",", None) for decimal in ".,"),
)


@dataclass(frozen=True)
class Layout:
    """Columns of numbers in a text, and the lines above them.

    Attributes
    ----------
    dialect : Dialect
        Separator and decimal mark.
    columns : tuple of int
        Places of the columns of numbers, from 0.
    width : int
        Number of columns of a row, with those that have no numbers.
    first : int
        Line in which the numbers begin, from 1.
    header : tuple of str
        Lines above the numbers.
    rows : tuple of str
        First lines of numbers.
    """

    dialect: Dialect
    columns: tuple[int, ...]
    width: int
    first: int
    header: tuple[str, ...]
    rows: tuple[str, ...]


def layout_of(path: object, lines: Sequence[str]) -> Layout:
    """Find the dialect and the columns of numbers in the first lines of a file.

    Parameters
    ----------
    path : object
        Name of the file in errors.
    lines : sequence of str
        First lines of the file, without the last one if it is cut off.

    Returns
    -------
    Layout
        Dialect, columns, and the line in which the numbers begin.

    Raises
    ------
    InputError
        If most lines are not of numbers, if they can be read in two ways, or if text follows the first line
        of numbers.
    """
    filled = [line for line in lines if line.strip()]
    if not filled:
        raise InputError(path, "is empty", takes="lines of time and voltage")
    sample = filled[-max(1, min(_TRIED, (len(filled) + 1) // 2)) :]
    dialect, rows = _dialect(path, lines, sample)
    places = {place for row in rows for place, field in enumerate(row) if field}
    often = [place for place in sorted(places) if 2 * sum(_has(row, place) for row in rows) > len(rows)]
    columns = tuple(often)
    width = max(columns) + 1
    first = _first_row(path, lines, dialect, columns)
    return Layout(dialect, columns, width, first + 1, tuple(lines[:first]), tuple(lines[first:]))


def _has(row: Sequence[str], place: int) -> bool:
    return place < len(row) and bool(row[place])


def _dialect(path: object, lines: Sequence[str], sample: Sequence[str]) -> tuple[Dialect, list[list[str]]]:
    """Dialect that makes most of the sampled lines rows of numbers, and these rows."""
    found: list[tuple[int, int, Dialect, list[list[str]]]] = []
    for dialect in _DIALECTS:
        rows = [row for row in map(dialect.fields, sample) if _is_row(dialect, row)]
        if 2 * len(rows) > len(sample):
            found.append((len(rows), max(sum(map(bool, row)) for row in rows), dialect, rows))
    if not found:
        line = next(line for line in reversed(sample))
        raise InputError(
            path,
            f"has no columns of numbers, as in its line {shown(line.strip())}",
            takes="numbers separated by ';', ',', tabs or spaces",
        )
    most = max((score, width) for score, width, _, _ in found)
    best = next(one for one in found if one[:2] == most)
    if best[2] == Dialect(",", "."):
        # A pair such as "0,5" is one number with a decimal comma, too: the heads decide.
        pairs = (one for one in found if one[2].decimal == "," and one[2].separator != ",")
        single = next((one for one in pairs if one[0] == best[0]), None)
        if single is not None:
            heads = [line for line in lines if line.strip() and not _is_row(best[2], best[2].fields(line))]
            if not heads:
                raise InputError(
                    path,
                    f"has lines such as {shown(sample[-1].strip())}, one number with a decimal comma or two;",
                    takes="a semicolon or a tab between columns, or heads above them",
                )
            best = best if len(best[2].fields(heads[-1])) >= best[1] else single
    return best[2], best[3]


def _is_row(dialect: Dialect, row: Sequence[str]) -> bool:
    """Whether all fields of a row that are not empty are numbers."""
    filled = [field for field in row if field]
    return bool(filled) and all(dialect.number(field) is not None for field in filled)


def _first_row(path: object, lines: Sequence[str], dialect: Dialect, columns: Sequence[int]) -> int:
    """Place of the first line of numbers that another one follows."""
    filled = [place for place, line in enumerate(lines) if line.strip()]
    starts = [_begins(dialect, dialect.fields(lines[place]), columns) for place in filled]
    for k, place in enumerate(filled):
        if starts[k] and all(starts[k + 1 : k + 2]):
            if k and starts[0]:
                wrong = filled[starts.index(False)]
                text = shown(lines[wrong].strip())
                raise InputError(path, f"line {wrong + 1} is {text}", takes="numbers below the first numbers")
            return place
    raise InputError(path, "has no lines of numbers below each other", takes="a line for each sample")


def _begins(dialect: Dialect, row: Sequence[str], columns: Sequence[int]) -> bool:
    """Whether the columns of numbers of a row have numbers only, and not all of them are empty."""
    return _is_row(dialect, [row[place] for place in columns if place < len(row)])


def bare(line: str) -> str:
    """Line without the signs of a comment before it."""
    return line.lstrip(_COMMENT)
