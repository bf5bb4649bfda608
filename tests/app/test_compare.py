"""Two cases side by side: what differs, the effect on every result, and warnings that one alone has."""

import tomllib
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import BearingCase, solve
from ehlectric.app.charts import compare_charts as figures
from ehlectric.app.compute.bearing_answers import meaning_of
from ehlectric.app.compute.compare_answers import side, whole_side
from ehlectric.app.compute.contact_answers import by_formula, contact_case
from ehlectric.app.form_fields.axle_fields import other_inputs
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.compare_page import effects_table, inputs_table
from ehlectric.app.pages.frame import AXLE
from ehlectric.app.view_models import Effect, Film, Result, effects, in_both, input_rows, only_in
from ehlectric.axle import solve_axle
from ehlectric.cases.axle_case import AxleCase
from ehlectric.errors import InputError
from ehlectric.runs.preview import preview_of
from tests.helpers.bearings import numbers_of
from tests.helpers.places import EXAMPLES


def example(name):
    return Inputs(tomllib.loads((EXAMPLES / f"{name}.toml").read_text(encoding="utf-8")))


# Coating of an outer ring.
COATING = {"base": "schaeffler-j20aa", "relative_permittivity": 9.0, "area": "45 cm^2"}

FAST = example("bearing_6208").changed({"bearing.film_factor": "none"})
SLOW = FAST.changed({"bearing.inner_speed": "1000 rpm", "motor.switching_frequency": "10 kHz"})


@pytest.fixture(scope="module")
def both():
    return side(FAST.table), side(SLOW.table)


@pytest.fixture(scope="module")
def solved():
    """Bearing with contacts from the atlas, as the Python package solves it."""
    return solve(BearingCase.from_written(FAST.table).replace({"contacts": "atlas"}), workers=1)


@pytest.mark.slow
@pytest.mark.gate
def test_results_are_those_of_the_package(both, solved):
    found = {result.name: result for result in both[0].results}
    summary = numbers_of(solved)["bearing"]
    for name, key in (
        ("capacitance of the bearing", "capacitance"),
        ("first breakdown voltage", "first_break"),
        ("shaft voltage", "shaft_voltage"),
        ("margin (first breakdown / shaft voltage)", "margin"),
        ("minimum lambda ratio", "lambda_ratio"),
    ):
        assert found[name].value == summary[key]
        assert found[name].main
    whole = whole_side(FAST.table)
    assert (whole.verdict, whole.meaning) == (solved.verdict, meaning_of(solved.verdict))
    assert whole.number.key == whole.deciding.key == "bearing.margin"
    assert float(whole.number.text) == pytest.approx(summary["margin"], rel=1e-3)
    assert {told.text for told in whole.warnings} == {warning.text for warning in solved.warnings}


@pytest.mark.slow
def test_an_upper_bound_says_so(both):
    """The films are isothermal, so that its voltages are upper bounds."""
    assert "isothermal-film" in {told.code for told in both[0].warnings}
    found = {result.name: result for result in both[0].results}
    assert found["first breakdown voltage"].bound == "≤"
    assert found["capacitance of the bearing"].bound == ""
    assert found["shaft voltage"].bound == ""
    assert found["minimum lambda ratio"].bound == "≤"
    whole = {result.name: result for result in whole_side(FAST.table).results}
    assert whole["critical speed"].bound == "≥", "thinner films break down at higher speeds too"
    ceramic = side(FAST.changed({"bearing.element_material": "silicon-nitride"}).table)
    assert {row.name: row for row in ceramic.results}["capacitance of the bearing"].bound == "≤"


@pytest.mark.slow
def test_both_axles_have_the_numbers_of_the_command():
    """Expected: ``solve_axle`` of both axles; a ring with 0 V on the rotor lowers all voltages."""
    ring = dict(AXLE.changed({"circuit.grounding_ring_resistance": "1 ohm"}).table)
    sides = [side(dict(AXLE.table)), side(ring)]
    for one, table in zip(sides, (AXLE.table, ring), strict=True):
        summary = solve_axle(AxleCase.from_written(dict(table)), remedies=False, probable=False).summary()
        ratios = {row["element"]: row["voltage_ratio"] for row in summary["elements"] if row["voltage_ratio"]}
        assert dict(one.ratios) == ratios
        main = {result.name: result.value for result in one.results if result.main}
        assert main == ratios | {row["shaft"]: row["voltage"] for row in summary["shafts"]}
    changes = [effect for effect in effects(*sides) if effect.either.main]
    assert all(effect.change < 0.0 for effect in changes)
    rows = input_rows(AXLE.table, ring, lambda table: other_inputs(Inputs(table)))
    assert [row.key for row in rows if row.sign != "="] == ["circuit.grounding_ring_resistance"]


