"""Fields of a drive: their keys, units and sliders, and the rules by which new inputs displace others."""

import pytest

from ehlectric.app.catalogue import choices
from ehlectric.app.compute.bearing_answers import bearing_case, solved_quickly
from ehlectric.app.form_fields.drive_fields import (
    DRIVE_GROUPS,
    HALF,
    MOST_FORCES,
    OTHER,
    PAGE_GROUPS,
    PRESETS,
    changes_of,
    remedies_of,
    remedy_at_bearing,
    with_remedy,
    with_rotor_force,
    without_remedy,
)
from ehlectric.app.form_fields.field_defaults import bearing_at, default_of, end_and_key
from ehlectric.app.form_fields.field_rules import Memory, changed, custom_values, is_custom
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import BEARING, DRIVE, drive_with
from ehlectric.bearing.bearing_discharges import shaft_voltage
from ehlectric.cases.amounts import Amount
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.input_keys import describe, input_field
from ehlectric.cases.table import number_of
from ehlectric.drive.preparation import prepare
from ehlectric.drive.quick_estimate import quick_drive
from ehlectric.drive.summary import checked_summary
from ehlectric.errors import InputError
from ehlectric.quantities import units
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.units import in_unit, si_unit
from tests.helpers.each import each

FIELDS = {field.key: field for group in DRIVE_GROUPS for field in group.fields}
KEYS = [key for key, field in FIELDS.items() if field.kind != "alternatives" and key != "title"]
NUMBERS = [key for key in KEYS if FIELDS[key].kind in ("number", "count")]


def drive(**changes):
    return DriveCase.from_written(DRIVE.changed(changes).table)


@each("key", KEYS)
def test_every_key_is_one_of_a_drive_file_and_is_described(key):
    input_field(key)
    assert describe(key)


@each("key", NUMBERS)
def test_units_and_sliders_are_those_of_the_key(key):
    field, kind = FIELDS[key], number_of(input_field(key))
    if isinstance(kind, Amount) and field.unit not in ("", "%", "degC"):
        # Numbers of the form have twelve digits.
        expected = units.factor(field.unit, kind.unit)
        assert in_unit(f"1 {field.unit}", si_unit(field.unit)) == pytest.approx(expected, rel=5e-12)
    for place in (0.0, 0.37, 1.0):
        written = field.from_slider(place)
        if isinstance(kind, Amount):
            kind.parse(written, written=True)
        elif kind is not None:
            kind.parse(written)


def test_titles_of_groups_differ():
    titles = [group.title for group in DRIVE_GROUPS]
    assert len(set(titles)) == len(titles)


def test_lists_of_the_library_are_those_of_a_bearing():
    listed = [key for key in KEYS if FIELDS[key].kind == "choice" and not FIELDS[key].choices]
    assert listed
    assert all(end_and_key(key)[1] in choices() for key in listed)


def test_the_start_is_the_example_and_has_fields_for_all_of_it():
    assert DRIVE.value("drive.contacts") == "atlas"
    assert set(DRIVE.flat()) - {"remedies"} <= set(FIELDS)
    assert drive().title == "Drive of a pump"


@each("key", [key for key, field in FIELDS.items() if field.kind == "alternatives"])
def test_every_way_of_the_example_makes_a_case(key):
    for place, way in enumerate(FIELDS[key].alternatives):
        if not way.listed:
            continue
        start = DRIVE if not key.startswith(ENDS[1]) else DRIVE.changed({ENDS[1]: DRIVE.value(ENDS[0])})
        found = changed(start, Memory(DRIVE_GROUPS).alternative(FIELDS[key], place, start))
        DriveCase.from_written(found.table)
        assert FIELDS[key].alternative(found) == place or not way.key


def test_six_step_modulation_takes_the_keys_of_the_carrier_away_and_back():
    six = changed(DRIVE, {"source.modulation": "six-step"})
    DriveCase.from_written(six.changed({"remedies": None}).table)
    assert six.value("source.switching_frequency") is None
    back = changed(six, {"source.modulation": "sinusoidal"})
    DriveCase.from_written(back.table)


def test_a_measured_waveform_displaces_the_described_source_and_comes_back():
    file = changed(DRIVE, {"source.file": "surfaces/surface-1.csv"})
    assert dict(file.value("source")) == {"file": "surfaces/surface-1.csv"}
    way = FIELDS["source.way"]
    assert way.alternative(file) == 0
    back = changed(file, Memory(DRIVE_GROUPS).alternative(way, 1, file))
    assert back.value("source.file") is None
    DriveCase.from_written(back.table)


