"""Fields of the heat and the shear in the film of a contact."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ehlectric.app.catalogue import oil
from ehlectric.app.fields.field import Field, Group, Way, When, fields_of
from ehlectric.app.inputs import Inputs

# Material of both bodies when the heat is switched on, as in the examples; an assumption.
_STEEL = {f"contact.body_{number}.material": "steel" for number in (1, 2)}


def _hot(inputs: Inputs) -> bool:
    return inputs.value("film.thermal") is True


def _follows(inputs: Inputs) -> bool:
    """Whether the viscosity of the oil follows its temperature, without which no heat can be computed."""
    if any(inputs.value(f"lubricant.{key}") is not None for key in ("temperature", "atmospheric_law")):
        return True
    known = oil(str(inputs.value("lubricant.base")))
    return bool(known) and "viscosity" not in known and inputs.value("lubricant.viscosity") is None


def _sheared(name: str) -> When:
    """Whether the oil is sheared after a law."""
    return lambda inputs: inputs.value("film.rheology") == name


# Keys that only a film has whose temperature is computed.
_OF_HEAT = (
    *("lubricant.thermal_conductivity", "contact.temperature_1", "contact.temperature_2"),
    *(
        f"contact.body_{number}.{key}"
        for number in (1, 2)
        for key in ("material", "thermal_conductivity", "heat_capacity", "density")
    ),
)
_SHOWN: dict[str, dict[str, Any]] = {
    "lubricant.eyring_stress": {"when": _sheared("eyring")},
    "lubricant.carreau_stress": {"when": _sheared("carreau")},
    "lubricant.carreau_exponent": {"when": _sheared("carreau")},
    "lubricant.limiting_coefficient": {"when": _sheared("limiting")},
    **{key: {"when": _hot} for key in _OF_HEAT},
    **{f"contact.body_{number}.material": {"when": _hot, "own": "Own values"} for number in (1, 2)},
    "lubricant.heat_capacity": {
        "when": _hot,
        "low": 1000.0,
        "high": 3000.0,
        "note": "about 2000 J/kg/K; needs a density",
    },
}
_WAYS = {
    "lubricant.thermal_conductivity": Field(
        "film.way_thermal",
        "Temperature of the film",
        kind="ways",
        ways=(
            Way("Computed", {"film.thermal": True, **_STEEL}, "film.thermal", value=True),
            Way("That of the oil in the inlet", {"film.thermal": None}),
        ),
        when=_follows,
    )
}


def heat(keys: Iterable[str]) -> Group:
    """Group of the heat and the shear in the film, which can be switched off."""
    return Group(
        "Heat and shear",
        fields_of(keys, _SHOWN, _WAYS),
        opened=False,
        table="film",
        start={"rheology": "newtonian"},
        note="Without it the film is isothermal and Newtonian. Temperatures are computed with an oil whose "
        "viscosity follows its temperature.",
    )


# Keys of the heat within the table of the contact, which line and point contacts share.
HEAT_OF_CONTACT = tuple(key.removeprefix("contact.") for key in _OF_HEAT if key.startswith("contact."))
