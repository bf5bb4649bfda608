"""Rows of the film factor of a bearing: heat in the inlet and supply of oil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

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
        yield "film factor of the heat, by formula", "bearing.inlet_shear_factor", "", "(Wilson and Sheu)"
    if supply != "flooded":
        note = f"({supply}, by SKF's factor)" if isinstance(supply, str) else "(given)"
        yield "film factor of the supply", "bearing.supply_factor", "", note
        yield "half time of the film without supply", "bearing.film_half_time", "s"


def _note(summary: Mapping[str, Any], supply: object) -> str:
    """Parts of the film factor."""
    if summary["bearing"]["film_factor"] == 1.0:
        return "(isothermal, fully flooded)"
    heat = _HEAT.get(summary["inputs"]["bearing"]["film_factor"], "")
    oil = "supply of oil" if supply != "flooded" else ""
    return f"({' and '.join(filter(None, (heat, oil))) or 'given'})"
