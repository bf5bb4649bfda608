"""Rows of data as tables of the terminal."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ehlectric.cases.row import Row

if TYPE_CHECKING:
    from rich.table import Table


def table_of(rows: Iterable[Row], title: str = "") -> Table:
    """Table of rows for the terminal: names, values, and units with notes, without lines.

    Parameters
    ----------
    rows : iterable of Row
        Rows, values in SI units. Alarms are red.
    title : str, optional
        Title above the table.

    Returns
    -------
    rich.table.Table
        Values in their shown units.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(title=Text(title) if title else None, show_header=False, title_justify="left", box=None)
    table.add_column(style="bold", no_wrap=True)
    table.add_column(justify="right", no_wrap=True)
    table.add_column()
    for row in rows:
        table.add_row(row.name, row.shown, row.unit + row.note, style="red" if row.alarm else None)
    return table
