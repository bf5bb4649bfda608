"""Tables in CSV files: heads with units, and writing."""

from __future__ import annotations

import csv
import re
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


# First characters of a text that a spreadsheet takes for a formula.
_FORMULA = re.compile(r"'*+[=+\-@\t\r\n＝＋－＠]")

# A number, which no spreadsheet takes for anything else.
_NUMBER = re.compile(r"-?[0-9]++(?:\.[0-9]++)?(?:e[-+]?[0-9]++)?")


def csv_text(text: str) -> str:
    """Text for a cell of a CSV file, which no spreadsheet takes for a formula.

    A text that begins like a formula, with "=", "+", "-", "@", a tab or a line break, gets an apostrophe
    before it, which spreadsheets take for the mark of a text.

    Examples
    --------
    >>> csv_text("=HYPERLINK(A1)"), csv_text("6208, 70 °C")
    ("'=HYPERLINK(A1)", '6208, 70 °C')
    """
    # A text with apostrophes before the sign gets one more, so that the way back is certain.
    return f"'{text}" if _FORMULA.match(text) else text


def _cell(value: Any) -> Any:
    """Value for a cell: a number is unchanged, also one as text, and another text is no formula."""
    return csv_text(value) if isinstance(value, str) and not _NUMBER.fullmatch(value) else value


def csv_of(
    heads: Sequence[str], rows: Iterable[Iterable[Any]], *, ending: str = "\r\n"
) -> Callable[[BinaryIO], None]:
    """Function that writes a table as CSV in UTF-8 to an open file, with this ending of its lines.

    No text is taken for a formula by a spreadsheet, see ``csv_text``.
    """

    def content(file: BinaryIO) -> None:
        # Names of files may hold bytes that are no text in UTF-8; they are escaped.
        text = TextIOWrapper(file, encoding="utf-8", errors="backslashreplace", newline="")
        writer = csv.writer(text, lineterminator=ending)
        writer.writerow(map(_cell, heads))
        writer.writerows(map(_cell, row) for row in rows)
        text.detach()

    return content
