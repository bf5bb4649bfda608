"""Tables in CSV files: heads with units, and writing."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ehlectric.runtime.files import whole


def column_head(name: str, unit: str) -> str:
    """Head of a column of numbers: its name, and its unit in brackets, a hyphen for a dimensionless one.

    Examples
    --------
    >>> column_head("load", "N"), column_head("lambda_ratio", ""), column_head("zone_size", "m**2")
    ('load [N]', 'lambda_ratio [-]', 'zone_size [m^2]')
    """
    return f"{name} [{unit.replace('**', '^').replace('*', ' ') or '-'}]"


def write_csv(path: Path, heads: Sequence[str], rows: Iterable[Iterable[Any]]) -> None:
    """Write a CSV file in UTF-8; an interrupted write leaves no partial file."""
    with whole(path) as beside, beside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(heads)
        writer.writerows(rows)
