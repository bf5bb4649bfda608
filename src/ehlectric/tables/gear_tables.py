"""Tables of a gear pair: its key figures, and the points of its path of contact."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from ehlectric.quantities.formats import SELDOM
from ehlectric.quantities.results import GEAR_BOOK, PATH_POINTS, POINT_KEYS
from ehlectric.quantities.rows import Row, RowTexts, Summary, row_of, sheet_rows, value_at
from ehlectric.quantities.sheets import GEAR
from ehlectric.readable import SAME_NUMBER
from ehlectric.tables.duty_rows import alarms_of_cycle, stretch_rows, values_of_cycle
from ehlectric.tables.measured_tables import columns_table
from ehlectric.tables.probability_rows import (
    left_out_of_probability,
    probability_note,
    probability_value,
    shares_of_spread,
)

if TYPE_CHECKING:
    from rich.table import Table


# Shares of time, which have no digits if they are very close to 0 or 1.
_SHARES = ("mesh.contact_time_share", "mesh.contact_time_share_low", "mesh.contact_time_share_high")


_PROBABILITY = "uncertainty.breakdown_probability"

# Shares of the points that have no breakdown voltage.
_WITHOUT_VOLTAGE = ("uncertainty.asperity_contact_probability", "uncertainty.conduction_probability")

# Breakdown voltages of the distribution, from the smallest to the largest.
_VOLTAGES = tuple(f"uncertainty.breakdown_voltage_{end}" for end in ("low", "median", "high"))


def _probability(summary: Summary) -> Any:
    """Probability of breakdown; None if no point has a breakdown voltage: each one touches or conducts."""
    without = sum(value_at(summary, key) or 0.0 for key in _WITHOUT_VOLTAGE)
    return None if without > 1.0 - SAME_NUMBER else probability_value(_PROBABILITY)(summary)


def _voltage(key: str) -> Callable[[Summary], Any]:
    """Breakdown voltage of the distribution. Of voltages that are 0, the largest one has a text, and the
    smaller ones have no row.
    """
    larger = _VOLTAGES[_VOLTAGES.index(key) + 1 :]

    def value(summary: Summary) -> Any:
        voltage = value_at(summary, key)
        if voltage is None or voltage > 0.0:
            return voltage
        return None if any(value_at(summary, other) == 0.0 for other in larger) else "none, metallic contact"

    return value


def gear_rows(summary: Summary) -> list[Row]:
    """Rows of the key figures of a gear pair."""
    shares = {key: partial(_time_share, key) for key in _SHARES if value_at(summary, key) > 0.0}
    return list(sheet_rows(GEAR, GEAR_BOOK, summary, _WORDS | RowTexts(values=shares)))


# Texts next to the numbers of a gear pair.
_WORDS = RowTexts(
    notes={_PROBABILITY: probability_note},
    values={_PROBABILITY: _probability, **{key: _voltage(key) for key in _VOLTAGES}, **values_of_cycle()},
    alarms=alarms_of_cycle(),
    rows={
        "uncertainty.indices": shares_of_spread,
        "uncertainty.left_out": left_out_of_probability,
        "duty.stretches": partial(stretch_rows, GEAR_BOOK),
    },
)


def _time_share(key: str, summary: Summary) -> float | tuple[str, str]:
    """Share of time, which has a text where its digits would round to 0 or 100 %."""
    share = float(value_at(summary, key))
    if share < SELDOM:
        return f"< {100.0 * SELDOM:g}", "%"
    if share > 1.0 - SELDOM:
        return f"> {100.0 * (1.0 - SELDOM):g}", "%"
    return share if share < 0.99 else (f"{100.0 * share:.4g}", "%")


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
