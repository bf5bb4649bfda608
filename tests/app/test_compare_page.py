"""Page of two cases: what differs is marked, with the effects between both results of the command."""

import tomllib

import pytest

from ehlectric.app.page_inputs import Inputs
from ehlectric.quantities.formats import amount
from ehlectric.quantities.results import BEARING_BOOK
from tests.app.driving import seen
from tests.app.outputs import address_of, fits, summary_by_command
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import wait_until

pytestmark = pytest.mark.browser


def tables():
    first = tomllib.loads((EXAMPLES / "bearing_6208.toml").read_text(encoding="utf-8"))
    changes = {"bearing.radial_load": "3600 N", "discharge.dielectric_strength": "30 V/um"}
    return first, dict(Inputs(first).changed(changes).table)


def by_command(table, folder):
    """Numbers of the bearing that the command gives for tables without solving."""
    path = folder / "case.toml"
    path.write_text(Inputs(table).toml(), encoding="utf-8")
    return summary_by_command("bearing", path, folder, "--contacts", "atlas")["bearing"]


def cells(page, name):
    """Cells of a result: name, A, B, and the effect."""
    row = seen(page, f"effect-{name}")
    row.wait_for()
    return row.evaluate("row => [...row.cells].map(cell => cell.innerText)")


def assert_effects(page, first, second):
    """The rows of both cases have the numbers of the command, and the change between them."""
    for name, key, unit in (
        ("capacitance-of-the-bearing", "capacitance", "F"),
        ("shaft-voltage", "shaft_voltage", "V"),
        ("minimum-lambda-ratio", "lambda_ratio", ""),
        ("margin-first-breakdown-shaft-voltage", "margin", ""),
    ):
        _, left, right, words = cells(page, name)
        for text, numbers in ((left, first), (right, second)):
            digits = BEARING_BOOK[f"bearing.{key}"].digits
            assert (amount(numbers[key], unit) if unit else f"{numbers[key]:{digits}}") in text, name
        change = 100.0 * (second[key] / first[key] - 1.0)
        sign = "▲ +" if change > 0.0 else "▼ −"
        assert words.startswith(sign), name
        assert float(words.removeprefix(sign).split()[0]) == pytest.approx(abs(change), rel=5e-3), name


@pytest.mark.slow
def test_what_differs_is_marked_with_its_effect_and_can_be_swapped(open_page, app_server, tmp_path):
    one, two = tables()
    page = open_page(app_server, address_of("/compare", {"a": one, "b": two}))
    first, second = by_command(one, tmp_path), by_command(two, tmp_path)
    assert_effects(page, first, second)
    differ = page.get_by_test_id("inputs-differ")
    rows = differ.evaluate("t => [...t.tBodies[0].rows].map(row => [row.dataset.testid, row.className])")
    assert rows == [
        ["input-bearing-radial_load", "differs"],
        ["input-discharge-dielectric_strength", "differs"],
    ]
    assert "≠" in differ.inner_text(), "colours are not the only sign"
    page.get_by_test_id("swap").click()
    load_of_a = page.locator("[data-testid=input-bearing-radial_load] td:nth-of-type(1)")
    load_of_a.filter(has_text="3600 N").wait_for()
    assert_effects(page, second, first)
    page.get_by_test_id("undo").click()
    load_of_a.filter(has_text="1800 N").wait_for()
    assert_effects(page, first, second)
    page.get_by_test_id("a-as-b").click()
    page.get_by_test_id("compared").get_by_text("Both cases have the same inputs").wait_for()
    page.get_by_test_id("undo").click()
    differ.wait_for()


@pytest.mark.slow
def test_a_bearing_is_compared_from_its_page_and_changed_there(page, tmp_path):
    page.get_by_test_id("compare").click()
    page.wait_for_url("**/compare?**")
    page.get_by_test_id("compared").get_by_text("Both cases have the same inputs").wait_for()
    page.get_by_test_id("inputs-b").click()
    box = page.get_by_test_id("form-b").get_by_test_id("field-bearing-radial_load")
    box.fill("3600 N")
    box.press("Tab")
    page.get_by_test_id("input-bearing-radial_load").wait_for()
    one, _ = tables()
    two = dict(Inputs(one).changed({"bearing.radial_load": "3600 N"}).table)
    assert_effects(page, by_command(one, tmp_path), by_command(two, tmp_path))


@pytest.mark.slow
def test_an_axle_is_compared_from_its_page_and_changed_there(open_page, app_server):
    page = open_page(app_server, "/axle")
    page.locator("[data-testid=answer][aria-busy=false]").wait_for()
    page.get_by_test_id("compare").click()
    page.wait_for_url("**/compare?**")
    page.get_by_test_id("compared").get_by_text("Both cases have the same inputs").wait_for()
    page.get_by_test_id("inputs-b").click()
    form = page.get_by_test_id("form-b")
    box = form.get_by_test_id("field-drive-torque")
    box.fill("60 N m")
    box.press("Tab")
    page.get_by_test_id("input-drive-torque").wait_for()
    assert cells(page, "mesh-of-rotor-and-intermediate")[3] != "no change"
    bars = seen(page, "figure-ratios").locator(".barlayer .point")
    assert wait_until(lambda: bars.count() == 14), "seven elements with a breakdown voltage in both"
    # The form follows another name of a shaft.
    form.get_by_test_id("group-shaft-output").locator("summary").first.click()
    name = form.get_by_test_id("field-shaft-3-name")
    name.fill("wheel")
    name.press("Tab")
    form.get_by_test_id("group-shaft-wheel").wait_for()
    assert fits(page)


@pytest.mark.slow
def test_a_wrong_case_is_told_at_its_side_and_has_no_effects(open_page, app_server):
    one, _ = tables()
    wrong = dict(Inputs(one).changed({"bearing.radial_load": "-5 N"}).table)
    page = open_page(app_server, address_of("/compare", {"a": one, "b": wrong}))
    error = page.get_by_test_id("form-b").get_by_test_id("error-bearing-radial_load")
    error.filter(has_text="expected").wait_for()
    verdicts = [page.get_by_test_id(f"side-{name}").get_by_test_id("verdict") for name in "ab"]
    verdicts[1].filter(has_text="No answer").wait_for()
    assert verdicts[1].get_attribute("data-level") == "grey"
    verdicts[0].filter(has_text="reakdown").wait_for()
    assert page.get_by_test_id("compared").locator("tr.differs").count() == 0
