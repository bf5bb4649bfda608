"""The first page of a report: numbers of summary.json, what to measure first, and one page of A4."""

import json
import re
import tomllib
from dataclasses import replace

import pytest
from reportlab.lib.pagesizes import A4
from reportlab.lib.units import mm
from reportlab.platypus import LongTable

from ehlectric import BearingCase, DriveCase, save, solve, solve_drive, write_report
from ehlectric.cases.input_keys import unit_of
from ehlectric.cases.table_edits import flattened
from ehlectric.quantities.inputs import end_and_key
from ehlectric.quantities.rows import Row
from ehlectric.quantities.units import to_si
from ehlectric.readable import ratio_text
from ehlectric.report.appendix import named
from ehlectric.report.build import report_of
from ehlectric.report.first_page import life_texts
from ehlectric.report.pdf import first_page, pdf_of
from ehlectric.report.report_content import Light, Numbers, Picture, Table, Text
from ehlectric.report.written_report import html_of
from ehlectric.runtime.display import is_number
from ehlectric.tables.probability_rows import input_range
from tests.helpers.drives import drive_with_remedy
from tests.helpers.places import EXAMPLES
from tests.helpers.readable import number_in
from tests.helpers.reports import Page

BEARINGS = ("bearing_6208", "bearing_thin_oil", "bearing_greased")


