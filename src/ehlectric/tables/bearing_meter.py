"""Rows of a bearing's table about what lies between shaft and housing beside its films."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.quantities.bearing_results import BEARING_KEYS
from ehlectric.quantities.rows import Row, rows_of
from ehlectric.tables.bearing_bounds import bounds_of

_COATING = "capacitance of the coating", "bearing.coating_capacitance", "pF"
_SHAFT = "capacitance from shaft to housing", "bearing.shaft_capacitance", "pF", ", smooth films"


def outside_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of parallel capacitance and coating, and of the capacitance that a meter reads.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, as ``BearingResult.summary`` gives it; one of an earlier version has no rows.

    Yields
    ------
    Row
        Values in SI units.
    """
    totals = summary["bearing"]
    if "shaft_capacitance" not in totals:
        return
    if totals["parallel_capacitance"] or "parallel_capacitance" in summary["inputs"]["bearing"]:
        yield Row("parallel capacitance", totals["parallel_capacitance"], "pF", ", cage, shields and wiring")
    else:
        yield Row("parallel capacitance", "not given", note=", taken as 0 (cage, shields and wiring)")
    yield from rows_of(BEARING_KEYS, summary, [_COATING])
    if totals["parallel_capacitance"] or totals["coating_capacitance"] is not None:
        yield from rows_of(BEARING_KEYS, summary, [_SHAFT], bounds_of(summary))
    if totals["meter_capacitance"] is not None:
        rough = "" if totals["roughness_factor"] is None else ", rough films"
        yield Row("capacitance that a meter reads", totals["meter_capacitance"], "pF", rough)
    elif totals["lubrication"] in ("conducting", "partial film"):
        yield Row("capacitance that a meter reads", "not computed", note=", asperities touch")


def shaft_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of a coating's share of the shaft voltage, and of the shaft voltages of both breakdowns."""
    lines = (
        ("share of the coating at high frequency", "bearing.coating_share", "%"),
        ("voltage across the films", "bearing.film_voltage", "V"),
        ("shaft voltage of the first breakdown", "bearing.shaft_first_break", "V"),
        ("shaft voltage, ring-to-ring breakdown", "bearing.shaft_through_breakdown", "V"),
        ("breakdown voltage of the coating", "bearing.coating_breakdown", "V"),
    )
    yield from rows_of(BEARING_KEYS, summary, lines, bounds_of(summary))