def test_effects_are_changes_in_percent(both):
    found = {effect.either.name: effect for effect in effects(*both)}
    margin = found["margin (first breakdown / shaft voltage)"]
    assert margin.change == pytest.approx(100.0 * (margin.second.value / margin.first.value - 1.0))
    assert margin.words.startswith("▼ −")
    assert found["capacitance of the bearing"].words.startswith("▲ +")
    assert found["film factor"].words == "no change"
    assert all(effect.words == "no change" for effect in effects(both[0], both[0]))


def test_effects_of_results_that_are_texts_or_missing():
    def effect(first, second):
        sides = [side_of(text) for text in (first, second)]
        return effects(*sides)[0].words

    def side_of(text):
        rows = () if text is None else (Result("g", "n", None, text),)
        return type("Side", (), {"results": rows})()

    assert effect("12 nJ", "6 nJ") == "▼ −50\N{NO-BREAK SPACE}%"
    assert effect("12 nJ", "6 µJ") == "▲ +49900\N{NO-BREAK SPACE}%"
    assert effect("20 s", "20 µs") == "▼ −100\N{NO-BREAK SPACE}%"
    assert effect("20 s", "20 V") == "differs"
    assert effect("full film", "mixed lubrication") == "differs"
    assert effect("none", None) == "only A"
    assert effect(None, "none") == "only B"
    assert Effect(Result("g", "n", 0.0, "0"), Result("g", "n", 1.0, "1"), None).words == "differs"


def test_a_change_within_the_accuracy_of_a_critical_speed_is_none():
    def words(first, second):
        rows = [Result("g", "critical speed", None, text, "rpm") for text in (first, second)]
        sides = [type("Side", (), {"results": (row,)})() for row in rows]
        return effects(*sides)[0].words

    assert words("1460", "1470") == "no change"
    assert words("1460", "1660") == "▲ +13.7\N{NO-BREAK SPACE}%"


def test_inputs_that_differ_come_first():
    rows = input_rows(FAST.table, SLOW.table)
    assert [(row.key, row.sign) for row in rows[:2]] == [
        ("bearing.inner_speed", "≠"),
        ("motor.switching_frequency", "only B"),
    ]
    assert {row.sign for row in rows[2:]} == {"="}
    assert len(rows) == len(SLOW.flat())


def test_warnings_of_one_alone(both):
    alone = {told.code for told in only_in(both[1], both[0])}
    assert "breakdown-expected" in alone
    assert not alone & {told.code for told in both[0].warnings}
    assert {told.code for told in in_both(*both)} | {told.code for told in only_in(*both)} == {
        told.code for told in both[0].warnings
    }


def test_a_coating_has_both_voltages_of_the_first_breakdown():
    coated = side(FAST.changed({"bearing.coating": COATING}).table)
    main = {row.name: row for row in coated.results if row.main}
    films, shaft = main["first breakdown voltage"], main["shaft voltage of the first breakdown"]
    assert (films.bound, shaft.bound) == ("≤", "≤")
    assert films.value < shaft.value


def test_contacts_are_compared_by_formula():
    case = example("discharge")
    found = {
        effect.either.name: effect
        for effect in effects(
            side(case.table), side(case.changed({"contact.entrainment_speed": "8 m/s"}).table)
        )
    }
    # Pan and Hamrock's minimum film grows with the speed to the power of 0.694.
    assert found["minimum film (Pan-Hamrock)"].change == pytest.approx(100.0 * (2.0**0.694 - 1.0), rel=1e-3)
    alone = by_formula(contact_case(case.table))
    both = side(case.table)
    assert (both.verdict, both.deciding) == (alone.verdict, alone.deciding)
    assert both.number.text == alone.number(alone.deciding.key).text
    broken = {row.name: row for row in both.results}["breakdown voltage (film-thickness formula)"]
    assert broken.main
    assert (broken.group, broken.bound) == ("breakdown", "≤")
    expected = preview_of(contact_case(case.table)).summary["breakdown_by_formula"]
    assert broken.value == expected["breakdown_voltage"]


