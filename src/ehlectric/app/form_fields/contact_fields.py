"""Fields of the page of a contact, its heat and shear, and the inputs that contacts of both geometries
share.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ehlectric.app.catalogue import oil
from ehlectric.app.form_fields.field import (
    Field,
    Group,
    Way,
    always,
    both,
    equal,
    fields_of,
    given,
    list_of_ways,
    never,
    way_by,
)
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.form_fields.oil_fields import oil as oil_fields
from ehlectric.app.page_inputs import Inputs
from ehlectric.quantities.inputs import form

# Material of both bodies when the heat is switched on, as in the examples; an assumption.
_STEEL = {f"contact.body_{number}.material": "steel" for number in (1, 2)}


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
    *("lubricant.thermal_conductivity", "contact.temperature_1", "contact.temperature_2"),
    *(
        f"contact.body_{number}.{key}"
        for number in (1, 2)
        for key in ("material", "thermal_conductivity", "heat_capacity", "density")
    ),
)
_SHOWN: dict[str, dict[str, Any]] = {
    "lubricant.eyring_stress": {"when": equal("film.rheology", "eyring")},
    "lubricant.carreau_stress": {"when": equal("film.rheology", "carreau")},
    "lubricant.carreau_exponent": {"when": equal("film.rheology", "carreau")},
    "lubricant.limiting_coefficient": {"when": equal("film.rheology", "limiting")},
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
    "lubricant.thermal_conductivity": list_of_ways(
        "film.way_thermal",
        "Temperature of the film",
        Way("Computed", {"film.thermal": True, **_STEEL}, "film.thermal", value=True),
        Way("That of the oil in the inlet", {"film.thermal": None}),
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


_MODULUS, _RATIO = "youngs_modulus", "poissons_ratio"
_ELASTIC = tuple(f"contact.body_{k}.{key}" for k in (1, 2) for key in (_MODULUS, _RATIO))


# Steel, as both bodies of the examples have it; an assumption.
_CONTACT_STEEL = dict(zip(_ELASTIC, 2 * ("206 GPa", 0.3), strict=True))


def _load_ways(key: str, label: str, first: str) -> Field:
    """Load as such, or by its Hertz pressure."""
    return list_of_ways(
        "contact.way_load",
        "Load given as",
        way_by(key, label, first),
        Way("Hertz pressure", {"contact.max_hertz_pressure": "1 GPa"}),
    )


# Lists of alternatives, by the key before which they stand.
_CONTACT_WAYS = {
    "contact.reduced_radius": list_of_ways(
        "contact.way_radius",
        "Radius given as",
        way_by("contact.reduced_radius", "Reduced radius", "10 mm"),
        Way("Both radii", {"contact.radius_1": "20 mm", "contact.radius_2": "20 mm"}),
    ),
    "contact.load_per_length": _load_ways("contact.load_per_length", "Load per length", "0.5 MN/m"),
    "contact.load": _load_ways("contact.load", "Load", "20 N"),
    "contact.entrainment_speed": list_of_ways(
        "contact.way_speed",
        "Speeds given as",
        way_by("contact.entrainment_speed", "Mean of both", "2 m/s"),
        Way("Speed of each surface", {"contact.speed_1": "2 m/s", "contact.speed_2": "2 m/s"}),
    ),
    "contact.reduced_modulus": list_of_ways(
        "contact.way_modulus",
        "Elasticity given as",
        way_by("contact.reduced_modulus", "Reduced modulus", "226 GPa"),
        Way("Both materials", _CONTACT_STEEL),
    ),
}

# Keys of which one of several is given: a field is shown with its value only.
_ALTERNATIVES = (
    *("contact.reduced_radius", "contact.radius_1", "contact.radius_2", "contact.load_per_length"),
    *("contact.load", "contact.max_hertz_pressure", "contact.entrainment_speed", "contact.speed_1"),
    *("contact.speed_2", "contact.reduced_modulus", "grid.nodes"),
)
_CONTACT_SHOWN: dict[str, dict[str, Any]] = {
    **{key: {"when": never} for key in _ALTERNATIVES},
    **{key: {"when": given(*_ELASTIC)} for key in _ELASTIC},
    "contact.slide_to_roll_ratio": {"when": given("contact.entrainment_speed")},
    "discharge.dielectric_strength": {"note": "an assumption; none is published for films"},
    "grid.error": {"when": both(equal("grid.nodes", None), equal("motion", None))},
}


def _groups(name: str, nodes: str, first: int, ends: tuple[float, float]) -> tuple[Group, ...]:
    """Groups of the form of a geometry, with the label, the first value and the slider of its nodes."""
    groups = form(name)
    ways = _CONTACT_WAYS | {
        "grid.nodes": list_of_ways(
            "grid.way_nodes",
            "Grid given by",
            way_by("grid.nodes", nodes, first),
            Way("Error of the film", {"grid.nodes": None}),
        )
    }
    shown = _CONTACT_SHOWN | {"grid.nodes": {"when": never, "low": ends[0], "high": ends[1]}}

    def group(title: str, *, opened: bool = True) -> Group:
        return Group(title, fields_of(groups[title], shown, ways), opened=opened)

    return (
        group("Contact"),
        oil_fields(
            groups["Oil"],
            base={"own": "Own values"},
            viscosity={"when": equal("lubricant.temperature", None)},
            pressure_viscosity_coefficient={"when": always, "note": ""},
            relative_permittivity={"when": always, "high": 8.0},
        ),
        group("Voltage and breakdown"),
        heat(groups["Heat and shear"]),
        group("Materials", opened=False),
        group("Grid", opened=False),
    )


_GROUPS: Mapping[str, tuple[Group, ...]] = {
    "line": _groups("line", "Nodes", 3201, (201, 12801)),
    "point": _groups("point", "Nodes along each side", 257, (65, 513)),
}

# Tables and keys that line and point contacts share, which a change from one to the other keeps.
_SHARED = ("lubricant", "electric", "discharge", "film", "inlet")
_SHARED_CONTACT = (
    "reduced_modulus",
    "entrainment_speed",
    "slide_to_roll_ratio",
    "speed_1",
    "speed_2",
    "temperature",
    "max_hertz_pressure",
    "boundary_film",
    "hardness",
    "boundary_friction",
    *(f"body_{k}.{key}" for k in (1, 2) for key in (_MODULUS, _RATIO)),
    *HEAT_OF_CONTACT,
)


def geometry_of(inputs: Inputs) -> str:
    """Geometry of a contact, "line" or "point"; a line where the inputs do not say."""
    return "point" if inputs.value("contact.geometry") == "point" else "line"


def groups_of(geometry: str) -> tuple[Group, ...]:
    """Fields of a contact of a geometry."""
    return _GROUPS[geometry]


def switched(inputs: Inputs, start: Inputs) -> Inputs:
    """Inputs of a contact of the other geometry, which begin with those of ``start``.

    Oil, potentials, breakdown, materials, speeds and temperature are those of the present inputs; geometry,
    load and grid are those of ``start``. Roughness and motion, which belong to a geometry, are left out.
    """
    left = (*_SHARED, "title", "roughness", "motion")
    table = {key: value for key, value in start.table.items() if key not in left}
    table |= {key: inputs.table[key] for key in _SHARED if key in inputs.table}
    found = Inputs({**table, "title": f"{geometry_of(start).capitalize()} contact"})
    # A point contact has no length, and a line contact gets back the one it had before.
    if found.value("discharge") is not None:
        found = found.changed({"discharge.length": start.value("discharge.length")})
    values = {f"contact.{name}": inputs.value(f"contact.{name}") for name in _SHARED_CONTACT}
    return changed(found, {key: value for key, value in values.items() if value is not None})
