"""Inputs that exclude each other: the form's rules against those of the cases."""

import tomllib

import pytest

from ehlectric.app.catalogue import choices
from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import form_data, kind_of
from ehlectric.app.form_fields.field_rules import Memory, changed, custom_values
from ehlectric.app.form_fields.gear_fields import gears_of, of_gears
from ehlectric.app.page_inputs import Inputs, example_inputs
from ehlectric.cases.drive_case import case_of_dict
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.gear.solution import OperatingPair
from ehlectric.quantities.alternatives import ONLY
from ehlectric.runs.example_files import example_text
from tests.helpers.each import each

EXAMPLE = Inputs(tomllib.loads(example_text("bearing_6208")))


def case(inputs):
    return case_of_dict(inputs.table, written=True)


@each(
    "changes",
    [
        {"bearing.base": "6306"},
        {"bearing.clearance_class": "C3"},
        {"bearing.radial_load": "2 kN"},
        {"lubricant.base": "fva-3"},
        {"lubricant.temperature.iso_vg": 68},
        {"lubricant.temperature.viscosity_index": 100.0},
        {"discharge.weibull": {"scale": "20 V/um", "shape": 5.0, "reference_area": "1 mm^2"}},
        {"bearing.coating": {"base": "schaeffler-j20aa", "relative_permittivity": 9.0}},
    ],
)
def test_changes_as_a_case_replaces_them(changes):
    """Expected: ``BearingCase.replace``, which the library's users call, for values that the user has set."""
    given = frozenset(EXAMPLE.flat())
    assert case(changed(EXAMPLE, changes, given)) == case(EXAMPLE).replace(changes)


CLEARANCE, CLASS, RQ = "bearing.radial_clearance", "bearing.clearance_class", "bearing.composite_rq"


@each(
    ("base", "clearance_class"),
    [
        ("6208-C3", "C3"),
        ("6208-2RS1/C3", "C3"),
        ("6314-C3", "C3"),
        ("6208-2Z/C3WT", "C3"),
        ("6208ZZCM", "CM"),
        ("skf 6208 C4", "C4"),
        ("6306", "CN"),
        ("6208 ZZ", "CN"),
        ("nu-210", "CN"),
    ],
)
def test_a_designation_brings_its_class_as_in_a_file(base, clearance_class):
    found = changed(EXAMPLE, {"bearing.base": base})
    assert (found.value(CLASS), found.value(CLEARANCE)) == (clearance_class, None)
    file = EXAMPLE.changed(
        {"bearing.base": base, CLEARANCE: None, "bearing.profile": found.value("bearing.profile")}
    )
    file = file.changed({RQ: found.value(RQ), "bearing.axial_load": found.value("bearing.axial_load")})
    assert case(file).bearing == case(found).bearing


COATED = EXAMPLE.changed(
    {"bearing.coating": {"ring": "outer", "thickness": "100 um", "relative_permittivity": 9.0}}
)
OF_DRIVE, OF_AXLE = (Inputs(tomllib.loads(example_text(name))) for name in ("drive", "e_axle"))


@each(
    "inputs, key, name",
    [
        (EXAMPLE, "bearing.base", "62088"),
        (EXAMPLE, "bearing.base", "nu 9999"),
        (changed(EXAMPLE, {"bearing.base": "6314-C3"}), "bearing.base", "6314-C3X9"),
        (EXAMPLE, "lubricant.base", "fva-33"),
        (COATED, "bearing.coating.base", "schaeffler-j99"),
        (OF_DRIVE, "drive_end.bearing.base", "62088"),
        (OF_AXLE, "bearing.1.base", "62088"),
    ],
)
def test_a_refused_name_changes_nothing_else(inputs, key, name):
    found = changed(inputs, {key: name})
    assert found.value(key) == name
    assert found.changed({key: inputs.value(key)}).table == inputs.table


@each("base", ["625 ZZ", "6244"])
def test_a_bore_without_classes_gets_a_clearance_to_be_set(base):
    found = changed(EXAMPLE, {"bearing.base": base})
    assert (found.value(CLASS), found.value(CLEARANCE)) == (None, "10 um")
    assert case(found).bearing.radial_clearance == pytest.approx(10e-6)