def solved(name):
    """Result of an example, with contacts from the atlas; the drive is simulated for a tenth of its time."""
    if name == "drive":
        return solve_drive(
            DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"drive.duration": 0.02}), workers=1
        )
    return solve(BearingCase.from_toml(EXAMPLES / f"{name}.toml").replace({"contacts": "atlas"}))


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Folder, summary.json and first page of each example, made when it is first asked for."""
    known = {}

    def page(name):
        if name not in known:
            folder = tmp_path_factory.mktemp(name)
            save(solved(name), folder)
            known[name] = (
                folder,
                json.loads((folder / "summary.json").read_text()),
                report_of(folder, summary=True),
            )
        return known[name]

    return page


def blocks(report, kind):
    return [block for block in report.sections[0].blocks if isinstance(block, kind)]


def numbers_of(report):
    (found,) = blocks(report, Numbers)
    return {
        label: (value.replace("\xa0", " "), note.replace("\xa0", " ")) for label, value, note in found.numbers
    }


def tables_of(report):
    return {table.caption: table for table in blocks(report, Table)}


LIFE = "Rating life at the operating point"
RANKED = "Measure first: the inputs that matter most"
MEASURE = "Measure first: inputs behind the answer, not ranked"


@pytest.mark.slow
@pytest.mark.parametrize("name", [*BEARINGS, "drive"])
def test_it_is_one_page_in_full_size(pages, name):
    _, summary, report = pages(name)
    assert len(report.sections) == 1
    content = pdf_of(report)
    assert len(re.findall(rb"/Type /Page\b", content)) == 1
    # The letters are as large as those of the other pages; a drive has twice the numbers, and a wide figure.
    assert first_page(report).scale >= (0.9 if name == "drive" else 1.0)
    page = Page(html_of(report))
    assert summary["title"] in page.text
    (light,) = [one["class"] for one in page.of("div") if "light" in one.get("class", "")]
    level = summary["level"] if name == "drive" else summary["margin"]["level"]
    assert light == f"light {level}"
    assert len(page.of("img")) == 1
    assert summary["version"] in page.text
    assert not page.of("nav")


@pytest.mark.slow
def test_numbers_of_a_bearing_with_a_margin(pages):
    _, summary, report = pages("bearing_6208")
    found, bearing, spread = numbers_of(report), summary["bearing"], summary["uncertainty"]
    margin, note = found["Margin (first breakdown / shaft voltage)"]
    assert margin == ratio_text(bearing["margin"])
    low, high = map(ratio_text, (spread["margin_low"], spread["margin_high"]))
    assert note.startswith(f"margin in 90 of 100 cases {low} to {high}")
    assert found["Probability of breakdown"][0] == f"{100.0 * spread['breakdown_probability']:.2g} %"
    assert found["Shaft voltage"][0] == f"{bearing['shaft_voltage']:.3g} V"
    assert found["First breakdown voltage"][0] == f"{bearing['first_break']:.3g} V"
    (picture,) = blocks(report, Picture)
    assert picture.name == "breakdown_over_speed"
    machine = blocks(report, Text)[0].text.replace("\xa0", " ")
    for text in (
        "6208",
        "1800 N radial and 300 N axial",
        "3000 rpm",
        "70 °C",
        "46 mm²/s at 40 °C",
        "300 V",
        "20 pF",
    ):
        assert text in machine


@pytest.mark.slow
def test_what_to_measure_first_are_the_largest_shares(pages):
    _, summary, report = pages("bearing_6208")
    largest = sorted(summary["uncertainty"]["indices"], key=lambda one: -one["total"])[:3]
    rows = tables_of(report)[RANKED].rows
    assert [row[0] for row in rows] == [one["label"] for one in largest]
    assert [row[2].replace("\xa0", " ") for row in rows] == [input_range(one) for one in largest]
    assert rows[0][1] == "20\xa0pF"
    assert [row[3].split("\xa0")[0] for row in rows] == [f"{100.0 * one['total']:.2g}" for one in largest]


@pytest.mark.slow
def test_inputs_that_decide_the_margin_are_called_inputs(pages):
    """Ends of ranges of uncertain inputs are no remedies: the table shows the margins at both ends."""
    _, summary, report = pages("bearing_6208")
    (table,) = [one for caption, one in tables_of(report).items() if caption.startswith("Inputs that decide")]
    assert "raise the margin" not in Page(html_of(report)).text
    largest = summary["margin"]["effects"][:4]
    assert [(row[0], row[2].replace("\xa0", " "), row[3]) for row in table.rows] == [
        (
            one["label"],
            input_range(one),
            f"{ratio_text(one['low_margin'])} to {ratio_text(one['high_margin'])}",
        )
        for one in largest
    ]
    rows = {row[0]: row for row in table.rows}
    # Capacitive divider with 10 and 30 pF from winding to rotor: the shaft has C / (C + rest).
    own, ratio = summary["bearing"]["margin"], summary["bearing"]["bearing_voltage_ratio"]
    rest = 20.0 / ratio - 20.0
    ends = [own * ratio * (one + rest) / one for one in (10.0, 30.0)]
    low, high = rows["winding-rotor capacitance"][3].split(" to ")
    assert [float(low), float(high)] == pytest.approx(ends, abs=0.006)


@pytest.mark.slow
def test_a_bearing_that_touches_has_no_margin(pages):
    _, summary, report = pages("bearing_thin_oil")
    found = numbers_of(report)
    assert not any("argin" in label for label in found)
    assert found["First breakdown voltage"][0] == "not computed"
    assert found["Minimum lambda ratio"][0] == f"{summary['bearing']['lambda_ratio']:.3g}"
    (light,) = blocks(report, Light)
    assert light.words == "Discharges likely"
    assert any(block.text.startswith("No margin is known") for block in blocks(report, Text))
    assert [row[0] for row in tables_of(report)[MEASURE].rows] == [
        "composite roughness Rq", "temperature of the oil", "height of the highest summits",
    ]  # fmt: skip


@pytest.mark.slow
def test_a_bearing_without_a_motor_has_a_breakdown_voltage(pages):
    _, summary, report = pages("bearing_greased")
    found = numbers_of(report)
    assert found["First breakdown voltage"][0] == f"{summary['bearing']['first_break']:.3g} V"
    assert list(tables_of(report)) == [MEASURE]
    rows = tables_of(report)[MEASURE].rows
    assert rows[0][:3] == ("dielectric strength", "15\xa0V/µm", "12 to 18\xa0V/µm")
    machine = blocks(report, Text)[0].text
    assert "grease with oil" in machine
    assert "winding" not in machine


def life_of(report, place=""):
    """Texts of the rating life by symbol; ``place``, end of a drive."""
    lead = f"{LIFE}, {place}: " if place else f"{LIFE}: "
    (text,) = [one.text for one in blocks(report, Text) if one.text.startswith(lead)]
    parts = text.removeprefix(lead).removesuffix(".").replace("\xa0", " ").split("; ")
    return dict(part.replace("= ", "").split(" ", 1) for part in parts)


@pytest.mark.slow
def test_rating_lives_stand_next_to_their_inputs(pages):
    _, summary, report = pages("bearing_greased")
    found, life = life_of(report), summary["life"]
    assert number_in(found["C"]) == pytest.approx(life["dynamic_rating"], rel=5e-3)
    assert number_in(found["C0"]) == pytest.approx(life["static_rating"], rel=5e-3)
    assert found["Cu"].startswith(f"{life['fatigue_load_limit']:.3g} N")
    assert found["P"].startswith("1800 N")
    assert found["ν1"].startswith(f"{4500.0 / (6000.0 * 60.0) ** 0.5:.3g} mm²/s")
    assert found["κ"].startswith(f"{life['viscosity_ratio']:.3g}")
    for symbol, key in (("L10", "basic_life"), ("Lnmr", "reference_modified_life")):
        hours = life[key] / 3600.0
        if hours > 1e6:
            assert found[symbol] == "above 1 000 000 h"
        else:
            assert number_in(found[symbol]) == pytest.approx(hours, rel=5e-3)


@pytest.mark.slow
def test_the_page_of_a_bearing_with_a_margin_has_room_for_its_lives(tmp_path):
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    save(solve(case.replace({"contacts": "atlas", "bearing.life": {"contamination_factor": 0.5}})), tmp_path)
    report = report_of(tmp_path, summary=True)
    assert {"C", "ν1", "κ", "Lnmr"} <= set(life_of(report))
    assert first_page(report).scale == 1.0


@pytest.mark.slow
def test_numbers_and_remedies_of_a_drive(pages):
    _, summary, report = pages("drive")
    found = numbers_of(report)
    for end, place in (("drive_end", "drive end"), ("non_drive_end", "non-drive end")):
        rate, note = found[f"Discharges per second, {place}"]
        own = summary[end]
        assert number_in(rate) == pytest.approx(own["events_per_second"], rel=5e-3)
        bounds = [number_in(text) for text in note.removeprefix("95 % interval ").split(" to ")]
        assert bounds == pytest.approx(
            [own["events_per_second_low"], own["events_per_second_high"]], rel=5e-3
        )
        assert found[f"Energy of a discharge, mean, {place}"][0] == f"{1e9 * own['energy_mean']:.3g} nJ"
    remedies = tables_of(report)["Mitigation measures: discharges [1/s]"]
    assert [row[0] for row in remedies.rows] == ["as it is", *(one["title"] for one in summary["remedies"])]
    rates = [summary[table]["events_per_second"] for table in ("drive_end", "non_drive_end", "drive")]
    assert [number_in(text) for text in remedies.rows[0][2:]] == pytest.approx(rates, rel=5e-3)
    assert blocks(report, Picture)[0].name == "drive_remedies"
    assert [row[:3] for row in tables_of(report)[MEASURE].rows] == [
        ("dielectric strength, both bearings", "15\xa0V/µm", "12 to 18\xa0V/µm"),
        ("winding-rotor capacitance", "50\xa0pF", "25 to 75\xa0pF"),
        ("arc resistance", "10\xa0Ω", "none known"),
    ]
    machine = blocks(report, Text)[0].text.replace("\xa0", " ")
    for text in ("space-vector", "10 kHz", "560 V", "50 pF", "500 pF", "two bearings", "6208", "3000 rpm"):
        assert text in machine


@pytest.mark.slow
def test_a_drive_has_the_lives_of_both_bearings(tmp_path):
    own = {
        "drive.duration": 0.02,
        "bearings.bearing.life": {"contamination_factor": 0.5},
        "non_drive_end.bearing.radial_load": 1000.0,
    }
    case = DriveCase.from_toml(EXAMPLES / "drive.toml").replace(own)
    table = case.to_dict()
    del table["remedies"]
    save(solve_drive(DriveCase.from_dict(table), workers=1), tmp_path / "apart")
    report = report_of(tmp_path / "apart", summary=True)
    first, second = life_of(report, "drive end"), life_of(report, "non-drive end")
    # 6208 of NSK: C 29100 N, C0 17900 N; P = P0 = 1800 N at the drive end, and P0 = 1000 N at the other end.
    assert number_in(first["L10"]) == pytest.approx(1e6 * (29100.0 / 1800.0) ** 3 / (60.0 * 3000.0), rel=5e-3)
    assert [number_in(end["s0"]) for end in (first, second)] == pytest.approx([9.94, 17.9], abs=0.005)
    assert "Lnmr" in second
    # Two bearings with different loads have two sentences on the page.
    assert first_page(report).scale >= 0.8
    table["non_drive_end"]["bearing"]["radial_load"] = "1800 N"
    save(solve_drive(DriveCase.from_dict(table), workers=1), tmp_path / "alike")
    report = report_of(tmp_path / "alike", summary=True)
    assert life_of(report, "drive end and non-drive end") == first


def test_lives_over_a_duty_cycle_have_the_minimum_static_safety():
    first = [
        Row("P", 900.0, "N", key="end.duty_equivalent_load"),
        Row("s0", 2.5, key="end.duty_static_safety"),
    ]
    second = [first[0], Row("s0", 1.5, key="end.duty_static_safety")]
    texts = [
        one.text.replace("\xa0", " ") for one in life_texts({"drive end": first, "non-drive end": second})
    ]
    assert texts == [
        "Rating life of the duty cycle, drive end: P = 900 N; minimum s0 = 2.5.",
        "Rating life of the duty cycle, non-drive end: P = 900 N; minimum s0 = 1.5.",
    ]


@pytest.mark.slow
def test_a_drive_without_remedies_shows_its_voltages(tmp_path):
    case = drive_with_remedy(**{"drive.duration": "20 ms"})
    table = case.to_dict()
    del table["remedies"]
    save(solve_drive(DriveCase.from_dict(table), workers=1), tmp_path)
    report = report_of(tmp_path, summary=True)
    assert blocks(report, Picture)[0].name == "drive_voltages"
    assert list(tables_of(report)) == [MEASURE]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bearing_6208", "drive"])
def test_the_answer_can_be_repeated_from_the_page(pages, name):
    """Each number of the input file stands on the page by its name, to four digits."""
    _, _, report = pages(name)
    text = " ".join(block.text for block in blocks(report, Text)).replace("\xa0", " ")
    told = dict(re.findall(r"(?:; |: )([^;:=]+) = ([^;,]+?)(?=[;,]|\.(?: |$))", text))
    with (EXAMPLES / f"{name}.toml").open("rb") as file:
        written = flattened({key: value for key, value in tomllib.load(file).items() if key != "remedies"})
    # The page is of a shorter simulation, and the drive gives its bearings speed and temperature.
    passed = {"drive.duration", "drive_end.bearing.inner_speed", "drive_end.bearing.temperature"}
    compared = 0
    for key in written.keys() - passed:
        own, value = end_and_key(key)[1], written[key]
        if unit_of(own) or is_number(value):
            shown = told[named(own).text].replace("Ω", "ohm").replace("°C", "degC")
            both = [
                to_si(text, unit_of(own)) if unit_of(own) else float(text) for text in (shown, str(value))
            ]
            assert both[0] == pytest.approx(both[1], rel=1e-3), key
            compared += 1
    assert compared >= 14
    if name == "drive":
        changes = " ".join(row[1] for row in tables_of(report)["Mitigation measures: discharges [1/s]"].rows)
        text = changes.replace("\xa0", " ")
        assert all(change in text for change in ("= 1 Ω", "= silicon-nitride", "= 5 pF", "= 5 kHz"))


@pytest.mark.slow
def test_the_appendix_follows_in_the_order_of_the_question(pages):
    folder, _, alone = pages("bearing_6208")
    whole = report_of(folder)
    assert [section.title for section in whole.sections] == [
        "Summary", "What was asked", "Result", "Key numbers", "Figures", "Contacts", "Warnings",
        "What it rests on", "Inputs", "What the model neglects", "Sources", "How it was computed",
        "Input file",
    ]  # fmt: skip
    first = [block for block in whole.sections[0].blocks if not isinstance(block, Picture)]
    assert first == [block for block in alone.sections[0].blocks if not isinstance(block, Picture)]
    names = [block.name for block in whole.blocks() if isinstance(block, Picture)]
    assert len(names) == len(set(names))
    # Inputs have names; their keys stand below them only.
    inputs = next(section for section in whole.sections if section.title == "Inputs")
    cells = [row[0] for table in inputs.blocks if isinstance(table, Table) for row in table.rows]
    assert cells
    assert not any(re.search(r"[a-z]\.[a-z]|_", cell.text) for cell in cells)


@pytest.mark.slow
def test_python_writes_the_page_alone(pages, tmp_path):
    folder, _, _ = pages("bearing_greased")
    (file,) = write_report(folder, tmp_path / "page.pdf", summary=True)
    assert len(re.findall(rb"/Type /Page\b", file.read_bytes())) == 1


@pytest.mark.slow
def test_the_page_of_a_drive_has_a_row_for_each_bearing_and_a_figure_of_the_whole_width(pages):
    _, _, report = pages("drive")
    numbers, picture = blocks(report, Numbers)[0], blocks(report, Picture)[0]
    ends = [label.rpartition(", ")[2] for label, *_ in numbers.numbers]
    assert (numbers.columns, ends) == (3, ["drive end"] * 3 + ["non-drive end"] * 3)
    wide, high = 72.0 * picture.figure.get_size_inches()
    assert wide == pytest.approx(A4[0] - 36.0 * mm, rel=0.02)
    assert high < 0.5 * wide
    (remedies,) = (
        table for name, table in tables_of(report).items() if name.startswith("Mitigation measures")
    )
    assert sum(remedies.shares) == pytest.approx(1.0)
    changes = [row[1] for row in remedies.rows]
    assert changes[0] == "none"
    assert changes[2].replace("\xa0", " ") == (
        "element material, both bearings = silicon-nitride; capacitance of an element, both bearings = 5 pF"
    )


@pytest.mark.slow
@pytest.mark.parametrize("remedies", [3, 14])
def test_all_parts_of_the_first_page_have_one_width_at_every_size(pages, remedies):
    """Numbers, verdict and tables kept their widths where the page was shrunk, and its texts did not."""
    _, _, report = pages("drive")
    first, *others = report.sections
    longer = [
        replace(block, rows=block.rows[:1] + block.rows[1:2] * remedies)
        if isinstance(block, Table) and block.caption.startswith("Mitigation measures")
        else block
        for block in first.blocks
    ]
    page = first_page(replace(report, sections=(replace(first, blocks=tuple(longer)), *others)))
    widths = [sum(part._colWidths) for part in page.parts._content if isinstance(part, LongTable)]
    whole = (A4[0] - 36.0 * mm) / page.scale
    assert len(widths) == 4, "numbers, verdict and two tables"
    assert widths == pytest.approx([whole] * 4)
    assert (page.scale < 0.9) == (remedies > 10)
