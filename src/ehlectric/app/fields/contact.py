"""Fields of the page of a contact, and the inputs that contacts of both geometries share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ehlectric.app.fields.field import Field, Group, Way
from ehlectric.app.fields.heat import HEAT, HEAT_OF_CONTACT
from ehlectric.app.fields.oil import OIL as OIL_OF_BEARING
from ehlectric.app.fields.rules import changed
from ehlectric.app.inputs import Inputs

_MODULUS, _RATIO = "youngs_modulus", "poissons_ratio"


def _no(_: Inputs) -> bool:
    return False


def _no_sheet(inputs: Inputs) -> bool:
    return inputs.value("lubricant.temperature") is None


def _bodies(inputs: Inputs) -> bool:
    keys = (f"contact.body_{number}.{key}" for number in (1, 2) for key in (_MODULUS, _RATIO))
    return any(inputs.value(key) is not None for key in keys)


def _body(number: int, what: str, label: str, unit: str, ends: tuple[float, float]) -> Field:
    """Field of an elastic constant of a body."""
    key = f"contact.body_{number}.{what}"
    return Field(key, f"{label}, surface {number}", unit, *ends, log=bool(unit), when=_bodies)


# Steel, as both bodies of the examples have it; an assumption.
_STEEL = {
    f"contact.body_{k}.{key}": value for k in (1, 2) for key, value in ((_MODULUS, "206 GPa"), (_RATIO, 0.3))
}

_MATERIALS = Group(
    "Materials",
    (
        Field(
            "contact.way_modulus",
            "Elasticity given as",
            kind="ways",
            ways=(
                Way("Reduced modulus", {"contact.reduced_modulus": "226 GPa"}, "contact.reduced_modulus"),
                Way("Both materials", _STEEL),
            ),
        ),
        Field("contact.reduced_modulus", "Reduced modulus E'", "GPa", 10.0, 500.0, log=True, when=_no),
        _body(1, _MODULUS, "Young's modulus", "GPa", (10.0, 500.0)),
        _body(1, _RATIO, "Poisson's ratio", "", (0.0, 0.5)),
        _body(2, _MODULUS, "Young's modulus", "GPa", (10.0, 500.0)),
        _body(2, _RATIO, "Poisson's ratio", "", (0.0, 0.5)),
    ),
    opened=False,
)

_SPEEDS = (
    Field(
        "contact.way_speed",
        "Speeds given as",
        kind="ways",
        ways=(
            Way("Mean of both", {"contact.entrainment_speed": "2 m/s"}, "contact.entrainment_speed"),
            Way("Speed of each surface", {"contact.speed_1": "2 m/s", "contact.speed_2": "2 m/s"}),
        ),
    ),
    Field(
        "contact.entrainment_speed",
        "Entrainment speed",
        "m/s",
        0.05,
        20.0,
        log=True,
        note="(u1 + u2)/2",
        when=_no,
    ),
    Field(
        "contact.slide_to_roll_ratio",
        "Slide-to-roll ratio",
        "",
        -2.0,
        2.0,
        note="(u1 - u2)/mean",
        when=lambda inputs: inputs.value("contact.entrainment_speed") is not None,
    ),
    Field("contact.speed_1", "Speed of surface 1, u1", "m/s", 0.05, 20.0, log=True, when=_no),
    Field("contact.speed_2", "Speed of surface 2, u2", "m/s", 0.05, 20.0, log=True, when=_no),
    Field(
        "contact.temperature",
        "Temperature of the oil",
        "degC",
        0.0,
        120.0,
        note="of an oil that depends on it",
    ),
    Field(
        "contact.boundary_film",
        "Boundary film",
        "nm",
        0.5,
        5.0,
        note="gap at which the surfaces touch",
        optional=True,
    ),
    Field(
        "contact.hardness",
        "Hardness of the surfaces",
        "GPa",
        1.0,
        20.0,
        log=True,
        note="none: elastic",
        optional=True,
    ),
    Field(
        "contact.boundary_friction",
        "Friction of boundary films",
        "",
        0.01,
        0.3,
        note="coefficient where the surfaces touch and slide",
        optional=True,
    ),
    Field(
        "inlet.oil_layer",
        "Layer of oil at the inlet",
        "um",
        0.01,
        10.0,
        log=True,
        note="on both surfaces together; none: flooded",
        optional=True,
    ),
)

_PRESSURE = Field("contact.max_hertz_pressure", "Hertz pressure", "GPa", 0.2, 4.0, when=_no)


def _load(load: Field, first: str) -> tuple[Field, ...]:
    """Fields of the load, which is given as such or by its Hertz pressure."""
    ways = (
        Way(load.label, {load.key: first}, load.key),
        Way("Hertz pressure", {_PRESSURE.key: "1 GPa"}),
    )
    return (
        Field("contact.way_load", "Load given as", kind="ways", ways=ways),
        replace(load, when=_no),
        _PRESSURE,
    )


_LINE = Group(
    "Contact",
    (
        Field(
            "contact.way_radius",
            "Radius given as",
            kind="ways",
            ways=(
                Way("Reduced radius", {"contact.reduced_radius": "10 mm"}, "contact.reduced_radius"),
                Way("Both radii", {"contact.radius_1": "20 mm", "contact.radius_2": "20 mm"}),
            ),
        ),
        Field("contact.reduced_radius", "Reduced radius", "mm", 1.0, 100.0, log=True, when=_no),
        Field("contact.radius_1", "Radius of surface 1", "mm", 1.0, 1000.0, log=True, when=_no),
        Field("contact.radius_2", "Radius of surface 2", "mm", 1.0, 1000.0, log=True, when=_no),
        *_load(Field("contact.load_per_length", "Load per length", "MN/m", 0.01, 5.0, log=True), "0.5 MN/m"),
        *_SPEEDS,
    ),
)

_POINT = Group(
    "Contact",
    (
        Field("contact.radius_x", "Radius along entrainment", "mm", 1.0, 100.0, log=True),
        Field("contact.radius_y", "Radius across entrainment", "mm", 1.0, 1000.0, log=True),
        *_load(Field("contact.load", "Load", "N", 1.0, 2000.0, log=True), "20 N"),
        *_SPEEDS,
    ),
)

_BASE, *_SHEET = OIL_OF_BEARING.fields
_PERMITTIVITY = "lubricant.relative_permittivity"
_COEFFICIENT = "lubricant.pressure_viscosity_coefficient"
# In the form of a contact it stands with the other inputs of the heat.
_OF_HEAT = "lubricant.heat_capacity"

_OIL = replace(
    OIL_OF_BEARING,
    fields=(
        replace(_BASE, own="Own values"),
        Field(
            "lubricant.viscosity",
            "Viscosity at ambient pressure",
            "Pa s",
            0.002,
            2.0,
            log=True,
            when=_no_sheet,
        ),
        Field(_COEFFICIENT, "Pressure-viscosity coefficient", "1/GPa", 5.0, 40.0),
        Field(_PERMITTIVITY, "Relative permittivity", "", 1.8, 8.0),
        *(field for field in _SHEET if field.key not in (_PERMITTIVITY, _COEFFICIENT, _OF_HEAT)),
    ),
)

_FIELD = Group(
    "Voltage and breakdown",
    (
        Field("electric.potential_1", "Potential of surface 1", "V", -50.0, 50.0),
        Field("electric.potential_2", "Potential of surface 2", "V", -50.0, 50.0),
        Field(
            "discharge.dielectric_strength",
            "Dielectric strength",
            "V/um",
            1.0,
            100.0,
            log=True,
            note="an assumption; none is published for films",
        ),
        Field(
            "electric.resistivity",
            "Resistivity of the bodies",
            "ohm m",
            1e-8,
            1e-5,
            log=True,
            note="of spots where the surfaces touch",
            optional=True,
        ),
        Field(
            "electric.mean_free_path",
            "Mean free path of electrons",
            "nm",
            0.0,
            100.0,
            note="matters for spots of that size",
            optional=True,
        ),
        Field(
            "electric.tribofilm_resistance",
            "Resistance of a tribofilm times its area",
            "ohm m^2",
            1e-12,
            1e-3,
            log=True,
            note="resistivity times thickness",
            optional=True,
        ),
    ),
)

# Spots of a line contact are strips, whose resistance depends on their length.
_FIELD_OF_LINE = replace(
    _FIELD,
    fields=(
        *_FIELD.fields,
        Field(
            "discharge.length",
            "Length of the contact",
            "mm",
            0.1,
            100.0,
            log=True,
            note="for the resistance of strips that touch",
            optional=True,
        ),
    ),
)

_IN_WIDTHS = "in half-widths of the dry contact; without ends and sides the domain suits the film"


_SIDE = Field(
    "grid.side",
    "Distance of the sides",
    "",
    1.5,
    10.0,
    note="in semi-axes of the dry contact, across; without ends and sides the domain suits the film",
    optional=True,
)


def _refined(inputs: Inputs) -> bool:
    return inputs.value("grid.nodes") is None and inputs.value("motion") is None


def _grid(label: str, ends: tuple[float, float], nodes: int, *more: Field) -> Group:
    ways = (
        Way(label, {"grid.nodes": nodes}, "grid.nodes"),
        Way("Error of the film", {"grid.nodes": None}),
    )
    return Group(
        "Grid",
        (
            Field("grid.way_nodes", "Grid given by", kind="ways", ways=ways),
            Field("grid.nodes", label, "", *ends, log=True, kind="count", when=_no),
            Field(
                "grid.error",
                "Error of the film",
                "%",
                0.1,
                5.0,
                log=True,
                note="the grid is refined until its estimate is below this",
                when=_refined,
            ),
            Field("grid.inlet", "Start of the domain", "", -10.0, -2.0, note=_IN_WIDTHS, optional=True),
            Field("grid.outlet", "End of the domain", "", 1.2, 4.0, note=_IN_WIDTHS, optional=True),
            *more,
        ),
        opened=False,
    )


_GROUPS: Mapping[str, tuple[Group, ...]] = {
    "line": (_LINE, _OIL, _FIELD_OF_LINE, HEAT, _MATERIALS, _grid("Nodes", (201.0, 12801.0), 3201)),
    "point": (
        *(_POINT, _OIL, _FIELD, HEAT, _MATERIALS),
        _grid("Nodes along each side", (65.0, 513.0), 257, _SIDE),
    ),
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
    """Inputs of a contact of the other geometry, with what both have.

    Parameters
    ----------
    inputs : Inputs
        Present inputs.
    start : Inputs
        Inputs of the other geometry, which give what the present ones lack.

    Returns
    -------
    Inputs
        Oil, potentials, breakdown, materials, speeds and temperature of the present inputs; geometry, load
        and grid of the others. Roughness and motion, which belong to a geometry, are left out.
    """
    left = (*_SHARED, "title", "roughness", "motion")
    table = {key: value for key, value in start.table.items() if key not in left}
    table |= {key: inputs.table[key] for key in _SHARED if key in inputs.table}
    found = Inputs({**table, "title": f"{geometry_of(start).capitalize()} contact"})
    # A point contact has no length, and a line contact gets back the one it had before.
    if found.value("discharge") is not None:
        found = found.changed({"discharge.length": start.value("discharge.length")})
    given = {f"contact.{name}": inputs.value(f"contact.{name}") for name in _SHARED_CONTACT}
    return changed(found, {key: value for key, value in given.items() if value is not None})
