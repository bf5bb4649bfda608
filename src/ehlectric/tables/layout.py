"""Tables of the terminal, made from rows of data."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ehlectric.errors import printable
from ehlectric.quantities.rows import Row

if TYPE_CHECKING:
    from rich.table import Table


def table_of(rows: Iterable[Row], title: str = "") -> Table:
    """Table of rows for the terminal: names, and beside them values with units and notes.

    Parameters
    ----------
    rows : iterable of Row
        Rows, values in SI units. Headings are bold, with the rows below them indented. Alarms are red.
    title : str, optional
        Title above the table.

    Returns
    -------
    rich.table.Table
        Two columns, both aligned to the left; values in their shown units.
    """
    from rich.table import Table
    from rich.text import Text

    table = Table(
        title=Text(printable(title)) if title else None, show_header=False, title_justify="left", box=None
    )
    table.add_column(no_wrap=True)
    table.add_column()
    indent = ""
    for row in rows:
        if row.heading:
            table.add_row(Text(printable(row.name)), "", style="bold")
            indent = "  "
        else:
            # Text keeps rich from reading brackets as a style.
            cells = Text(indent + printable(row.name)), Text(printable(row.text))
            table.add_row(*cells, style="red" if row.alarm else None)
    return table