def test_a_bearing_of_a_drive_follows_the_rules_of_a_bearing():
    """The same change of the bearing alone is the reference."""
    for changes in (
        {"bearing.base": "nu-208"},
        {"bearing.clearance_class": "C3"},
        {"lubricant.base": "fva-3"},
        {"bearing.film_factor": "inlet-shear"},
        {"bearing.coating": {"base": "schaeffler-j20aa", "relative_permittivity": 9.0}},
    ):
        found = changed(DRIVE, {f"drive_end.{key}": value for key, value in changes.items()})
        assert bearing_at(found, "drive_end") == changed(bearing_at(DRIVE, "drive_end"), changes)
        assert found.changed({"drive_end": None}) == DRIVE.changed({"drive_end": None})


def test_own_values_and_defaults_of_a_bearing_of_a_drive():
    own = custom_values(DRIVE, "drive_end.bearing.base")
    assert own["drive_end.bearing.bore"] == "40 mm"
    assert default_of(DRIVE, "drive_end.bearing.bore") == "40 mm"
    assert not is_custom(DRIVE, "drive_end.bearing.base")
    found = changed(DRIVE, own)
    assert is_custom(found, "drive_end.bearing.base")
    DriveCase.from_written(found.table)


def test_the_other_end_begins_as_the_drive_end_and_remembers():
    memory = Memory(DRIVE_GROUPS)
    other = memory.table(OTHER, DRIVE)
    assert other == DRIVE.value("drive_end")
    typed = DRIVE.changed({"non_drive_end": other, "non_drive_end.bearing.radial_load": "500 N"})
    memory.note(typed)
    assert memory.table(OTHER, DRIVE)["bearing"]["radial_load"] == "500 N"
    assert OTHER.tells(DRIVE)
    assert not OTHER.tells(typed)


@each("title", PRESETS)
def test_every_usual_remedy_is_a_case_and_can_be_taken_back(title):
    start = DRIVE.changed({"remedies": None})
    on = start.changed({"remedies": with_remedy(start, title, changes_of(start, title))})
    assert list(remedies_of(on)) == [title]
    (variant,) = DriveCase.from_written(on.table).variants()
    assert variant != DriveCase.from_written(on.table)
    assert without_remedy(on, title) == []


def test_usual_remedies_of_the_example_are_those_of_the_list():
    for title, changes in remedies_of(DRIVE).items():
        assert changes == changes_of(DRIVE, title)


def test_half_of_the_switching_frequency_follows_it():
    found = changed(DRIVE, {"source.switching_frequency": "16 kHz"})
    assert remedies_of(found)[HALF] == {"source.switching_frequency": "8 kHz"}
    own = DRIVE.changed({"remedies": [{"title": "slow", "changes": {"source.switching_frequency": "3 kHz"}}]})
    kept = changed(own, {"source.switching_frequency": "16 kHz"})
    assert remedies_of(kept)["slow"] == {"source.switching_frequency": "3 kHz"}


def test_a_bearing_in_its_drive():
    motor = {"winding_rotor_capacitance": "7 pF", "rotor_frame_capacitance": "900 pF", "rise_time": "1 us"}
    bearing = BEARING.changed(
        {"bearing.inner_speed": "1500 rpm", "motor": {"common_mode_voltage": "300 V", **motor}}
    )
    case = DriveCase.from_written(drive_with(bearing).table)
    assert case.drive_end.bearing.radial_load == 1800.0
    assert case.source.dc_link == 600.0
    assert case.circuit.winding_rotor_capacitance == pytest.approx(7e-12)
    assert case.source.rise_time == pytest.approx(1e-6)
    assert case.bearings[0].bearing.inner_speed == pytest.approx(157.0796, rel=1e-6)
    # A bearing without a strength gets the assumed one, which a drive needs.
    bare = DriveCase.from_written(drive_with(BEARING.changed({"discharge": None})).table)
    assert bare.drive_end.discharge.dielectric_strength == pytest.approx(15e6)


