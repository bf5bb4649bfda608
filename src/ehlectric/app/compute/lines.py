"""Lines of the table that the command prints, from its rows."""

from __future__ import annotations

from collections.abc import Iterable

from ehlectric.app.answers.line import Line
from ehlectric.quantities.rows import Row


def lines_of(rows: Iterable[Row]) -> tuple[Line, ...]:
    """Lines of rows.

    Examples
    --------
    >>> lines_of([Row("film"), Row("minimum film", 2e-7, "µm")])[1].text
    '0.2 µm'
    """
    return tuple(Line(row.name, row.text, row.alarm) for row in rows)
