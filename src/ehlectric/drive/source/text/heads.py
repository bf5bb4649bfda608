"""Heads of the columns of an oscilloscope's file, their units, and what the lines above them state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ehlectric.drive.source.text.dialect import Layout, bare
from ehlectric.drive.source.text.spelling import (
    NUMBERING,
    NUMBERINGS,
    TIME_NAMES,
    TIMES,
    VOLTAGES,
    parts,
    spelled,
)
from ehlectric.drive.source.text.stated import is_key, key_of, stated_by, take
from ehlectric.errors import printable, short

# Longest name of a column in a text [characters].
_LONGEST = 40


@dataclass(frozen=True)
class Head:
    """Head of a column.

    Attributes
    ----------
    place : int
        Place of the column, from 0.
    name : str
        Name; empty if the file has none.
    unit : str
        Unit in the spelling of pint, or as it is written if it is not known; empty if the file has none.
    """

    place: int
    name: str = ""
    unit: str = ""

    @property
    def is_numbering(self) -> bool:
        """Whether the column numbers the samples."""
        return self.unit == NUMBERING or (not self.unit and self.name.lower() in NUMBERINGS)

    @property
    def is_time(self) -> bool:
        """Whether the column is a time by its unit, or by its name if it has no unit."""
        if self.unit:
            return self.unit in TIMES
        return not self.is_numbering and self.name.lower() in TIME_NAMES

    def __str__(self) -> str:
        column = f"column {self.place + 1}"
        return f"{short(printable(self.name), _LONGEST)} ({column})" if self.name else column


@dataclass(frozen=True)
class Heads:
    """Heads of all columns of numbers, and what the lines above them state.

    Attributes
    ----------
    columns : tuple of Head
        Heads in the order of the columns.
    named : bool
        Whether the file has names or units of its columns.
    step, start : float or None
        Sampling interval and time of the first sample that the file states [s].
    points : int or None
        Number of samples that the file states.
    """

    columns: tuple[Head, ...]
    named: bool
    step: float | None = None
    start: float | None = None
    points: int | None = None


def heads_of(layout: Layout) -> Heads:
    """Heads of the columns of numbers, and what the lines above them state.

    Parameters
    ----------
    layout : Layout
        Dialect and columns of the file, with the lines above the numbers.

    Returns
    -------
    Heads
        Names and units, empty where the file has none, and stated intervals and lengths.
    """
    stated = stated_by(layout)
    names, below = _rows(layout)
    for place, name in enumerate(names):
        number = layout.dialect.number(below[place]) if place < len(below) else None
        if place not in layout.columns and number is not None:
            take(stated, key_of(name), [below[place]])
    columns = []
    for place in layout.columns:
        name, unit = parts(names[place] if place < len(names) else "")
        other = spelled(below[place]) if place < len(below) else ""
        columns.append(Head(place, name, other or unit))
    named = any(head.name or head.unit for head in columns)
    columns = _with_stated(columns, stated.units)
    return Heads(tuple(columns), named, stated.step, stated.start, stated.points)


def _with_stated(columns: Sequence[Head], stated: Mapping[str, Sequence[str]]) -> list[Head]:
    """Heads with the units that lines such as "Vertical Units,V" state."""
    unnamed = not any(head.name or head.unit for head in columns)
    result, channels = [], 0
    for k, head in enumerate(columns):
        time = head.is_time or (unnamed and k == 0 and len(columns) > 1)
        found = stated.get("x" if time else "y", ())
        at = 0 if time else channels
        channels += not time
        if head.unit or not found or head.is_numbering:
            result.append(head)
        else:
            result.append(Head(head.place, head.name, spelled(found[min(at, len(found) - 1)])))
    return result


def _rows(layout: Layout) -> tuple[list[str], list[str]]:
    """Row of names and row of units above the numbers; empty where the file has none."""
    lines = [bare(line) for line in layout.header]
    rows = [_head_fields(layout, line) for line in lines]
    rows = [row for row in rows if any(row)]
    if not rows or not _covers(layout, rows[-1]):
        return [], []
    if not _are_units(layout, rows[-1]):
        return (rows[-1], []) if _are_names(layout, rows[-1]) else ([], [])
    if len(rows) > 1 and _covers(layout, rows[-2]) and _are_names(layout, rows[-2]):
        return rows[-2], rows[-1]
    return [], rows[-1]


def _head_fields(layout: Layout, line: str) -> list[str]:
    """Fields of a line of heads: between columns of white space, names have spaces and units brackets."""
    row = layout.dialect.fields(line)
    if layout.dialect.separator is not None or len(row) == layout.width:
        return row
    wide = [text.strip() for text in line.replace("\t", "  ").split("  ") if text.strip()]
    if len(wide) == layout.width:
        return wide
    joined: list[str] = []
    for text in row:
        if joined and text.startswith(("(", "[")):
            joined[-1] += f" {text}"
        else:
            joined.append(text)
    return joined


def _covers(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has a field for every column of numbers; the first one may be empty."""
    return len(row) > max(layout.columns) and all(row[place] for place in layout.columns[1:])


def _are_units(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has units in the columns of numbers, in brackets or as words."""
    found = [row[place] for place in layout.columns if row[place]]
    known = [spelled(text) in (*TIMES, *VOLTAGES, "A", NUMBERING) for text in found]
    enclosed = [text[:1] + text[-1:] in ("()", "[]") for text in found]
    # "Second,Value" has one unit and no names; "Time,Value" has names.
    values = [text.lower() == "value" for text in found]
    return any(known) and all(a or b or c for a, b, c in zip(known, enclosed, values, strict=True))


def _are_names(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has names in the columns of numbers: texts, or whole numbers of channels."""
    if is_key(row[0]):
        return False
    texts = [row[place] for place in layout.columns]
    numbers = [text for text in texts if layout.dialect.number(text) is not None]
    channels = all(text.isdigit() and len(text) <= 2 for text in numbers)
    return len(numbers) < len(texts) and channels
