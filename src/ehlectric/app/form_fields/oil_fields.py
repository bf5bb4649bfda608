"""Fields of an oil: an oil of the library, or the oil of a data sheet."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.app.catalogue import oil as oil_named
from ehlectric.app.catalogue import oil_needs
from ehlectric.app.form_fields.field import Group, both, equal, given, group_of
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import FILM_FACTORS

_SHEET = "lubricant.temperature"

# Thermal expansion of an oil whose data sheet gives none.
EXPANSION = "6.5e-4 1/K"


_sheet = given(_SHEET)
_heat_of_films = both(given("bearing"), equal("bearing.film_factor", None, *FILM_FACTORS[1:]))
_heated = both(_sheet, _heat_of_films)
_solved_heat = both(_sheet, equal("bearing.film_factor", "solved"))


def _permittivity(inputs: Inputs) -> bool:
    return _sheet(inputs) or "relative_permittivity" in oil_needs(str(inputs.value("lubricant.base")))


def _needs_exponent(inputs: Inputs) -> bool:
    return "roelands_z" in oil_needs(str(inputs.value("lubricant.base")))


def assumed(inputs: Inputs) -> str:
    """Sentence on the properties that a data sheet does not give, with the values taken instead.

    They are the values of the oil that ``lubricant.base`` names, except for what the data sheet replaces.

    Examples
    --------
    >>> oil = {"base": "paper", "temperature": {"base_oil": "pao"}}
    >>> assumed(Inputs({"lubricant": oil})).partition(";")[0]
    "Assumed, since not given: relative permittivity 2.4 of 'paper'"
    """
    given, base = inputs.value("lubricant") or {}, str(inputs.value("lubricant.base"))
    known = oil_named(base)
    if not _sheet(inputs) or not known:
        return ""
    parts = []
    if not given.keys() & {"relative_permittivity", "permittivity_table"}:
        value = known.get("relative_permittivity")
        parts.append(f"relative permittivity {value} of {base!r}" if value else "")
    parts.append(_assumed_with_pressure(given, known, base))
    if "density_law" not in given:
        parts.append(f"density over pressure as in {base!r} ({known.get('density_law')})")
    if inputs.value(f"{_SHEET}.expansion") is None:
        parts.append(f"thermal expansion {EXPANSION}")
    text = "; ".join(filter(None, parts))
    return f"Assumed, since not given: {text}." if text else ""


def _assumed_with_pressure(given: Mapping[str, Any], known: Mapping[str, Any], base: str) -> str:
    """Part of the sentence on the rise of the viscosity with pressure."""
    law = given.get("viscosity_law") or known.get("viscosity_law")
    if law != "roelands":
        return "" if "viscosity_law" in given else f"viscosity over pressure as in {base!r} ({law})"
    lacks = [_WORDS[name] for name in _WORDS if given.get(name) is None]
    sheet = given.get("temperature", {})
    exponent = known.get("roelands_z")
    if not lacks:
        return ""
    if given.get("roelands_z") is not None:
        return f"{lacks[0]} by Roelands' relation from z and the viscosity"
    if isinstance(sheet, Mapping) and sheet.get("base_oil"):
        if len(lacks) == 1:
            return f"{lacks[0]} by Roelands' relation from the coefficient and the viscosity"
        return f"{' and '.join(lacks)} as estimated for {sheet['base_oil']}"
    if exponent is None:
        return ""
    exponent_text = f"Roelands' z {exponent} of {base!r}"
    return (
        exponent_text
        if len(lacks) == 1
        else f"{exponent_text}, which with the viscosity gives the {lacks[0]}"
    )


_WORDS = {"pressure_viscosity_coefficient": "pressure-viscosity coefficient", "roelands_z": "Roelands' z"}


_SHOWN: dict[str, dict[str, Any]] = {
    f"{_SHEET}.density_15": {"when": _sheet},
    f"{_SHEET}.base_oil": {"when": _sheet},
    f"{_SHEET}.thermal_conductivity": {"when": _heated},
    "lubricant.heat_capacity": {"when": _solved_heat},
    "lubricant.relative_permittivity": {"when": _permittivity},
    "lubricant.pressure_viscosity_coefficient": {"when": _sheet},
    "lubricant.roelands_z": {"when": _needs_exponent},
}
_LISTS = {f"{_SHEET}.iso_vg": _sheet, f"{_SHEET}.viscosity_index": _sheet}


def oil(form_name: str, **shown: Mapping[str, Any]) -> Group:
    """Group of the oil of a form; ``shown`` replaces what other forms say of a key, by its last name."""
    others = {(key := f"lubricant.{name}"): {**_SHOWN.get(key, {}), **more} for name, more in shown.items()}
    return group_of(form_name, "Oil", _SHOWN | others, _LISTS, tells=assumed)
