"""How all tables look."""

from __future__ import annotations

from rich.table import Table
from rich.text import Text


def plain_table(title: str) -> Table:
    """A table of names, numbers and units, without lines."""
    table = Table(title=Text(title) if title else None, show_header=False, title_justify="left", box=None)
    table.add_column(style="bold")
    table.add_column(justify="right")
    table.add_column()
    return table
