"""Tables of a report from the rows and tables that the commands print, with bounds marked as such."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

from ehlectric.errors import CODES, ResultWarning, Severity, printable
from ehlectric.quantities.rows import Row
from ehlectric.report.content import Table, Text, WarningLine, Warnings

if TYPE_CHECKING:
    from rich.table import Table as RichTable

_HEADS, _SHARES = ("quantity", "value", "unit", "note"), (0.42, 0.17, 0.1, 0.31)

# Order of warnings in a report, the most important first.
_SEVERITIES = ("severe", "warning", "note")

# Sentences below tables with bounds, by their signs.
BOUNDS: Mapping[str, str] = MappingProxyType(
    {
        "≤": "≤ marks an upper bound, before a range one of both ends. Real films are thinner than "
        "isothermal, fully flooded, smooth ones, and break down at lower voltages.",
        "≥": "≥ marks a lower bound: the field is higher in thinner films.",
    }
)


def row_tables(rows: Iterable[Row], title: str) -> Iterator[Table | Text]:
    """Tables of rows, one for each heading, and a sentence about the bounds in them.

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
    bounds: set[str] = set()
    for caption, group in groups:
        if not group:
            continue
        cells = tuple(tuple(_cells(row)) for row in group)
        bounds |= {row.bound for row in group}
        alarms = tuple(number for number, row in enumerate(group) if row.alarm)
        yield Table(caption, _HEADS, cells, numeric=(1,), alarms=alarms, shares=_SHARES)
    meanings = [text for bound, text in BOUNDS.items() if bound in bounds]
    if meanings:
        yield Text(" ".join(meanings))


def _cells(row: Row) -> Iterator[str]:
    name = printable(row.name)
    indent = "\u2003" * ((len(name) - len(name.lstrip(" "))) // 2)
    yield indent + name.strip()
    yield unbroken(row.bounded)
    yield printable(row.unit).replace(" ", "\xa0")
    yield printable(row.note.lstrip(",; ").strip())


def unbroken(text: str) -> str:
    """Text of a cell whose sign of a bound stays on the line of its number."""
    return printable(text).replace("≤ ", "≤\xa0").replace("≥ ", "≥\xa0")


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
    """Warnings by kind with their meaning, the severe ones first; a sentence where there are none."""
    if not warnings:
        return Text("The result has no warnings.")
    ordered = sorted(warnings, key=lambda warning: _SEVERITIES.index(warning.severity))
    kinds: dict[tuple[Severity, str], list[str]] = {}
    for one in ordered:
        kinds.setdefault((one.severity, one.code), []).append(printable(one.text))
    return Warnings(
        tuple(
            WarningLine(severity, code, CODES[code].meaning, tuple(texts))
            for (severity, code), texts in kinds.items()
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
