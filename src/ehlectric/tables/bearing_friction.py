"""Rows of the friction of a bearing whose contacts are solved with heat."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.cases.row import Row, amount_row


def friction_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the rolling resistance and of the heat in the most loaded contacts.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, SI units; there are no rows where no heat is solved, and for results of earlier
        versions.

    Yields
    ------
    Row
        Heading and rows.
    """
    totals = summary["bearing"]
    power = totals.get("rolling_power_loss")
    if power is None:
        return
    yield Row("friction, hydrodynamic rolling alone")
    yield amount_row("power loss by rolling", power, "W", ", without spin, slip, cage, seals and churned oil")
    yield Row("rolling moment", f"{1e3 * totals['rolling_moment']:.3g}", "N mm")
    for ring in ("inner", "outer"):
        loss = totals[f"{ring}_contact_power_loss"]
        coefficient = f", rolling coefficient {totals[f'{ring}_rolling_coefficient']:.2g}"
        yield amount_row(f"power loss, most loaded {ring} contact", loss, "W", coefficient)
        peak, error = (totals[f"{ring}_{key}"] for key in ("max_temperature_rise", "temperature_rise_error"))
        known = "" if error is None else f" ± {error:.1g}"
        note = f", largest {peak:.2g}{known} K"
        yield Row(
            "temperature rise at its inlet", f"{totals[f'{ring}_inlet_temperature_rise']:.2g}", "K", note
        )
