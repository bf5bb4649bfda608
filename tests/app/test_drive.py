"""Page of a drive: its first answer, its simulation, its remedies, and what is told of wrong values."""

import math
import tomllib
import zipfile

import pytest

from ehlectric import DriveCase
from tests.app.driving import (
    complete,
    field,
    number,
    seen,
    type_into,
    wait_for_address,
    wait_for_any_number,
    wait_for_number,
)
from tests.app.outputs import address_of, downloaded, fits, summary_by_command
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import alive, wait_until
from tests.helpers.readable import number_in

pytestmark = pytest.mark.browser

EXAMPLE = tomllib.loads((EXAMPLES / "drive.toml").read_text(encoding="utf-8"))

# By the capacitive divider of the example: 280 V times 50 pF over 50 pF, 500 pF and both bearings.
AT_PEAK = 12.8


def short(seconds="2 ms", **tables):
    """Tables of the example with a short simulated time."""
    return {**EXAMPLE, "drive": {**EXAMPLE["drive"], "duration": seconds}, **tables}


def simulate(page):
    page.get_by_test_id("solve").click()
    page.locator("[data-testid=answer][data-simulated=true]").wait_for()


@pytest.mark.slow
def test_the_first_answer_follows_what_is_typed(open_page, app_server):
    page = open_page(app_server, "/drive")
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    assert page.get_by_test_id("verdict").get_attribute("data-level") == "red"
    # The divider is linear in the voltage of the DC link.
    type_into(page, "source.dc_link", "56")
    wait_for_number(page, "end.voltage_at_peak", 0.1 * AT_PEAK)
    assert "56+V" in page.url
    page.get_by_test_id("undo").click()
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    type_into(page, "drive_end.bearing.radial_load", "much")
    error = page.get_by_test_id("error-drive_end-bearing-radial_load")
    error.filter(has_text="expected").wait_for()
    assert "Radial load" in page.get_by_test_id("notice").inner_text()
    assert page.get_by_test_id("answer").get_attribute("aria-busy") == "true"
    page.get_by_test_id("undo").click()
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)


@pytest.mark.slow
@pytest.mark.gate
def test_a_simulation_has_the_numbers_of_the_command_and_a_remedy_stands_beside_it(
    open_page, app_server, tmp_path
):
    page = open_page(app_server, address_of("/drive", short(remedies=[])))
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    page.get_by_test_id("remedy-grounding-ring").click()
    page.wait_for_function("location.search.includes('Grounding')")
    simulate(page)
    rate = number(page, "end.events_per_second")
    path = downloaded(page, "download-toml", tmp_path)
    summary = summary_by_command("drive", path, tmp_path)
    rates = [summary[end]["events_per_second"] for end in ("drive_end", "non_drive_end")]
    assert rate == pytest.approx(max(rates), rel=5e-3), "the worse end decides"
    seen(page, "figure-remedies").wait_for()
    table = page.get_by_test_id("remedies-table")
    table.get_by_text("Grounding ring").wait_for()
    assert table.locator("tbody tr").count() == 2
    shown = [number_in(text) for text in table.locator("tbody tr").first.locator("td").all_inner_texts()[1:]]
    assert shown == pytest.approx([*rates, summary["drive"]["events_per_second"]], rel=5e-3)
    # Further figures are drawn when their place is opened, one at a time.
    further = page.get_by_test_id("figure-further")
    assert not further.is_visible()
    page.get_by_test_id("further").locator("summary").first.click()
    # The circles are the discharges of the shown time.
    circles = further.locator(".js-plotly-plot .scatterlayer .point")
    assert wait_until(lambda: circles.count() > 0)
    page.get_by_test_id("choose-spectrum").click()
    further.get_by_role("heading", name="Spectrum").wait_for()
    assert page.get_by_test_id("choose-spectrum").get_attribute("aria-pressed") == "true"
    assert page.get_by_test_id("choose-voltages").get_attribute("aria-pressed") == "false"
    with zipfile.ZipFile(downloaded(page, "download-csv", tmp_path)) as archive:
        assert {"events.csv", "spectrum.csv"} <= set(archive.namelist())
    # Another input has no simulation yet; one step leads back to it.
    type_into(page, "drive.seed", "7")
    page.locator("[data-testid=answer][data-simulated=false]").wait_for()
    page.get_by_test_id("back-to-solved").click()
    page.locator("[data-testid=answer][data-simulated=true]").wait_for()


