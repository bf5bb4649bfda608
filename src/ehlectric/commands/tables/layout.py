"""How all tables look."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from rich.table import Table
from rich.text import Text

from ehlectric.cases.quantity import to_fraction, to_si
from ehlectric.cases.result_key import Keys, key_of

# Name of a row, dotted key of its number, unit that the number is shown in, and a text behind that unit.
Row = tuple[str, str, str, str]


def plain_table(title: str) -> Table:
    """A table of names, numbers and units, without lines."""
    table = Table(title=Text(title) if title else None, show_header=False, title_justify="left", box=None)
    table.add_column(style="bold")
    table.add_column(justify="right")
    table.add_column()
    return table


def add_numbers(table: Table, keys: Keys, summary: Mapping[str, Any], rows: Iterable[Row]) -> None:
    """Rows of the numbers of a summary that are there.

    Parameters
    ----------
    table : Table
        Table of names, numbers and units.
    keys : mapping of str to ResultKey
        Keys of the summary, for the SI unit of each number.
    summary : mapping
        Summary by dotted key, SI units.
    rows : iterable of tuple
        Name, dotted key, unit that the number is shown in, and a text behind that unit.
    """
    for name, key, unit, about in rows:
        value, own = summary.get(key), key_of(keys, key)
        if value is not None and own is not None:
            table.add_row(name, f"{value * factor_to(unit, own.unit):.4g}", unit + about)


def factor_to(shown: str, unit: str) -> float:
    """Factor from an SI unit to the unit in which a number is shown.

    Examples
    --------
    >>> factor_to("pF", "F"), factor_to("V/µm", "V/m"), factor_to("%", "")
    (1000000000000.0, 1e-06, 100.0)
    """
    one = to_fraction(f"1 {shown}") if shown == "%" else to_si(f"1 {shown}", unit) if unit else 1.0
    return float(f"{1.0 / one:.9g}")
