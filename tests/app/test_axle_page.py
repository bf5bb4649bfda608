"""Page of an axle as a user sees it: from designations and a drawing to the first element."""

import re

import pytest

from ehlectric.readable import readable
from tests.app.driving import field, type_into, wait_for_address, wait_for_number
from tests.app.outputs import downloaded, fits, summary_by_command
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import wait_until

pytestmark = pytest.mark.browser


def answered(page):
    page.locator("[data-testid=answer][aria-busy=false]").wait_for()


@pytest.fixture
def axle(open_page, app_server):
    page = open_page(app_server, "/axle")
    answered(page)
    return page


def opened(page, group):
    """Open a group of the form."""
    box = page.get_by_test_id(f"group-{group}")
    if not box.evaluate("box => box.open"):
        box.locator("summary").first.click()
    return box


def choose(page, key, text):
    """Type a designation into a searched list, and accept it."""
    box = field(page, key)
    box.fill(text)
    box.press("Enter")


def elements(page):
    """Rows of the table of all bearings and meshes, by their names."""
    rows = page.get_by_test_id("elements").locator("tbody tr").all()
    texts = [row.locator("td").all_inner_texts() for row in rows]
    return {row[0]: row[1:] for row in texts}


@pytest.mark.slow
@pytest.mark.gate
def test_designations_and_a_drawing_lead_to_the_numbers_of_the_command(axle, tmp_path):
    page = axle
    opened(page, "bearing-1-of-rotor")
    choose(page, "bearing.1.base", "6308")
    wait_for_address(page, "6308")
    opened(page, "bearing-2-of-intermediate")
    type_into(page, "bearing.4.at", "105")
    wait_for_address(page, "105 mm")
    opened(page, "gear-mesh-1")
    type_into(page, "mesh.1.pair.gear.teeth.2", "68")
    type_into(page, "mesh.1.pair.gear.profile_shift.1", "")
    type_into(page, "mesh.1.pair.gear.centre_distance", "")
    for gear in (1, 2):
        more = page.get_by_test_id("group-gear-mesh-1").locator("details summary")
        if not field(page, f"mesh.1.pair.gear.tip_diameter.{gear}").is_visible():
            more.click()
        type_into(page, f"mesh.1.pair.gear.tip_diameter.{gear}", "")
    type_into(page, "drive.torque", "40")
    wait_for_address(page, "40 N*m")
    summary = summary_by_command("drive", downloaded(page, "download-toml", tmp_path), tmp_path)
    first = summary["rank"]["by-film"][0]
    ratios = {row["element"]: row["voltage_ratio"] for row in summary["elements"]}
    wait_for_number(page, "first.margin", 1.0 / ratios[first])
    for row in summary["elements"]:
        shown = elements(page)[row["element"]]
        if row["voltage_ratio"] is None:
            # Words instead of a number, from the state of the element.
            words = "conducts" if row["state"] == "conducts" else "touches" if row["touching"] else "no V_b"
            assert shown[0] == words
        else:
            assert shown[0] == readable(row["voltage_ratio"])
        assert shown[3] == readable(1e9 * row["capacitance"])
    network = page.get_by_test_id("network")
    assert network.locator("li.first").count() == 1
    assert network.get_by_text("bearing 1 6308").count() == 1
    head = page.get_by_test_id("group-bearing-1-of-rotor").locator("summary").first.inner_text()
    assert "6308" in head


def simulate(page):
    """Press the button that simulates, and wait for the discharges."""
    page.get_by_test_id("solve").click()
    page.locator("[data-testid=answer][data-simulated=true]").wait_for()


