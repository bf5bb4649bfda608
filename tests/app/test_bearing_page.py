"""Page of a bearing: its numbers are those of the command for the case that it downloads."""

import pytest

from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import in_field_unit
from ehlectric.quantities.units import printed
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
from tests.app.outputs import address_of, bearing_by_command, command, downloaded, fits
from tests.app.test_first_page import capacitance
from tests.helpers.processes import alive, wait_until

pytestmark = pytest.mark.browser

LOAD = "bearing.radial_load"

# Its contacts are solved in seconds: line contacts of rollers are faster than point contacts of balls.
ROLLERS = {
    "bearing": {
        "base": "nu-205",
        "radial_load": "1800 N",
        "axial_load": "0 N",
        "radial_clearance": "20 um",
        "profile": "none",
        "inner_speed": "3000 rpm",
        "temperature": "70 degC",
        "composite_rq": "0.03 um",
    },
    "lubricant": {"base": "paper"},
    "discharge": {"dielectric_strength": "15 V/um"},
}


def wait_for_command(page, summary):
    """Wait until the page shows the numbers that the command gives."""
    found = summary["bearing"]
    wait_for_number(page, "bearing.capacitance", 1e12 * found["capacitance"], digits=4)
    wait_for_number(page, "bearing.lambda_ratio", found["lambda_ratio"])
    if found["shaft_first_break"]:
        wait_for_number(page, "bearing.first_break", found["shaft_first_break"], digits=4)
    if found["shaft_voltage"]:
        wait_for_number(page, "bearing.shaft_voltage", found["shaft_voltage"], digits=4)
        wait_for_number(page, "bearing.margin", found["margin"])


def text_of(page, key):
    return field(page, key).input_value()


@pytest.mark.slow
def test_keys_and_a_mouse_on_a_slider_change_the_answer(page, tmp_path):
    wait_for_number(page, "bearing.capacitance", capacitance())
    slider = page.get_by_test_id("slider-bearing-radial_load")
    slider.focus()
    for _ in range(3):
        before = text_of(page, LOAD)
        page.keyboard.press("ArrowRight")
        assert wait_until(lambda before=before: text_of(page, LOAD) != before)
    wait_for_number(page, "bearing.capacitance", capacitance(text_of(page, LOAD)), digits=4)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.4 * box["width"], middle)
    page.mouse.down()
    for part in (0.5, 0.6, 0.7, 0.8):
        page.mouse.move(box["x"] + part * box["width"], middle)
    field_of_load = next(one for group in BEARING_GROUPS for one in group.fields if one.key == LOAD)
    load = field_of_load.from_slider(float(slider.input_value()) / float(slider.get_attribute("max")))
    page.mouse.up()
    # The place where the slider was left has come to the server when the address of the page has its load.
    wait_for_address(page, load)
    wait_for_command(page, bearing_by_command(page, tmp_path))


@pytest.mark.slow
def test_bearings_that_the_list_lacks(page, tmp_path):
    """From a designation to the numbers of the command: deep-groove, needle, thrust and a tapered pair."""
    wait_for_number(page, "bearing.capacitance", capacitance())
    box = field(page, "bearing.base")
    for name in ("6314-C3", "HK 2020", "51208", "32208"):
        box.click()
        box.fill(name)
        page.get_by_role("listbox").filter(has_text="not in the list").wait_for()
        box.press("Enter")
        page.get_by_test_id("form-note").filter(has_text="Also").wait_for()
        if name == "32208":
            # One row is pushed apart by its radial load: a second one holds it.
            page.get_by_test_id("switch-pair").check()
            field(page, "bearing.pair.preload").wait_for()
        else:
            assert not page.get_by_test_id("switch-pair").is_visible()
        summary = bearing_by_command(page, tmp_path / name.replace(" ", "-"))
        assert summary["inputs"]["bearing"]["base"] == {"6314-C3": "6314", "HK 2020": "hk-2020"}.get(
            name, name
        )
        wait_for_command(page, summary)
    assert summary["inputs"]["bearing"]["pair"]["arrangement"] == "O"