@each(
    ("base", "words"),
    [("6208 E", "reinforced set"), ("22210 E", "spherical roller"), ("7208", "contact angle")],
)
def test_a_designation_that_is_refused_says_why(base, words):
    with pytest.raises(InputError, match=words):
        case(changed(EXAMPLE, {"bearing.base": base}))


def test_the_class_of_a_designation_goes_with_it():
    """Unless the user has set the class, the next designation without a suffix stands for the normal one."""
    found = changed(EXAMPLE, {"bearing.base": "6208-C3"})
    assert changed(found, {"bearing.base": "6208"}).value(CLASS) == "CN"
    assert changed(found, {"bearing.base": "6306-C4"}).value(CLASS) == "C4"
    assert changed(found, {"bearing.base": "6306"}, frozenset({CLASS})).value(CLASS) == "C3"
    own = changed(EXAMPLE, {CLEARANCE: "12 um"})
    assert changed(own, {"bearing.base": "6306"}).value(CLEARANCE) == "12 um"
    assert changed(own, {"bearing.base": "6306-C3"}).value(CLASS) == "C3"


# A bearing of each kind, and the composite Rq with which a file of the kind begins.
OF_KINDS = {
    "6208": "0.03 um", "7208-b": "0.03 um", "QJ 208": "0.05 um", "51208": "0.05 um", "nu-208": "0.1 um",
    "HK 2020": "0.1 um", "32008 X": "0.1 um", "AXK 2542": "0.1 um",
}  # fmt: skip


@each(("base", "rq"), list(OF_KINDS.items()))
def test_first_values_follow_the_kind_until_the_user_has_set_them(base, rq):
    for before in OF_KINDS:
        inputs = changed(EXAMPLE, {"bearing.base": before})
        found = changed(inputs, {"bearing.base": base})
        assert found.value(RQ) == rq
        # What depends on the way is the load of the example, which is no value of a kind, and the clearance.
        of_kind = {f"bearing.{key}" for key in form_data("kinds")[kind_of(found)]} - {"bearing.axial_load"}
        expected = changed(EXAMPLE, {"bearing.base": base})
        for key in of_kind - {CLEARANCE}:
            assert found.value(key) == expected.value(key), key
        kept = changed(inputs.changed({RQ: "0.03 um"}), {"bearing.base": base}, frozenset({RQ}))
        assert kept.value(RQ) == "0.03 um"
        assert changed(inputs.changed({RQ: "0.07 um"}), {"bearing.base": base}).value(RQ) == "0.07 um"


def test_the_examples_of_the_kinds_have_the_first_values():
    """The composite Rq of each example is the first value of its kind in the app."""
    for name in ("6208", "four_point", "thrust", "needle", "tapered_pair"):
        table = tomllib.loads(example_text(f"bearing_{name}"))["bearing"]
        kind = kind_of(Inputs({"bearing": table}))
        assert form_data("kinds")[kind]["composite_rq"] == table["composite_rq"], name


def test_first_values_of_a_bearing_in_a_drive_follow_its_kind():
    drive = Inputs(
        {"drive_end": dict(EXAMPLE.table), "non_drive_end": {"bearing": {RQ.partition(".")[2]: "0.03 um"}}}
    )
    found = changed(drive, {"drive_end.bearing.base": "nu-208"})
    assert found.value(f"drive_end.{RQ}") == "0.1 um"
    kept = changed(drive, {"drive_end.bearing.base": "nu-208"}, frozenset({f"drive_end.{RQ}"}))
    assert kept.value(f"drive_end.{RQ}") == "0.03 um"


def test_what_the_user_sets_is_remembered():
    memory = Memory([])
    memory.take({RQ: "0.03 um", "bearing.fits": {"shaft_interference": "10 um"}})
    assert memory.given == {RQ, "bearing.fits.shaft_interference"}
    memory.take({RQ: None})
    assert memory.given == {"bearing.fits.shaft_interference"}


