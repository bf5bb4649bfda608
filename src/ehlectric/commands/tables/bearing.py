"""Rows of the totals of a bearing, and tables of the contacts of its elements."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ehlectric.bearing.keys import BEARING_KEYS
from ehlectric.cases.row import Row, rows_of

if TYPE_CHECKING:
    from rich.table import Table


def loads_table(summary: Mapping[str, Any]) -> Table:
    """Table of the loads and dry contacts of all elements with both rings."""
    heads = ("at\n[deg]", "load\n[N]", "angle\n[deg]", "p_h\n[GPa]", "semi-axes\n[µm]")
    rows = (
        (
            f"{math.degrees(row['position']):.0f}",
            f"{row['load']:.4g}",
            f"{math.degrees(row['contact_angle']):.1f}",
            _number(row["max_pressure"], 1e-9, ".3f"),
            " x ".join(filter(None, [_number(row[f"semi_axis_{axis}"], 1e6, ".4g") for axis in "xy"])),
        )
        for row in summary["contacts"]
    )
    return _contacts_table(summary, heads, rows)


def films_table(summary: Mapping[str, Any]) -> Table:
    """Table of the films, capacitances and voltages of all elements with both rings."""
    driven = summary["bearing"]["shaft_voltage"] is not None
    heads = ("h_min\n[µm]", "h(0)\n[µm]", "lambda", "C\n[pF]", "share\n[%]")
    rows = (
        (
            f"{row['minimum_thickness'] * 1e6:.4g}",
            f"{row['central_thickness'] * 1e6:.4g}",
            f"{row['lambda_ratio']:.3g}",
            _number(row["capacitance"], 1e12, ".4g"),
            _number(row["voltage_share"], 100.0, ".1f"),
            _number(row["max_strength" if driven else "strength_per_volt"], 1e-6, ".3g"),
            _number(row["breakdown_voltage"], 1.0, ".3g"),
        )
        for row in summary["contacts"]
    )
    field = "E\n[V/µm]" if driven else "E/V\n[1/µm]"
    return _contacts_table(summary, (*heads, field, "breaks\n[V]"), rows)


def _contacts_table(
    summary: Mapping[str, Any], heads: Sequence[str], rows: Iterable[tuple[str, ...]]
) -> Table:
    """Table with a row for each element and ring, and these columns."""
    from rich.markup import escape
    from rich.table import Table

    table = Table(box=None, padding=(0, 2, 0, 0))
    for head in ("", "ring", *heads):
        # Rich would read a unit of small letters in brackets as a style.
        table.add_column(escape(head), justify="right", no_wrap=True)
    for row, texts in zip(summary["contacts"], rows, strict=True):
        table.add_row(str(row["element"]), row["ring"], *texts)
    return table


def _number(value: float | None, factor: float, digits: str) -> str:
    """Number of a cell as text; empty where it is None."""
    return "" if value is None else f"{value * factor:{digits}}"


def total_rows(summary: Mapping[str, Any]) -> list[Row]:
    """Rows of the totals of a bearing.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, as ``BearingResult.summary`` gives it.

    Returns
    -------
    list of Row
        Values in SI units.
    """
    totals, factor = summary["bearing"], summary["inputs"]["bearing"]["film_factor"]
    entries = (
        ("capacitance", "bearing.capacitance", "pF", f", contacts {totals['contacts']}"),
        ("  all in oil", "bearing.capacitance_oil", "pF"),
        ("  air around the films", "bearing.capacitance_air", "pF"),
        ("  over that of plates", "bearing.capacitance_ratio", ""),
        ("least lambda", "bearing.lambda_ratio", "", totals["lubrication"]),
        ("film factor", "bearing.film_factor", "", "" if isinstance(factor, float) else factor),
        ("first break", "bearing.first_break", "V"),
        ("  mean over a pitch", "bearing.first_break_mean", "V"),
        ("through breakdown", "bearing.through_breakdown", "V"),
        ("  mean over a pitch", "bearing.through_breakdown_mean", "V"),
        ("largest field by volt", "bearing.strength_per_volt", "1/µm", ", of the bearing's voltage"),
        ("  at the shaft voltage", "bearing.max_strength", "V/µm"),
        ("bearing voltage ratio", "bearing.bearing_voltage_ratio", "%"),
        ("shaft voltage", "bearing.shaft_voltage", "V", ", capacitive alone"),
        ("first break over it", "bearing.margin", ""),
        ("error of the film", "bearing.discretisation_error", "%"),
        ("error of interpolation", "bearing.interpolation_error", "%"),
    )
    rows = list(rows_of(BEARING_KEYS, summary, entries))
    if totals["first_break_at"] is not None:
        rows.append(Row("breaks first", note=totals["first_break_at"]))
    return [*rows, Row("time", summary["seconds"], "s", digits=".3g")]