@pytest.mark.slow
def test_another_bearing_of_the_catalogue_and_one_s_own_geometry(page, tmp_path):
    wait_for_number(page, "bearing.capacitance", capacitance())
    box = field(page, "bearing.base")
    box.click()
    box.fill("nu-205")
    page.get_by_test_id("option-nu-205").wait_for()
    box.press("Enter")
    # A roller bearing carries no axial load: the page says what it changed beside the bearing.
    page.get_by_test_id("form-note").filter(has_text="Also").wait_for()
    wait_for_command(page, bearing_by_command(page, tmp_path / "rollers"))
    box.click()
    page.get_by_test_id("option-~own").click()
    field(page, "bearing.elements").wait_for()
    # The values of the catalogue are the first ones, so the answer stays until one changes.
    wait_for_command(page, bearing_by_command(page, tmp_path / "own"))
    before = number(page, "bearing.capacitance")
    type_into(page, "bearing.elements", "11")
    page.wait_for_function(
        "before => !document.querySelector('[data-testid=\"number-bearing.capacitance\"]')"
        ".innerText.includes(before)",
        arg=f"{before:g}",
    )
    summary = bearing_by_command(page, tmp_path / "fewer")
    assert summary["inputs"]["bearing"]["elements"] == 11
    wait_for_command(page, summary)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("key", "wrong"),
    [(LOAD, "-5 N"), (LOAD, "5 kg"), ("bearing.inner_speed", "fast"), ("bearing.composite_rq", "-1 um")],
)
def test_a_wrong_value_has_the_line_of_the_command_beside_it(page, tmp_path, key, wrong):
    wait_for_number(page, "bearing.capacitance", capacitance())
    type_into(page, key, wrong)
    error = page.get_by_test_id(f"error-{key.replace('.', '-')}")
    error.wait_for()
    box = field(page, key)
    assert box.get_attribute("aria-invalid") == "true"
    assert error.get_attribute("id") in box.get_attribute("aria-describedby").split()
    path = downloaded(page, "download-toml", tmp_path)
    _, told = command("bearing", path, "--contacts", "atlas", folder=tmp_path, status=2)
    # The line of the command, with its bounds in the unit of the field.
    (line,) = [line for line in told.splitlines() if f"{key}: " in line]
    shown = next(one for group in BEARING_GROUPS for one in group.fields if one.key == key)
    expected = in_field_unit(shown, line.partition(f"{key}: ")[2])
    assert " ".join(error.inner_text().split()) == " ".join(expected.split())
    assert printed(shown.unit) in error.inner_text()
    assert "string" not in error.inner_text()
    notice = page.get_by_test_id("notice").inner_text()
    assert shown.label in notice
    assert key not in notice
    page.get_by_test_id("to-field").click()
    box.and_(page.locator(":focus")).wait_for()
    assert "being computed" not in page.get_by_test_id("number-margin.critical_speed").inner_text()
    assert page.get_by_test_id("answer").get_attribute("aria-busy") == "true", "an old answer is dimmed"
    page.get_by_test_id("undo").click()
    error.wait_for(state="detached")
    wait_for_number(page, "bearing.capacitance", capacitance())


@pytest.mark.slow
def test_solving_shows_its_progress_and_can_be_cancelled(own_server, open_page):
    # Its balls take half a minute of a processor, far longer than it takes to cancel them.
    server = own_server()
    page = open_page(server)
    wait_for_any_number(page, "bearing.capacitance")
    formula = number(page, "bearing.capacitance")
    before = set(server.started())
    page.get_by_test_id("solve").click()
    bar = seen(page, "progress")
    assert wait_until(lambda: float(bar.get_attribute("value") or 0) > 0.0)
    started = set(server.processes()) - before
    assert started
    seen(page, "cancel").click()
    page.get_by_test_id("solve-message").filter(has_text="Cancelled").wait_for()
    assert wait_until(lambda: not any(map(alive, started)))
    assert page.get_by_test_id("answer").get_attribute("data-contacts") == "atlas"
    assert number(page, "bearing.capacitance") == formula


