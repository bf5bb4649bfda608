"""Reports of drives and of sweeps of drives: verdict, assumptions, both bearings, remedies and discharges."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from docs import pages

from ehlectric import DriveCase, Sweep, run_sweep, save, solve_drive
from ehlectric.cases.case import Case
from ehlectric.drive.result import DriveResult
from ehlectric.report.appendix import inputs_of, named, replaced_by
from ehlectric.report.build import report_of
from ehlectric.report.drive_report import (
    LISTED,
    deciding_blocks,
    drive_part,
    event_blocks,
)
from ehlectric.report.pdf import pdf_of
from ehlectric.report.report_content import Light, Picture, Table, Text
from ehlectric.report.report_facts import density_tables
from ehlectric.report.report_texts import (
    DRIVE_LIMITS,
    DRIVE_REFERENCES,
    conditions_of,
    limits_of,
    references_of,
)
from ehlectric.report.written_report import html_of
from ehlectric.sweep.drive_sweep_verdict import swept_verdict
from tests.helpers.drives import drive_with_remedy, small_drive
from tests.helpers.readable import number_in
from tests.helpers.reports import HOSTILE, Page, needs_pdftotext, text_of_pdf

LOAD = "non_drive_end.bearing.radial_load"
MACHINE = {
    "stack_length": "120 mm", "bore_diameter": "110 mm", "air_gap": "0.5 mm", "slots": 36,
    "slot_opening": "3 mm", "copper_depth": "2 mm", "slot_permittivity": 2, "liner_width": "50 mm",
    "liner_thickness": "0.3 mm", "liner_permittivity": 3.5,
}  # fmt: skip


@pytest.fixture(scope="module")
def drive():
    title = "".join(letter for letter in HOSTILE if letter.isprintable())
    changes = {"drive.duration": "20 ms", "bearings.bearing.film_factor": "none"}
    return solve_drive(drive_with_remedy(title=title, **changes), workers=1)


@pytest.fixture(scope="module")
def report(drive, tmp_path_factory):
    folder = tmp_path_factory.mktemp("drive")
    save(drive, folder)
    return report_of(folder)


@pytest.fixture(scope="module")
def page(report):
    return Page(html_of(report))


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """Sweep over the load of one of two bearings, and its report."""
    folder = tmp_path_factory.mktemp("sweep")
    vary = {LOAD: ["1 kN", "2 kN"]}
    return run_sweep(Sweep.from_dict({"case": small_drive(), "vary": vary}), folder, workers=1), report_of(
        folder
    )


def tables(report, section):
    (found,) = [one for one in report.sections if one.title == section]
    return {block.caption: block for block in found.blocks if isinstance(block, Table)}


def rows(table):
    """Rows by the first cell, or by its dotted key."""
    return {getattr(row[0], "key", row[0]): row[1:] for row in table.rows}


@pytest.mark.slow
@pytest.mark.gate
def test_sections_begin_with_the_answer(report):
    (light,) = [block for block in report.sections[0].blocks if isinstance(block, Light)]
    lead, _ = report.sections[2].blocks
    for number in ("3000 rpm", "80 °C", "20 ms", "2 periods", "1200 edges"):
        assert number in lead.text
    assert (light.level, light.words.startswith("Discharges")) == ("red", True)


@pytest.mark.slow
def test_numbers_of_both_ends_are_those_of_the_summary(report, drive):
    summary, found = drive.summary(), tables(report, "Key numbers")
    events = rows(found["discharges"])
    ends = [summary[end] for end in ("drive_end", "non_drive_end")]
    assert events["number of discharges"][:2] == tuple(str(end["events"]) for end in ends)
    bounds = [[float(end[f"events_per_second_{side}"]) for side in ("low", "high")] for end in ends]
    shown = [
        list(map(number_in, text.split(" to ")))
        for text in events["discharges per second, 95 % interval"][:2]
    ]
    assert np.array(shown) == pytest.approx(np.array(bounds), rel=5e-3)
    assert events["energy of a discharge, mean"] == (
        *(f"{1e9 * end['energy_mean']:.3g}" for end in ends),
        "nJ",
    )
    assert rows(found["simulation"])["edges of the source"] == ("1200", "", "")
    times = [
        name for name in rows(found["voltage across the films"]) if name.startswith("share of time above")
    ]
    assert times[0] == "share of time above 1 V"
    assert len(times) < 6  # beyond the first voltage that is never reached there is nothing to say


@pytest.mark.slow
def test_voltages_of_the_shaft_and_signs_of_discharges_are_those_of_the_simulation(report, drive):
    """Without a coating the shaft has the voltage of the films, whose times at each voltage are stored."""
    found, record = tables(report, "Key numbers"), drive.solution.record
    shaft = {name: float(row[0]) for name, row in rows(found["shaft against frame"]).items()}
    middle = record.edges[:-1] + 0.5 * np.diff(record.edges)
    square = np.sum(middle**2 * record.histogram[0]) / record.duration
    assert shaft["shaft voltage, rms"] == pytest.approx(np.sqrt(square), rel=2e-2)
    peaks = shaft["shaft voltage, positive peak"], shaft["shaft voltage, negative peak"]
    assert max(np.abs(peaks)) == pytest.approx(record.peak[0], rel=5e-3)
    assert peaks[0] > 0.0 > peaks[1]
    assert shaft["shaft voltage, peak to peak"] == pytest.approx(peaks[0] - peaks[1], rel=1e-2)
    # Of the two zero states of the inverter, the whole voltage of the DC link.
    assert rows(found["simulation"])["common-mode voltage, peak to peak"][:2] == ("560", "V")
    discharges = rows(found["discharges"])
    for b, end in enumerate(("drive_end", "non_drive_end")):
        volts = np.array([row["voltage"] for row in drive.events() if row["bearing"] == end])
        for name, count in (("positive", np.sum(volts > 0.0)), ("negative", np.sum(volts < 0.0))):
            rate = number_in(discharges[f"discharges per second, shaft {name}"][b])
            assert rate == pytest.approx(count / record.duration, rel=5e-3)


def test_current_densities_stand_beside_each_limit_with_its_source():
    """0.364 A/mm² lies between the second and the third limit, which no sentence may call above all."""
    (table,) = density_tables({"drive end": 0.364e6, "non-drive end": 0.05e6})
    assert [row[:3] for row in table.rows] == [
        ("0.1 A/mm²", "above", "below"), ("0.3 A/mm²", "above", "below"), ("0.8 A/mm²", "below", "below"),
    ]  # fmt: skip
    assert table.heads[1] == "drive end, 0.364 A/mm²"
    page = pages.page("theory/discharge.md")
    assert all(row[-1].address in page or "Busse" in row[-1].text for row in table.rows)
    assert list(density_tables({"drive end": None, "non-drive end": 0.0})) == []
    (alone,) = density_tables({"drive end": 1e6, "non-drive end": None})
    assert [row[1] for row in alone.rows] == ["above"] * 3


@pytest.mark.slow
def test_standards_are_dated_and_have_their_source(report):
    found = tables(report, "Sources")
    (caption,) = [caption for caption in found if caption.startswith("Standards")]
    assert re.search(r"as known on \d+ \w+ 20\d\d$", caption)
    documents = [row[0] for row in found[caption].rows]
    assert [document.split(":")[0].split(",")[0] for document in documents] == [
        "IEC 60034-1", "IEC TS 60034-25", "NEMA MG 1",
    ]  # fmt: skip
    assert all(row[-1] for row in found[caption].rows)
    # No limit is stated that no source was found for.
    assert not [row for row in found[caption].rows if re.search(r"\d ?m?[VA]\b", " ".join(row))]


@pytest.mark.slow
def test_no_dotted_key_is_in_the_text(report):
    """The input file at the end has them; a name of an input shows its key under the pointer alone."""
    text = Page(html_of(replace(report, sections=report.sections[:-1]))).text
    assert "winding-rotor capacitance" in text
    tables_of_files = "drive|circuit|breakdown|source|bearings?|lubricant|discharge|motor"
    assert not re.findall(rf"\b(?:{tables_of_files})\.(?!nc\b)[a-z]\w+", text)
    assert not re.findall(r"\b[a-z]{2,}_[a-z]{2,}\b", re.sub(r"https?://\S+", "", text))


def test_values_that_decide_are_told_with_their_origin(report):
    decisive = rows(tables(report, "What it rests on")["Values that decide the result"])
    assert decisive["breakdown.arc_resistance"][:2] == ("10\xa0Ω", "input file")
    assert decisive["circuit.winding_rotor_capacitance"][:2] == ("50\xa0pF", "input file")
    assert decisive["breakdown.renewal_time"][1] == "time in which oil passes the most loaded contact"
    assert decisive["bearings.discharge.dielectric_strength"][0] == "15\xa0V/µm"
    assert not any("common_mode_resistance" in key for key in decisive)


def test_capacitances_from_the_geometry_are_marked():
    case = small_drive(**{f"circuit.machine.{key}": value for key, value in MACHINE.items()})
    table = case.to_dict()
    del table["circuit"]["winding_rotor_capacitance"]
    case = DriveCase.from_dict(table)
    (_, found) = deciding_blocks(case)
    assert rows(found)["circuit.winding_rotor_capacitance"][1].startswith("geometry of the machine")
    assert rows(found)["circuit.rotor_frame_capacitance"][1] == "input file"
    topics = {limit.topic for limit in limits_of(case)}
    assert "capacitances of the machine" in topics
    assert "capacitances of the machine" not in {limit.topic for limit in limits_of(small_drive())}


def test_figures_have_findings_and_captions(report):
    pictures = [block for block in report.blocks() if isinstance(block, Picture)]
    assert {"drive_voltages", "drive_discharges", "drive_remedies"} <= {one.name for one in pictures}
    assert all(one.caption and one.title != one.name for one in pictures)


def test_remedies_stand_beside_the_drive_with_what_they_change(report, drive):
    found = tables(report, "Mitigation measures")
    assert found["What each mitigation measure changes"].rows == (
        ("Grounding ring", named("circuit.grounding_ring_resistance"), "not given", "1\xa0Ω"),
    )
    sides = found["Mitigation measures compared"].rows
    assert [row[:2] for row in sides] == [
        (name, place)
        for name in ("as it is", "Grounding ring")
        for place in ("drive end", "non-drive end", "both")
    ]
    high = drive.summary()["remedies"][0]["drive_end"]["events_per_second_high"]
    assert sides[3][2:5] == ("0", f"at most {high:.3g}", "–")
    both = drive.summary()["drive"]["events_per_second"]
    assert number_in(sides[2][2]) == pytest.approx(both, rel=5e-3)
    verdicts = rows(found["Verdict on each mitigation measure"])
    assert verdicts["as it is"] == ("Discharges expected", "none")
    assert verdicts["Grounding ring"][0].endswith("in an ideal film (upper bound)")


def test_the_largest_discharges_are_those_of_the_table_of_events(report, drive):
    (table,) = tables(report, "Largest discharges").values()
    assert len(table.rows) == LISTED
    energy = next(n for n, head in enumerate(table.heads) if head.startswith("energy"))
    shown = [float(row[energy]) for row in table.rows]
    largest = sorted((row["energy"] for row in drive.events()), reverse=True)[:LISTED]
    assert "[nJ]" in table.heads[energy]
    assert shown == pytest.approx([1e9 * value for value in largest], rel=5e-3)


def test_a_drive_without_discharges(drive):
    part = drive_part(DriveResult(drive.remedies[0][2]))
    assert [one.title for one in part.further] == ["Largest discharges"]
    assert [type(block) for block in part.further[0].blocks] == [Text]
    discharges = rows(next(one for one in part.numbers if getattr(one, "caption", "") == "discharges"))
    assert discharges["discharges per second, 95 % interval"][0].startswith("at most ")
    assert "energy of a discharge, mean" not in discharges
    assert f"{LISTED} discharges" in next(event_blocks(drive)).text


def test_inputs_of_two_equal_bearings_stand_once(report, drive):
    found = tables(report, "Inputs")
    assert "Inputs: both bearings" in found
    cells = rows(found["Inputs: both bearings"])
    assert cells["bearing.inner_speed"][2] == "not used: the rotor speed of the drive takes its place"
    assert cells["bearing.elements"][1].startswith("library 6208: published")
    apart = {one.key: one for one in inputs_of(drive.case, apart=True)}
    assert apart["non_drive_end.bearing.elements"].source == apart["drive_end.bearing.elements"].source
    other = drive.case.replace({"non_drive_end.bearing.radial_load": "500 N"})
    keys = {one.key for one in inputs_of(other)}
    assert "bearings.bearing.radial_load" not in keys
    assert {"drive_end.bearing.radial_load", "non_drive_end.bearing.radial_load"} <= keys
    assert not any(key.startswith("remedies") for key in keys)


def test_limits_say_that_arcs_are_inputs():
    case = small_drive()
    texts = " ".join(limit.text for limit in limits_of(case))
    assert "plasma" in texts
    assert "Weibull" in texts
    assert all(limit.text.endswith(".") for limit in DRIVE_LIMITS)
    table = case.to_dict()
    del table["breakdown"]["weibull_shape"]
    fixed = DriveCase.from_dict(table)
    assert "Weibull" not in " ".join(limit.text for limit in limits_of(fixed))
    assert "Weibull" not in " ".join(one.citation for one in references_of(fixed))
    assert "Holtz" in " ".join(one.citation for one in references_of(case))


def test_conditions_of_limits_and_publications_are_known():
    names = {name.removeprefix("not ") for one in (*DRIVE_LIMITS, *DRIVE_REFERENCES) for name in one.when}
    assert names <= set(conditions_of(small_drive()))


def test_the_input_file_is_the_drive(report, drive, tmp_path):
    (code,) = [block for block in report.blocks() if isinstance(block, Text) and block.tone == "code"]
    (tmp_path / "again.toml").write_text(code.text, encoding="utf-8")
    assert DriveCase.from_toml(tmp_path / "again.toml") == drive.case


@pytest.mark.slow
def test_a_page_escapes_the_title_and_has_heads_for_every_column(page):
    assert not page.of("script")
    assert "<script>alert(1)</script>" in page.text
    assert all(image["alt"] for image in page.of("img"))
    assert len(page.of("caption")) == len(page.of("table"))


@pytest.mark.slow
@needs_pdftotext
def test_no_text_is_lost_on_paper(report, page):
    paper = text_of_pdf(pdf_of(report)).replace(" ", "").replace("\xad", "")
    for section in report.sections:
        for block in section.blocks:
            if isinstance(block, Text | Light):
                texts = [block.text]
            elif isinstance(block, Table):
                texts = [cell for row in block.rows for cell in row if isinstance(cell, str)]
            else:
                continue
            for text in texts:
                plain = " ".join(text.split())
                assert plain in page.text, text
                if not (isinstance(block, Text) and block.tone == "code"):
                    assert plain.replace(" ", "") in paper, text


@pytest.mark.slow
def test_a_sweep_of_drives_has_a_verdict_and_its_values(swept):
    results, report = swept
    light = next(block for block in report.sections[0].blocks if isinstance(block, Light))
    verdict = swept_verdict(results)
    assert light.level == verdict.level
    assert Text(verdict.text) in report.sections[2].blocks
    points = tables(report, "Points")["Points of the sweep"]
    rates = [
        number_in(row[points.heads.index("discharges per second, both bearings [1/s]")])
        for row in points.rows
    ]
    assert rates == pytest.approx(results.values("drive.events_per_second"), rel=1e-3)
    # The bearings differ from point to point, so that both ends have columns.
    assert {"discharges per second, drive end [1/s]", "discharges per second, non-drive end [1/s]"} <= {
        *points.heads
    }
    names = [block.name for block in report.blocks() if isinstance(block, Picture)]
    assert len(names) == len(set(names))
    assert names[0] == "lines_drive.events_per_second"
    assert {f"lines_{end}.peak_voltage" for end in ("drive_end", "non_drive_end")} <= set(names)
    assert not any("e+0" in block.title for block in report.blocks() if isinstance(block, Picture))
    decisive = tables(report, "What it rests on")["Values that decide the result"]
    assert {"drive_end.discharge.dielectric_strength", "non_drive_end.discharge.dielectric_strength"} <= set(
        rows(decisive)
    )
    varied = rows(tables(report, "Inputs")["Inputs: bearing at the non-drive end"])
    assert varied["bearing.radial_load"][1] == "varied"


@pytest.mark.slow
def test_verdict_on_a_sweep_from_its_points(swept):
    results, _ = swept
    red = swept_verdict(results)
    assert red.heading.startswith("Discharges")
    point = results.points[0]
    ring = solve_drive(small_drive(**{"circuit.grounding_ring_resistance": 1e-3}), workers=1).summary()
    quiet = json.loads(json.dumps(ring))
    for end in ("drive_end", "non_drive_end"):
        quiet[end]["peak_voltage"] = 1e-3

    def judged(*summaries):
        return swept_verdict(replace(results, points=[replace(point, summary=one) for one in summaries]))

    assert judged(quiet, quiet).level == "green"
    assert judged(quiet, point.summary).level == "yellow"
    assert "expected at 1 of 2 points" in judged(quiet, point.summary).text
    lost = judged(quiet, None)
    assert (lost.level, "1 more point is not solved" in lost.text) == ("yellow", True)
    assert judged(quiet).heading == "No discharge at any point"


def test_other_cases_have_no_key_that_a_drive_replaces(drive):
    assert replaced_by(drive.case, "drive_end.bearing.temperature") == "drive.temperature"
    assert replaced_by(drive.case, "bearings.bearing.radial_load") == ""
    contact = {
        "reduced_radius": 0.01,
        "reduced_modulus": 2e11,
        "load_per_length": 1e5,
        "entrainment_speed": 1.0,
    }
    assert (
        replaced_by(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}), "contact.load")
        == ""
    )
