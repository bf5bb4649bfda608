"""Tables of a report from the rows and tables that the commands print, with bounds marked as such."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from ehlectric.cases.row import Row
from ehlectric.errors import CODES, ResultWarning, printable
from ehlectric.report.content import Table, Text, WarningLine, Warnings

if TYPE_CHECKING:
    from rich.table import Table as RichTable

_HEADS, _SHARES = ("quantity", "value", "unit", "note"), (0.42, 0.17, 0.1, 0.31)

# Order of warnings in a report, the most important first.
_SEVERITIES = ("severe", "warning", "note")

# Sentence below tables with breakdown voltages: films are isothermal, fully flooded or smooth, so that every
# breakdown voltage that is computed is an upper bound.
AT_MOST = (
    "≤ marks an upper bound: real films are thinner than isothermal, fully flooded, smooth ones, and break "
    "down at lower voltages."
)


def row_tables(rows: Iterable[Row], title: str) -> Iterator[Table | Text]:
    """Tables of rows, one for each heading; breakdown voltages and margins are marked as upper bounds.

    Parameters
    ----------
    rows : iterable of Row
        Rows that a command prints.
    title : str
        Caption of the rows before the first heading.
    """
    groups: list[tuple[str, list[Row]]] = [(title, [])]
    for row in rows:
        if row.heading:
            groups.append((printable(row.name), []))
        else:
            groups[-1][1].append(row)
    marked = False
    for caption, group in groups:
        if not group:
            continue
        cells = tuple(tuple(_cells(row)) for row in group)
        marked = marked or any(is_bound(row) for row in group)
        alarms = tuple(number for number, row in enumerate(group) if row.alarm)
        yield Table(caption, _HEADS, cells, numeric=(1,), alarms=alarms, shares=_SHARES)
    if marked:
        yield Text(AT_MOST)


def _cells(row: Row) -> Iterator[str]:
    name = printable(row.name)
    indent = "\u2003" * ((len(name) - len(name.lstrip(" "))) // 2)
    yield indent + name.strip()
    yield printable(f"≤ {row.shown}" if is_bound(row) else row.shown)
    yield printable(row.unit).replace(" ", "\xa0")
    yield printable(row.note.lstrip(",; ").strip())


def is_bound(row: Row) -> bool:
    """Whether a row is a breakdown voltage or a margin of a film, which are upper bounds.

    Examples
    --------
    >>> is_bound(Row("first breakdown voltage", 5.88, "V")), is_bound(Row("shaft voltage", 4.0, "V"))
    (True, False)
    """
    if not isinstance(row.value, float) or "coating" in row.name:
        return False
    named = "breakdown" in row.name or "ring-to-ring" in row.name
    return (row.unit == "V" and named) or row.name.startswith("margin")


def cell_table(table: RichTable, caption: str, first: str) -> Table:
    """Table of a report from one of the terminal; columns that are aligned to the right stay so.

    Parameters
    ----------
    table : rich.table.Table
        Table that a command prints.
    caption : str
        Its caption.
    first : str
        Head of a column that has none.
    """
    from rich.text import Text as RichText

    columns = table.columns
    heads = tuple(_plain(column.header, RichText).replace("\n", " ").strip() or first for column in columns)
    rows = zip(*([_plain(cell, RichText) for cell in column.cells] for column in columns), strict=True)
    numeric = tuple(number for number, column in enumerate(columns) if column.justify == "right")
    return Table(caption, heads, tuple(tuple(row) for row in rows), numeric=numeric)


def _plain(cell: object, text: type) -> str:
    """Cell of a table of the terminal as plain text."""
    return cell.plain if isinstance(cell, text) else str(text.from_markup(str(cell)).plain)  # type: ignore[attr-defined]


def warning_block(warnings: Sequence[ResultWarning]) -> Warnings | Text:
    """Warnings with their meaning, the severe ones first; a sentence where there are none."""
    if not warnings:
        return Text("The result has no warnings.")
    ordered = sorted(warnings, key=lambda warning: _SEVERITIES.index(warning.severity))
    return Warnings(
        tuple(
            WarningLine(one.severity, one.code, CODES[one.code].meaning, printable(one.text))
            for one in ordered
        )
    )


def alarms_of(warnings: Iterable[ResultWarning], failure: str) -> Iterator[Text]:
    """Sentences that stand at the top of a report: why its numbers must not be used.

    Parameters
    ----------
    warnings : iterable of ResultWarning
        Warnings of the result.
    failure : str
        What is not solved; empty where all is.
    """
    if failure:
        yield Text(failure, "alarm")
    severe = dict.fromkeys(one.code for one in warnings if one.severity == "severe")
    for code in severe:
        yield Text(f"Do not use the numbers: {CODES[code].meaning}", "alarm")
