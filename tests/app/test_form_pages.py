"""Form of the pages as a user fills it in: search, own values that come back, units, and the keyboard."""

import tomllib

import pytest

from tests.app.driving import complete, field, type_into, wait_for_address, wait_for_number
from tests.app.outputs import address_of, downloaded
from tests.app.test_first_page import capacitance
from tests.helpers.places import EXAMPLES

pytestmark = pytest.mark.browser

EXAMPLE = EXAMPLES / "bearing_6208.toml"


def search(page, text):
    """Names of the entries that a search for a bearing finds."""
    box = field(page, "bearing.base")
    box.click()
    box.fill(text)
    options = page.locator('[data-testid^="option-"]')
    options.first.wait_for()
    return [one.get_attribute("data-testid").removeprefix("option-") for one in options.all()]


@pytest.mark.slow
@pytest.mark.gate
def test_a_bearing_is_found_by_the_names_of_makers(page):
    for name in ("6208-2RS", "6208-2Z", "6208 ZZ", "6208 C3", "6208-2RS1/C3", "6208"):
        assert "6208" in search(page, name), name
    assert search(page, "4711-2Z") == ["~own"]
    told = page.get_by_role("listbox").inner_text()
    assert "not in the list" in told
    # Enter looks the designation up, and the page says that there is no such bearing.
    box = field(page, "bearing.base")
    box.press("Enter")
    error = page.get_by_test_id("error-bearing-base")
    error.filter(has_text="'4711-2Z'").wait_for()
    assert search(page, "6208")
    box.press("Enter")
    error.wait_for(state="detached")
    assert "6208" in box.input_value()


@pytest.mark.slow
def test_a_typed_designation_is_read_and_not_an_entry_that_contains_its_letters(page):
    """Letters as E and C are in the labels of entries: "6308 E" became a 6308, and "7208 C" a 7208-B."""
    box, error = field(page, "bearing.base"), page.get_by_test_id("error-bearing-base")
    for text, says in (
        ("6308 E", "reinforced set"),
        ("7208", "the letter of its contact angle"),
        ("22210 E", "spherical roller"),
        ("6316/C3VL0241", "bearing.coating"),
    ):
        search(page, text)
        box.press("Enter")
        error.filter(has_text=says).wait_for()
    for text, address in (
        ("7208 C", "base=7208-c"),
        ("skf nu 208 ecp", "base=nu-208"),
        ("6208DDUCM", "clearance_class=CM"),
        ("6208-2Z/C3WT", "clearance_class=C3"),
    ):
        search(page, text)
        box.press("Enter")
        wait_for_address(page, address)
        error.wait_for(state="detached")


@pytest.mark.slow
def test_a_designation_keeps_its_class_and_a_kind_its_first_values(page, tmp_path):
    """Class and roughness of the page, its address and its file are those of the designation and its kind."""
    wait_for_number(page, "bearing.capacitance", capacitance())
    box, note = field(page, "bearing.base"), page.get_by_test_id("form-note")
    for name, chosen in (("6208-C3", "Enter"), ("6306 C4", "6306"), ("6208", "Enter")):
        search(page, name)
        if chosen == "Enter":
            box.press("Enter")
        else:
            page.get_by_test_id(f"option-{chosen}").click()
        expected = {"6208-C3": "C3", "6306 C4": "C4", "6208": "CN"}[name]
        wait_for_address(page, f"clearance_class={expected}")
        assert "radial_clearance" not in page.url
    box.click()
    box.fill("32008 X")
    box.press("Enter")
    wait_for_address(page, "composite_rq=0.1 um")
    note.filter(has_text="from 0.03 µm to 0.1 µm").wait_for()
    page.get_by_test_id("switch-pair").check()
    assert field(page, "bearing.composite_rq").input_value() == "0.1 µm"
    written = tomllib.loads(downloaded(page, "download-toml", tmp_path).read_text(encoding="utf-8"))
    assert written["bearing"]["composite_rq"] == "0.1 um"
    # The note stays until the kind changes again, and what the user has set stays for good.
    assert note.is_visible()
    type_into(page, "bearing.composite_rq", "0.2 um")
    search(page, "6208")
    box.press("Enter")
    wait_for_address(page, "base='6208'")
    assert field(page, "bearing.composite_rq").input_value() == "0.2 µm"