@pytest.mark.slow
def test_solved_contacts_replace_the_formula_and_say_by_how_much(open_page, app_server, tmp_path):
    page = open_page(app_server, address_of("/", ROLLERS))
    formula = bearing_by_command(page, tmp_path)
    wait_for_command(page, formula)
    page.get_by_test_id("solve").click()
    page.locator("[data-testid=answer][data-contacts=solved]").wait_for()
    solved = bearing_by_command(page, tmp_path, "solved")
    wait_for_command(page, solved)
    row = page.get_by_test_id("differences").locator("tr", has_text="apacitance")
    row.wait_for()
    change = 100.0 * (solved["bearing"]["capacitance"] / formula["bearing"]["capacitance"] - 1.0)
    assert f"{abs(change):.1f} %" in row.inner_text()
    page.get_by_test_id("other-contacts").click()
    wait_for_command(page, formula)
    assert page.get_by_test_id("answer").get_attribute("data-contacts") == "atlas"
    page.get_by_test_id("other-contacts").click()
    wait_for_command(page, solved)


@pytest.mark.slow
def test_undo_and_redo_by_buttons_and_keys(page):
    wait_for_number(page, "bearing.capacitance", capacitance())
    assert page.get_by_test_id("undo").is_disabled()
    for load in ("900 N", "2700 N"):
        type_into(page, LOAD, load)
        wait_for_number(page, "bearing.capacitance", capacitance(load))
    page.get_by_test_id("undo").click()
    wait_for_number(page, "bearing.capacitance", capacitance("900 N"))
    assert text_of(page, LOAD) == "900 N"
    # The focus is on a button, so that the keys are not those of a text.
    page.keyboard.press("Control+z")
    wait_for_number(page, "bearing.capacitance", capacitance())
    assert text_of(page, LOAD) == "1800 N"
    page.get_by_test_id("redo").click()
    wait_for_number(page, "bearing.capacitance", capacitance("900 N"))
    page.keyboard.press("Control+Shift+z")
    wait_for_number(page, "bearing.capacitance", capacitance("2700 N"))
    wait_for_address(page, "2700")


@pytest.mark.slow
def test_a_link_shows_the_same_in_another_browser(page, open_page, app_server, tmp_path):
    wait_for_number(page, "bearing.capacitance", capacitance())
    type_into(page, LOAD, "1234.5 N")
    page.locator("[data-testid=group-title] > summary").click()
    type_into(page, "title", "Müller & Søn: 'fan' #2")
    wait_for_number(page, "bearing.capacitance", capacitance("1234.5 N"), digits=4)
    page.get_by_test_id("copy-link").click()
    link = page.get_by_test_id("link")
    box = link if link.evaluate("box => box.matches('input')") else link.locator("input")
    box.wait_for()
    address = box.input_value()
    assert address.startswith(f"http://{page.watch.host}/?")
    other = open_page(app_server, address.removeprefix(f"http://{page.watch.host}"))
    wait_for_number(other, "bearing.capacitance", capacitance("1234.5 N"), digits=4)
    files = []
    for name, tab in (("first", page), ("second", other)):
        (tmp_path / name).mkdir()
        files.append(downloaded(tab, "download-toml", tmp_path / name).read_text("utf-8"))
    assert files[0] == files[1]
    assert "Müller" in files[0]


@pytest.mark.slow
def test_the_answer_is_read_and_solved_by_the_keyboard_alone(open_page, app_server):
    # Its balls take half a minute of a processor, far longer than the keys that cancel them.
    page = open_page(app_server)
    complete(page)
    stops = []
    for _ in range(120):
        page.keyboard.press("Tab")
        stops.append(page.evaluate("document.activeElement.dataset.testid || document.activeElement.tagName"))
        if stops[-1] == "solve":
            break
    assert stops[-1] == "solve", stops
    page.keyboard.press("Enter")
    seen(page, "cancel").wait_for()
    for _ in range(20):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.dataset.testid") == "cancel":
            break
    page.keyboard.press("Enter")
    page.get_by_test_id("solve-message").filter(has_text="Cancelled").wait_for()


@pytest.mark.slow
@pytest.mark.parametrize("colors", ["light", "dark"])
def test_the_page_is_read_on_a_narrow_screen_and_in_both_colours(open_page, app_server, colors):
    page = open_page(app_server, width=400, height=800, color_scheme=colors)
    wait_for_number(page, "bearing.capacitance", capacitance())
    assert fits(page)
    back, front = page.evaluate(
        "() => ['backgroundColor', 'color'].map(name => getComputedStyle(document.body)[name]"
        ".match(/[\\d.]+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0) / 3)"
    )
    assert (back < front) is (colors == "dark")
    # Far apart, as a contrast of 4.5 of the W3C takes at least.
    assert abs(back - front) > 128