@pytest.mark.slow
def test_a_simulation_can_be_stopped(own_server, open_page):
    server = own_server()
    page = open_page(server, address_of("/drive", short("10 s")))
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    before = set(server.started())
    page.get_by_test_id("solve").click()
    page.get_by_text("percent simulated").filter(visible=True).wait_for()
    started = set(server.processes()) - before
    assert started
    seen(page, "cancel").click()
    page.get_by_test_id("solve-message").filter(has_text="Cancelled").wait_for()
    assert wait_until(lambda: not any(map(alive, started)))
    assert page.get_by_test_id("answer").get_attribute("data-simulated") == "false"


@pytest.mark.slow
def test_a_drive_file_is_opened_from_any_page_and_fits_a_phone(open_page, app_server):
    page = open_page(app_server, "/", width=400, height=800)
    page.get_by_test_id("upload-case").locator("input").set_input_files(EXAMPLES / "drive.toml")
    page.wait_for_url("**/drive?*")
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    assert fits(page)
    # The bearing file leads back to the page of a bearing, and from there into its drive.
    page.get_by_test_id("upload-case").locator("input").set_input_files(EXAMPLES / "bearing_6208.toml")
    page.wait_for_function("location.pathname === '/'")
    page.get_by_test_id("in-drive").click()
    page.wait_for_url("**/drive?*")
    wait_for_any_number(page, "end.voltage_at_peak")
    assert field(page, "drive_end.bearing.radial_load").input_value() == "1800 N"
    assert fits(page)


@pytest.mark.slow
def test_a_measured_waveform_takes_the_place_of_the_source(open_page, app_server, tmp_path):
    page = open_page(app_server, address_of("/drive", short(remedies=[])))
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    wave = tmp_path / "scope.csv"
    volts = "\n".join(f"{2e-7 * k:.8e},{140 if k // 100 % 2 else -140}" for k in range(2000))
    wave.write_text(f"time [s],voltage [V]\n{volts}\n", encoding="utf-8")
    page.get_by_test_id("upload-waveform").set_input_files(wave)
    wait_for_number(page, "end.voltage_at_peak", 0.5 * AT_PEAK)
    assert "measured waveform" in page.get_by_test_id("number-source.peak").inner_text()
    simulate(page)
    assert number(page, "end.peak_voltage") > 0.0
    page.get_by_test_id("undo").click()
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)


@pytest.mark.slow
def test_a_missing_channel_is_named_at_its_field_as_soon_as_the_record_is_given(
    open_page, app_server, tmp_path
):
    page = open_page(app_server, address_of("/drive", short()))
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    rows = "\n".join(
        f"{2e-7 * k:.8e},{140 if k // 100 % 2 else -140},{5 if k // 100 % 2 else -5}" for k in range(2000)
    )
    record = tmp_path / "two_channels.csv"
    record.write_text(f"TIME,CH1,CH2\ns,V,V\n{rows}\n", encoding="utf-8")
    page.get_by_test_id("upload-waveform").set_input_files(record)
    error = page.get_by_test_id("error-source-column")
    error.filter(has_text="CH2").wait_for()
    assert "two_channels.csv" in error.inner_text()
    assert "surface-1" not in page.locator("body").inner_text()
    type_into(page, "source.column", "CH1")
    wait_for_number(page, "end.voltage_at_peak", 0.5 * AT_PEAK)
    page.get_by_test_id("warnings").filter(has_text="not applicable").first.wait_for(state="attached")
    assert "surface-1" not in page.locator("body").inner_text()


# Height of the page of a simulated drive on a phone [px]; twice that with all figures below each other.
TALLEST = 5000


@pytest.mark.slow
def test_a_simulated_drive_is_short_on_a_phone_and_shows_what_decides(open_page, app_server):
    page = open_page(app_server, address_of("/drive", short()), width=400, height=800)
    simulate(page)
    for test_id in ("number-end.events_per_second", "number-end.energy_mean", "remedies-table"):
        assert page.get_by_test_id(test_id).is_visible()
    seen(page, "figure-remedies").wait_for()
    assert page.evaluate("document.documentElement.scrollHeight") < TALLEST
    assert fits(page)
    page.get_by_test_id("further").locator("summary").first.click()
    page.get_by_test_id("figure-further").wait_for()
    assert page.evaluate("document.documentElement.scrollHeight") < 1.1 * TALLEST
    assert fits(page)


