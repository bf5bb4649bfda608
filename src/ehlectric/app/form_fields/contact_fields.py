"""Fields of the page of a contact, its heat and shear, and the inputs that contacts of both geometries
share.
"""

from __future__ import annotations

from typing import Any

from ehlectric.app.catalogue import oil
from ehlectric.app.form_fields.field import Group, always, both, equal, given, group_of
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.form_fields.oil_fields import oil as oil_fields
from ehlectric.app.page_inputs import Inputs
from ehlectric.quantities.inputs import form


def _hot(inputs: Inputs) -> bool:
    return inputs.value("film.thermal") is True


def _follows(inputs: Inputs) -> bool:
    """Whether the viscosity of the oil follows its temperature, without which no heat can be computed."""
    if given("lubricant.temperature", "lubricant.atmospheric_law")(inputs):
        return True
    known = oil(str(inputs.value("lubricant.base")))
    return bool(known) and "viscosity" not in known and inputs.value("lubricant.viscosity") is None


# Keys that only a film has whose temperature is computed.
_OF_HEAT = (
    "lubricant.thermal_conductivity",
    *(key for key in form("line")["Heat and shear"] if key.startswith("contact.")),
)

_ELASTIC = tuple(f"body_{k}.{key}" for k in (1, 2) for key in ("youngs_modulus", "poissons_ratio"))

# When fields are shown, and where contacts differ from the book.
_SHOWN: dict[str, dict[str, Any]] = {
    "lubricant.eyring_stress": {"when": equal("film.rheology", "eyring")},
    "lubricant.carreau_stress": {"when": equal("film.rheology", "carreau")},
    "lubricant.carreau_exponent": {"when": equal("film.rheology", "carreau")},
    "lubricant.limiting_coefficient": {"when": equal("film.rheology", "limiting")},
    **{key: {"when": _hot} for key in _OF_HEAT},
    "lubricant.heat_capacity": {
        "when": _hot,
        "low": 1000.0,
        "high": 3000.0,
        "note": "needs a density",
    },
    **{f"contact.{key}": {"when": given(*(f"contact.{name}" for name in _ELASTIC))} for key in _ELASTIC},
    "contact.slide_to_roll_ratio": {"when": given("contact.entrainment_speed")},
    "discharge.dielectric_strength": {"note": "an assumption; none is published for films"},
    "grid.error": {"when": both(equal("grid.nodes", None), equal("motion", None))},
}
_LISTS = {"lubricant.thermal_conductivity": _follows}

# Ends of the slider of the nodes along each side of a point contact.
_NODES_OF_POINT = {"low": 65, "high": 513}


def _groups(name: str) -> tuple[Group, ...]:
    """Groups of the form of a geometry."""
    shown = _SHOWN | ({"grid.nodes": _NODES_OF_POINT} if name == "point" else {})
    of_oil = oil_fields(
        name,
        base={"custom_label": "Own values"},
        viscosity={"when": equal("lubricant.temperature", None)},
        pressure_viscosity_coefficient={"when": always, "note": ""},
        relative_permittivity={"when": always, "high": 8.0},
    )
    groups = (of_oil if title == "Oil" else group_of(name, title, shown, _LISTS) for title in form(name))
    return tuple(groups)


_GROUPS = {name: _groups(name) for name in ("line", "point")}

# Tables that line and point contacts share, which a change from one to the other keeps.
_SHARED = ("lubricant", "electric", "discharge", "film", "inlet")

# Inputs of the table ``contact`` that they share.
_KEYS = {name: [key for keys in form(name).values() for key in keys] for name in ("line", "point")}
_KEPT = [key for key in _KEYS["line"] if key.startswith("contact.") and key in _KEYS["point"]]


def geometry_of(inputs: Inputs) -> str:
    """Geometry of a contact, "line" or "point"; a line where the inputs do not say."""
    return "point" if inputs.value("contact.geometry") == "point" else "line"


def groups_of(geometry: str) -> tuple[Group, ...]:
    """Fields of a contact of a geometry."""
    return _GROUPS[geometry]


def switched(inputs: Inputs, start: Inputs) -> Inputs:
    """Inputs of a contact of the other geometry, which begin with the inputs of ``start``.

    Oil, potentials, breakdown, materials, speeds and temperature are taken from the present inputs; geometry,
    load and grid are taken from ``start``. Roughness and motion, which belong to a geometry, are omitted.
    """
    left = (*_SHARED, "title", "roughness", "motion")
    table = {key: value for key, value in start.table.items() if key not in left}
    table |= {key: inputs.table[key] for key in _SHARED if key in inputs.table}
    result = Inputs({**table, "title": f"{geometry_of(start).capitalize()} contact"})
    # A point contact has no length, and a line contact gets back the one it had before.
    if result.value("discharge") is not None:
        result = result.changed({"discharge.length": start.value("discharge.length")})
    values = {key: inputs.value(key) for key in _KEPT}
    return changed(result, {key: value for key, value in values.items() if value is not None})
