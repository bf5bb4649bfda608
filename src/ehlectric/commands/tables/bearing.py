"""Tables of a bearing."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table


def loads_table(summary: dict[str, Any]) -> Table:
    """Load and dry contact of every element with either ring."""
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


def films_table(summary: dict[str, Any]) -> Table:
    """Film, capacitance and voltages of every element with either ring."""
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


def _contacts_table(summary: dict[str, Any], heads: Sequence[str], rows: Iterable[tuple[str, ...]]) -> Table:
    from rich.markup import escape
    from rich.table import Table

    table = Table(box=None, padding=(0, 2, 0, 0))
    for head in ("", "ring", *heads):
        # Unescaped, a unit of small letters would be taken for a style.
        table.add_column(escape(head), justify="right", no_wrap=True)
    for row, texts in zip(summary["contacts"], rows, strict=True):
        table.add_row(str(row["element"]), row["ring"], *texts)
    return table


def _number(value: float | None, factor: float, digits: str) -> str:
    """A number in its column; nothing where there is none."""
    return "" if value is None else f"{value * factor:{digits}}"


def bearing_table(summary: dict[str, Any]) -> Table:
    """The totals of a bearing."""
    from ehlectric.bearing.keys import BEARING_KEYS
    from ehlectric.commands.tables.layout import add_numbers, plain_table

    found = summary["bearing"]
    table = plain_table(summary["title"])
    factor = summary["inputs"]["bearing"]["film_factor"]
    rows = (
        ("capacitance", "bearing.capacitance", "pF", f", contacts {found['contacts']}"),
        ("  all in oil", "bearing.capacitance_oil", "pF", ""),
        ("  air around the films", "bearing.capacitance_air", "pF", ""),
        ("  over that of plates", "bearing.capacitance_ratio", "", ""),
        ("least lambda", "bearing.lambda_ratio", "", found["lubrication"]),
        ("film factor", "bearing.film_factor", "", "" if isinstance(factor, float) else factor),
        ("first break", "bearing.first_break", "V", ""),
        ("  mean over a pitch", "bearing.first_break_mean", "V", ""),
        ("through breakdown", "bearing.through_breakdown", "V", ""),
        ("  mean over a pitch", "bearing.through_breakdown_mean", "V", ""),
        ("largest field by volt", "bearing.strength_per_volt", "1/µm", ", of the bearing's voltage"),
        ("  at the shaft voltage", "bearing.max_strength", "V/µm", ""),
        ("bearing voltage ratio", "bearing.bearing_voltage_ratio", "%", ""),
        ("shaft voltage", "bearing.shaft_voltage", "V", ", capacitive alone"),
        ("first break over it", "bearing.margin", "", ""),
        ("error of the film", "bearing.discretisation_error", "%", ""),
        ("error of interpolation", "bearing.interpolation_error", "%", ""),
    )
    numbers = {f"bearing.{name}": value for name, value in found.items()}
    add_numbers(table, BEARING_KEYS, numbers, rows)
    if found["first_break_at"] is not None:
        table.add_row("breaks first", "", found["first_break_at"])
    table.add_row("time", f"{summary['seconds']:.3g}", "s")
    return table
