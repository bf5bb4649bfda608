"""Page of a sweep: its map fills, stops and resumes, and its database is that of the command."""

import csv
import json
import re
import sqlite3
import tomllib
from contextlib import closing

import openpyxl
import pytest
from scipy.io import loadmat

from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.form_fields.field import in_field_unit
from tests.app.driving import seen, type_into, wait_for_address, wait_for_number
from tests.app.outputs import address_of, command, downloaded
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import PATIENCE, alive, wait_until

pytestmark = pytest.mark.browser

SPEED, LOAD = "bearing.inner_speed", "bearing.radial_load"


def sweep(count):
    """Sweep of the example of a bearing by formula, with smooth films and so many values of each input."""
    case = tomllib.loads((EXAMPLES / "bearing_6208.toml").read_text(encoding="utf-8"))
    case["bearing"]["summit_height"] = 0
    vary = {
        "inner_speed": {"from": "600 rpm", "to": "6000 rpm", "count": count, "spacing": "log"},
        "radial_load": {"from": "500 N", "to": "8000 N", "count": count},
    }
    return {"case": case | {"contacts": "formula"}, "vary": {"bearing": vary}}


def run(page):
    """Press Run or Resume, once it can be pressed."""
    page.locator("[data-testid=solve]:not([disabled])").click()


def wait_for_points(page, text):
    # Points are solved one after the other, each in some tenths of a second of a processor.
    page.get_by_test_id("map-note").filter(has_text=text).wait_for(timeout=5e3 * PATIENCE)