@pytest.mark.slow
def test_a_designation_is_shown_and_written_as_typed(page, tmp_path):
    """Its own field shows the typed text, and changes the bearing; another bearing has no such field."""
    box, typed = field(page, "bearing.base"), page.get_by_test_id("field-bearing-designation")
    assert not typed.is_visible()
    search(page, "skf 6208-2rs1/c3")
    box.press("Enter")
    typed.wait_for()
    assert field(page, "bearing.designation").input_value() == "SKF 6208-2RS1/C3"
    written = tomllib.loads(downloaded(page, "download-toml", tmp_path).read_text(encoding="utf-8"))
    assert (written["bearing"]["base"], written["bearing"]["designation"]) == ("6208", "SKF 6208-2RS1/C3")
    type_into(page, "bearing.designation", "fag 6306/c4")
    wait_for_address(page, "base='6306'")
    wait_for_address(page, "clearance_class=C4")
    assert field(page, "bearing.designation").input_value() == "FAG 6306/C4"
    search(page, "6208")
    box.press("Enter")
    typed.wait_for(state="detached")
    wait_for_address(page, "base='6208'")


@pytest.mark.slow
def test_values_of_a_group_and_an_own_oil_come_back(page):
    wait_for_number(page, "bearing.capacitance", capacitance())
    type_into(page, "motor.common_mode_voltage", "123 V")
    type_into(page, "lubricant.relative_permittivity", "2.2")
    page.get_by_test_id("tells-oil").filter(has_text="Roelands", has_not_text="permittivity").wait_for()
    switch = page.get_by_test_id("switch-motor")
    switch.uncheck()
    # The box may be gone before it can be looked at.
    page.get_by_test_id("field-motor-common_mode_voltage").wait_for(state="detached")
    switch.check()
    field(page, "motor.common_mode_voltage").wait_for()
    assert field(page, "motor.common_mode_voltage").input_value() == "123 V"
    for name in ("fva-3", "~own"):
        field(page, "lubricant.base").click()
        page.get_by_test_id(f"option-{name}").click()
        page.get_by_test_id("tells-oil").wait_for(state="attached" if name == "~own" else "detached")
    assert field(page, "lubricant.relative_permittivity").input_value() == "2.2"


@pytest.mark.slow
def test_a_long_number_is_short_in_its_box_and_whole_in_the_file(open_page, app_server, tmp_path):
    table = {"bearing": {"base": "6208", "inner_speed": "181.37993642342187 rad/s", "temperature": "70 degC"}}
    page = open_page(app_server, address_of("/", table))
    speed = field(page, "bearing.inner_speed")
    assert speed.input_value() == "1732.0508 rpm"
    assert speed.get_attribute("title") == "181.37993642342187 rad/s"
    speed.focus()
    speed.press("Enter")
    temperature = field(page, "bearing.temperature")
    assert temperature.input_value() == "70 °C"
    temperature.fill("71 °C")
    temperature.press("Tab")
    page.wait_for_function("() => location.search.includes('71')")
    text = downloaded(page, "download-toml", tmp_path).read_text("utf-8")
    assert "181.37993642342187 rad/s" in text
    assert '"71 degC"' in text


_FOCUSED = """() => {
  const e = document.activeElement, style = getComputedStyle(e), box = e.getBoundingClientRect();
  return {
    name: e.tagName, test: e.dataset.testid || "", hidden: !!e.closest("[aria-hidden=true]"),
    outline: style.outlineStyle, wide: parseFloat(style.outlineWidth), size: box.width * box.height,
  };
}"""