@pytest.mark.slow
@pytest.mark.gate
def test_a_simulation_has_the_numbers_of_the_command(axle, tmp_path):
    page = axle
    assert not page.get_by_test_id("simulated").is_visible()
    simulate(page)
    # The button switches on the group of the simulated time, whose first values are in the downloaded file.
    summary = summary_by_command("drive", downloaded(page, "download-toml", tmp_path), tmp_path)
    rows = page.get_by_test_id("simulation").locator("tbody tr").all()
    texts = {cells[0]: cells[1:] for cells in (row.locator("td").all_inner_texts() for row in rows)}
    for row in summary["simulation"]["elements"]:
        expected = [row[key] for key in ("events_per_second", "voltage_median", "energy_mean")]
        shown = [readable(factor * value) for factor, value in zip((1.0, 1.0, 1e9), expected, strict=True)]
        assert texts[row["element"]][:3] == shown
    for row in summary["simulation"]["shafts"]:
        assert texts[f"shaft {row['shaft']}"][4] == readable(row["peak_voltage"])
    rates = [row["events_per_second"] for row in summary["simulation"]["elements"]]
    wait_for_number(page, "simulated.rate", max(rates))
    circles = page.get_by_test_id("figure-shaft-voltages").locator(".scatterlayer .point")
    assert wait_until(lambda: circles.count() > 0)
    assert page.get_by_test_id("figure-rates").locator(".scatterlayer .point").count() == len(rates)
    # Another input has no simulation yet; without its group, no time is simulated.
    type_into(page, "drive.torque", "31")
    page.locator("[data-testid=answer][data-simulated=false]").wait_for()
    page.get_by_test_id("back-to-solved").click()
    page.locator("[data-testid=answer][data-simulated=true]").wait_for()
    opened(page, "discharges-over-time")
    page.get_by_test_id("switch-discharges-over-time").click()
    page.wait_for_function("() => !location.search.includes('duration')")


@pytest.mark.slow
def test_a_ticked_measure_has_a_column_and_a_sentence_on_all_elements(axle):
    page = axle
    box = page.get_by_test_id("remedy-ring-on-the-output-shaft")
    box.focus()
    page.keyboard.press("Space")
    sentence = page.get_by_test_id("effects").locator("li", has_text="Ring on the output shaft:")
    sentence.wait_for()
    assert "both bearings of output" in sentence.inner_text()
    heads = page.get_by_test_id("remedies-table").get_by_role("columnheader").all_inner_texts()
    assert "Ring on the output shaft" in heads
    assert box.evaluate("box => box.contains(document.activeElement)")
    assert box.get_attribute("aria-checked") == "true"
    page.get_by_test_id("undo").click()
    sentence.wait_for(state="detached")
    assert box.get_attribute("aria-checked") == "false"


# Words that the browser shows on a part of the page.
_WORDS = "part => getComputedStyle(part, '::before').content"


@pytest.mark.slow
def test_parts_of_earlier_inputs_say_so_until_their_new_values_come(axle):
    page = axle
    page.locator("[data-testid=answer][data-whole=true]").wait_for()
    remedies, followed = page.get_by_test_id("remedies-table"), page.locator(".follows")
    remedies.locator("table").wait_for()
    assert followed.count() == 0
    before = remedies.inner_text()
    type_into(page, "drive.torque", "45")
    waiting = page.locator("[data-testid=answer]:not(.follows) [data-testid=remedies-table].follows")
    waiting.wait_for()
    assert "new values follow" in waiting.evaluate(_WORDS)
    assert remedies.inner_text() == before
    followed.first.wait_for(state="detached")
    assert wait_until(lambda: remedies.inner_text() != before and followed.count() == 0)
    # A refused input has no new values, and the notice of the page says so.
    type_into(page, "drive.torque", "much")
    page.get_by_test_id("notice").filter(has_text="earlier inputs").wait_for()
    assert page.get_by_test_id("answer").evaluate(_WORDS) == "none"


@pytest.mark.slow
def test_shafts_and_links_are_added_renamed_and_removed(axle):
    page = axle
    network = page.get_by_test_id("network")
    page.get_by_test_id("add-shaft").click()
    network.get_by_text("shaft 4", exact=True).wait_for()
    opened(page, "shaft-shaft-4")
    type_into(page, "shaft.4.name", "wheel")
    network.get_by_text("wheel", exact=True).wait_for()
    assert "mesh to wheel" in network.inner_text()
    page.get_by_test_id("add-link").click()
    network.get_by_text("ring", exact=True).wait_for()
    opened(page, "shaft-wheel")
    page.get_by_test_id("remove-shaft-4").click()
    network.get_by_text("wheel", exact=True).wait_for(state="detached")
    assert page.get_by_test_id("group-link-1").count() == 0
    page.get_by_test_id("undo").click()
    network.get_by_text("wheel", exact=True).wait_for()
    opened(page, "bearing-2-of-wheel")
    page.get_by_test_id("remove-bearing-8").click()
    page.get_by_test_id("notice").filter(has_text="1 on shaft 'wheel'").wait_for()
    opened(page, "shaft-wheel")
    page.get_by_test_id("add-bearing-4").click()
    page.get_by_test_id("notice").wait_for(state="hidden")