@each("voltage, link", [("400 V", "800 V"), ("0.4 kV", "0.8 kV"), ("287.65 V", "575.3 V"), (400, "800 V")])
def test_the_common_mode_voltage_is_carried_over_exactly(voltage, link):
    bearing = BEARING.changed({"motor.common_mode_voltage": voltage})
    assert drive_with(bearing).value("source.dc_link") == link


def test_the_drive_of_a_bearing_has_its_shaft_voltage():
    """400 V on the page of a bearing are 400 V at the peak of its drive, and the divider is the same.

    That of the drive has the elements at their first position, that of the bearing has their mean.
    """
    bearing = BEARING.changed({"motor.common_mode_voltage": "400 V"})
    case = DriveCase.from_written(drive_with(bearing).table)
    quick, _ = quick_drive(case)
    found = checked_summary(prepare(quick, workers=1))
    own = solved_quickly(bearing_case(bearing.table)).solution
    assert found["source"]["peak"] == pytest.approx(400.0, rel=1e-12)
    voltage = found["drive_end"]["voltage_at_peak"]
    assert voltage == pytest.approx(float(shaft_voltage(own)), rel=1e-2)


@each("voltage", ["300 V +- 10 %", "300 V to 400 V", "much"])
def test_a_common_mode_voltage_that_is_no_single_one_is_refused_in_its_drive(voltage):
    with pytest.raises(InputError) as refused:
        drive_with(BEARING.changed({"motor.common_mode_voltage": voltage}))
    assert refused.value.key == "motor.common_mode_voltage"


@each("name, table, offered", [
    ("Hybrid", {}, True), ("Hybrid", {"bearing.element_material": "silicon-nitride"}, False),
    ("Insulated", {}, True), ("Insulated", {"bearing.coating": {"base": "alumina"}}, False),
    ("Grounding ring", {}, True), ("Grounding ring", {"motor": None}, False),
    ("Other oil", {}, True), ("Other oil", {"motor": None}, True),
])  # fmt: skip
def test_a_bearing_is_offered_what_it_has_not(name, table, offered):
    assert (remedy_at_bearing(BEARING.changed(table), name) is not None) == offered


def test_another_oil_is_another_one():
    assert remedy_at_bearing(BEARING, "Other oil")["title"] == "Oil fva-3"
    thick = BEARING.changed({"lubricant": {"base": "fva-3"}})
    assert remedy_at_bearing(thick, "Other oil")["title"] == "Oil mobil-shc-320"
    assert remedy_at_bearing(thick, "Other oil", "iso-vg-32")["title"] == "Oil iso-vg-32"


def test_an_address_holds_a_drive_with_its_remedies():
    from urllib.parse import parse_qsl

    assert Inputs.of_query(parse_qsl(DRIVE.address())) == DRIVE


def test_a_rotor_takes_loads_out_of_ranges_and_measures():
    """And takes its own measures with it."""
    bearing = {"base": "6208", "radial_load": "2 kN"}
    ranges = {"bearing.radial_load": ["1 kN", "3 kN"], "bearing.composite_rq": ["1 nm", "2 nm"]}
    measures = [
        {"title": key, "changes": {key: "1 kN"}} for key in ("bearings.bearing.radial_load", "drive.speed")
    ]
    given = Inputs({"drive_end": {"bearing": bearing, "ranges": ranges}, "remedies": measures})
    rotor = changed(given, {"rotor": {"mass": "2 kg"}})
    assert rotor.value("drive_end.bearing") == {"base": "6208"}
    assert rotor.value("drive_end.ranges") == {"bearing.composite_rq": ["1 nm", "2 nm"]}
    assert [each["title"] for each in rotor.value("remedies")] == ["drive.speed"]
    measured = rotor.changed({"remedies": [{"title": "c", "changes": {"rotor.mass": "3 kg"}}]})
    without = changed(with_rotor_force(measured), {"rotor": None})
    assert (without.value("force"), without.value("remedies")) == (None, None)
    assert without.value("drive_end.bearing.radial_load") == "1000 N"


def test_a_page_shows_eight_forces():
    inputs = Inputs({"rotor": {"mass": "2 kg"}})
    for _ in range(MOST_FORCES + 1):
        inputs = with_rotor_force(inputs)
    assert len(inputs.value("force")) == MOST_FORCES
    titles = [group.title for group in PAGE_GROUPS if group.when(inputs)]
    assert titles.count(f"Force {MOST_FORCES}") == 1
