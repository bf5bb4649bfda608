"""What a report says of a stored contact: numbers of its summary, origins of inputs, bounds, and failures."""

import json
import tomllib
from typing import get_args

import pytest

from ehlectric import BearingCase, Case, load, save, solve
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS
from ehlectric.cases.gear_inputs import Sharing
from ehlectric.errors import InputError
from ehlectric.figures import figure_names
from ehlectric.figures.figure_names import in_formats
from ehlectric.quantities.rows import Row
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.report.appendix import inputs_of, material_sources, source_section, worded
from ehlectric.report.build import report_of
from ehlectric.report.report_content import Light, Numbers, Picture, Table, Text, Warnings
from ehlectric.report.report_facts import caption_of, row_tables
from ehlectric.report.report_texts import (
    LIMITS,
    REFERENCES,
    SENTENCES,
    TEXTS,
    conditions_of,
    limits_of,
    references_of,
)
from ehlectric.report.written_report import write_report
from tests.axle.axles import two_stages
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import BALLS, OIL, bearing_case, changed
from tests.helpers.each import each
from tests.helpers.gears import spur_case
from tests.helpers.hot_cases import HOT_LINE

TABLE = {
    "title": "A & <b>B</b>",
    "contact": PAPER_CONTACT,
    "lubricant": {"base": "paper", "relative_permittivity": 2.2},
    "discharge": {"dielectric_strength": "15 V/um"},
    "grid": {"nodes": 801},
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("contact")
    save(solve(TABLE), place)
    return place


@pytest.fixture(scope="module")
def report(folder):
    return report_of(folder)


def tables(report, section):
    (found,) = [one for one in report.sections if one.title == section]
    return [block for block in found.blocks if isinstance(block, Table)]


def cells(report, section):
    """Rows of a section by the first cell, or by its dotted key."""
    rows = [row for table in tables(report, section) for row in table.rows]
    return {getattr(row[0], "key", row[0]): row for row in rows}


@pytest.mark.slow
def test_numbers_are_those_of_the_summary(report, folder):
    summary = json.loads((folder / "summary.json").read_text())
    found = cells(report, "Key numbers")
    assert found["minimum film thickness"][1] == f"{summary['film']['minimum_thickness'] * 1e6:.4g}"
    assert found["maximum field strength"][1] == f"≥\xa0{summary['field']['max_strength'] / 1e6:.4g}"
    breakdown = found["breakdown voltage"]
    assert breakdown[1:3] == (f"≤\xa0{summary['discharge']['breakdown_voltage']:.4g}", "V")


@pytest.mark.slow
def test_the_input_file_is_solved_again_to_the_same_case(report, folder):
    (code,) = [block for block in report.blocks() if isinstance(block, Text) and block.tone == "code"]
    path = folder / "again.toml"
    path.write_text(code.text)
    assert Case.from_toml(path) == Case.from_dict(tomllib.loads(code.text)) == Case.from_dict(TABLE)


@pytest.mark.slow
def test_every_input_has_its_origin(report):
    found = cells(report, "Inputs")
    radius = found["contact.reduced_radius"]
    assert radius[0].text == "reduced radius"
    assert radius[1:3] == ("14.1\xa0mm", "given")
    assert radius[3].startswith("reduced radius R of a line contact, with ")
    assert found["lubricant.relative_permittivity"][2] == "given"
    assert found["lubricant.roelands_z"][2] == "library paper: assumed [1]"
    assert found["grid.field_degree"][2] == "default"
    (assumed,) = tables(report, "What it rests on")
    assert assumed.caption == "Inputs to measure or to check"
    assert "Roelands' exponent = 0.67" in assumed.rows[0][0]
    assert "relative permittivity" not in assumed.rows[0][0]
    assert assumed.rows[1][0].startswith("dielectric strength = 15")
    (source,) = tables(report, "Sources")[0].rows
    assert source[2].address == "https://doi.org/10.3390/lubricants10050087"


@pytest.mark.slow
def test_the_light_has_the_level_of_the_verdict_and_never_hides_an_upper_bound(report, folder):
    (light,) = [block for block in report.blocks() if isinstance(block, Light)]
    verdict = load(folder).verdict
    assert light.level == verdict.level
    (result,) = [section for section in report.sections if section.title == "Result"]
    assert Text(verdict.text) in result.blocks
    assert light.bound == "upper bound"
    assert "ideal film" in light.words


def swept(level, code, word, below, known):
    counts = {"word": word, "below": below, "known": known, "low": 0.5, "high": 2.0}
    return Verdict(level, code, Statement.of("points-margins", **counts))


@each(
    "verdict, words, bound",
    [
        (Verdict("green", "breakdown-excluded"), "No breakdown expected", ""),
        (
            Verdict("green", "breakdown-excluded", bound="upper"),
            "No breakdown expected in an ideal film",
            "upper bound",
        ),
        (
            Verdict("yellow", "breakdown-likely", bound="upper"),
            "Breakdown likely even in an ideal film",
            "upper bound",
        ),
        (
            Verdict("grey", "none", bound="upper"),
            "No verdict; the breakdown voltage is an upper bound",
            "upper bound",
        ),
        (swept("yellow", "points-some", "expected", 4, 8), "Breakdown expected at some points", ""),
        (swept("yellow", "points-some-likely", "likely", 5, 6), "Breakdown likely at some points", ""),
        (swept("yellow", "points-none-possible", "expected", 0, 8), "Breakdown possible", ""),
        (swept("red", "points-all", "expected", 8, 8), "Breakdown expected", ""),
        (swept("green", "points-none", "expected", 0, 9), "No breakdown expected", ""),
        # A shaft voltage that is an upper bound makes the margin a lower one.
        (Verdict("red", "breakdown-expected", bound="best"), "Breakdown expected", ""),
    ],
)
def test_the_heading_of_a_light_is_the_heading_of_its_verdict(verdict, words, bound):
    light = Light.of(verdict, reasons=1)
    assert (light.level, light.words, light.bound) == (verdict.level, words, bound)


def test_bounds_are_marked_and_other_numbers_are_not():
    rows = (
        Row("margin (first breakdown / shaft voltage)", 1.5, bound="≤"),
        Row("temperature, 60 to 80 °C", "1.8 to 1.2", bound="≤"),
        Row("coating breakdown voltage", 3e3, "V"),
        Row("shaft voltage", 4.0, "V"),
    )
    table, text = row_tables(rows, "Test")
    assert [row[1] for row in table.rows] == ["≤\xa01.5", "≤\xa01.8 to 1.2", "3000", "4"]
    assert "upper bound" in text.text
    assert "lower bound" not in text.text
    assert len(list(row_tables(rows[-1:], "Test"))) == 1


def test_figures_have_captions(report):
    pictures = [block for block in report.blocks() if isinstance(block, Picture)]
    assert {"film", "field_strength", "breakdown"} <= {picture.name for picture in pictures}
    assert all(picture.caption and picture.title != picture.name for picture in pictures)


def test_every_figure_that_a_result_can_have_has_a_caption():
    files = (
        *figure_names.DRIVE_FIGURE_FILES, *figure_names.FIGURE_FILES, *figure_names.POINT_FIGURE_FILES,
        figure_names.ROUGHNESS_FIGURE, figure_names.BREAKDOWN_FIGURE,
        figure_names.METER_FIGURE, *figure_names.MOTION_FIGURE_FILES, *figure_names.BEARING_FIGURE_FILES,
        *figure_names.SPEED_FIGURE_FILES, figure_names.SENSITIVITY_FIGURE,
        figure_names.TEMPERATURE_FIGURE, figure_names.SHEAR_FIGURE, *figure_names.GEAR_FIGURE_FILES,
        *figure_names.AXLE_FIGURE_FILES,
    )  # fmt: skip
    assert {file.removesuffix(".png") for file in in_formats(files)} == set(TEXTS["captions"])
    assert caption_of("film", converged=False).startswith(SENTENCES["unconverged_figure"])


def test_a_film_with_heat_has_its_own_limits_and_references():
    hot, plain = Case.from_dict(HOT_LINE), Case.from_dict({k: v for k, v in HOT_LINE.items() if k != "film"})
    of_hot, of_plain = limits_text(hot), limits_text(plain)
    assert "isothermal" not in of_hot
    assert "Newtonian" not in of_hot
    assert "Newtonian" in of_plain
    cited = " ".join(one.citation for one in references_of(hot))
    assert all(name in cited for name in ("Carslaw", "Yang and Wen", "Johnson and Tevaarwerk"))
    assert "Carslaw" not in " ".join(one.citation for one in references_of(plain))
    assert {name for name, _ in material_sources(hot)} == {"steel"}


def limits_text(case):
    return " ".join(limit.text for limit in limits_of(case))


def test_a_bearing_whose_solved_heat_thins_the_oil_is_not_newtonian():
    """The films of its solved heat follow Ree and Eyring where the oil has their stress."""
    oil = {"temperature__thermal_conductivity": "0.14 W/m/K", "heat_capacity": "2000 J/kg/K"}
    changes = {f"lubricant__{key}": value for key, value in oil.items()} | {"motor": None}
    for factor, stress, newtonian in (
        ("solved", "5 MPa", False),
        ("solved", None, True),
        (0.9, "5 MPa", True),
    ):
        given = {"bearing__film_factor": factor, "lubricant__eyring_stress": stress}
        case = bearing_case(BALLS, contacts="formula", **changes, **given)
        assert ("Newtonian" in limits_text(case)) == newtonian
        assert any("Tevaarwerk" in one.citation for one in references_of(case)) != newtonian


def test_a_starved_contact_has_no_heat_to_switch_on():
    """``[film]`` is refused beside ``[inlet]``, so that no text tells to give it."""
    case = Case.from_dict(TABLE | {"inlet": {"oil_layer": "200 nm"}})
    assert "Heating" in limits_text(case)
    assert "[film]" not in limits_text(case)


@pytest.mark.slow
def test_a_result_that_is_not_converged_says_so_everywhere(tmp_path):
    table = TABLE | {"solver": {"max_iterations": 1}}
    save(solve(table, require_convergence=False), tmp_path)
    report = report_of(tmp_path)
    first = report.sections[0].blocks[0]
    assert (first.tone, first.text[:13]) == ("alarm", "NOT CONVERGED")
    assert not any(isinstance(block, Numbers) for block in report.blocks())
    assert "NOT CONVERGED" in next(iter(tables(report, "Key numbers"))).rows[0][0]
    pictures = [block for block in report.blocks() if isinstance(block, Picture)]
    assert pictures
    for picture in pictures:
        assert picture.caption.startswith(SENTENCES["unconverged_figure"])
        assert "NOT CONVERGED" in picture.title
    (warnings,) = [block for block in report.blocks() if isinstance(block, Warnings)]
    assert warnings.lines[0].severity == "severe"


def test_limits_and_publications_are_those_of_the_case():
    line, bearing = Case.from_dict(TABLE), BearingCase.from_dict(BALLS)
    of_line, of_bearing = ({limit.topic for limit in limits_of(case)} for case in (line, bearing))
    assert {"bodies", "roughness", "discharge"} <= of_line
    assert {"mechanics of the bearing", "circuit"} <= of_bearing
    assert not {"mechanics of the bearing", "circuit"} & of_line
    assert all(limit.text.endswith(".") for limit in LIMITS)
    assert "10.1115/1.3261900" in {one.doi for one in references_of(line)}
    assert "10.1115/1.3261900" not in {one.doi for one in references_of(bearing)}


@each("motor", [True, False])
def test_standards_are_those_of_machines_with_inverters(motor):
    table = BALLS if motor else changed(BALLS, motor=None)
    for case, told in ((BearingCase.from_dict(table), motor), (Case.from_dict(TABLE), False)):
        captions = [block.caption for block in source_section(case).blocks if isinstance(block, Table)]
        assert any(caption.startswith("Standards") for caption in captions) == told
        assert any("Only the peak" in limit.text for limit in limits_of(case)) == told


@each(
    ("text", "shown"),
    [
        ("non_drive_end: 0.2 A/mm²", "non-drive end: 0.2 A/mm²"),
        ("give it or iso_vg", "give it or ISO viscosity grade"),
        ("lower circuit.winding_rotor_capacitance", "lower winding-rotor capacitance"),
        ("V/h_min and d_m; sweep.csv has them", "V/h_min and d_m; sweep.csv has them"),
    ],
)
def test_keys_are_told_by_their_names(text, shown):
    assert worded(text) == shown


def test_conditions_of_limits_and_publications_are_known():
    cases = Case.from_dict(TABLE), BearingCase.from_dict(BALLS), spur_case(), two_stages()
    known = {name for case in cases for name in conditions_of(case)}
    known |= {f"kind {kind}" for kind in KINDS_OF_BEARINGS}
    known |= {f"sharing {law}" for law in get_args(Sharing)}
    names = {name.removeprefix("not ") for one in (*LIMITS, *REFERENCES) for name in one.when}
    assert {name for name in names if not name.startswith(("law ", "rheology "))} <= known


def test_values_of_the_bearing_of_the_library_have_its_sources():
    keys = (
        "kind",
        "elements",
        "element_diameter",
        "pitch_diameter",
        "inner_groove",
        "outer_groove",
        "shoulder_height",
    )
    own = {f"bearing__{key}": None for key in keys}
    case = BearingCase.from_dict(changed(BALLS, **own, bearing__base="6208", lubricant=OIL))
    found = {one.key: one for one in inputs_of(case)}
    assert found["bearing.elements"].source.kind == "published"
    assert found["bearing.inner_groove"].assumed
    assert found["bearing.shoulder_height"].source.kind == "by rule"
    assert found["bearing.radial_load"].origin == "given"
    assert dict(material_sources(case))["steel"].citation


@pytest.mark.slow
def test_the_date_alone_makes_two_reports_differ(folder, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1767225600")
    first = write_report(folder, folder / "a.html", folder / "a.pdf")
    second = write_report(folder, folder / "b.html", folder / "b.pdf")
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
    assert b"2026-01-01 00:00:00 UTC" in first[0].read_bytes()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "today")
    with pytest.raises(InputError, match="SOURCE_DATE_EPOCH: got 'today'"):
        report_of(folder)