@pytest.mark.slow
def test_a_refusal_stands_next_to_the_field_of_its_element(axle):
    page = axle
    opened(page, "bearing-1-of-intermediate")
    type_into(page, "bearing.3.at", "far")
    page.get_by_test_id("error-bearing-3-at").filter(has_text="a number").wait_for()
    type_into(page, "bearing.3.at", "0")
    page.get_by_test_id("error-bearing-3-at").wait_for(state="hidden")
    choose(page, "bearing.3.base", "99999")
    page.get_by_test_id("error-bearing-3-base").filter(has_text="designation").wait_for()
    page.get_by_test_id("undo").click()
    opened(page, "gear-mesh-2")
    type_into(page, "mesh.2.pair.gear.teeth.1", "many")
    page.get_by_test_id("error-mesh-2-pair-gear-teeth-1").filter(has_text="a whole number").wait_for()
    page.get_by_test_id("undo").click()
    answered(page)
    assert field(page, "mesh.2.pair.gear.teeth.1").input_value() == "19"


@pytest.mark.slow
def test_a_drawing_is_typed_faster_than_its_answers(axle):
    page = axle
    opened(page, "gear-mesh-2")
    # Each number is typed while the answer of the number before is being computed.
    for key, value in {"normal_module": "2.5", "teeth.2": "66", "helix_angle": "22"}.items():
        type_into(page, f"mesh.2.pair.gear.{key}", value)
    wait_for_address(page, "22 deg")
    answered(page)
    assert not page.get_by_test_id("notice").is_visible()
    more = page.get_by_test_id("group-gear-mesh-2").locator("details summary")
    if not field(page, "mesh.2.pair.gear.tip_diameter.1").is_visible():
        more.click()
    for key in ("centre_distance", "profile_shift.1", "tip_diameter.1", "tip_diameter.2"):
        assert field(page, f"mesh.2.pair.gear.{key}").input_value() == ""
    assert field(page, "mesh.2.pair.gear.teeth.2").input_value() == "66"


@pytest.mark.slow
def test_tapered_bearings_are_typed_without_a_rejection(axle):
    """Notices name the bearing, and what it keeps of the bearing before it."""
    page, note = axle, axle.get_by_test_id("form-note")
    opened(page, "bearing-1-of-intermediate")
    assert field(page, "bearing.3.composite_rq").get_attribute("placeholder") == "0.03 µm"
    choose(page, "bearing.3.base", "32008")
    note.filter(has_text="Bearing 1 of intermediate, also removed: Radial clearance").wait_for()
    note.filter(has_text="kept: Composite roughness Rq = 0.03 µm").wait_for()
    asked = page.get_by_test_id("error-bearing-4-base")
    asked.filter(has_text="a tapered roller bearing").wait_for()
    assert "empty" in asked.get_attribute("class")
    choose(page, "bearing.4.base", "32207")
    note.filter(has_text="kept: Composite roughness Rq = 0.05 µm").wait_for()
    asked = page.get_by_test_id("error-shaft-2-adjustment-preload")
    asked.filter(has_text="an axial play").wait_for()
    assert "empty" in asked.get_attribute("class")
    type_into(page, "shaft.2.adjustment.axial_play", "0")
    asked.wait_for(state="hidden")
    answered(page)
    assert "32008" in page.get_by_test_id("network").inner_text()


