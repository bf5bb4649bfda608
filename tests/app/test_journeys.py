"""Journeys: each page from its first inputs to its final answer, which is that of the command."""

import csv
import json
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

import pytest

from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import AXLE
from ehlectric.app.pages.page_parts import page_texts
from tests.app.driving import type_into, wait_for_address
from tests.app.looks import PLACEHOLDERS, deciding, heading, see_figures, settle
from tests.app.outputs import address_of, command, downloaded
from tests.helpers.places import EXAMPLES, ROOT
from tests.helpers.readable import number_in, verdict_line
from tests.helpers.reports import Page

pytestmark = [pytest.mark.browser, pytest.mark.slow, pytest.mark.gate]

_ANSWER = "[data-testid=answer][aria-busy=false]"


@dataclass(frozen=True)
class Journey:
    """Way through a page: its path, texts that are typed, and what the final answer has."""

    path: str
    figures: tuple[str, ...]  # figures of the final answer
    final: str  # attribute of the final answer
    typed: Mapping[str, str] = field(default_factory=dict)
    table: Mapping[str, Any] = field(
        default_factory=dict
    )  # inputs of its address; none for those of its start
    before: str = "[data-whole=true]"  # attribute of the answer before the button is pressed


# Axle whose discharges are simulated for a short time, with one mitigation measure.
_AXLE = AXLE.changed(
    {
        "drive.duration": "2 ms",
        "breakdown": {"arc_resistance": "10 ohm", "extinction_current": "10 mA", "recovery_time": "100 ns"},
        "remedies": AXLE.value("remedies")[:1],
        **{f"mesh.{number}.contact_resistance": "1 ohm" for number in (1, 2)},
    }
)

JOURNEYS = {
    "bearing": Journey(
        "/",
        ("breakdown", "load", "film", "capacitance"),
        "[data-contacts=solved]",
        {"bearing.base": "nu-205", "bearing.inner_speed": "12000 rpm"},
    ),
    "drive": Journey(
        "/drive", ("remedies", "further"), "[data-simulated=true]", {"drive.duration": "2 ms"}, before=""
    ),
    "gear": Journey(
        "/gear",
        ("film", "flank", "mesh", "path"),
        "[data-solved=true]",
        {"gear.operation.pinion_torque": "60 N*m"},
    ),
    "axle": Journey(
        "/axle", ("ratios", "rates", "shaft-voltages"), "[data-simulated=true]", table=dict(_AXLE.table)
    ),
    "contact": Journey(
        "/contact?contact.geometry=point",
        ("surface", "film-map", "pressure-map", "field-map", "cut-x", "cut-y"),
        "[data-solved=true]",
        {"contact.load": "30 N"},
        before="",
    ),
}


@pytest.mark.parametrize("name", JOURNEYS)
def test_a_page_leads_to_the_answer_of_the_command(open_page, app_server, tmp_path, name):
    journey = JOURNEYS[name]
    page = open_page(app_server, address_of(journey.path, journey.table) if journey.table else journey.path)
    page.locator(_ANSWER + journey.before).wait_for()
    for key, text in journey.typed.items():
        type_into(page, key, text)
        wait_for_address(page, text)
    page.locator(_ANSWER + journey.before).wait_for()
    page.get_by_test_id("solve").click()
    page.locator(_ANSWER + journey.final).wait_for()
    page.evaluate("document.querySelectorAll('.answer details').forEach(part => { part.open = true; })")
    see_figures(page, *(f"figure-{figure}" for figure in journey.figures))
    downloaded(page, "download-toml", tmp_path)
    # The page says how the command solves the file.
    words = page.locator(".downloads code").inner_text().split()
    assert_as_by_command(page, *words[1:], "--no-plots", folder=tmp_path)


def assert_as_by_command(part, *words, folder):
    """A page, or a part of it, has the first words and the number that decides of a command."""
    printed, _ = command(*words, "-o", "out", folder=folder)
    summary = json.loads((folder / "out" / "summary.json").read_text("utf-8"))
    table, _, name = deciding(part)[0].partition(".")
    # The worse end of a drive decides.
    tables = ["drive_end", "non_drive_end"] if table == "end" else [table]
    number = max(summary[table][name] for table in tables)
    assert_same(part, verdict_line(printed), number)
    assert heading(part)[1] == summary["verdict_level"]


def assert_same(part, line, number):
    """A page, or a part of it, has the words of a line without the operating point, and a number."""
    words, _ = heading(part)
    assert re.fullmatch(rf"{re.escape(words)}( at .*\d.*)?", line), (words, line)
    _, text = deciding(part)
    assert abs(number_in(text) - number) < 0.51 * last_place(text), (text, number)


def last_place(text):
    """Value of 1 in the last place of a number: "0.97" has 0.01, and "30 100" of three digits has 100."""
    _, point, decimals = text.partition(".")
    return 10.0 ** (-len(decimals) if point else max(0, len(re.findall(r"\d", text)) - 3))


# Keeps all notes of a map, also those that are there for a moment.
_KEEP_NOTES = """
() => {
  const note = document.querySelector('[data-testid=map-note]');
  window.notes = [];
  new MutationObserver(() => window.notes.push(note.innerText))
    .observe(note, {childList: true, characterData: true, subtree: true});
}
"""