def test_a_viscosity_takes_the_place_of_the_data_sheet():
    found = changed(EXAMPLE, {"lubricant.viscosity": "20 mPa s"})
    assert found.value("lubricant") == {"base": "paper", "viscosity": "20 mPa s"}
    case(found)


@each("choice", choices()["bearing.base"], ids=lambda choice: choice.name)
def test_every_bearing_can_be_picked_after_every_kind(choice):
    for before in ("6208", "7208-b", "nu-208"):
        inputs = changed(changed(EXAMPLE, {"bearing.base": before}), {"bearing.base": choice.name})
        assert case(inputs).bearing.base == choice.name


@pytest.mark.parametrize("base", ["6208", "7208-b", "nu-208"])
def test_own_geometry_begins_with_that_of_the_base(base):
    inputs = changed(EXAMPLE, {"bearing.base": base})
    own = changed(inputs, custom_values(inputs, "bearing.base"))
    assert own.value("bearing.base") is None
    same = {"bearing": {**case(inputs).to_dict()["bearing"], "base": None}}
    assert case(own).bearing == case(inputs).replace(same).bearing
    back = changed(own, {"bearing.base": base})
    assert case(back).bearing == case(inputs).bearing


@pytest.mark.parametrize("kind", ["deep-groove ball", "angular-contact ball", "cylindrical roller"])
def test_own_geometry_of_another_kind(kind):
    own = changed(EXAMPLE, custom_values(EXAMPLE, "bearing.base"))
    assert case(changed(own, {"bearing.kind": kind})).bearing.kind == kind


@each("name", [choice.name for choice in choices()["lubricant.base"]])
def test_oils_and_data_sheets_take_turns(name):
    inputs = changed(EXAMPLE, {"lubricant.base": name})
    assert inputs.value("lubricant") == {"base": name}
    sheet = changed(inputs, custom_values(inputs, "lubricant.base"))
    assert case(sheet).lubricant == case(EXAMPLE).lubricant


def test_heat_needs_a_thermal_conductivity():
    heated = changed(EXAMPLE, {"bearing.film_factor": "inlet-shear"})
    assert heated.value("lubricant.temperature.thermal_conductivity") == "0.137 W/m/K"
    case(heated)


def test_groups_switched_on_make_a_case():
    paired = changed(EXAMPLE, {"bearing.base": "7208-b"})
    for group in BEARING_GROUPS:
        if group.table:
            start = EXAMPLE if group.when(EXAMPLE) else paired
            assert group.when(start)
            case(start.changed({group.table: dict(group.start)}))


@each(
    "way",
    [way for group in BEARING_GROUPS for field in group.fields for way in field.alternatives],
    ids=lambda way: way.label,
)
def test_ways_begin_with_values_that_make_a_case(way):
    found = changed(EXAMPLE, way.changes)
    case(found)
    assert way.taken(found)


def test_own_coating_begins_with_that_of_the_library():
    start = changed(EXAMPLE, {"bearing.coating": {"base": "schaeffler-j20aa", "relative_permittivity": 9.0}})
    own = changed(start, custom_values(start, "bearing.coating.base"))
    assert case(own).bearing.coating.thickness == case(start).bearing.coating.thickness
    assert (
        case(changed(own, {"bearing.coating.strength": "10 V/um"})).bearing.coating.breakdown_voltage is None
    )


def test_another_geometry_of_a_contact_drops_keys_of_this_one():
    line = Inputs(tomllib.loads(example_text("line_contact")))
    point = changed(line, {"contact.geometry": "point"})
    flat = point.flat()
    assert not any(f"contact.{key}" in flat for key in ONLY["line"])
    assert "grid.error" in line.flat()
    assert not {"grid.nodes", "grid.error"} & set(flat)


