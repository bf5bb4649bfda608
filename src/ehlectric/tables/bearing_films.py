"""Rows of the films of a bearing: their factor, of heat and supply of oil, and the friction of their heat."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.quantities.rows import Row, amount_row

# Heat of a film factor in words.
_HEAT: Mapping[object, str] = {
    "inlet-shear": "heating by shear in the inlet",
    "solved": "solved heat in the film, in pure rolling",
}


def film_factors(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Entries of the film factor, and of the supply of oil of a bearing that is not flooded.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, SI units; those of earlier versions have no supply.

    Yields
    ------
    tuple of str
        Name of the row, dotted key of its number, shown unit and note, as ``cases.row.rows_of`` takes them.
    """
    bearing = summary["inputs"]["bearing"]
    supply = bearing.get("supply", "flooded")
    yield "film factor", "bearing.film_factor", "", _note(summary, supply)
    if bearing["film_factor"] == "solved":
        if supply != "flooded":
            yield "film factor of the heat", "bearing.heat_factor", "", "(solved)"
        yield "film factor of the heat, by formula", "bearing.inlet_shear_factor", "", "(Wilson and Sheu)"
    if supply != "flooded":
        note = f"({supply}, by SKF's factor)" if isinstance(supply, str) else "(given)"
        yield "film factor of the supply", "bearing.supply_factor", "", note
        yield "half time of the film without supply", "bearing.film_half_time", "s"


def _note(summary: Mapping[str, Any], supply: object) -> str:
    """Parts of the film factor."""
    if summary["bearing"]["film_factor"] == 1.0:
        return "(isothermal, fully flooded)"
    factor = summary["inputs"]["bearing"]["film_factor"]
    if supply == "flooded":
        return f"({_HEAT.get(factor, 'given')})"
    other = _HEAT.get(factor) or (f"given factor of {factor:.3g}" if factor not in ("none", 1.0) else "")
    return f"({' and '.join(filter(None, (other, 'supply of oil')))})"


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
    flooded = summary["inputs"]["bearing"].get("supply", "flooded") == "flooded"
    note = f"{'' if flooded else ', of flooded contacts'}, without spin, slip, cage, seals and churned oil"
    yield amount_row("power loss by rolling", power, "W", note)
    yield Row("rolling moment", f"{1e3 * totals['rolling_moment']:.3g}", "N mm")
    for ring in ("inner", "outer"):
        loss = totals[f"{ring}_contact_power_loss"]
        coefficient = f", rolling coefficient {totals[f'{ring}_rolling_coefficient']:.2g}"
        yield amount_row(f"power loss, most loaded {ring} contact", loss, "W", coefficient)
        peak, error = (totals[f"{ring}_{key}"] for key in ("max_temperature_rise", "temperature_rise_error"))
        known = "" if error is None else f" ± {error:.1g}"
        note, rise = f", largest in the film {peak:.2g}{known} K", totals[f"{ring}_inlet_temperature_rise"]
        yield Row(f"inlet temperature rise, {ring} contact", f"{rise:.2g}", "K", note)
