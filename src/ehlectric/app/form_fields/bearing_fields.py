"""Fields of the page of a bearing, with the supply of oil to its contacts."""

from __future__ import annotations

from typing import Any

from ehlectric.app.form_fields.field import (
    VEHICLE,
    VEHICLE_TABLE,
    always,
    both,
    carries,
    equal,
    given,
    group_of,
    of_kind,
    unequal,
)
from ehlectric.app.form_fields.oil_fields import oil
from ehlectric.quantities.inputs import attributes, form

_custom_geometry = equal("bearing.base", None)


def _number_in_place_of(key: str) -> dict[str, Any]:
    """Condition of a field that holds a number where its list has no word for the value."""
    words = [
        alternative["value"]
        for entry in attributes("lists")[key]
        for alternative in entry["alternatives"]
        if "value" in alternative
    ]
    return {"when": unequal(key, None, *words), "strict": True}


# Dimensions of a user-defined bearing, and those that bearings of some kinds have.
_DIMENSIONS = ("kind", "elements", "element_diameter", "pitch_diameter", "bore", "outer_diameter", "width")
_OF_KINDS = ("inner_groove", "outer_groove", "shoulder_height", "roller_length")

# When fields are shown.
_SHOWN: dict[str, dict[str, Any]] = {
    **{f"bearing.{name}": {"when": _custom_geometry} for name in _DIMENSIONS},
    **{f"bearing.{name}": {"when": both(_custom_geometry, of_kind(name))} for name in _OF_KINDS},
    "bearing.profile": {"when": of_kind("profile")},
    "bearing.contact_angle": {"when": of_kind("contact_angle")},
    "bearing.element_capacitance": {"when": equal("bearing.element_material", "silicon-nitride")},
    "bearing.radial_load": {"when": carries("radial")},
    "bearing.axial_load": {"when": carries("axial")},
    **{key: _number_in_place_of(key) for key in ("bearing.film_factor", "bearing.supply", "bearing.fill")},
    **{
        key: {"when": given("bearing.fits")}
        for key in form("bearing")["Clearance"]
        if key.startswith("bearing.fits.") and key not in attributes("only_given")
    },
    "bearing.coating.ring": {"when": equal("bearing.coating.base", None)},
}
_LISTS = {"bearing.radial_clearance": of_kind("radial_clearance")}
# When groups are shown.
_GROUPS = {
    "Pair": of_kind("pair"),
    "Clearance": of_kind("radial_clearance"),
    VEHICLE: given(VEHICLE_TABLE),
}

BEARING_GROUPS = tuple(
    oil("bearing")
    if title == "Oil"
    else group_of("bearing", title, _SHOWN, _LISTS, when=_GROUPS.get(title, always))
    for title in form("bearing")
)
