"""Own values of a form: what a data sheet leaves to assumptions, and values that come back."""

import tomllib

import pytest

from ehlectric.app.form_fields import BEARING_GROUPS, GEAR_GROUPS
from ehlectric.app.form_fields.contact_fields import groups_of
from ehlectric.app.form_fields.field_defaults import default_of, field_at
from ehlectric.app.form_fields.field_rules import Memory, changed
from ehlectric.app.form_fields.oil_fields import EXPANSION, assumed, oil
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.drive_case import case_of_dict
from ehlectric.quantities.units import to_si
from ehlectric.runs.example_files import example_text
from tests.helpers.each import each

EXAMPLE = Inputs(tomllib.loads(example_text("bearing_6208")))
ALPHA, EXPONENT = "lubricant.pressure_viscosity_coefficient", "lubricant.roelands_z"
PERMITTIVITY, BASE_OIL = "lubricant.relative_permittivity", "lubricant.temperature.base_oil"
FIELDS = {field.key: field for group in BEARING_GROUPS for field in group.fields}


def lubricant(inputs):
    return case_of_dict(inputs.table, written=True).lubricant


def test_a_data_sheet_has_fields_of_permittivity_and_pressure_viscosity():
    for key in (PERMITTIVITY, ALPHA):
        assert FIELDS[key].shown(EXAMPLE)
        assert not FIELDS[key].shown(changed(EXAMPLE, {"lubricant.base": "fva-3"}))
        for geometry in ("line", "point"):
            fields = [field for group in groups_of(geometry) for field in group.fields]
            (field,) = [field for field in fields if field.key == key]
            assert field.shown(EXAMPLE)


def test_the_assumed_values_are_those_of_the_case():
    oil = lubricant(EXAMPLE)
    told = assumed(EXAMPLE)
    assert f"relative permittivity {oil.relative_permittivity} of 'paper'" in told
    assert f"Roelands' z {oil.roelands_z} of 'paper'" in told
    assert f"({oil.density_law})" in told
    assert to_si(EXPANSION, "1/K") == oil.temperature.expansion
    assert EXPANSION in told


def test_given_values_are_not_told_as_assumed():
    given = EXAMPLE.changed({PERMITTIVITY: 2.1, ALPHA: "15 1/GPa", EXPONENT: 0.6})
    assert "permittivity" not in assumed(given)
    assert "Roelands" not in assumed(given)
    assert assumed(changed(EXAMPLE, {"lubricant.base": "fva-3"})) == ""


@each(
    "changes, lacks, told",
    [
        ({}, {"pressure_viscosity_coefficient"}, "which with the viscosity gives the pressure-viscosity"),
        ({ALPHA: "15 1/GPa"}, set(), "Roelands' z 0.67 of 'paper'"),
        ({EXPONENT: 0.6}, {"pressure_viscosity_coefficient"}, "by Roelands' relation from z"),
        ({BASE_OIL: "pao"}, {"pressure_viscosity_coefficient", "roelands_z"}, "as estimated for pao"),
        ({BASE_OIL: "pao", ALPHA: "15 1/GPa"}, {"roelands_z"}, "from the coefficient and the viscosity"),
    ],
)
def test_the_rise_with_pressure_is_told_as_the_case_resolves_it(changes, lacks, told):
    """Keys that the resolved table lacks follow from others; ``lubricant.at`` computes them."""
    inputs = EXAMPLE.changed(changes)
    oil = lubricant(inputs)
    names = ("pressure_viscosity_coefficient", "roelands_z")
    assert {name for name in names if oil.parameter(name) is None} == lacks
    assert told in assumed(inputs)
    for name in lacks:
        assert default_of(inputs, f"lubricant.{name}") is None
    oil.at(343.15)


def group(title):
    return next(one for one in BEARING_GROUPS if one.title == title)


