"""Fields of the page of a bearing, with the supply of oil to its contacts."""

from __future__ import annotations

from typing import Any

from ehlectric.app.fields.field import (
    ANGULAR,
    ROLLERS,
    Field,
    Group,
    Way,
    fields_of,
    has_balls,
    has_clearance,
    kind_of,
    never,
)
from ehlectric.app.fields.oil_fields import oil
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import FILM_FACTORS
from ehlectric.quantities.inputs import form

_ASSUMED = "The first values are assumptions: replace them with your own."
_ISOTHERMAL = "Isothermal, fully flooded"


def _own(inputs: Inputs) -> bool:
    return inputs.value("bearing.base") is None


def _own_balls(inputs: Inputs) -> bool:
    return _own(inputs) and has_balls(inputs)


def _own_rollers(inputs: Inputs) -> bool:
    return _own(inputs) and kind_of(inputs) == ROLLERS


def _rollers(inputs: Inputs) -> bool:
    return kind_of(inputs) == ROLLERS


def _angular(inputs: Inputs) -> bool:
    return kind_of(inputs) == ANGULAR


def _ceramic(inputs: Inputs) -> bool:
    return bool(inputs.value("bearing.element_material") == "silicon-nitride")


def _own_coating(inputs: Inputs) -> bool:
    return inputs.value("bearing.coating.base") is None


# Endings of a designation that change nothing here: seals, shields and classes of clearance, as makers write
# them. The clearance has fields of its own.
_ENDINGS = (
    r"([-\s/]*(2?rs[hlr]?[12]?|2?rz|2?z[rz]?|zz|2?ddu?|v{1,2}|ll[ubh]|2?ns[el]?|ee|uu|c[2-5]|cn|cm))+\s*$"
)

# Clearance before mounting and fits of the example of the guide: a 6208 of class C3 in an aluminium housing.
_FITS = {
    "bearing.clearance_class": "C3",
    "bearing.fits.shaft_interference": "13.5 um",
    "bearing.fits.housing_interference": "-20 um",
    "bearing.fits.housing_material": "aluminium",
}


def _fits(inputs: Inputs) -> bool:
    return inputs.value("bearing.fits") is not None


def _factor(inputs: Inputs) -> bool:
    return inputs.value("bearing.film_factor") not in (None, *FILM_FACTORS)


def _part(inputs: Inputs) -> bool:
    return inputs.value("bearing.fill") not in (None, "oil", "air")


# Ways of supply in words, by the value of ``bearing.supply``.
_SUPPLIES = {
    "flooded": "Fully flooded",
    "oil-bath": "Low oil bath",
    "oil-jet": "Oil jet",
    "grease": "Grease",
    "oil-air": "Oil and air",
}


def _share(inputs: Inputs) -> bool:
    return inputs.value("bearing.supply") not in (None, *_SUPPLIES)


# Lists of alternatives, by the key before which they stand.
_WAYS = {
    "bearing.radial_clearance": Field(
        "bearing.clearance",
        "Clearance given as",
        kind="ways",
        ways=(
            Way("Class and fits", _FITS, "bearing.fits"),
            Way(
                "Class before mounting",
                {"bearing.clearance_class": "CN", "bearing.fits": None},
                "bearing.clearance_class",
            ),
            Way("Clearance in operation", {"bearing.radial_clearance": "10 um"}),
        ),
        when=has_clearance,
    ),
    "bearing.film_factor": Field(
        "bearing.film_way",
        "Heat and starvation",
        kind="ways",
        ways=(
            Way(_ISOTHERMAL, {"bearing.film_factor": "none"}, "bearing.film_factor", "none"),
            Way(
                "Heat by shear in the inlet",
                {"bearing.film_factor": "inlet-shear"},
                "bearing.film_factor",
                "inlet-shear",
            ),
            Way(
                "Heat in the film, solved with the contacts",
                {"bearing.film_factor": "solved"},
                "bearing.film_factor",
                "solved",
            ),
            Way("A factor of your own", {"bearing.film_factor": 0.7}, "bearing.film_factor"),
            Way(_ISOTHERMAL, listed=False),
        ),
    ),
    "bearing.supply": Field(
        "bearing.supply_way",
        "Oil supplied by",
        kind="ways",
        ways=(
            *(Way(words, {"bearing.supply": way}, "bearing.supply", way) for way, words in _SUPPLIES.items()),
            Way("A share of the flooded film", {"bearing.supply": 0.6}, "bearing.supply"),
            Way("Fully flooded", listed=False),
        ),
    ),
    "bearing.fill": Field(
        "bearing.fill_way",
        "Around the films",
        kind="ways",
        ways=(
            Way("Oil", {"bearing.fill": "oil"}, "bearing.fill", "oil"),
            Way("Air", {"bearing.fill": "air"}, "bearing.fill", "air"),
            Way("Partly oil", {"bearing.fill": "30 %"}, "bearing.fill"),
            Way("Oil", listed=False),
        ),
    ),
}

