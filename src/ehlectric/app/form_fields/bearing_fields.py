"""Fields of the page of a bearing, with the supply of oil to its contacts."""

from __future__ import annotations

from typing import Any

from ehlectric.app.form_fields.field import (
    ANGULAR,
    ROLLERS,
    both,
    equal,
    form_data,
    given,
    group_of,
    has_balls,
    has_clearance,
    kind_of,
    unequal,
)
from ehlectric.app.form_fields.oil_fields import oil
from ehlectric.app.page_inputs import Inputs
from ehlectric.quantities.inputs import form

_own = equal("bearing.base", None)


def _rollers(inputs: Inputs) -> bool:
    return kind_of(inputs) == ROLLERS


def _angular(inputs: Inputs) -> bool:
    return kind_of(inputs) == ANGULAR


def _number_in_place_of(key: str) -> dict[str, Any]:
    """Condition of a field that holds a number where its list has no word for the value."""
    words = [way["value"] for way in form_data("alternatives")[key]["ways"] if "value" in way]
    return {"when": unequal(key, None, *words), "strict": True}


# Dimensions of a user-defined bearing, and those that only ball bearings have.
_DIMENSIONS = ("kind", "elements", "element_diameter", "pitch_diameter", "bore", "outer_diameter", "width")
_OF_BALLS = ("inner_groove", "outer_groove", "shoulder_height")

# When fields are shown.
_SHOWN: dict[str, dict[str, Any]] = {
    **{f"bearing.{name}": {"when": _own} for name in _DIMENSIONS},
    **{f"bearing.{name}": {"when": both(_own, has_balls)} for name in _OF_BALLS},
    "bearing.roller_length": {"when": both(_own, _rollers)},
    "bearing.profile": {"when": _rollers},
    "bearing.contact_angle": {"when": _angular},
    "bearing.element_capacitance": {"when": equal("bearing.element_material", "silicon-nitride")},
    "bearing.axial_load": {"when": has_balls},
    **{key: _number_in_place_of(key) for key in ("bearing.film_factor", "bearing.supply", "bearing.fill")},
    **{
        key: {"when": given("bearing.fits")}
        for key in form("bearing")["Clearance"]
        if key.startswith("bearing.fits.") and key not in form_data("only_given")
    },
    "bearing.coating.ring": {"when": equal("bearing.coating.base", None)},
}
_LISTS = {"bearing.radial_clearance": has_clearance}

BEARING_GROUPS = tuple(
    oil("bearing") if title == "Oil" else group_of("bearing", title, _SHOWN, _LISTS)
    for title in form("bearing")
)