@pytest.mark.slow
def test_an_axle_opens_with_its_gear_files(page):
    upload = page.get_by_test_id("upload-case").locator("input[type=file]")
    upload.set_input_files(EXAMPLES / "e_axle.toml")
    page.get_by_role("status").filter(has_text="e_axle_stage_1.toml, e_axle_stage_2.toml").wait_for()
    upload.set_input_files([EXAMPLES / f"e_axle_stage_{number}.toml" for number in (1, 2)])
    page.wait_for_url(re.compile("/axle"))
    page.get_by_test_id("verdict").filter(has_text="Breakdown expected").wait_for()
    opened(page, "gear-mesh-2")
    assert field(page, "mesh.2.pair.gear.teeth.2").input_value() == "73"


@pytest.mark.slow
def test_a_narrow_screen_shows_the_ratio_of_each_element_without_scrolling(open_page, app_server):
    page = open_page(app_server, "/axle", width=400, height=800)
    answered(page)
    heads = page.get_by_test_id("elements").get_by_role("columnheader")
    assert heads.all_inner_texts()[:4] == ["", "U/V_b", "U [V]", "V_b [V]"]
    right = heads.nth(3).bounding_box()
    assert right["x"] + right["width"] <= 400


@pytest.mark.slow
def test_only_one_shaft_is_the_rotor_and_one_bearing_of_a_shaft_carries_its_axial_force(axle):
    page = axle
    opened(page, "bearing-2-of-output")
    page.get_by_test_id("field-bearing-6-locating").select_option("yes")
    opened(page, "bearing-1-of-output")
    assert wait_until(lambda: page.get_by_test_id("field-bearing-5-locating").input_value() == "no")
    answered(page)


@pytest.mark.slow
def test_an_axle_is_varied_on_the_page_of_sweeps(axle):
    """The first inputs of the sweep are speed and torque of the rotor."""
    page = axle
    page.get_by_test_id("vary").click()
    page.wait_for_url("**/sweep**")
    values = "names.map((_, k) => document.querySelector(`[data-testid=field-vary-${k}]`)?.value)"
    page.wait_for_function(
        f"names => JSON.stringify({values}) === JSON.stringify(names)",
        arg=["Speed of the rotor", "Torque of the rotor"],
    )
    assert "/axle?" in page.get_by_role("link", name="Open the base case on its page").get_attribute("href")


@pytest.mark.slow
def test_a_gear_file_replaces_the_gears_of_a_mesh(axle):
    page = axle
    opened(page, "gear-mesh-1")
    upload = page.get_by_test_id("upload-gear-1")
    upload.set_input_files(EXAMPLES / "bearing_6208.toml")
    page.get_by_test_id("error-gear-1").filter(has_text="no gear file").wait_for()
    upload.set_input_files(EXAMPLES / "gear_pair.toml")
    # The file of a pair in a drawing has no hand, which an axle needs.
    error = page.get_by_test_id("error-mesh-1-pair-gear-hand")
    error.filter(has_text="left").wait_for()
    page.get_by_test_id("error-gear-1").wait_for(state="hidden")
    page.get_by_test_id("field-mesh-1-pair-gear-hand").select_option("left")
    error.wait_for(state="hidden")
    assert page.get_by_test_id("group-gear-mesh-1").evaluate("box => box.open")


@pytest.mark.slow
def test_a_measured_voltage_takes_the_place_of_the_inverter(axle, tmp_path):
    """Edges of 280 V of a record, instead of a third of the DC link."""
    page = axle
    before = elements(page)
    wave = tmp_path / "scope.csv"
    volts = "\n".join(f"{2e-7 * k:.8e},{140 if k // 100 % 2 else -140}" for k in range(2000))
    wave.write_text(f"time [s],voltage [V]\n{volts}\n", encoding="utf-8")
    opened(page, "source")
    page.get_by_test_id("upload-waveform").set_input_files(wave)
    page.get_by_test_id("waveform-used").filter(has_text="scope.csv").wait_for()
    assert wait_until(lambda: elements(page) != before)
    assert "280 V" in page.get_by_test_id("answer").inner_text()
    assert fits(page)
    page.get_by_test_id("undo").click()
    assert wait_until(lambda: elements(page) == before)
