"""Measured values on the pages, as a user types them: calibration, its verdict, and the updated case."""

import tomllib

import pytest

from tests.app.driving import complete, drawn, field, type_into, wait_for_address
from tests.app.outputs import command, downloaded, fits
from tests.app.test_accessibility import findings
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import wait_until

pytestmark = pytest.mark.browser


def add(page, name, value):
    """Add a measured value, and wait until the page has taken it over."""
    group = page.get_by_test_id("group-measured-values")
    if not group.evaluate("box => box.open"):
        group.locator("summary").first.click()
    page.get_by_test_id("field-measured-add").select_option(name)
    type_into(page, f"measured.{name}", value)
    wait_for_address(page, f"measured.{name}={value}")


def calibrate(page, *, explained):
    page.get_by_test_id("measured-used").get_by_text("operating point").wait_for()
    page.get_by_test_id("calibrate").click()
    page.locator(f"[data-testid=calibration][data-explained={str(explained).lower()}]").wait_for()


@pytest.mark.slow
@pytest.mark.gate
def test_measured_values_update_the_ranges_as_the_command_does(open_page, app_server, tmp_path):
    page = open_page(app_server, "/")
    complete(page)
    add(page, "capacitance", "250")
    assert field(page, "measured.capacitance").input_value() == "250 pF"
    assert field(page, "measured.capacitance.uncertainty").input_value() == "5 %"
    add(page, "outer_ring_temperature", "74")
    type_into(page, "measured.outer_ring_temperature.uncertainty", "2")
    wait_for_address(page, "74 degC +- 2 K")
    case = downloaded(page, "download-toml", tmp_path)
    calibrate(page, explained=True)
    command("calibrate", case, "--no-plots", "-o", "out", folder=tmp_path)
    by_command = tomllib.loads((tmp_path / "out" / "calibrated.toml").read_text(encoding="utf-8"))
    updated = tomllib.loads(downloaded(page, "download-calibrated", tmp_path).read_text(encoding="utf-8"))
    assert updated["ranges"].keys() == by_command["ranges"].keys()
    assert "measured" not in updated
    drawn(page)
    assert findings(page) == []
    # Both verdicts have a heading, and the short answer of a narrow screen names its own.
    headings = page.locator("h2").filter(has_text="the measurement").filter(visible=True)
    assert headings.all_inner_texts() == ["After the measurement", "Before the measurement"]
    page.set_viewport_size({"width": 400, "height": 800})
    assert fits(page)
    strip = page.get_by_test_id("strip").inner_text()
    after = page.get_by_test_id("calibration-chances").locator("tbody tr").first.locator("td").last
    assert f"After the measurement · breakdown {after.inner_text().partition(' (')[0]}" in strip
    type_into(page, "measured.outer_ring_temperature.uncertainty", "3")
    page.get_by_test_id("strip").get_by_text("Before the measurement").wait_for()
    page.get_by_test_id("undo").click()
    page.get_by_test_id("strip").get_by_text("After the measurement").wait_for()
    # The updated ranges are inputs of the page, which has the measured values again after an undo.
    page.get_by_test_id("use-calibrated").click()
    wait_for_address(page, 'ranges."bearing.temperature"')
    assert not page.get_by_test_id("calibration").is_visible()
    assert not page.get_by_test_id("before").is_visible()
    page.get_by_test_id("undo").click()
    page.get_by_test_id("calibration").wait_for()


@pytest.mark.slow
def test_a_file_of_operating_points_is_opened_with_its_case_and_can_be_replaced(
    open_page, app_server, tmp_path
):
    page = open_page(app_server, "/")
    complete(page)
    files = [EXAMPLES / "bearing_measured.toml", EXAMPLES / "measurements" / "bearing_6208_points.csv"]
    page.get_by_test_id("upload-case").locator("input[type=file]").set_input_files(files)
    # Two values of the file, and seven of the CSV at four operating points.
    used = page.get_by_test_id("measured-used")
    used.get_by_text("7 measured values at 4 operating points of the file, and 2").wait_for()
    bad = tmp_path / "bad.csv"
    bad.write_text("speed [rpm],capacitance [pF]\n3000,250\n", encoding="utf-8")
    page.get_by_test_id("upload-measured").set_input_files(bad)
    error = page.get_by_test_id("error-measured").get_by_text("uncertainty of capacitance")
    error.wait_for()
    assert error.inner_text().startswith("bad.csv"), "the file has the name that its user knows"
    assert page.get_by_test_id("calibrate").is_disabled()
    page.get_by_test_id("measured-remove").click()
    calibrate(page, explained=True)