def test_a_wrong_case_is_an_error_of_its_key():
    with pytest.raises(InputError) as refused:
        side(FAST.changed({"bearing.radial_load": "1800 m"}).table)
    assert refused.value.key == "bearing.radial_load"


class Tags(HTMLParser):
    """Names of the tags of a text, and its attributes."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.ids = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.ids += [value for name, value in attributes if name == "data-testid"]


def test_tables_escape_what_a_user_typed(both):
    hostile = "<script>alert(1)</script>\"' onload=x"
    rows = input_rows({"title": hostile, hostile: 1}, {"title": "B"})
    found = Tags(inputs_table(rows, {"title": hostile}) + effects_table(effects(*both)))
    assert "script" not in found.tags
    assert {
        "effect-margin-first-breakdown-shaft-voltage",
        "effect-capacitance-of-the-bearing",
        "inputs-differ",
    } <= set(found.ids)


def test_figures_hold_the_numbers_of_the_tables(both):
    traces = figures.films(both)["data"]
    light = "below 2 % of the load"
    names = [f"{name}, {what}" for name in "AB" for what in ("inner ring", "outer ring", light)]
    assert [trace["name"] for trace in traces] == names
    assert figures.over_speed(both)["data"] == [], "voltages over the speed follow with the whole answer"
    thinnest = min(value for trace in traces[:2] for value in trace["r"])
    shown = {row.name: row for row in both[0].results}["minimum film, inner ring"]
    assert thinnest == pytest.approx(1e6 * shown.value)


def films_of(*sides):
    """Figure of cases with one ring each, by the films [µm] of its elements and their loads [N]."""
    made = [
        Film(
            "inner",
            tuple(range(len(films))),
            tuple(1e-6 * film for film, _ in films),
            tuple(load for _, load in films),
        )
        for films in sides
    ]
    return figures.films([SimpleNamespace(films=(film,)) for film in made])


def test_films_of_light_elements_leave_the_radius_to_the_loaded_ones():
    """A gap of 5 µm, and the film of 2 µm at 1 % of the largest load, are at the rim."""
    figure = films_of([(0.1, 1000.0), (0.2, 25.0), (5.0, 0.0), (2.0, 10.0)], [(0.15, 500.0)])
    loaded, light, other = figure["data"]
    radial = figure["layout"]["polar"]["radialaxis"]
    assert (loaded["theta"], other["name"]) == ([0, 1], "B, inner ring")
    assert loaded["r"] == pytest.approx([0.1, 0.2])
    assert radial["range"] == pytest.approx([0.0, 0.24])
    assert light["theta"] == [2, 3]
    assert light["r"] == pytest.approx([0.24, 0.24])
    assert light["customdata"] == ["inner ring, 0 N: 5 µm", "inner ring, 10 N: 2 µm"]
    wide = films_of([(0.1, 1000.0), (0.2, 25.0)], [(2.0, 500.0)])["layout"]["polar"]["radialaxis"]
    assert (wide["type"], 10.0 ** wide["range"][0]) == ("log", pytest.approx(0.08))


@pytest.mark.slow
def test_voltages_over_the_speed_are_those_of_the_package_at_the_speed_of_each_case(solved):
    sides = [whole_side(one.table) for one in (FAST, SLOW)]
    data = figures.over_speed(sides)["data"]
    curves = {one["name"]: one for one in data if one["mode"] == "lines"}
    assert list(curves) == [
        f"{name}, {voltage}" for name in "AB" for voltage in ("first breakdown voltage", "shaft voltage")
    ]
    summary, first = numbers_of(solved)["bearing"], curves["A, first breakdown voltage"]
    # A curve goes through the voltage at the speed of its case, 3000 rpm.
    near = np.interp(3000.0, first["x"], first["y"])
    assert near == pytest.approx(summary["first_break"], rel=1e-2)
    assert next(one["y"] for one in data if one["mode"] != "lines") == [summary["first_break"]]


def test_only_changes_of_a_percent_are_marked():
    def marked(change, first="1", second="2"):
        return Effect(Result("g", "n", 1.0, first), Result("g", "n", 1.0, second), change).large

    assert [marked(change) for change in (-55.0, 1.0, 0.99, -0.04)] == [True, True, False, False]
    assert marked(None)
    assert not marked(None, "full film", "full film")
