"""Verdicts as data: texts of all codes, and levels that no words change."""

import json
import math
from string import Formatter

import pytest

from ehlectric import BearingCase, Case, solve, solve_bearing
from ehlectric.app.compute.bearing_answers import answer_of as bearing_page
from ehlectric.app.compute.contact_answers import answer_of as contact_page
from ehlectric.quantities import verdict_texts
from ehlectric.quantities.formats import operating_point
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.report.report_content import Light
from tests.helpers.places import EXAMPLES

TEXTS = data_file("ehlectric.quantities", "verdict_texts.toml")


def test_every_template_has_a_known_way_to_write_its_values():
    templates = [entry["text"] for entry in TEXTS["statements"].values()]
    templates += [text for entry in TEXTS["statements"].values() for text in entry.get("lines", {}).values()]
    ways = {way for text in templates for _, _, way, _ in Formatter().parse(text) if way}
    assert ways <= verdict_texts._WAYS.keys()
    labels = {entry["line"] for entry in TEXTS["statements"].values() if "line" in entry}
    labels |= {name for entry in TEXTS["statements"].values() for name in entry.get("lines", ())}
    assert labels <= TEXTS["lines"].keys()


def test_the_module_of_verdicts_loads_no_numerics():
    """Checked in a process of its own, where nothing else has loaded them."""
    import subprocess
    import sys

    code = "import sys, ehlectric.quantities.verdict; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def in_other_words():
    """Texts in which every template is one other sentence, and all first words are the same."""
    other = {code: {"text": "Green, yellow, red: something else."} for code in TEXTS["statements"]}
    leads = {code: {"text": "Other words"} for code in TEXTS["leads"]}
    return {**TEXTS, "statements": other, "leads": leads}


@pytest.fixture(params=["bearing", "contact"])
def solved(request):
    """A result with its page."""
    if request.param == "bearing":
        case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "atlas"})
        return solve_bearing(case, workers=1), lambda result: bearing_page(result)
    case = Case.from_toml(EXAMPLES / "discharge.toml").replace({"grid.nodes": 257})
    return solve(case), contact_page


def levels(result, page):
    """Level, heading's bound and codes of a result in page, report and summary."""
    verdict, summary = result.verdict, json.loads(json.dumps(result.summary()))
    answer = page(result)
    light = Light.of(verdict, reasons=1)
    codes = [one["code"] for one in summary["verdict_reasons"]]
    bounds = (answer.verdict.bound, light.bound)
    return {answer.verdict.level, light.level, summary["verdict_level"]}, codes, bounds, answer.meaning


@pytest.mark.slow
def test_page_report_and_summary_keep_their_level_in_other_words(solved, monkeypatch):
    before = levels(*solved)
    text = solved[0].verdict.text
    monkeypatch.setattr(verdict_texts, "_texts", in_other_words)
    assert levels(*solved) == before
    assert len(before[0]) == 1
    assert solved[0].verdict.text != text
    assert solved[0].verdict.lead == "Other words"


def test_statements_are_plain_data():
    statement = Statement.of("speeds-below-1", intervals=(Statement.of("speeds-below", high=10.0),))
    verdict = Verdict(
        "yellow", "breakdown-likely", statement, facts=(Fact("bearing.margin", 0.9, (0.5, 1.2)),)
    )
    data = json.loads(json.dumps(verdict.as_data()))
    assert data["verdict_level"] == "yellow"
    assert data["verdict_reasons"] == [
        {
            "code": "speeds-below-1",
            "values": {"intervals": [{"code": "speeds-below", "values": {"high": 10.0}}]},
        }
    ]
    assert (verdict.margin, verdict.interval) == (0.9, (0.5, 1.2))
    assert verdict.text == data["verdict"] == "Breakdown likely: below about 95.5 rpm the margin is below 1."


def test_lines_have_the_numbers_of_the_sentences():
    values = {"shaft": 4.04, "breakdown": 3.9, "margin": 0.966, "interval": None}
    chance = {"probability": Statement.of("chance", pair=(0.53, 0.043)), "doubts": None}
    verdict = Verdict(
        "yellow",
        "breakdown-likely",
        Statement.of("bearing-voltages", **values),
        Statement.of("at", speed=314.159265, temperature=343.15),
        reasons=(
            Statement.of("probability", low=0.46, median=0.97, high=2.09, off=0.099, **chance),
            Statement.of("measure-first", first="winding-rotor capacitance", share=0.45),
            Statement.of("warning", code="estimated-alpha"),
        ),
        assumptions=(Statement.of("films", words=("fully flooded", "rough")),),
        bound="best",
    )
    interval = "90 % interval of the margin 0.46 to 2.09, median 0.97 (sampling error 9.9 %)"
    assert [*verdict.lines()] == [
        ("", "Breakdown likely at 3000 rpm, 70 °C"),
        ("voltages", f"shaft 4.04 V, first breakdown 3.9 V, margin 0.97; {interval}"),
        ("probability", "53 % (sampling error 4.3 %)"),
        ("caution", "The pressure-viscosity coefficient is estimated from the base oil."),
        ("measure", "winding-rotor capacitance first (45 % of the spread of the margin)"),
        ("model", "best estimate: fully flooded, rough film"),
    ]


def test_a_verdict_names_the_operating_point_with_the_digits_of_titles():
    speed, temperature = 2995.0 * math.pi / 30.0, 335.7
    assert operating_point(speed, temperature) == ("2995 rpm", "62.55 °C")
    at = verdict_texts.statement_text(Statement.of("at", speed=speed, temperature=temperature))
    assert at == "at 2995 rpm, 62.55 °C"
