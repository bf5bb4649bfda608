"""Kind of the bearing of inputs, and the inputs that only some kinds have."""

from __future__ import annotations

from typing import Any

from ehlectric.app.catalogue import bearing
from ehlectric.app.inputs import Inputs

DEEP, ANGULAR, ROLLERS = "deep-groove ball", "angular-contact ball", "cylindrical roller"

# Keys that a kind does not have.
_REFUSED = {
    DEEP: ("contact_angle", "roller_length", "profile"),
    ANGULAR: ("radial_clearance", "clearance_class", "fits", "roller_length", "profile"),
    ROLLERS: ("inner_groove", "outer_groove", "shoulder_height", "contact_angle", "axial_load"),
}

# First values of keys that a kind needs; the clearance and the profile are assumptions of the examples.
_GROOVES = {"inner_groove": 0.52, "outer_groove": 0.53}
_NEEDED: dict[str, dict[str, Any]] = {
    DEEP: {**_GROOVES, "shoulder_height": 0.19, "radial_clearance": "10 um"},
    ANGULAR: {**_GROOVES, "shoulder_height": 0.31, "contact_angle": "40 deg", "axial_load": "1000 N"},
    ROLLERS: {"roller_length": "10 mm", "profile": "logarithmic", "radial_clearance": "20 um"},
}


def kind_of(inputs: Inputs) -> str:
    """Kind of the bearing; empty where the inputs do not tell it."""
    kind = inputs.value("bearing.kind") or bearing(str(inputs.value("bearing.base"))).get("kind", "")
    return str(kind)


def has_balls(inputs: Inputs) -> bool:
    """Whether the bearing has balls."""
    return kind_of(inputs) in (DEEP, ANGULAR)


def has_clearance(inputs: Inputs) -> bool:
    """Whether the bearing has a radial clearance, and not a contact angle."""
    return kind_of(inputs) in (DEEP, ROLLERS)


def fitted_to_kind(inputs: Inputs) -> dict[str, Any]:
    """Changes that a bearing of another kind needs: keys it does not have, and first values of keys it lacks.

    Examples
    --------
    >>> fitted_to_kind(Inputs({"bearing": {"base": "nu-208", "axial_load": "300 N"}}))
    {'bearing.axial_load': None, 'bearing.profile': 'logarithmic', 'bearing.radial_clearance': '20 um'}
    """
    kind = kind_of(inputs)
    known = bearing(str(inputs.value("bearing.base")))
    given = [f"bearing.{key}" for key in _REFUSED.get(kind, ())]
    changes: dict[str, Any] = {key: None for key in given if inputs.value(key) is not None}
    for name, value in _NEEDED.get(kind, {}).items():
        key = f"bearing.{name}"
        clear = name == "radial_clearance" and (
            inputs.value("bearing.clearance_class") or inputs.value("bearing.fits")
        )
        if not clear and inputs.value(key) is None and name not in known:
            changes[key] = value
    return changes
