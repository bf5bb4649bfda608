"""Answers about measured values: what they contain, and the case with the updated ranges."""

import pytest

import ehlectric
from ehlectric.app.compute.answer_parts import run_case_of
from ehlectric.app.compute.calibration_answers import calibrated, checked
from ehlectric.app.form_fields.measured_fields import measured_fields, with_uncertainty, with_value
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import AXLE, BEARING, DRIVE, GEAR
from ehlectric.calibration.models import model_of
from ehlectric.cases.axle_keys import name_of_quantity
from ehlectric.cases.measurements import CALIBRATED
from ehlectric.errors import InputError
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.units import in_unit
from ehlectric.runtime.progress import silent
from tests.helpers.each import each

START = {"bearing": BEARING, "drive": DRIVE, "gear": GEAR, "axle": AXLE}


def tables(kind, **measured):
    return dict(START[kind].changed({"measured": measured}).table)


@each("kind", START)
def test_a_page_offers_quantities_that_the_model_of_its_kind_computes(kind):
    case = run_case_of(START[kind].table, None)
    offered = measured_fields(kind, START[kind])
    assert set(offered) == set(model_of(case).quantities)
    assert {*map(name_of_quantity, offered)} <= set(CALIBRATED)


@each(
    "name, typed, expected",
    [
        ("capacitance", "250", "250 pF +- 5 %"),
        ("capacitance", "0.25 nF", "0.25 nF +- 5 %"),
        ("outer_ring_temperature", "74", "74 degC +- 1 K"),
        ("conducting_share", "0.1", "0.1 +- 0.02"),
        # 5 % of the value, as the table of the columns has it.
        ("bearing_voltage_ratio", "0.04", "0.04 +- 0.002"),
    ],
)
def test_a_typed_value_has_the_unit_of_its_field_and_the_usual_uncertainty(name, typed, expected):
    field = measured_fields("bearing", Inputs())[name]
    text = with_value(Inputs(), name, field, typed)
    assert text == expected
    assert checked(tables("bearing", **{name: text})) == "1 measured value at 1 operating point."


@each(
    "name, typed, expected",
    [
        ("elements.rotor_1.capacitance", "250", "250 pF +- 5 %"),
        ("elements.mesh_2.conducting_share", "0.1", "0.1 +- 0.02"),
        ("shafts.output.voltage", "10", "10 V +- 3 %"),
    ],
)
def test_a_measured_value_of_an_axle_belongs_to_an_element_or_a_shaft(name, typed, expected):
    field = measured_fields("axle", AXLE)[name]
    text = with_value(AXLE, name, field, typed)
    assert text == expected
    table = dict(AXLE.changed({field.key: text}).table)
    assert checked(table) == "1 measured value at 1 operating point."


def test_names_of_shafts_with_other_letters_make_keys_in_quotes():
    inputs = AXLE.changed({"shaft.1.name": "größe 1"})
    assert measured_fields("axle", inputs)['shafts."größe_1".voltage'].label == "Voltage of the shaft größe 1"


@each(
    "typed, expected",
    [
        ("8 +- 0.3", "8 V +- 0.3 V"),
        ("8 ± 0.3 V", "8 V +- 0.3 V"),
        ("8 V +/- 4 %", "8 V +- 4 %"),
        ("8 kV ± 2", "8 kV +- 2 kV"),
        ("0.8 mV ± 0.1 V", "0.8 mV +- 0.1 V"),
        ("8 +- 4 % V", "8 V +- 4 % V"),
        ("8", "8 V +- 5 mV"),
        ("", None),
    ],
)
def test_a_value_is_typed_with_or_without_its_uncertainty(typed, expected):
    field = measured_fields("bearing", Inputs())["shaft_voltage"]
    present = Inputs({"measured": {"shaft_voltage": "7 V ± 5 mV"}})
    assert with_value(present, "shaft_voltage", field, typed) == expected


@each("written", ["7 V", "7 V +- 4 % V", "7 V +- 2 pF", "7 V +- 0.1 +- 0.2"])
def test_what_is_no_uncertainty_is_replaced_by_the_usual_one(written):
    field = measured_fields("bearing", Inputs())["shaft_voltage"]
    present = Inputs({"measured": {"shaft_voltage": written}})
    assert with_value(present, "shaft_voltage", field, "8") == "8 V +- 3 %"


