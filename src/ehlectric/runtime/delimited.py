"""Delimited text of RFC 4180, as spreadsheets and instruments write it: quoted fields, and void values."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator

# Texts of a field without a value, in small letters, as NumPy, pandas and spreadsheets write them.
_VOIDS = frozenset(("", "nan", "+nan", "-nan", "na", "n/a", "#n/a", "#na", "<na>", "null", "none"))

_QUOTED = re.compile(r'"[^"]*+"')

# Separator of a line with one column, which no text contains.
_NONE = "\x1f"

# Largest number of lines of one record, whose quoted fields may contain line breaks.
_MOST_LINES = 20


def is_void(field: str) -> bool:
    """Whether a field contains no value.

    Examples
    --------
    >>> is_void(" NaN"), is_void(""), is_void("0")
    (True, True, False)
    """
    return field.strip().lower() in _VOIDS


def records(lines: Iterable[str], separator: str | None) -> Iterator[tuple[int, list[str]]]:
    """Fields of each record, without white space around them, and the number of its last line from 1.

    ``separator`` is None for one column. A quoted field may contain the separator, and a doubled quote is a
    quote. Raises ``csv.Error`` if a quoted field is not closed.

    Examples
    --------
    >>> list(records(['1, "accel, 1st"', '"1,500.5","5"" shaft"'], ","))
    [(1, ['1', 'accel, 1st']), (2, ['1,500.5', '5" shaft'])]
    """
    ended = (line if line.endswith("\n") else f"{line}\n" for line in lines)
    reader = csv.reader(ended, delimiter=separator or _NONE, skipinitialspace=True, strict=True)
    for fields in reader:
        yield reader.line_num, [field.strip() for field in fields]


def fields(line: str, separator: str | None) -> list[str]:
    """Fields of one line, without white space around them. A quote that is not closed is ignored.

    Examples
    --------
    >>> fields('"x, filtered [um]",z [nm]', ",")
    ['x, filtered [um]', 'z [nm]']
    """
    if '"' in line:
        try:
            return next((found for _, found in records([line], separator)), [])
        except csv.Error:
            pass
    return [field.strip().strip('"').strip() for field in line.strip("\r\n").split(separator or _NONE)]


def separator_of(line: str) -> str | None:
    """Separator of the columns in a line of heads, outside of its quotes; None for one column.

    Examples
    --------
    >>> separator_of('"speed, mean [rpm]";film [nm]'), separator_of('"speed, mean [rpm]"')
    (';', None)
    """
    bare = _QUOTED.sub("", line)
    return next((mark for mark in (";", "\t", ",") if mark in bare), None)


def record_at(lines: list[str], place: int) -> tuple[str, int]:
    r"""Text of the record that begins in a line, and the place of the line after it.

    Examples
    --------
    >>> record_at(['"speed', '[rpm]",film [nm]', "1,2"], 0)
    ('"speed\n[rpm]",film [nm]', 2)
    """
    quotes = 0
    for end in range(place, min(place + _MOST_LINES, len(lines))):
        quotes += lines[end].count('"')
        if quotes % 2 == 0:
            return "\n".join(lines[place : end + 1]), end + 1
    return lines[place], place + 1