@each(
    "start, change, dropped",
    [
        ("hot_contact", {"inlet.oil_layer": "0.2 um"}, None),
        ("starved_contact", {"film.rheology": "newtonian"}, None),
        ("starved_contact", {"meter.fill": "oil"}, "inlet"),
        ("moving_roughness", {"inlet.oil_layer": "0.2 um"}, None),
        ("moving_roughness", {"inlet.film_ratio": 0.5}, "motion"),
    ],
)
def test_a_supply_of_oil_takes_the_place_of_what_cases_refuse_beside_it(start, change, dropped):
    inputs = Inputs(tomllib.loads(example_text(start)))
    found = changed(inputs, change)
    case(found)
    assert [key for key in ("film", "inlet", "motion") if inputs.value(key) and not found.value(key)] == (
        [dropped] if dropped else []
    )


def test_nodes_and_error_of_a_grid_take_the_place_of_one_another():
    line = Inputs(tomllib.loads(example_text("line_contact")))
    given = changed(line, {"grid.nodes": 801})
    assert "grid.error" not in given.flat()
    assert "grid.nodes" not in changed(given, {"grid.error": "1 %"}).flat()
    assert "grid.error" not in changed(line, {"motion": {"passes": 1}}).flat()


def test_wrong_texts_stay_for_the_checks():
    wrong = changed(EXAMPLE, {"bearing.base": "no such bearing"})
    with pytest.raises(InputError, match=r"bearing\.base"):
        case(wrong)


# A spur pair as its drawing is typed, from top to bottom.
SPUR_DRAWING = {
    "gear.normal_module": "2.5 mm",
    "gear.teeth.1": 20,
    "gear.teeth.2": 61,
    "gear.normal_pressure_angle": "25 deg",
    "gear.helix_angle": None,
    "gear.face_width": "18 mm",
    "gear.profile_shift.1": 0.3,
    "gear.profile_shift.2": -0.1,
    "gear.tip_diameter.1": "56.4 mm",
    "gear.tip_diameter.2": "156.9 mm",
}


@pytest.mark.parametrize("example", ["gear_pair", "gear_spur"])
def test_a_typed_drawing_of_gears_can_run_after_each_number(example):
    """But after a value for one gear only, which the page refuses at the empty field of the other gear."""
    inputs, given = example_inputs(example), frozenset()
    for key, value in SPUR_DRAWING.items():
        inputs = changed(inputs, {key: value}, given)
        given |= {key}
        if key not in ("gear.profile_shift.1", "gear.tip_diameter.1"):
            OperatingPair.of(GearCase.from_dict(inputs.table))
    assert gears_of(inputs) == "spur"
    assert inputs.value("gear.profile_shift") == [0.3, -0.1]


def test_values_that_the_user_has_set_stay_in_a_new_drawing():
    inputs = changed(example_inputs("gear_pair"), {"gear.profile_shift.1": 0.25})
    after = changed(inputs, {"gear.teeth.1": 24}, frozenset({"gear.profile_shift.1", "gear.centre_distance"}))
    assert after.value("gear.profile_shift") == [0.25]
    assert after.value("gear.centre_distance") == "87 mm"
    assert after.value("gear.tip_diameter") is None
    # What is no number yet removes nothing, and the present number again changes nothing.
    assert changed(inputs, {"gear.normal_module": "1.75 mm"}) == inputs
    assert changed(inputs, {"gear.teeth.1": "many"}).value("gear.centre_distance") == "87 mm"


def test_the_other_kind_of_gears_keeps_oil_strength_and_operating_point():
    helical = changed(example_inputs("gear_pair"), {"discharge.dielectric_strength": "20 V/um"})
    spur = of_gears("spur", helical)
    assert gears_of(spur) == "spur"
    assert spur.value("gear.teeth") == [16, 24]
    assert spur.value("title") == example_inputs("gear_spur").value("title")
    # A new drawing is not the example.
    assert changed(spur, {"gear.teeth.1": 23}).value("title") is None
    assert spur.value("gear.contact.voltage") == "5 V"
    assert spur.value("lubricant") == helical.value("lubricant")
    assert GearCase.from_dict(spur.table).gear.helix_angle == 0.0
    for key in ("discharge", "gear.operation"):
        assert spur.value(key) == helical.value(key)
    relieved = changed(spur, {"gear.operation.load_sharing": "tip-relief"})
    assert of_gears("helical", relieved).value("gear.operation.load_sharing") is None