@pytest.mark.slow
def test_a_value_is_typed_with_its_uncertainty(open_page, app_server):
    page = open_page(app_server, "/")
    complete(page)
    add(page, "shaft_voltage", "8")
    boxes = [field(page, f"measured.shaft_voltage{end}") for end in ("", ".uncertainty")]

    def shown(*texts):
        return wait_until(lambda: tuple(box.input_value() for box in boxes) == texts)

    for typed, texts in {
        "8 +- 0.3": ("8 V", "0.3 V"),
        "9 V": ("9 V", "0.3 V"),
        "8 ± 0.4 V": ("8 V", "0.4 V"),
        "8 V +- 4 %": ("8 V", "4 %"),
        "7 +- 4 % V": ("7 V", "4 % V"),
    }.items():
        type_into(page, "measured.shaft_voltage", typed)
        assert shown(*texts), typed
    error = page.get_by_test_id("error-measured-shaft_voltage-uncertainty")
    error.filter(has_text="a difference above 0").wait_for()
    assert not page.get_by_test_id("error-measured-shaft_voltage").is_visible()
    # What is no uncertainty ends with the value to which it was typed.
    type_into(page, "measured.shaft_voltage", "6")
    assert shown("6 V", "3 %")
    error.wait_for(state="hidden")
    type_into(page, "measured.shaft_voltage.uncertainty", "300")
    used = page.get_by_test_id("measured-used").filter(has_text="larger than the measured value")
    used.wait_for()
    type_into(page, "measured.shaft_voltage.uncertainty", "0.3")
    used.wait_for(state="hidden")


@pytest.mark.slow
def test_what_nothing_explains_and_what_is_wrong_is_stated(open_page, app_server):
    page = open_page(app_server, "/gear")
    page.locator("[data-testid=answer][data-whole=true][aria-busy=false]").wait_for()
    add(page, "capacitance", "900 nF")
    calibrate(page, explained=False)
    verdict = page.get_by_test_id("calibration-verdict")
    assert verdict.get_attribute("data-level") == "grey"
    assert not page.get_by_test_id("use-calibrated").is_visible()
    type_into(page, "measured.capacitance", "5 V")
    page.get_by_test_id("error-measured-capacitance").get_by_text("expected").wait_for()
    page.get_by_test_id("calibration-state").get_by_text("earlier inputs").wait_for()
    assert page.get_by_test_id("calibrate").is_disabled()
    page.get_by_test_id("remove-measured-capacitance").click()
    page.get_by_test_id("calibration").wait_for(state="hidden")


@pytest.mark.slow
def test_measured_values_of_an_axle_name_their_element_and_update_its_inputs(open_page, app_server):
    page = open_page(app_server, "/axle")
    page.locator("[data-testid=answer][data-whole=true][aria-busy=false]").wait_for()
    add(page, "shafts.rotor.voltage", "13")
    assert page.get_by_label("Voltage of the shaft rotor", exact=True).input_value() == "13 V"
    # A shaft with another name keeps its measured value.
    page.get_by_test_id("group-shaft-rotor").locator("summary").first.click()
    type_into(page, "shaft.1.name", "motor shaft")
    wait_for_address(page, "measured.shafts.motor_shaft.voltage=13 V +- 3 %")
    add(page, "elements.motor_shaft_1.capacitance", "240")
    assert page.get_by_label("Capacitance of bearing 1 of motor shaft", exact=True).input_value() == "240 pF"
    calibrate(page, explained=True)
    tables = page.get_by_test_id("calibration-tables")
    tables.locator("summary").first.click()
    tables.get_by_text("Temperature of the oil").first.wait_for()
    # The inputs with the updated ranges are a valid axle again.
    page.get_by_test_id("use-calibrated").click()
    page.locator("[data-testid=answer][data-whole=true][aria-busy=false]").wait_for()
    assert not page.get_by_test_id("notice").is_visible()
