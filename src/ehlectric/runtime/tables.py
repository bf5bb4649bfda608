"""Tables in CSV files: heads with units, and writing."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Sequence
from io import TextIOWrapper
from typing import Any, BinaryIO


def column_head(name: str, unit: str) -> str:
    """Head of a column of numbers: its name, and its unit in brackets, a hyphen for a dimensionless one.

    Examples
    --------
    >>> column_head("load", "N"), column_head("lambda_ratio", ""), column_head("zone_size", "m**2")
    ('load [N]', 'lambda_ratio [-]', 'zone_size [m^2]')
    """
    return f"{name} [{unit.replace('**', '^').replace('*', ' ') or '-'}]"


def csv_of(
    heads: Sequence[str], rows: Iterable[Iterable[Any]], *, ending: str = "\r\n"
) -> Callable[[BinaryIO], None]:
    """Function that writes a table as CSV in UTF-8 to an open file, with this ending of its lines."""

    def content(file: BinaryIO) -> None:
        text = TextIOWrapper(file, encoding="utf-8", newline="")
        writer = csv.writer(text, lineterminator=ending)
        writer.writerow(heads)
        writer.writerows(rows)
        text.detach()

    return content
