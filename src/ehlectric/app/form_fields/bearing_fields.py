"""Fields of the page of a bearing, with the supply of oil to its contacts."""

from __future__ import annotations

from typing import Any

from ehlectric.app.form_fields.field import (
    ANGULAR,
    ROLLERS,
    Group,
    Way,
    both,
    equal,
    fields_of,
    given,
    has_balls,
    has_clearance,
    kind_of,
    list_of_ways,
    never,
    unequal,
    way_by,
)
from ehlectric.app.form_fields.oil_fields import oil
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import FILM_FACTORS
from ehlectric.quantities.inputs import form

ASSUMED = "The first values are assumptions: replace them with your own."
_ISOTHERMAL = "Isothermal, fully flooded"


_own = equal("bearing.base", None)


def _rollers(inputs: Inputs) -> bool:
    return kind_of(inputs) == ROLLERS


def _angular(inputs: Inputs) -> bool:
    return kind_of(inputs) == ANGULAR


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


# Ways of supply in words, by the value of ``bearing.supply``.
_SUPPLIES = {
    "flooded": "Fully flooded",
    "oil-bath": "Low oil bath",
    "oil-jet": "Oil jet",
    "grease": "Grease",
    "oil-air": "Oil and air",
}


# Lists of alternatives, by the key before which they stand.
_WAYS = {
    "bearing.radial_clearance": list_of_ways(
        "bearing.clearance",
        "Clearance given as",
        Way("Class and fits", _FITS, "bearing.fits"),
        Way(
            "Class before mounting",
            {"bearing.clearance_class": "CN", "bearing.fits": None},
            "bearing.clearance_class",
        ),
        Way("Clearance in operation", {"bearing.radial_clearance": "10 um"}),
        when=has_clearance,
    ),
    "bearing.film_factor": list_of_ways(
        "bearing.film_way",
        "Heat and starvation",
        way_by("bearing.film_factor", _ISOTHERMAL, "none", exactly=True),
        way_by("bearing.film_factor", "Heat by shear in the inlet", "inlet-shear", exactly=True),
        way_by("bearing.film_factor", "Heat in the film, solved with the contacts", "solved", exactly=True),
        way_by("bearing.film_factor", "A factor of your own", 0.7),
        Way(_ISOTHERMAL, listed=False),
    ),
    "bearing.supply": list_of_ways(
        "bearing.supply_way",
        "Oil supplied by",
        *(way_by("bearing.supply", words, name, exactly=True) for name, words in _SUPPLIES.items()),
        way_by("bearing.supply", "A share of the flooded film", 0.6),
        Way("Fully flooded", listed=False),
    ),
    "bearing.fill": list_of_ways(
        "bearing.fill_way",
        "Around the films",
        way_by("bearing.fill", "Oil", "oil", exactly=True),
        way_by("bearing.fill", "Air", "air", exactly=True),
        way_by("bearing.fill", "Partly oil", "30 %"),
        Way("Oil", listed=False),
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
    **{f"bearing.{name}": {"when": both(_own, has_balls)} for name in _OF_BALLS},
    "bearing.roller_length": {"when": both(_own, _rollers)},
    "bearing.profile": {"when": _rollers},
    "bearing.contact_angle": {"when": _angular},
    "bearing.element_capacitance": {"when": equal("bearing.element_material", "silicon-nitride")},
    "bearing.axial_load": {"when": has_balls},
    "bearing.film_factor": {"when": unequal("bearing.film_factor", None, *FILM_FACTORS), "strict": True},
    "bearing.supply": {"when": unequal("bearing.supply", None, *_SUPPLIES), "strict": True},
    "bearing.fill": {"when": unequal("bearing.fill", None, "oil", "air"), "strict": True},
    "bearing.radial_clearance": {"when": never},
    "bearing.clearance_class": {"when": never},
    **{
        key: {"when": given("bearing.fits")}
        for key in form("bearing")["Clearance"]
        if key.startswith("bearing.fits.")
    },
    "bearing.fits.unmounted_clearance": {"when": never},
    "bearing.coating.base": {"own": "Own coating"},
    "bearing.coating.ring": {"when": equal("bearing.coating.base", None)},
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
    note=f"{ASSUMED} Without a motor no shaft voltage is computed.",
)
BREAKDOWN = _group(
    "Breakdown",
    table="discharge",
    start={"dielectric_strength": "15 V/um"},
    note=f"{ASSUMED} 15 V/µm is a rule of thumb for the films of bearings.",
)
COATING = _group(
    "Insulating coating",
    table="bearing.coating",
    start={"base": "schaeffler-j20aa", "relative_permittivity": 9.0},
    note=f"{ASSUMED} No maker states a permittivity.",
)
SUMMITS = _group(
    "Summits of the roughness",
    table="bearing.summits",
    start={"density": "2000 1/mm^2", "radius": "50 um"},
    note=f"{ASSUMED} ehlectric surface prints those of a measured surface.",
)
REPORT = _group("Title", opened=False)

BEARING_GROUPS = (GEOMETRY, OPERATION, OIL, FILM, CLEARANCE, MOTOR, BREAKDOWN, COATING, SUMMITS, REPORT)