def test_values_of_the_page_and_of_a_file_are_counted_apart(tmp_path):
    (tmp_path / "surfaces").mkdir()
    heads = "speed [rpm],capacitance [pF],uncertainty of capacitance [%]"
    rows = "3000,250,3\n3000,252,3\n6000,200,300\n"
    (tmp_path / "surfaces" / "surface-1.csv").write_text(f"{heads}\n{rows}", encoding="utf-8")
    table = tables("bearing", file="surfaces/surface-1.csv", shaft_voltage="8 V +- 3 %")
    counts, doubt = checked(table, tmp_path).split(". ")
    assert counts == (
        "3 measured values at 2 operating points of the file, and 1 at the operating point of the page"
    )
    assert doubt.startswith("The uncertainty of the capacitance is larger")


def test_a_value_without_an_uncertainty_is_refused_by_its_key():
    field = measured_fields("bearing", Inputs())["capacitance"]
    inputs = Inputs({"measured": {"capacitance": "250 pF +- 5 %"}})
    text = with_uncertainty(inputs, "capacitance", field, "")
    assert text == "250 pF"
    with pytest.raises(InputError) as caught:
        checked(tables("bearing", capacitance=text))
    assert caught.value.key == "measured.capacitance"


@pytest.mark.slow
@pytest.mark.gate
def test_the_updated_case_has_the_values_of_the_calibration_and_all_other_inputs(tmp_path):
    table = tables("bearing", capacitance="250 pF +- 5 %", outer_ring_temperature="74 degC +- 2 K")
    answer = calibrated(table, tmp_path, silent)
    assert answer.explained
    case = ehlectric.BearingCase.from_written(table)
    result = ehlectric.calibrate(case)
    updated = Inputs(answer.updated)
    for entry in result.inputs:
        ends = updated.value(f'ranges."{entry.key}"')
        assert (ends is not None) == entry.updated, entry.key
    temperature = next(entry for entry in result.inputs if entry.key == "bearing.temperature")
    # Texts of the page have five digits.
    expected = [end - 273.15 for end in temperature.posterior]
    low, high = updated.value('ranges."bearing.temperature"')
    shown = [in_unit(text, "degC") for text in (low, updated.value("bearing.temperature"), high)]
    assert shown == pytest.approx(expected, rel=1e-4)
    # The updated tables are a valid case, and a page keeps what the measurement does not concern.
    again = ehlectric.BearingCase.from_written(dict(updated.table))
    assert again.measured is None
    changed = {key for key, value in updated.flat().items() if value != Inputs(table).flat().get(key)}
    radial = {"bearing.radial_load", "bearing.axial_load"}
    assert (
        changed
        <= {f'ranges."{entry.key}"' for entry in result.inputs}
        | {entry.key for entry in result.inputs}
        | radial
    )
    probability = answer.chances.rows[0][2]
    assert probability.startswith(f"{100.0 * result.after.probability:.2g} %")


@pytest.mark.slow
def test_both_ends_of_an_updated_drive_are_as_calibrated(tmp_path):
    table = tables("drive", capacitance="200 pF +- 5 %", shaft_voltage="12 V +- 5 %")
    answer = calibrated(table, tmp_path, silent)
    assert "non_drive_end" not in answer.updated, "both ends are equal, as before"
    case = ehlectric.calibrate(ehlectric.DriveCase.from_written(table)).case
    again = ehlectric.DriveCase.from_written(dict(answer.updated))
    keys = ("bearing.temperature", "bearing.radial_load", "bearing.radial_clearance")
    for end in ("drive_end", "non_drive_end"):
        both = [[value_at(one.to_dict()[end], key) for key in keys] for one in (again, case)]
        assert both[0] == pytest.approx(both[1], rel=1e-4)
        ranges = [one.to_dict()[end]["ranges"] for one in (again, case)]
        assert ranges[0].keys() == ranges[1].keys()
        for key, ends in ranges[1].items():
            assert ranges[0][key] == pytest.approx(ends, rel=1e-4)


@pytest.mark.slow
def test_a_measurement_that_nothing_explains_updates_nothing(tmp_path):
    answer = calibrated(tables("gear", capacitance="1 uF +- 1 %"), tmp_path, silent)
    assert not answer.explained
    assert answer.updated is None
    assert answer.inputs is None
    assert "ranges" not in answer.figures
    assert answer.verdict.code == "measurement-unexplained"