@pytest.mark.slow
def test_the_focus_is_seen_and_never_lost(page):
    complete(page)
    page.locator("main.page").focus()
    stops = []
    for _ in range(24):
        page.keyboard.press("Tab")
        stops.append(page.evaluate(_FOCUSED))
    assert "BODY" not in [one["name"] for one in stops]
    assert not any(one["hidden"] or one["size"] < 16 for one in stops), stops
    buttons = [one for one in stops if one["test"] in ("copy-link", "compare", "vary", "open-case")]
    assert len(buttons) == 4
    assert all(one["outline"] != "none" and one["wide"] >= 1 for one in buttons), buttons


@pytest.mark.slow
def test_messages_do_not_move_the_page(page):
    complete(page)
    page.evaluate("window.scrollTo(0, 0)")
    form = page.get_by_role("form", name="Inputs")
    before = form.bounding_box()
    page.get_by_test_id("copy-link").click()
    page.get_by_test_id("toast").filter(has_text="link").wait_for()
    assert form.bounding_box() == before
    type_into(page, "bearing.radial_load", "2 kN")
    page.evaluate("window.scrollTo(0, 0)")
    page.get_by_test_id("undo").click()
    page.get_by_test_id("toast").filter(has_text="Undone").wait_for()
    assert form.bounding_box() == before


@pytest.mark.slow
@pytest.mark.parametrize(
    ("writes", "text"),
    [("setTimeout(done, 1500)", "Link copied"), ("", "Copy the link from the field.")],
    ids=["late", "never"],
)
def test_a_browser_that_takes_its_time_over_the_link(page, writes, text):
    """As one that draws figures without a graphics card, or asks its user first."""
    wait_for_number(page, "bearing.capacitance", capacitance())
    page.evaluate(f"() => {{ navigator.clipboard.writeText = () => new Promise((done) => {{ {writes} }}) }}")
    page.get_by_test_id("copy-link").click()
    page.get_by_test_id("toast").filter(has_text=text).wait_for()
    assert page.get_by_test_id("link").input_value().startswith(f"{page.url}?")


@pytest.mark.slow
def test_the_short_answer_leads_to_the_answer_on_a_phone(open_page, app_server):
    page = open_page(app_server, "/", width=400, height=800)
    complete(page)
    answer = page.locator("section.answer")
    assert answer.bounding_box()["y"] > 800
    page.get_by_test_id("to-answer").click()
    page.wait_for_function("() => document.querySelector('section.answer').getBoundingClientRect().top < 200")
    bar = page.get_by_test_id("strip").bounding_box()
    assert bar["y"] + bar["height"] <= answer.bounding_box()["y"] + 1


@pytest.mark.slow
def test_a_text_typed_into_a_search_is_taken_with_the_tabulator(page):
    """A grade, a designation and a text that is no entry are taken; words that find several are dropped."""
    wait_for_number(page, "bearing.capacitance", capacitance())
    box = field(page, "bearing.base")
    search(page, "6210")
    box.press("Tab")
    wait_for_address(page, "base='6210'")
    search(page, "deep groove")
    box.press("Tab")
    assert "6210" in box.input_value()
    oil = field(page, "lubricant.base")
    oil.click()
    page.get_by_text("From a data sheet", exact=True).first.click()
    page.get_by_test_id("field-lubricant-temperature-way_40").select_option(label="ISO viscosity grade")
    grade, error = field(page, "lubricant.temperature.iso_vg"), page.get_by_test_id
    for text in ("68", "100"):
        grade.click()
        grade.press_sequentially(text)
        grade.press("Tab")
        wait_for_address(page, f"iso_vg={text}")
        assert grade.input_value() == text
    grade.click()
    grade.press_sequentially("70")
    grade.press("Tab")
    error("error-lubricant-temperature-iso_vg").filter(has_text="70").wait_for()