def rows_of(path):
    """Rows of a sweep's table without the computing time, which differs between two runs."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [{key: value for key, value in row.items() if key != "seconds [s]"} for row in rows]


def points_of(path):
    """All rows of a database by table, without the date of the last run."""
    with closing(sqlite3.connect(path)) as database, database:
        names = [name for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        rows = {name: list(database.execute(f'SELECT * FROM "{name}"')) for name in names}
    return {name: [row for row in found if row[0] != "date"] for name, found in rows.items()}


def cells_of(path):
    """Texts in the cells of all tables of a report."""
    return re.findall(r"<td[^>]*>(.*?)</td>", path.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.slow
def test_a_map_fills_and_its_database_is_that_of_the_command(open_page, app_server, tmp_path):
    page = open_page(app_server, address_of("/sweep", sweep(4)))
    page.get_by_test_id("plan").filter(has_text="16 points").wait_for()
    run(page)
    wait_for_points(page, "16 solved")
    table = downloaded(page, "download-csv", tmp_path)
    base = downloaded(page, "download-sqlite", tmp_path)
    case = downloaded(page, "download-toml", tmp_path)
    command("sweep", case, "-o", "by_command", "--quiet", folder=tmp_path)
    own = tmp_path / "by_command"
    assert rows_of(table) == rows_of(own / "sweep.csv")
    # The command finds all points of the page in its database: they have the same keys.
    other = tmp_path / "of_page"
    other.mkdir()
    (other / "sweep.sqlite").write_bytes(base.read_bytes())
    before = points_of(other / "sweep.sqlite")
    command("sweep", case, "-o", other, "--quiet", folder=tmp_path)
    assert points_of(other / "sweep.sqlite") == before
    assert (other / "sweep.csv").read_text() == table.read_text()
    report = downloaded(page, "download-report-html", tmp_path)
    command("report", other, "-o", "own.html", folder=tmp_path)
    assert len(cells_of(report)) > 100
    assert cells_of(report) == cells_of(tmp_path / "own.html")
    workbook = openpyxl.load_workbook(downloaded(page, "download-xlsx", tmp_path))
    assert workbook["table"].max_row == 1 + 16
    assert loadmat(downloaded(page, "download-mat", tmp_path))["bearing_capacitance"].size == 16


@pytest.mark.slow
def test_a_sweep_stops_and_resumes_with_the_points_that_are_done(own_server, open_page):
    # With the probability of each point a run is far from its end when it is stopped.
    server = own_server()
    page = open_page(server, address_of("/sweep", sweep(11) | {"uncertainty_samples": 256}))
    page.get_by_test_id("plan").filter(has_text="121 points").wait_for()
    before = set(server.started())
    run(page)
    state = page.get_by_test_id("progress")
    state.filter(has_text=re.compile(r"^[1-9]\d* of 121")).wait_for()
    started = set(server.processes()) - before
    seen(page, "cancel").click()
    state.filter(has_text="Stopped").wait_for()
    assert wait_until(lambda: not any(map(alive, started)))
    note = page.get_by_test_id("map-note")
    note.filter(has_text="open").wait_for()
    kept = int(note.inner_text().partition(" solved")[0].rpartition(" ")[2])
    assert 0 < kept < 121
    assert page.get_by_test_id("solve").inner_text() == "Resume"
    run(page)
    page.wait_for_function(
        "kept => [...document.querySelectorAll('[data-testid=progress]')].some(e => "
        "{ const found = e.innerText.match(/^(\\d+) of 121/); return found && Number(found[1]) >= kept })",
        arg=kept,
    )
    wait_for_points(page, "121 solved")
    assert page.get_by_test_id("solve").is_disabled()


@pytest.mark.slow
def test_a_sweep_that_was_stopped_at_once_does_not_show_the_one_before_as_its_own(open_page, app_server):
    page = open_page(app_server, address_of("/sweep", sweep(2)))
    page.get_by_test_id("plan").filter(has_text="4 points").wait_for()
    run(page)
    wait_for_points(page, "4 solved")
    # With so many points more the run is not over before it is stopped.
    type_into(page, "vary.1.count", "20")
    page.get_by_test_id("plan").filter(has_text="40 points").wait_for()
    type_into(page, "vary.1.to", "7 kN")
    wait_for_address(page, "7 kN")
    wait_for_points(page, "The inputs have changed")
    run(page)
    seen(page, "cancel").click()
    page.get_by_test_id("progress").filter(has_text="Stopped").wait_for()
    # As fast as that, the run has not begun to write, or it has no more than the points of both sweeps.
    note = page.get_by_test_id("map-note").inner_text()
    assert "The inputs have changed" in note or "open" in note
    assert not page.get_by_test_id("solve").is_disabled()
    assert page.get_by_test_id("download-csv").is_disabled() == ("have changed" in note)
    run(page)
    wait_for_points(page, "40 solved")
    assert page.get_by_test_id("points").count() == 1


@pytest.mark.slow
def test_a_point_opens_its_case_with_the_same_numbers(open_page, app_server, tmp_path):
    page = open_page(app_server, address_of("/sweep", sweep(2)))
    page.get_by_test_id("plan").filter(has_text="4 points").wait_for()
    run(page)
    wait_for_points(page, "4 solved")
    table = rows_of(downloaded(page, "download-csv", tmp_path))
    page.get_by_test_id("map").focus()
    for number in (0, 2):
        page.keyboard.press("ArrowRight")
        page.get_by_test_id("point").filter(has_text=f"Point {number}").wait_for()
    link = page.get_by_test_id("open-point")
    link.wait_for()
    opened = open_page(app_server, link.get_attribute("href"))
    row = table[2]
    wait_for_number(opened, "bearing.capacitance", 1e12 * float(row["bearing.capacitance [F]"]), digits=4)
    wait_for_number(opened, "bearing.margin", float(row["bearing.margin [-]"]))
    case = downloaded(opened, "download-toml", tmp_path)
    numbers = json.loads(command("bearing", case, "--json", "--no-plots", "-o", "out", folder=tmp_path)[0])
    # Points that are solved together share tables of their gaps, and the command solves one alone.
    for key, column in (("capacitance", "bearing.capacitance [F]"), ("margin", "bearing.margin [-]")):
        assert numbers["bearing"][key] == pytest.approx(float(row[column]), rel=1e-8)


@pytest.mark.slow
def test_a_click_on_the_map_opens_the_point_in_a_new_tab(open_page, app_server):
    page = open_page(app_server, address_of("/sweep", sweep(2)))
    page.get_by_test_id("plan").filter(has_text="4 points").wait_for()
    run(page)
    wait_for_points(page, "4 solved")
    page.get_by_test_id("number-sweep.margin").wait_for()  # Its place is above the map.
    layer = page.get_by_test_id("map").locator(".nsewdrag")
    layer.scroll_into_view_if_needed()

    def clicked():
        """Click where the map is now; it follows the width of the page in its own time."""
        box = layer.bounding_box()
        page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + 0.75 * box["height"])
        return wait_until(lambda: page.wait_for_timeout(50) or len(page.context.pages) > 1, seconds=10.0)

    assert wait_until(clicked)
    opened = page.context.pages[1]
    opened.get_by_test_id("number-bearing.capacitance").wait_for()
    assert "/?" in opened.url


@pytest.mark.slow
def test_a_wrong_range_is_told_beside_its_field(open_page, app_server, tmp_path):
    page = open_page(app_server, address_of("/sweep", sweep(2)))
    page.get_by_test_id("plan").filter(has_text="4 points").wait_for()
    type_into(page, "vary.0.from", "600 kg")
    error = page.get_by_test_id("error-vary-0-from")
    error.filter(has_text="600 kg").wait_for()
    case = downloaded(page, "download-toml", tmp_path)
    _, told = command("sweep", case, "-o", "out", folder=tmp_path, status=2)
    shown = next(one for group in BEARING_GROUPS for one in group.fields if one.key == SPEED)
    assert " ".join(error.inner_text().split()) in in_field_unit(shown, " ".join(told.split()))
    assert page.get_by_test_id("solve").is_disabled()


@pytest.mark.slow
def test_the_probability_of_breakdown_is_asked_for_by_showing_it(open_page, app_server, tmp_path):
    """Its samples are in the sweep file from then on; another result of the same points needs no new run."""
    page = open_page(app_server, address_of("/sweep", sweep(2)))
    page.get_by_test_id("plan").filter(has_text="4 points").wait_for()
    choose_result(page, "Probability of breakdown")
    wait_for_address(page, "uncertainty_samples=256")
    page.get_by_test_id("plan").filter(has_text="4 points").wait_for()
    run(page)
    wait_for_points(page, "4 solved")
    case = tomllib.loads(downloaded(page, "download-toml", tmp_path).read_text(encoding="utf-8"))
    assert case["uncertainty_samples"] == 256
    rows = rows_of(downloaded(page, "download-csv", tmp_path))
    assert [row["uncertainty.samples [-]"] for row in rows] == ["256"] * 4
    choose_result(page, "Lambda ratio")
    wait_for_address(page, "show=bearing.lambda_ratio")
    assert "uncertainty_samples=256" in page.url
    assert page.get_by_test_id("solve").is_disabled()


def choose_result(page, name):
    """Choose what the map shows by the beginning of its name."""
    page.get_by_test_id("field-show").click()
    page.get_by_test_id("field-show").fill(name)
    page.get_by_role("option", name=re.compile(f"^{name}", re.IGNORECASE)).first.click()