def test_a_group_that_is_switched_on_again_has_its_last_values():
    memory = Memory(BEARING_GROUPS)
    motor = {"common_mode_voltage": "123 V", "winding_rotor_capacitance": "7 pF"}
    typed = EXAMPLE.changed({"motor": motor})
    memory.note(typed)
    memory.note(typed.changed({"motor": None}))
    assert memory.table(group("Motor"), EXAMPLE) == motor
    assert memory.table(group("Insulating coating"), EXAMPLE) == dict(group("Insulating coating").start)


def test_an_own_oil_comes_back_after_one_of_the_library():
    memory = Memory(BEARING_GROUPS)
    typed = EXAMPLE.changed({PERMITTIVITY: 2.2, "lubricant.temperature.density_15": "901 kg/m^3"})
    memory.note(typed)
    other = changed(typed, {"lubricant.base": "fva-3"})
    memory.note(other)
    back = changed(other, memory.custom(FIELDS["lubricant.base"], other))
    assert back == typed


@pytest.mark.parametrize("base", ["6306", "nu-208", "7208-b"])
def test_an_own_bearing_comes_back_after_one_of_the_library(base):
    memory = Memory(BEARING_GROUPS)
    field = FIELDS["bearing.base"]
    own = changed(EXAMPLE, memory.custom(field, EXAMPLE))
    typed = own.changed({"bearing.elements": 8, "bearing.pitch_diameter": "61 mm"})
    memory.note(typed)
    other = changed(typed, {"bearing.base": base})
    memory.note(other)
    back = changed(other, memory.custom(field, other))
    assert case_of_dict(back.table, written=True).bearing.elements == 8
    names = (*("elements", "pitch_diameter", "kind", "inner_groove", "bore"),)
    assert {name: back.value(f"bearing.{name}") for name in names} == {
        name: typed.value(f"bearing.{name}") for name in names
    }
    assert back.value("bearing.base") is None


def test_a_way_comes_back_with_its_last_values():
    memory = Memory(BEARING_GROUPS)
    field = next(field for field in oil("bearing").fields if field.key.endswith("way_40"))
    grade, viscosity = 0, 3
    typed = EXAMPLE.changed({"lubricant.temperature.kinematic_viscosity_40": "52 mm^2/s"})
    memory.note(typed)
    other = changed(typed, memory.alternative(field, grade, typed))
    assert field.alternative(other) == grade
    memory.note(other)
    assert changed(other, memory.alternative(field, viscosity, other)) == typed


def test_a_composite_roughness_of_flanks_begins_with_the_present_roughness():
    """By hand: sqrt(0.3^2 + 0.4^2) um times 1.1; on the page of a pair, and in a mesh of an axle."""
    memory = Memory(GEAR_GROUPS)
    field = next(
        field for group in GEAR_GROUPS for field in group.fields if field.key.endswith("way_roughness")
    )
    pair = {"gear": {"flank_ra": ["0.3 um", "0.4 um"], "rq_over_ra": 1.1}}
    after = changed(Inputs(pair), memory.alternative(field, 1, Inputs(pair)))
    assert after.value("gear.composite_rq") == "0.55 um"
    assert after.value("gear.flank_ra") is None
    in_axle = field_at(field, "mesh.1.pair")
    changes = memory.alternative(in_axle, 1, Inputs({"mesh": [{"pair": pair}]}))
    assert changes["mesh.1.pair.gear.composite_rq"] == "0.55 um"


@each("field", [field for field in FIELDS.values() if field.alternatives], ids=lambda one: one.key)
def test_every_way_is_taken_whatever_was_before(field):
    memory, inputs = Memory(BEARING_GROUPS), EXAMPLE
    for place, way in enumerate(field.alternatives):
        memory.note(inputs)
        inputs = changed(inputs, memory.alternative(field, place, inputs))
        assert way.taken(inputs)
    for place, way in reversed(list(enumerate(field.alternatives))):
        memory.note(inputs)
        inputs = changed(inputs, memory.alternative(field, place, inputs))
        assert way.taken(inputs)
        case_of_dict(inputs.table, written=True)