# Dimensions of one's own bearing, and those that only ball bearings have.
_DIMENSIONS = ("kind", "elements", "element_diameter", "pitch_diameter", "bore", "outer_diameter", "width")
_OF_BALLS = ("inner_groove", "outer_groove", "shoulder_height")

# When fields are shown, and what their lists need.
_SHOWN: dict[str, dict[str, Any]] = {
    "bearing.base": {
        "own": "Own geometry",
        "ignored": _ENDINGS,
        "lacks": "not in the catalogue ({count} bearings): choose your own geometry and type its dimensions",
    },
    **{f"bearing.{name}": {"when": _own} for name in _DIMENSIONS},
    **{f"bearing.{name}": {"when": _own_balls} for name in _OF_BALLS},
    "bearing.roller_length": {"when": _own_rollers},
    "bearing.profile": {"when": _rollers},
    "bearing.contact_angle": {"when": _angular},
    "bearing.element_capacitance": {"when": _ceramic},
    "bearing.axial_load": {"when": has_balls},
    "bearing.film_factor": {"when": _factor, "strict": True},
    "bearing.supply": {"when": _share, "strict": True},
    "bearing.fill": {"when": _part, "strict": True},
    "bearing.radial_clearance": {"when": never},
    "bearing.clearance_class": {"when": never},
    **{key: {"when": _fits} for key in form("bearing")["Clearance"] if key.startswith("bearing.fits.")},
    "bearing.fits.unmounted_clearance": {"when": never},
    "bearing.coating.base": {"own": "Own coating"},
    "bearing.coating.ring": {"when": _own_coating},
}


def _group(title: str, **more: Any) -> Group:
    return Group(title, fields_of(form("bearing")[title], _SHOWN, _WAYS), **more)


GEOMETRY = _group("Bearing")
OPERATION = _group("Operation")
OIL = oil(form("bearing")["Oil"])
FILM = _group("Films")
CLEARANCE = _group("Clearance", opened=False)
MOTOR = _group(
    "Motor",
    table="motor",
    start={
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "20 pF",
        "rotor_frame_capacitance": "1 nF",
    },
    note=f"{_ASSUMED} Without a motor no shaft voltage is computed.",
)
BREAKDOWN = _group(
    "Breakdown",
    table="discharge",
    start={"dielectric_strength": "15 V/um"},
    note=f"{_ASSUMED} 15 V/µm is a rule of thumb for the films of bearings.",
)
COATING = _group(
    "Insulating coating",
    table="bearing.coating",
    start={"base": "schaeffler-j20aa", "relative_permittivity": 9.0},
    note=f"{_ASSUMED} No maker states a permittivity.",
)
SUMMITS = _group(
    "Summits of the roughness",
    table="bearing.summits",
    start={"density": "2000 1/mm^2", "radius": "50 um"},
    note=f"{_ASSUMED} ehlectric surface prints those of a measured surface.",
)
REPORT = _group("Title", opened=False)

BEARING_GROUPS = (GEOMETRY, OPERATION, OIL, FILM, CLEARANCE, MOTOR, BREAKDOWN, COATING, SUMMITS, REPORT)
