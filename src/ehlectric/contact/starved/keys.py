"""Keys of the summary of a starved contact: meaning, unit, name and symbol."""

from __future__ import annotations

from typing import Any

from ehlectric.cases.result_key import Keys, ResultKey
from ehlectric.film.accuracy.starved import Starvation

_ONLY = "; only with `[inlet]`"

STARVED_KEYS: Keys = {
    "oil_layer": ResultKey(
        "thickness of the oil on both surfaces together before the contact, on the centre line; if they "
        "slide, the oil that they carry over the mean speed; null for `film_ratio = 1` in a point "
        f"contact{_ONLY}",
        "m",
        "layer of oil",
        r"$h_\mathrm{oil}$",
    ),
    "film_ratio": ResultKey(
        f"central film thickness over that of the flooded contact; null if that did not converge{_ONLY}",
        "",
        "starved / flooded central film",
        r"$h_\mathrm{c}/h_\mathrm{c,ff}$",
    ),
    "meniscus": ResultKey(
        "position on the centre line from which oil fills the gap; null if the film is flooded, or if oil "
        f"fills the gap at the inlet edge there{_ONLY}",
        "m",
        "position of the meniscus",
        r"$x_\mathrm{m}$",
    ),
    "flooded.minimum_thickness": ResultKey(
        "minimum film thickness of the same contact with a flooded inlet, on the same grid; null if it "
        f"did not converge{_ONLY}",
        "m",
        "minimum film thickness, flooded",
    ),
    "flooded.central_thickness": ResultKey(
        "central film thickness of the same contact with a flooded inlet; null if it did not converge"
        f"{_ONLY}",
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
