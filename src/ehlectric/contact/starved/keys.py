"""Keys of the summary of a starved contact: meaning, unit, name and symbol."""

from __future__ import annotations

from typing import Any

from ehlectric.cases.result_key import Keys, ResultKey
from ehlectric.film.accuracy.starved import Starvation

_ONLY = "; only with `[inlet]`"

STARVED_KEYS: Keys = {
    "oil_layer": ResultKey(
        f"thickness of the oil on both surfaces together before the contact, on the centre line{_ONLY}",
        "m",
        "layer of oil",
        r"$h_\mathrm{oil}$",
    ),
    "film_ratio": ResultKey(
        f"central film thickness over that of the flooded contact{_ONLY}",
        "",
        "starved / flooded central film",
        r"$h_\mathrm{c}/h_\mathrm{c,ff}$",
    ),
    "meniscus": ResultKey(
        f"position on the centre line from which oil fills the gap; null if the film is flooded{_ONLY}",
        "m",
        "position of the meniscus",
        r"$x_\mathrm{m}$",
    ),
    "flooded.minimum_thickness": ResultKey(
        f"minimum film thickness of the same contact with a flooded inlet, on the same grid{_ONLY}",
        "m",
        "minimum film thickness, flooded",
    ),
    "flooded.central_thickness": ResultKey(
        f"central film thickness of the same contact with a flooded inlet{_ONLY}",
        "m",
        "central film thickness, flooded",
    ),
}


def starved_summary(starvation: Starvation | None) -> dict[str, Any]:
    """Key figures of the supply of oil, for the table ``film`` of a summary; empty without a supply."""
    if starvation is None:
        return {}
    return {
        "oil_layer": starvation.oil_layer,
        "film_ratio": starvation.film_ratio,
        "meniscus": starvation.meniscus,
        "flooded": {
            "minimum_thickness": starvation.flooded_minimum_thickness,
            "central_thickness": starvation.flooded_central_thickness,
        },
    }
