"""Tables of a gear pair: its key figures, and the points of its path of contact."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ehlectric.quantities.formats import SELDOM
from ehlectric.quantities.results import GEAR_BOOK, PATH_POINTS, POINT_KEYS
from ehlectric.quantities.rows import Row, RowTexts, Summary, row_of, sheet_rows, value_at
from ehlectric.quantities.sheets import GEAR
from ehlectric.tables.measured_tables import columns_table
from ehlectric.tables.probability_rows import (
    left_out_of_probability,
    probability_note,
    probability_value,
    shares_of_spread,
)

if TYPE_CHECKING:
    from rich.table import Table


# Shares of time, which have no digits if they are very small.
_SHARES = ("mesh.contact_time_share", "mesh.contact_time_share_low", "mesh.contact_time_share_high")


_PROBABILITY = "uncertainty.breakdown_probability"


def gear_rows(summary: Summary) -> list[Row]:
    """Rows of the key figures of a gear pair."""
    seldom = {key: _seldom for key in _SHARES if 0.0 < value_at(summary, key) < SELDOM}
    return list(sheet_rows(GEAR, GEAR_BOOK, summary, _WORDS | RowTexts(values=seldom)))


# Texts next to the numbers of a gear pair.
_WORDS = RowTexts(
    notes={_PROBABILITY: probability_note},
    values={_PROBABILITY: probability_value(_PROBABILITY)},
    rows={"uncertainty.indices": shares_of_spread, "uncertainty.left_out": left_out_of_probability},
)


def _seldom(_: Summary) -> tuple[str, str]:
    return f"< {100.0 * SELDOM:g}", "%"


def point_rows(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of points, then a row for each quantity that a point has, with its value
    at each point.
    """
    yield "path of contact", *PATH_POINTS, ""
    for name, about in POINT_KEYS.items():
        values = [summary["points"][point].get(name) for point in PATH_POINTS]
        if all(value is None for value in values):
            continue
        rows = [row_of(f"point.{name}", about, value) for value in values]
        yield about.label, *(row.shown for row in rows), rows[0].unit


def points_table(summary: Summary) -> Table:
    """Table of the points of the path of contact, for the terminal."""
    heads, *rows = point_rows(summary)
    return columns_table(heads, rows, left=(0, len(heads) - 1), wrapped=(0,))