@pytest.mark.slow
def test_a_remedy_of_a_bearing_leads_to_its_drive_with_the_same_voltage(open_page, app_server):
    page = open_page(app_server)
    complete(page)
    type_into(page, "motor.common_mode_voltage", "400 V")
    wait_for_address(page, "400 V")
    complete(page)
    button = page.get_by_test_id("choose-hybrid")
    button.focus()
    page.keyboard.press("Enter")
    effect = page.get_by_test_id("helps-effect")
    effect.get_by_text("No discharge expected").wait_for()
    assert button.get_attribute("aria-pressed") == "true"
    effect.and_(page.locator("[data-whole=true]")).wait_for()
    # By the divider, with nine elements of 5 pF in each bearing.
    voltage = f"{400.0 * 20.0 / 1110.0:.3g} V"
    effect.get_by_text(voltage, exact=True).wait_for()
    page.get_by_test_id("helps-drive").click()
    page.wait_for_url("**/drive?*")
    wait_for_number(page, "source.peak", 400.0)
    assert field(page, "source.dc_link").input_value() == "800 V"
    box = page.get_by_test_id("remedy-ceramic-balls")
    assert box.get_attribute("aria-checked") == "true"
    assert page.get_by_test_id("remedy-grounding-ring").get_attribute("aria-checked") == "false"


@pytest.mark.slow
def test_remedies_of_a_bearing_follow_its_inputs_on_a_phone(open_page, app_server):
    page = open_page(app_server, width=400, height=800)
    complete(page)
    page.get_by_test_id("choose-other-oil").click()
    table = page.get_by_test_id("helps-effect").get_by_role("row").filter(has_text="Margin (")
    table.wait_for()
    before = table.inner_text()
    page.get_by_test_id("field-remedy-oil").select_option("iso-vg-32")
    assert wait_until(lambda: table.inner_text() != before)
    assert fits(page)
    # A bearing that is hybrid already is offered the others, and no effect of what was pressed stays.
    page.get_by_test_id("choose-hybrid").click()
    page.get_by_test_id("helps-effect").get_by_text("No discharge expected").wait_for()
    page.get_by_test_id("group-bearing").locator("select").first.select_option("silicon-nitride")
    page.get_by_test_id("choose-hybrid").wait_for(state="hidden")
    page.get_by_test_id("helps-effect").wait_for(state="hidden")
    assert page.get_by_test_id("verdict").get_attribute("data-level") == "green"


@pytest.mark.slow
def test_the_rotor_gives_the_loads_of_both_bearings(open_page, app_server, tmp_path):
    """Its weight and a force replace the given loads, which come back without it."""
    page = open_page(app_server, "/drive")
    wait_for_number(page, "end.voltage_at_peak", AT_PEAK)
    page.get_by_test_id("group-weight-and-forces-of-the-rotor").locator("summary").first.click()
    page.get_by_test_id("switch-weight-and-forces-of-the-rotor").check()
    page.wait_for_function("location.search.includes('rotor.mass')")
    assert "radial_load" not in page.url
    assert field(page, "rotor.mass").is_visible()
    assert page.get_by_test_id("field-drive_end-bearing-radial_load").count() == 0
    page.get_by_test_id("add-force").click()
    page.wait_for_function("location.search.includes('force')")
    type_into(page, "force.1.x", "800")
    page.wait_for_function("location.search.includes('800')")
    path = downloaded(page, "download-toml", tmp_path)
    # 20 kg in the middle, and 800 N at a lever of 230 mm over 180 mm.
    case = DriveCase.from_toml(path)
    expected = math.hypot(10.0 * 9.80665, 800.0 * 230.0 / 180.0)
    assert case.bearings[0].bearing.radial_load == pytest.approx(expected, rel=1e-12)
    page.get_by_test_id("remove-force-1").click()
    page.wait_for_function("!location.search.includes('force')")
    page.get_by_test_id("switch-weight-and-forces-of-the-rotor").uncheck()
    page.wait_for_function("location.search.includes('radial_load')")
    assert field(page, "drive_end.bearing.radial_load").input_value() == "1000 N"
    assert fits(page)