def test_a_sweep_shows_its_points_again_after_they_have_changed(open_page, app_server, tmp_path):
    """The page looks at points while they are solved, when all are solved, and after a run of other ones."""
    page = open_page(app_server, "/sweep")
    plan, margins = page.get_by_test_id("plan"), []
    plan.filter(has_text="64 points").wait_for()
    page.evaluate(_KEEP_NOTES)
    for points, typed in (
        (64, {}),
        (12, {"vary.0.to": "12000 rpm", "vary.0.count": "4", "vary.1.count": "3"}),
    ):
        for key, text in typed.items():
            type_into(page, key, text)
        plan.filter(has_text=f"{points} points").wait_for()
        page.locator("[data-testid=solve]:not([disabled])").click()
        page.get_by_test_id("progress").filter(has_text=f"{points} of {points} points done").wait_for()
        folder = tmp_path / f"{points}"
        folder.mkdir()
        seen = see_figures(page, "map")
        file = downloaded(page, "download-toml", folder)
        printed, _ = command("sweep", file, "-o", "out", folder=folder)
        with (folder / "out" / "sweep.csv").open(newline="", encoding="utf-8") as table:
            rows = [row["bearing.margin [-]"] for row in csv.DictReader(table)]
        assert len(rows) == points
        known = [float(margin) for margin in rows if margin]
        assert seen["map"]["cells"] == len(known)
        assert_same(page, verdict_line(printed), min(known))
        margins.append(deciding(page))
    assert margins[0] != margins[1]
    assert any(re.search(r"\d open", note) for note in page.evaluate("window.notes")), (
        "no look at open points"
    )


def test_two_files_are_compared_and_swapped(open_page, app_server, tmp_path):
    files = {"a": EXAMPLES / "bearing_6314.toml", "b": EXAMPLES / "bearing_four_point.toml"}
    titles = {name: tomllib.loads(file.read_text("utf-8"))["title"] for name, file in files.items()}
    page = open_page(app_server, "/compare")
    page.get_by_test_id("upload-b").locator("input").set_input_files(EXAMPLES / "gear_pair.toml")
    page.get_by_test_id("error-b").filter(has_text="belongs to the page /gear").wait_for()
    for name, file in files.items():
        page.get_by_test_id(f"upload-{name}").locator("input").set_input_files(file)
        page.get_by_test_id(f"title-{name}").filter(has_text=titles[name]).wait_for()
    assert not page.get_by_test_id("error-b").inner_text()
    for places in ("ab", "ba"):
        page.get_by_test_id("title-a").filter(has_text=titles[places[0]]).wait_for()
        see_figures(page, "figure-over-speed", "figure-films")
        for place, name in zip("ab", places, strict=True):
            folder = tmp_path / f"{places}-{place}"
            folder.mkdir()
            words = ("bearing", files[name], "--contacts", "atlas", "--no-plots")
            assert_as_by_command(page.get_by_test_id(f"side-{place}"), *words, folder=folder)
        page.get_by_test_id("swap").click()


def test_a_file_its_link_and_its_report_have_one_answer(open_page, app_server, tmp_path):
    table = tomllib.loads((EXAMPLES / "bearing_6208.toml").read_text("utf-8"))
    file = tmp_path / "saved.toml"
    file.write_text(Inputs(table).changed({"bearing.radial_load": "2500 N"}).toml(), "utf-8")
    page = open_page(app_server)
    page.locator(f"{_ANSWER}[data-whole=true]").wait_for()
    page.get_by_test_id("upload-case").locator("input").set_input_files(file)
    wait_for_address(page, "2500 N")
    settle(page)
    assert_as_by_command(page, "bearing", file, "--contacts", "atlas", "--no-plots", folder=tmp_path)
    answer = numbers(page)
    page.get_by_test_id("copy-link").click()
    link = page.get_by_test_id("link")
    box = link if link.evaluate("box => box.matches('input')") else link.locator("input")
    box.wait_for()
    other = open_page(app_server, box.input_value().removeprefix(f"http://{page.watch.host}"))
    other.locator(f"{_ANSWER}[data-whole=true]").wait_for()
    settle(other)
    assert numbers(other) == answer
    words, label = heading(page)[0], page.locator(".deciding .name > div").first.inner_text()
    report = Page(downloaded(other, "download-report-html", tmp_path).read_text("utf-8")).text
    shown = re.search(rf"{re.escape(words)} .*?{re.escape(label)} ([\d.]+)", report)
    assert shown, (words, label, report[:2000])
    assert abs(float(shown[1]) - number_in(deciding(page)[1])) < 0.51 * last_place(shown[1])


def numbers(page):
    """First words, the number that decides, and the table of all numbers."""
    return heading(page), deciding(page), page.get_by_test_id("numbers").inner_text()


def test_every_page_has_a_journey():
    """Two journeys are tests of their own."""
    assert {urlsplit(journey.path).path for journey in JOURNEYS.values()} | {"/sweep", "/compare"} == {
        *page_texts("links")
    }


def test_every_placeholder_is_a_text_of_the_package():
    """A text that no page shows any more would find nothing."""
    package = ROOT / "src" / "ehlectric"
    paths = [path for end in ("py", "toml", "css") for path in package.rglob(f"*.{end}")]
    source = "".join(path.read_text("utf-8") for path in paths)
    assert [text for text in PLACEHOLDERS if text not in source] == []
